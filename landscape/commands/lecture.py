"""`landscape lecture`: shows the steps of a lecture in one window, or writes them to a file."""

import argparse
import os
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from framelens.base.errors import InputError, NoOpenGLError, short
from framelens.base.output import check_output_folder, check_writable, write_all, write_whole
from framelens.base.texts import LANGUAGES, choose, translator
from framelens.base.texts import marked as _
from framelens.commands import option_values
from framelens.commands.parser import language_option
from framelens.gl import display
from framelens.system.processes import cores
from landscape.course.lecture import texts
from landscape.course.lecture.copy import copied
from landscape.course.lecture.plan import COURSE, PAPERS, PICTURE, TEXT, VIEW, Lecture, course, read

if TYPE_CHECKING:
    from landscape.course.lecture.stage import Stage


EXAMPLE = "a.txt"
LECTURE = _(
    "a text file, see docs/lecture.md; first_course, see docs/course.md; or reflections; "
    "default: the whole course"
)
FORMATS = (".html", ".pdf")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument(
        "file", nargs="?", type=option_values.pathname, metavar="FILE", help=LECTURE
    )
    parser.add_argument(
        "--from", dest="begin", default="", metavar="NAME", help=_("begin at this step, or number")
    )
    parser.add_argument("--list", action="store_true", help=_("only print the steps"))

    parser.add_argument(
        "--size",
        type=option_values.size,
        metavar="WxH",
        help=_("in a window of this size, not on the whole screen"),
    )
    parser.add_argument(
        "--screen",
        type=option_values.count,
        metavar="N",
        help=_("which screen, if there are several; default: 1, the primary one"),
    )

    parser.add_argument(
        "--out",
        type=option_values.pathname,
        action="append",
        default=[],
        metavar="FILE.html|.pdf",
        help=_(
            "write the steps to one page of HTML, or to a PDF, instead of showing them; may be "
            "given several times"
        ),
    )
    parser.add_argument(
        "--paper",
        choices=PAPERS,
        help=_("of the PDF: slides, or a handout on A4 with the notes; default: 16:9"),
    )
    parser.add_argument(
        "--copy",
        type=option_values.pathname,
        nargs="?",
        const=Path(),
        metavar="DIR",
        help=_(
            "copy the lecture, with its pictures, into a folder, to change it: its words in the "
            "language of --lang; default: the current folder"
        ),
    )

    parser.add_argument(
        "-q", "--quiet", action="store_true", help=_("print no progress while a file is written")
    )
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Do what the command line asks; return the exit status."""
    lecture = read(_file(options.file)) if options.file else course()
    if options.copy is not None:
        print("\n".join(map(str, copy(_file(options.file or COURSE), options.copy))))
        return 0

    begin = _begin(lecture, options.begin)
    if options.out:
        write(lecture, options.out, options.paper, options.quiet)
        print("\n".join(map(str, options.out)))
        return 0

    if options.paper is not None:
        raise InputError("--paper: is for a PDF; expected --out FILE.pdf as well")
    if options.list:
        for name in ("size", "screen"):
            if getattr(options, name) is not None:
                raise InputError("--{name}: not with --list, which opens no window", name=name)
        for number, title, name in texts.listed(lecture)[begin:]:
            print(f"{number}  {name:18} {title}")
        return 0

    if sys.platform == "linux":
        kind, reason = display.choose(os.environ)
        if not kind:
            raise NoOpenGLError(
                "there is no screen to open a window on ({reason}): use --list, or xvfb-run",
                reason=reason,
            )

    show(lecture, begin, options.size, options.screen or 1)
    return 0


def _file(asked: Path) -> Path:
    """Return a lecture's file: one that exists, or one that comes with the program, by its name."""
    shipped = COURSE.parent / f"{asked}.txt"
    return shipped if len(asked.parts) == 1 and not asked.exists() and shipped.exists() else asked


def _begin(lecture: Lecture, asked: str) -> int:
    """Return the index of the step that is asked for by its name or number."""
    if not asked:
        return 0
    names = [step.name for step in lecture.steps]
    if asked in names:
        return names.index(asked)
    if asked.isascii() and asked.isdigit() and 1 <= int(asked[:9]) <= len(names):
        return int(asked) - 1
    raise InputError(
        "--from {asked}: expected the name of a step, or a number from 1 to {count}; "
        "--list lists them",
        asked=short(asked),
        count=len(names),
    )


def copy(file: Path, folder: Path) -> list[Path]:
    """Copy a lecture that comes with the program into a folder, which is made; return the copies.

    InputError, and nothing is copied, where it is another lecture, or a file of these names is
    there already with another content.
    """
    if file.resolve().parent != COURSE.parent:
        names = ", ".join(sorted(each.stem for each in COURSE.parent.glob("*.txt")))
        raise InputError("--copy: expected one of {names}, not {file}", names=names, file=file)
    check_output_folder(folder, "--copy ")
    language = choose(os.environ)
    words = None if language == LANGUAGES[0] else translator(language, "course", "lessons")
    files = {folder / name: content for name, content in copied(file, words).items()}
    for path, content in files.items():
        if path.exists() and (not path.is_file() or path.read_bytes() != content):
            raise InputError(
                "{path}: is there already, changed; expected a folder without it", path=path
            )
    write_all({path: content for path, content in files.items() if not path.exists()})
    return list(files)


def write(lecture: Lecture, files: Sequence[Path], paper: str | None, quiet: bool) -> None:
    """Write a lecture to pages of HTML and to PDFs; InputError where that cannot be done."""
    from landscape.course.lecture import page, pdf
    from landscape.course.lecture.slides import slides

    kinds = [file.suffix.lower() for file in files]
    for file, kind in zip(files, kinds, strict=True):
        if kind not in FORMATS:
            raise InputError("--out {out}: expected a name that ends in .html or .pdf", out=file)
    if ".pdf" in kinds:
        pdf.check_typst()
    elif paper is not None:
        raise InputError("--paper: is for a PDF; expected --out FILE.pdf as well")
    for file in files:
        check_writable(file, "--out ")

    language, title = choose(os.environ), texts.heading(lecture)
    made = slides(lecture, language, cores(), quiet)
    for file, kind in zip(files, kinds, strict=True):
        if kind == ".pdf":
            write_whole(file, pdf.as_pdf(title, made, language, paper or PAPERS[0]))
        else:
            write_whole(file, page.as_html(title, made, language))


def show(
    lecture: Lecture, index: int, size: tuple[int, int] | None = None, screen: int = 1
) -> None:
    """Show a lecture from a step on, until the user closes it; NoOpenGLError without a window."""
    from landscape.course.lecture.stage import Stage

    print(texts.wrapped(texts.word("keys"), ""), end="\n\n", flush=True)
    stage = Stage(lecture, index, size, screen)
    try:
        while index >= 0:
            stage.begin(index)
            print(texts.for_speaker(lecture, index), flush=True)
            _play(stage)
            index = -1 if stage.to is None else stage.to
    finally:
        stage.close()


def _play(stage: "Stage") -> None:
    """Play a step until the user leaves it; what ends it before is shown in its place."""
    from landscape.course.lecture import program, view
    from landscape.course.lecture.still import still

    step, language = stage.step, choose(os.environ)
    try:
        if step.kind == VIEW:
            view.play(stage, step.name, step.keys, language)
        elif step.kind in (PICTURE, TEXT):
            view.stand(stage, partial(still, step))
        elif step.file is not None:
            for line in program.play(stage, step.file, step.keys, language):
                print(f"landscape: {line}", file=sys.stderr)
        said = texts.word("ended")
    except InputError as error:
        said = str(error)
        print(f"landscape: {said}", file=sys.stderr)
        print(end=getattr(error, "details", ""), file=sys.stderr)
    if not stage.leaving:
        stage.settle()
        view.say(stage, said)
