"""The history of a pixel in the user's language: its sentences are made of few phrases."""

from framelens.base.texts import Phrases, reworded, translator

# Phrases that framelens/tape/pixel.py and framelens/tape/arithmetic.py write.
PHRASES: Phrases = (
    "fog has this colour already",
    "the light is behind the surface",
    "no light is enabled",
    "ambient of the scene",
    "attenuation",
    "emission",
    "specular",
    "lighting:",
    "ambient",
    "diffuse",
    "the colour mask lets no component through",
    "outside the scissor box",
    "in the stencil buffer",
    "of which nothing is written",
    "of which",
    "is written",
    "of the bits of",
    "GL_MIN of",
    "GL_MAX of",
    "replaces",
    "becomes",
    "set to",
    "behind",
    "reference",
    "colour",
    "depth",
    "unit",
    "fog:",
    ": fails",
    "by N.L",
    "and",
    "or",
)


def arithmetic(text: str, language: str) -> str:
    """Return one part of a row's arithmetic in a language."""
    return reworded(text, PHRASES, translator(language, "inspector"))
