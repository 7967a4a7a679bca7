"""What a run means, for people: from its exit code, its report and what it said. Knows nothing of Cura."""
import collections

STANDS, USAGE, UNUSABLE, CANNOT_STAND, CANCELLED, OVER_BUDGET, DOES_NOT_PRINT, INTERNAL = range(8)
GOOD, WARNING, ERROR = "good", "warning", "error"

Verdict = collections.namedtuple("Verdict", "level text")

# Settings of Cura's that spoil a void that was rightly made: key, the value that does, what is to be done.
SPOILERS = (
    ("meshfix_union_all_remove_holes", True, "\u201cRemove All Holes\u201d is on and would fill the void: turn it off."),
    ("conical_overhang_enabled", True, "\u201cMake Overhang Printable\u201d is on and would fill the void: turn it off."),
    ("magic_spiralize", True, "\u201cSpiralize Outer Contour\u201d is on: the void would not be printed at all. Turn it off."),
    ("support_type", "everywhere", "Supports would be put into the void: let them touch the build plate only."),
)

PLAINLY = {
    UNUSABLE: "cannot be used",
    OVER_BUDGET: "takes too much memory",
    USAGE: "the settings do not do",
    INTERNAL: "Aplomb failed",
}


def _degrees(value):
    return "{:.1f}\u00b0".format(value if abs(value) >= 0.05 else 0.0).replace("-", "\u2212")


def _sentence(said):
    """The first line of what the program said, without its name."""
    for line in said:
        if line.strip():
            return line.strip()[len("aplomb: "):] if line.startswith("aplomb: ") else line.strip()
    return "it ended without a word"


def tip_line(report):
    asked = _degrees(report["required_tip_deg"])
    before = _degrees(report["before"]["tip_deg"])
    if report.get("after"):
        return "Tip angle {} ({} before, {} asked).".format(_degrees(report["after"]["tip_deg"]), before, asked)
    return "Tip angle {} ({} asked).".format(before, asked)


def mass_line(report):
    before, after = report["before"], report.get("after")
    if not after:
        return "Mass {:.1f} g, centre of mass {:.1f} mm above the plate.".format(before["mass_g"], before["com_height_mm"])
    return "Mass {:.1f} g ({:.1f} g before), centre of mass {:.1f} mm above the plate ({:.1f}).".format(
        after["mass_g"], before["mass_g"], after["com_height_mm"], before["com_height_mm"])


def work_line(report):
    parts = []
    carving, wall, deformation = report.get("carving"), report.get("wall_mm"), report.get("deformation")
    if carving:
        parts.append("void {:.1f} cm\u00b3".format(carving["void_mm3"] / 1000))
    ballast = report.get("ballast")
    if ballast:
        parts.append("infill of {:.0f} % in one part instead of {:.0f} %, {:.1f} g more".format(
            ballast["infill_percent"][1], ballast["infill_percent"][0], ballast["added_g"]))
    if wall:
        parts.append("wall {:.2f} mm".format(wall["measured"]))
    if deformation and deformation.get("trim_mm"):
        parts.append("{:.2f} mm cut off the base".format(deformation["trim_mm"]))
    if deformation and deformation.get("max_mm"):
        parts.append("outside bent by up to {:.1f} mm".format(deformation["max_mm"]))
    text = ", ".join(parts)
    return text[:1].upper() + text[1:] + "." if text else ""


def failures(report):
    """A sentence for each finding that stands in the way of printing, and what helps."""
    judgement = report.get("judgement") or {}
    found = [finding for finding in judgement.get("findings", []) if finding["id"] in judgement.get("new_failures", [])]
    return ["{}{}: {}.".format(finding["text"][:1].upper(), finding["text"][1:], finding["remedy"]) for finding in found[:3]]


def _figures(report):
    if not report or "tip_deg" not in report.get("before", {}):
        return []
    return [line for line in (tip_line(report), mass_line(report), work_line(report)) if line]


def of_check(name, code, report, said, has_ballast=False):
    """Of "Will it stand?". \\param has_ballast  it was made to stand by infill, which the program was not told of."""
    if has_ballast and code in (STANDS, CANNOT_STAND):
        head = "{}: without its ballast it {}. With it, it stands as it did when the ballast was made, unless it was changed since."
        return Verdict(WARNING, "\n".join([head.format(name, "stands" if code == STANDS else "falls over")] + _figures(report)))
    if code == STANDS:
        return Verdict(GOOD, "\n".join(["{}: it stands.".format(name)] + _figures(report)))
    if code == CANNOT_STAND:
        stands_barely = report["before"]["tip_deg"] > 0
        head = "{}: it stands, but tips over sooner than asked." if stands_barely else "{}: it falls over."
        return Verdict(WARNING, "\n".join([head.format(name)] + _figures(report) + ["\u201cMake it stand\u201d may help."]))
    return of_failure(name, code, said)


def spoilers(setting):
    """What spoils the void, a sentence each. setting(key) is the value that Cura has; of no use without supports."""
    return [text for key, value, text in SPOILERS
            if setting(key) == value and (key != "support_type" or setting("support_enable") is True)]


def of_stand(name, code, report, said, is_swapped, spoilt_by=()):
    """Of "Make it stand". \\param spoilt_by  what spoilers() gave."""
    if code == STANDS and is_swapped and spoilt_by:
        lines = ["{}: it stands now, but not as Cura is set.".format(name)] + list(spoilt_by) + _figures(report)
        return Verdict(WARNING, "\n".join(lines))
    if code == STANDS:
        head = "{}: it stands now." if is_swapped else "{}: it stood already, and is left as it was."
        return Verdict(GOOD, "\n".join([head.format(name)] + _figures(report)))
    if code == CANNOT_STAND:
        helps = ["Left as it was. A smaller angle, a thinner wall, another pose or \u201coutside may change\u201d may help."]
        return Verdict(WARNING, "\n".join(["{}: nothing inside makes it stand as asked.".format(name)] + _figures(report) + helps))
    if code == DOES_NOT_PRINT:
        lines = ["{}: left as it was, for what would stand would not print as Cura is set.".format(name)]
        return Verdict(WARNING, "\n".join(lines + failures(report)))
    return of_failure(name, code, said)


def of_failure(name, code, said):
    if code == CANCELLED:
        return Verdict(WARNING, "{}: cancelled.".format(name))
    return Verdict(ERROR, "{}: {}: {}.".format(name, PLAINLY.get(code, "Aplomb ended with {}".format(code)),
                                               _sentence(said).rstrip(".")))


def together(verdicts):
    """One for several models: the worst level, every text."""
    order = (GOOD, WARNING, ERROR)
    level = max((verdict.level for verdict in verdicts), key=order.index)
    return Verdict(level, "\n\n".join(verdict.text for verdict in verdicts))
