"""One catalogue: it is brought up to date with a list of texts, or compared with it."""

import re
import string
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import polib

WIDTH = 98  # chosen: columns of a catalogue
WORDS = 4  # chosen: a shorter text may need another translation elsewhere
_LINK = re.compile(r"\]\(([^)]*)\)")

EMPTY: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class Message:
    """An English text, and the file that it stands in.

    ``context`` is the msgctxt of an entry that the catalogue may have for this text here, beside
    the one that holds everywhere.
    """

    text: str
    source: str
    context: str = ""


def known(paths: Iterable[Path]) -> dict[str, str]:
    """Return the translations on which these catalogues agree, of texts of WORDS words or more."""
    found: dict[str, set[str]] = {}
    for path in paths:
        for entry in _entries(path):
            if entry.msgstr and not entry.fuzzy and len(entry.msgid.split()) >= WORDS:
                found.setdefault(entry.msgid, set()).add(entry.msgstr)
    return {text: texts.pop() for text, texts in found.items() if len(texts) == 1}


def update(
    path: Path, language: str, messages: Iterable[Message], elsewhere: Mapping[str, str] = EMPTY
) -> list[str]:
    """Write the catalogue with an entry for each of these texts, sorted by source, and no others.

    Translations and translators' comments are kept; a new text is translated as ``elsewhere``.
    Returns a line for each translation that is gone with its text. Raises ValueError if the file is
    not a catalogue.
    """
    kept = {_key(entry): entry for entry in _entries(path)}
    sources, contexts = _wanted(messages)
    new = polib.POFile(wrapwidth=WIDTH)
    new.header = "How to add or change a text: CONTRIBUTING.md"
    new.metadata = {
        "Language": language,
        "MIME-Version": "1.0",
        "Content-Type": "text/plain; charset=utf-8",
        "Content-Transfer-Encoding": "8bit",
    }
    for text in sorted(sources, key=lambda text: sources[text][0]):
        for context in ("", *sorted(contexts[text])):
            old = kept.pop((context, text), None)
            if context and not old:
                continue
            entry = polib.POEntry(
                msgctxt=context or None,
                msgid=text,
                msgstr=old.msgstr if old else elsewhere.get(text, ""),
                occurrences=[(source, "") for source in sources[text]],
            )
            if old:
                entry.flags, entry.tcomment = old.flags, old.tcomment
            new.append(entry)

    path.parent.mkdir(parents=True, exist_ok=True)
    new.save(str(path))
    return [
        f"{path}: removed: {old.msgid!r}: {old.msgstr!r}" for old in kept.values() if old.msgstr
    ]


def faults(path: Path, messages: Iterable[Message]) -> Iterator[str]:
    """Yield a line for each fault of the catalogue of these texts."""
    try:
        entries = _entries(path)
    except ValueError as error:
        yield str(error)
        return

    sources, contexts = _wanted(messages)
    found = [_key(entry) for entry in entries]
    for text, files in sources.items():
        if ("", text) not in found:
            yield f"{path}: missing: {text!r}, from {', '.join(files)}"
    for entry in entries:
        context, text = key = _key(entry)
        what = f"{text!r}, for {context}" if context else repr(text)
        if text not in sources or (context and context not in contexts[text]):
            yield f"{path}: stale: {what}"
        elif found.count(key) > 1:
            yield f"{path}: more than one entry: {what}"
        elif not entry.msgstr.strip():
            yield f"{path}: untranslated: {what}"
        elif entry.fuzzy:
            yield f"{path}: fuzzy: {what}"
        elif (ours := placeholders(text)) != (theirs := placeholders(entry.msgstr)):
            names = ", ".join(sorted(ours ^ theirs))
            yield f"{path}: not in both languages: {{{names}}}: {what}"
        elif (here := markup(text)) != (there := markup(entry.msgstr)):
            yield f"{path}: not in both languages: {', '.join(sorted(here ^ there))}: {what}"


def placeholders(text: str) -> set[str]:
    """Return the names in braces, as str.format reads them; text that it cannot read, whole."""
    try:
        return {name for _, name, _, _ in string.Formatter().parse(text) if name is not None}
    except ValueError:
        return {text}


def markup(text: str) -> set[str]:
    """Return where the links of a text in Markdown lead, and how many cells a row of a table has.

    A document may have a translation of its own beside it: README.md, README.fr.md.
    """
    targets = {re.sub(r"\.[a-z]{2}\.md$", ".md", link) for link in _LINK.findall(text)}
    return targets | ({f"{text.count('|')} times |"} if text.startswith("|") else set())


def _entries(path: Path) -> list[polib.POEntry]:
    """Return the entries of a catalogue, none if there is no file."""
    try:
        entries = polib.pofile(str(path), encoding="utf-8") if path.exists() else []
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: not a catalogue: {error}") from error
    return [entry for entry in entries if not entry.obsolete]


def _key(entry: polib.POEntry) -> tuple[str, str]:
    return entry.msgctxt or "", entry.msgid


def _wanted(messages: Iterable[Message]) -> tuple[dict[str, list[str]], dict[str, set[str]]]:
    """Return, by text, the files that it stands in, sorted, and the contexts it may have."""
    sources: dict[str, set[str]] = {}
    contexts: dict[str, set[str]] = {}
    for message in messages:
        sources.setdefault(message.text, set()).add(message.source)
        contexts.setdefault(message.text, set()).update({message.context} - {""})
    return {text: sorted(files) for text, files in sources.items()}, contexts
