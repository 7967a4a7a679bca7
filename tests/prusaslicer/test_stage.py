"""aplomb-slice: its reading of a command line, and the real PrusaSlicer behind it."""
import os
import pathlib
import shutil
import stat
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plugin/prusaslicer"))

from aplomb_slice.command_line import UsageError, is_for_us, request_of  # noqa: E402
from aplomb_slice.settings import forced_keys  # noqa: E402

STAGE = ROOT / "plugin/prusaslicer/aplomb-slice"
FIXTURES = pathlib.Path(os.environ["APLOMB_FIXTURES"])
SOLID = ["-g", "--fill-density", "100%", "--fill-pattern", "rectilinear", "--filament-density", "1.24", "--layer-height", "0.3"]

MODEL = """<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>{}
<object id="9" type="model"><components>{}</components></object></resources><build><item objectid="9"/></build></model>"""
PACKAGE = {
    "[Content_Types].xml": """<?xml version="1.0"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>""",
    "_rels/.rels": """<?xml version="1.0"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r"
Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/3dmodel.model"/></Relationships>""",
}


def triangles_of(stl):
    """Of a binary STL: three corners each."""
    data = pathlib.Path(stl).read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    numbers = (struct.unpack_from("<9f", data, 96 + 50 * i) for i in range(count))
    return [(corners[:3], corners[3:6], corners[6:]) for corners in numbers]


def write_parts(path, *parts):
    """A 3MF of one object with several parts, each of triangles."""
    objects, components = "", ""
    for number, triangles in enumerate(parts, 1):
        at = {}
        corners = [[at.setdefault(corner, len(at)) for corner in triangle] for triangle in triangles]
        vertices = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*corner) for corner in at)
        faces = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*three) for three in corners)
        objects += f'<object id="{number}" type="model"><mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh></object>'
        components += f'<component objectid="{number}"/>'
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in {**PACKAGE, "3D/3dmodel.model": MODEL.format(objects, components)}.items():
            package.writestr(name, text)


class CommandLine(unittest.TestCase):
    def test_models_are_told_from_the_values_of_keys(self):
        request = request_of(["-g", "--load", "odd.stl", "--fill-pattern", "grid", "a.STL", "--output=out.gcode", "b.3mf", "-m"])
        self.assertEqual([str(model) for model in request.models], ["a.STL", "b.3mf"])
        self.assertEqual(request.keys, ["--load", "odd.stl", "--fill-pattern", "grid", "-m"])
        self.assertEqual(str(request.output), "out.gcode")
        self.assertTrue(request.merges)

    def test_what_is_ours_goes_to_stand_and_its_angle_to_verify(self):
        request = request_of(["-g", "a.stl", "--aplomb", "--tip 5deg --wall '2 mm'"])
        self.assertEqual(request.stand, ["--wall", "2 mm"])
        self.assertEqual((request.tip_deg, request_of(["-g", "a.stl"]).tip_deg), (5, 10))
        self.assertAlmostEqual(request_of(["-g", "a.stl", "--aplomb", "--tip=0.1rad"]).tip_deg, 5.72957795)
        for words in ("--tip", "--tip much"):
            with self.assertRaises(UsageError):
                request_of(["-g", "a.stl", "--aplomb", words])

    def test_only_g_code_is_staged(self):
        self.assertTrue(is_for_us(["--export-gcode", "a.stl"]))
        for words in (["--info", "a.stl"], ["--help"], ["-g", "--export-stl", "a.stl"], ["a.stl"]):
            self.assertFalse(is_for_us(words))

    def test_what_would_turn_or_scale_a_carved_model_is_refused(self):
        for words in (["--rotate-x", "90"], ["--scale=2"], ["--scale-to-fit", "9,9,9"], ["--cut", "3"], ["--split"]):
            with self.assertRaises(UsageError):
                request_of(["-g", "a.stl", *words])
        self.assertEqual(request_of(["-g", "a.stl", "--scale", "100%", "--rotate", "30"]).keys, ["--rotate", "30"])
        for words in (["-g"], ["-g", "a.stl", "--output"]):
            with self.assertRaises(UsageError):
                request_of(words)

    def test_settings_that_undo_a_void_are_forced_and_said(self):
        words, why = forced_keys({"slicing_mode": "close_holes", "support_material": "1", "gcode_label_objects": "1"})
        self.assertEqual(words, ["--slicing-mode", "regular", "--support-material-buildplate-only"])
        self.assertEqual(len(why), 2)
        safe = {"slicing_mode": "regular", "support_material": "0", "gcode_label_objects": "1"}
        self.assertEqual(forced_keys(safe), ([], []))


class Slicing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def stage(self, *words, **environment):
        ended = subprocess.run([STAGE, *SOLID, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                               env={**os.environ, **environment})
        return ended.returncode, ended.stderr

    def verify(self, gcode, tip):
        return subprocess.run([os.environ["APLOMB"], "verify", str(gcode), "--tip", tip, "-q"]).returncode

    def test_a_figure_that_topples_as_sliced_stands_after_the_stage(self):
        plain, staged = self.folder / "plain.gcode", self.folder / "staged.gcode"
        subprocess.run(["prusa-slicer", *SOLID, "-o", plain, FIXTURES / "trex.stl"], check=True, capture_output=True)
        self.assertEqual(self.verify(plain, "0deg"), 3)
        code, said = self.stage("--slicing-mode", "close_holes", "--aplomb", "--tip 8deg", "-o", staged, FIXTURES / "trex.stl")
        self.assertEqual(code, 0, said)
        self.assertIn("slicing_mode = close_holes", said)
        self.assertEqual(self.verify(staged, "8deg"), 0)

    def test_at_little_infill_it_stands_by_denser_infill_on_one_side(self):
        output, sparse = self.folder / "out.gcode", ["--fill-density", "15%", "--fill-pattern", "gyroid"]
        code, said = self.stage(*sparse, "--aplomb", "--tip 8deg", "-o", output, FIXTURES / "trex.stl")
        self.assertEqual(code, 0, said)
        self.assertIn("balanced by infill", said)
        self.assertEqual(self.verify(output, "8deg"), 0)

    def test_what_cannot_stand_is_not_sliced_and_what_was_there_stays(self):
        output = self.folder / "old.gcode"
        output.write_text("; old\n")
        code, said = self.stage("--aplomb", "--tip 60deg", "-o", output, FIXTURES / "trex.stl")
        self.assertEqual(code, 3)
        self.assertIn("was not sliced", said)
        self.assertEqual(output.read_text(), "; old\n")
        self.assertEqual([file.name for file in self.folder.iterdir()], ["old.gcode"])

    def test_a_slicer_that_fills_the_void_is_caught_by_its_g_code(self):
        filling = self.folder / "filling-slicer"
        filling.write_text(f'#!/bin/sh\nexec {shutil.which("prusa-slicer")} "$@" --slicing-mode close_holes\n')
        filling.chmod(filling.stat().st_mode | stat.S_IXUSR)
        output = self.folder / "out.gcode"
        code, said = self.stage("--aplomb", "--tip 8deg", "-o", output, FIXTURES / "trex.stl", PRUSA_SLICER=str(filling))
        self.assertEqual(code, 3, said)
        self.assertIn("was not given out", said)
        self.assertFalse(output.exists())

    def test_models_with_wrong_triangles_are_mended_before_they_are_sliced(self):
        for name in ("broken_flipped", "broken_holes"):
            with self.subTest(name):
                output = self.folder / f"{name}.gcode"
                code, said = self.stage("--aplomb", "--tip 1deg", "-o", output, FIXTURES / f"{name}.stl")
                self.assertEqual(code, 0, said)
                self.assertEqual(self.verify(output, "1deg"), 0)

    def test_a_void_that_came_as_a_second_part_is_named_and_another_is_made(self):
        """PrusaSlicer prints it solid: outer and inner surface as two ModelParts."""
        shell, parts, output = (self.folder / name for name in ("shell.stl", "parts.3mf", "out.gcode"))
        subprocess.run([os.environ["APLOMB"], "stand", FIXTURES / "trex.stl", "-o", shell, "--tip", "8deg", "-q"], check=True)
        triangles, outer = triangles_of(shell), len(triangles_of(FIXTURES / "trex.stl"))
        write_parts(parts, triangles[:outer], [triangle[::-1] for triangle in triangles[outer:]])
        code, said = self.stage("--aplomb", "--tip 8deg", "-o", output, parts)
        self.assertEqual(code, 0, said)
        self.assertIn("if it was meant as a void, reverse its winding", said)
        self.assertEqual(self.verify(output, "8deg"), 0)

    def test_each_object_of_a_plate_is_held_against_its_own_promise(self):
        output = self.folder / "plate.gcode"
        code, said = self.stage("-m", "-o", output, FIXTURES / "knight.stl", FIXTURES / "tumbler.stl")
        self.assertEqual(code, 0, said)
        self.assertEqual(said.count("against report"), 2)
        self.assertTrue(output.exists())

    def test_a_missing_model_and_other_actions_end_as_they_should(self):
        self.assertEqual(self.stage(self.folder / "none.stl")[0], 2)
        info = subprocess.run([STAGE, "--info", FIXTURES / "knight.stl"], capture_output=True, text=True)
        self.assertEqual(info.returncode, 0)
        self.assertIn("volume", info.stdout)


if __name__ == "__main__":
    unittest.main()
