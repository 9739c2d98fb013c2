"""Pixel history: every draw that covered a pixel, and what became of each of its fragments.

The frame is drawn again with everything but the pixel cut away. Each draw is asked whether it
covers the pixel, taken apart into its primitives if it does, and each of those is asked how far it
comes through the tests, and with what colour.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from framelens.base.errors import InputError
from framelens.gl.seam import Call, gl
from framelens.tape.arithmetic import COMPARISONS, MODES, Blend, colour, fogged, token
from framelens.tape.lighting import shares
from framelens.tape.primitives import Draw, Primitives, grouped, primitives
from framelens.tape.probe import Draws, Pixel, Probe, enabled, number
from framelens.tape.steps import Step, issue
from framelens.tape.tape import Tape
from framelens.tape.textures import completeness

# Between these, OpenGL counts or selects for the program itself.
ASIDE = ("glBeginQuery", "glEndQuery", "glRenderMode", "glSelectBuffer", "glFeedbackBuffer")
# Calls that copy pixels of the frame elsewhere: with one of them all pixels must be right.
COPIES = ("glCopy", "glBlitFramebuffer", "glAccum")
WHOLESALE = ("glClear", *COPIES)


@dataclass(frozen=True)
class Row:
    """A fragment, or what else happened to the pixel: the call, what came of it, and the numbers.

    ``outcome`` is drawn, clip, scissor, alpha, stencil, depth or masked. ``primitive`` counts the
    primitives of a draw call. ``parts`` has the numbers that ``arithmetic`` writes out.
    """

    step: Step
    outcome: str
    arithmetic: str
    pixel: Pixel
    primitive: int | None = None
    parts: dict[str, object] = field(default_factory=dict)

    @property
    def call(self) -> Call:
        """The call that drew."""
        return self.step.call

    def as_json(self) -> dict[str, object]:
        """Return the row as `landscape pixel --json` prints it."""
        call, place = self.call, self.step.place
        entry: dict[str, object] = {
            "call": self.step.number,
            "name": call.name,
            "element": self.step.elements[0],
            "source": call.source,
            "pass": self.step.top.pass_,
            "outcome": self.outcome,
            "arithmetic": self.arithmetic,
            "color": list(self.pixel.color),
            "depth": self.pixel.depth,
            "stencil": self.pixel.stencil,
        }
        if "." in place:
            entry["inside"] = place
        if self.primitive is not None:
            entry["primitive"] = self.primitive
        return entry | self.parts


def history(tape: Tape, x: int, y: int) -> list[Row]:
    """Return what happened to a pixel of the tape's frame; ``x``, ``y`` from the top left.

    The tape's context must be current. InputError for a pixel outside the picture.
    """
    width, height = tape.size
    if not (0 <= x < width and 0 <= y < height):
        raise InputError(
            "pixel {x},{y}: expected one of the picture, 0,0 to {width},{height}",
            x=x,
            y=y,
            width=width - 1,
            height=height - 1,
        )

    tape.rewind()
    place = x, height - 1 - y
    probe = Probe(*place, tape.size)
    frame = _History(tape, probe, place)
    try:
        return list(frame.rows())
    finally:
        frame.release()
        probe.release()
        tape.rewind()


class _History:
    def __init__(self, tape: Tape, probe: Probe, place: tuple[int, int]) -> None:
        self._tape = tape
        self._probe = probe
        self._place = place
        self._list = int(gl.glGenLists(1))
        self._whole = any(step.call.name.startswith(COPIES) for step in tape.steps())

    def release(self) -> None:
        """Delete the display list."""
        gl.glDeleteLists(self._list, 1)

    def rows(self) -> Iterator[Row]:
        """Draw the frame again; yield the rows in the order of the draws."""
        for item in grouped(self._tape.steps()):
            if isinstance(item, Step):
                if not item.call.name.startswith(ASIDE):
                    issue(item.call)
            elif not self._probe.here():
                item.issue()
            elif item.first.call.name.startswith(WHOLESALE):
                yield from self._wholesale(item)
            else:
                yield from self._fragments(item)

    def _wholesale(self, draw: Draw) -> Iterator[Row]:
        """Yield a row for what sets many pixels without fragments: a clear, a blit."""
        before = self._probe.read()
        outside = self._scissored_away()
        if self._whole:
            draw.issue()
        elif not outside:
            with self._probe.scissored():
                draw.issue()
        after = self._probe.read()
        call, outcome = draw.first.call, "drawn"
        if call.name == "glClear" and not int(call.args[0]) & int(gl.GL_COLOR_BUFFER_BIT):
            outcome = "masked"
        if outside:
            outcome = "scissor"
        text = f"set to = {colour(_unit(after), 4)}"
        if outcome != "drawn" or call.name != "glClear":
            text = f"{colour(_unit(before))} becomes = {colour(_unit(after), 4)}"
        yield Row(draw.first, outcome, text, after)

    def _fragments(self, draw: Draw) -> Iterator[Row]:
        probe, parts = self._probe, primitives(draw)
        total = probe.count(draw.issue)
        if total:
            if "." in draw.first.place:
                parts = self._through_list(parts)
            for index, fragments in self._covering(parts, 0, parts.count, total):
                single = parts.count == 1
                one = _part(parts, index)
                yield self._row(draw.first, one, None if single else index, fragments)
        if self._whole:
            self._around(draw)
        if draw.first.call.name == "glBegin":
            self._touch(draw)

    def _through_list(self, parts: Primitives) -> Primitives:
        """Return the same primitives, drawn by a display list as in the program.

        Mesa splits the quads of a list into triangles along the other diagonal.
        """

        def draw(first: int, last: int) -> None:
            gl.glNewList(self._list, gl.GL_COMPILE)
            parts.draw(first, last)
            gl.glEndList()
            gl.glCallList(self._list)

        return Primitives(parts.count, draw)

    def _covering(
        self, parts: Primitives, first: int, last: int, total: int
    ) -> Iterator[tuple[int, int]]:
        """Yield the primitives with fragments at the pixel and their numbers, by bisection."""
        if last - first == 1:
            yield first, total
            return
        middle = (first + last) // 2
        left = self._probe.count(lambda: parts.draw(first, middle))
        if left:
            yield from self._covering(parts, first, middle, left)
        if total > left:
            yield from self._covering(parts, middle, last, total - left)

    def _row(self, step: Step, draw: Draws, primitive: int | None, fragments: int) -> Row:
        outcome, text = self._outcome(draw)
        parts: dict[str, object] = {} if fragments == 1 else {"fragments": fragments}
        before = self._probe.read()
        if outcome == "drawn":
            text, parts = self._arithmetic(draw, before, parts)
        if outcome != "scissor":
            with self._probe.scissored():
                draw()
        return Row(step, outcome, text, self._probe.read(), primitive, parts)

    def _scissored_away(self) -> bool:
        """Whether the program's own scissor box leaves the pixel out."""
        if not enabled("GL_SCISSOR_TEST"):
            return False
        left, low, width, height = number("GL_SCISSOR_BOX")
        x, y = self._place
        return not (left <= x < left + width and low <= y < low + height)

    def _outcome(self, draw: Draws) -> tuple[str, str]:
        """Return what becomes of a fragment, and why, as text."""
        probe = self._probe
        planes = probe.planes()
        if planes and not probe.count(draw, ["clip"]):
            names = " or ".join(f"GL_CLIP_PLANE{plane}" for plane in planes)
            return "clip", f"behind {names}"
        if self._scissored_away():
            return "scissor", f"outside the scissor box {number('GL_SCISSOR_BOX')}"
        if failed := self._failed_test(draw):
            return failed
        if not any(np.ravel(number("GL_COLOR_WRITEMASK"))):
            return "masked", "the colour mask lets no component through"
        return "drawn", ""

    def _failed_test(self, draw: Draws) -> tuple[str, str] | None:
        """Return which of alpha, stencil and depth test a fragment fails, and why."""
        probe = self._probe
        if enabled("GL_ALPHA_TEST") and not probe.count(draw, ["clip", "alpha"]):
            alpha = probe.fragment(draw)[0][3]
            compared = token(number("GL_ALPHA_TEST_FUNC"), COMPARISONS)
            return "alpha", f"alpha {alpha:.3f} {compared} {number('GL_ALPHA_TEST_REF'):.3f}: fails"

        if enabled("GL_STENCIL_TEST") and not probe.count(draw, ["clip", "alpha", "stencil"]):
            compared = token(number("GL_STENCIL_FUNC"), COMPARISONS)
            ref, marked = int(number("GL_STENCIL_REF")), probe.read().stencil
            return "stencil", f"reference {ref} {compared} {marked} in the stencil buffer: fails"

        if enabled("GL_DEPTH_TEST") and not probe.count(
            draw, ["clip", "alpha", "stencil", "depth"]
        ):
            depth, held = probe.fragment(draw)[1], probe.read().depth
            compared = token(number("GL_DEPTH_FUNC"), COMPARISONS)
            return "depth", f"depth {depth:.6f} {compared} {held:.6f}: fails"
        return None

    def _of_unit(
        self, draw: Draws, units: Sequence[int], place: int
    ) -> tuple[str, dict[str, object]]:
        """Return what one of the texture units makes of the colour, as text and as numbers."""
        unit = units[place]
        if missing := self._incomplete(unit):
            return f"unit {unit}: {missing}", {"unit": unit, "incomplete": missing}
        result = self._through(draw, units, place + 1)
        texel = self._texel(draw, unit, units)
        mode = self._mode(unit)
        text = f"unit {unit}, {mode}, texel {colour(texel)}: {colour(result)}"
        numbers = {"unit": unit, "mode": mode, "texel": _list(texel), "result": _list(result)}
        return text, numbers

    def _of_fog(
        self, draw: Draws, units: Sequence[int], source: np.ndarray
    ) -> tuple[str, dict[str, object]]:
        """Return what fog makes of the colour, which is ``source`` (4,) then."""
        plain = self._through(draw, units, len(units))
        haze = np.array(number("GL_FOG_COLOR"))
        left, text = fogged(plain, source, haze)
        return text, {"factor": left, "color": _list(haze), "result": _list(source)}

    def _arithmetic(
        self, draw: Draws, before: Pixel, parts: dict[str, Any]
    ) -> tuple[str, dict[str, object]]:
        """Return how a drawn fragment gets its colour, as text and as numbers."""
        probe = self._probe
        units = probe.units()
        texts: list[str] = []

        if enabled("GL_LIGHTING"):
            lines, parts["lighting"] = shares(lambda set_: self._through(draw, units, 0, set_))
            texts += lines
        if units:
            value = self._through(draw, units, 0)
            texts.append(f"colour {colour(value)}")
            parts["primary"] = _list(value)
            steps = [self._of_unit(draw, units, place) for place in range(len(units))]
            texts += [text for text, _ in steps]
            parts["units"] = [numbers for _, numbers in steps]
        source, depth = probe.fragment(draw)
        if enabled("GL_FOG"):
            text, parts["fog"] = self._of_fog(draw, units, source)
            texts.append(text)
        _mixed, text = Blend.now().mix(source, _unit(before))
        texts.append(text)
        parts |= {"fragment": _list(source), "fragment_depth": depth}
        return "; ".join(texts), parts

    def _through(
        self, draw: Draws, units: Sequence[int], first: int, change: Draws = lambda: None
    ) -> np.ndarray:
        """Return a fragment's colour before the fog, past the first so many texture units.

        ``change`` may set other state for it.
        """

        def prepare() -> None:
            gl.glDisable(gl.GL_FOG)
            self._probe.without_units(units[first:])
            change()

        return self._probe.fragment(draw, prepare)[0]

    def _texel(self, draw: Draws, unit: int, units: Sequence[int]) -> np.ndarray:
        """Return the colour that a texture unit samples for the fragment."""

        def alone() -> None:
            gl.glDisable(gl.GL_FOG)
            self._probe.without_units([each for each in units if each != unit])
            gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)

        return self._probe.fragment(draw, alone)[0]

    def _incomplete(self, unit: int) -> str:
        """Return why a unit's two-dimensional texture is not used, "" if it is."""
        active = int(gl.glGetIntegerv(gl.GL_ACTIVE_TEXTURE))
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        try:
            if any(enabled(name) for name in ("GL_TEXTURE_3D", "GL_TEXTURE_CUBE_MAP")):
                return ""
            if not enabled("GL_TEXTURE_2D"):
                return ""
            texture = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
            what = completeness(texture)
        finally:
            gl.glActiveTexture(active)

        if what is None:
            return ""
        _, value, sizes = what
        if value == "empty":
            return f"texture {texture} has no image, so it is not used"
        size = f"{sizes['width']} x {sizes['height']}"
        return (
            f"texture {texture} is incomplete, so it is not used: {value} reads level "
            f"{sizes['level']} ({size}), which is missing"
        )

    def _mode(self, unit: int) -> str:
        """Return how a texture unit mixes its texel with the colour."""
        active = int(gl.glGetIntegerv(gl.GL_ACTIVE_TEXTURE))
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        mode = np.ravel(gl.glGetTexEnviv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE))[0]
        gl.glActiveTexture(active)
        return token(mode, MODES)

    def _around(self, draw: Draw) -> None:
        """Draw into all pixels but this one, which a later copy may read."""
        x, y = self._place
        width, height = self._tape.size
        boxes = (
            (0, 0, width, y),
            (0, y + 1, width, height - y - 1),
            (0, y, x, 1),
            (x + 1, y, width - x - 1, 1),
        )
        own = [0.0, 0.0, float(width), float(height)]
        if enabled("GL_SCISSOR_TEST"):
            own = number("GL_SCISSOR_BOX")

        for left, low, wide, high in boxes:
            right, top = min(left + wide, own[0] + own[2]), min(low + high, own[1] + own[3])
            left, low = max(left, int(own[0])), max(low, int(own[1]))
            if right > left and top > low:
                gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
                gl.glEnable(gl.GL_SCISSOR_TEST)
                gl.glScissor(left, low, int(right - left), int(top - low))
                draw.issue()
                gl.glPopAttrib()

    def _touch(self, draw: Draw) -> None:
        """Make a glBegin's calls without a pixel: the current colour, normal, ... outlast it."""
        gl.glPushAttrib(
            gl.GL_COLOR_BUFFER_BIT
            | gl.GL_DEPTH_BUFFER_BIT
            | gl.GL_STENCIL_BUFFER_BIT
            | gl.GL_SCISSOR_BIT
        )
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(0, 0, 0, 0)
        draw.issue()
        gl.glPopAttrib()


def _part(parts: Primitives, index: int) -> Draws:
    return lambda: parts.draw(index, index + 1)


def _unit(pixel: Pixel) -> np.ndarray:
    return np.array(pixel.color) / 255.0


def _list(values: np.ndarray) -> list[float]:
    return [round(float(value), 5) for value in values]
