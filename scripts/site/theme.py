"""The words of the theme, furo: it has no translations of its own."""

from pathlib import Path

import polib

from framelens.base.texts import Phrases, translator

WORDS: Phrases = (
    "Back to top",
    "Home",
    "Made with ",
    "Next",
    "On this page",
    "Please activate JavaScript to enable the search functionality.",
    "Previous",
    "Skip to content",
)
LABELS: Phrases = (
    "Toggle Light / Dark / Auto color theme",
    "Toggle navigation of ",
    "Toggle site navigation sidebar",
    "Toggle table of contents sidebar",
)


def write_words(folder: Path, language: str) -> None:
    """Write the theme's words among a site's sources, as the catalogue that Sphinx looks for."""
    _ = translator(language, "site")
    catalogue = polib.POFile()
    catalogue.metadata = {"Content-Type": "text/plain; charset=utf-8"}
    for word in WORDS:
        catalogue.append(polib.POEntry(msgid=word, msgstr=_(word)))
    path = folder / "locales" / language / "LC_MESSAGES" / "sphinx.po"
    path.parent.mkdir(parents=True)
    catalogue.save(str(path))


def reword_labels(out: Path, language: str) -> None:
    """Translate, in built pages, the labels that the theme writes in English whatever one asks."""
    _ = translator(language, "site")
    for path in out.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        for label in LABELS:
            text = text.replace(label, _(label))
        path.write_text(text, encoding="utf-8")
