"""What a run means, for people: from its exit code, its report and what it said. Knows nothing of Cura."""
import collections

STANDS, USAGE, UNUSABLE, CANNOT_STAND, CANCELLED, OVER_BUDGET, DOES_NOT_PRINT, INTERNAL = range(8)
GOOD, WARNING, ERROR = "good", "warning", "error"

Verdict = collections.namedtuple("Verdict", "level text")

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


def of_check(name, code, report, said):
    """Of "Will it stand?"."""
    if code == STANDS:
        return Verdict(GOOD, "\n".join(["{}: it stands.".format(name)] + _figures(report)))
    if code == CANNOT_STAND:
        stands_barely = report["before"]["tip_deg"] > 0
        head = "{}: it stands, but tips over sooner than asked." if stands_barely else "{}: it falls over."
        return Verdict(WARNING, "\n".join([head.format(name)] + _figures(report) + ["\u201cMake it stand\u201d may help."]))
    return of_failure(name, code, said)


def of_stand(name, code, report, said, is_swapped):
    """Of "Make it stand"."""
    if code == STANDS:
        head = "{}: it stands now." if is_swapped else "{}: it stood already, and is left as it was."
        return Verdict(GOOD, "\n".join([head.format(name)] + _figures(report)))
    if code == CANNOT_STAND:
        helps = ["Left as it was. A smaller angle, a thinner wall, another pose or \u201coutside may change\u201d may help."]
        return Verdict(WARNING, "\n".join(["{}: no void makes it stand as asked.".format(name)] + _figures(report) + helps))
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
