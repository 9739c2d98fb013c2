"""The history of a pixel in French: no English phrase is left in it."""

import re
from pathlib import Path

import pytest

from framelens.inspector import words
from framelens.inspector.inspector_words import arithmetic
from framelens.tape import pixel

ROWS = {
    "colour (1.000, 0.500, 0.000)": "couleur (1.000, 0.500, 0.000)",
    "unit 1, GL_COMBINE, texel (0.1, 0.2, 0.3): (0.2, 0.2, 0.2)": (
        "unité 1, GL_COMBINE, texel (0.1, 0.2, 0.3): (0.2, 0.2, 0.2)"
    ),
    "fog: 0.9 x (1, 1, 1) + 0.1 x (0, 0, 0) = (0.9, 0.9, 0.9)": (
        "brouillard : 0.9 x (1, 1, 1) + 0.1 x (0, 0, 0) = (0.9, 0.9, 0.9)"
    ),
    "(1, 1, 1) replaces (0, 0, 0), of which RG is written = (1, 1, 0)": (
        "(1, 1, 1) remplace (0, 0, 0), dont RG est écrit = (1, 1, 0)"
    ),
    "GL_MIN of (1, 1, 1) and (0, 0, 0) = (0, 0, 0)": "GL_MIN de (1, 1, 1) et (0, 0, 0) = (0, 0, 0)",
    "GL_XOR of the bits of (1, 1, 1) and (1, 1, 1), of which nothing is written = (0, 0, 0)": (
        "GL_XOR des bits de (1, 1, 1) et (1, 1, 1), dont rien n’est écrit = (0, 0, 0)"
    ),
    "behind GL_CLIP_PLANE0 or GL_CLIP_PLANE1": "derrière GL_CLIP_PLANE0 ou GL_CLIP_PLANE1",
    "reference 1 GL_EQUAL 0 in the stencil buffer: fails": (
        "référence 1 GL_EQUAL 0 dans le tampon de stencil : échec"
    ),
    "depth 0.500000 GL_LESS 0.250000: fails": "profondeur 0.500000 GL_LESS 0.250000 : échec",
    "set to = (0.4, 0.6, 0.7)": "mis à = (0.4, 0.6, 0.7)",
}


@pytest.mark.parametrize("english", ROWS)
def test_each_kind_of_row_has_its_french_words(english: str) -> None:
    assert arithmetic(english, "en") == english
    assert arithmetic(english, "fr").replace("\u00a0", " ") == ROWS[english]


def test_every_outcome_of_a_fragment_has_a_word() -> None:
    source = Path(pixel.__file__).read_text(encoding="utf-8")
    named = set(re.findall(r'return "(\w+)", ', source)) | {"drawn", "masked"}
    assert all(words.text("en", f"inspector.{name}") == name for name in named)
    assert words.text("fr", "inspector.depth") == "caché"
