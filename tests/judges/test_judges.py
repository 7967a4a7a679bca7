"""The judges judged: each passes a right shell and fails a wrong one for the right reason. Answers are closed forms."""
import contextlib
import io
import math
import os
import tempfile
import unittest

import inserts
import judge
import shells
import void_core

TABLE = os.environ["APLOMB_TILT_TABLE"]
RASTER = os.environ["APLOMB_LAYER_RASTER"]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def leaning_box(low, high, lean=0.0):
    """A box whose top is displaced by `lean` along x."""
    vertices = [(x + (lean if z == high[2] else 0), y, z)
                for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
    return shells.Mesh(vertices, [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])


def reversed_mesh(mesh):
    return shells.Mesh(mesh.vertices, [(a, c, b) for a, b, c in mesh.triangles])


def joined(first, second):
    shift = len(first.vertices)
    return shells.Mesh(first.vertices + second.vertices,
                       first.triangles + [tuple(i + shift for i in t) for t in second.triangles])


def box_less_block(low, high, block_low, block_high):
    """A box with a block cut out of its top."""
    vertices = leaning_box(low, high).vertices + leaning_box(block_low, block_high).vertices
    top = (4, 5, 7, 6)
    rim = [(a, b, b + 8, a + 8) for a, b in zip(top, top[1:] + top[:1])]
    block = [tuple(i + 8 for i in reversed(quad)) for quad in QUADS if quad != top]
    quads = [quad for quad in QUADS if quad != top] + rim + block
    return shells.Mesh(vertices, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


CUBE = leaning_box((0, 0, 0), (40, 40, 40))
HOLLOW = joined(CUBE, reversed_mesh(leaning_box((10, 10, 10), (30, 30, 30))))
WITH_ISLAND = joined(CUBE, reversed_mesh(box_less_block((10, 10, 10), (30, 30, 30), (13, 13, 15), (18, 19, 30))))
WRONGLY_WOUND = joined(CUBE, leaning_box((10, 10, 10), (30, 30, 30)))
TORN = shells.Mesh(HOLLOW.vertices, HOLLOW.triangles[:-1])


def wrong(judgement, *arguments):
    """What the judge finds wrong, by name."""
    with contextlib.redirect_stdout(io.StringIO()):
        return judgement(*arguments).wrong


def wrong_in_file(judgement, mesh, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "shell.stl")
        shells.write_stl(path, mesh)
        return wrong(judgement, path, *arguments)


def standing(mesh, up=(0, 0, 1), **after):
    body = shells.body(mesh)
    return {"kind": "standing", "up": up, "after": {"volume_mm3": body.volume, "com_mm": body.centroid, **after}}


class Layers(unittest.TestCase):
    """A void of 20 x 20 x 20 mm, bridged across 20 mm; in one of them a block of 5 x 6 mm hangs from
    the ceiling, whose first layer's far
    corner is 8 mm from the nearest wall."""

    def judgement(self, mesh, span_mm, *islands_mm2):
        checks = [{"id": "void.bridge", "measured": span_mm}]
        return wrong_in_file(judge.layered, mesh, {"checks": checks, "findings": [
            {"id": "void.island", "measured": area} for area in islands_mm2]}, RASTER)

    def test_passes_what_the_layers_show(self):
        self.assertEqual(self.judgement(HOLLOW, 20), [])
        self.assertEqual(self.judgement(WITH_ISLAND, 16, 30), [])

    def test_fails_a_span_that_is_not_there(self):
        self.assertEqual(self.judgement(HOLLOW, 19), ["widest span"])

    def test_fails_an_island_that_was_not_told_of_and_one_that_is_not_there(self):
        self.assertEqual(self.judgement(WITH_ISLAND, 16), ["islands in voids"])
        self.assertEqual(self.judgement(HOLLOW, 20, 30), ["islands in voids"])

    def test_fails_a_void_that_the_slicer_fills(self):
        self.assertIn("volume of the voids", self.judgement(WRONGLY_WOUND, 20))


class Prusaslicer(unittest.TestCase):
    def judgement(self, mesh, com_mm=(20, 20, 20)):
        return wrong_in_file(judge.prusaslicer, mesh, {"poses": [standing(mesh, com_mm=com_mm)]})

    def test_passes_a_void_that_is_wound_inward(self):
        self.assertEqual(self.judgement(HOLLOW), [])

    def test_passes_a_void_that_shifts_the_centre_of_mass(self):
        mesh = joined(CUBE, reversed_mesh(leaning_box((4, 10, 16), (24, 30, 36))))
        self.assertGreater(math.dist(shells.body(mesh).centroid, (20, 20, 20)), 1)
        self.assertEqual(self.judgement(mesh, shells.body(mesh).centroid), [])

    def test_fails_a_centre_of_mass_that_is_not_what_is_printed(self):
        box = leaning_box((10, 10, 10), (20, 20, 20))
        self.assertEqual(self.judgement(box, (15.2, 15, 15)), [])
        for wrong_mm in ((15.4, 15, 15), (15, 14.6, 15), (15, 15, 15.4)):
            self.assertEqual(self.judgement(box, wrong_mm), ["extruded centre of mass"])

    def test_fails_a_void_that_is_wound_outward(self):
        self.assertEqual(self.judgement(WRONGLY_WOUND),
                         ["volume = outer - voids", "extruded volume", "nothing printed in the core"])

    def test_fails_a_void_with_a_missing_triangle(self):
        self.assertIn("manifold", self.judgement(TORN))


class Manifold(unittest.TestCase):
    def test_passes_a_void_that_is_wound_inward(self):
        self.assertEqual(wrong_in_file(judge.manifold, HOLLOW), [])

    def test_fails_a_void_that_is_wound_outward(self):
        self.assertEqual(wrong_in_file(judge.manifold, WRONGLY_WOUND), ["volume = outer - voids"])

    def test_fails_a_void_with_a_missing_triangle(self):
        self.assertIn("status", wrong_in_file(judge.manifold, TORN))


class Tilt(unittest.TestCase):
    """A leaning box's centre of mass stands at (w + lean)/2 of its base: it tips at atan((w - lean) / h)."""

    def judgement(self, mesh, promised_deg, **changes):
        report = {"poses": [standing(mesh, tip_deg=promised_deg, **changes)]}
        return wrong_in_file(judge.poses, mesh, report, TABLE, 0.001)

    def test_passes_the_closed_form_of_a_box(self):
        self.assertEqual(self.judgement(leaning_box((0, 0, 0), (20, 30, 60)), math.degrees(math.atan(20 / 60))), [])

    def test_passes_the_closed_form_of_a_leaning_prism(self):
        prism = leaning_box((0, 0, 5), (20, 30, 65), lean=12)
        self.assertEqual(self.judgement(prism, math.degrees(math.atan((20 - 12) / 60))), [])

    def test_passes_a_prism_that_is_said_to_fall(self):
        prism = leaning_box((0, 0, 0), (20, 30, 60), lean=22)
        self.assertEqual(self.judgement(prism, math.degrees(math.atan((20 - 22) / 60))), [])

    def test_fails_a_promise_that_is_a_degree_off_either_way(self):
        box, angle = leaning_box((0, 0, 0), (20, 30, 60)), math.degrees(math.atan(20 / 60))
        for promised in (angle - 1, angle + 1):
            found = self.judgement(box, promised)
            self.assertIn("tip angle of the report", found)
            self.assertTrue(any(name.startswith("tips at") for name in found))

    def test_fails_a_prism_that_is_said_to_stand_but_falls(self):
        prism = leaning_box((0, 0, 0), (20, 30, 60), lean=24)
        self.assertTrue(any(name.startswith("tips at") for name in self.judgement(prism, 3.0)))

    def test_fails_a_centre_of_mass_that_is_not_the_files(self):
        box, angle = leaning_box((0, 0, 0), (20, 30, 60)), math.degrees(math.atan(20 / 60))
        self.assertEqual(self.judgement(box, angle, com_mm=[10, 15, 30.1]), ["centre of mass of the report"])


    def test_judges_every_pose_by_its_own_way_up(self):
        """A box that is h long tips at atan(w / h) on its end, and at atan(h / w) on its side."""
        box, on_end = leaning_box((0, 0, 0), (20, 30, 60)), math.degrees(math.atan(20 / 60))
        on_side = math.degrees(math.atan(30 / 20))
        for promised, found in ((on_side, []), (on_end, ["tip angle of the report"])):
            report = {"poses": [standing(box, tip_deg=on_end), standing(box, up=(-2, 0, 0), tip_deg=promised)]}
            self.assertEqual(wrong_in_file(judge.poses, box, report, TABLE, 0.001)[:1], found)


class Hang(unittest.TestCase):
    """A box that hangs from a point on its top, d beside the middle, tilts by atan(d / half its height)."""

    TILT_DEG = math.degrees(math.atan(5 / 30))

    def judgement(self, **changes):
        box = leaning_box((0, 0, 0), (20, 30, 60))
        pose = {**standing(box, tilt_deg=changes.pop("tilt_deg", self.TILT_DEG)), "kind": "hanging", "holds": True,
                "attachments_mm": [(15, 15, 60)], "required_tilt_deg": 10, **changes}
        return wrong_in_file(judge.poses, box, {"poses": [pose]}, TABLE, 0.001)

    def test_passes_the_closed_form_of_a_box(self):
        self.assertEqual(self.judgement(), [])

    def test_fails_an_angle_that_is_not_the_files(self):
        for wrong_by in (-0.02, 0.02):
            self.assertEqual(self.judgement(tilt_deg=self.TILT_DEG + wrong_by), ["tilt of the report"])

    def test_fails_another_way_up(self):
        self.assertIn("tilt of the report", self.judgement(up=(0.1, 0, 1)))

    def test_fails_an_angle_that_is_more_than_was_asked_for(self):
        self.assertEqual(self.judgement(required_tilt_deg=9), ["hangs as asked"])


class Measures(unittest.TestCase):
    def test_inertia_of_a_box_is_the_closed_form(self):
        body = shells.body(leaning_box((5, 5, 5), (25, 35, 65)))
        self.assertAlmostEqual(body.volume, 36000)
        self.assertAlmostEqual(body.inertia[0][0], 36000 * (30**2 + 60**2) / 12, delta=1e-3)
        self.assertAlmostEqual(body.inertia[0][1], 0, delta=1e-3)

    def test_core_of_a_box_is_the_box_less_the_margin(self):
        core = void_core.VoidCore([leaning_box((10, 10, 10), (30, 30, 30))], margin=1.0, cell=0.5)
        self.assertAlmostEqual(core.volume() ** (1 / 3), 18, delta=0.51)
        self.assertIn((20, 20, 20), core)
        for near_the_wall in ((10.6, 20, 20), (20, 29.4, 20), (20, 20, 10.6)):
            self.assertNotIn(near_the_wall, core)
        self.assertAlmostEqual(core.share_along((0, 20), (40, 20), 20), 18 / 40, delta=0.02)
        self.assertEqual(core.share_along((0, 20), (40, 20), 5), 0)

    def test_an_island_in_a_void_is_no_void(self):
        island = joined(HOLLOW, leaning_box((15, 15, 15), (25, 25, 25)))
        outer, voids = shells.split_voids(island)
        self.assertEqual((len(outer), len(voids)), (2, 1))
        self.assertAlmostEqual(shells.intended_volume(outer, voids), 64000 - 8000 + 1000)

    def test_what_is_written_is_read_again(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "shell.stl")
            shells.write_stl(path, HOLLOW)
            again = shells.read(path)
        self.assertEqual(len(again.vertices), len(HOLLOW.vertices))
        self.assertAlmostEqual(shells.body(again).volume, 56000)


class Inserts(unittest.TestCase):
    POCKET = {"name": "coin", "at_mm": [5, 5, 4], "diameter_mm": 20.5, "floor_mm": 3.0, "pause_mm": 5.0}
    REPORT = {"inserts": {"pockets": [POCKET]}, "before": {"box_mm": [[-10, -10, 0], [20, 20, 20]]}}

    def wrong_in(self, pause_below, bead_at=None):
        """Square rings round the pocket, a pause before the layers above pause_below, and a bead through its middle."""
        lines, is_paused = ["M83\n"], False
        for layer in range(1, 61):
            z = 0.2 * layer
            if pause_below is not None and not is_paused and z > pause_below + 1e-6:
                lines.append("M601\n")
                is_paused = True
            lines.append(f"G1 X188 Y188 Z{z:.3f}\n")
            lines += [f"G1 X{x} Y{y} E0.5\n" for x, y in ((212, 188), (212, 212), (188, 212), (188, 188))] * 4
            if bead_at is not None and abs(z - bead_at) < 1e-6:
                lines.append("G1 X212 Y212 E0.5\n")
        with tempfile.NamedTemporaryFile("w", suffix=".gcode") as program:
            program.writelines(lines)
            program.flush()
            return inserts.judge(program.name, self.REPORT, 0.2)

    def test_passes_a_pause_over_an_empty_pocket(self):
        self.assertEqual(self.wrong_in(5.0), [])
        self.assertEqual(self.wrong_in(5.0, bead_at=5.2), [])
        self.assertEqual(self.wrong_in(5.0, bead_at=3.0), [])

    def test_fails_a_pause_that_is_missing_early_or_late(self):
        self.assertEqual(self.wrong_in(None), ["pauses", "beads on the wrong side of a pause"])
        for pause_below in (4.8, 5.2):
            self.assertEqual(self.wrong_in(pause_below), ["beads on the wrong side of a pause"])

    def test_fails_a_bead_where_the_insert_will_be(self):
        for z in (3.2, 5.0):
            self.assertEqual(self.wrong_in(5.0, bead_at=z), ["beads within an insert"])


if __name__ == "__main__":
    unittest.main()
