"""The submissions of a class, found in files, folders and zips.

A file is a submission of the student who is named like it; a folder inside a folder or a zip is the
student's of its name, or of the one that Moodle put into it (moodle.py). What cannot be graded is a
submission, too: its error says why.
"""

import io
import lzma
import struct
import unicodedata
import zipfile
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from functools import partial
from pathlib import Path, PurePosixPath

from framelens.base.errors import InputError, reason
from framelens.base.input import check_plain, read_bounded
from landscape.course.roster.moodle import participant
from landscape.course.shelf import MOST_BYTES

MOST_ZIP_BYTES = 1 << 28  # chosen: of a zip of a class
MOST_FILES = 20_000  # chosen: in a zip or a folder
MOST_UNPACKED = 1 << 28  # bytes, chosen: of all programs in a zip or a folder, and in zips in it
MOST_OF_STUDENT = 1 << 22  # bytes, chosen: of all programs and zips of a student
MOST_PROGRAMS = 50  # chosen: of a student; a folder of installed packages has thousands
KINDS = (".py", ".zip")  # what is read
# What zipfile raises, which has no common error: RuntimeError is for a password,
# NotImplementedError for a method, ValueError for a file that begins before the zip does, and
# MemoryError for an LZMA's dictionary of some gigabytes.
UNREADABLE = (
    *(zipfile.BadZipFile, zlib.error, lzma.LZMAError, struct.error, EOFError, OSError),
    *(RuntimeError, NotImplementedError, ValueError, OverflowError, MemoryError),
)
UTF_8 = 1 << 11  # the flag of a name that is not in code page 437
# Of a zip's directory: names that are no student's, as the systems of their makers leave them.
HIDDEN = "__MACOSX"


@dataclass(frozen=True)
class Submission:
    """A program, or why there is none: ``data`` is None where ``error`` says it.

    ``file`` is its name below the folder or zip; ``folder`` is the student's, as Moodle named it.
    """

    student: str
    id: str = ""
    file: str = ""
    folder: str = ""
    data: bytes | None = None
    changed: datetime | None = None
    error: InputError | None = None


class _Room:
    """How many bytes of programs may still be read of what the user names, or of a student."""

    def __init__(self, name: str, most: int) -> None:
        self._name = name
        self._most = self._left = most

    def take(self, data: bytes) -> bytes:
        """Return the bytes; InputError if they are too many."""
        if len(data) > self._left:
            raise InputError(
                "{name}: expected at most {amount} of programs",
                name=self._name,
                amount=f"{self._most >> 20} MB",
            )
        self._left -= len(data)
        return data


def submissions(paths: Sequence[Path]) -> list[Submission]:
    """Return the submissions in files, folders and zips, in the order of their names.

    InputError if one of the paths cannot be read at all.
    """
    found: list[Submission] = []
    for path in paths:
        room = _Room(str(path), MOST_UNPACKED)
        if path.is_dir():
            found += _students(_of_folder(path), room)
        elif path.suffix.lower() == ".zip":
            data = read_bounded(path, MOST_ZIP_BYTES)
            found += _students(_of_zip(data, str(path)), room)
        else:
            data = read_bounded(path, MOST_BYTES)
            changed = datetime.fromtimestamp(path.stat().st_mtime)
            found.append(Submission(path.stem, file=path.name, data=data, changed=changed))

    if not found:
        raise InputError(
            "{paths}: expected programs, found none", paths=", ".join(str(path) for path in paths)
        )
    return sorted(found, key=_place)


Load = Callable[[], bytes]
File = tuple[PurePosixPath, Load | None, datetime, InputError | None]
"""Its name below the folder or zip, what reads it, when it was changed, and why it cannot be.

A folder has neither of the two.
"""


def _of_folder(folder: Path) -> Iterator[File]:
    paths = sorted(folder.rglob("*"))
    if len(paths) > MOST_FILES:
        raise InputError("{folder}: expected at most {most} files", folder=folder, most=MOST_FILES)
    for path in paths:
        name = PurePosixPath(path.relative_to(folder).as_posix())
        if path.is_dir():
            yield name / "", None, datetime.min, None
            continue
        try:
            changed = datetime.fromtimestamp(path.stat().st_mtime)
        except OSError as error:
            yield name, None, datetime.min, _unread(str(name), error)
        else:
            yield name, partial(_plain, path, str(name)), changed, None


def _plain(path: Path, name: str) -> bytes:
    """Return what is in a file; InputError if it is none, or cannot be read."""
    try:
        if path.is_symlink():  # to another student's program, or one of the lecturer's
            raise InputError("{path}: expected a file, found a link", path=path)
        check_plain(path, MOST_BYTES)  # a pipe would let all others wait
        return read_bounded(path, MOST_BYTES)
    except OSError as error:
        raise _unread(name, error) from None


def _unread(name: str, error: OSError) -> InputError:
    return InputError("{name}: cannot be read ({reason})", name=name, reason=reason(error))


def _of_zip(data: bytes, name: str) -> Iterator[File]:
    """Yield the files of a zip; none is written."""
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
    except UNREADABLE:
        raise InputError("{name}: is not a zip that can be read", name=name) from None

    entries = archive.infolist()
    if len(entries) > MOST_FILES:
        raise InputError("{name}: expected at most {most} files", name=name, most=MOST_FILES)

    for entry in sorted(entries, key=lambda entry: entry.filename):
        if not entry.filename:
            continue

        inside = PurePosixPath(_named(entry).replace("\\", "/"))
        if inside.is_absolute() or ".." in inside.parts:
            raise InputError(
                "{name}: has a file outside of itself, {file}", name=name, file=entry.filename
            )
        changed = _date(entry.date_time)
        if entry.is_dir():
            yield inside / "", None, changed, None
        else:
            yield inside, partial(_unpacked, archive, entry), changed, None


def _named(entry: zipfile.ZipInfo) -> str:
    """Return a file's name; some systems write UTF-8 without saying so."""
    if entry.flag_bits & UTF_8:
        return entry.filename
    try:
        return entry.filename.encode("cp437").decode("utf-8")
    except UnicodeError:
        return entry.filename


def _date(numbers: tuple[int, int, int, int, int, int]) -> datetime:
    try:
        return datetime(*numbers)
    except ValueError:
        return datetime.min


def _unpacked(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """Return what a zip has at a name; no more of it is unpacked than a program may have."""
    try:
        with archive.open(entry) as file:
            data = file.read(MOST_BYTES + 1)
    except UNREADABLE:
        raise InputError("{file}: is damaged or encrypted", file=entry.filename) from None
    if len(data) > MOST_BYTES:
        raise InputError(
            "{file}: too large, expected at most {amount}",
            file=entry.filename,
            amount=f"{MOST_BYTES >> 20} MB",
        )
    return data


def _students(files: Iterable[File], room: _Room) -> list[Submission]:
    """Return the submissions among files: a student's are in one folder, or are one file."""
    found: list[Submission] = []
    folders: dict[str, list[File]] = {}
    for file in _unwrapped([file for file in files if not _hidden(file[0])]):
        name, load, _changed, error = file
        if len(name.parts) > 1 or (load is None and error is None):
            folders.setdefault(name.parts[0], []).append(file)
        elif name.suffix.lower() in KINDS:
            found += _programs(Submission(name.stem), [file], room)

    for folder, inside in folders.items():
        student, number = participant(folder) or (folder, "")
        found += _programs(Submission(student or folder, number, folder=folder), inside, room)
    return found


def _place(each: Submission) -> tuple[tuple[str, str], str, tuple[str, str]]:
    """Return by what submissions are sorted."""
    return alphabetic(each.student), each.id, alphabetic(each.file)


def alphabetic(name: str) -> tuple[str, str]:
    """Return by what a name is sorted: its letters without accents, and then the name itself."""
    letters = unicodedata.normalize("NFKD", name.casefold())
    return "".join(each for each in letters if not unicodedata.combining(each)), name


def _hidden(name: PurePosixPath) -> bool:
    return HIDDEN in name.parts or any(part.startswith(".") for part in name.parts)


def _unwrapped(files: Sequence[File]) -> Sequence[File]:
    """Return files without the one folder in which a zip or a folder often has all others."""
    tops = {name.parts[0] for name, *_rest in files if name.parts}
    deep = any(len(name.parts) > 2 for name, *_rest in files)
    if len(tops) != 1 or not deep or participant(tops.pop()) is not None:
        return files
    return _unwrapped(
        [
            (PurePosixPath(*name.parts[1:]), data, changed, error)
            for name, data, changed, error in files
            if len(name.parts) > 1
        ]
    )


def _programs(student: Submission, files: Iterable[File], room: _Room) -> list[Submission]:
    """Return the programs of a student, those in a zip of the student's own among them.

    One who hands in more than a student may is told so, and takes nothing from the others.
    """
    own = _Room(student.student, MOST_OF_STUDENT)
    found: list[Submission] = []
    for each in _handed_in(student, files, own):
        found.append(each)
        if len(found) > MOST_PROGRAMS:
            many = InputError(
                "{student}: handed in more than {most} programs",
                student=student.student,
                most=MOST_PROGRAMS,
            )
            return [replace(student, error=many)]

    if not found:
        nothing = InputError(
            "{student}: handed in no program, expected a file that ends in .py",
            student=student.student,
        )
        return [replace(student, error=nothing)]
    for each in found:
        room.take(each.data or b"")
    return found


def _handed_in(
    student: Submission, files: Iterable[File], own: _Room, outer: str = ""
) -> Iterator[Submission]:
    """Yield the programs among files; ``outer`` is the zip in which they are."""
    for name, load, changed, error in files:
        kind = name.suffix.lower()
        if kind not in KINDS or (load is None and error is None) or HIDDEN in name.parts:
            continue
        if kind == ".zip" and outer:
            continue

        of_file = replace(student, file=f"{outer}{name}", changed=changed)
        if load is None:
            yield replace(of_file, error=error)
            continue

        try:
            data = own.take(load())
            inside = list(_of_zip(data, str(name))) if kind == ".zip" else []
        except InputError as trouble:
            yield replace(of_file, error=trouble)
            continue

        if kind == ".zip":
            yield from _handed_in(of_file, inside, own, f"{name}/")
        else:
            yield replace(of_file, data=data)


def late(submission: Submission, due: datetime | None) -> bool:
    """Return whether a submission was changed after it was due; a zip keeps even seconds only."""
    if due is None or submission.changed is None:
        return False
    return submission.changed - due > timedelta(seconds=2)
