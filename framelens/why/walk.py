"""The pipeline in numbers, for draws that leave no trace: how far do vertices and fragments come?

For each of them: vertices and primitives, where they lie, the fragments that they have without any
test and with all, the pixels that they change, and which tests are on.
"""

from collections.abc import Iterator

from framelens.base.texts import Texts, translator
from framelens.tape.edits import as_code
from framelens.tape.tape import Tape
from framelens.why.survey import Drawn, Survey, survey
from framelens.why.suspects import near_far

TEXTS: Texts = {
    "draw": "call {place}: {code}, {source}",
    "vertices": "{n} vertices, {faces} primitives",
    "unknown": "vertices not known",
    "behind": "{n} behind the eye",
    "beyond": "{n} beyond the {plane} plane",
    "plane.left": "left",
    "plane.right": "right",
    "plane.below": "lower",
    "plane.above": "upper",
    "plane.near": "near",
    "plane.far": "far",
    "distances": "{nearest} to {farthest} from the eye (near {near}, far {far})",
    "nan": "not all are numbers",
    "fragments": "{covered} fragments without tests, {passed} with them",
    "changed": "{n} pixels changed",
    "on": "on: {names}",
    "more": "and {n} more draws like these",
}
TESTS = (
    *("GL_CULL_FACE", "GL_ALPHA_TEST", "GL_STENCIL_TEST", "GL_DEPTH_TEST", "GL_SCISSOR_TEST"),
    *("GL_BLEND", "GL_FOG", "GL_LIGHTING", "GL_TEXTURE0.GL_TEXTURE_2D", "GL_COLOR_LOGIC_OP"),
)
MOST = 4  # draws that are described; chosen


def unseen_draws(tape: Tape, language: str = "en") -> list[str]:
    """Return lines about the draws of a tape's frame that leave no trace, as :func:`lines` does."""
    found = survey(tape, None)
    try:
        return list(lines(found, language))
    finally:
        found.trial.release()


def without_trace(tape: Tape) -> set[str]:
    """Return the places of the draws that change no pixel, where there are not too many draws.

    No places where the frame cannot be drawn again, in a core profile.
    """
    if not tape.start:
        return set()
    found = survey(tape, None)
    try:
        return {found.place_of(draw.number) for draw in found.shapes if draw.changed == 0}
    finally:
        found.trial.release()


def lines(found: Survey, language: str) -> Iterator[str]:
    """Yield lines about the draws that leave no trace in the picture."""
    hidden = [draw for draw in found.shapes if not found.seen(draw)]
    for draw in hidden[:MOST]:
        yield _text(
            language,
            "draw",
            place=found.place_of(draw.number),
            code=as_code(draw.call),
            source=draw.call.source,
        )
        yield "    " + ", ".join(_numbers(draw, language))
    if len(hidden) > MOST:
        yield _text(language, "more", n=len(hidden) - MOST)


def _numbers(draw: Drawn, language: str) -> Iterator[str]:
    placed = draw.placed
    if placed is None:
        yield _text(language, "unknown")
    else:
        yield _text(language, "vertices", n=placed.count, faces=placed.faces)
        if not placed.finite:
            yield _text(language, "nan")
        else:
            if placed.behind:
                yield _text(language, "behind", n=placed.behind)
            for plane, count in placed.beyond.items():
                if count and placed.behind != placed.count:
                    named = _text(language, f"plane.{plane}")
                    yield _text(language, "beyond", n=count, plane=named)
            near, far = near_far(draw.state["GL_PROJECTION_MATRIX"])
            nearest, farthest = (0.0 + value for value in placed.distances)
            yield _text(
                language,
                "distances",
                nearest=f"{nearest:.4g}",
                farthest=f"{farthest:.4g}",
                near=f"{near:.4g}",
                far=f"{far:.4g}",
            )

    yield _text(language, "fragments", covered=draw.covered, passed=draw.passed)
    if draw.changed is not None:
        yield _text(language, "changed", n=draw.changed)
    names = [name.removeprefix("GL_TEXTURE0.") for name in TESTS if draw.state[name]]
    if names:
        yield _text(language, "on", names=", ".join(names))


def _text(language: str, key: str, **words: object) -> str:
    return translator(language, "why")(TEXTS[key], key).format(**words)
