#!/usr/bin/env python3
"""The settings dialog and the plugin's own Qt class, in the Qt of Cura 4 and in that of Cura 5: test_dialog.py PyQt5|PyQt6.

Of Cura there is a stand-in that can be imported and keeps preferences. The real one is in test_in_cura.py.
"""
import importlib.util
import os
import pathlib
import sys
import types
import unittest

os.environ.update(QT_QPA_PLATFORM="offscreen", QT_QUICK_BACKEND="software")
BINDING = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2] / "plugin/cura"
sys.path.insert(0, str(ROOT))
QtCore, QtGui, QtQml, QtQuick = (importlib.import_module(f"{BINDING}.{name}") for name in ("QtCore", "QtGui", "QtQml", "QtQuick"))


class Preferences(dict):
    """As Cura's: a value that is not known is none; what was set may come back as text after a restart."""

    def addPreference(self, key, default):
        self.setdefault(key, default)

    getValue = dict.get
    setValue = dict.__setitem__


class Extension:
    def __init__(self):
        self.items = {}

    def setMenuName(self, name):
        self.name = name

    def addMenuItem(self, name, function):
        self.items[name] = function


def import_extension():
    """Aplomb.extension, with empty stand-ins for the modules of Cura that it imports."""
    for name in ("UM", "UM.Application", "UM.Extension", "UM.Logger", "UM.Message", "UM.Operations", "UM.Operations.AddSceneNodeOperation",
                 "UM.Operations.GroupedOperation", "UM.Operations.Operation", "UM.Operations.RemoveSceneNodeOperation", "UM.Mesh",
                 "UM.Mesh.MeshData", "UM.Scene", "UM.Scene.Iterator", "UM.Scene.Iterator.DepthFirstIterator", "UM.Scene.Selection",
                 "UM.Settings", "UM.Settings.SettingInstance", "UM.Job", "cura", "cura.Scene", "cura.Scene.BuildPlateDecorator",
                 "cura.Scene.CuraSceneNode", "cura.Scene.SliceableObjectDecorator"):
        module = sys.modules[name] = types.ModuleType(name)
        setattr(module, name.rpartition(".")[2], type(name.rpartition(".")[2], (), {}))
    sys.modules["UM.Extension"].Extension = Extension
    sys.modules["UM.Mesh.MeshData"].calculateNormalsFromVertices = None
    return importlib.import_module("Aplomb.extension")


class Dialog(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.app = QtGui.QGuiApplication([])
        cls.module = import_extension()

    def setUp(self):
        self.preferences = Preferences()
        self.plugin = self.module.AplombExtension(types.SimpleNamespace(getPreferences=lambda: self.preferences))
        self.engine = QtQml.QQmlEngine()
        self.warnings = []
        self.engine.warnings.connect(lambda errors: self.warnings.extend(error.toString() for error in errors))
        component = QtQml.QQmlComponent(self.engine, QtCore.QUrl.fromLocalFile(str(ROOT / "Aplomb/SettingsDialog.qml")))
        self.context = QtQml.QQmlContext(self.engine.rootContext())
        self.context.setContextProperty("manager", self.plugin)
        self.window = component.create(self.context)
        self.assertIsNotNone(self.window, [error.toString() for error in component.errors()])
        self.window.load()
        self.window.show()
        self.app.processEvents()

    def tearDown(self):
        self.window.close()
        self.window.deleteLater()
        self.app.processEvents()
        self.assertEqual(self.warnings, [])

    def find(self, name):
        found = self.window.findChild(QtCore.QObject, name)
        self.assertIsNotNone(found, name)
        return found

    def test_it_shows_the_settings_and_nothing_is_cut_off(self):
        self.assertEqual((self.find("tip").property("text"), self.find("wall").property("text")), ("10", "1.6"))
        for name in ("tip", "wall", "aim", "save"):
            item = self.find(name)
            at = item.mapRectToScene(QtCore.QRectF(0, 0, item.width(), item.height()))
            self.assertTrue(QtCore.QRectF(0, 0, self.window.width(), self.window.height()).contains(at), name)
            self.assertGreaterEqual(item.width(), item.property("implicitWidth") or 0, name)
        if "APLOMB_CURA_PICTURES" in os.environ:
            self.window.grabWindow().save(os.path.join(os.environ["APLOMB_CURA_PICTURES"], f"settings_{BINDING}.png"))

    def test_what_is_saved_is_remembered_and_comes_back_cleaned(self):
        self.find("tip").setProperty("text", "7.5")
        self.find("aim").setProperty("currentIndex", 2)
        self.find("save").clicked.emit()
        self.app.processEvents()
        self.assertFalse(self.window.isVisible())
        self.assertEqual((self.preferences["aplomb/tip_deg"], self.preferences["aplomb/aim"]), (7.5, "stable"))
        self.preferences["aplomb/tip_deg"] = "7.5"  # as after a restart
        self.assertEqual(self.plugin.values()["tip_deg"], 7.5)

    def test_the_plugin_takes_the_qt_that_cura_has_loaded_though_both_are_installed(self):
        self.assertIsInstance(self.plugin, QtCore.QObject)
        for binding in ("PyQt5", "PyQt6"):
            self.assertIsNotNone(importlib.util.find_spec(binding))

    def test_closing_it_changes_nothing(self):
        before = dict(self.preferences)
        self.find("tip").setProperty("text", "1")
        self.window.close()
        self.assertEqual(self.preferences, before)

    def test_the_menu_has_what_is_promised(self):
        self.assertEqual(list(self.plugin.items)[:2], ["Make it stand", "Will it stand?"])


if __name__ == "__main__":
    sys.exit(unittest.main())
