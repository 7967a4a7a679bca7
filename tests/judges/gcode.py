"""Reads what a G-code program extrudes. Knows the absolute, linear moves that PrusaSlicer writes; refuses others."""
import collections
import math

Extrusion = collections.namedtuple("Extrusion", "start end z volume")  # mm, mm, top of the bead in mm, mm3


def extrusions(lines, filament_diameter):
    """Yields every move that lays down material. Retractions are moves without a path, so they do not count."""
    area = math.pi / 4 * filament_diameter**2
    at = {"X": 0.0, "Y": 0.0, "Z": 0.0, "E": 0.0}
    relative_e = False
    for line in lines:
        words = line.partition(";")[0].split()
        if not words:
            continue
        code = words[0]
        if code in ("M82", "M83"):
            relative_e = code == "M83"
        elif code in ("G2", "G3", "G91"):
            raise ValueError(f"cannot read {line.strip()!r}")
        elif code in ("G0", "G1", "G92"):
            to = dict(at)
            for word in words[1:]:
                if word[0] in at:
                    step = relative_e and word[0] == "E" and code != "G92"
                    to[word[0]] = float(word[1:]) + (at["E"] if step else 0)
            start, end = (at["X"], at["Y"]), (to["X"], to["Y"])
            if code != "G92" and to["E"] > at["E"] and start != end:
                yield Extrusion(start, end, to["Z"], (to["E"] - at["E"]) * area)
            at = to
