"""PrusaSlicer's settings as they will be, and what of them would undo a void."""
import pathlib


def read_settings(path):
    """key: value of a saved .ini."""
    settings = {}
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        key, is_pair, value = line.partition(" = ")
        if is_pair and not line.startswith("#"):
            settings[key.strip()] = value.strip()
    return settings


def promise_limits(settings):
    """Words for `aplomb verify`: what G-code may differ from the promise by. Sparse infill is predicted less exactly than solid; that it
    stands is asked of the G-code all the same."""
    density = settings.get("fill_density", "20%").rstrip("%")
    return [] if float(density) >= 100 else ["--max-com-error", "2mm", "--max-mass-error", "10%"]


def forced_keys(settings):
    """(words for the command line, sentences that say why): what has to be otherwise for the void to be printed as a void."""
    words, why = [], []
    if settings.get("slicing_mode", "regular") != "regular":
        words += ["--slicing-mode", "regular"]
        why.append(f"slicing_mode = {settings['slicing_mode']} would print the void solid: regular is used")
    supports = settings.get("support_material") == "1"
    if supports and settings.get("support_material_buildplate_only") != "1":
        words.append("--support-material-buildplate-only")
        why.append("supports would grow inside the void, where nobody gets them out: they are drawn from the plate alone")
    if settings.get("gcode_label_objects") != "1":
        words.append("--gcode-label-objects")
    return words, why
