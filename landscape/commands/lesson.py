"""`landscape lesson`: lists the lessons; runs, draws, copies or inspects one."""

import argparse
import json
import os
import re
import sys
from pathlib import Path

from framelens.base.errors import InputError, NoOpenGLError
from framelens.base.output import check_output_folder, check_writable, save_png, write_all
from framelens.base.texts import LANGUAGES, Phrases, choose, translator
from framelens.base.texts import marked as _
from framelens.commands import option_values
from framelens.commands.parser import backend_option, language_option
from framelens.gl import display
from framelens.program.program_events import presses
from landscape.course.grader.picture import pictures
from landscape.course.ladder import (
    LESSONS,
    PROGRAMS,
    TOPICS,
    Lesson,
    lesson,
    lessons,
    program_files,
)
from landscape.course.language import WIDTH, described, program_described, translated
from landscape.course.own_lesson import own_lesson
from landscape.course.pages import wrapped

EXAMPLE = "matrix_stack"
LESSON = _("a lesson, or the file of one of your own; without one, the lessons are listed")
COPY = _(
    "copy it, with what it reads and its plain programs, into a folder; default: the current one"
)
HEADING: Phrases = ("{topic}:",)
ADVICE: Phrases = (
    "The tools draw frame 0 of a copied lesson, unless told otherwise; its picture is of the frame "
    "that its line `# picture:` names:",
)
WHY_KEY: Phrases = (
    "F1: why the pixel under the pointer looks as it does. F12: the inspector, with all calls.",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", nargs="?", default="", metavar="NAME|FILE.py", help=LESSON)
    what = parser.add_mutually_exclusive_group()
    what.add_argument(
        "--out",
        type=option_values.pathname,
        metavar="FILE.png",
        help=_("draw it to a file, without a screen"),
    )
    what.add_argument(
        "--copy", type=option_values.pathname, nargs="?", const=Path(), metavar="DIR", help=COPY
    )
    what.add_argument("--inspect", action="store_true", help=_("run it under the inspector (F12)"))
    what.add_argument("--json", action="store_true", help=_("print what is known of it as JSON"))
    language_option(parser, "language of the texts")
    backend_option(parser)


def run(options: argparse.Namespace) -> int:
    """Do what the command line asks; return the exit status."""
    if not options.name:
        _list(options)
        return 0
    own = options.name.endswith(".py")
    chosen = own_lesson(Path(options.name)) if own else lesson(options.name)
    if options.out is not None:
        picture(chosen, options.out, options.backend)
        print(options.out)
    elif options.copy is not None:
        if own:
            raise InputError(
                "--copy: expected a lesson of the course, not {name}", name=options.name
            )
        for path in copy(chosen, options.copy):
            print(path)
    elif options.inspect:
        from framelens.inspector.program_inspector import inspect

        inspect(str(chosen.file), language=options.lang)
    elif options.json:
        print(json.dumps(chosen.as_json(), indent=1))
    else:
        return show(chosen)
    return 0


def _list(options: argparse.Namespace) -> None:
    if options.json:
        print(json.dumps([each.as_json() for each in lessons()], indent=1))
        return
    topic = ""
    for each in lessons():
        if each.topic != topic:
            topic = each.topic
            print(translated(HEADING[0]).format(topic=translated(TOPICS[topic])))
        print(f"  {each.name:18} {translated(each.title)}")
    shown = lesson("matrix_stack")
    print(f"\n{wrapped('', translated(ADVICE[0]), WIDTH)}")
    print(f"  landscape strip {shown.file.name} --frame {shown.frame}")


def show(chosen: Lesson) -> int:
    """Run a lesson in a window until it ends; return the exit status.

    F1 in it says why the pixel under the pointer looks as it does, in the inspector.
    """
    if sys.platform == "linux":
        kind, reason = display.choose(os.environ)
        if not kind:
            raise NoOpenGLError(
                "there is no screen to open a window on ({reason}): use --out FILE.png, "
                "or xvfb-run",
                reason=reason,
            )
    said = translator(choose(os.environ), "course", "lessons", chosen.file.parent)
    for line in chosen.about:
        print(said(line), file=sys.stderr)
    from framelens.inspector.program_inspector import inspect

    print(translated(WHY_KEY[0]), file=sys.stderr)
    for line in inspect(str(chosen.file), language=choose(os.environ), closed=True):
        print(line, file=sys.stderr)
    return 0


def picture(chosen: Lesson, out: Path, backend: str = "auto") -> None:
    """Write a lesson's picture to a PNG file; InputError if it cannot be written.

    ``out`` may also be a device or a pipe.
    """
    if out.suffix.lower() != ".png" and (out.is_file() or not out.exists()):
        raise InputError("--out {out}: expected a name ending in .png", out=out)
    check_writable(out, "--out ")
    (drawn,) = pictures(chosen.file, [chosen.frame], presses(chosen.pressed), backend)
    save_png(drawn, out)


def copy(chosen: Lesson, folder: Path) -> list[Path]:
    """Copy a lesson, its data and its programs into a folder, which is made; return the copies.

    InputError, and nothing is copied, if one of the files is there already with another content.
    The modules that the lesson imports may be there in another language.
    """
    check_output_folder(folder, "--copy ")
    language = choose(os.environ)
    copies, known = {}, {}
    for file in needed(chosen):
        path = folder / file.relative_to(LESSONS)
        copies[path] = _in_language(file, language)
        others = () if file == chosen.file else LANGUAGES
        known[path] = {copies[path], *(_in_language(file, other) for other in others)}
    for path, contents in known.items():
        if path.exists() and (not path.is_file() or path.read_bytes() not in contents):
            raise InputError(
                "{path}: is there already, changed; expected a folder without it", path=path
            )
    write_all({path: content for path, content in copies.items() if not path.exists()})
    return list(copies)


def _in_language(file: Path, language: str) -> bytes:
    """Return the content of a lesson's file; a program's texts are in a language."""
    if file.suffix != ".py":
        return file.read_bytes()
    if file.parent == PROGRAMS:
        return program_described(file, language).encode()
    return described(lesson(file.stem), language).encode()


def needed(chosen: Lesson) -> list[Path]:
    """Return the files of a lesson: itself, what it imports, its plain programs, and their data."""
    programs = [chosen.file, *(file for name in chosen.programs for file in program_files(name))]
    if re.search("^from text import", chosen.file.read_text(encoding="utf-8"), re.MULTILINE):
        programs.append(LESSONS / "text.py")
    texts = "".join(program.read_text(encoding="utf-8") for program in programs)
    data = [LESSONS / "data" / name for name in re.findall(r'"([\w.]+)"', texts)]
    return [*programs, *(path for path in dict.fromkeys(data) if path.is_file())]
