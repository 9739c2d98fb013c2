"""The texts that users see, in their languages, and the script that checks the translations."""

import os
import runpy
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest
from commands import TESTS, Done, environment, python

from framelens.base import texts as translations
from framelens.base.errors import InputError
from framelens.base.packages import PACKAGES, Package
from framelens.base.texts import reworded, translator
from landscape.gallery.scene_captions import VIEW_TEXTS

SCRIPT = TESTS.parent / "scripts" / "catalogues"

HEAD = 'msgid ""\nmsgstr "Content-Type: text/plain; charset=utf-8\\n"\n\n'
FOG = 'msgid "fog"\nmsgstr "brouillard"\n\n'
ON = 'msgid "on"\nmsgstr "oui"\n\n'
FIXED = 'msgctxt "fix.on"\nmsgid "on"\nmsgstr "activée"\n\n'
CALLS = 'msgid "{n} calls"\nmsgstr "{n} appels"\n\n'
ROW = 'msgid "| [sun](a.md) | 1 |"\nmsgstr "| [soleil](a.fr.md) | 1 |"\n\n'


def run(*words: str) -> Done:
    """Run scripts/catalogues."""
    code = "import runpy, sys; del sys.argv[0]; runpy.run_path(sys.argv[0], None, '__main__')"
    return python(code, str(SCRIPT), *words)


def test_every_text_is_translated_and_no_translation_is_stale() -> None:
    done = run("check")
    assert (done.status, done.err) == (0, ""), done.out
    assert done.out == "every text is translated\n"


@pytest.mark.posix_only("it has no SIGPIPE, which ends the script")
def test_a_reader_that_closes_the_pipe_sees_no_traceback() -> None:
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "w") as closed:
        command = [sys.executable, str(SCRIPT), "--help"]  # it takes a second less than a check
        done = subprocess.run(command, stdout=closed, stderr=subprocess.PIPE, env=environment())
    assert (done.returncode, done.stderr) == (-signal.SIGPIPE, b"")


@pytest.fixture
def run_here(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., Done]:
    """Runs scripts/catalogues in this process, with the domains window and film alone."""
    monkeypatch.syspath_prepend(str(SCRIPT))
    import domains

    few = {name: domains.DOMAINS[name] for name in ("window", "film")}
    monkeypatch.setattr(domains, "DOMAINS", few)

    def run_once(*words: str) -> Done:
        monkeypatch.setattr(sys, "argv", [str(SCRIPT), *words])
        status: object = 0
        pipes = signal.getsignal(signal.SIGPIPE) if hasattr(signal, "SIGPIPE") else None
        try:
            runpy.run_path(str(SCRIPT / "__main__.py"), None, "__main__")
        except SystemExit as end:
            status = end.code
        finally:
            if pipes is not None:
                signal.signal(signal.SIGPIPE, pipes)
        seen = capsys.readouterr()
        said = f"{status}\n" if isinstance(status, str) else ""
        return Done(1 if said else int(str(status)), seen.out, seen.err + said)

    return run_once


def test_the_check_fails_on_a_fault_and_an_update_adds_only_what_is_missing(
    tmp_path: Path, run_here: Callable[..., Done]
) -> None:
    (tmp_path / "fr").mkdir()
    for name in ("window", "film"):
        shutil.copy(PACKAGES[-1].locale / "fr" / f"{name}.po", tmp_path / "fr")
    path = tmp_path / "fr" / "window.po"
    whole = path.read_text(encoding="utf-8")
    entry = f"#: landscape/walk/words.py\n{FOG}"
    stale = FOG.replace("fog", "haze")
    path.write_text(stale + whole.replace(entry, ""), encoding="utf-8")
    (tmp_path / "fr" / "none.po").write_text(HEAD)

    done = run_here("check", "--locale", str(tmp_path))
    missing = f"{path}: missing: 'fog', from landscape/walk/words.py"
    stranger = f"{path.with_name('none.po')}: stale: no texts belong to it"
    assert (done.status, done.out.splitlines()) == (
        1,
        [missing, f"{path}: stale: 'haze'", stranger],
    )

    done = run_here("update", "--locale", str(tmp_path))
    removed = f"{path}: removed: 'haze': 'brouillard'"
    untranslated = f"{path}: untranslated: 'fog'"
    assert (done.status, done.out.splitlines()) == (0, [removed, untranslated, stranger])
    left = path.read_text(encoding="utf-8")
    assert left == whole.replace(entry, entry.replace("brouillard", ""))

    path.write_text("msgtext\n")
    done = run_here("update", "--locale", str(tmp_path))
    assert done.status == 1 and done.err.startswith(f"catalogues: {path}: not a catalogue: ")


@pytest.fixture
def catalogue(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script's module for one catalogue."""
    monkeypatch.syspath_prepend(str(SCRIPT))
    import catalogue

    return catalogue


@pytest.mark.parametrize(
    ("entries", "expected"),
    [
        (FOG + ON + CALLS, []),
        (FOG + ON + FIXED + CALLS, []),
        (ON + CALLS, ["missing: 'fog', from b.py"]),
        (FOG + FIXED + CALLS, ["missing: 'on', from a.py, b.py"]),
        (FOG + ON + CALLS + ROW, []),
        (FOG + ON + CALLS + ROW.replace("a.fr", "b"), ["not in both languages: a.md, b.md: "]),
        (FOG + ON + CALLS + ROW.replace("soleil]", "|"), ["not in both languages: 3 times |, 4 "]),
        (FOG.replace("brouillard", "") + ON + CALLS, ["untranslated: 'fog'"]),
        ("#, fuzzy\n" + FOG + ON + CALLS, ["fuzzy: 'fog'"]),
        (FOG + FOG + ON + CALLS, ["more than one entry: 'fog'"] * 2),
        (FOG + ON + CALLS + FOG.replace("fog", "sun"), ["stale: 'sun'"]),
        (FOG + ON + CALLS + FIXED.replace("fix", "sun"), ["stale: 'on', for sun.on"]),
        (FOG + ON + CALLS.replace("{n} a", "{a} a"), ["not in both languages: {a, n}: "]),
        (FOG + ON + CALLS.replace("{n} a", "{ a"), ["not in both languages: {n, { appels}: "]),
        ("msgtext\n", ["not a catalogue: "]),
    ],
)
def test_each_kind_of_fault_of_a_catalogue_is_named(
    entries: str, expected: list[str], catalogue: ModuleType, tmp_path: Path
) -> None:
    path = tmp_path / "window.po"
    path.write_text(HEAD + entries, encoding="utf-8")
    texts = [
        catalogue.Message("fog", "b.py"),
        catalogue.Message("on", "a.py", "fix.on"),
        catalogue.Message("on", "b.py"),
        catalogue.Message("{n} calls", "a.py"),
    ]
    if ROW[:10] in entries:
        texts.append(catalogue.Message("| [sun](a.md) | 1 |", "a.md"))
    found = [line.removeprefix(f"{path}: ") for line in catalogue.faults(path, texts)]
    assert len(found) == len(expected), found
    for line, start in zip(found, expected, strict=True):
        assert line.startswith(start)


README = """\
# Fog

![A picture](a.png)

    code("a ; b")

| Key | What |
|---|---|
| `F` | fog |

It hides what is far away, `and  code` is left, as is
[a long link](docs/a.md).

- Thick
- Thin
"""
LISEZMOI = """\
# Brouillard

![A picture](a.png)

    code("a ; b")

| Key | What |
|---|---|
| `F` | brouillard_! |

Il cache le lointain -
`le code` reste, comme
[un long lien](docs/a.md) 2.
Ici.

- Épais et très dense, à
  ne plus rien y voir
- Thin
"""


def test_a_new_text_is_translated_as_other_catalogues_do_if_they_agree(
    catalogue: ModuleType, tmp_path: Path
) -> None:
    def written(name: str, *translated: tuple[str, str]) -> Path:
        path = tmp_path / f"{name}.po"
        entries = (f'msgid "{text}"\nmsgstr "{french}"\n\n' for text, french in translated)
        path.write_text(HEAD + "".join(entries), encoding="utf-8")
        return path

    agreed, disputed, short = "a line of four words", "this one has two of them", "fog"
    one = written("one", (agreed, "une ligne"), (disputed, "celle-ci"), (short, "brouillard"))
    two = written("two", (agreed, "une ligne"), (disputed, "celui-ci"))
    elsewhere = catalogue.known([one, two, tmp_path / "none.po"])
    assert elsewhere == {agreed: "une ligne"}

    new = tmp_path / "new.po"
    texts = [catalogue.Message(text, "a.py") for text in (agreed, disputed, short)]
    assert catalogue.update(new, "fr", texts, elsewhere) == []
    assert [line.split(": ", 1)[1] for line in catalogue.faults(new, texts)] == [
        f"untranslated: {disputed!r}",
        f"untranslated: {short!r}",
    ]


def test_readme_is_written_in_french_with_its_code_tables_and_pictures_as_they_are(
    catalogue: ModuleType, locale: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import readme

    monkeypatch.setattr(readme, "ROOT", tmp_path)
    monkeypatch.setattr(readme, "page", lambda language: f"the gallery in {language}")
    monkeypatch.setattr(readme, "scene_page", lambda scene, language: f"{scene} in {language}")
    monkeypatch.setattr(readme, "flyover_page", lambda language: f"the flights in {language}")
    monkeypatch.setattr(readme.notebooks, "NAMES", ())
    monkeypatch.setattr(readme, "WIDTH", 24)
    french = {
        "Fog": "Brouillard",
        "| `F` | fog |": "| `F` | brouillard ! |",
        "It hides what is far away, `and code` is left, as is [a long link](docs/a.md).": (
            "Il cache le lointain - `le code` reste, comme [un long lien](docs/a.md) 2. Ici."
        ),
        "Thick": "Épais et très dense, à ne plus rien y voir",
    }
    entries = (f'msgid "{text}"\nmsgstr "{other}"\n\n' for text, other in french.items())
    (locale / "docs").mkdir()
    (locale / "docs" / "README.po").write_text(HEAD + "".join(entries), encoding="utf-8")
    (tmp_path / "README.md").write_text(README)
    kept = tmp_path / "screenshots"
    folders = [tmp_path, kept, *(kept / name for name in (*VIEW_TEXTS, "flyover"))]
    for folder in folders[2:]:
        folder.mkdir(parents=True)
    path, gallery, hall, *others = (each / "README.fr.md" for each in folders)
    told = "stale: scripts/catalogues update writes it"
    stale = [path, gallery, hall, *others]
    assert list(readme.stale("fr")) == [f"{each}: {told}" for each in stale]
    readme.write("fr")
    assert gallery.read_text(encoding="utf-8") == "the gallery in fr"
    assert hall.read_text(encoding="utf-8") == "hall in fr"
    assert [each.read_text(encoding="utf-8") for each in others] == [
        "voxel in fr",
        "the flights in fr",
    ]
    assert path.read_text(encoding="utf-8") == LISEZMOI.replace("_", "\u00a0")
    assert list(readme.stale("fr")) == []
    (tmp_path / "README.md").write_text(README.replace("Thin", "Light"))
    assert len(list(readme.stale("fr"))) == 1


def test_texts_are_found_in_calls_and_in_annotated_tables(
    catalogue: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import domains

    monkeypatch.setattr(domains, "ROOT", tmp_path)
    (tmp_path / "page.py").write_text(
        'def page(_):\n    return _("depth"), _("a " "sum", "page"), _(key), text("no")\n'
        "TITLE = f\"## {_('first')}\"\n"
        'WORDS: Texts = {"on": "on", "rest": "and " "so on"}\nPARTS: Phrases = ("is on", "is")\n'
        'NAMES: dict[str, str] = {"fog": "no"}\n'
    )
    found = {(message.text, message.context) for message in domains.in_code("*.py")}
    in_calls = {("depth", ""), ("a sum", "page"), ("first", "")}
    assert found == in_calls | {("on", "on"), ("and so on", "rest"), ("is on", ""), ("is", "")}


@pytest.fixture
def locale(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of French catalogues, in place of the program's own."""
    monkeypatch.setattr(translations, "PACKAGES", [Package("own", tmp_path)])
    translations._catalogue.cache_clear()
    (tmp_path / "locale" / "fr").mkdir(parents=True)
    yield tmp_path / "locale" / "fr"
    translations._catalogue.cache_clear()


def test_a_text_is_translated_for_its_context_else_for_any_else_it_stays(locale: Path) -> None:
    fuzzy = "#, fuzzy\n" + FOG.replace("fog", "haze")
    (locale / "words.po").write_text(HEAD + FOG + ON + FIXED + fuzzy, encoding="utf-8")
    french, english = translator("fr", "words"), translator("en", "words")
    assert french("on") == french("on", "list.on") == "oui"
    assert french("on", "fix.on") == "activée"
    assert [english("on", "fix.on"), french("sun"), french("haze")] == ["on", "sun", "haze"]
    assert translator("de", "words")("fog") == translator("../fr", "words")("fog") == "fog"


def test_domains_are_looked_up_in_their_order_and_a_domain_may_be_a_folder(locale: Path) -> None:
    (locale / "lessons").mkdir()
    (locale / "words.po").write_text(HEAD + ON, encoding="utf-8")
    (locale / "lessons" / "one.po").write_text(HEAD + FOG, encoding="utf-8")
    (locale / "lessons" / "two.po").write_text(HEAD + FIXED + CALLS, encoding="utf-8")
    found = translator("fr", "words", "lessons")
    assert [found(text) for text in ("fog", "{n} calls")] == ["brouillard", "{n} appels"]
    assert found("on", "fix.on") == "oui"
    assert translator("fr", "lessons", "words")("on", "fix.on") == "activée"
    assert translator("fr", "lessons/two")("fog") == translator("fr", "none")("fog") == "fog"


def test_french_is_typeset_with_no_break_spaces(locale: Path) -> None:
    entry = 'msgid "fix"\nmsgstr "« {title} » : fait ; vraiment ? 1 500 000 fois en 2006"\n'
    (locale / "words.po").write_text(HEAD + entry, encoding="utf-8")
    expected = "«_{title}_»_: fait_; vraiment_? 1_500_000 fois en 2006".replace("_", "\u00a0")
    assert translator("fr", "words")("fix") == expected


def test_french_has_its_apostrophes_but_not_in_code_or_for_quotes_and_primes(locale: Path) -> None:
    french = "l'eau, l'`x'y`, qu'« ici », l'« œil », 'mot', P'"
    (locale / "words.po").write_text(
        HEAD + f'msgid "fix"\nmsgstr "{french}"\n\nmsgid "on"\nmsgstr "P\'"\n', encoding="utf-8"
    )
    set_ = translator("fr", "words")
    expected = "l’eau, l’`x'y`, qu’«_ici_», l’«_œil_», 'mot', P'".replace("_", "\u00a0")
    assert (set_("fix"), set_("on")) == (expected, "P'")


def test_code_in_french_is_left_as_it_is(locale: Path) -> None:
    entries = (
        'msgid "fix"\nmsgstr "`a ? b : 1 000` : oui"\n\nmsgid "on"\nmsgstr "un ` seul : oui"\n'
    )
    (locale / "words.po").write_text(HEAD + entries, encoding="utf-8")
    french = translator("fr", "words")
    assert french("fix") == "`a ? b : 1 000`\u00a0: oui"
    assert french("on") == "un ` seul\u00a0: oui"


def test_a_damaged_catalogue_is_refused_in_one_line(locale: Path) -> None:
    (locale / "words.po").write_text("msgtext\n")
    (locale / "latin.po").write_bytes('msgid "fog"\nmsgstr "éé"\n'.encode("latin-1"))
    for name in ("words", "latin"):
        with pytest.raises(InputError, match=rf"{name}\.po: not a catalogue of texts: .*$"):
            translator("fr", name)("fog")


def test_a_sentence_is_reworded_phrase_by_phrase(locale: Path) -> None:
    french = {"is": "=", "is on": "= oui", "a:": "un :"}
    entries = (f'msgid "{text}"\nmsgstr "{other}"\n\n' for text, other in french.items())
    (locale / "words.po").write_text(HEAD + "".join(entries), encoding="utf-8")
    phrases, sentence = ("is on", "is", "a:"), "a: this is on; is 2"
    assert reworded(sentence, phrases, translator("fr", "words")) == "un\u00a0: this = oui; = 2"
    assert reworded(sentence, phrases, translator("en", "words")) == sentence
