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

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/judges"), str(ROOT / "plugin/cura")]
import gcode  # noqa: E402
import run_cura  # noqa: E402
import void_core  # noqa: E402
from Aplomb import meshes  # noqa: E402

CLI = os.environ["APLOMB_CLI"]
MODELS = [pathlib.Path(os.environ["APLOMB_FIXTURES"]) / name for name in ("trex.stl", "seal.stl")]
FILAMENT_MM, LAYER_MM = 1.75, 0.2
SPARSE = {"layer_height": 0.2, "line_width": 0.4, "wall_line_count": 2, "top_layers": 4, "bottom_layers": 4, "infill_sparse_density": 15,
          "infill_pattern": "cubic", "material_density": 1.24}  # about as Cura's Ender-3 is


class Surface:
    def __init__(self, triangles):
        self.vertices = [tuple(map(float, vertex)) for vertex in triangles.reshape(-1, 3)]
        self.triangles = [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles))]


def printed(path):
    """The extrusions of the model: what Cura writes between its layers' beginning and its end code, without the skirt."""
    lines = path.read_text().splitlines()
    end = next(number for number, line in enumerate(lines) if line.startswith("G91"))  # the end code's first relative move
    part = {"of_model": False}

    def watched():
        for line in lines[:end]:
            if line.startswith(";TYPE:"):
                part["of_model"] = not line.startswith(";TYPE:SKIRT")
            yield line

    return [extrusion for extrusion in gcode.extrusions(watched(), FILAMENT_MM) if part["of_model"]]


def centre_of(extrusions):
    """Centre of mass; a bead's is half a layer below its top."""
    mass = sum(e.volume for e in extrusions)
    x, y = (sum(e.volume * (e.start[axis] + e.end[axis]) / 2 for e in extrusions) / mass for axis in range(2))
    return numpy.array([x, y, sum(e.volume * (e.z - LAYER_MM / 2) for e in extrusions) / mass])


def margin(corners, point):
    """How far a point lies inside a convex, counter-clockwise polygon."""
    edges = zip(corners, corners[1:] + corners[:1])
    return min(((bx - ax) * (point[1] - ay) - (by - ay) * (point[0] - ax)) / math.dist((ax, ay), (bx, by))
               for (ax, ay, _), (bx, by, _) in edges)


class InCura(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="aplomb_cura"))
        package = cls.folder / "Aplomb.curapackage"
        subprocess.run([ROOT / "plugin/cura/build_package", "--program", CLI, "--without-libraries", "-o", package], check=True)
        profile, ballast = cls.folder / "cura.json", cls.folder / "trex.3mf"
        profile.write_text(json.dumps(SPARSE))
        subprocess.run([CLI, "stand", MODELS[0], "--profile", profile, "--tip", "8deg", "-o", ballast, "-q"], check=True)
        cls.seen = run_cura.run(package, MODELS, ballast, cls.folder, 2000)
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
        self.assertEqual(self.seen["complaints"], [])  # of Qt about the dialog
        self.assertEqual(self.seen["menu"][:2], ["Make it stand", "Will it stand?"])

    def test_the_figure_is_said_to_fall_then_made_to_stand_and_then_said_to_stand(self):
        self.assertIn("falls over", self.seen["checked"]["text"])
        self.assertIn("stands now", self.seen["made"]["text"])
        self.assertIn("8.0\u00b0", self.seen["made"]["text"])  # the angle that the dialog was given
        self.assertIn("it stands", self.seen["checked_again"]["text"])

    def test_settings_are_remembered_in_the_preferences(self):
        self.assertEqual(self.seen["settings"], {"tip_deg": 8.0, "wall_mm": 1.6, "aim": "least", "deform": "never"})

    def test_infill_layer_height_filament_and_what_spoils_a_void_are_read_from_cura(self):
        profile, spoilt = self.seen["profile"], self.seen["profile_spoilt"]
        self.assertEqual((profile["infill_percent"], profile["layer_mm"], profile["density_g_per_cm3"]), (100, 0.2, 1.24))
        self.assertEqual(profile["spoilt_by"], [])
        self.assertEqual(spoilt["infill_percent"], 33)
        self.assertIn("Remove All Holes", spoilt["spoilt_by"][0])

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

    def test_all_models_are_asked_about_or_those_that_are_selected_and_a_group_is_not_taken_apart(self):
        names = [model.name for model in MODELS]
        self.assertTrue(all(name in self.seen["of_all"]["text"] for name in names), self.seen["of_all"])
        self.assertNotIn(names[0], self.seen["of_selected"]["text"])
        self.assertIn(names[1], self.seen["of_selected"]["text"])
        self.assertEqual(self.seen["of_group"]["text"].count("part of a group"), 2)

    def test_nothing_is_extruded_in_the_void_which_is_full_where_it_was_not_made(self):
        made = self.plate("made")
        core = void_core.VoidCore([Surface(made[len(self.own("original")):, ::-1])])
        strayed = {name: sum(e.volume * core.share_along(e.start, e.end, e.z) for e in printed(self.out / f"{name}.gcode"))
                   for name in ("plain", "made")}
        print(f"core {core.volume():.0f} mm3, extruded in it {strayed['plain']:.0f} before, {strayed['made']:.2f} mm3 after")
        self.assertGreater(core.volume(), 1000)
        self.assertLess(strayed["made"], 1)  # mm3
        self.assertGreater(strayed["plain"], 0.9 * core.volume())

    def test_the_printed_centre_of_mass_is_where_it_was_predicted(self):
        for name, mesh in (("plain", "original"), ("made", "made")):
            predicted = numpy.array(self.check(mesh)["com_mm"])
            off = centre_of(printed(self.out / f"{name}.gcode")) - predicted
            print(f"{name}: centre of mass of the G-code less the predicted one {off.round(3)} mm")
            self.assertLess(abs(off).max(), 0.5)

    def test_what_cura_sliced_before_falls_by_its_own_gcode_and_what_it_sliced_after_stands(self):
        self.assertTrue(self.seen["sliced_plain"] and self.seen["sliced_made"])
        feet = self.check("original")["support_polygon_mm"]
        margins = {name: margin(feet, centre_of(printed(self.out / f"{name}.gcode"))) for name in ("plain", "made")}
        print("margins by the G-code:", margins)
        self.assertLess(margins["plain"], -1, margins)
        self.assertGreater(margins["made"], 2, margins)

    def test_infill_denser_on_one_side_arrives_as_an_infill_mesh_and_makes_it_stand(self):
        for told in (self.seen["ballast"], self.seen["ballast_by_menu"]):
            self.assertEqual([told[key] for key in ("infill_sparse_density", "wall_line_count", "top_layers", "bottom_layers")], [100, 0, 0, 0])
            self.assertAlmostEqual(told["infill_line_distance"], 0.4)
        tips = {name: self.verified(name) for name in ("sparse", "ballast", "ballast_by_menu")}
        print("tip angles by the G-code at 15 % infill:", tips)
        self.assertLess(tips["sparse"], 0)
        for name in ("ballast", "ballast_by_menu"):
            self.assertGreater(tips[name], 7, name)  # of 8 that were asked for of such a profile

    def test_at_little_infill_the_menu_adds_ballast_and_leaves_the_model_as_it_is(self):
        made = self.seen["ballast_by_menu"]
        self.assertTrue(made["kept"] and made["inside"])
        self.assertLess(made["moved"], 1e-3)  # mm: what reaches below the plate does not lift the model
        self.assertIn("stands now", self.seen["ballasted"]["text"])
        self.assertIn("infill of 100 % in one part instead of 15 %", self.seen["ballasted"]["text"].replace("Infill", "infill"))
        self.assertIn("without its ballast it falls over", self.seen["checked_with_ballast"]["text"])
        self.assertTrue(self.seen["ballast_undone"])
        self.assertEqual(self.seen["ballast_redone"], 1)

    def verified(self, name):
        report = self.folder / "verified.json"
        subprocess.run([CLI, "verify", self.out / f"{name}.gcode", "--one", "--density", "1.24", "--diameter", str(FILAMENT_MM),
                        "--report", report, "-q"])
        (one,) = json.loads(report.read_text())["objects"]
        return one["tip_deg"]

    def check(self, name):
        """What the program says of a mesh where it lies on Cura's bed."""
        model, report = self.folder / f"{name}.stl", self.folder / f"{name}.json"
        meshes.write_stl(model, self.plate(name))
        subprocess.run([CLI, "check", model, "--report", report, "-q"])
        return json.loads(report.read_text())["before"]


if __name__ == "__main__":
    sys.exit(unittest.main())
