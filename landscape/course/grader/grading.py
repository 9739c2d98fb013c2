"""The form of an exercise's tests, in its grading.py.

    FRAMES = (0, 30)                          # the frames that are looked at
    EVENTS = [{"frame": 1, "key": "SPACE"}]   # optional: see framelens/program/program_events.py
    ELSEWHERE = 0.004   # optional: the fraction of the pixels that may differ in a trial (trial.py)

    @test(_("The fog is on"), _("Without glEnable the other calls for fog have no effect."))
    def fog_on(work, solution):
        if not work.last.draws[0].state["GL_FOG"]:
            clear, first = work.last.find("glClear")[0], work.last.draws[0]
            return hint(_("What turns the fog on is missing {place}."), place=between(clear, first))

    @test(_("The picture is right"), _("..."), needs=fog_on)
    def picture(work, solution):
        return compare(work, solution, regions={_("the far wall"): (0.3, 0.2, 0.7, 0.5)})

A test is a function of the evidence of the student's program and of the solution's (evidence.py).
It returns None if it has passed, else a :func:`hint`. Tests are made in their order in the file;
one whose ``needs`` have not passed is not made, because its hint would mislead. :func:`between`
says where a call is missing: "between line 41 (glClear) and line 44 (draw_scene)".

``_`` marks a text for the exercise's catalogue, landscape/locale/LANGUAGE/exercises/NAME.po or the
LANGUAGE.po of an exercise of one's own; it is translated when it is printed.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, reduce
from typing import Protocol

import numpy as np

from framelens.base.texts import filled
from framelens.spec import spec
from landscape.course.grader.calls import expanded
from landscape.course.grader.evidence import NO_LINE, Call, Draw, Evidence, Frame, drawn

LEVELS = 24  # chosen: levels by which a pixel may differ from the solution's
REACH = 1  # pixels by which an edge may be elsewhere: other ways to compute it round differently
FINE = 2  # chosen: levels by which it may where another way to the picture is not to be refused
NEAR = 1e-4  # chosen: by which numbers may be off that were computed twice
FEWEST = 20  # chosen: pixels of a region that may differ, however small it is
MOST = 0.0015  # chosen: the fraction of the pixels that may differ by more


class Text(str):
    """A text that is translated when it is printed."""

    __slots__ = ()


def _(text: str) -> Text:
    """Mark a text for the catalogue."""
    return Text(text)


DECIMAL_MARK = _(".")


@dataclass(frozen=True)
class Hint:
    """A text with its {values}; those that are hints or marked with ``_`` are translated, too."""

    text: str
    values: Mapping[str, object] = field(default_factory=dict, hash=False)

    def written(self, translate: Callable[[str], str]) -> str:
        """Return the hint in a language."""
        values = {name: _written(value, translate) for name, value in self.values.items()}
        return filled(translate(self.text), values, translate(DECIMAL_MARK))


def _written(value: object, translate: Callable[[str], str]) -> object:
    if isinstance(value, Hint):
        return value.written(translate)
    return translate(value) if isinstance(value, Text) else value


def hint(text: Text, **values: object) -> Hint:
    """Return what a failed test tells the student."""
    return Hint(text, values)


def between(first: Call | Draw | None, second: Call | Draw | None) -> Hint:
    """Return where something is missing, as a value of a hint.

    "between line 41 (glScalef) and line 44 (draw_scene)": the lines stand in one function where the
    two calls are made by one, so that the student can put something there. None stands for the
    beginning or the end: "before line 44 (draw_scene)". Not for glVertex and its like.
    """
    before, after = _way(first), _way(second)
    if not before or not after:
        if not before and not after:
            raise ValueError("neither of the two calls was made by the program")
        line, name = (before or after)[-1]
        text = _("after line {line} ({name})") if before else _("before line {line} ({name})")
        return hint(text, line=line, name=name)

    depth = 0
    while depth < min(len(before), len(after)) - 1 and before[depth] == after[depth]:
        depth += 1
    (line, name), (later, other) = before[depth], after[depth]
    text = _("between line {line} ({name}) and line {later} ({other})")
    if line >= later:
        text = _("between line {line} ({name}) and line {later} ({other}) of the next pass")
    return hint(text, line=line, name=name, later=later, other=other)


def _way(made: Call | Draw | None) -> Sequence[tuple[int, str]]:
    call = made.call if isinstance(made, Draw) else made
    if call is None:
        return ()
    return call.way or ([(call.line, call.name)] if call.line != NO_LINE else [])


class Check(Protocol):
    """A test's function."""

    __name__: str

    def __call__(self, work: Evidence, solution: Evidence) -> Hint | None:
        """Return None, or what is wrong."""


@dataclass(frozen=True)
class Test:
    """A test; ``key`` is the name of its function.

    ``demanded``: the task itself asks for what is tested, so that a right picture is not enough.
    ``points``: what it is worth beside the others. ``hidden``: it is not shown to students.
    """

    name: Text
    rationale: Text
    check: Check
    needs: tuple["Test", ...] = ()
    demanded: bool = False
    points: float = 1.0
    hidden: bool = False

    @property
    def key(self) -> str:
        """The name of the test's function."""
        return self.check.__name__


@dataclass(frozen=True)
class Result:
    """The result of a test; ``passed`` is None where it did not run.

    ``otherwise``: the program does something else than the test looks for, and its picture is right
    all the same.
    """

    test: Test
    passed: bool | None
    hint: Hint | None = None
    otherwise: bool = False


def test(
    name: Text,
    rationale: Text,
    needs: Test | Sequence[Test] = (),
    demanded: bool = False,
    points: float = 1.0,
) -> Callable[[Check], Test]:
    """Make a test of a function; it is made only if those that it ``needs`` have passed."""

    def make(check: Check) -> Test:
        wanted = (needs,) if isinstance(needs, Test) else tuple(needs)
        return Test(name, rationale, check, wanted, demanded, points)

    return make


def tests_of(module: Mapping[str, object]) -> list[Test]:
    """Return the tests of a grading.py in their order, from its names."""
    return [value for value in module.values() if isinstance(value, Test)]


def grade(
    tests: Iterable[Test], work: Evidence, solution: Evidence, right: bool = False
) -> list[Result]:
    """Make the tests and return what they found; all fail where there is nothing to check.

    That is where a frame has another size, or nothing is drawn in it. Where the picture is known to
    be ``right``, also under circumstances that no test names, only those tests can fail that the
    task demands: there is more than one way to a picture.
    """
    found: dict[str, Result] = {}
    nothing = _nothing_to_check(work, solution)
    for each in tests:
        if not all(found[needed.key].passed for needed in each.needs):
            found[each.key] = Result(each, None)
            continue

        told = nothing or _checked(each, work, solution)
        if told is not None and each.key != "picture" and state_in_lists(work):
            told = hint(UNFOLLOWED)
        if told is not None and work.early is not None:
            told = _without_context(*work.early)
        if told is not None and right and not each.demanded:
            found[each.key] = Result(each, True, otherwise=True)
        else:
            found[each.key] = Result(each, told is None, told)

    return list(found.values())


def same_pictures(tests: Iterable[Test], work: Evidence, solution: Evidence) -> bool:
    """Return whether the test that every exercise has of its pictures passes."""
    (pictures,) = [test for test in tests if test.key == "picture"]
    return _nothing_to_check(work, solution) is None and _checked(pictures, work, solution) is None


def _checked(test: Test, work: Evidence, solution: Evidence) -> Hint | None:
    """Make one test; a program that draws nothing of what it looks for must not break it."""
    try:
        with np.errstate(all="ignore"):
            return test.check(work, solution)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
        return hint(UNLIKE)


UNLIKE = _(
    "The program draws something else than the one you started from, so this cannot be checked. "
    "Compare it with a fresh one: landscape exercise start."
)


UNFOLLOWED = _(
    "The program sets OpenGL's state inside display lists. What is set there cannot be followed, "
    "so this cannot be checked; and the picture is not as it should be."
)
# Groups of calls that a display list may hold without changing the state that a test looks at.
FOLLOWED = ("vertex", "begin_end", "matrix", "draw", "list")


def state_in_lists(work: Evidence) -> bool:
    """Return whether a display list changes the state of OpenGL, and then draws something.

    What it draws has the state from before the list, as far as the tests know.
    """
    return any(
        _draws_otherwise(top)
        for frame in work.frames.values()
        for top in frame.top
        if isinstance(top, Call)
    )


def _draws_otherwise(executing: Call) -> bool:
    changed = False
    for call in expanded(executing.inside, None):
        known = spec.function(call.name)
        if changed and spec.draws(call.name):
            return True
        changed = changed or (known is not None and known.group not in FOLLOWED)
    return False


def _without_context(name: str, line: int) -> Hint:
    return hint(
        _(
            "Line {line} calls {name} before glfw.make_context_current. OpenGL has no context by "
            "then, and the call has no effect."
        ),
        line=line,
        name=name,
    )


def _nothing_to_check(work: Evidence, solution: Evidence) -> Hint | None:
    for number, frame in solution.frames.items():
        height, width = frame.picture.shape[:2]
        if work.frame(number).picture.shape != frame.picture.shape:
            return hint(
                _(
                    "The window must be {width} x {height} pixels, as in the program you started "
                    "from."
                ),
                width=width,
                height=height,
            )
        if _empty(work.frame(number)):
            return hint(_("In frame {frame} nothing is drawn."), frame=number)
    return None


def _empty(frame: Frame) -> bool:
    """Return whether nothing is drawn in a frame; it may be cleared."""
    names = frame.names - {"glBegin", "glClear"}
    if "glArrayElement" in names or any(spec.draws(name) for name in names):
        return False
    draws = drawn(frame.top, frame.numbers)
    return not any(len(draw.vertices) for draw in draws)  # mostly one is enough


def vertices(frame: Frame) -> int:
    """Return how many vertices are drawn in a frame."""
    return sum(len(draw.vertices) for draw in frame.draws)


def equal_pictures(work: Evidence, solution: Evidence) -> bool:
    """Return whether all pictures are equal but for rounding, and a few pixels at edges."""
    return all(
        differing(work.frame(number), wanted, FINE).mean() <= MOST
        for number, wanted in solution.frames.items()
    )


def same_drawing(work: Frame, again: Frame) -> bool:
    """Return whether a frame is the one that its calls give: its picture, and what is drawn."""
    if float(differing(work, again, FINE).mean()) > MOST or len(work.draws) != len(again.draws):
        return False
    return all(map(_same_draw, work.draws, again.draws))


def _same_draw(work: Draw, again: Draw) -> bool:
    return work.mode == again.mode and all(
        mine.shape == theirs.shape and _near(mine, theirs)
        for mine, theirs in (
            (work.vertices, again.vertices),
            (work.colors, again.colors),
            (work.modelview, again.modelview),
            (work.projection, again.projection),
        )
    )


def _near(mine: np.ndarray, theirs: np.ndarray) -> bool:
    """Return whether two arrays of one shape are equal but for rounding; most are equal."""
    return bool((mine == theirs).all()) or np.allclose(mine, theirs, atol=NEAR, equal_nan=True)


# Pictures.

Box = tuple[float, float, float, float]
"""A part of the picture: left, top, right, bottom, each from 0 to 1, from the top left."""

Regions = Mapping[object, Box | np.ndarray]
"""Parts of the picture by name, a text or a hint: boxes, or masks, bool (h, w), top row first."""


@lru_cache(maxsize=16)  # the frames of one program
def differing(work: Frame, solution: Frame, levels: int = LEVELS) -> np.ndarray:
    """Return which pixels differ, bool (h, w): from the solution's pixel and from its neighbours.

    By more than some ``levels``. All of them if the sizes differ. The array is kept for the next
    call: do not change it.
    """
    found = _differing(work, solution, levels)
    found.setflags(write=False)
    return found


def _differing(work: Frame, solution: Frame, levels: int) -> np.ndarray:
    if work.picture.shape != solution.picture.shape:
        return np.ones(work.picture.shape[:2], bool)
    # Only the part around all pixels that are not the same: often it is small.
    other = _any_channel(work.picture != solution.picture)
    inside = tuple(_extent(np.logical_or.reduce(other, axis)) for axis in (1, 0))
    if other.any():
        around = tuple(slice(part.start, part.stop + 2 * REACH) for part in inside)
        padded = np.pad(solution.picture, ((REACH, REACH), (REACH, REACH), (0, 0)), mode="edge")
        other[inside] = _beyond(
            work.picture[inside], solution.picture[inside], padded[around], levels
        )
    return other


def _extent(mask: np.ndarray) -> slice:
    """Return the part of a row from its first True to its last."""
    places = np.flatnonzero(mask)
    return slice(places[0], places[-1] + 1) if len(places) else slice(0)


def _beyond(theirs: np.ndarray, ours: np.ndarray, padded: np.ndarray, levels: int) -> np.ndarray:
    """Return which pixels of a part differ; ``padded`` is ours with REACH more on each side."""
    found = _any_channel(np.maximum(ours, theirs) - np.minimum(ours, theirs) > levels)
    # Most pixels that differ are beyond all of their neighbours; only for the others look at each.
    low, high = _extreme(np.minimum, padded), _extreme(np.maximum, padded)
    beyond = (theirs > high) & (theirs - high > levels) | (theirs < low) & (low - theirs > levels)
    rows, columns = np.nonzero(found & ~_any_channel(beyond))
    mine = theirs[rows, columns].astype(np.int16)
    nearest = np.full(len(rows), 255)
    for down in range(2 * REACH + 1):
        for right in range(2 * REACH + 1):
            apart = np.abs(padded[rows + down, columns + right] - mine)
            nearest = np.minimum(nearest, np.maximum.reduce(apart.T))
    found[rows, columns] = nearest > levels
    return found


def _any_channel(mask: np.ndarray) -> np.ndarray:
    return np.asarray(mask[..., 0] | mask[..., 1] | mask[..., 2])


def _extreme(choose: np.ufunc, padded: np.ndarray) -> np.ndarray:
    """Return the least or greatest value around each pixel of a picture, within REACH."""
    height, width = (size - 2 * REACH for size in padded.shape[:2])
    rows = [padded[down : down + height] for down in range(2 * REACH + 1)]
    around = reduce(choose, rows)
    return reduce(choose, [around[:, right : right + width] for right in range(2 * REACH + 1)])


def difference(work: Frame, solution: Frame, box: Box = (0, 0, 1, 1)) -> float:
    """Return the fraction of the pixels of a part of the picture that differ."""
    return float(_part(differing(work, solution), box).mean())


def _part(mask: np.ndarray, box: Box) -> np.ndarray:
    """Return a part of a mask, (h, w): at least one pixel of it."""
    height, width = mask.shape
    left, right = round(box[0] * width), round(box[2] * width)
    top, bottom = round(box[1] * height), round(box[3] * height)
    return mask[top : max(bottom, top + 1), left : max(right, left + 1)]


def compare(
    work: Evidence,
    solution: Evidence,
    told: Hint | None = None,
    box: Box = (0, 0, 1, 1),
    most: float = MOST,
    frames: Sequence[int] | None = None,
    regions: Regions | Callable[[int], Regions] | None = None,
) -> Hint | None:
    """Compare the pictures of some frames, of all by default, with the solution's.

    ``most``: the fraction of the pixels in the ``box`` that may differ, and of those in each of the
    ``regions``, which have names such as _("the second column"); where they lie elsewhere in each
    frame, a function of its number returns them. ``told`` is the hint where more differ; the
    default names the region with the largest fraction, and the place in the picture.
    """
    for number in solution.frames if frames is None else frames:
        found = differing(work.frame(number), solution.frame(number))
        named = (regions(number) if callable(regions) else regions or {}) if found.any() else {}
        parts = {name: _mask(area, found) for name, area in named.items()}
        shares = {name: _share(found, part, most) for name, part in parts.items()}
        worst = max(shares, key=lambda name: shares[name], default=None)
        if worst is not None and shares[worst] > most:
            return told or hint(
                _(
                    "In frame {frame} the difference is {where}: {region}. {percent:.1f} % of the "
                    "pixels there are not as they should be. --heat-map FILE.png shows which."
                ),
                frame=number,
                where=_where(found & parts[worst]),
                region=worst,
                percent=100 * shares[worst],
            )
        fraction = float(_part(found, box).mean())
        if fraction > most:
            return told or hint(
                _(
                    "In frame {frame}, {percent:.1f} % of the pixels are not as they should be, "
                    "most of them {where}. --heat-map FILE.png shows which."
                ),
                frame=number,
                percent=100 * fraction,
                where=_where(found & _mask(box, found)),
            )

    return None


def _mask(area: Box | np.ndarray, like: np.ndarray) -> np.ndarray:
    if isinstance(area, np.ndarray):
        return area
    mask = np.zeros_like(like)
    _part(mask, area)[:] = True
    return mask


def _share(found: np.ndarray, region: np.ndarray, most: float) -> float:
    """Return the fraction of a region that differs; 0 where it may be rounding at its edges."""
    count = int((found & region).sum())
    return count / int(region.sum()) if count > FEWEST or most == 0 else 0.0


PLACES = (
    (_("at the top left"), _("at the top"), _("at the top right")),
    (_("at the left"), _("in the middle"), _("at the right")),
    (_("at the bottom left"), _("at the bottom"), _("at the bottom right")),
)


def _where(mask: np.ndarray) -> Text:
    """Return in which ninth of the picture most pixels of a mask are."""
    counts = [
        [_part(mask, (x / 3, y / 3, (x + 1) / 3, (y + 1) / 3)).sum() for x in range(3)]
        for y in range(3)
    ]
    row, column = divmod(int(np.argmax(counts)), 3)
    return PLACES[row][column]
