"""Switches off the island's techniques that the current OpenGL cannot do, with one line for each.

Their requirements are in framelens/gl/features.py. Here the settings are changed accordingly, so
that all other code only asks the settings.
"""

from landscape.elements.settings import Settings
from landscape.gl.features import possible
from landscape.settings.declare import Value, get, with_settings

# Settings that ask for something, and the value that does not.
OFF: dict[str, Value] = {
    "castle.ornate": False,
    "water.foam": False,
    "water.glitter": 0.0,
    "water.horizon_contrast": 0.0,
    "water.query": False,
    "water.ripples": 0.0,
}


def supported(settings: Settings) -> Settings:
    """Return settings without the techniques that the current OpenGL cannot draw."""
    asked = [key for key, off in OFF.items() if get(settings, key) != off]
    settings = with_settings(settings, {key: OFF[key] for key in asked if not possible(key)})
    castle = settings.castle
    if castle.multitexture and not castle.ornate and not possible("castle.multitexture"):
        settings = with_settings(settings, {"castle.multitexture": False})
    return settings
