"""A frame without display lists: the calls that a glCallList executes take its place.

The rules then find in a list what they find outside of one, GLU's calls among it, and can leave out
or change each call. A call keeps the line that compiled it; the function that makes it is called
glCallList.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from framelens.gl.seam import Call, GluCall
from framelens.program.program_run import Chain
from framelens.tape.steps import Step, steps
from framelens.tape.tape import Tape

LISTS = ("glCallList", "glCallLists")
FUNCTION = "glCallList"  # what stands for the function that makes a list's calls


@dataclass(frozen=True)
class Flat:
    """A tape whose frame executes no lists.

    ``places`` are those of its calls in the tape that it was made of, by their numbers; ``called``
    are the numbers of the lists that the frame executes.
    """

    tape: Tape
    places: Mapping[int, str]
    called: frozenset[int]

    def place(self, number: int) -> str:
        """Return the place that a call had in the frame with lists."""
        return self.places.get(number, str(number))


def flattened(tape: Tape) -> Flat:
    """Return a tape's frame without lists; the tape itself where it executes none."""
    lists = [call for call in tape.frame if call.name in LISTS]
    called = frozenset(int(call.args[0]) for call in lists if call.name == "glCallList")
    if not any(call.listed for call in lists):
        return Flat(tape, {}, called)

    calls = list(tape.calls[: tape.begin])
    numbers: dict[int, int] = {}  # of the frame's calls
    places: dict[int, str] = {}
    chains: dict[int, Chain] = {}
    glu: list[GluCall] = []
    for call in tape.frame:
        numbers[call.number] = begin = len(calls)
        chain = tape.past.chains.get(call.number, ()) if tape.past else ()
        first: dict[str, int] = {}  # the first call at a place or below it
        for step in steps([call]) if call.listed else [Step(str(call.number), call, call)]:
            number = len(calls)
            places[number] = step.place or str(call.number)
            calls.append(_moved(step, number))
            if step.call is not call:
                chains[number] = (*chain, (FUNCTION, step.call.site.line))
            elif chain:
                chains[number] = chain
            for prefix in _prefixes(places[number]):
                first.setdefault(prefix, number)
        glu += _glu(call, str(call.number), call.pass_, first, len(calls))
        if call.listed:
            chains.setdefault(begin, chain)

    past = tape.past
    if past is not None:
        numbers[len(tape.calls)] = len(calls)
        outer = [
            replace(
                note,
                begin=numbers.get(note.begin, note.begin),
                end=numbers.get(note.end, note.end),
            )
            for note in past.glu
        ]
        glu = sorted([*outer, *glu], key=lambda note: note.begin)
        past = replace(past, chains=chains, glu=glu)
    return Flat(replace(tape, calls=calls, past=past), places, called)


def _moved(step: Step, number: int) -> Call:
    """Return a step's call under another number; one of a list as if glCallList made it."""
    call = step.call
    if call is step.top:
        return replace(call, number=number)
    site = replace(call.site, function=FUNCTION)
    return replace(call, number=number, site=site, pass_=step.top.pass_, executed=())


def _prefixes(place: str) -> Iterator[str]:
    parts = place.split(".")
    for depth in range(1, len(parts) + 1):
        yield ".".join(parts[:depth])


def _glu(
    call: Call, place: str, pass_: str, first: Mapping[str, int], end: int
) -> Iterator[GluCall]:
    """Yield the calls of GLU in the lists that a call executes, up to the number ``end``."""
    offset = 0
    total = len(call.listed)

    def number(index: int) -> int:
        """Return the number of the first call from an index of the lists on."""
        known = (first.get(f"{place}.{k}") for k in range(offset + index, total))
        return next((each for each in known if each is not None), end)

    for listing in call.executed:
        for note in listing.glu:
            yield replace(note, begin=number(note.begin), end=number(note.end), pass_=pass_)
        for index, inner in enumerate(listing.calls()):
            if inner.executed:
                below = f"{place}.{offset + index}"
                yield from _glu(inner, below, pass_, first, number(index + 1))
        offset += len(listing.calls())
