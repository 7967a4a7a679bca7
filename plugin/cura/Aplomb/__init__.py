"""Aplomb in Cura: "Will it stand?" and "Make it stand" in the Extensions menu. Cura imports this and calls register().

Written for the oldest Python of the Curas that it runs in, 3.5: no f-strings, no annotated variables.
"""


def getMetaData():
    return {}


def register(app):
    from .extension import AplombExtension

    return {"extension": AplombExtension(app)}
