"""Where the exercises lie: those of the course, and a lecturer's own in any folder.

An exercise is a folder of its name, whoever wrote it; docs/exercises.md says what is in it. A
:class:`Shelf` finds it by its name, and by what a student's program says of itself.
"""

import ast
import codecs
import io
import re
import textwrap
import tokenize
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

from framelens.base.errors import InputError, short
from framelens.base.input import read_bounded
from framelens.base.texts import LANGUAGES, Translator, translator
from landscape.course import ladder, program_texts
from landscape.course.grader.grading import _
from landscape.course.not_python import not_python

FOLDER = Path(__file__).resolve().parent / "exercises"
# From one line to a page.
NAMES: tuple[str, ...] = (
    "missing_enable",
    "window",
    "first_drawing",
    "primitives",
    "winding",
    "mesh_tables",
    "homogeneous",
    "perspective",
    "look_at",
    "transform_order",
    "frames",
    "matrix_stack",
    "normals",
    "light_position",
    "materials",
    "texture_coordinates",
    "texture_filters",
    "textured_sphere",
    "fog",
    "blending_order",
    "clip_plane",
    "vertex_arrays",
    "billboard",
    "second_viewport",
    "mirror",
    "planar_shadow",
    "stencil_mirror",
    "hidden_faces",
    "shadow_map",
    "projection",
    "bresenham",
    "line_clipping",
    "back_faces",
    "bezier_path",
    "quad_tree",
    "level_of_detail",
    "floating_horizon",
)
HOLE = _("# Your code goes here.")
LEAD = _("Lessons to read first: {lessons}.")
MARKER = re.compile(r"^#\s*exercise:\s*(\S+)\s*$", re.MULTILINE)
LESSONS = re.compile(r"^# lessons: (.+)$", re.MULTILINE)
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,59}")  # of an exercise: a folder, and a file of Python
PARTS = ("start.py", "solution.py", "grading.py")  # what every exercise has
HIDDEN = "hidden.py"  # tests that students do not see: an exercise may have some
MOST_BYTES = 1 << 20  # chosen: of a program
SLOW = ("idna", "punycode")  # encodings that take hours for a long text
COLUMNS = 92  # chosen: of the task in a program


@dataclass(frozen=True)
class Exercise:
    """One exercise; ``title`` and ``task`` (its paragraphs) are in English.

    ``lessons``: the names of those that it builds on. ``folder``: that of its files. ``domain``:
    the catalogue of its texts; of a lecturer's own exercise the folder in which it lies.
    """

    name: str
    title: str
    task: tuple[str, ...]
    lessons: tuple[str, ...]
    folder: Path
    domain: str | Path

    @property
    def translate(self) -> "Translate":
        """A function that translates the exercise's texts."""
        return Translate(self.domain)


@dataclass(frozen=True)
class Translate:
    """The translators of an exercise's texts, and of the grader's own."""

    domain: str | Path

    def to(self, language: str) -> Translator:
        """Return the translator to a language."""
        return translator(language, self.domain, "course")


@dataclass(frozen=True)
class Shelf:
    """Exercises by name: those of a folder, if there is one, and those of the course.

    ``folder`` has a folder for each exercise, or is one exercise. Where both have an exercise of
    the same name, it is that of the folder.
    """

    folder: Path | None = None

    @cached_property
    def own(self) -> Mapping[str, Path]:
        """The folders of a lecturer's own exercises by their names."""
        if self.folder is None:
            return {}
        if not self.folder.is_dir():
            raise InputError("{folder}: expected a folder with exercises", folder=self.folder)
        root = self.folder.resolve()
        if _is_exercise(root):
            return {root.name: root}
        return {each.name: each for each in sorted(root.iterdir()) if _is_exercise(each)}

    @property
    def names(self) -> Sequence[str]:
        """The names of all exercises, the lecturer's own first."""
        return [*self.own, *(name for name in NAMES if name not in self.own)]

    def exercise(self, name: str) -> Exercise:
        """Return the exercise of a name; InputError lists the names, or says what is wrong."""
        if name in self.own:
            return read(name, self.own[name], self.own[name])
        if name not in NAMES:
            raise InputError(
                "{name}: expected an exercise, one of {names}",
                name=short(name),
                names=", ".join(self.names),
            )
        return _of_course(name)

    def named_in(self, path: Path) -> Exercise:
        """Return the exercise that a student's file is of, by its line `# exercise: NAME`."""
        if path.is_dir():
            raise InputError(
                "{path}: is a folder, expected a program written for an exercise", path=path
            )
        code = source(path)
        if not code.strip():
            raise InputError(
                "{path}: is empty, expected a program written for an exercise", path=path
            )
        names = MARKER.findall(code)
        if not names:
            raise InputError(
                "{path}: expected a line such as `# exercise: {names}`, which says of which "
                "exercise it is; `landscape exercise start` writes it",
                path=path,
                names=self.names[0],
            )

        if len(set(names)) > 1:
            raise InputError(
                "{path}: names two exercises, {first} and {second}; expected one",
                path=path,
                first=names[0],
                second=names[1],
            )
        if names[0] not in self.names:
            raise InputError(
                "{path}: {name}: expected an exercise of `landscape exercise list`; --exercises "
                "DIR finds those of a lecturer's own",
                path=path,
                name=short(names[0]),
            )

        return self.exercise(names[0])


COURSE = Shelf()


def _is_exercise(folder: Path) -> bool:
    """Return whether a folder is meant as an exercise: it has one of the files of one."""
    return NAME.fullmatch(folder.name) is not None and any(
        (folder / each).is_file() for each in PARTS
    )


@cache
def _of_course(name: str) -> Exercise:
    return read(name, FOLDER / name, f"exercises/{name}")


def exercise(name: str) -> Exercise:
    """Return an exercise of the course by its name; InputError lists the names."""
    return COURSE.exercise(name)


def source(path: Path) -> str:
    """Return the text of a Python program, in the encoding that it names; InputError if not."""
    data = read_bounded(path, MOST_BYTES)
    try:
        encoding, _lines = tokenize.detect_encoding(io.BytesIO(data).readline)
        if codecs.lookup(encoding).name in SLOW:
            raise ValueError(encoding)
        return data.decode(encoding)
    except (LookupError, SyntaxError, ValueError):  # LookupError: a codec of no text, as rot13
        raise InputError("{path}: is not text, expected a Python program", path=path) from None


def paragraphs(docstring: str) -> list[str]:
    """Return the paragraphs of a docstring, each on one line."""
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", docstring.strip())]


def read(name: str, folder: Path, domain: str | Path) -> Exercise:
    """Return the exercise of a folder; InputError says which of its files lacks what."""
    path = folder / "start.py"
    code = source(path)
    try:
        docstring = ast.get_docstring(ast.parse(code)) or ""
    except (SyntaxError, ValueError) as error:
        raise not_python(path, error) from None

    title, *task = paragraphs(docstring)
    if not code.startswith('"""') or not title or not task:
        raise InputError(
            '{path}: expected """ and the title in its first line, then an empty line and the task',
            path=path,
        )
    if MARKER.findall(code) != [name]:
        raise InputError("{path}: expected the line `# exercise: {name}`", path=path, name=name)
    if not any(translator(each, "course")(HOLE) in code for each in LANGUAGES):
        raise InputError(
            "{path}: expected the line `{hole}`, where students begin to write",
            path=path,
            hole=str(HOLE),
        )

    named = LESSONS.search(code)
    lessons = re.split(r",\s*", named[1].strip()) if named else []
    for each in lessons:
        if each not in ladder.NAMES:
            raise InputError(
                "{path}: # lessons: {name}: expected a lesson; `landscape lesson` lists them",
                path=path,
                name=short(each),
            )
    return Exercise(name, title, tuple(task), tuple(lessons), folder, domain)


def start(found: Exercise, language: str) -> str:
    """Return the program that a student starts from, with its task in a language."""
    code = source(found.folder / "start.py")
    translated = found.translate.to(language)
    texts = [translated(text) for text in (found.title, *found.task)]
    if found.lessons:
        texts.append(translated(LEAD).format(lessons=", ".join(found.lessons)))
    parts = [textwrap.fill(text, COLUMNS) for text in texts]
    # The names stay as they are: the language of OpenGL's is English.
    program = program_texts.translated(code[code.index('"""', 3) + 3 :], translated)
    return '"""' + "\n\n".join(parts) + '\n"""' + program.replace(HOLE, translated(HOLE))


def texts_of(found: Exercise) -> Iterator[tuple[str, str]]:
    """Yield the texts of an exercise that can be translated, each with its file's name."""
    program = source(found.folder / "start.py")
    for text in (found.title, *found.task, *program_texts.texts(program)):
        yield text, "start.py"
    for file in ("grading.py", HIDDEN):
        path = found.folder / file
        for text, _context in program_texts.marked(source(path)) if path.is_file() else ():
            yield text, file
