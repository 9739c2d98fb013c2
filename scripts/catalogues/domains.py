"""The domains: which texts each catalogue translates.

A domain is a name and a function that yields its texts. The name is the catalogue's path below
locale/LANGUAGE of its package, without .po.
"""

import ast
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import notebooks
from catalogue import Message

from landscape.course import program_texts
from landscape.course.ladder import PROGRAMS, SECTIONS, Lesson, lessons, paragraphs
from landscape.course.lecture import plan
from landscape.course.own_exercise import scaffold_texts
from landscape.course.pages import BY_CELL, blocks, cells, has_words, page
from landscape.course.shelf import NAMES, exercise, texts_of
from landscape.gallery import flyover_captions
from landscape.gallery.page import FIXES_TEXT, INTRODUCTION, PARTS
from landscape.gallery.panels import panels
from landscape.gallery.scene_captions import INTRODUCTIONS, PAIRS_TEXT, STEPS, VIEW_TEXTS
from landscape.island.fixes import FIXES
from landscape.scene.scene import SCENES, scene
from landscape.voxel.blocks import BLOCKS
from landscape.walk.settings_list import rows

ROOT = Path(__file__).resolve().parents[2]

DOCUMENTS = (
    "README.md",
    "docs/gate.md",
    "docs/frame.md",
    "docs/why.md",
    "docs/black.md",
    "docs/programs.md",
    "docs/lecture.md",
    "docs/glut.md",
    "docs/sheet.md",
    "docs/course.md",
    "docs/notebooks.md",
    "docs/films.md",
    "docs/sound.md",
    "docs/exercises.md",
    "docs/assets.md",
    "docs/performance.md",
    "docs/errata.md",
    "docs/voxels.md",
    "docs/flyover.md",
    "docs/environments.md",
    "docs/documents.md",
    "docs/reading.md",
)
"""The documents that are translated, below the root of the project."""

TABLES = ("Texts", "Phrases")
"""The annotations of tables of texts, in framelens/base/texts.py."""


def in_code(*patterns: str) -> Iterator[Message]:
    """Yield the texts of the modules that match these patterns, below the root of the project."""
    for path in sorted({path for pattern in patterns for path in ROOT.glob(pattern)}):
        source = path.relative_to(ROOT).as_posix()
        code = path.read_text(encoding="utf-8")
        # Reading a file as text first saves parsing those without any.
        tables = _tables(ast.parse(code)) if any(f": {name} =" in code for name in TABLES) else ()
        for text, context in (*program_texts.marked(code), *tables):
            yield Message(text, source, context)


ERRORS = (
    "EngineGone",
    "InputError",
    "NoOpenGLError",
    "ProgramError",
    "StateError",
    "TooLarge",
    "WorkerKilled",
    "Message",
    "refusal",
)
"""What takes a template of framelens.base.errors, as its first argument."""


ERROR_TABLES = ("framelens/base/errors.py", "framelens/commands/parser.py")
"""The modules whose tables are what others say of errors: the operating system, argparse."""


def errors(package: str) -> Iterator[Message]:
    """Yield the templates of a package's errors."""
    for path in sorted((ROOT / package).rglob("*.py")):
        written = path.read_text(encoding="utf-8")
        source = path.relative_to(ROOT).as_posix()
        if source not in ERROR_TABLES and not any(f"{name}(" in written for name in ERRORS):
            continue
        code = ast.parse(written)
        calls = [node for node in ast.walk(code) if isinstance(node, ast.Call) and node.args]
        named = [node for node in code.body if isinstance(node, ast.Assign)]
        constants = {ast.unparse(node.targets[0]): node.value for node in named}
        for call in sorted(calls, key=lambda call: (call.lineno, call.col_offset)):
            if ast.unparse(call.func) in ERRORS:
                template = ast.unparse(call.args[0])
                text = constants.get(template, call.args[0])
                if isinstance(text, ast.Constant):
                    yield Message(text.value, source)
        if source in ERROR_TABLES:
            yield from (Message(text, source) for text, _key in _tables(code))


def _tables(code: ast.Module) -> Iterator[tuple[str, str]]:
    """Yield the texts of a module's tables, each with its key if it has one."""
    for node in code.body:
        if not isinstance(node, ast.AnnAssign) or not isinstance(node.annotation, ast.Name):
            continue
        if node.annotation.id not in TABLES or node.value is None:
            continue
        table = ast.literal_eval(node.value)
        keyed = table.items() if isinstance(table, dict) else (("", text) for text in table)
        yield from ((text, key) for key, text in keyed)


def in_lesson(lesson: Lesson) -> Iterator[Message]:
    """Yield the texts of a lesson: its docstring, its comments, what it shows, and its page."""
    source = lesson.file.relative_to(ROOT).as_posix()
    own = program_texts.texts(lesson.file.read_text(encoding="utf-8"))
    for text in (lesson.title, *lesson.about, *own):
        yield Message(text, source)
    for block in page(lesson):
        if not block.is_code and block.text not in SECTIONS:
            yield Message(block.text, lesson.page.relative_to(ROOT).as_posix())


def in_programs() -> Iterator[Message]:
    """Yield the texts of the lessons' plain programs: docstrings, comments, titles of windows."""
    for path in sorted(PROGRAMS.glob("*.py")):
        source = path.read_text(encoding="utf-8")
        about = paragraphs(ast.get_docstring(ast.parse(source)) or "")
        for text in (*about, *program_texts.texts(source)):
            yield Message(text, path.relative_to(ROOT).as_posix())


def in_exercise(name: str) -> Iterator[Message]:
    """Yield the texts of an exercise: its title, its task, those of its program, and its tests."""
    for text, file in texts_of(exercise(name)):
        yield Message(text, f"landscape/course/exercises/{name}/{file}")


def in_scaffold() -> Iterator[Message]:
    """Yield the texts of the exercise that a lecturer's own begins as."""
    for text, file in scaffold_texts():
        yield Message(text, f"landscape/course/scaffold/{file}")


def in_lectures() -> Iterator[Message]:
    """Yield the texts of the lectures that come with the program."""
    for path in sorted(plan.COURSE.parent.glob("*.txt")):
        for text in plan.texts(plan.read(path)):
            yield Message(text, path.relative_to(ROOT).as_posix())


def settings() -> Iterator[Message]:
    """Yield what the list of settings says of each scene's: groups, what they do, units."""
    for kind in map(scene, SCENES):
        for row in rows(type(kind.settings)):
            value = getattr(kind.settings, row.group)
            owner = type(value if "." in row.key else kind.settings)
            source = owner.__module__.replace(".", "/") + ".py"
            yield Message(row.group, source)
            yield Message(row.item.does, source, row.key)
            if row.item.unit:
                yield Message(row.item.unit, source)


def scenes() -> Iterator[Message]:
    """Yield what each scene is called, and calls its own: doors, blocks, what keys change."""
    yield from in_code("landscape/island/island.py", "landscape/hall/*.py", "landscape/voxel/*.py")
    for each in BLOCKS[1:]:
        yield Message(each.name, "landscape/voxel/blocks.py")
    for kind in map(scene, SCENES):
        yield Message(kind.title, SCENES[kind.name].replace(".", "/") + ".py")
        for toggle in (*kind.digits.values(), *kind.letters.values()):
            yield Message(toggle.name, SCENES[kind.name].replace(".", "/") + ".py", toggle.setting)


def fixes() -> Iterator[Message]:
    """Yield the titles of each scene's fixes."""
    for kind in map(scene, SCENES):
        for fix in kind.fixes:
            source = type(fix).__module__.rpartition(".")[0].replace(".", "/")
            yield Message(fix.title, source, fix.name)


def gallery() -> Iterator[Message]:
    """Yield the texts of the gallery and what each view shows, except the titles of the fixes."""
    source = "landscape/gallery"
    yield from in_code("landscape/gallery/page.py", "landscape/gallery/scene_page.py")
    for kind in map(scene, SCENES):
        where = SCENES[kind.name].replace(".", "/") + ".py"
        yield from (Message(view.shows, where) for view in kind.views.values())
    for name in VIEW_TEXTS:
        kind = scene(name)
        texts = [*INTRODUCTIONS[name], PAIRS_TEXT]
        for view, captions in VIEW_TEXTS[name].items():
            texts += [kind.views[view].shows, *captions]
        for heading, text, steps in STEPS.get(name, ()):
            texts += [heading, text]
            for step in steps:
                texts += [step.title, step.seen, step.look]
        for fix in kind.fixes:
            texts += [fix.flaw, *fix.seen, fix.look, fix.how]
        yield from (Message(text, source) for text in texts)

    yield from flyover_gallery()
    yield from (Message(line, source) for line in INTRODUCTION if line)
    for part in PARTS:
        yield from (Message(text, source) for text in (part.heading, part.text))
    for pair in FIXES_TEXT.items():
        yield from (Message(text, source) for text in pair)
    for panel in panels():
        if panel.name.startswith("fig"):
            yield from (Message(text, source) for text in (panel.title, panel.seen, panel.look))
    for fix in FIXES:
        for text in (fix.flaw, *fix.seen, fix.look, fix.how):
            yield Message(text, "landscape/island/fixes.py")


def flyover_gallery() -> Iterator[Message]:
    """Yield the texts of the fly-over's page."""
    said, source = flyover_captions, "landscape/gallery/flyover_captions.py"
    texts = [*said.INTRODUCTION]
    for shot in said.VIEWS:
        texts += [shot.title, shot.seen, shot.look]
    texts += [said.STEPS_HEADING, said.STEPS_TEXT]
    for shot in said.STEPS:
        texts += [shot.title, shot.seen, shot.look]
    texts += [said.PAIRS_HEADING, said.PAIRS_TEXT]
    for pair in said.PAIRS:
        texts += [pair.flaw, *pair.seen, pair.look, pair.how]
    yield from (Message(text, source) for text in texts)
    yield from (Message(pair.title, source, pair.name) for pair in said.PAIRS)


def in_document(name: str) -> Iterator[Message]:
    """Yield the texts of a document in Markdown, a block each; of some, rows cell by cell."""
    for block in blocks((ROOT / name).read_text(encoding="utf-8")):
        if block.is_row and Path(name).stem in BY_CELL:
            yield from (Message(cell, name) for cell in cells(block.text) if has_words(cell))
        elif not block.is_code:
            yield Message(block.text, name)


def in_notebooks() -> Iterator[Message]:
    """Yield the texts of the notebooks of docs/notebooks."""
    yield from (Message(text, source) for text, source in notebooks.texts(ROOT))


COURSE = (
    "landscape/course/*.py",
    "landscape/course/grader/*.py",
    "landscape/course/lecture/*.py",
    "landscape/course/roster/*.py",
    "landscape/cli.py",
    "landscape/commands/*.py",
    "landscape/notebook/*.py",
)

IN_FRAMELENS = ("calls", "errors", "inspector", "strip", "why")
"""The domains whose catalogues come with framelens; the others come with landscape."""

DOMAINS: dict[str, Callable[[], Iterable[Message]]] = {
    "errors": lambda: errors("framelens"),
    "landscape_errors": lambda: errors("landscape"),
    "calls": lambda: in_code("framelens/spec/*.py", "framelens/tape/*.py"),
    "fixes": fixes,
    "scenes": scenes,
    "settings": settings,
    "inspector": lambda: in_code("framelens/inspector/*.py"),
    "strip": lambda: in_code("framelens/report/*.py"),
    "why": lambda: in_code("framelens/why/*.py"),
    "window": lambda: in_code("landscape/walk/*.py"),
    "film": lambda: in_code("landscape/film/*.py"),
    "course": lambda: (*in_code(*COURSE), *in_lectures()),
    "programs": in_programs,
    "scaffold": in_scaffold,
    "site": lambda: in_code("scripts/site/*.py"),
    "gallery": gallery,
    "notebook_cells": in_notebooks,
    **{f"exercises/{name}": partial(in_exercise, name) for name in NAMES},
    **{f"docs/{Path(name).stem}": partial(in_document, name) for name in DOCUMENTS},
    **{f"lessons/{lesson.name}": partial(in_lesson, lesson) for lesson in lessons()},
}
