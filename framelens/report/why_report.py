"""`landscape why`: the cause of what a frame does not show, in words and as JSON."""

from collections.abc import Iterator
from contextlib import suppress

from framelens.base.errors import InputError
from framelens.base.progress import Progress
from framelens.spec.spec import draws
from framelens.tape.tape import Tape
from framelens.tape.target import Target
from framelens.why.diagnosis import LIMIT, Diagnosis, diagnose
from framelens.why.findings import mend, text, word

__all__ = ["LIMIT", "as_text", "find"]


def find(
    target: Target,
    pixel: tuple[int, int] | None = None,
    limit: float = LIMIT,
    language: str = "en",
    quiet: bool = True,
) -> Diagnosis:
    """Find out why a target's frame shows what it shows.

    ``pixel``: one that should look otherwise, from the top left; ``limit``: seconds for the search.
    InputError as in Target.look, and for a pixel outside the picture.
    """
    found = _looked(target, pixel, limit, language, quiet)
    after = target.following()
    if after is not None and not found.causes and found.drew:
        # A program that swaps twice shows a good picture, and at once an old one in its place.
        with suppress(InputError):
            again = after.look(lambda tape: _swapped_again(tape, limit, language), past=True)
            return again or found

    return found


def _swapped_again(tape: Tape, limit: float, language: str) -> Diagnosis | None:
    """Return the diagnosis of a frame that is a second swap, None for another one."""
    showing = tape.past.showing if tape.past else None
    if showing is None or not showing.again or any(draws(call.name) for call in tape.frame):
        return None
    return diagnose(tape, None, limit, language, only=("swapped-twice",))


def _looked(
    target: Target,
    pixel: tuple[int, int] | None,
    limit: float,
    language: str,
    quiet: bool,
) -> Diagnosis:
    with Progress(None, quiet) as progress:

        def step(done: int, of: int) -> None:
            progress.step(f"{done}/{of}")

        return target.look(lambda tape: diagnose(tape, pixel, limit, language, step), past=True)


def as_text(found: Diagnosis, language: str, walk: bool = True) -> Iterator[str]:
    """Yield the lines of a report: the verdict, each cause with its mend, what was ruled out.

    Without ``walk`` the draws that leave no trace are not listed.
    """
    yield word(language, found.verdict, **found.verdict_values)
    for number, cause in enumerate(found.causes, 1):
        yield ""
        yield f"{number}. {cause.source}  [{cause.cause}]"
        yield f"   {text(language, cause.cause, cause.values)}"
        yield f"   {word(language, 'mend', mend=mend(language, cause.cause, cause.values))}"
        if cause.pixels:
            key = "unseen" if cause.hidden else "pixels"
            yield f"   {word(language, key, n=cause.pixels)}"
    if walk and found.walk and (found.causes or found.verdict == "not-found"):
        yield ""
        yield word(language, "walk")
        yield from (f"  {line}" for line in found.walk)
    if found.ruled_out:
        yield ""
        yield word(language, "ruled-out", causes=", ".join(found.ruled_out))
