"""The menu, the settings and what becomes of a run."""
import html
import os
import sys

if "PyQt6.QtCore" in sys.modules:  # what Cura itself has loaded; both may be installed, and they do not mix
    from PyQt6.QtCore import QObject, pyqtSlot
else:
    from PyQt5.QtCore import QObject, pyqtSlot

from UM.Application import Application
from UM.Extension import Extension
from UM.Logger import Logger
from UM.Message import Message
from UM.Operations.GroupedOperation import GroupedOperation

from . import ballast, command, scene, settings, verdict
from .job import BalanceJob
from .operation import SetMeshOperation

FOLDER = os.path.dirname(os.path.abspath(__file__))
CHANGED = "{}: changed while it was reckoned with, and left as it is. Try again."


class AplombExtension(QObject, Extension):
    def __init__(self, app):
        QObject.__init__(self)
        Extension.__init__(self)
        self._preferences = app.getPreferences()
        for setting in settings.ALL:
            self._preferences.addPreference("aplomb/" + setting.key, setting.default)
        self._job = None
        self._dialog = None
        self.setMenuName("Aplomb")
        self.addMenuItem("Make it stand", self.make_it_stand)
        self.addMenuItem("Will it stand?", self.will_it_stand)
        self.addMenuItem("Settings\u2026", self.show_settings)

    def make_it_stand(self):
        self._start(True)

    def will_it_stand(self):
        self._start(False)

    def show_settings(self):
        if self._dialog is None:
            path = os.path.join(FOLDER, "SettingsDialog.qml")
            self._dialog = Application.getInstance().createQmlComponent(path, {"manager": self})
        if self._dialog is not None:
            self._dialog.load()
            self._dialog.show()

    @pyqtSlot(str, result="QVariant")
    def value(self, key):
        return self.values()[key]

    @pyqtSlot("QVariantMap")
    def setValues(self, values):
        for key, value in settings.cleaned(values).items():
            self._preferences.setValue("aplomb/" + key, value)

    @pyqtSlot(result="QVariantMap")
    def defaults(self):
        return settings.DEFAULTS

    def values(self):
        return settings.cleaned({key: self._preferences.getValue("aplomb/" + key) for key in settings.DEFAULTS})

    def _start(self, makes_stand):
        program = command.find_program(FOLDER)
        models = scene.chosen_models()
        if self._job is not None:
            self._say(verdict.Verdict(verdict.WARNING, "It is still at work. Cancel that first, or wait."))
        elif program is None:
            self._say(verdict.Verdict(verdict.ERROR, "The program aplomb is neither in this plugin nor on the PATH."))
        elif not models:
            self._say(verdict.Verdict(verdict.WARNING, "There is no model."))
        else:
            asked = [(scene.ModelState(node), None if scene.is_in_group(node) else scene.print_profile(node)) for node in models]
            self._job = BalanceJob(program, asked, self.values(), makes_stand)
            self._job.finished.connect(self._on_finished)
            self._job.start()

    def _on_finished(self, job):
        self._job = None
        if job.hasError():
            Logger.log("e", "Aplomb failed: %s", job.getError())
            self._say(verdict.Verdict(verdict.ERROR, "Aplomb failed: {}".format(job.getError())))
            return
        verdicts, operation = [], GroupedOperation()
        for outcome in job.getResult():
            steps = self._steps(outcome)
            if steps and not outcome.state.is_current():
                verdicts.append(verdict.Verdict(verdict.WARNING, CHANGED.format(outcome.state.name)))
                continue
            for step in steps:
                operation.addOperation(step)
            verdicts.append(outcome.said)
        if operation.getNumChildrenOperations():
            operation.push()
        self._say(verdict.together(verdicts))

    @staticmethod
    def _steps(outcome):
        """Operations that make a model what came of it."""
        node = outcome.state.node
        if outcome.ballast is not None:
            return ballast.adding(node, outcome.ballast.triangles, outcome.ballast.infill_percent)
        if outcome.mesh is not None:
            return ballast.removing(node) + [SetMeshOperation(node, outcome.state.mesh_of(outcome.mesh))]
        return []

    def _say(self, said):
        arguments = {"lifetime": 0, "title": "Aplomb"}
        if hasattr(Message, "MessageType"):  # not before Cura 4.11
            kind = Message.MessageType
            arguments["message_type"] = {verdict.GOOD: kind.POSITIVE, verdict.WARNING: kind.WARNING, verdict.ERROR: kind.ERROR}[said.level]
        Message(html.escape(said.text, quote=False), **arguments).show()
