"""A lecturer's own exercise, as it begins: a whole small exercise, each part of it explained.

It is the one in landscape/course/scaffold, under another name. In English it has a catalogue for
the French; in French it has French texts alone.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from framelens.base.errors import InputError
from framelens.base.texts import Phrases, Translator, translator
from landscape.course import program_texts
from landscape.course.shelf import MARKER, NAME, Exercise, read, start, texts_of

SCAFFOLD = Path(__file__).resolve().parent / "scaffold"
FRENCH = "fr.po"
WIDTH = 98  # chosen: columns of a catalogue
FILES = ("solution.py", "solution2.py", "grading.py", "mutants.py", "hidden.py")
README: Phrases = (
    "The exercise {name}. It works as it is: change one file after the other, and let the first "
    "command below say after each whether the exercise still holds.",
    "What students begin with. Its first lines are the title, an empty line and the task. "
    "The line `# exercise: {name}` says to the grader which exercise it is; `# lessons:` names "
    "lessons to read first, and may be deleted; `# Your code goes here.` marks where they write. "
    "The program must run as it is.",
    "How you would solve it: students' pictures are compared with those of this program.",
    "Other ways to solve it, as many as you can think of, also `solution3.py` and so on: they must "
    "pass, so that a student who thinks differently does.",
    "The tests, and which frames they look at.",
    "Mistakes that you expect, at least four: each must get a hint of its own.",
    "Tests that students do not see. Delete it if you need none.",
    "The French texts, for `--lang fr`. Delete it if you teach in one language: write in that "
    "everywhere.",
    "What a test can look at: `python -m pydoc landscape.course.grader.evidence`; how it is "
    "written: `python -m pydoc landscape.course.grader.grading`.",
    "In the folder around this one:",
    "does the exercise hold?",
    "what students get, and what you keep",
    "what they handed in",
)
PO_HEADER: Phrases = (
    "The French of the exercise: msgid is a text as it stands in its files, msgstr what it is in "
    "French. `landscape exercise test NAME --french` adds the texts that are new.",
)


def new(name: str, language: str) -> dict[str, str]:
    """Return the files of a new exercise by their names; InputError for a name that cannot be."""
    if not NAME.fullmatch(name):
        raise InputError(
            "{name}: expected a name of letters, digits and _, such as clock_hand", name=name
        )
    found = _scaffold()
    own = translator(language, "scaffold")
    files = {"README.md": _readme(name, translator(language, "course"), language)}
    files["start.py"] = _named(start(replace(found, lessons=()), language), name)
    for file in FILES:
        code = (SCAFFOLD / file).read_text(encoding="utf-8")
        files[file] = _named(program_texts.translated(code, own), name)
    if language == "en":
        texts = [text for text, _file in texts_of(found)]
        french = translator("fr", "scaffold")
        files[FRENCH] = catalogue(texts, french, PO_HEADER[0])
    return files


def _scaffold() -> Exercise:
    return read("clock_hand", SCAFFOLD, "scaffold")


def _named(code: str, name: str) -> str:
    return MARKER.sub(f"# exercise: {name}", code)


def _readme(name: str, _: Translator, language: str) -> str:
    said = [_(text).format(name=name) for text in README]
    files = ("start.py", "solution.py", "solution2.py", "grading.py", "mutants.py", "hidden.py")
    about = list(zip((*files, FRENCH), said[1:8], strict=True))
    lines = [f"# {name}", "", said[0], ""]
    lines += [f"- `{file}`: {text}" for file, text in about if file != FRENCH or language == "en"]
    commands = (
        (f"landscape exercise test {name}", said[10]),
        (f"landscape exercise pack {name} --out handout", said[11]),
        ("landscape exercise check submissions --exercises .", said[12]),
    )
    width = max(len(command) for command, _what in commands)
    lines += ["", said[8], "", said[9], ""]
    lines += [f"    {command:{width}}  # {what}" for command, what in commands]
    return "\n".join(lines) + "\n"


def catalogue(texts: list[str], translate: Translator, header: str = "") -> str:
    """Return a catalogue of texts, each with its translation, or with none where it has none."""
    import polib  # here, as English needs no catalogue

    made = polib.POFile(wrapwidth=WIDTH)
    made.header = header
    made.metadata = {
        "Language": "fr",
        "MIME-Version": "1.0",
        "Content-Type": "text/plain; charset=utf-8",
        "Content-Transfer-Encoding": "8bit",
    }
    for text in dict.fromkeys(texts):
        said = translate(text)
        made.append(polib.POEntry(msgid=text, msgstr=said if said != text else ""))
    return f"{made}\n"


def scaffold_texts() -> Iterator[tuple[str, str]]:
    """Yield the texts of the scaffold, each with its file's name."""
    yield from texts_of(_scaffold())
    for file in FILES:
        code = (SCAFFOLD / file).read_text(encoding="utf-8")
        yield from ((text, file) for text in program_texts.texts(code))


def untranslated(found: Exercise) -> list[str]:
    """Return the texts of an exercise that its fr.po has not in French."""
    known = {entry.msgid for entry in _french(found) if entry.translated()}
    texts = dict.fromkeys(text for text, _file in texts_of(found))
    return [text for text in texts if text not in known]


def with_new_texts(found: Exercise) -> tuple[bytes, int]:
    """Return the fr.po of an exercise with an entry for each text that had none; how many.

    Entries of texts that are gone become comments.
    """
    import polib

    texts = dict.fromkeys(text for text, _file in texts_of(found))
    if not (found.folder / FRENCH).is_file():
        made = catalogue(list(texts), lambda text, context="": text, PO_HEADER[0])
        return made.encode(), len(texts)
    old = _french(found)
    for entry in old:
        entry.obsolete = entry.msgid not in texts
    known = {entry.msgid for entry in old}
    new_ones = [text for text in texts if text not in known]
    old.extend(polib.POEntry(msgid=text) for text in new_ones)
    return f"{old}\n".encode(), len(new_ones)


def french_without(found: Exercise, hidden: str) -> bytes:
    """Return the fr.po of an exercise without the texts that only the file ``hidden`` has."""
    kept = {text for text, file in texts_of(found) if file != hidden}
    entries = _french(found)
    for entry in [entry for entry in entries if entry.msgid not in kept]:
        entries.remove(entry)
    return f"{entries}\n".encode()


def _french(found: Exercise) -> Any:
    """Return the entries of an exercise's fr.po; InputError if it is no catalogue."""
    import polib

    path = found.folder / FRENCH
    try:
        return polib.pofile(str(path), encoding="utf-8", wrapwidth=WIDTH)
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(
            "{path}: not a catalogue of texts: {error}", path=path, error=error
        ) from None
