#!/usr/bin/env python3
"""Judges pockets for inserts in PrusaSlicer's own program: inserts.py --aplomb EXE [--profile INI] MODEL [FLAGS OF stand].

Makes MODEL stand with FLAGS (an --insert among them), slices the 3MF and holds the G-code against the report: it
pauses once for each pocket (or once for those that end in one layer), all that is printed before a pocket's pause lies below its ceiling,
what comes after it above, and no bead enters the space of an insert, before or after. Ends with 77 where PrusaSlicer
is not installed.
"""
import argparse
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

import gcode

FILAMENT_MM = 1.75
CENTRE_MM = 200
BEAD_MM = 0.45  # its width, at most: PrusaSlicer's default for a nozzle of 0.4
ROUNDING_MM = 2e-3


def distance(point, start, end):
    (px, py), (ax, ay), (bx, by) = point, start, end
    dx, dy = bx - ax, by - ay
    along = max(0.0, min(1.0, ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy)))
    return math.hypot(px - ax - along * dx, py - ay - along * dy)


class Watched:
    """Lines on their way to the reader; notes the pauses that passed."""

    def __init__(self, lines):
        self.lines, self.pauses = lines, 0

    def __iter__(self):
        for line in self.lines:
            if line.startswith("M601"):
                self.pauses += 1
            yield line


class Space:
    """What inserts take up in a pocket, in the slicer's coordinates: coins an upright cylinder, balls balls."""

    def __init__(self, pocket, shift, radius):
        x, y, _ = pocket["at_mm"]
        self.axis = x + shift[0], y + shift[1]
        self.floor, self.top, self.radius = pocket["floor_mm"], pocket["pause_mm"], radius
        self.is_ball = pocket["name"].startswith("ball")

    def radius_at(self, height):
        """Of the insert; over the steps of its floor a ball lies up to a layer higher, and is left out there."""
        above = height - self.floor
        if above <= 0 or height >= self.top:
            return 0.0
        if not self.is_ball:
            return self.radius
        below_equator = self.radius - above % (2 * self.radius)
        return math.sqrt(max(0.0, self.radius**2 - below_equator**2)) - 0.2

    def enters(self, extrusion, layer_mm):
        radius = self.radius_at(extrusion.z - layer_mm / 2)
        return radius > 0 and distance(self.axis, extrusion.start, extrusion.end) - BEAD_MM / 2 < radius - ROUNDING_MM


def judge(program, report, layer_mm, clearance_mm=0.25):
    pockets = report["inserts"]["pockets"]
    low, high = report["before"]["box_mm"]
    shift = [CENTRE_MM - (low[axis] + high[axis]) / 2 for axis in (0, 1)]
    spaces = [Space(p, shift, p["diameter_mm"] / 2 - clearance_mm) for p in pockets]
    ceilings = sorted({round(p["pause_mm"], 4) for p in pockets})
    wrong = []
    with open(program) as lines:
        watched, entered, strayed, between = Watched(lines), 0, 0, 0
        for extrusion in gcode.extrusions(watched, FILAMENT_MM):
            entered += any(space.enters(extrusion, layer_mm) for space in spaces)
            passed = sum(extrusion.z > ceiling + ROUNDING_MM for ceiling in ceilings)
            strayed += passed != watched.pauses
            between += min(s.floor for s in spaces) < extrusion.z < max(s.top for s in spaces)
    for name, value, is_right in (("pauses", watched.pauses, watched.pauses == len(ceilings)),
                                  ("beads on the wrong side of a pause", strayed, strayed == 0),
                                  ("beads within an insert", entered, entered == 0),
                                  ("beads beside the pockets", between, between > 100)):
        print(f"{'ok   ' if is_right else 'WRONG'} {name}: {value}")
        wrong += [] if is_right else [name]
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--aplomb", required=True)
    parser.add_argument("--layer-mm", type=float, default=0.2)
    parser.add_argument("--first-layer-mm", type=float, default=0.2)
    parser.add_argument("--fill", default="100%")
    parser.add_argument("model")
    arguments, flags = parser.parse_known_args()
    if not shutil.which("prusa-slicer"):
        print("prusa-slicer is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        shell, told, program, profile = (folder / name for name in ("out.3mf", "out.json", "out.gcode", "profile.ini"))
        profile.write_text(f"layer_height = {arguments.layer_mm}\nfirst_layer_height = {arguments.first_layer_mm}\n"
                           f"fill_density = {arguments.fill}\nfill_pattern = rectilinear\nperimeters = 3\n"
                           "filament_density = 1.24\nnozzle_diameter = 0.4\nbrim_width = 0\nskirts = 0\n")
        subprocess.run([arguments.aplomb, "stand", arguments.model, *flags, "--profile", profile, "-q", "-o", shell,
                        "--report", told], check=True)
        subprocess.run(["prusa-slicer", "--export-gcode", "--load", profile, "--center", f"{CENTRE_MM},{CENTRE_MM}",
                        "--bed-shape", "0x0,400x0,400x400,0x400", "--max-print-height", "400", "-o", program, shell],
                       check=True, capture_output=True)
        sys.exit(1 if judge(program, json.loads(told.read_text()), arguments.layer_mm) else 0)


if __name__ == "__main__":
    main()
