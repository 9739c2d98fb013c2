"""The history of a pixel in French: its sentences are made of few phrases (capture/pixel.py)."""

import re

from landscape.languages import typeset

OUTCOMES = {
    "drawn": "tracé",
    "clip": "découpé",
    "scissor": "ciseaux",
    "alpha": "alpha",
    "stencil": "stencil",
    "depth": "caché",
    "masked": "masqué",
}
PHRASES = (
    (r"^colour ", "couleur "),
    (r"^unit (\d)", r"unité \1"),
    (r"^fog: ", "brouillard : "),
    ("^fog has this colour already", "le brouillard a déjà cette couleur"),
    (r"\) replaces \(", ") remplace ("),
    (r"\) becomes = \(", ") devient = ("),
    (r"^set to = ", "mis à = "),
    (r", of which (\w+) is written", r", dont \1 est écrit"),
    (r"of the bits of (.*) and ", r"des bits de \1 et "),
    (r"(GL_MIN|GL_MAX) of (.*) and ", r"\1 de \2 et "),
    (r"^behind (.*)", r"derrière \1"),
    (r"(GL_CLIP_PLANE\d) or ", r"\1 ou "),
    ("^outside the scissor box", "hors du rectangle de ciseaux"),
    ("^reference ", "référence "),
    (" in the stencil buffer", " dans le tampon de stencil"),
    ("^depth ", "profondeur "),
    (": fails$", " : échec"),
    (
        "^the colour mask lets no component through",
        "le masque de couleur ne laisse passer aucune composante",
    ),
)


def outcome(name: str, language: str) -> str:
    """Return what became of a fragment, in a word."""
    return OUTCOMES[name] if language == "fr" else name


def arithmetic(text: str, language: str) -> str:
    """Return one part of a row's arithmetic in a language."""
    if language != "fr":
        return text
    for phrase, french in PHRASES:
        text = re.sub(phrase, french, text)
    return typeset(text)
