"""Names of a frame's passes and elements, in the user's language."""

from framelens.base.texts import Texts, translator

NAMES: Texts = {
    "pass.setup": "setup",
    "pass.shadow": "shadows",
    "pass.reflection": "reflection",
    "pass.refraction": "refraction",
    "pass.main": "main pass",
    "pass.picture": "picture",
    "pass.water": "water",
    "pass.overlay": "overlay",
    "element.ground": "ground",
    "element.water": "water",
    "element.sky": "sky",
    "element.trees": "trees",
    "element.deer": "deer",
    "element.plants": "plants",
    "element.grass": "grass",
    "element.castle": "castle",
    "element.rabbit": "rabbit",
    "element.dragon": "dragon",
    "element.sword": "sword",
    "element.map": "map",
    "element.fog": "fog",
    "element.reflection": "reflection",
    "element.mist": "mist",
    "element.frame": "frame",
}


def element(language: str, name: str) -> str:
    """Return an element's name; that of a program's own element is left as it is."""
    return _named(language, f"element.{name}", name)


def pass_name(language: str, name: str) -> str:
    """Return a pass's name."""
    return _named(language, f"pass.{name}", name)


def _named(language: str, key: str, name: str) -> str:
    return translator(language, "calls")(NAMES[key], key) if key in NAMES else name
