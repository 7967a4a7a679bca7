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
from .settings import forced_keys, promise_limits, read_settings

USAGE, UNUSABLE_INPUT, TOPPLES, BROKEN_PROMISE, INTERNAL = 1, 2, 3, 6, 7  # exit codes, as the program's own
BEYOND_DEG = 0.1  # asked for in addition to what G-code came short of


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
    tip_deg: float  # that was asked for


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
        self.limits = []
        self.aplomb = program("APLOMB", "aplomb", "../aplomb", "../../../tools/aplomb")
        self.slicer = program("PRUSA_SLICER", "prusa-slicer")

    def run(self):
        profile = self.settings_file()
        settings = read_settings(profile)
        forced, why = forced_keys(settings)
        for sentence in why:
            say(sentence)
        self.limits = promise_limits(settings)
        standing = [self.stand(model, profile, self.request.tip_deg) for model in self.request.models]
        groups = [standing] if self.request.merges else [[one] for one in standing]
        made = [(self.settle(group, profile, forced), group) for group in groups]
        for gcode, group in made:
            self.give_out(gcode, group, len(made))

    def settle(self, group, profile, forced):
        """The G-code of a plate on which everything stands. Where it comes short of the angle, for sparse infill is predicted only so
        exactly, models stand again, asked for as much more."""
        for is_last in (False, False, True):
            gcode = self.slice(group, forced)
            shortfalls = [self.shortfall_deg(gcode, one, len(group) == 1, is_last) for one in group]
            if max(shortfalls) <= 0:
                return gcode
            for i, short_deg in enumerate(shortfalls):
                if short_deg > 0:
                    say(f"{group[i].model.name} comes {short_deg:.2f} degrees short in the G-code: as much more is asked for")
                    group[i] = self.stand(group[i].model, profile, group[i].tip_deg + short_deg + BEYOND_DEG)
        raise AssertionError("the last round ends otherwise")

    def settings_file(self):
        """All of prusa-slicer's settings, from its files and its command line."""
        path = self.scratch / "settings.ini"
        self.prusa_slicer([*self.request.keys, "--save", str(path)])
        if not path.exists():
            raise Stop(USAGE, "prusa-slicer did not save its settings: are its options right?")
        return path

    def folder(self, name):
        return pathlib.Path(tempfile.mkdtemp(prefix=name, dir=self.scratch))

    def stand(self, model, profile, tip_deg):
        folder = self.folder("model")
        staged, report = folder / f"{model.stem}.3mf", folder / "report.json"
        layer = read_settings(profile).get("layer_height", "0.2")
        say(f"{model.name}:")
        code = subprocess.run([self.aplomb, "stand", str(model), "-o", str(staged), "--report", str(report), "--profile", str(profile),
                               "--layer", f"{layer}mm", "--tip", f"{tip_deg}deg", *self.request.stand], stdin=subprocess.DEVNULL).returncode
        if code != 0:
            raise Stop(code, f"{model.name} was not sliced (aplomb stand ended with {code}; its reason is above)")
        return Standing(model, staged, report, tip_deg)

    def slice(self, group, forced):
        folder = self.folder("sliced")
        code = self.prusa_slicer([*self.request.keys, *forced, "--export-gcode", "--output", str(folder) + "/",
                                  *(str(one.staged) for one in group)])
        made = sorted(folder.iterdir())
        if code != 0 or len(made) != 1:
            raise Stop(code if code > 0 else INTERNAL, f"prusa-slicer made no G-code (it ended with {code})")
        return made[0]

    def shortfall_deg(self, gcode, one, is_alone, is_last):
        """By how much the worst copy of a model falls short of the angle asked for; its other faults end the stage."""
        report = self.scratch / "verified.json"
        worst_deg = 0
        for label in [None] if is_alone else self.labels(gcode, one):
            chosen = ["--object", label] if label else []
            code = subprocess.run([self.aplomb, "verify", str(gcode), "--tip", f"{self.request.tip_deg}deg", "--expect", str(one.report),
                                   "--report", str(report), *self.limits, *chosen], stdin=subprocess.DEVNULL, stdout=sys.stderr).returncode
            told = json.loads(report.read_text())["objects"] if code in (0, TOPPLES, BROKEN_PROMISE) else []
            is_as_told = all(thing["error"]["is_within_limits"] for thing in told)
            if code != 0 and (is_last or code != TOPPLES or not is_as_told):
                raise Stop(code, f"{gcode.name} was not given out (aplomb verify ended with {code}; its reason is above)")
            worst_deg = max([worst_deg, *(self.request.tip_deg - thing["tip_deg"] for thing in told)])
        return worst_deg

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
