"""What a user may set: each with its key, default, and what it may be. Knows nothing of Cura."""
import collections

Number = collections.namedtuple("Number", "key default least most")
Choice = collections.namedtuple("Choice", "key default names")
Switch = collections.namedtuple("Switch", "key default")

ALL = (
    Number("tip_deg", 10.0, 0.0, 89.0),  # tip angle asked for
    Number("wall_mm", 1.6, 0.1, 100.0),  # least wall round a void
    Choice("aim", "least", ("least", "light", "stable")),
    Choice("deform", "never", ("never", "auto", "only")),
    Switch("robust", False),  # ask it of the worst of the tolerances
    Switch("from_cura", True),  # reckon with the infill, layer height and filament that are set in Cura
)
DEFAULTS = {setting.key: setting.default for setting in ALL}


def clean(setting, value):
    """A value as it may be used: of the right type and in range; the default where it is no such thing."""
    if isinstance(setting, Switch):
        return str(value).lower() in ("true", "1")
    if isinstance(setting, Choice):
        return value if value in setting.names else setting.default
    try:
        number = float(str(value).replace(",", "."))
    except ValueError:
        return setting.default
    if not number == number:  # NaN
        return setting.default
    return min(max(number, setting.least), setting.most)


def cleaned(values):
    """Every setting, from a dict that may lack some and hold anything."""
    return {setting.key: clean(setting, values.get(setting.key, setting.default)) for setting in ALL}
