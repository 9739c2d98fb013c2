"""Moodle's names of folders, its grading worksheet, and a zip of feedback files.

Moodle names a student's folder FULLNAME_ID_assignsubmission_file, where ID is the number of the
participant in this assignment. Its worksheet is a CSV whose headers are in the language of the
site. A student is found by its first column, and only the grade and the comment of each graded
student change in it: every other byte stays. The column after the grades has the highest grade of
the assignment, a number, or the words of a scale; Moodle passes over a grade above it in silence.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from framelens.base.errors import InputError
from landscape.course.roster.archive import zipped

FOLDER = re.compile(r"(?P<name>[^_]*)_(?P<id>\d+)_assignsubmission_[a-z]+(_.*)?")
# Headers of the columns that are filled, in the languages of Moodle's sites.
GRADES = ("Grade", "Note", "Bewertung", "Calificación", "Valutazione", "Cijfer")
COMMENTS = (
    "Feedback comments",
    "Feedback par commentaires",
    "Feedback als Kommentar",
    "Comentarios de retroalimentación",
    "Commenti di feedback",
    "Feedback als commentaar",
)
# Headers of the column after the grades where the assignment is graded by the words of a scale.
SCALES = ("Scale", "Barème", "Skala", "Bewertungsskala", "Escala", "Scala", "Schaal")
NUMBER = re.compile(r"(\d+)\s*$")
GRADE = re.compile(r"\d+([.,]\d+)?")  # in some languages of a site with a comma


def participant(folder: str) -> tuple[str, str] | None:
    """Return the name and number of the student whose folder this is; None for another name."""
    known = FOLDER.fullmatch(folder)
    return (known["name"].strip(), known["id"]) if known else None


@dataclass(frozen=True)
class Mark:
    """What a worksheet gets for a participant."""

    grade: str
    comment: str


def filled(worksheet: bytes, marks: Mapping[str, Mark], name: str) -> tuple[bytes, list[str]]:
    """Return a worksheet with the marks by participants' numbers, and the numbers not in it.

    InputError, which names the file ``name``, if it is not a worksheet.
    """
    text, rows, headers = _read(worksheet, name)
    grade = _grades(headers, name)
    comment = next((index for index, each in enumerate(headers) if each in COMMENTS), None)

    changes: list[tuple[int, int, str]] = []
    left = dict(marks)
    for row in rows[1:]:
        number = NUMBER.search(_value(text[slice(*row[0])]))
        mark = left.pop(number[1], None) if number else None
        if mark is None or len(row) <= grade:
            continue
        changes.append((*row[grade], _quoted(mark.grade)))
        if comment is not None and len(row) > comment:
            changes.append((*row[comment], _quoted(mark.comment)))

    return _changed(text, changes).encode(), sorted(left)


def _changed(text: str, changes: Iterable[tuple[int, int, str]]) -> str:
    """Return a text with other values in some places, (begin, end, value)."""
    for begin, end, value in sorted(changes, reverse=True):
        text = text[:begin] + value + text[end:]
    return text


def highest(worksheet: bytes, name: str) -> float | None:
    """Return the highest grade that the assignment has; None where it is not a number.

    InputError, which names the file ``name``, if it is not a worksheet.
    """
    text, rows, headers = _read(worksheet, name)
    column = _grades(headers, name) + 1
    for row in rows[1:]:
        value = _value(text[slice(*row[column])]) if len(row) > column else ""
        if GRADE.fullmatch(value) and float(value.replace(",", ".")) > 0:
            return float(value.replace(",", "."))
    return None


def by_scale(worksheet: bytes, name: str) -> bool:
    """Return whether the assignment is graded by the words of a scale.

    Moodle then looks for these words in the column of grades, and passes over all else in silence.
    InputError, which names the file ``name``, if it is not a worksheet.
    """
    _text, _rows, headers = _read(worksheet, name)
    return headers[_grades(headers, name) + 1 :][:1] in [[scale] for scale in SCALES]


def _read(worksheet: bytes, name: str) -> tuple[str, list[list[tuple[int, int]]], list[str]]:
    """Return a worksheet's text, where its cells are, and its headers."""
    try:
        text = worksheet.decode("utf-8")
    except UnicodeDecodeError:
        raise InputError(
            "{name}: expected a grading worksheet of Moodle, a CSV in UTF-8", name=name
        ) from None
    rows = _cells(text)
    headers = [_value(text[begin:end]).lstrip("\ufeff") for begin, end in rows[0]] if rows else []
    return text, rows, headers


def _grades(headers: Sequence[str], name: str) -> int:
    """Return the index of the column of grades; InputError, which names the file, without one."""
    found = next((index for index, each in enumerate(headers) if each in GRADES), None)
    if found is None:
        raise InputError(
            "{name}: expected a grading worksheet of Moodle, with a column {columns}",
            name=name,
            columns=" / ".join(GRADES),
        )
    return found


def _cells(text: str) -> list[list[tuple[int, int]]]:
    """Return where each cell of a CSV begins and ends, quotes included, row by row."""
    rows: list[list[tuple[int, int]]] = []
    row: list[tuple[int, int]] = []
    begin, quoted = 0, False
    for place, character in enumerate(text):
        if character == '"':
            quoted = not quoted
        elif quoted:
            continue
        elif character == ",":
            row.append((begin, place))
            begin = place + 1
        elif character == "\n":
            end = place - 1 if text[place - 1 : place] == "\r" else place
            rows.append([*row, (begin, end)])
            row, begin = [], place + 1

    if begin < len(text):
        rows.append([*row, (begin, len(text))])
    return rows


def _value(cell: str) -> str:
    cell = cell.strip()
    bare = cell.lstrip("\ufeff")
    return bare[1:-1].replace('""', '"') if bare[:1] == bare[-1:] == '"' else bare


def _quoted(value: str) -> str:
    if any(character in value for character in ',"\r\n'):
        return '"' + value.replace('"', '""') + '"'
    return value


def feedback(files: Sequence[tuple[str, str, bytes]]) -> bytes:
    """Return a zip of (folder, name, bytes), as Moodle takes it: folders named as it named them."""
    return zipped({f"{folder}/{name}": data for folder, name, data in files})
