# /// script
# requires-python = ">=3.12"
# dependencies = ["numpy"]
#
# [tool.orcaslicer.plugin]
# name = "Aplomb"
# description = "Makes models stand that would topple when printed: moves their centre of mass by a void inside."
# author = "Aplomb"
# version = "0.1.0"
# ///
"""Aplomb in OrcaSlicer (after 2.4.2): "Will it stand?" and "Make it stand", in the Plugins window under Run.

NOT YET RUN IN THE REAL HOST: written after Orca's documentation and bindings, tested with a stand-in for its `orca` module.

Plugins may read the model and not change it, so what stands is handed back as a 3MF to import. The program `aplomb` does the
work; it is looked for at the config's "program", beside this file and on the PATH. Orca asks before it lets a plugin start one.
"""
import json
import os
import pathlib
import queue
import re
import shutil
import subprocess
import sys
import threading

import numpy
import orca

TITLE = "Aplomb"
STANDS, CANNOT_STAND, CANCELLED, DOES_NOT_PRINT = 0, 3, 4, 6  # exit codes of the program
DEFAULTS = {"tip_deg": 10.0, "wall_mm": 1.6, "aim": "least", "deform": "never", "robust": False, "from_orca": True, "program": ""}
RECORD = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
TICK_S = 0.1


class Unusable(Exception):
    """A sentence for people."""


def triangles_of(model_object):
    """(n, 3, 3) corners in mm, z up, as the first copy of the object lies on the plate: all its parts."""
    instance, found = model_object.instance(0), []
    for volume in model_object.volumes():
        if volume.is_negative_volume():
            raise Unusable(f"{model_object.name} has a negative part: make one mesh of it first")
        if not volume.is_model_part():
            continue
        mesh = volume.mesh()
        matrix = numpy.asarray(instance.matrix()) @ numpy.asarray(volume.matrix())
        vertices = numpy.asarray(mesh.vertices(), dtype=numpy.float64) @ matrix[:3, :3].T + matrix[:3, 3]
        corners = vertices[numpy.asarray(mesh.triangles())]
        found.append(corners[:, ::-1] if numpy.linalg.det(matrix[:3, :3]) < 0 else corners)  # outside stays outside
    if not found:
        raise Unusable(f"{model_object.name} has no part that is printed")
    return numpy.concatenate(found).astype(numpy.float32)


def write_stl(path, corners):
    records = numpy.zeros(len(corners), dtype=RECORD)
    records["corners"] = corners
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    records["normal"] = normals / numpy.where(lengths > 0, lengths, 1)
    header = b"binary STL of Aplomb for OrcaSlicer".ljust(80)  # never begins with "solid"
    with open(path, "wb") as file:
        file.write(header + len(records).to_bytes(4, "little") + records.tobytes())


def number_in(text):
    """The first number of a setting such as "15%" or "1.24,1.27"; None where there is none."""
    found = re.search(r"\d+(\.\d+)?", str(text)) if text is not None else None
    return float(found[0]) if found else None


def print_profile(model_object):
    """How Orca is set to print it; what it does not tell is None."""
    def value(key):
        own = model_object.config_value(key)
        return number_in(own if own is not None else orca.host.preset_bundle().full_config_value(key))

    return {"--infill": (value("sparse_infill_density"), "%"), "--layer": (value("layer_height"), "mm"),
            "--density": (value("filament_density"), "")}


def arguments_for(makes_stand, config, profile, model, output, report):
    arguments = ["stand" if makes_stand else "check", str(model), "--report", str(report), "--progress", "json",
                 "--tip", f"{config['tip_deg']:g}deg"]
    if config["robust"]:
        arguments.append("--robust")
    if makes_stand:
        arguments += ["-o", str(output), "--wall", f"{config['wall_mm']:g}mm", "--aim", config["aim"], "--deform", config["deform"]]
    for flag, (value, unit) in profile.items():
        if value and config["from_orca"] and (makes_stand or flag == "--density"):
            arguments += [flag, f"{value:g}{unit}"]
    return arguments


def find_program(asked):
    beside = pathlib.Path(__file__).resolve().parent / ("aplomb.exe" if sys.platform == "win32" else "aplomb")
    for candidate in (asked, str(beside), shutil.which("aplomb")):
        if candidate and os.access(candidate, os.X_OK):
            return candidate
    raise Unusable("The program aplomb is neither beside this plugin nor on the PATH. Its place can be set in the plugin's Config tab.")


def own_folder():
    """Where Orca lets a plugin write: its storage, in Orcas that have one, or beside the plugin."""
    plugin = getattr(orca.host, "plugin", None)
    folder = pathlib.Path(plugin.storage() if hasattr(plugin, "storage") else pathlib.Path(__file__).resolve().parent / "made")
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def run(command, on_progress):
    """(exit code, lines that it said). on_progress(share done, stage) is asked ten times a second; False cancels."""
    flags = {"creationflags": 0x08000000} if sys.platform == "win32" else {}  # no console window
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          encoding="utf-8", errors="replace", **flags) as process:
        is_cancelled, said = follow(process, on_progress)
    return (CANCELLED if is_cancelled else process.returncode), said


def follow(process, on_progress):
    """Reads what it says to its end, in a thread, so that cancelling does not wait for the next line."""
    lines = queue.SimpleQueue()

    def listen():
        for line in process.stdout:
            lines.put(line)
        lines.put(None)

    threading.Thread(target=listen, daemon=True).start()
    said, told, is_cancelled = [], (0.0, "start"), False
    while True:
        try:
            line = lines.get(timeout=TICK_S)
        except queue.Empty:
            line = ""
        if line is None:
            return is_cancelled, said
        progress = re.fullmatch(r'\{"progress": ([\d.]+), "stage": "(.*)"\}\s*', line)
        if progress:
            told = float(progress[1]), progress[2]
        elif line.strip():
            said.append(line.strip())
        if not is_cancelled and not on_progress(*told):
            is_cancelled = True
            process.terminate()


def figures(report):
    """Lines with the numbers of a report."""
    before, after = report["before"], report.get("after")
    lines = [f"Tip angle {(after or before)['tip_deg']:.1f}\u00b0 ({report['required_tip_deg']:.1f}\u00b0 asked"
             + (f", {before['tip_deg']:.1f}\u00b0 before)" if after else ")"),
             f"Mass {(after or before)['mass_g']:.1f} g" + (f" ({before['mass_g']:.1f} g before)" if after else "")]
    return [line.replace("-", "\u2212") for line in lines]


def verdict(makes_stand, name, code, report, said, output):
    """(icon, text) of a run."""
    head = said[0].removeprefix("aplomb: ") if said else f"it ended with {code}"
    if code == CANCELLED:
        return "warning", f"{name}: cancelled."
    if code not in (STANDS, CANNOT_STAND, DOES_NOT_PRINT):
        return "error", f"{name}: {head}"
    lines = [f"{name}: {head}", *figures(report)]
    if makes_stand and code == STANDS and report["outcome"] == "stands":
        lines += ["", f"Import it in place of the model, without turning or scaling it:\n{output}"]
    elif code == DOES_NOT_PRINT:
        judgement = report.get("judgement", {})
        lines += ["", "Nothing was made, for it would not print as Orca is set:"]
        lines += [f"{f['text']}: {f['remedy']}" for f in judgement.get("findings", []) if f["id"] in judgement.get("new_failures", [])]
    return ("info" if code == STANDS else "warning"), "\n".join(lines)


class Balancer(orca.script.ScriptPluginCapabilityBase):
    """What both capabilities share; not registered itself."""

    makes_stand = False

    def get_default_config(self):
        return DEFAULTS

    def config(self):
        given = json.loads(self.get_config() or "{}")
        return {key: type(default)(given.get(key, default)) for key, default in DEFAULTS.items()}

    def execute(self):
        try:
            config = self.config()
            program, objects = find_program(config["program"]), orca.host.model().objects()
            if not objects:
                raise Unusable("There is no model.")
            said = self.run_all(program, config, objects)
        except (Unusable, OSError, ValueError) as error:
            orca.host.ui.message(str(error), title=TITLE, buttons="ok", icon="error")
            return orca.ExecutionResult.failure(orca.PluginResult.RecoverableError, str(error))
        text = "\n\n".join(text for _, text in said)
        worst = max((icon for icon, _ in said), key=("info", "warning", "error").index)
        orca.host.ui.message(text, title=TITLE, buttons="ok", icon=worst)
        return orca.ExecutionResult.success(text)

    def run_all(self, program, config, objects):
        ui = orca.host.ui
        style = ui.PD_APP_MODAL | ui.PD_AUTO_HIDE | ui.PD_CAN_ABORT
        with ui.create_progress_dialog(TITLE, "Reading the models", maximum=100, style=style) as progress:
            said = []
            for number, model_object in enumerate(objects):
                def show(share, stage):
                    done = min(99, int(100 * (number + share) / len(objects)))  # at 100 the dialog would hide
                    return progress.update(done, f"{model_object.name}: {stage}")
                said.append(self.run_one(program, config, model_object, number + 1, show))
            return said

    def run_one(self, program, config, model_object, number, show):
        folder = own_folder()
        name = f"{number}_" + re.sub(r"[^\w-]+", "_", pathlib.Path(model_object.name).stem)
        model, output, report_file = folder / f"{name}.stl", folder / f"{name}_stands.3mf", folder / f"{name}.json"
        report_file.unlink(missing_ok=True)
        write_stl(model, triangles_of(model_object))
        try:
            command = arguments_for(self.makes_stand, config, print_profile(model_object), model, output, report_file)
            code, said = run([program, *command], show)
        finally:
            model.unlink(missing_ok=True)
        report = json.loads(report_file.read_text(encoding="utf-8")) if report_file.exists() else {}
        return verdict(self.makes_stand, model_object.name, code, report, said, output)


class MakeItStand(Balancer):
    makes_stand = True

    def get_name(self):
        return "Make it stand"


class WillItStand(Balancer):
    def get_name(self):
        return "Will it stand?"


@orca.plugin
class AplombPlugin(orca.base):
    def register_capabilities(self):
        orca.register_capability(MakeItStand)
        orca.register_capability(WillItStand)
