#!/usr/bin/env python3
"""Judges `aplomb verify` on real slicers' programs: printed.py prusaslicer|cura --aplomb EXE MODEL [SLICER FLAGS].

Slices the model and sums up mass and centre of mass per object with gcode.py, which shares no code with Aplomb and reads
plain moves only. Ends with 77 where the slicer is not installed.
"""
import argparse
import collections
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import gcode

DENSITY = 1.11  # g/cm3; no slicer's default
FILAMENT_MM = 1.75
MASS_ERROR, COM_ERROR_MM = 1e-4, 2e-3
CURA = pathlib.Path("/usr/share/cura/resources")
NOT_THE_MODEL = ("support", "skirt", "brim", "tower", "custom")


class Context:
    """Which object and feature the moves belong to, and how high the bead is, by the comments that passed."""

    def __init__(self):
        self.label, self.feature, self.height = None, None, None

    def follow(self, lines):
        for line in lines:
            if line.startswith("G91"):  # Cura's end code; nothing is printed after it
                return
            if line.startswith("; printing object "):
                self.label = line.removeprefix("; printing object ").strip()
            elif line.startswith("; stop printing object"):
                self.label = None
            elif line.startswith(";MESH:"):
                name = line.removeprefix(";MESH:").strip()
                self.label = None if name == "NONMESH" else os.path.basename(name)
            elif line.startswith(";TYPE:"):
                self.feature = line.removeprefix(";TYPE:").strip().lower()
            elif line.startswith(";HEIGHT:"):
                self.height = float(line.removeprefix(";HEIGHT:"))
            yield line

    def is_model(self):
        return self.label and self.feature and not any(word in self.feature for word in NOT_THE_MODEL)


def summed_up(path):
    """{object: (mass in g, centre of mass)}"""
    sums = collections.defaultdict(lambda: [0.0] * 4)
    context, layers = Context(), []
    with open(path) as lines:
        for extrusion in gcode.extrusions(context.follow(lines), FILAMENT_MM):
            (x0, y0), (x1, y1), top, volume = extrusion
            if context.height is None and (not layers or top > layers[-1] + 1e-6) and context.feature:
                layers.append(top)
            if not context.is_model():
                continue
            height = context.height or top - ([0] + layers)[layers.index(top)]
            for i, value in enumerate((1, (x0 + x1) / 2, (y0 + y1) / 2, top - height / 2)):
                sums[context.label][i] += volume * value
    return {name: (1e-3 * DENSITY * v, (x / v, y / v, z / v)) for name, (v, x, y, z) in sums.items()}


def slice_with(slicer, model, flags, program):
    if slicer == "prusaslicer":
        command = ["prusa-slicer", "--export-gcode", "--gcode-label-objects", "--filament-density", str(DENSITY),
                   "--bed-shape", "0x0,400x0,400x400,0x400", "--max-print-height", "400", *flags, "-o", program, model]
    else:
        command = ["CuraEngine", "slice", "-j", str(CURA / "definitions/creality_ender3.def.json"), "-s", "layer_height=0.2",
                   "-s", "infill_line_distance=4", "-s", "adhesion_type=brim", *flags, "-o", program, "-l", model]
    if not shutil.which(command[0]) or (slicer == "cura" and not CURA.is_dir()):
        print(f"{command[0]} is not installed")
        sys.exit(77)
    paths = {**os.environ, "CURA_ENGINE_SEARCH_PATH": f"{CURA / 'definitions'}:{CURA / 'extruders'}"}
    subprocess.run(command, check=True, capture_output=True, env=paths)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("slicer", choices=["prusaslicer", "cura"])
    parser.add_argument("model")
    parser.add_argument("--aplomb", required=True)
    arguments, flags = parser.parse_known_args()
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "print.gcode")
        slice_with(arguments.slicer, arguments.model, flags, program)
        given = [] if arguments.slicer == "prusaslicer" else ["--density", str(DENSITY), "--diameter", str(FILAMENT_MM)]
        told = subprocess.run([arguments.aplomb, "verify", program, "--report", "-", "-q", *given], capture_output=True, text=True)
        objects = {o["name"]: o for o in json.loads(told.stdout)["objects"]}
        expected = summed_up(program)
        print(f"objects: {sorted(objects)}")
        wrong += sorted(objects) != sorted(expected)
        for name, (mass, centre) in expected.items():
            error, off = objects[name]["mass_g"] / mass - 1, math.dist(objects[name]["com_mm"], centre)
            print(f"{name}: {mass:.3f} g, {error:+.1e}; centre of mass off by {off:.1e} mm")
            wrong += not (abs(error) < MASS_ERROR and off < COM_ERROR_MM)
        stated = re.search(r"^; total filament used \[g\] = (\S+)", pathlib.Path(program).read_text(), re.MULTILINE)
        if stated:
            report = json.loads(told.stdout)
            total = sum(o["mass_g"] for o in report["objects"]) + sum(p["mass_g"] for p in report["left_out"])
            print(f"in all: {total:.2f} g, {stated[1]} g by the slicer")
            wrong += abs(total - float(stated[1])) > 0.02
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
