"""The rows of a class as CSV, JSON, JUnit XML, and the results.json of Gradescope."""

import csv
import io
import json
import unicodedata
from collections.abc import Sequence
from dataclasses import asdict, fields
from xml.etree import ElementTree

from landscape.course.roster.grades import Row

COLUMNS = [field.name for field in fields(Row) if field.name != "tests"]
# A spreadsheet takes a cell that begins so for a formula, and it is the student who wrote it.
# Some take the wide forms of East Asia, too.
FORMULAS = ("=", "+", "-", "@", "\t", "\r", "\uff1d", "\uff0b", "\uff0d", "\uff20")


def as_csv(rows: Sequence[Row]) -> bytes:
    """Return the rows as CSV in UTF-8, the names of the columns first."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in rows:
        values = asdict(row)
        writer.writerow([_cell(values[name]) for name in COLUMNS])
    return text.getvalue().encode()


def _cell(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:g}"
    text = printable(str(value))
    return f"'{text}" if text.startswith(FORMULAS) else text


def printable(text: str) -> str:
    """Return a text on one line without control characters, which a terminal would obey."""
    return "".join(each if _is_shown(each) else " " for each in text)


def _is_shown(character: str) -> bool:
    """Return whether a character is printable, as are spaces of every width, no-break or not."""
    return character.isprintable() or unicodedata.category(character) == "Zs"


def as_json(rows: Sequence[Row], copies: Sequence[dict[str, object]] | None = None) -> bytes:
    """Return the rows as JSON: {"submissions": [...]}, and "copies" where those are asked for."""
    whole: dict[str, object] = {"submissions": [asdict(row) for row in rows]}
    if copies is not None:
        whole["copies"] = copies
    return (json.dumps(whole, indent=1, ensure_ascii=False) + "\n").encode("utf-8", "replace")


def as_junit(rows: Sequence[Row]) -> bytes:
    """Return the rows as JUnit XML: a suite for each submission, a case for each test."""
    root = ElementTree.Element("testsuites")
    for row in rows:
        failed = sum(test["passed"] is False for test in row.tests)
        skipped = sum(test["passed"] is None for test in row.tests)
        suite = ElementTree.SubElement(
            root,
            "testsuite",
            name=_xml(row.student),
            tests=str(1 if row.error else len(row.tests)),
            failures=str(0 if row.error else failed),
            errors=str(int(bool(row.error))),
            skipped=str(0 if row.error else skipped),
            time=f"{row.seconds:g}",
        )
        _add_cases(suite, row)

    ElementTree.indent(root)
    return ElementTree.tostring(root, "utf-8", xml_declaration=True) + b"\n"


def _add_cases(suite: ElementTree.Element, row: Row) -> None:
    """Add a case for each test, or one with the error."""
    named = _xml(f"{row.exercise or 'exercise'}.{row.student}")
    if row.error:
        case = ElementTree.SubElement(suite, "testcase", name=_xml(row.file), classname=named)
        ElementTree.SubElement(case, "error", message=_xml(row.error))
        return
    for test in row.tests:
        case = ElementTree.SubElement(suite, "testcase", name=_xml(test["name"]), classname=named)
        if test["passed"] is None:
            ElementTree.SubElement(case, "skipped")
        elif not test["passed"]:
            ElementTree.SubElement(case, "failure", message=_xml(test["hint"]))


def _xml(text: str) -> str:
    """Return a text of characters that XML may have."""
    return printable(text).encode("utf-8", "replace").decode()


def as_gradescope(row: Row) -> bytes:
    """Return a row as the results.json that Gradescope reads for one submission."""
    tests = [
        {
            "name": test["name"],
            "score": test["points"] if test["passed"] else 0.0,
            "max_score": test["points"],
            "status": "passed" if test["passed"] else "failed",
            "output": test["hint"],
            "visibility": "hidden" if test["hidden"] else "visible",
        }
        for test in row.tests
    ]

    result: dict[str, object] = {
        "score": row.points,
        "execution_time": row.seconds,
        "output": row.error or row.hint,
        "output_format": "text",
        "visibility": "visible",
        "tests": tests,
        "extra_data": {"exercise": row.exercise, "version": row.version},
    }
    return (json.dumps(result, indent=1, ensure_ascii=False) + "\n").encode("utf-8", "replace")
