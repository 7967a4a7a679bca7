#!/usr/bin/env python3
"""Lets programs by others judge a shell: judge.py manifold SHELL, judge.py prusaslicer SHELL --report JSON, or
judge.py poses SHELL --report JSON --table EXE [--contact-height-mm H], or judge.py layers SHELL --validation JSON --raster EXE.

SHELL is a 3MF or binary STL as Aplomb writes it. Every judge prints what it measured and ends with 1 when the shell
does not hold what it promises.
"""
import argparse
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import gcode
import layers
import shells
import void_core

HERE = pathlib.Path(__file__).resolve().parent
LAYER_MM = 0.1  # beads are round where they meet air: at 0.2 mm a wall of 1.6 mm lacks another 1.5 %
FILAMENT_MM = 1.75
BED_CENTRE_MM = 500
VALIDATED_LAYER_MM = 0.2  # the default of `aplomb validate`
LEAST_ISLAND_MM2 = 0.1  # smaller ones are bumps to it
SLICING = [
    "--fill-pattern", "rectilinear", "--fill-density", "100%", "--filament-diameter", str(FILAMENT_MM),
    "--nozzle-diameter", "0.4", "--layer-height", str(LAYER_MM), "--first-layer-height", str(LAYER_MM),
    "--first-layer-extrusion-width", "0.45", "--elefant-foot-compensation", "0", "--skirts", "0", "--brim-width", "0",
    "--no-thick-bridges",  # a round bead of the nozzle in a layer of 0.1 mm is three times what the layer holds
    "--infill-overlap", "0%",  # what overlaps is laid twice: at 10 % that is 1.5 % of a wall of 1.6 mm
    "--slicing-mode", "regular", "--bed-shape=0x0,1000x0,1000x1000,0x1000", "--max-print-height", "1000",
]


def relative(measured, expected):
    return measured / expected - 1


class Verdict:
    """What was measured, and which of it is wrong."""

    def __init__(self):
        self.wrong = []

    def expect(self, name, holds, measured):
        print(f"{'ok   ' if holds else 'WRONG'} {name}: {measured}")
        if not holds:
            self.wrong.append(name)


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def prusaslicer(path, report):
    """The shell is manifold, has the volume meant, and sliced solid it prints that volume, its centre of mass where the
    report has it, and leaves the voids empty."""
    verdict = Verdict()
    mesh = shells.read(path)
    outer, voids = shells.split_voids(mesh)
    intended = shells.intended_volume(outer, voids)
    told = dict(re.findall(r"^(\w+) = +(\S+)$", run("prusa-slicer", "--info", path), re.MULTILINE))
    verdict.expect("manifold", told["manifold"] == "yes", told["manifold"])
    error = relative(float(told["volume"]), intended)
    verdict.expect("volume = outer - voids", abs(error) < 1e-3, f"{told['volume']} mm3, {error:+.1e}")

    printed, strayed, first_moment = 0.0, 0.0, [0.0] * 3
    core = void_core.VoidCore(voids) if voids else None
    for extrusion in sliced(path, mesh):
        (x0, y0), (x1, y1), z, volume = extrusion
        printed += volume
        for axis, middle in enumerate(((x0 + x1) / 2, (y0 + y1) / 2, z)):
            first_moment[axis] += volume * middle
        if core:
            strayed += extrusion.volume * core.share_along(extrusion.start, extrusion.end, extrusion.z)
    error = relative(printed, intended)
    verdict.expect("extruded volume", abs(error) < 0.01, f"{printed:.0f} mm3, {100 * error:+.2f} %")
    off = [m / printed - told for m, told in zip(first_moment, report["poses"][0]["after"]["com_mm"])]
    error = math.hypot(*off)
    verdict.expect("extruded centre of mass", error < 0.3, f"off by {error:.3f} mm ({off[0]:+.3f}, {off[1]:+.3f}, {off[2]:+.3f})")
    if core:
        verdict.expect("voids have a core", core.volume() > 0, f"{len(voids)} voids, core of {core.volume():.0f} mm3")
        verdict.expect("nothing printed in the core", strayed == 0, f"{strayed:.3f} mm3")
    return verdict


def sliced(path, mesh):
    """Every extrusion of the sliced file, in the mesh's own coordinates, z in the middle of the bead."""
    used = [mesh.vertices[i] for triangle in mesh.triangles for i in triangle]
    low, high = ([pick(v[axis] for v in used) for axis in range(3)] for pick in (min, max))
    # Round numbers in the middle of the bed: about a centre such as -0.0014, PrusaSlicer 2.5 finds no room on any bed.
    shift = [(low[axis] + high[axis]) / 2 - BED_CENTRE_MM for axis in range(2)]
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "print.gcode"
        run("prusa-slicer", "--export-gcode", *SLICING, "--center", f"{BED_CENTRE_MM},{BED_CENTRE_MM}", "--output", str(program), path)
        with open(program) as lines:
            for extrusion in gcode.extrusions(lines, FILAMENT_MM):
                (x0, y0), (x1, y1), top, volume = extrusion
                start, end = (x0 + shift[0], y0 + shift[1]), (x1 + shift[0], y1 + shift[1])
                yield gcode.Extrusion(start, end, top - LAYER_MM / 2 + low[2], volume)


def manifold(path):
    """manifold-3d takes the shell as it is, and computes the volume meant."""
    verdict = Verdict()
    mesh = shells.read(path)
    intended = shells.intended_volume(*shells.split_voids(mesh))
    with tempfile.TemporaryDirectory() as folder:
        given = pathlib.Path(folder) / "mesh.json"
        given.write_text(json.dumps(mesh._asdict()))
        told = json.loads(run("node", str(HERE / "manifold.mjs"), str(given)))
    verdict.expect("status", told["status"] == "NoError", told["status"])
    error = relative(told["volume"], intended)
    verdict.expect("volume = outer - voids", abs(error) < 1e-6, f"{told['volume']:.3f} mm3, {error:+.1e}")
    return verdict


def layered(path, validation, raster):
    """PrusaSlicer's own layers of the shell show the voids, the widest span of their ceilings and the islands in them that
    `aplomb validate` tells of."""
    verdict = Verdict()
    mesh = shells.read(path)
    _, voids = shells.split_voids(mesh)
    intended = sum(abs(shells.body(part).volume) for part in voids)
    shown = layers.shown(path, mesh, raster, VALIDATED_LAYER_MM, allowed_mm=VALIDATED_LAYER_MM)  # 45 degrees
    found = VALIDATED_LAYER_MM * sum(shown.void_mm2)
    verdict.expect("volume of the voids", abs(found - intended) <= 0.002 * intended + 1, f"{found:.0f} of {intended:.0f} mm3")
    check = next(check for check in validation["checks"] if check["id"] == "void.bridge")
    told, span = check.get("measured", 0), max(shown.span_mm)
    # What is narrower than two pixels more than a layer may overhang is there in one and not there in the other.
    near = abs(span - told) <= 4 * layers.PIXEL_MM or max(span, told) < 2 * (VALIDATED_LAYER_MM + 2 * layers.PIXEL_MM)
    verdict.expect("widest span", near, f"{span:.2f} mm in layer {shown.span_mm.index(span)}, {told:.2f} told")
    told = sorted(finding["measured"] for finding in validation["findings"] if finding["id"] == "void.island")
    islands = sorted(island.area_mm2 for island in shown.islands if island.area_mm2 >= LEAST_ISLAND_MM2)
    alike = len(told) == len(islands) and all(abs(a - b) < 0.1 * b + 0.1 for a, b in zip(told, islands))
    verdict.expect("islands in voids", alike, f"{islands} mm2, {told} told")
    return verdict


def poses(path, report, table, contact_height_mm):
    """The report's numbers are the file's, and every pose of the report is held as it says."""
    verdict = Verdict()
    mesh = shells.read(path)
    for pose in report["poses"]:
        body = shells.body(mesh)
        after = pose["after"]
        error = relative(after["volume_mm3"], body.volume)
        verdict.expect("volume of the report", abs(error) < 1e-6, f"{error:+.1e}")
        error = math.dist(after["com_mm"], body.centroid)
        verdict.expect("centre of mass of the report", error < 1e-3, f"off by {error:.1e} mm")
        if pose["kind"] == "hanging":
            hang(verdict, body, pose)
        else:
            stand(verdict, shells.turned_upright(mesh, pose["up"]), after, table, contact_height_mm)
    return verdict


def stand(verdict, mesh, after, table, contact_height_mm):
    """On Bullet's tilt table the body stands exactly as far as the report says."""
    body = shells.body(mesh)
    polygon = shells.support_polygon(mesh, contact_height_mm)
    plate = min(mesh.vertices[i][2] for triangle in mesh.triangles for i in triangle)
    weakest = min(tip_angle(body.centroid, plate, edge) for edge in edges(polygon))
    error = math.degrees(weakest) - after["tip_deg"]
    verdict.expect("tip angle of the report", abs(error) < 0.01, f"{after['tip_deg']:.3f} degrees, off by {error:.1e}")
    judge_on_table(verdict, body, plate, polygon, math.radians(after["tip_deg"]), table)


def hang(verdict, body, pose):
    """From one thread a body comes to rest with its centre of mass straight below: so far from `up` it hangs."""
    attachment, = pose["attachments_mm"]
    thread = shells.minus(attachment, body.centroid)
    up = pose["up"]
    tilt = math.degrees(math.atan2(math.hypot(*shells.cross(up, thread)), shells.dot(up, thread)))
    error = tilt - pose["after"]["tilt_deg"]
    verdict.expect("tilt of the report", abs(error) < 0.01, f"{tilt:.3f} degrees, off by {error:.1e}")
    allowed = pose["required_tilt_deg"]
    verdict.expect("hangs as asked", (tilt <= allowed) == pose["holds"], f"{tilt:.3f} of {allowed:.3f} degrees")


def edges(polygon):
    return zip(polygon, polygon[1:] + polygon[:1])


def tip_angle(centroid, plate, edge):
    """atan2(distance of the centre of mass inside the edge, its height)."""
    return math.atan2(shells.turn(*edge, centroid) / math.dist(*edge), centroid[2] - plate)


def tip_angle_towards(centroid, plate, polygon, direction):
    """The tilt at which the plumb line from the centre of mass leaves the support polygon, table leaning that way."""
    reach = math.inf
    for a, b in edges(polygon):
        outward = (b[1] - a[1]) * math.cos(direction) - (b[0] - a[0]) * math.sin(direction)
        if outward > 0:
            reach = min(reach, shells.turn(a, b, centroid) / outward)
    return math.atan2(reach, centroid[2] - plate)


def judge_on_table(verdict, body, plate, polygon, promised, table, tolerance=math.radians(0.5)):
    """Tilts across the weakest edge and eight other ways, half a degree short of the tip angle and beyond it."""
    if promised < 0:
        falls = ask(table, body, plate, polygon, [(0.0, 0.0)]) == ["falls"]
        verdict.expect("falls on a level table", falls, "falls" if falls else "stands")
        return
    polygon = coarsened(polygon, math.radians(0.02) * (body.centroid[2] - plate))
    a, b = min(edges(polygon), key=lambda edge: tip_angle(body.centroid, plate, edge))
    weakest = math.atan2(a[0] - b[0], b[1] - a[1])
    directions = [(weakest, promised)]
    for i in range(8):
        direction = 0.2 + i * math.pi / 4
        directions.append((direction, tip_angle_towards(body.centroid, plate, polygon, direction)))
    questions = [(way, angle + sign * tolerance) for way, angle in directions for sign in (-1, 1)]
    questions = [(way, max(angle, 0.0)) for way, angle in questions]
    answers = ask(table, body, plate, polygon, questions)
    for (way, angle), short, beyond in zip(directions, answers[::2], answers[1::2]):
        name = f"tips at {math.degrees(angle):.2f} +- 0.5 degrees towards {math.degrees(way):.0f}"
        verdict.expect(name, (short, beyond) == ("stands", "falls"), f"{short} short of it, {beyond} beyond")


def coarsened(polygon, tolerance):
    """The polygon without the corners that stand out by less than the tolerance: Bullet is slow with hundreds of them."""
    kept = [polygon[0]]
    passed = []
    for corner, following in zip(polygon[1:], polygon[2:] + polygon[:1]):
        passed.append(corner)
        if any(-shells.turn(kept[-1], following, p) > tolerance * math.dist(kept[-1], following) for p in passed):
            kept.append(corner)
            passed = []
    return kept


def ask(table, body, plate, polygon, questions):
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = body.inertia
    numbers = [body.volume, *body.centroid, xx, xy, xz, yy, yz, zz, plate, len(polygon)]
    numbers += [c for corner in polygon for c in corner] + [q for question in questions for q in question]
    answer = subprocess.run([table], input=" ".join(map(repr, numbers)), check=True, capture_output=True, text=True)
    return answer.stdout.split()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("judge", choices=["prusaslicer", "manifold", "poses", "layers"])
    parser.add_argument("shell")
    parser.add_argument("--report")
    parser.add_argument("--validation")
    parser.add_argument("--table")
    parser.add_argument("--raster")
    parser.add_argument("--contact-height-mm", type=float, default=0.1)
    arguments = parser.parse_args()
    if arguments.judge == "manifold":
        verdict = manifold(arguments.shell)
    elif arguments.judge == "layers":
        with open(arguments.validation) as file:
            verdict = layered(arguments.shell, json.load(file), arguments.raster)
    else:
        with open(arguments.report) as file:
            report = json.load(file)
        if arguments.judge == "prusaslicer":
            verdict = prusaslicer(arguments.shell, report)
        else:
            verdict = poses(arguments.shell, report, arguments.table, arguments.contact_height_mm)
    return 1 if verdict.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
