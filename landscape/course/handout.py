"""Packages of exercises: one for the students, one that their teacher keeps.

Students get the program that each exercise starts from. Of a lecturer's own exercises they also get
what checks it: the tests that they may see, and the solution as the calls that it makes
(grader/recorded.py), which are numbers and no program. Solutions, mistakes and hidden tests stay.
"""

from collections.abc import Sequence

import framelens
from framelens.base.errors import InputError
from framelens.base.packages import PACKAGES
from framelens.base.texts import Phrases, translator
from landscape.course.grader import recorded
from landscape.course.own_exercise import FRENCH, french_without
from landscape.course.shelf import HIDDEN, Exercise, Shelf, start

CHECKED = "exercises"  # the folder from which students check
OPEN = ("start.py", "grading.py")  # of a lecturer's own exercise
SUFFIXES = (".py", ".po", ".md", ".calls")  # of what a teacher keeps

GUIDE: Phrases = (
    "Exercises: {names}.",
    "Each is a program with a hole. The task stands at its top; write where it says so, and keep "
    "the line `# exercise: ...`.",
    "Run it:",
    "Check it, in the folder in which this file lies:",
    "You need Python 3.11 or later, and the packages framelens and landscape-gl, which are on no "
    "index: your teacher gives you their two files (wheels), or a checkout of the project. Install "
    "them in that folder, by the first or by the second line:",
)
WHEELS = "framelens-{framelens}-py3-none-any.whl", "landscape_gl-{landscape}-py3-none-any.whl"


def for_students(
    found: Sequence[Exercise], shelf: Shelf, language: str, checks: bool = True
) -> dict[str, bytes]:
    """Return the files that students get, by their names, with their tasks in a language.

    Without ``checks`` they get the programs alone. InputError where a solution cannot be recorded.
    """
    own = [each for each in found if each.name in shelf.own]
    files = {f"{each.name}.py": start(each, language).encode() for each in found}
    for each in own if checks else ():
        place = f"{CHECKED}/{each.name}"
        for name in OPEN:
            files[f"{place}/{name}"] = (each.folder / name).read_bytes()
        if (each.folder / FRENCH).is_file():
            files[f"{place}/{FRENCH}"] = french_without(each, HIDDEN)
        files[f"{place}/{recorded.FILE}"] = _calls(each)
    return {"README.txt": _guide(found, bool(own) and checks, checks, language).encode(), **files}


def _calls(found: Exercise) -> bytes:
    from landscape.course.grader.recording import record  # it opens OpenGL

    try:
        return record(found)
    except recorded.Unrecorded:
        raise InputError(
            "{folder}: the calls of solution.py do not give its pictures again, so students cannot "
            "check their programs; --without-checks packs the programs alone",
            folder=found.folder,
        ) from None


def _guide(found: Sequence[Exercise], own: bool, checks: bool, language: str) -> str:
    _ = translator(language, "course")
    first = f"{found[0].name}.py"
    names = ", ".join(each.name for each in found)
    versions = {"framelens": framelens.__version__}
    versions |= {each.name: each.version for each in PACKAGES if each.version}
    wheels = " ".join(WHEELS).format(**versions)
    lines = [_(GUIDE[0]).format(names=names), "", _(GUIDE[1]), "", _(GUIDE[4]), ""]
    lines += [f"    pip install {wheels}", "    pip install ./framelens .", ""]
    lines += [_(GUIDE[2]), "", f"    python {first}"]
    if checks:
        option = f" --exercises {CHECKED}" if own else ""
        lines += ["", _(GUIDE[3]), "", f"    landscape exercise check {first}{option}"]
    return "\n".join(lines) + "\n"


def for_teachers(found: Sequence[Exercise]) -> dict[str, bytes]:
    """Return all files of exercises, by their names."""
    return {
        f"{each.name}/{path.name}": path.read_bytes()
        for each in found
        for path in sorted(each.folder.iterdir())
        if path.is_file() and path.suffix in SUFFIXES
    }
