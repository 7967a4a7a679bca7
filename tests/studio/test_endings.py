#!/usr/bin/env python3
"""Who makes way for whom, what a dead solver leaves behind, and that nothing is left when the server ends."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

import studio
from studio import JSON, QUICK

LONG = {"poses": [{"stand": {"tip_deg": 10}}], "voxel_mm": 0.3}  # of some ten seconds
SLOW = {"fem": True}  # judged by elasticity, too: of some seven seconds
BEND = {"deform": "only", "deform_limit_percent": 50, "poses": [{"stand": {"tip_deg": 30}}]}


def soon(condition, seconds=20):
    """Waits until it is true. \\return whether it was."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True


def is_alive(process):
    """Also while but one of its threads is: until then its files are open."""
    try:
        is_zombie = "\nState:\tZ" in pathlib.Path(f"/proc/{process}/status").read_text()
        return not is_zombie or len(os.listdir(f"/proc/{process}/task")) > 1
    except OSError:
        return False


class Endings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.studio = self.begin_studio()
        self.trex = self.studio.fixture("trex.stl")

    def begin_studio(self, **environment):
        """One in the test's own folder, ended at the latest with the test."""
        begun = studio.Studio(environment={"TMPDIR": str(self.folder), **environment})
        self.addCleanup(begun.process.wait)  # else it may still write while its folder goes
        self.addCleanup(begun.process.kill)
        self.addCleanup(begun.process.stdout.close)
        return begun

    def child(self, words):
        """The server's child whose command line has them, once it is there."""
        found = []
        self.assertTrue(soon(lambda: found.extend(p for p, line in self.studio.children() if words in line) or found), words)
        return found[0]

    def is_placed(self):
        return [m["type"] for m in self.studio.stream("/api/place", model=self.trex, job={}).messages()] == ["placed"]

    def begin(self, path, **fields):
        """A stream that has begun to say something."""
        stream = self.studio.stream(path, model=self.trex, **fields)
        frames = stream.frames()
        return frames, next(frames)

    def begin_run(self):
        frames, (_, first) = self.begin("/api/stand", job=LONG)
        self.assertEqual(first["type"], "progress")
        return frames, self.child("aplomb run")

    def last(self, frames):
        return [message for kind, message in frames if kind == JSON][-1]

    def test_a_killed_solver_is_a_message_and_the_next_try_works(self):
        self.assertTrue(self.is_placed())
        frames, _ = self.begin("/api/validate", job=SLOW, of="model")
        solver = self.child("--solver")
        os.kill(solver, signal.SIGKILL)
        said = self.last(frames)
        self.assertEqual((said["type"], said["code"]), ("error", 7))
        self.assertRegex(said["message"], "^the solver was ended by signal 9 .*; the next try starts another$")
        self.assertTrue(self.is_placed())
        self.assertNotEqual(self.child("--solver"), solver)

    def test_a_solver_that_was_killed_while_it_was_idle_is_not_even_missed(self):
        self.assertTrue(self.is_placed())
        solver = self.child("--solver")
        os.kill(solver, signal.SIGKILL)
        self.assertTrue(soon(lambda: not is_alive(solver)))
        self.assertTrue(self.is_placed())

    def test_a_killed_run_is_a_message_and_the_next_try_works(self):
        frames, run = self.begin_run()
        os.kill(run, signal.SIGKILL)
        said = self.last(frames)
        self.assertEqual((said["type"], said["code"]), ("error", 7))
        self.assertIn("signal 9", said["message"])
        again, _ = self.begin_run()
        self.studio.post("/api/cancel")
        self.assertEqual(self.last(again), {"type": "cancelled"})

    def test_cancel_ends_what_runs(self):
        frames, run = self.begin_run()
        begun = time.monotonic()
        self.assertEqual(self.studio.post("/api/cancel").status, 204)
        self.assertEqual(self.last(frames), {"type": "cancelled"})
        self.assertLess(time.monotonic() - begun, 5)
        self.assertTrue(soon(lambda: not is_alive(run)))
        frames, _ = self.begin("/api/validate", job=SLOW, of="model")
        self.studio.post("/api/cancel")
        self.assertEqual(self.last(frames), {"type": "cancelled"})
        self.assertTrue(self.is_placed())

    def test_what_is_written_may_be_taken_while_its_page_is_drawn_and_after_that_was_cancelled(self):
        def take(what):
            return self.studio.post("/api/take", model=self.trex, job=QUICK, what=what)

        frames = self.studio.stream("/api/stand", model=self.trex, job=QUICK).frames()
        next(frames)
        run = self.child("aplomb run")
        next(message for _, message in frames if message["type"] == "report")
        os.kill(run, signal.SIGSTOP)  # it draws its page
        next(message for kind, message in frames if kind == JSON and message["type"] == "written")
        taken = take("3mf")
        self.assertEqual((taken.status, taken.body[:2]), (200, b"PK"))
        self.assertEqual(take("stl").status, 200)
        self.assertEqual((take("html").status, take("html").json()["code"]), (409, 1))
        self.studio.post("/api/cancel")
        self.assertEqual(self.last(frames), {"type": "cancelled"})
        self.assertEqual(take("3mf").body, taken.body)

    def test_a_page_that_goes_away_takes_its_work_with_it(self):
        stream = self.studio.stream("/api/stand", model=self.trex, job=LONG)
        next(stream.frames())
        run = self.child("aplomb run")
        stream.close()
        self.assertTrue(soon(lambda: not is_alive(run), 10))
        self.assertTrue(self.is_placed())

    def test_one_works_at_a_time_and_the_others_hear_that_they_wait(self):
        frames, run = self.begin_run()
        waiting = self.studio.stream("/api/check", model=self.trex, job={})
        kind_and_length = waiting.take(8)
        self.assertEqual(waiting.take(int.from_bytes(kind_and_length[:4], "little")), b'{"type":"alive"}')
        self.assertTrue(is_alive(run))
        os.kill(run, signal.SIGKILL)
        self.assertEqual(self.last(frames)["type"], "error")
        self.assertEqual(self.last(waiting.frames())["type"], "report")

    def test_a_newer_wish_ends_the_older(self):
        frames, _ = self.begin_run()
        older = self.studio.stream("/api/preview", model=self.trex, job=BEND, wish=1)
        newer = self.studio.stream("/api/preview", model=self.trex, job=BEND, wish=2)
        self.assertEqual(older.messages(), [{"type": "cancelled"}])  # it waited
        run, _ = self.begin_run()  # a newer one, which ends the preview that waits, too
        self.assertEqual(self.last(frames), {"type": "cancelled"})
        self.assertEqual(newer.messages(), [{"type": "cancelled"}])
        self.studio.post("/api/cancel")
        self.assertEqual(self.last(run), {"type": "cancelled"})

    def test_a_newer_preview_ends_one_that_works(self):
        job = {**BEND, "place": {"height_mm": 300}}  # another solid: reading and the cage take their time
        older = self.studio.stream("/api/preview", model=self.trex, job=job, wish=1)
        newer = self.studio.stream("/api/preview", model=self.trex, job=job, wish=2)
        self.assertEqual(older.messages()[-1], {"type": "cancelled"})
        wishes = {message["wish"] for message in newer.messages("preview")}
        self.assertEqual(wishes, {2})

    def end_and_look(self, end):
        self.assertTrue(self.is_placed())
        frames, run = self.begin_run()
        solver = self.child("--solver")
        self.assertEqual(len(list(self.folder.iterdir())), 1)
        end()
        self.assertEqual(self.studio.process.wait(15), 0)
        self.assertEqual([p for p in (run, solver) if not soon(lambda p=p: not is_alive(p), 5)], [])
        self.assertEqual(list(self.folder.iterdir()), [])
        frames.close()

    def test_quit_leaves_nothing(self):
        self.end_and_look(lambda: self.assertEqual(self.studio.post("/api/quit").status, 204))

    def test_signals_leave_nothing(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            if number != signal.SIGTERM:
                self.setUp()
            self.end_and_look(lambda number=number: self.studio.process.send_signal(number))

    def test_a_killed_server_leaves_no_process(self):
        _, run = self.begin_run()
        self.assertTrue(soon(lambda: is_alive(run)))
        self.studio.process.kill()
        self.studio.process.wait()
        self.assertTrue(soon(lambda: not is_alive(run), 5))

    def test_what_a_killed_server_left_goes_when_the_next_begins_and_what_another_holds_stays(self):
        (held,) = self.folder.iterdir()
        killed = self.begin_studio()
        (left,) = set(self.folder.iterdir()) - {held}
        killed.process.kill()
        killed.process.wait()
        self.assertTrue(left.exists())
        with studio.Studio(environment={"TMPDIR": str(self.folder)}):
            self.assertFalse(left.exists())
            self.assertTrue(held.exists())

    def test_it_ends_where_it_is_told_to_before_it_listens(self):
        begun = self.begin_studio(LD_PRELOAD=os.environ["APLOMB_SLOW_BESIDE_THREADS"])
        begun.process.send_signal(signal.SIGINT)
        self.assertEqual(begun.process.wait(20), 0)

    def test_the_command_line_becomes_the_studio(self):
        with subprocess.Popen([studio.CLI, "studio", "--no-browser", "--port", "0"], stdout=subprocess.PIPE, text=True) as process:
            self.assertRegex(process.stdout.readline(), r"http://127\.0\.0\.1:\d+/#[0-9a-f]{64}")
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(10), 0)
        taken = subprocess.run([studio.CLI, "studio", "--no-browser", "--port", str(self.studio.port)], capture_output=True,
                               text=True, check=False, timeout=10)
        self.assertEqual(taken.returncode, 1)
        self.assertEqual(taken.stderr, f"aplomb: port {self.studio.port} is taken; leave --port out\n")


if __name__ == "__main__":
    unittest.main()
