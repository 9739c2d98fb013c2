"""Two traces compared: which calls came, which went, and which have other arguments.

Calls are matched as in a comparison of texts, element by element and pass by pass, by the function,
the line of code and what they set; of those that match, the arguments are compared.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

from framelens.gl.seam import Call
from framelens.tape.edits import as_code, selectors


@dataclass(frozen=True)
class Difference:
    """What is different in the second trace."""

    added: Sequence[Call]
    removed: Sequence[Call]
    changed: Sequence[tuple[Call, Call]]

    def as_json(self) -> dict[str, object]:
        """Return the difference as `landscape trace --diff --json` prints it."""
        return {
            "added": [call.as_json() for call in self.added],
            "removed": [call.as_json() for call in self.removed],
            "changed": [
                {"from": before.as_json(), "to": after.as_json()} for before, after in self.changed
            ],
        }


def difference(first: Sequence[Call], second: Sequence[Call]) -> Difference:
    """Compare two traces."""
    before, after = [_sort(call) for call in first], [_sort(call) for call in second]
    added: list[Call] = []
    removed: list[Call] = []
    changed: list[tuple[Call, Call]] = []
    for kind, a, b, c, d in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        if kind == "equal":
            pairs = zip(first[a:b], second[c:d], strict=True)
            changed += [pair for pair in pairs if _content(pair[0]) != _content(pair[1])]
        else:
            removed += first[a:b]
            added += second[c:d]
    return Difference(added, removed, changed)


def _sort(call: Call) -> tuple[object, ...]:
    """Return what two calls must share to be the same call with, perhaps, other arguments."""
    # The name of an object tells nothing: in another frame it is another number.
    given = call.args if call.given is None else call.given
    select = () if call.name.startswith("glBind") else selectors(call.name, given)
    return call.pass_, call.element, call.name, call.site.file, call.site.function, select


def _content(call: Call) -> object:
    """Return what makes a call what it is: its arguments, and what its display lists execute."""
    listed = [(inner.name, inner.shown, inner.skipped) for inner in call.listed]
    return listed or call.shown, call.skipped


def as_text(found: Difference) -> Iterator[str]:
    """Yield the lines of a report, by pass and element, in the order of the calls."""
    lines = [(call, "+", as_code(call)) for call in found.added]
    lines += [(call, "-", as_code(call)) for call in found.removed]
    lines += [(b, "~", _became(a, b)) for a, b in found.changed]
    groups: dict[tuple[str, str], list[tuple[Call, str, str]]] = {}
    for line in sorted(lines, key=lambda line: line[0].number):
        groups.setdefault((line[0].pass_, line[0].element), []).append(line)
    for (pass_, element), mine in groups.items():
        yield f"{element} ({pass_})"
        for call, sign, text in mine:
            yield f"  {sign} {text:70}  {call.source}"
    counts = len(found.added), len(found.removed), len(found.changed)
    yield "{} calls came (+), {} went (-), {} changed (~)".format(*counts)


def _became(before: Call, after: Call) -> str:
    if after.skipped != before.skipped:
        return f"{as_code(after)}: {'left out' if after.skipped else 'made'}"
    if after.listed:
        return f"{as_code(after)}: the list holds other calls"
    return f"{as_code(before)} -> {as_code(after)}"
