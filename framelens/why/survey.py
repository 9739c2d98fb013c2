"""The frame walked once: the state, the vertices and the fragments of each draw, as numbers.

In this order: the frame is drawn, and before each draw the variables of :data:`NAMES` are read and
its vertices collected; after it, where there are few draws, the picture is compared with the one
before. Then occlusion queries count, draw by draw, the fragments that pass all tests, and those
that there would be without any test. The last setter of each variable is known from the frames
before on.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from framelens.gl.named import gl_constant, gl_function
from framelens.gl.raw import raw
from framelens.gl.seam import Call, GluCall, gl
from framelens.program.past import Past, Setters
from framelens.program.program_run import Chain
from framelens.state.state_reading import Values, read_some
from framelens.tape.primitives import Draw
from framelens.tape.steps import Step
from framelens.tape.tape import Tape
from framelens.why.flat import flattened
from framelens.why.geometry import Placed, Vertices, array_now, placed, vertices
from framelens.why.trial import NOTHING, Around, CallFailed, Change, Item, Trial, changed, counted

ENABLES = (
    *("GL_CULL_FACE", "GL_DEPTH_TEST", "GL_STENCIL_TEST", "GL_ALPHA_TEST", "GL_SCISSOR_TEST"),
    *("GL_BLEND", "GL_LIGHTING", "GL_FOG", "GL_COLOR_MATERIAL", "GL_NORMALIZE"),
    *("GL_RESCALE_NORMAL", "GL_COLOR_LOGIC_OP", "GL_POLYGON_STIPPLE", "GL_LINE_STIPPLE"),
    *(f"GL_LIGHT{k}" for k in range(8)),
    *(f"GL_CLIP_PLANE{k}" for k in range(6)),
    *("GL_VERTEX_ARRAY", "GL_NORMAL_ARRAY", "GL_COLOR_ARRAY"),
)
OF_LIGHTS = (
    *("DIFFUSE", "POSITION", "SPOT_CUTOFF"),
    *("CONSTANT_ATTENUATION", "LINEAR_ATTENUATION", "QUADRATIC_ATTENUATION"),
)
MAPS = tuple(f"GL_MAP{d}_VERTEX_{n}" for d in (1, 2) for n in (3, 4))
NAMES = (
    *ENABLES,
    *("GL_TEXTURE0.GL_TEXTURE_2D", "GL_TEXTURE0.GL_TEXTURE_BINDING_2D"),
    *("GL_TEXTURE0.GL_TEXTURE_ENV.GL_TEXTURE_ENV_MODE", "GL_TEXTURE0.GL_TEXTURE_GEN_S"),
    *("GL_TEXTURE0.GL_TEXTURE_1D", "GL_TEXTURE0.GL_TEXTURE_CUBE_MAP"),
    *("GL_TEXTURE0.GL_TEXTURE_3D", "GL_TEXTURE0.GL_TEXTURE_COORD_ARRAY"),
    *("GL_TEXTURE1.GL_TEXTURE_2D", "GL_ACTIVE_TEXTURE", "GL_TEXTURE0.GL_TEXTURE_MATRIX"),
    *("GL_CULL_FACE_MODE", "GL_FRONT_FACE", "GL_POLYGON_MODE", "GL_DEPTH_FUNC"),
    *("GL_DEPTH_WRITEMASK", "GL_COLOR_WRITEMASK", "GL_DEPTH_CLEAR_VALUE", "GL_COLOR_CLEAR_VALUE"),
    *("GL_DEPTH_RANGE", "GL_STENCIL_FUNC", "GL_STENCIL_REF", "GL_ALPHA_TEST_FUNC"),
    *("GL_ALPHA_TEST_REF", "GL_BLEND_SRC_RGB", "GL_BLEND_DST_RGB", "GL_SCISSOR_BOX"),
    *("GL_VIEWPORT", "GL_MATRIX_MODE", "GL_MODELVIEW_MATRIX", "GL_PROJECTION_MATRIX"),
    *("GL_CURRENT_COLOR", "GL_CURRENT_NORMAL", "GL_FOG_COLOR", "GL_FOG_START", "GL_FOG_END"),
    *("GL_FOG_MODE", "GL_FOG_DENSITY", "GL_FRONT.GL_DIFFUSE", "GL_FRONT.GL_AMBIENT"),
    *("GL_FRONT.GL_EMISSION", "GL_LIGHT_MODEL_AMBIENT", "GL_LIGHT_MODEL_TWO_SIDE"),
    *("GL_STENCIL_FAIL", "GL_STENCIL_PASS_DEPTH_FAIL", "GL_STENCIL_PASS_DEPTH_PASS"),
    *(f"GL_LIGHT{k}.GL_{what}" for k in range(8) for what in OF_LIGHTS),
    *("GL_COLOR_MATERIAL_FACE", "GL_COLOR_MATERIAL_PARAMETER"),
    *("GL_TEXTURE0.GL_TEXTURE_BINDING_1D", *MAPS),
    *("GL_DRAW_BUFFER", "GL_CURRENT_RASTER_POSITION_VALID", "GL_CURRENT_RASTER_COLOR"),
    *("GL_RENDER_MODE", "GL_POINT_SIZE", "GL_LINE_WIDTH", "GL_MODELVIEW_STACK_DEPTH"),
    *("GL_DRAW_FRAMEBUFFER_BINDING", "GL_LOGIC_OP_MODE", "GL_CURRENT_RASTER_POSITION"),
)
PICTURES = 300  # draws up to which each is compared with the picture before it; chosen
DRAWN_TEXT = ("glutBitmap", "glBitmap", "glDrawPixels")
MOST_DRAWS = 3000  # whose state is read; chosen


@dataclass
class Drawn:
    """A draw, as the survey found it.

    ``state`` are the variables of NAMES in which it is made, ``passed`` its fragments that pass all
    tests and ``covered`` those it has without tests; ``at_pixel`` the same two for the pixel asked
    about; ``changed`` the pixels whose colour it changes, None where that was not looked at.
    """

    index: int
    item: Item
    state: Values
    setters: Setters
    chain: Chain
    number: int
    vertices: Vertices | None = None
    passed: int = 0
    covered: int = 0
    at_pixel: tuple[int, int] = (0, 0)
    changed: int | None = None
    color: tuple[int, ...] = ()  # of the pixel asked about, after it
    error: str = ""

    @property
    def call(self) -> Call:
        """The call that draws."""
        return self.item.call

    @property
    def draw(self) -> Draw:
        """The draw itself."""
        assert self.item.draw is not None
        return self.item.draw

    @property
    def steps(self) -> Sequence[Step]:
        """Its calls: from a glBegin to its glEnd, or the one call that draws."""
        return self.draw.steps

    @property
    def place(self) -> str:
        """Its place in the frame."""
        return self.item.place

    @property
    def clears(self) -> bool:
        """Whether it makes no fragments: a clear or a copy."""
        return not counted(self.call.name)

    @property
    def places(self) -> frozenset[str]:
        """Its place, for :class:`framelens.why.trial.Around`."""
        return frozenset((self.place,))

    @cached_property
    def placed(self) -> Placed | None:
        """Where its vertices are; None where they are not known."""
        if self.vertices is None or not len(self.vertices.positions):
            return None
        state = self.state
        return placed(self.vertices, state["GL_MODELVIEW_MATRIX"], state["GL_PROJECTION_MATRIX"])

    def setter(self, name: str) -> Call | None:
        """Return the call that set a variable last."""
        return self.setters.last.get(name)


@dataclass
class Survey:
    """The material of the rules: a frame's draws, its base picture, and its past.

    ``pixel`` is the place asked about, from the top left, or None. ``place_of`` gives the place
    of a call in the frame as it was recorded, by its number; ``called`` are the display lists that
    the frame executes.
    """

    tape: Tape
    trial: Trial
    pixel: tuple[int, int] | None
    base: np.ndarray
    draws: list[Drawn]
    calls: Sequence[Call]
    errors: list[tuple[str, Call, str]]
    place_of: Callable[[int], str]
    called: frozenset[int]

    @property
    def past(self) -> Past | None:
        """The frame's past, where the tape comes from a program."""
        return self.tape.past

    @property
    def glu(self) -> Sequence[GluCall]:
        """The calls of GLU in the setup and in the frame."""
        return self.tape.past.glu if self.tape.past else ()

    @property
    def shapes(self) -> list[Drawn]:
        """The draws that make fragments."""
        return [draw for draw in self.draws if not draw.clears]

    @cached_property
    def background(self) -> np.ndarray | None:
        """The picture without what draws shapes: what is cleared, or was there before."""
        places = {place: () for draw in self.shapes for place, _ in draw.item.thunks if place}
        return self.trial.picture(Change(instead=places))

    @cached_property
    def empty(self) -> bool:
        """Whether the picture shows nothing but the background, or one colour."""
        flat = self.base.reshape(-1, 3)
        if not changed(self.base, self.base[:1, :1].repeat(1, 0), 6).any():
            return True
        bare = self.background
        return not flat.size or (bare is not None and not changed(self.base, bare).any())

    def same(self, draws: Sequence[Drawn]) -> list[list[Drawn]]:
        """Return draws in groups: those that the same lines of the program lead to."""
        groups: dict[object, list[Drawn]] = {}
        for draw in draws:
            groups.setdefault(draw.chain or draw.place, []).append(draw)
        return list(groups.values())

    def hidden(self) -> Iterator[list[Drawn]]:
        """Yield the groups of draws that show nothing: by function, all that it draws.

        A group is what one call of a function of the program's draws, or one line of code, if no
        part of it is seen. In a picture that is empty every draw is one, and each that would cover
        the pixel asked about.
        """
        shapes = self.shapes
        unseen = {draw.index for draw in shapes if not self.seen(draw)}
        done: set[int] = set()
        deepest = max((len(draw.chain) for draw in shapes), default=0)
        for depth in range(1, deepest + 1):
            groups: dict[Chain, list[Drawn]] = {}
            for draw in shapes:
                if len(draw.chain) >= depth:
                    groups.setdefault(draw.chain[:depth], []).append(draw)
            for group in groups.values():
                mine = {draw.index for draw in group}
                if mine <= unseen and not mine & done:
                    done |= mine
                    yield group

        for draw in shapes:
            missed = draw.at_pixel[1] > 0 and draw.at_pixel[0] == 0
            if draw.index in unseen and draw.index not in done and (self.empty or missed):
                yield [draw]

    def seen(self, draw: Drawn) -> bool:
        """Return whether a draw has changed the picture."""
        return draw.passed > 0 and draw.changed != 0


class PickedPixel:
    """Counts fragments at one pixel alone."""

    def __init__(self, x: int, y: int) -> None:
        self._box = x, y, 1, 1

    def around(self) -> Around:
        """Return what leaves of each draw this pixel."""
        return Around(
            int(gl.GL_SCISSOR_BIT) | int(gl.GL_ENABLE_BIT),
            [("glEnable", (gl.GL_SCISSOR_TEST,)), ("glScissor", self._box)],
        )


def untested() -> Around:
    """Return what lets every fragment of a draw pass."""
    off = (
        *("CULL_FACE", "DEPTH_TEST", "STENCIL_TEST", "ALPHA_TEST", "SCISSOR_TEST"),
        *("POLYGON_STIPPLE", "LINE_STIPPLE"),
    )
    planes = [("glDisable", (gl.GL_CLIP_PLANE0 + k,)) for k in range(6)]
    return Around(
        int(gl.GL_ENABLE_BIT), [("glDisable", (gl_constant(f"GL_{n}"),)) for n in off] + planes
    )


class _Walk:
    """Notes each draw of a frame while it is made, and what OpenGL refuses."""

    def __init__(self, tape: Tape, trial: Trial, pixel: tuple[int, int] | None) -> None:
        self.draws: list[Drawn] = []
        self.errors: list[tuple[str, Call, str]] = []
        self._past = tape.past
        self._trial = trial
        self._pixel = pixel
        self._pictures = len(trial.draws) <= PICTURES
        self._last: np.ndarray | None = None  # the picture so far
        self._setters = tape.past.setters.copied() if tape.past else Setters()
        self._kept: Setters | None = None  # a copy, as long as nothing is set

    def make(self, item: Item, draw: Callable[[], None]) -> None:
        """Note a draw, and make it."""
        found = self._noted(item)
        self.draws.append(found)
        if self._last is None and self._pictures:
            self._last = self._trial.read()
        try:
            draw()
        except Exception as error:
            found.error = _short(error)
            self.errors.append((item.place, item.call, found.error))

        _drain(self.errors, item)
        for step in found.steps:
            self._setters.follow(step.call)
        self._kept = None
        if self._pictures:
            self._compare(found)

    def step(self, item: Item) -> None:
        """Follow a call that draws nothing."""
        self._setters.follow(item.call)
        self._kept = None
        _drain(self.errors, item)

    def _noted(self, item: Item) -> Drawn:
        """Return what there is to know of a draw before it is made."""
        assert item.draw is not None
        _read_arrays(item)
        if self._kept is None:
            self._kept = self._setters.copied()
        number = item.draw.first.number
        chain = self._past.chains.get(number, ()) if self._past else ()
        found = Drawn(len(self.draws), item, read_some(NAMES), self._kept, chain, number)
        if len(self.draws) < MOST_DRAWS and not found.clears:
            found.vertices = vertices(item.draw)
        return found

    def _compare(self, found: Drawn) -> None:
        """Note which pixels a draw has changed."""
        after = self._trial.read()
        if after is not None and self._last is not None:
            found.changed = int(changed(self._last, after, 1).sum())
        self._last = after
        if self._pixel and after is not None:
            found.color = tuple(int(c) for c in after[self._pixel[1], self._pixel[0]])


def survey(tape: Tape, pixel: tuple[int, int] | None) -> Survey:
    """Walk a tape's frame, in its context; ``pixel`` is asked about, from the top left."""
    flat = flattened(tape)
    tape = flat.tape
    trial = Trial(tape)
    walk = _Walk(tape, trial, pixel)
    draws, errors = walk.draws, walk.errors
    try:
        trial.run(NOTHING, walk.make, walk.step)
    except CallFailed as error:
        place = trial.items[len(draws)].place if draws else ""
        call = draws[-1].call if draws else (tape.frame[-1] if tape.frame else None)
        if call is not None:
            errors.append((place, call, str(error)))

    _count(trial, draws, pixel)
    base = _base(tape, trial)
    return Survey(tape, trial, pixel, base, draws, tape.frame, errors, flat.place, flat.called)


def _base(tape: Tape, trial: Trial) -> np.ndarray:
    """Return the picture of the frame as it is; black where its program ends in it."""
    base = trial.picture()
    if base is None:
        base = trial.read()
    if base is None or (tape.past is not None and tape.past.error is not None):
        return np.zeros((*tape.size[::-1], 3), np.uint8)
    return base


def _count(trial: Trial, draws: Sequence[Drawn], pixel: tuple[int, int] | None) -> None:
    """Count the fragments of draws with and without tests, of all and of the pixel."""
    nothing = [0] * len(draws)
    passed = trial.counts() or nothing
    covered = trial.counts(Change(around=(untested(),))) or nothing
    for draw, inside, all_ in zip(draws, passed, covered, strict=False):
        draw.passed, draw.covered = inside, all_
    if pixel:
        here = PickedPixel(pixel[0], trial.size[1] - 1 - pixel[1]).around()
        at = trial.counts(Change(around=(here,))) or nothing
        over = trial.counts(Change(around=(untested(), here))) or nothing
        for draw, inside, all_ in zip(draws, at, over, strict=False):
            draw.at_pixel = inside, all_


def _read_arrays(item: Item) -> None:
    """Point to a draw's own arrays, so that they can be read."""
    if item.call.arrays:
        for name, args in item.call.arrays:
            gl_function(name)(*args)


def _drain(errors: list[tuple[str, Call, str]], item: Item) -> None:
    if code := int(raw.glGetError()):
        errors.append((item.place, item.call, ERRORS.get(code, hex(code))))
        while raw.glGetError():
            pass


ERRORS = {
    0x0500: "invalid enumerant",
    0x0501: "invalid value",
    0x0502: "invalid operation",
    0x0503: "stack overflow",
    0x0504: "stack underflow",
    0x0505: "out of memory",
}


def _short(error: Exception) -> str:
    said = getattr(error, "description", None)
    return bytes(said).decode(errors="replace") if said else type(error).__name__


__all__ = ["Drawn", "PickedPixel", "Survey", "array_now", "survey", "untested"]
