"""What a command line of prusa-slicer asks for: which words are models, which are ours, where the G-code goes."""
import dataclasses
import math
import pathlib
import re
import shlex

MODEL_SUFFIXES = (".stl", ".obj", ".3mf", ".ply", ".off")
EXPORTS = ("-g", "--gcode", "--export-gcode", "-s", "--slice")
OTHER_ACTIONS = ("-h", "--help", "--help-fff", "--help-sla", "--info", "--export-3mf", "--export-amf", "--export-obj", "--export-stl",
                 "--export-sla", "--sla", "--gcodeviewer", "--save")
TAKES_FILE = ("--load", "-o", "--output", "--datadir", "--save")  # their value is no model, whatever it is called
TURNS = ("--rotate-x", "--rotate-y", "--cut", "--scale", "--scale-to-fit", "--split")
UNCHANGED = ("1", "100%", "0")  # a scale or a turn that is none


class UsageError(Exception):
    """A command line that cannot be staged; its text is for the user."""


@dataclasses.dataclass
class Request:
    models: list  # paths
    keys: list  # the words for prusa-slicer without models, output and actions
    output: pathlib.Path = None
    merges: bool = False
    stand: list = dataclasses.field(default_factory=list)  # words for `aplomb stand`
    tip_deg: float = 10


def is_for_us(words):
    """Whether G-code is asked for; everything else is prusa-slicer's alone."""
    names = {word.split("=", 1)[0] for word in words}
    return bool(names & set(EXPORTS)) and not names & set(OTHER_ACTIONS)


def request_of(words):
    """The parts of a command line. Raises UsageError."""
    request = Request([], [])
    words = list(words)
    while words:
        word = words.pop(0)
        name, joined, value = word.partition("=")

        def argument():
            if joined:
                return value
            if not words:
                raise UsageError(f"{name} needs a value")
            return words.pop(0)

        if name in EXPORTS:
            continue
        if name in ("-o", "--output"):
            request.output = pathlib.Path(argument())
        elif name == "--aplomb":
            request.stand += shlex.split(argument())
        elif name in TAKES_FILE:
            request.keys += [name, argument()]
        elif name in TURNS:
            refuse_turn(name, "1" if name == "--split" else argument())
        elif name.startswith("-"):
            request.merges |= name in ("-m", "--merge")
            request.keys.append(word)
        elif pathlib.Path(word).suffix.lower() in MODEL_SUFFIXES:
            request.models.append(pathlib.Path(word))
        else:
            request.keys.append(word)  # the value of the key before it
    take_tip(request)
    if not request.models:
        raise UsageError("no model is named: one of " + ", ".join(MODEL_SUFFIXES))
    return request


def refuse_turn(name, value):
    if name == "--split" or value.strip() not in UNCHANGED:
        raise UsageError(f"{name} would change the model after it was made to stand; use --aplomb '--scale F', '--height H' or "
                         "'--rotate X,Y,Z', or change the model itself")


def take_tip(request):
    """--tip is asked of the G-code, too: it is taken from the words for `aplomb stand`."""
    kept, words = [], list(request.stand)
    while words:
        word = words.pop(0)
        name, joined, value = word.partition("=")
        if name != "--tip":
            kept.append(word)
        elif joined or words:
            request.tip_deg = degrees(value if joined else words.pop(0))
        else:
            raise UsageError("--tip needs a value")
    request.stand = kept


def degrees(text):
    """"8deg", "8" or "0.14rad"."""
    found = re.fullmatch(r"([0-9.eE+-]+?)(deg|rad)?", text.strip())
    try:
        return float(found[1]) * (math.degrees(1) if found[2] == "rad" else 1)
    except (TypeError, ValueError):
        raise UsageError(f"--tip: '{text}' is no angle such as 10deg") from None
