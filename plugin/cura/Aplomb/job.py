"""One click: runs the program on each model, off the main thread."""
import collections
import json
import os
import tempfile

from UM.Job import Job
from UM.Logger import Logger
from UM.Message import Message

from . import command, meshes, verdict
from .program import Program

ANOTHER_POSE = "is part of a group: ungroup it, or merge the parts to one mesh before loading it"
# What came of one model. mesh: its new triangles, or None; ballast: a Ballast, or None; both in the node's own coordinates.
Outcome = collections.namedtuple("Outcome", "state said mesh ballast")
Ballast = collections.namedtuple("Ballast", "triangles infill_percent")


class BalanceJob(Job):
    """After run(): getResult() is a list of Outcomes.

    \\param models  of (ModelState, print profile); of those in a group the state alone counts, with None for a profile.
    """

    def __init__(self, program, models, settings, makes_stand):
        super().__init__()
        self._program = program
        self._models = models
        self._settings = settings
        self._makes_stand = makes_stand
        self._current = None
        self._is_cancelled = False
        self._message = Message("", lifetime=0, dismissable=False, progress=0,
                                title="Making it stand" if makes_stand else "Will it stand?")
        self._message.addAction("cancel", "Cancel", "", "")
        self._message.actionTriggered.connect(self._on_action)

    def cancel(self):
        self._is_cancelled = True
        if self._current:
            self._current.cancel()

    def run(self):
        self._message.show()
        results = []
        try:
            for i, (state, profile) in enumerate(self._models):
                results.append(self._run_one(i, state, profile))
        finally:
            self._message.hide()
        self.setResult(results)

    def _run_one(self, number, state, profile):
        if profile is None:
            return _unchanged(state, verdict.Verdict(verdict.WARNING, "{}: {}.".format(state.name, ANOTHER_POSE)))
        if self._is_cancelled:
            return _unchanged(state, verdict.of_failure(state.name, verdict.CANCELLED, []))
        try:
            with tempfile.TemporaryDirectory(prefix="aplomb") as folder:
                return self._run_in(folder, number, state, profile)
        except (OSError, ValueError) as error:  # the program cannot be started, or the disk is full
            Logger.logException("e", "Aplomb failed")
            return _unchanged(state, verdict.of_failure(state.name, verdict.INTERNAL, [str(error)]))

    def _run_in(self, folder, number, state, profile):
        model, output, report_file, ballast_file = (
            os.path.join(folder, name) for name in ("model.stl", "made.stl", "report.json", "ballast.stl"))
        profile_file = _written_settings(os.path.join(folder, "cura.json"), profile)
        own = state.own_triangles()
        sent = meshes.to_plate(own, state.world)
        meshes.write_stl(model, sent)
        if self._makes_stand:
            arguments = command.stand_arguments(model, output, report_file, self._settings, profile, profile_file, ballast_file)
        else:
            arguments = command.check_arguments(model, report_file, self._settings, profile, profile_file)
        self._current = Program(self._program, arguments, os.environ)
        if self._is_cancelled:
            self._current.cancel()
        code, said = self._current.start(lambda share, stage: self._show(number, state.name, share, stage))
        report = {}
        if os.path.exists(report_file):
            with open(report_file, encoding="utf-8") as file:
                report = json.load(file)
        Logger.log("i", "Aplomb: %s ended with %s: %s", " ".join(arguments), code, " | ".join(said[:3]))
        if not self._makes_stand:
            return _unchanged(state, verdict.of_check(state.name, code, report, said, bool(state.ballast)))
        made = ballast = None
        if code == verdict.STANDS and report.get("outcome") == "stands":
            if report.get("ballast"):
                ballast = Ballast(meshes.from_plate(meshes.read_stl(ballast_file), state.world), report["ballast"]["infill_percent"][1])
            else:
                made = meshes.back_into_node(meshes.read_stl(output), sent, own, state.world)
        is_changed = made is not None or ballast is not None
        spoilt_by = () if ballast else profile.get("spoilt_by", ())
        return Outcome(state, verdict.of_stand(state.name, code, report, said, is_changed, spoilt_by), made, ballast)

    def _show(self, number, name, share, stage):
        self._message.setText("{}: {}".format(name, stage))
        self._message.setProgress(100 * (number + share) / len(self._models))

    def _on_action(self, message, action):
        if action == "cancel":
            self.cancel()


def _unchanged(state, said):
    return Outcome(state, said, None, None)


def _written_settings(path, profile):
    """Cura's settings as a file for the program; None where Cura did not tell them."""
    if not profile.get("settings"):
        return None
    with open(path, "w", encoding="utf-8") as file:
        json.dump(profile["settings"], file)
    return path
