"""A stand-in for OrcaSlicer's `orca` module: no more than its bindings and documentation say, and as strict as they are.

After OrcaSlicer's src/slic3r/plugin/host/PluginHostModel.cpp and its wiki, developer_reference/plugin_development. What is not
there is not here: a plugin that calls it fails in the test.
"""
import types

import numpy


class Mesh:
    def __init__(self, vertices, triangles):
        self._vertices, self._triangles = numpy.float32(vertices), numpy.int32(triangles)
        self._vertices.flags.writeable = self._triangles.flags.writeable = False  # zero-copy views into the live mesh

    def vertices(self):
        return self._vertices

    def triangles(self):
        return self._triangles


class Volume:
    def __init__(self, mesh, kind="ModelPart", matrix=None):
        self.name, self._mesh, self._kind = "part", mesh, kind
        self._matrix = numpy.eye(4) if matrix is None else numpy.array(matrix, dtype=float)

    def is_model_part(self):
        return self._kind == "ModelPart"

    def is_negative_volume(self):
        return self._kind == "NegativeVolume"

    def is_modifier(self):
        return self._kind == "ParameterModifier"

    def matrix(self):
        return self._matrix.copy()

    def mesh(self):
        return self._mesh


class Instance:
    def __init__(self, matrix=None):
        self._matrix = numpy.eye(4) if matrix is None else numpy.array(matrix, dtype=float)

    def matrix(self):
        return self._matrix.copy()

    def is_left_handed(self):
        return numpy.linalg.det(self._matrix[:3, :3]) < 0


class ModelObject:
    def __init__(self, name, volumes, instance=None, config=None):
        self.name, self._volumes, self._instances, self._config = name, volumes, [instance or Instance()], config or {}

    def volumes(self):
        return list(self._volumes)

    def instance(self, index):
        return self._instances[index]

    def config_value(self, key):
        return self._config.get(key)  # a str or None


class ProgressDialog:
    def __init__(self, host, maximum):
        self._host, self._maximum, self._is_open = host, maximum, True

    def update(self, value, message=""):
        assert self._is_open and isinstance(value, int) and 0 <= value <= self._maximum and isinstance(message, str)
        self._host.progress.append((value, message))
        return not (self._host.cancel_at is not None and len(self._host.progress) > self._host.cancel_at)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._is_open = False


class Host:
    """What a test sets and sees."""

    def __init__(self, objects, storage, settings=None, config=None):
        self.objects, self.storage, self.settings, self.config = objects, str(storage), settings or {}, config or "{}"
        self.messages, self.progress, self.cancel_at, self.capabilities, self.packages = [], [], None, [], []

    def message(self, text, title="", buttons="ok", icon="info"):
        assert buttons in ("ok", "ok_cancel", "yes_no", "yes_no_cancel") and icon in ("info", "warning", "error", "question")
        self.messages.append((icon, text))
        return "ok"

    def module(self):
        class PythonPluginBase:
            def get_name(self):
                raise NotImplementedError  # pure virtual

            def get_config(base):
                return self.config

        class Script(PythonPluginBase):
            pass

        class Base:
            pass

        class Result(types.SimpleNamespace):
            @staticmethod
            def success(message="", data=""):
                return Result(status="Success", message=message, data=data)

            @staticmethod
            def failure(status, message, data=""):
                return Result(status=status, message=message, data=data)

        def plugin(cls):
            assert issubclass(cls, Base) and not self.packages, "exactly one class per file"
            self.packages.append(cls)
            return cls

        def register_capability(cls):
            assert issubclass(cls, PythonPluginBase)
            self.capabilities.append(cls)

        orca = types.ModuleType("orca")
        orca.base, orca.plugin, orca.register_capability, orca.ExecutionResult = Base, plugin, register_capability, Result
        orca.PluginResult = types.SimpleNamespace(Success="Success", RecoverableError="RecoverableError", FatalError="FatalError")
        orca.script = types.SimpleNamespace(ScriptPluginCapabilityBase=Script)
        ui = types.SimpleNamespace(
            message=self.message, PD_APP_MODAL=1, PD_AUTO_HIDE=2, PD_CAN_ABORT=4,
            create_progress_dialog=lambda title, message, maximum=100, style=3: ProgressDialog(self, maximum))
        orca.host = types.SimpleNamespace(
            ui=ui, model=lambda: types.SimpleNamespace(objects=lambda: list(self.objects)),
            preset_bundle=lambda: types.SimpleNamespace(full_config_value=self.settings.get),
            plugin=types.SimpleNamespace(storage=lambda: self.storage))
        return orca
