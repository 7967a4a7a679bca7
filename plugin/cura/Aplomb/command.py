"""Which program is run, and with which arguments. Knows nothing of Cura."""
import os
import platform
import shutil
import stat


def carried_program(plugin_folder, machine=None, system=None):
    """Where a package carries the program for this kind of machine: <machine>/<System>/aplomb, as Cura's own plugins do."""
    system = system or platform.system()
    name = "aplomb.exe" if system == "Windows" else "aplomb"
    return os.path.join(plugin_folder, machine or platform.machine(), system, name)


def find_program(plugin_folder, which=shutil.which):
    """The program of the package, else the one on PATH, else None."""
    carried = carried_program(plugin_folder)
    if os.path.isfile(carried):
        make_runnable(carried)
        return carried
    return which("aplomb")


def make_runnable(path):
    """Cura unpacks packages without their permissions."""
    mode = os.stat(path).st_mode
    if not mode & stat.S_IXUSR:
        os.chmod(path, mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)


def environment_for(program, given):
    """What the program sees: not the libraries and Python of the Cura that runs it, but those it was packed with."""
    clean = {key: value for key, value in given.items()
             if key not in ("LD_LIBRARY_PATH", "LD_PRELOAD", "PYTHONHOME", "PYTHONPATH", "QT_PLUGIN_PATH", "QML2_IMPORT_PATH")}
    libraries = os.path.join(os.path.dirname(program), "lib")
    if os.path.isdir(libraries):
        clean["LD_LIBRARY_PATH"] = libraries
    return clean


def _number(value):
    return "{:.6g}".format(value)


def _common(model, report, settings, profile, profile_file):
    arguments = [model, "--report", report, "--progress", "json", "--tip", _number(settings["tip_deg"]) + "deg"]
    if profile_file and settings["from_cura"]:
        arguments += ["--profile", profile_file]
    if settings["robust"]:
        arguments.append("--robust")
    if settings["from_cura"] and profile.get("density_g_per_cm3"):
        arguments += ["--density", _number(profile["density_g_per_cm3"])]
    return arguments


def check_arguments(model, report, settings, profile, profile_file=None):
    return ["check"] + _common(model, report, settings, profile, profile_file)


def stand_arguments(model, output, report, settings, profile, profile_file=None, ballast=None):
    """`profile` holds what Cura is set to: infill_percent, layer_mm, density_g_per_cm3; any may be missing. `profile_file`
    holds all its settings, and `ballast` is where a volume of denser infill is written, if that serves better than a void."""
    arguments = ["stand"] + _common(model, report, settings, profile, profile_file)
    if ballast and "--profile" in arguments:
        arguments += ["--modifier", ballast]
    arguments += ["-o", output, "--wall", _number(settings["wall_mm"]) + "mm", "--aim", settings["aim"], "--deform", settings["deform"]]
    if settings["from_cura"]:
        if profile.get("infill_percent") is not None:
            arguments += ["--infill", _number(profile["infill_percent"]) + "%"]
        if profile.get("layer_mm"):
            arguments += ["--layer", _number(profile["layer_mm"]) + "mm"]
    return arguments
