"""A plugin of the test's own: uses Cura as a person would, notes what it sees and closes Cura.

Told by the environment: APLOMB_DRIVER_MODEL is opened, APLOMB_DRIVER_SECOND_MODEL later and
APLOMB_DRIVER_BALLAST last; APLOMB_DRIVER_OUT is the folder for
what was seen.
"""


def getMetaData():
    return {}


def register(app):
    from .driver import Driver

    return {"extension": Driver(app)}
