"""The languages of the texts that users see.

English stands in the code. The other languages are in gettext catalogues,
``locale/LANGUAGE/DOMAIN.po`` of each package, where a translation is found by its English text.
They are read as they are, not compiled: a compiled catalogue could be older than its source, and
nobody would see it.

A text that is to be translated is either the argument of a call of ``_``, the name that a
:func:`translator` is given, or in a table annotated as :data:`Texts` or :data:`Phrases`.
``scripts/catalogues`` finds both, and checks that every text has a translation.
"""

import os
import re
import string
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from numbers import Integral, Real
from pathlib import Path
from typing import Protocol

from framelens import system
from framelens.base.errors import InputError, Message, NoOpenGLError
from framelens.base.packages import PACKAGES

LANGUAGES = ("en", "fr")
ERRORS = ("errors", "landscape_errors")  # the domains of templates of messages, of both packages
_NO_BREAK = re.compile(r" (?=[;:!?»]|%(?![(rs]))|(?<=«) |(?<=\d) (?=\d{3}(?!\d))")
_APOSTROPHE = re.compile(r"(?<=[^\W\d_])'(?=\w|«)")  # as in l'eau; not in 'word' or x'

Texts = dict[str, str]
"""English texts by key. A key is the context of its text, where one text has two translations."""

Phrases = tuple[str, ...]
"""Phrases that English sentences are made of; a longer one comes before one that it contains."""


class Translator(Protocol):
    """From an English text to the same in a language."""

    def __call__(self, text: str, context: str = "") -> str:
        """Return the translation for a context (msgctxt), else that for any, else the text."""


def marked(text: str, context: str = "") -> str:
    """Return a text as it is: imported as ``_``, it marks a text that is translated elsewhere."""
    return text


def choose(environment: Mapping[str, str]) -> str:
    """Return the first of LANGUAGES that the environment asks for, else "en".

    LANGUAGE may list several, preferred first; then LC_ALL, LC_MESSAGES and LANG, in this order.
    An environment that names none, as on Windows, leaves it to the user's settings of the system.
    """
    wanted = environment.get("LANGUAGE", "").split(":")
    locale = next(
        (environment[v] for v in ("LC_ALL", "LC_MESSAGES", "LANG") if environment.get(v)), ""
    )
    if not any((*wanted, locale)):
        locale = system.user_language()
    for name in (*wanted, locale):
        code = name.replace("-", "_").split("_")[0].split(".")[0].lower()
        if code in LANGUAGES:
            return code
    return "en"


@contextmanager
def speaking(language: str) -> Iterator[None]:
    """Let the texts, and programs that are started, be in a language; "": in the user's."""
    before = os.environ.get("LANGUAGE")
    if language:
        os.environ["LANGUAGE"] = language
    try:
        yield
    finally:
        os.environ.pop("LANGUAGE", None)
        if before is not None:
            os.environ["LANGUAGE"] = before


def typeset(french: str) -> str:
    """Return a French text with its no-break spaces and its apostrophes.

    No-break are the spaces before ; : ! ? %, but not before %s, inside « » and in 1 500 000. What
    is between backquotes is code, and stays as it is.
    """
    parts = french.split("`")
    # An odd number of parts: each second one is code.
    words = slice(0, None, 2 if len(parts) % 2 else 1)
    parts[words] = [
        _APOSTROPHE.sub("\u2019", _NO_BREAK.sub("\u00a0", part)) for part in parts[words]
    ]
    # Before code too, as in l'`alpha`.
    for number in range(0, len(parts) - 1, 2) if len(parts) % 2 else ():
        parts[number] = re.sub(r"(?<=[^\W\d_])'$", "\u2019", parts[number])
    return "`".join(parts)


@cache
def translator(language: str, *domains: str | Path) -> Translator:
    """Return the function that translates the texts of these domains; the first that has one wins.

    A domain is a catalogue of the packages, or a folder of them; or the path of a user's folder, in
    which LANGUAGE.po is the catalogue. A catalogue is read when its first text is asked for, and
    kept. A text without a translation is returned as it is, and so is every text in a
    language that is not one of LANGUAGES. The function raises InputError if a catalogue cannot be
    read.
    """

    def translated(text: str, context: str = "") -> str:
        for domain in domains:
            catalogue = _catalogue(language, domain)
            found = catalogue.get((context, text)) or catalogue.get(("", text))
            if found:
                return found
        return text

    def unchanged(text: str, context: str = "") -> str:
        return text

    return translated if language in LANGUAGES[1:] else unchanged


def said(message: Message | InputError | NoOpenGLError, language: str) -> str:
    """Return a message in a language; in English where that has no translation of it."""
    return message.translated(translator(language, *ERRORS))


class _Formatter(string.Formatter):
    """Fills values into a text, fractions with a decimal mark of its own."""

    def __init__(self, mark: str) -> None:
        self._mark = mark

    def format_field(self, value: object, format_spec: str) -> object:
        text = super().format_field(value, format_spec)
        fraction = isinstance(value, Real) and not isinstance(value, Integral)
        return text.replace(".", self._mark) if fraction else text


def filled(text: str, values: Mapping[str, object], mark: str = ".") -> str:
    """Return a text with {values} as str.format does; ``mark`` is the decimal mark."""
    return _Formatter(mark).vformat(text, (), values)


def reworded(sentence: str, phrases: Phrases, _: Translator) -> str:
    """Return an English sentence with each of the phrases in it translated."""
    whole = "|".join(
        (r"\b" if phrase[0].isalnum() else "")
        + re.escape(phrase)
        + (r"\b" if phrase[-1].isalnum() else "")
        for phrase in phrases
    )
    return re.sub(whole, lambda match: _(match[0]), sentence)


@cache
def _catalogue(language: str, domain: str | Path) -> dict[tuple[str, str], str]:
    """Return the translations of a domain by context and English text."""
    # Imported here: English needs no catalogue.
    import polib

    found: dict[tuple[str, str], str] = {}
    for path in _files(language, domain):
        if not path.is_file():
            continue
        try:
            entries = polib.pofile(str(path), encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(
                "{path}: not a catalogue of texts: {error}", path=path, error=error
            ) from error
        for entry in entries:
            if entry.translated():
                text = typeset(entry.msgstr) if language == "fr" else entry.msgstr
                found.setdefault((entry.msgctxt or "", entry.msgid), text)
    return found


def _files(language: str, domain: str | Path) -> list[Path]:
    """Return the files in which a domain's catalogues would be."""
    if isinstance(domain, Path):
        return [domain / f"{language}.po"]
    places = [package.locale / language / domain for package in PACKAGES]
    return [
        path
        for place in places
        for path in (place.with_name(f"{place.name}.po"), *sorted(place.glob("*.po")))
    ]


class Wording:
    """A table of texts by key, which a domain of the catalogues translates."""

    def __init__(self, texts: Texts, domain: str) -> None:
        self._texts = texts
        self._domain = domain

    def text(self, language: str, key: str, **words: str) -> str:
        """Return a text in a language, else in English; ``words`` fill its {placeholders}."""
        return translator(language, self._domain)(self._texts[key], key).format(**words)

    def counted(self, language: str, key: str, count: int, **words: str) -> str:
        """Return a text that says how many, with {count}; that of one has a key ending in .one.

        In French 0 is singular, too.
        """
        single = count == 1 or (language == "fr" and count == 0)
        return self.text(language, f"{key}.one" if single else key, count=str(count), **words)
