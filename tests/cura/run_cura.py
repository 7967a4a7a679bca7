"""Runs the real Cura under a display of its own, with a home of its own, until the driver closes it."""
import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
VERSION = "4.13"
PREFERENCES = """[general]
version = 7
accepted_user_agreement = True
auto_slice = False
[cura]
choice_on_open_project = open_as_model
[info]
send_slice_info = False
asked_send_slice_info = True
automatic_update_check = False
"""


@contextlib.contextmanager
def display():
    """The name of a fresh X display with OpenGL."""
    reader, writer = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", "1400x900x24", "+extension", "GLX", "-nolisten", "tcp"],
                              pass_fds=[writer], stderr=subprocess.DEVNULL)
    os.close(writer)
    try:
        with os.fdopen(reader) as told:
            yield ":" + told.readline().strip()
    finally:
        server.terminate()
        server.wait()


def install(package, home):
    """Schedules the package as Cura does when one is dropped on its window: it installs it when it starts next."""
    data = home / ".local/share/cura" / VERSION
    cached = data / "Aplomb.curapackage"
    data.mkdir(parents=True)
    shutil.copy(package, cached)
    with zipfile.ZipFile(package) as archive:
        info = json.loads(archive.read("package.json"))
    scheduled = {"version": 1, "installed": {}, "to_remove": [], "dismissed": [],
                 "to_install": {info["package_id"]: {"package_info": info, "filename": str(cached)}}}
    (data / "packages.json").write_text(json.dumps(scheduled))


def run(package, models, ballast, folder, seconds):
    """What the driver saw. \\raises RuntimeError with the end of Cura's log where it saw nothing."""
    home, out = folder / "home", folder / "out"
    out.mkdir(parents=True)
    install(package, home)
    plugins = home / ".local/share/cura" / VERSION / "plugins"
    shutil.copytree(HERE / "AplombTestDriver", plugins / "AplombTestDriver", ignore=shutil.ignore_patterns("__pycache__"))
    config = home / ".config/cura" / VERSION
    config.mkdir(parents=True)
    (config / "cura.cfg").write_text(PREFERENCES)
    with display() as name:
        environment = {"PATH": os.environ["PATH"], "HOME": str(home), "DISPLAY": name, "LIBGL_ALWAYS_SOFTWARE": "1", "LC_ALL": "C.UTF-8",
                       "QT_QPA_PLATFORM": "xcb", "APLOMB_DRIVER_OUT": str(out), "PYTHONDONTWRITEBYTECODE": "1",
                       "APLOMB_DRIVER_MODEL": str(models[0]), "APLOMB_DRIVER_SECOND_MODEL": str(models[1]),
                       "APLOMB_DRIVER_BALLAST": str(ballast)}
        environment.update({key: os.environ[key] for key in ("APLOMB_CURA_PICTURES",) if key in os.environ})
        with open(folder / "cura.log", "wb") as log:
            cura = subprocess.Popen(["cura"], env=environment, stdout=log, stderr=subprocess.STDOUT, cwd=folder)
            try:
                cura.wait(seconds)
            except subprocess.TimeoutExpired:
                cura.kill()
                cura.wait()
    if not (out / "seen.json").exists():
        logs = [folder / "cura.log", *home.rglob("cura.log"), *home.rglob("stderr.log")]
        raise RuntimeError("\n".join(f"--- {path}\n" + path.read_text(errors="replace")[-4000:] for path in logs if path.exists()))
    seen = json.loads((out / "seen.json").read_text())
    seen["complaints"] = [line for line in (folder / "cura.log").read_text(errors="replace").splitlines() if "plugins/Aplomb/" in line]
    return seen
