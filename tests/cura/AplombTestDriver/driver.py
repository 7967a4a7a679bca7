import json
import os
import pathlib
import sys
import time
import traceback

import numpy
from PyQt5.QtCore import QObject, QTimer, QUrl
from PyQt5.QtQuick import QQuickWindow
from UM.Extension import Extension
from UM.Math.Vector import Vector
from UM.PluginRegistry import PluginRegistry
from UM.Scene.Iterator.DepthFirstIterator import DepthFirstIterator
from UM.Scene.SceneNode import SceneNode
from UM.Scene.Selection import Selection

from .engine import hurry
from .waits import after, at_rest

OUT = pathlib.Path(os.environ["APLOMB_DRIVER_OUT"])
MODEL = os.environ["APLOMB_DRIVER_MODEL"]
SECOND_MODEL = os.environ["APLOMB_DRIVER_SECOND_MODEL"]
BALLAST = os.environ["APLOMB_DRIVER_BALLAST"]
PATIENCE_S = 900  # other tests run beside
PICTURED_LAYER = 360
DONE, FAILED = 3, 4  # of UM.Backend.Backend.BackendState
SETTINGS = "Settings\u2026"


class Driver(Extension):
    """Runs story(), a generator that yields what it waits for: a function that says whether it may go on."""

    def __init__(self, app):
        super().__init__()
        self._app = app
        self._seen = {}
        self._story = None
        self._condition = None
        self._since = 0
        self._slicing = 0
        self._timer = QTimer()
        self._timer.setInterval(100)
        self._timer.timeout.connect(self._go_on)
        app.initializationFinished.connect(self._begin)

    def _begin(self):
        self._story = self.story()
        self._timer.start()

    def _go_on(self):
        try:
            if self._condition and not self._condition():
                if time.monotonic() - self._since > PATIENCE_S:
                    raise TimeoutError("waited too long after " + ", ".join(self._seen))
                return
            self._condition = next(self._story)
            self._since = time.monotonic()
        except StopIteration:
            self._end()
        except Exception:
            self._seen["error"] = traceback.format_exc()
            self._end()

    def _end(self):
        self._timer.stop()
        (OUT / "seen.json").write_text(json.dumps(self._seen, indent=1))
        os._exit(0)  # Cura's own farewell takes its time

    def story(self):
        yield lambda: len(self._app.topLevelWindows()) > 0
        plugin = PluginRegistry.getInstance().getPluginObject("Aplomb")
        self._seen["menu"] = plugin.getMenuItemList()
        yield from self.prepare()
        node = self.model()
        original = node.getMeshData()
        self.save_mesh("original", node)

        yield from self.choose("Will it stand?")
        self.see_verdict("checked")
        yield from self.slice("plain")
        yield from self.change_settings(plugin)
        self.read_profiles(plugin, node)
        yield from self.cancel()
        self._seen["kept_after_cancel"] = node.getMeshData() is original

        yield from self.choose("Make it stand")
        self.see_verdict("made")
        made = node.getMeshData()
        self._seen["swapped"] = made is not original
        self.save_mesh("made", node)
        yield from self.choose("Will it stand?")
        self.see_verdict("checked_again")
        yield from self.slice("made")

        stack = self._app.getOperationStack()
        stack.undo()
        self._seen["undone"] = node.getMeshData() is original
        self.save_mesh("undone", node)
        stack.redo()
        self._seen["redone"] = node.getMeshData() is made
        yield from self.change_while_at_work(node)
        yield from self.choose_among_several(node)
        yield from self.make_ballast()
        yield from self.open_ballast()

    def prepare(self):
        self._app.getMachineManager().addMachine("creality_ender3", "T")
        yield lambda: self._app.getGlobalContainerStack() is not None
        stack = self._app.getGlobalContainerStack()
        stack.userChanges.setProperty("layer_height", "value", 0.2)
        extruder = stack.extruderList[0]
        for key, value in (("infill_sparse_density", 100), ("infill_line_distance", 0.4), ("material_diameter", 1.75)):
            extruder.userChanges.setProperty(key, "value", value)
        self._seen["bed_mm"] = [stack.getProperty("machine_width", "value"), stack.getProperty("machine_depth", "value")]
        self._app.readLocalFile(QUrl.fromLocalFile(MODEL), "open_as_model")
        yield lambda: self.model() is not None
        self._app.getWelcomePagesModel().allFinished.emit()
        yield at_rest(self.models)

    def models(self):
        root = self._app.getController().getScene().getRoot()
        return [node for node in DepthFirstIterator(root) if node.callDecoration("isSliceable")]

    def model(self):
        return next(iter(self.models()), None)

    def choose(self, item):
        """A click in the menu; ends when the verdict is shown."""
        for message in self._app.getVisibleMessages()[:]:
            message.hide()
        PluginRegistry.getInstance().getPluginObject("Aplomb").activateMenuItem(item)
        yield lambda: self.verdict() is not None
        yield after(1)

    def verdict(self):
        return next((message for message in self._app.getVisibleMessages() if message.getTitle() == "Aplomb"), None)

    def see_verdict(self, name):
        message = self.verdict()
        self._seen[name] = {"text": message.getText(), "type": int(message.getMessageType())}
        self.picture(self._app.getMainWindow(), name)

    def picture(self, window, name):
        window.grabWindow().save(str(OUT / (name + ".png")))

    def change_settings(self, plugin):
        plugin.activateMenuItem(SETTINGS)
        yield lambda: self.dialog() is not None
        yield after(1)
        dialog = self.dialog()
        self.picture(dialog, "settings")
        dialog.findChild(QObject, "tip").setProperty("text", "8")
        dialog.findChild(QObject, "save").clicked.emit()
        yield lambda: not dialog.isVisible()
        preferences = self._app.getPreferences()
        self._seen["settings"] = {key: preferences.getValue("aplomb/" + key) for key in ("tip_deg", "wall_mm", "aim", "deform")}

    def read_profiles(self, plugin, node):
        """What the plugin reads of Cura's settings, as they are and with some that spoil a void."""
        scene = sys.modules[type(plugin).__module__].scene
        settings = self._app.getGlobalContainerStack().extruderList[0].userChanges
        self._seen["profile"] = scene.print_profile(node)
        for key, value in (("meshfix_union_all_remove_holes", True), ("infill_sparse_density", 33)):
            settings.setProperty(key, "value", value)
        self._seen["profile_spoilt"] = scene.print_profile(node)
        settings.removeInstance("meshfix_union_all_remove_holes")
        settings.setProperty("infill_sparse_density", "value", 100)

    def dialog(self):
        windows = [window for window in self._app.topLevelWindows() if isinstance(window, QQuickWindow)]
        return next((window for window in windows if window.title() == "Aplomb" and window.isVisible()), None)

    def cancel(self):
        """Clicks Cancel in the middle of a run."""
        for message in self._app.getVisibleMessages()[:]:
            message.hide()
        PluginRegistry.getInstance().getPluginObject("Aplomb").activateMenuItem("Make it stand")
        yield lambda: any((message.getProgress() or 0) > 5 for message in self._app.getVisibleMessages())
        progress = next(message for message in self._app.getVisibleMessages() if message.getProgress() is not None)
        self._seen["progress"] = {"title": progress.getTitle(), "text": progress.getText(), "value": progress.getProgress()}
        self.picture(self._app.getMainWindow(), "progress")
        clicked = time.monotonic()
        progress.actionTriggered.emit(progress, "cancel")
        yield lambda: self.verdict() is not None
        self._seen["cancelled"] = {"text": self.verdict().getText(), "seconds": time.monotonic() - clicked}

    def slice(self, name):
        scene = self._app.getController().getScene()
        backend = self._app.getBackend()
        backend.backendStateChange.connect(self.note_state)  # held weakly: no lambda
        self._slicing = 0
        backend.forceSlice()
        yield lambda: hurry() or self._slicing in (DONE, FAILED)
        yield after(1)
        (OUT / (name + ".gcode")).write_text("".join(getattr(scene, "gcode_dict")[0]))
        self._seen["sliced_" + name] = self._slicing == DONE
        if "APLOMB_CURA_PICTURES" in os.environ:
            yield from self.preview(name)

    def preview(self, name):
        """A picture of a layer from above, in the middle of the void."""
        controller = self._app.getController()
        for message in self._app.getVisibleMessages()[:]:
            message.hide()
        controller.setActiveStage("PreviewStage")
        yield after(10)
        controller.getActiveView().setLayer(PICTURED_LAYER)
        controller.setCameraRotation("y", 90)
        yield after(4)
        self.picture(self._app.getMainWindow(), "layers_" + name)
        controller.setCameraRotation("home", 0)
        controller.setActiveStage("PrepareStage")
        yield after(1)

    def note_state(self, state):
        self._slicing = int(state)

    def change_while_at_work(self, node):
        """Turns the model before the answer comes: it was not asked about this pose."""
        stack = self._app.getOperationStack()
        stack.undo()
        original = node.getMeshData()
        for message in self._app.getVisibleMessages()[:]:
            message.hide()
        PluginRegistry.getInstance().getPluginObject("Aplomb").activateMenuItem("Make it stand")
        yield lambda: any((message.getProgress() or 0) > 5 for message in self._app.getVisibleMessages())
        node.scale(Vector(1.1, 1.1, 1.1))
        yield lambda: self.verdict() is not None
        self._seen["changed"] = {"text": self.verdict().getText(), "kept": node.getMeshData() is original}

    def choose_among_several(self, first):
        """A second model: both are asked about, then the selected one, then both as a group."""
        self._app.readLocalFile(QUrl.fromLocalFile(SECOND_MODEL), "open_as_model")
        yield lambda: len(self.models()) == 2
        yield at_rest(self.models)
        second = next(node for node in self.models() if node is not first)
        Selection.clear()
        yield from self.choose("Will it stand?")
        self.see_verdict("of_all")
        Selection.add(second)
        yield from self.choose("Will it stand?")
        self.see_verdict("of_selected")
        Selection.add(first)
        self._app.groupSelected()
        yield from self.choose("Will it stand?")
        self.see_verdict("of_group")

    def clear(self):
        Selection.clear()
        for node in self._app.getController().getScene().getRoot().getChildren()[:]:
            if node.callDecoration("isSliceable") or node.callDecoration("isGroup"):
                node.setParent(None)

    def dense_parts(self):
        return [node for node in self.models() if node.callDecoration("isInfillMesh")]

    def settings_of(self, dense):
        return {key: dense.callDecoration("getStack").getProperty(key, "value") for key in (
            "infill_sparse_density", "wall_line_count", "top_layers", "bottom_layers", "infill_line_distance", "infill_pattern")}

    def make_ballast(self):
        """At little infill "Make it stand" fills one part of the model more densely, and Undo takes that back."""
        self.clear()
        extruder = self._app.getGlobalContainerStack().extruderList[0]
        extruder.userChanges.setProperty("infill_sparse_density", "value", 15)
        extruder.userChanges.removeInstance("infill_line_distance")
        self._app.readLocalFile(QUrl.fromLocalFile(MODEL), "open_as_model")
        yield lambda: self.model() is not None
        yield at_rest(self.models)
        node = self.model()
        original, place = node.getMeshData(), node.getWorldPosition()
        yield from self.choose("Make it stand")
        self.see_verdict("ballasted")
        yield at_rest(self.models)
        (dense,) = self.dense_parts()
        self._seen["ballast_by_menu"] = dict(self.settings_of(dense), kept=node.getMeshData() is original, inside=dense.getParent() is node,
                                             moved=(node.getWorldPosition() - place).length())
        yield from self.choose("Will it stand?")
        self.see_verdict("checked_with_ballast")
        yield from self.slice("ballast_by_menu")
        self._app.getOperationStack().undo()
        self._seen["ballast_undone"] = not self.dense_parts()
        yield from self.slice("sparse")
        self._app.getOperationStack().redo()
        self._seen["ballast_redone"] = len(self.dense_parts())

    def open_ballast(self):
        """Opens a model with its infill mesh, at little infill."""
        self.clear()
        self._app.readLocalFile(QUrl.fromLocalFile(BALLAST), "open_as_model")
        yield self.dense_parts
        yield at_rest(self.models)
        (dense,) = self.dense_parts()
        group = dense.getParent()  # Cura lays a 3MF where it says on the bed, not in its middle
        centre = group.getBoundingBox().center
        group.translate(Vector(-centre.x, 0, -centre.z), SceneNode.TransformSpace.World)
        yield at_rest(self.models)
        self._seen["ballast"] = self.settings_of(dense)
        yield from self.slice("ballast")

    def save_mesh(self, name, node):
        mesh = node.getMeshData()
        vertices = numpy.asarray(mesh.getVertices())
        if mesh.hasIndices():
            vertices = vertices[mesh.getIndices().reshape(-1)]
        numpy.save(OUT / (name + ".own.npy"), vertices.reshape(-1, 3, 3))
        moved = mesh.getTransformed(node.getWorldTransformation())
        vertices = numpy.asarray(moved.getVertices())
        if moved.hasIndices():
            vertices = vertices[moved.getIndices().reshape(-1)]
        numpy.save(OUT / (name + ".world.npy"), vertices.reshape(-1, 3, 3))
