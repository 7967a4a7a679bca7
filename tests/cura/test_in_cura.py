#!/usr/bin/env python3
"""The plugin in the real Cura: a package is installed, a figure that falls is made to stand, sliced, and put back."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "judges"))
import gcode  # noqa: E402
import run_cura  # noqa: E402
import void_core  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLI = os.environ["APLOMB_CLI"]
MODEL = pathlib.Path(os.environ["APLOMB_FIXTURES"]) / "trex.stl"
FILAMENT_MM = 1.75


class Surface:
    def __init__(self, triangles):
        self.vertices = [tuple(map(float, vertex)) for vertex in triangles.reshape(-1, 3)]
        self.triangles = [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles))]


def model_lines(lines):
    """The G-code of the model alone: no start and end code, no skirt."""
    kept, is_in_layers, is_skirt = [], False, False
    for line in lines:
        is_in_layers = is_in_layers or line.startswith(";LAYER:")
        if line.startswith(";TYPE:"):
            is_skirt = line.startswith(";TYPE:SKIRT")
        # What is left out still moves the head and the filament.
        kept.append((is_in_layers and not is_skirt, line))
        if line.startswith(";End of Gcode"):
            break
    return kept


def printed(path):
    """The extrusions of the model, in the G-code's coordinates."""
    marked = model_lines(path.read_text().splitlines())
    counts = [keep for keep, line in marked]
    at = {"line": -1}

    def numbered():
        for number, (_, line) in enumerate(marked):
            at["line"] = number
            yield line

    return [e for e in gcode.extrusions(numbered(), FILAMENT_MM) if counts[at["line"]]]


class InCura(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="aplomb_cura"))
        package = cls.folder / "Aplomb.curapackage"
        subprocess.run([ROOT / "plugin/cura/build_package", "--program", CLI, "--without-libraries", "-o", package], check=True)
        cls.seen = run_cura.run(package, MODEL, cls.folder, 900)
        cls.out = cls.folder / "out"

    @classmethod
    def tearDownClass(cls):
        kept = os.environ.get("APLOMB_CURA_PICTURES")
        if kept:
            for path in (cls.folder / "out").glob("*.png"):
                shutil.copy(path, kept)
        shutil.rmtree(cls.folder)

    def own(self, name):
        return numpy.load(self.out / f"{name}.own.npy")

    def plate(self, name):
        """Triangles as they lie on the plate, z up, in the G-code's coordinates: Cura's scene begins in the bed's middle."""
        x, y, z = numpy.moveaxis(numpy.load(self.out / f"{name}.world.npy").astype(float), 2, 0)
        width, depth = self.seen["bed_mm"]
        return numpy.stack([x + width / 2, depth / 2 - z, y], axis=2)

    def test_the_story_was_told_to_its_end(self):
        self.assertNotIn("error", self.seen, self.seen.get("error"))
        self.assertEqual(self.seen["menu"][:2], ["Make it stand", "Will it stand?"])

    def test_the_figure_is_said_to_fall_then_made_to_stand_and_then_said_to_stand(self):
        self.assertIn("falls over", self.seen["checked"]["text"])
        self.assertIn("stands now", self.seen["made"]["text"])
        self.assertIn("8.0\u00b0", self.seen["made"]["text"])  # the angle that the dialog was given
        self.assertIn("it stands", self.seen["checked_again"]["text"])

    def test_settings_are_remembered_in_the_preferences(self):
        self.assertEqual(self.seen["settings"], {"tip_deg": 8.0, "wall_mm": 1.6, "aim": "least", "deform": "never"})

    def test_a_run_shows_how_far_it_is_and_is_cancelled_by_a_click(self):
        self.assertGreater(self.seen["progress"]["value"], 5)
        self.assertIn("cancelled", self.seen["cancelled"]["text"])
        self.assertLess(self.seen["cancelled"]["seconds"], 3)
        self.assertTrue(self.seen["kept_after_cancel"])

    def test_the_swapped_mesh_has_the_models_own_outside_to_the_last_bit_and_a_void(self):
        self.assertTrue(self.seen["swapped"])
        original, made = self.own("original"), self.own("made")
        self.assertGreater(len(made), len(original))
        self.assertEqual(made[:len(original)].tobytes(), original.tobytes())

    def test_undo_restores_the_mesh_and_redo_swaps_it_again(self):
        self.assertTrue(self.seen["undone"] and self.seen["redone"])
        self.assertEqual(self.own("undone").tobytes(), self.own("original").tobytes())

    def test_a_model_that_was_changed_meanwhile_is_left_alone(self):
        self.assertIn("changed while", self.seen["changed"]["text"])
        self.assertTrue(self.seen["changed"]["kept"])

    def test_nothing_is_extruded_in_the_void(self):
        made = self.plate("made")
        void = Surface(made[len(self.own("original")):, ::-1])
        core = void_core.VoidCore([void])
        self.assertGreater(core.volume(), 1000)
        strayed = sum(e.volume * core.share_along(e.start, e.end, e.z) for e in printed(self.out / "made.gcode"))
        self.assertLess(strayed, 1)  # mm3

    def test_the_printed_centre_of_mass_is_over_the_feet_where_that_of_the_figure_as_it_came_is_not(self):
        extruded = printed(self.out / "made.gcode")
        mass = sum(e.volume for e in extruded)
        x, y = (sum(e.volume * (e.start[axis] + e.end[axis]) / 2 for e in extruded) / mass for axis in range(2))
        report = self.folder / "report.json"
        subprocess.run([CLI, "check", MODEL, "--report", report, "-q"])
        before = json.loads(report.read_text())["before"]
        corners = before["support_polygon_mm"]
        offset = self.plate("original").reshape(-1, 3).min(axis=0) - numpy.concatenate(self.own("original")).min(axis=0)[[0, 2, 1]]
        self.assertTrue(math.isfinite(mass) and mass > 0)
        self.assertLess(max(c[0] for c in corners), before["com_mm"][0])  # it falls to +x as it came
        self.assertEqual(self.seen["sliced"], 3)
        edge = self.edge_x()
        self.assertLess(x, edge - 1, (x, y, edge, offset))

    def edge_x(self):
        """The foremost place where the figure touches the plate, in the G-code's coordinates."""
        low = self.plate("original").reshape(-1, 3)
        return low[low[:, 2] < low[:, 2].min() + 0.1][:, 0].max()


if __name__ == "__main__":
    sys.exit(unittest.main())
