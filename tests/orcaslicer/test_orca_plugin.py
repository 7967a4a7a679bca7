#!/usr/bin/env python3
"""The OrcaSlicer plugin with a stand-in for its host. The real host was not at hand: see plugin/orcaslicer/README.md."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy
import orca_stand_in as stand_in

CLI = os.environ["APLOMB_CLI"]
FIXTURES = pathlib.Path(os.environ["APLOMB_FIXTURES"])
PLUGIN = pathlib.Path(__file__).resolve().parents[2] / "plugin/orcaslicer/aplomb_orca.py"
SOLID = {"sparse_infill_density": "100%", "layer_height": "0.2", "filament_density": "1.24,1.24"}
MIRRORED = numpy.diag([-1.0, 1, 1, 1])


def figure(name, matrix=None):
    data = (FIXTURES / f"{name}.stl").read_bytes()
    records = numpy.frombuffer(data, numpy.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")]), offset=84)
    vertices, triangles = numpy.unique(records["c"].reshape(-1, 3), axis=0, return_inverse=True)
    return stand_in.Volume(stand_in.Mesh(vertices, triangles.reshape(-1, 3)), matrix=matrix)


def metadata():
    """The PEP 723 block, as Orca reads it."""
    lines = PLUGIN.read_text().splitlines()
    start = lines.index("# /// script")
    block = lines[start + 1:lines.index("# ///", start)]
    assert all(line == "#" or line.startswith("# ") for line in block)
    return tomllib.loads("\n".join(line[2:] for line in block))


class Plugin(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.storage = pathlib.Path(folder.name)

    def run_in(self, capability, objects, settings=SOLID, cancel_at=None, **config):
        """(result, host) of a click on Run."""
        host = stand_in.Host(objects, self.storage, settings, json.dumps({"program": CLI, **config}))
        host.cancel_at = cancel_at
        sys.modules["orca"] = host.module()
        spec = importlib.util.spec_from_file_location("aplomb_orca", PLUGIN)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        host.packages[0]().register_capabilities()
        made = {cls().get_name(): cls() for cls in host.capabilities}
        return made[capability].execute(), host

    def outputs(self):
        return sorted(path.name for path in self.storage.iterdir() if path.suffix != ".json")

    def test_its_header_names_it_and_what_it_needs(self):
        told = metadata()
        self.assertEqual(told["dependencies"], ["numpy"])
        self.assertTrue({"name", "description", "author", "version"} <= set(told["tool"]["orcaslicer"]["plugin"]))

    def test_it_registers_two_capabilities_with_names_of_their_own(self):
        _, host = self.run_in("Will it stand?", [])
        names = [cls().get_name() for cls in host.capabilities]
        self.assertEqual(len(set(names)), 2)
        self.assertFalse(any(";" in name for name in names))

    def test_a_figure_that_falls_is_handed_back_as_a_3mf_that_stands(self):
        trex = stand_in.ModelObject("trex.stl", [figure("trex")])
        _, host = self.run_in("Will it stand?", [trex])
        self.assertEqual(host.messages[0][0], "warning")
        self.assertIn("Falls", host.messages[0][1])
        result, host = self.run_in("Make it stand", [trex])
        self.assertEqual((result.status, host.messages[0][0]), ("Success", "info"))
        self.assertEqual(self.outputs(), ["1_trex_stands.3mf"])
        self.assertIn(str(self.storage / "1_trex_stands.3mf"), host.messages[0][1])
        self.assertEqual(subprocess.run([CLI, "check", self.storage / "1_trex_stands.3mf", "-q", "--tip", "9.9deg"]).returncode, 0)
        self.assertGreater(len(set(host.progress)), 3)

    def test_a_mirrored_instance_is_reckoned_with_as_it_lies(self):
        for instance, volume in ((stand_in.Instance(MIRRORED), None), (stand_in.Instance(), MIRRORED), (stand_in.Instance(MIRRORED), MIRRORED)):
            _, host = self.run_in("Will it stand?", [stand_in.ModelObject("trex", [figure("trex", volume)], instance)])
            side = "-x" if numpy.linalg.det(instance.matrix() @ (numpy.eye(4) if volume is None else volume)) < 0 else "+x"
            self.assertIn(f"to the {side} side", host.messages[0][1])

    def test_modifiers_are_left_out_and_negative_parts_refused(self):
        modifier, negative = figure("bust"), figure("bust")
        modifier._kind, negative._kind = "ParameterModifier", "NegativeVolume"
        _, alone = self.run_in("Will it stand?", [stand_in.ModelObject("trex", [figure("trex")])])
        _, host = self.run_in("Will it stand?", [stand_in.ModelObject("trex", [figure("trex"), modifier])])
        self.assertEqual(host.messages, alone.messages)
        result, host = self.run_in("Make it stand", [stand_in.ModelObject("trex", [figure("trex"), negative])])
        self.assertEqual((result.status, host.messages[0][0]), ("RecoverableError", "error"))
        self.assertIn("negative part", host.messages[0][1])

    def test_what_orca_is_set_to_counts_and_the_objects_own_setting_first(self):
        thin = {**SOLID, "sparse_infill_density": "20%"}
        _, host = self.run_in("Make it stand", [stand_in.ModelObject("trex", [figure("trex")])], thin)
        self.assertIn("more infill", host.messages[0][1])
        self.assertEqual(self.outputs(), [])
        own = stand_in.ModelObject("trex", [figure("trex")], config={"sparse_infill_density": "100%"})
        self.assertEqual(self.run_in("Make it stand", [own], thin)[1].messages[0][0], "info")

    def test_cancel_ends_the_run_and_leaves_nothing(self):
        _, host = self.run_in("Make it stand", [stand_in.ModelObject("trex", [figure("trex")])], cancel_at=5)
        self.assertIn("cancelled", host.messages[0][1])
        self.assertEqual(self.outputs(), [])

    def test_without_a_program_or_a_model_it_says_so(self):
        path, os.environ["PATH"] = os.environ["PATH"], str(self.storage)
        try:
            result, host = self.run_in("Will it stand?", [stand_in.ModelObject("trex", [figure("trex")])], program="")
        finally:
            os.environ["PATH"] = path
        self.assertEqual(result.status, "RecoverableError")
        self.assertIn("PATH", host.messages[0][1])
        self.assertIn("no model", self.run_in("Will it stand?", [])[1].messages[0][1])

    def test_the_programs_own_words_are_shown_for_what_it_cannot_use(self):
        flat = stand_in.Volume(stand_in.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
        _, host = self.run_in("Make it stand", [stand_in.ModelObject("flat", [flat])])
        self.assertEqual(host.messages[0][0], "error")
        self.assertGreater(len(host.messages[0][1]), len("flat: "))


if __name__ == "__main__":
    sys.exit(unittest.main())
