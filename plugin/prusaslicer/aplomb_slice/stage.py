"""Makes every model stand, slices, and gives out G-code only where it stands."""
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from .command_line import UsageError, is_for_us, request_of
from .settings import forced_keys, read_settings

USAGE, UNUSABLE_INPUT, INTERNAL = 1, 2, 7  # exit codes, as the program's own


class Stop(Exception):
    """Ends the stage with an exit code; what there is to say was said, or is in the text."""

    def __init__(self, code, text=""):
        super().__init__(text)
        self.code = code


@dataclasses.dataclass
class Standing:
    model: pathlib.Path
    staged: pathlib.Path  # what is sliced
    report: pathlib.Path


def say(text):
    print(f"aplomb-slice: {text}", file=sys.stderr, flush=True)


def program(variable, name, *beside):
    """From the environment, beside this file, or on the PATH."""
    here = pathlib.Path(__file__).resolve().parent
    for candidate in (os.environ.get(variable), *(here / place for place in beside), shutil.which(name)):
        if candidate and os.access(candidate, os.X_OK):
            return str(candidate)
    raise Stop(USAGE, f"{name} was not found; {variable} can name it")


class Stage:
    def __init__(self, request, scratch):
        self.request = request
        self.scratch = pathlib.Path(scratch)
        self.aplomb = program("APLOMB", "aplomb", "../aplomb", "../../../tools/aplomb")
        self.slicer = program("PRUSA_SLICER", "prusa-slicer")

    def run(self):
        profile = self.settings_file()
        forced, why = forced_keys(read_settings(profile))
        for sentence in why:
            say(sentence)
        standing = [self.stand(number, model, profile) for number, model in enumerate(self.request.models)]
        groups = [standing] if self.request.merges else [[one] for one in standing]
        made = [(self.slice(number, group, forced), group) for number, group in enumerate(groups)]
        for gcode, group in made:
            self.verify(gcode, group)
        for gcode, group in made:
            self.give_out(gcode, group, len(made))

    def settings_file(self):
        """All of prusa-slicer's settings, from its files and its command line."""
        path = self.scratch / "settings.ini"
        self.prusa_slicer([*self.request.keys, "--save", str(path)])
        if not path.exists():
            raise Stop(USAGE, "prusa-slicer did not save its settings: are its options right?")
        return path

    def stand(self, number, model, profile):
        folder = self.scratch / f"model{number}"
        folder.mkdir()
        staged, report = folder / f"{model.stem}.3mf", folder / "report.json"
        layer = read_settings(profile).get("layer_height", "0.2")
        say(f"{model.name}:")
        code = subprocess.run([self.aplomb, "stand", str(model), "-o", str(staged), "--report", str(report), "--profile", str(profile),
                               "--layer", f"{layer}mm", *self.request.stand], stdin=subprocess.DEVNULL).returncode
        if code != 0:
            raise Stop(code, f"{model.name} was not sliced (aplomb stand ended with {code}; its reason is above)")
        return Standing(model, staged, report)

    def slice(self, number, group, forced):
        folder = self.scratch / f"sliced{number}"
        folder.mkdir()
        code = self.prusa_slicer([*self.request.keys, *forced, "--export-gcode", "--output", str(folder) + "/",
                                  *(str(one.staged) for one in group)])
        made = sorted(folder.iterdir())
        if code != 0 or len(made) != 1:
            raise Stop(code if code > 0 else INTERNAL, f"prusa-slicer made no G-code (it ended with {code})")
        return made[0]

    def verify(self, gcode, group):
        """Of a plate, and of each of its objects against what was promised."""
        checks = [["--expect", str(group[0].report)]] if len(group) == 1 else [
            ["--object", label, "--expect", str(one.report)] for one in group for label in self.labels(gcode, one)]
        for check in checks:
            code = subprocess.run([self.aplomb, "verify", str(gcode), "--tip", self.request.tip, *check], stdin=subprocess.DEVNULL,
                                  stdout=sys.stderr).returncode
            if code != 0:
                raise Stop(code, f"{gcode.name} was not given out (aplomb verify ended with {code}; its reason is above)")

    def labels(self, gcode, one):
        """What G-code calls the copies of a model."""
        report = self.scratch / "verified.json"
        subprocess.run([self.aplomb, "verify", str(gcode), "--tip", "0deg", "-q", "--report", str(report)], stdin=subprocess.DEVNULL)
        objects = json.loads(report.read_text())["objects"] if report.exists() else []
        labels = [told["name"] for told in objects if told["name"].startswith(one.model.stem + " ")]
        if not labels:
            raise Stop(INTERNAL, f"{one.model.name} is not in the G-code")
        return labels

    def give_out(self, gcode, group, count):
        """Where prusa-slicer would have put it: beside the first model, in the folder or under the name asked for."""
        output = self.request.output
        if output is None:
            target = group[0].model.parent / gcode.name
        elif output.is_dir() or count > 1:
            target = output / gcode.name
        else:
            target = output
        partial = target.with_name(target.name + ".part")
        try:
            shutil.copyfile(gcode, partial)
            os.replace(partial, target)
        except OSError as error:
            partial.unlink(missing_ok=True)
            raise Stop(UNUSABLE_INPUT, f"{target} cannot be written: {error.strerror}") from error
        say(f"wrote {target}")

    def prusa_slicer(self, words):
        return subprocess.run([self.slicer, *words], stdin=subprocess.DEVNULL, stdout=sys.stderr).returncode


def main(words):
    """The exit code."""
    try:
        if not is_for_us(words):
            slicer = program("PRUSA_SLICER", "prusa-slicer")
            os.execv(slicer, [slicer, *words])
        request = request_of(words)
        for model in request.models:
            if not model.is_file():
                raise Stop(UNUSABLE_INPUT, f"{model}: there is no such file")
        with tempfile.TemporaryDirectory(prefix="aplomb-slice-") as scratch:
            Stage(request, scratch).run()
        return 0
    except UsageError as error:
        say(str(error))
        return USAGE
    except Stop as stop:
        if str(stop):
            say(str(stop))
        return stop.code
    except KeyboardInterrupt:
        return 4
