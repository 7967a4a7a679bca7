#!/usr/bin/env python3
"""The parts of the Cura plugin that need no Cura: command lines, meshes, the program's words, verdicts, packages."""
import ast
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import zipfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2] / "plugin" / "cura"
sys.path.insert(0, str(ROOT))
from Aplomb import command, meshes, program, settings, verdict  # noqa: E402  (its __init__ imports nothing of Cura)

CLI = os.environ["APLOMB_CLI"]
FIXTURES = pathlib.Path(os.environ["APLOMB_FIXTURES"])


def matrix(turn, scale=(1, 1, 1), by=(0, 0, 0)):
    """A world matrix: scaled, turned about x, y, z, moved."""
    made = numpy.diag([*scale, 1.0])
    for axis, angle in enumerate(turn):
        c, s, rotation = numpy.cos(angle), numpy.sin(angle), numpy.eye(4)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        rotation[i, i], rotation[i, j], rotation[j, i], rotation[j, j] = c, -s, s, c
        made = rotation @ made
    made[:3, 3] = by
    return made


def volume(triangles):
    a, b, c = numpy.moveaxis(numpy.asarray(triangles, dtype=float), 1, 0)
    return numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6


class Meshes(unittest.TestCase):
    def setUp(self):
        self.trex = meshes.read_stl(FIXTURES / "trex.stl")

    def test_what_is_up_in_cura_is_up_on_the_plate(self):
        one = numpy.array([[[1.0, 2.0, 3.0]] * 3])
        self.assertEqual(meshes.to_plate(one, numpy.eye(4))[0, 0].tolist(), [1, -3, 2])

    def test_the_way_to_the_plate_and_back_keeps_places_and_outside(self):
        for scale in ((1, 1, 1), (2, 0.5, 1.5), (-1, 1, 1), (-1, -1, -1)):
            with self.subTest(scale):
                world = matrix((0.3, -1.1, 2.0), scale, (10, 0, -20))
                sent = meshes.to_plate(self.trex, world)
                self.assertAlmostEqual(volume(sent) / volume(self.trex) / abs(numpy.prod(scale)), 1, places=4)
                self.assertLess(abs(meshes.from_plate(sent, world) - self.trex).max(), 1e-4)

    def test_triangles_that_came_back_as_they_were_sent_are_the_models_own_to_the_last_bit(self):
        for scale in ((1.7, 0.9, 1.1), (-1, 1, 1)):
            with self.subTest(scale):
                world = matrix((0.3, -1.1, 2.0), scale, (10, 0, -20))
                sent = meshes.to_plate(self.trex, world)
                inside = meshes.to_plate(0.5 * self.trex[:100], world)
                back = meshes.back_into_node(numpy.concatenate([sent, inside]), sent, self.trex, world)
                self.assertEqual(back[:len(sent)].tobytes(), self.trex.tobytes())
                self.assertLess(abs(back[len(sent):] - 0.5 * self.trex[:100]).max(), 1e-4)

    def test_an_stl_that_was_written_reads_as_it_was_and_the_program_takes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/model.stl"
            meshes.write_stl(path, self.trex)
            self.assertEqual(meshes.read_stl(path).tobytes(), self.trex.tobytes())
            self.assertEqual(subprocess.run([CLI, "check", path, "-q"]).returncode, 3)
            with open(path, "ab") as file:
                file.write(b"x")
            with self.assertRaises(ValueError):
                meshes.read_stl(path)

    def test_indexed_and_loose_triangles_are_the_same(self):
        vertices, indices = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), numpy.array([[0, 1, 2], [0, 3, 1]])
        self.assertTrue((meshes.triangles_of(vertices, indices) == meshes.triangles_of(vertices[indices.reshape(-1)])).all())


class Command(unittest.TestCase):
    PROFILE = {"infill_percent": 20.0, "layer_mm": 0.12, "density_g_per_cm3": 1.27}

    def test_the_program_knows_every_flag_of_every_setting(self):
        with tempfile.TemporaryDirectory() as folder:
            model = FIXTURES / "tumbler.stl"
            for key, value in (("tip_deg", 5), ("aim", "light"), ("deform", "auto"), ("robust", True), ("from_cura", False), ("wall_mm", 2.4)):
                chosen = settings.cleaned({key: value})
                for arguments in (command.check_arguments(str(model), f"{folder}/r.json", chosen, self.PROFILE),
                                  command.stand_arguments(str(model), f"{folder}/o.stl", f"{folder}/r.json", chosen, self.PROFILE, None, "b.stl")):
                    ended = subprocess.run([CLI, *arguments, "--help"], capture_output=True, text=True)
                    self.assertEqual(ended.returncode, 0, ended.stderr)
                    ended = subprocess.run([CLI, *[a if a != str(model) else f"{folder}/none.stl" for a in arguments]], capture_output=True)
                    self.assertEqual(ended.returncode, 2, ended.stderr)  # the file is missing: not usage, which is 1

    def test_what_cura_is_set_to_is_told_only_if_it_is_asked_for(self):
        told = command.stand_arguments("m", "o", "r", settings.cleaned({}), self.PROFILE)
        self.assertEqual(told[told.index("--infill") + 1], "20%")
        self.assertEqual(told[told.index("--layer") + 1], "0.12mm")
        self.assertEqual(told[told.index("--density") + 1], "1.27")
        untold = command.stand_arguments("m", "o", "r", settings.cleaned({"from_cura": False}), self.PROFILE)
        self.assertFalse({"--infill", "--layer", "--density"} & set(untold))
        self.assertNotIn("--infill", command.stand_arguments("m", "o", "r", settings.cleaned({}), {}))

    def test_all_of_curas_settings_are_told_where_there_are_any_and_where_ballast_may_go(self):
        told = command.stand_arguments("m", "o", "r", settings.cleaned({}), self.PROFILE, "cura.json", "ballast.stl")
        self.assertEqual(told[told.index("--profile") + 1], "cura.json")
        self.assertEqual(told[told.index("--modifier") + 1], "ballast.stl")
        self.assertIn("--profile", command.check_arguments("m", "r", settings.cleaned({}), self.PROFILE, "cura.json"))
        for untold in (command.stand_arguments("m", "o", "r", settings.cleaned({"from_cura": False}), self.PROFILE, "cura.json", "ballast.stl"),
                       command.stand_arguments("m", "o", "r", settings.cleaned({}), {}, None, "ballast.stl")):
            self.assertFalse({"--profile", "--modifier"} & set(untold))

    def test_the_carried_program_comes_before_the_one_on_the_path_and_is_made_to_run(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(command.find_program(folder, which=lambda name: f"/bin/{name}"), "/bin/aplomb")
            self.assertIsNone(command.find_program(folder, which=lambda name: None))
            carried = pathlib.Path(command.carried_program(folder))
            carried.parent.mkdir(parents=True)
            carried.write_bytes(b"")
            carried.chmod(0o600)
            self.assertEqual(command.find_program(folder, which=lambda name: f"/bin/{name}"), str(carried))
            self.assertTrue(os.access(carried, os.X_OK))
        self.assertTrue(command.carried_program("p", "AMD64", "Windows").endswith(os.path.join("AMD64", "Windows", "aplomb.exe")))

    def test_the_program_does_not_see_curas_own_libraries(self):
        seen = command.environment_for("/x/aplomb", {"LD_LIBRARY_PATH": "/cura", "PYTHONHOME": "/cura", "HOME": "/h"})
        self.assertEqual(seen, {"HOME": "/h"})


class Settings(unittest.TestCase):
    def test_whatever_the_preferences_hold_becomes_a_value_in_range(self):
        for key, given, expected in (("tip_deg", "7,5", 7.5), ("tip_deg", "nan", 10.0), ("tip_deg", 1e9, 89.0), ("tip_deg", None, 10.0),
                                     ("wall_mm", "-3", 0.1), ("aim", "best", "least"), ("robust", "True", True), ("robust", False, False)):
            self.assertEqual(settings.cleaned({key: given})[key], expected, (key, given))
        self.assertEqual(settings.cleaned({}), settings.DEFAULTS)


class Running(unittest.TestCase):
    def test_progress_is_told_and_the_rest_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            told = []
            run = program.Program(CLI, ["stand", str(FIXTURES / "odd_void.stl"), "-o", f"{folder}/o.stl", "--progress", "json"], os.environ)
            code, said = run.start(lambda share, stage: told.append((share, stage)))
            self.assertEqual(code, 0)
            self.assertTrue(said[0].startswith("Stands"), said[:1])
            self.assertTrue(told and all(0 <= share <= 1 and stage for share, stage in told), told)

    def test_a_cancelled_run_ends_at_once_and_writes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            run = program.Program(CLI, ["stand", str(FIXTURES / "trex.stl"), "-o", f"{folder}/o.stl", "--progress", "json"], os.environ)
            first = threading.Event()
            threading.Thread(target=lambda: (first.wait(60), run.cancel())).start()
            code, _ = run.start(lambda share, stage: first.set())
            self.assertEqual(code, program.CANCELLED)
            self.assertEqual(os.listdir(folder), [])

    def test_a_run_that_was_cancelled_before_it_began_never_begins(self):
        run = program.Program("/no/such/program", [], {})
        run.cancel()
        self.assertEqual(run.start(None), (program.CANCELLED, []))

    def test_only_lines_of_progress_are_progress(self):
        self.assertEqual(program.progress_of('{"progress": 0.5, "stage": "carve"}'), (0.5, "carve"))
        for line in ("", "Stands now", "{", "{}", '{"progress": "x", "stage": 1}', "[1]"):
            self.assertIsNone(program.progress_of(line))


class Verdicts(unittest.TestCase):
    def report_of(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            ended = subprocess.run([CLI, *arguments, "--report", f"{folder}/r.json", *(["-o", f"{folder}/o.stl"] if arguments[0] == "stand" else [])],
                                   capture_output=True, text=True)
            path = pathlib.Path(folder, "r.json")
            return ended.returncode, json.loads(path.read_text()) if path.exists() else {}, (ended.stdout + ended.stderr).splitlines()

    def test_a_figure_that_falls_is_said_to_with_its_numbers(self):
        code, report, said = self.report_of("check", str(FIXTURES / "trex.stl"))
        told = verdict.of_check("trex", code, report, said)
        self.assertEqual(told.level, verdict.WARNING)
        self.assertIn("falls over", told.text)
        self.assertIn("{:.1f}\u00b0".format(report["before"]["tip_deg"]).replace("-", "\u2212"), told.text)
        self.assertIn("{:.1f} g".format(report["before"]["mass_g"]), told.text)

    def test_what_makes_it_stand_is_said_with_before_and_after(self):
        code, report, said = self.report_of("stand", str(FIXTURES / "trex.stl"))
        told = verdict.of_stand("trex", code, report, said, True)
        self.assertEqual(told.level, verdict.GOOD)
        for number in ("{:.1f}\u00b0".format(report["after"]["tip_deg"]), "\u2212{:.1f}\u00b0 before".format(-report["before"]["tip_deg"]),
                       "{:.1f} cm\u00b3".format(report["carving"]["void_mm3"] / 1000), "{:.2f} mm".format(report["wall_mm"]["measured"])):
            self.assertIn(number, told.text)

    def test_ballast_is_said_with_its_densities_and_what_was_checked_without_it(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "cura.json").write_text(json.dumps(dict(layer_height=0.2, line_width=0.4, wall_line_count=2, top_layers=4,
                                                                         bottom_layers=4, infill_sparse_density=15, material_density=1.24)))
            profile = ["--profile", f"{folder}/cura.json"]
            code, report, said = self.report_of("stand", str(FIXTURES / "trex.stl"), "--tip", "8deg", "--modifier", f"{folder}/b.stl", *profile)
            told = verdict.of_stand("trex", code, report, said, True)
            self.assertEqual(told.level, verdict.GOOD)
            self.assertIn("Infill of 100 % in one part instead of 15 %, {:.1f} g more".format(report["ballast"]["added_g"]), told.text)
            self.assertGreater(len(meshes.read_stl(f"{folder}/b.stl")), 0)
            code, report, said = self.report_of("check", str(FIXTURES / "trex.stl"), *profile)
            self.assertIn("without its ballast it falls over", verdict.of_check("trex", code, report, said, True).text)

    def test_settings_that_would_fill_the_void_are_named(self):
        cura = {"meshfix_union_all_remove_holes": False, "support_type": "everywhere", "support_enable": False}
        self.assertEqual(verdict.spoilers(cura.get), [])
        cura.update(support_enable=True, meshfix_union_all_remove_holes=True)
        spoilt = verdict.spoilers(cura.get)
        self.assertEqual(len(spoilt), 2)
        report = {"required_tip_deg": 10.0, "before": {"tip_deg": -1.0, "mass_g": 2.0, "com_height_mm": 3.0}}
        told = verdict.of_stand("trex", verdict.STANDS, report, [], True, spoilt)
        self.assertEqual(told.level, verdict.WARNING)
        self.assertTrue(all(text in told.text for text in spoilt))
        self.assertEqual(verdict.of_stand("trex", verdict.STANDS, report, [], False, spoilt).level, verdict.GOOD)  # no void

    def test_what_cannot_stand_or_would_not_print_is_left_and_said_why(self):
        code, report, said = self.report_of("stand", str(FIXTURES / "rearing_horse.stl"))
        self.assertEqual(code, verdict.CANNOT_STAND)
        self.assertIn("Left as it was", verdict.of_stand("horse", code, report, said, False).text)
        code, report, said = self.report_of("stand", str(FIXTURES / "trex.stl"), "--infill", "20%")
        self.assertEqual(code, verdict.DOES_NOT_PRINT)
        self.assertIn("more infill", verdict.of_stand("trex", code, report, said, False).text)

    def test_errors_are_said_in_the_programs_own_words(self):
        code, report, said = self.report_of("check", str(FIXTURES / "none.stl"))
        told = verdict.of_check("none", code, report, said)
        self.assertEqual(told.level, verdict.ERROR)
        self.assertIn("none.stl", told.text)
        self.assertEqual(verdict.of_failure("x", -11, []).level, verdict.ERROR)
        self.assertEqual(verdict.together([verdict.Verdict(verdict.GOOD, "a"), told]).level, verdict.ERROR)


class Package(unittest.TestCase):
    def test_it_holds_the_plugin_and_the_program_with_its_libraries_and_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            package = f"{folder}/Aplomb.curapackage"
            subprocess.run([ROOT / "build_package", "--program", CLI, "-o", package], check=True)
            with zipfile.ZipFile(package) as archive:
                info = json.loads(archive.read("package.json"))
                archive.extractall(folder)
            self.assertEqual((info["package_id"], info["package_type"]), ("Aplomb", "plugin"))
            plugin = pathlib.Path(folder, "files/plugins/Aplomb")
            self.assertEqual(json.loads((plugin / "plugin.json").read_text())["version"], info["package_version"])
            carried = command.find_program(str(plugin), which=lambda name: None)
            libraries = {path.name for path in pathlib.Path(carried).parent.joinpath("lib").iterdir()}
            self.assertTrue(any(name.startswith("libopenvdb") for name in libraries), libraries)
            self.assertFalse(any(name.startswith(("libc.", "ld-linux")) for name in libraries), libraries)
            told = subprocess.run([carried, "--version"], env=command.environment_for(carried, {}), capture_output=True, text=True)
            self.assertRegex(told.stdout, r"aplomb \d")

    def test_its_python_is_that_of_the_oldest_cura(self):
        for path in (ROOT / "Aplomb").glob("*.py"):
            tree = ast.parse(path.read_text(), path.name, feature_version=(3, 5))
            new = [node for node in ast.walk(tree) if isinstance(node, (ast.JoinedStr, ast.AnnAssign, ast.NamedExpr))]
            self.assertEqual(new, [], path.name)


if __name__ == "__main__":
    sys.exit(unittest.main())
