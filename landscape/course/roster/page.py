"""A class as one page of HTML without scripts: each student's picture, first hint and line."""

import base64
import html
from collections.abc import Sequence

from framelens.base.texts import Translator
from landscape.course.grader.grading import _
from landscape.course.roster.grades import Graded, Row
from landscape.course.roster.tables import printable

TITLE = _("Exercises of a class")
COUNTS = _("Programs that pass: {passed} of {all}")
PICTURE = _("the picture of {student}, where it differs, and the solution's")
LABELS = (_("the student's picture"), _("where it differs"), _("the solution's"))
LINE = _("line {line}")
TOLD = _("{line}: {text}")
LATE = _("late")
HIDDEN = _("Not shown to students: {test}. {hint}")
COLUMNS = (
    _("Student"),
    _("File"),
    _("Exercise"),
    _("Points"),
    _("First hint"),
)
STYLE = """
body { font: 16px/1.45 sans-serif; margin: 2em auto; max-width: 70em; padding: 0 1em; }
table { border-collapse: collapse; width: 100%; }
th, td { border-bottom: 1px solid #ccc; padding: .3em .6em; text-align: left; vertical-align: top; }
td:nth-child(-n+2) { min-width: 9em; overflow-wrap: anywhere; }
td.points { white-space: nowrap; }
img { display: block; max-width: 100%; }
figure { margin: .4em 0 0; width: fit-content; }
figcaption { display: grid; font-size: .85em; grid-template-columns: 1fr 1fr 1fr; }
tr.passed td.points { color: #1a6b2f; }
tr.failed td.points { color: #9b1c1c; }
.pair { display: grid; gap: 1em; grid-template-columns: 1fr 1fr; }
pre { font-size: .75em; overflow-x: auto; }
@media print { tr { break-inside: avoid; } }
"""


def as_page(
    graded: Sequence[Graded], language: str, _: Translator, hidden: bool = False, more: str = ""
) -> bytes:
    """Return the page; pictures are in it, so that it is one file.

    With ``hidden`` it also says which tests failed that students do not see. ``more`` is HTML that
    follows.
    """
    passed = sum(each.row.passed for each in graded)
    head = "".join(f"<th>{html.escape(_(each))}</th>" for each in COLUMNS)
    body = "\n".join(_line_of(each, _, hidden) for each in graded)
    title = html.escape(_(TITLE))
    counts = html.escape(_(COUNTS).format(passed=passed, all=len(graded)))

    return f"""<!DOCTYPE html>
<html lang="{language}">
<meta charset="utf-8">
<title>{title}</title>
<style>{STYLE}</style>
<h1>{title}</h1>
<p>{counts}</p>
<table>
<thead><tr>{head}</tr></thead>
<tbody>
{body}
</tbody>
</table>
{more}
</html>
""".encode("utf-8", "replace")


def _figure(graded: Graded, _: Translator) -> str:
    """Return the student's picture, where it differs, and the solution's, with their labels."""
    text = html.escape(_(PICTURE).format(student=printable(graded.row.student)), quote=True)
    source = base64.b64encode(graded.picture).decode()
    labels = "".join(f"<span>{html.escape(_(each))}</span>" for each in LABELS)
    image = f'<img alt="{text}" src="data:image/png;base64,{source}">'
    return f"<figure>{image}<figcaption>{labels}</figcaption></figure>"


def _line_of(graded: Graded, _: Translator, hidden: bool) -> str:
    row = graded.row
    hint = html.escape(printable(told(row, _)))

    for test in row.tests if hidden else ():
        if test["hidden"] and test["passed"] is False:
            text = _(HIDDEN).format(test=test["name"], hint=test["hint"])
            hint += f"<p>{html.escape(printable(text))}</p>"

    if graded.picture:
        hint += _figure(graded, _)
    student = html.escape(printable(row.student))
    if row.late:
        student += f" ({html.escape(_(LATE))})"
    points = f"{row.points:g} / {row.of:g}" if row.of else "-"
    cells = (
        f"<td>{student}</td>",
        f"<td>{html.escape(printable(inside(graded)))}</td>",
        f"<td>{html.escape(row.exercise)}</td>",
        f'<td class="points">{points}</td>',
        f"<td>{hint}</td>",
    )
    kind = "passed" if row.passed else "failed"
    return f'<tr class="{kind}">{"".join(cells)}</tr>'


def inside(graded: Graded) -> str:
    """Return a program's name below its student's folder, whose name says only who that is."""
    return graded.row.file.removeprefix(f"{graded.submission.folder}/")


def told(row: Row, _: Translator) -> str:
    """Return the first hint of a row, or why it was not graded, with the line of the program."""
    text = row.error or row.hint
    named = _(LINE).format(line=row.line)
    if row.line and named.casefold() not in text.casefold():
        text = _(TOLD).format(line=named, text=text)
    return text
