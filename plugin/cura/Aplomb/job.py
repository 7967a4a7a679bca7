"""One click: runs the program on each model, off the main thread."""
import json
import os
import tempfile

from UM.Job import Job
from UM.Logger import Logger
from UM.Message import Message

from . import command, meshes, verdict
from .program import Program

ANOTHER_POSE = "is part of a group: ungroup it, or merge the parts to one mesh before loading it"


class BalanceJob(Job):
    """After run(): getResult() is a list of (state, verdict, triangles in the node's own coordinates or None).

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
            return state, verdict.Verdict(verdict.WARNING, "{}: {}.".format(state.name, ANOTHER_POSE)), None
        if self._is_cancelled:
            return state, verdict.of_failure(state.name, verdict.CANCELLED, []), None
        try:
            with tempfile.TemporaryDirectory(prefix="aplomb") as folder:
                return self._run_in(folder, number, state, profile)
        except (OSError, ValueError) as error:  # the program cannot be started, or the disk is full
            Logger.logException("e", "Aplomb failed")
            return state, verdict.of_failure(state.name, verdict.INTERNAL, [str(error)]), None

    def _run_in(self, folder, number, state, profile):
        model, output, report_file = (os.path.join(folder, name) for name in ("model.stl", "made.stl", "report.json"))
        own = state.own_triangles()
        sent = meshes.to_plate(own, state.world)
        meshes.write_stl(model, sent)
        if self._makes_stand:
            arguments = command.stand_arguments(model, output, report_file, self._settings, profile)
        else:
            arguments = command.check_arguments(model, report_file, self._settings, profile)
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
            return state, verdict.of_check(state.name, code, report, said), None
        made = None
        if code == verdict.STANDS and report.get("outcome") == "stands":
            made = meshes.back_into_node(meshes.read_stl(output), sent, own, state.world)
        return state, verdict.of_stand(state.name, code, report, said, made is not None, profile.get("spoilt_by", ())), made

    def _show(self, number, name, share, stage):
        self._message.setText("{}: {}".format(name, stage))
        self._message.setProgress(100 * (number + share) / len(self._models))

    def _on_action(self, message, action):
        if action == "cancel":
            self.cancel()
