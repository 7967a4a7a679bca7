#!/usr/bin/env python3
"""What the page asks and what it gets, and that the command line says and makes the same."""
import json
import math
import pathlib
import struct
import subprocess
import tempfile
import unittest

import studio
from studio import JSON, MESH, POSITIONS, QUICK


PROFILE = "perimeters = 2\nfill_density = 15%\nlayer_height = 0.2\nfirst_layer_height = 0.2\nfilament_density = 1.3\n"


def run(*arguments, folder=None):
    """(exit code, what it said) of the command line."""
    done = subprocess.run([studio.CLI, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stderr.strip().splitlines()


def stl(triangles):
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(struct.pack("<12fH", 0, 0, 0, *sum(t, ()), 0) for t in triangles)


class Protocol(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.studio = studio.Studio()

    @classmethod
    def tearDownClass(cls):
        cls.studio.__exit__()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.trex = self.studio.fixture("trex.stl")

    def only(self, kind, path, **fields):
        return next(message for message in self.studio.stream(path, **fields).messages() if message["type"] == kind)

    def test_start_says_what_there_is(self):
        start = self.studio.request("GET", "/api/start").json()
        self.assertIsNone(start["model"])
        self.assertIsNone(start["job"])
        self.assertIn({"name": "trex.stl"}, start["fixtures"])
        self.assertIn({"name": "sla", "wall_mm": 2.0}, start["processes"])
        self.assertIn("pla", start["materials"])
        self.assertEqual(start["limits"]["upload_bytes"], 512 << 20)

    def test_a_placed_model_comes_as_a_mesh_with_its_way_from_the_file(self):
        job = {"place": {"up": "y", "rotate_deg": [0, 0, 30], "height_mm": 50}}
        frames = list(self.studio.stream("/api/place", model=self.trex, job=job).frames())
        self.assertEqual([kind for kind, _ in frames], [JSON, MESH])
        placed, mesh = frames[0][1], frames[1][1]
        self.assertEqual(mesh.name, "model")
        self.assertEqual(len(mesh.triangles), placed["triangles"])
        self.assertLess(max(max(t) for t in mesh.triangles), len(mesh.vertices))
        for axis in range(3):
            self.assertAlmostEqual(min(v[axis] for v in mesh.vertices), placed["box_mm"][0][axis], 4)
            self.assertAlmostEqual(max(v[axis] for v in mesh.vertices), placed["box_mm"][1][axis], 4)
        self.assertAlmostEqual(placed["box_mm"][1][2], 50, 3)
        (_, _), (_, as_it_came) = self.studio.stream("/api/place", model=self.trex, job={}).frames()
        rows = [placed["from_file"][4 * row:4 * row + 4] for row in range(3)]
        for before, after in list(zip(as_it_came.vertices, mesh.vertices))[::997]:
            for axis, row in enumerate(rows):
                self.assertAlmostEqual(sum(a * b for a, b in zip(row, (*before, 1))), after[axis], 3)

    def test_an_upload_is_what_was_sent(self):
        sent = self.studio.upload(studio.FIXTURES / "duck.stl")
        told = [self.studio.stream("/api/check", model=model, job={}).messages("report")[0]
                for model in (sent, self.studio.fixture("duck.stl"))]
        for report in told:
            report["report"].pop("seconds")
        self.assertEqual(told[0], told[1])

    def test_check_says_what_the_command_line_says(self):
        told = self.only("report", "/api/check", model=self.trex, job={"poses": [{"stand": {"tip_deg": 5}}]})
        report = self.folder / "report.json"
        code, _ = run("check", str(studio.FIXTURES / "trex.stl"), "--tip", "5deg", "--report", str(report))
        expected = json.loads(report.read_text())
        self.assertEqual(code, 3)
        for part in ("outcome", "before", "poses", "required_tip_deg", "mesh"):
            self.assertEqual(told["report"][part], expected[part])
        self.assertEqual(told["message"], "Falls: tips over to the +x side, -2.2 degrees (5.0 asked)")

    def test_validate_says_what_the_command_line_says(self):
        said = self.studio.stream("/api/validate", model=self.trex, job={"process": "sla", "waive": ["stand.nominal"]}, of="model")
        messages = said.messages()
        self.assertGreater(sum(m["type"] == "progress" for m in messages), 0)
        report = self.folder / "judgement.json"
        run("validate", str(studio.FIXTURES / "trex.stl"), "--process", "sla", "--waive", "stand.nominal", "--report", str(report))
        self.assertEqual(messages[-1], {"type": "judgement", "judgement": json.loads(report.read_text())})

    def test_unusable_files_end_in_the_sentence_of_the_command_line(self):
        wall = [((0, 0, 0), (9, 0, 0), (0, 9, 0)), ((9, 0, 0), (9, 9, 0), (0, 9, 0))]
        bad = {"empty.stl": b"", "words.stl": b"no mesh at all", "short.stl": (studio.FIXTURES / "duck.stl").read_bytes()[:5000],
               "open.stl": stl(wall), "broken.3mf": b"PK\3\4" + bytes(100), "two.stl": (studio.FIXTURES / "odd_two_bodies.stl").read_bytes()}
        for name, data in bad.items():
            path = self.folder / name
            path.write_bytes(data)
            code, lines = run("check", name, folder=self.folder)
            self.assertEqual(code, 2, (name, lines))
            for errand in ("place", "check", "stand"):
                error = self.studio.stream(f"/api/{errand}", model=self.studio.upload(path), job={}).messages()[-1]
                self.assertEqual((error["type"], error["code"], "aplomb: " + error["message"]), ("error", code, lines[-1]), (name, errand))

    def test_wrong_jobs_end_in_the_sentence_of_the_command_line(self):
        for wrong in ({"wall_mm": -1}, {"walls_mm": 1}, {"poses": []}, {"handles": [{"at_mm": [0, 0, 0], "scale": 9}], "deform": "auto"},
                      {"max_triangles": 1000}, {"ballast": "only"}):
            job = self.folder / "job.json"
            job.write_text(json.dumps({"aplomb_job": 1, "model": str(studio.FIXTURES / "trex.stl"), "output": "out.3mf", **wrong}))
            code, lines = run("run", "job.json", folder=self.folder)
            for errand in ("check", "stand"):
                error = self.studio.stream(f"/api/{errand}", model=self.trex, job=wrong).messages()[-1]
                self.assertEqual(error["type"], "error", (wrong, error))
                self.assertEqual(error["code"], code)
                expected = lines[-1].removeprefix("aplomb: ").removeprefix("job.json: ")
                self.assertIn(error["message"], (expected, expected.replace(str(studio.FIXTURES) + "/", "")))

    def test_requests_that_make_no_sense_are_refused(self):
        for body in (b"", b"no json", b"[]", b'{"job": 3}', b"[" * 200_000, b'{"model": %d, "job": {"output": "/a.3mf"}}' % self.trex,
                     b'{"model": %d, "job": {"report": "-"}}' % self.trex, b'{"job": ' + b'{"a":' * 5000 + b"1" + b"}" * 5001):
            answer = self.studio.request("POST", "/api/check", body)
            self.assertEqual((answer.status, answer.json()["code"]), (400, 1), body[:40])
        self.assertEqual(self.studio.post("/api/check", model=9999, job={}).status, 409)
        self.assertEqual(self.studio.post("/api/fixture", name="../README.md").status, 404)
        self.assertEqual(self.studio.request("GET", "/api/no_such").status, 404)

    def test_a_preview_bends_towards_its_handle_and_settles(self):
        (_, placed), (_, mesh) = self.studio.stream("/api/place", model=self.trex, job={}).frames()
        top = max(mesh.vertices, key=lambda v: v[2])
        target = [top[0] - 4, top[1], top[2]]
        job = {"deform": "only", "poses": [{"name": "feet", "stand": {"tip_deg": 1}}],
               "handles": [{"at_mm": list(top), "radius_mm": 6, "to_mm": target}]}
        frames = list(self.studio.stream("/api/preview", model=self.trex, job=job, wish=7).frames())
        self.assertEqual([kind for kind, _ in frames], [JSON, POSITIONS] * (len(frames) // 2))
        last, positions = frames[-2][1], frames[-1][1]
        self.assertEqual((last["type"], last["wish"], last["settled"]), ("preview", 7, True))
        self.assertEqual([message["settled"] for _, message in frames[:-2:2]], [False] * (len(frames) // 2 - 1))
        self.assertEqual(len(positions), len(mesh.vertices))
        moved = [math.dist(a, b) for a, b in zip(mesh.vertices, positions)]
        self.assertAlmostEqual(max(moved), last["max_mm"], 3)
        self.assertAlmostEqual(sum(moved) / len(moved), last["mean_mm"], 3)
        self.assertEqual(max(d for d, v in zip(moved, mesh.vertices) if v[2] <= 0.1), 0)
        self.assertLess(math.dist(positions[mesh.vertices.index(top)], target), 1 + last["handle_short_mm"])
        self.assertEqual((last["poses"][0]["name"], last["poses"][0]["carved_deg"]), ("feet", None))
        bent, solid = last["poses"][0], self.only("report", "/api/check", model=self.trex, job={**job, "handles": []})["report"]["poses"][0]
        self.assertEqual(bent["before"].keys(), solid["before"].keys())  # as in a report
        self.assertGreater(bent["before"]["tip_deg"], solid["before"]["tip_deg"])  # it was pulled back over its feet
        self.assertLess(bent["before"]["com_mm"][0], placed["center_mm"][0])

    def test_a_preview_says_which_way_it_falls_as_it_is_bent(self):
        job = {"poses": [{"stand": {"tip_deg": 1}}], "deform_limit_percent": 20,
               "handles": [{"at_mm": [60, 0, 80], "radius_mm": 9, "to_mm": [20, 60, 80]}]}
        as_it_came = self.only("report", "/api/check", model=self.trex, job={"poses": job["poses"]})["report"]["poses"][0]
        bent = self.studio.stream("/api/preview", model=self.trex, job=job, wish=1).messages()[-1]["poses"][0]
        self.assertGreater(as_it_came["before"]["weak_edge"]["heading"][0], 0.9)
        self.assertGreater(bent["before"]["weak_edge"]["heading"][1], 0.5)

    def test_a_preview_of_several_poses_says_what_each_could_reach(self):
        (_, placed), _ = self.studio.stream("/api/place", model=self.trex, job={}).frames()
        top = [(low + high) / 2 for low, high in zip(*placed["box_mm"])][:2] + [placed["box_mm"][1][2]]
        job = {"poses": [{"stand": {"tip_deg": 1}}, {"hang": {"from_mm": [top], "tilt_deg": 30}}], "deform": "auto",
               "handles": [{"at_mm": [60, 0, 80], "radius_mm": 9, "turn_deg": [0, 20, 0]}]}
        stands, hangs = self.studio.stream("/api/preview", model=self.trex, job=job, wish=1).messages()[-1]["poses"]
        self.assertGreater(stands["carved_deg"], stands["before"]["tip_deg"])
        self.assertGreater(stands["carved_deg"], 0)
        self.assertLess(hangs["carved_deg"], 90)

    def test_a_preview_takes_handles_where_a_run_would_not_bend(self):
        job = {"handles": [{"at_mm": [60, 0, 80], "radius_mm": 9, "turn_deg": [0, 20, 0]}]}
        said = self.studio.stream("/api/preview", model=self.trex, job=job, wish=1).messages()
        self.assertTrue(said[-1]["settled"])
        self.assertGreater(said[-1]["max_mm"], 1)
        self.assertEqual(self.studio.stream("/api/stand", model=self.trex, job=job).messages()[-1]["type"], "error")

    def test_what_stands_here_stands_on_the_command_line_byte_by_byte(self):
        frames = list(self.studio.stream("/api/stand", model=self.trex, job=QUICK).frames())
        kinds = [m["type"] if kind == JSON else m.name for kind, m in frames]
        self.assertEqual([kind for kind in kinds if kind != "progress"][:2], ["report", "outside"])
        self.assertIn("void", kinds[:kinds.index("written")])
        report = frames[kinds.index("report")][1]
        self.assertTrue(report["message"].startswith("Stands now: "), report["message"])
        self.assertEqual(frames[-1][1], {"type": "ended", "code": 0, "message": report["message"]})
        volume = sum(signed_volume(mesh) for kind, mesh in frames if kind == MESH)
        self.assertAlmostEqual(volume / report["report"]["after"]["volume_mm3"], 1, 4)
        taken = {what: self.studio.post("/api/take", model=self.trex, job=QUICK, what=what) for what in ("3mf", "stl", "job", "html")}
        for what, name in (("3mf", "trex-standing.3mf"), ("stl", "trex-standing.stl"), ("job", "trex-job.json"), ("html", "trex-report.html")):
            self.assertEqual(taken[what].status, 200)
            self.assertIn(f'filename="{name}"', taken[what].headers["Content-Disposition"])
            (self.folder / name).write_bytes(taken[what].body)
        (self.folder / "trex.stl").write_bytes((studio.FIXTURES / "trex.stl").read_bytes())
        (self.folder / "trex-standing.3mf").unlink()
        self.assertEqual(run("run", "trex-job.json", folder=self.folder)[0], 0)
        self.assertEqual((self.folder / "trex-standing.3mf").read_bytes(), taken["3mf"].body)
        self.assertEqual(run("run", "trex-job.json", "-o", "trex-standing.stl", folder=self.folder)[0], 0)
        self.assertEqual((self.folder / "trex-standing.stl").read_bytes(), taken["stl"].body)
        self.assertIn(b"<html", taken["html"].body)
        judged = self.studio.stream("/api/validate", model=self.trex, job=QUICK, of="result").messages()[-1]
        run("validate", "trex-standing.stl", "--tip", "2deg", "--report", "judged.json", folder=self.folder)
        self.assertEqual(judged["judgement"], json.loads((self.folder / "judged.json").read_text()))
        other = self.studio.post("/api/take", model=self.trex, job={**QUICK, "wall_mm": 3}, what="3mf")
        self.assertEqual((other.status, other.json()["code"]), (409, 1))

    def test_what_cannot_stand_is_told_and_not_given_out(self):
        model = self.studio.fixture("galloping_horse.stl")
        frames = list(self.studio.stream("/api/stand", model=model, job=QUICK).frames())
        self.assertEqual([kind for kind, _ in frames if kind == MESH], [])
        self.assertNotIn("written", [message["type"] for _, message in frames])
        self.assertEqual((frames[-1][1]["type"], frames[-1][1]["code"]), ("ended", 3))
        self.assertEqual(self.studio.post("/api/take", model=model, job=QUICK, what="3mf").status, 409)
        self.assertEqual(self.studio.post("/api/take", model=model, job=QUICK, what="html").status, 200)

    def test_it_begins_with_a_job_of_the_command_line(self):
        (self.folder / "sliced.ini").write_text(PROFILE)
        (self.folder / "trex.stl").write_bytes((studio.FIXTURES / "trex.stl").read_bytes())
        job = {"aplomb_job": 1, "model": "trex.stl", "profile": "sliced.ini", "report": "told.json", "poses": [{"stand": {"tip_deg": 3}}]}
        (self.folder / "job.json").write_text(json.dumps(job))
        with studio.Studio(str(self.folder / "job.json")) as begun:
            start = begun.request("GET", "/api/start").json()
            self.assertEqual(start["job"], {"poses": job["poses"]})
            self.assertEqual(start["model"]["name"], "trex.stl")
            self.assertEqual(start["profile"]["name"], "sliced.ini")
            asked = {"model": start["model"]["id"], "profile": start["profile"]["id"], "job": start["job"]}
            frames = list(begun.stream("/api/stand", **asked).frames())
            self.assertEqual([m.name for kind, m in frames if kind == MESH], ["outside", "dense"])
            self.assertEqual(begun.post("/api/take", **asked, what="stl").status, 409)

    def test_a_profile_makes_it_what_is_sliced_as_on_the_command_line(self):
        (self.folder / "sliced.ini").write_text(PROFILE)
        (self.folder / "trex.stl").write_bytes((studio.FIXTURES / "trex.stl").read_bytes())
        asked = {"model": self.trex, "profile": self.studio.upload(self.folder / "sliced.ini", "profile"),
                 "job": {"poses": [{"stand": {"tip_deg": 3}}]}}
        told = self.only("report", "/api/check", **asked)
        run("check", "trex.stl", "--tip", "3deg", "--profile", "sliced.ini", "--report", "told.json", folder=self.folder)
        self.assertEqual(told["report"]["poses"], json.loads((self.folder / "told.json").read_text())["poses"])
        self.assertNotEqual(told["report"]["poses"], self.only("report", "/api/check", **{**asked, "profile": 0})["report"]["poses"])
        names = [m.name for kind, m in self.studio.stream("/api/stand", **asked).frames() if kind == MESH]
        self.assertEqual(names, ["outside", "dense"])
        self.assertEqual(self.studio.post("/api/take", **{**asked, "profile": 0}, what="3mf").status, 409)
        (self.folder / "trex-job.json").write_bytes(self.studio.post("/api/take", **asked, what="job").body)
        self.assertEqual(run("run", "trex-job.json", folder=self.folder)[0], 0)
        made = self.studio.post("/api/take", **asked, what="3mf").body
        self.assertEqual((self.folder / "trex-standing.3mf").read_bytes(), made)

    def test_a_profile_that_is_none_is_refused_in_the_sentence_of_the_command_line(self):
        for name, text in {"words.ini": "no settings", "wrong.ini": "fill_density = 700%\nlayer_height = 0.2\n"}.items():
            (self.folder / name).write_text(text)
            code, lines = run("check", str(studio.FIXTURES / "trex.stl"), "--profile", name, folder=self.folder)
            answer = self.studio.request("POST", f"/api/profile?name={name}", text.encode())
            self.assertEqual((answer.status, answer.json()["code"]), (400, code))
            self.assertEqual("aplomb: " + answer.json()["error"], lines[-1])
        self.assertEqual(self.studio.post("/api/check", model=self.trex, profile=99, job={}).status, 409)

    def test_a_profile_of_the_models_name_does_not_take_its_place(self):
        (self.folder / "trex.stl").write_text(PROFILE)
        asked = {"model": self.trex, "profile": self.studio.upload(self.folder / "trex.stl", "profile"), "job": {"ballast": "only"}}
        job = self.studio.post("/api/take", **asked, what="job").json()
        self.assertEqual((job["model"], job["profile"]), ("trex.stl", "trex.stl.profile"))
        self.assertIn("dense", [m.name for kind, m in self.studio.stream("/api/stand", **asked).frames() if kind == MESH])

    def test_a_file_that_is_not_there_ends_it_at_once(self):
        done = subprocess.run([studio.PROGRAM, "--no-browser", "no_such.stl"], capture_output=True, text=True, check=False, timeout=20)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^aplomb: no_such\.stl cannot be read: .*\n$")


def signed_volume(mesh):
    v = mesh.vertices
    return sum(v[a][0] * (v[b][1] * v[c][2] - v[b][2] * v[c][1]) - v[a][1] * (v[b][0] * v[c][2] - v[b][2] * v[c][0])
               + v[a][2] * (v[b][0] * v[c][1] - v[b][1] * v[c][0]) for a, b, c in mesh.triangles) / 6


if __name__ == "__main__":
    unittest.main()
