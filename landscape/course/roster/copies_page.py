"""The pairs of a class that share what is rare, for a teacher: side by side, or as lines.

Nothing here says that somebody has copied.
"""

import html
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from framelens.base.texts import Translator
from landscape.course.grader.grading import _
from landscape.course.roster.copies import (
    COMMENT,
    NAME,
    NUMBER,
    SEQUENCE,
    TEXT,
    WORDS,
    Pair,
    Shared,
    known,
    pairs,
)
from landscape.course.roster.grades import Graded
from landscape.course.roster.tables import printable
from landscape.course.shelf import Shelf

TELLING = (COMMENT, TEXT, NUMBER, NAME, SEQUENCE)  # what a reader understands at once, first
FEW = 3  # chosen: pieces of evidence on a line of the terminal
TITLE = _("Pairs to look at")
NONE = _("No two programs share anything rare.")
ABOUT = _(
    "These programs share what is rare in this class, beyond the start, the solutions and known "
    "mistakes. It is no verdict: students who have learned together, or from the same page, share "
    "as much. Read both, and talk to them."
)
PAIR = _("{exercise}: {first} and {second}")
PIECE = _("{kind} {text} (lines {one} and {other})")
MORE = _("{count} more")
SHARED = _("{pair}: {pieces}")


@dataclass(frozen=True)
class Likeness:
    """Two submissions of a class that share what is rare."""

    first: Graded
    second: Graded
    score: float
    shared: Sequence[Shared]


def likenesses(graded: Sequence[Graded], shelf: Shelf) -> list[Likeness]:
    """Return the pairs of a class that share rare evidence, those with the most first.

    Programs of each exercise are compared with each other, those that could not be run as well.
    """
    groups: dict[str, list[Graded]] = defaultdict(list)
    for each in graded:
        if each.row.exercise and each.submission.data is not None:
            groups[each.row.exercise].append(each)

    found: list[Likeness] = []
    for name, members in groups.items():
        if len(members) > 1:
            whose = [f"{each.row.id} {each.row.student}" for each in members]
            common = known(shelf.exercise(name))
            for pair in pairs([_text(each) for each in members], common, whose):
                found.append(_likeness(pair, members))
    return sorted(found, key=lambda each: -each.score)


def _likeness(pair: Pair, members: Sequence[Graded]) -> Likeness:
    return Likeness(members[pair.first], members[pair.second], pair.score, pair.shared)


def _text(graded: Graded) -> str:
    return (graded.submission.data or b"").decode("utf-8", "replace")


def as_lines(found: Sequence[Likeness], _: Translator) -> list[str]:
    """Return what the terminal shows: a line for each pair."""
    if not found:
        return [_(NONE)]
    lines = [f"{_(TITLE)}. {_(ABOUT)}"]
    for each in found:
        best = sorted(each.shared, key=lambda shared: TELLING.index(shared.kind))
        pieces = [_piece(shared, _) for shared in best[:FEW]]
        if len(each.shared) > FEW:
            pieces.append(_(MORE).format(count=len(each.shared) - FEW))
        lines.append(_(SHARED).format(pair=_named(each, _), pieces=", ".join(pieces)))
    return [printable(line) for line in lines]


def _named(each: Likeness, _: Translator) -> str:
    names = each.first.row.student, each.second.row.student
    return _(PAIR).format(exercise=each.first.row.exercise, first=names[0], second=names[1])


def _piece(shared: Shared, _: Translator) -> str:
    one, other = shared.lines
    kind, text = _(WORDS[shared.kind]), " ".join(shared.text.split())
    piece = _(PIECE).format(kind=kind, text=text, one=one, other=other)
    return piece.replace("  ", " ")  # a sequence has no text


def as_json(found: Sequence[Likeness]) -> list[dict[str, object]]:
    """Return the pairs as JSON."""
    return [
        {
            "exercise": each.first.row.exercise,
            "students": [each.first.row.student, each.second.row.student],
            "files": [each.first.row.file, each.second.row.file],
            "score": each.score,
            "shared": [
                {"kind": shared.kind, "text": shared.text, "lines": list(shared.lines)}
                for shared in each.shared
            ],
        }
        for each in found
    ]


def as_section(found: Sequence[Likeness], _: Translator) -> str:
    """Return a part of a page: each pair side by side, with the lines that it shares marked."""
    parts = [f"<h2>{html.escape(_(TITLE))}</h2>"]
    if not found:
        parts.append(f"<p>{html.escape(_(NONE))}</p>")
        return "\n".join(parts)
    parts.append(f"<p>{html.escape(_(ABOUT))}</p>")
    for each in found:
        pieces = "".join(
            f"<li>{html.escape(printable(_piece(shared, _)))}</li>" for shared in each.shared
        )
        marked = tuple({shared.lines[side] for shared in each.shared} for side in (0, 1))
        sides = "".join(
            f"<pre>{_code(_text(graded), lines)}</pre>"
            for graded, lines in zip((each.first, each.second), marked, strict=True)
        )
        parts.append(
            f"<details><summary>{html.escape(printable(_named(each, _)))}</summary>"
            f'<ul>{pieces}</ul><div class="pair">{sides}</div></details>'
        )
    return "\n".join(parts)


def _code(text: str, marked: set[int]) -> str:
    """Return a program with numbers of lines; those that are marked stand out."""
    rows = []
    for number, line in enumerate(text.splitlines(), 1):
        row = f"{number:4} {html.escape(printable(line))}"
        rows.append(f"<mark>{row}</mark>" if number in marked else row)
    return "\n".join(rows)
