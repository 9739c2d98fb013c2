"""A frame growing: what the buffers hold after each group of its calls.

The frame is drawn again in its context, group by group. A group ends with a draw, and has the calls
that lead to its draws. What is drawn into another framebuffer, such as a mirror image, is a group
of its own, with that framebuffer's contents.

Technique: first the frame is drawn once to learn what the pictures have in common, namely the
projection, how far the drawn pixels are, and the layers (see overdraw.py); then it is drawn once
more to read its buffers. So no picture is kept longer than its user wants.
"""

import zlib
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from framelens.gl.seam import gl
from framelens.tape.overdraw import LayerCounter
from framelens.tape.primitives import Draw, grouped
from framelens.tape.readback import Lens, lens_now, read_color, read_depth, read_stencil
from framelens.tape.steps import Step, issue
from framelens.tape.tape import Tape

GROUPINGS = ("pass", "element", "draw")
BUFFERS = ("color", "depth", "stencil", "overdraw")
OWN = "GL_DRAW_FRAMEBUFFER_BINDING"


@dataclass
class Group:
    """Calls of a frame that make one picture: ``items``, in order, with their draws.

    ``target`` is the framebuffer that they draw into; ``aside`` says that it is not the frame's
    own. ``elements`` are those that draw.
    """

    target: int
    aside: bool
    pass_: str
    items: list[Step | Draw] = field(default_factory=list)
    elements: list[str] = field(default_factory=list)

    @property
    def steps(self) -> Iterator[Step]:
        """All calls, those between a glBegin and its glEnd too, without those the replay adds."""
        for item in self.items:
            for step in item.steps if isinstance(item, Draw) else (item,):
                if step.place:
                    yield step

    @property
    def draws(self) -> list[Draw]:
        """The calls that draw, clears included."""
        return [item for item in self.items if isinstance(item, Draw)]

    @property
    def clears(self) -> bool:
        """Whether all it draws is glClear."""
        return all(draw.first.call.name == "glClear" for draw in self.draws)


def groups(tape: Tape, by: str) -> list[Group]:
    """Divide the calls of a frame into groups by "pass", "element" or "draw"; no OpenGL is called.

    Calls before a draw belong to it, but for those with which the element before it ends. A frame
    that draws nothing gives no group.
    """
    own = target = int(tape.start.get(OWN, 0))
    found: list[Group] = []
    key: Hashable = None
    pending: list[Step] = []
    visits = 0
    for item in grouped(tape.steps()):
        if isinstance(item, Step):
            pending.append(item)
            into = bound(item, target)
            visits += into != target
            target = into
            continue
        first, aside = item.first, target != own
        mine: Hashable = visits if aside else _key(first, by)
        if by == "draw" or not found or key != (aside, mine):
            if found and by != "draw":
                pending = _finish(found[-1], pending)
            found.append(Group(target, aside, first.top.pass_))
        key = aside, mine
        group = found[-1]
        group.items += [*pending, item]
        pending = []
        if first.call.name != "glClear":
            group.elements += [name for name in first.elements if name not in group.elements]

    if found:
        found[-1].items += pending
    return found


def bound(step: Step, target: int) -> int:
    """Return the framebuffer that is drawn into after a call; ``target`` is the one before it."""
    call = step.call
    if call.skipped or not call.name.startswith("glBindFramebuffer"):
        return target
    return target if int(call.args[0]) == int(gl.GL_READ_FRAMEBUFFER) else int(call.args[1])


def _key(step: Step, by: str) -> Hashable:
    return step.top.pass_ if by == "pass" else (step.top.pass_, step.elements)


def _finish(group: Group, pending: Sequence[Step]) -> list[Step]:
    """Give a group the calls with which its last element ends; return the others."""
    last = group.draws[-1].first.top
    count = 0
    for step in pending:
        if step.place and (step.top.pass_, step.top.shared_by) != (last.pass_, last.shared_by):
            break
        count += 1
    group.items += pending[:count]
    return list(pending[count:])


@dataclass(frozen=True)
class SharedValues:
    """Values shared by all pictures of a strip.

    ``lens`` tells distances from depths, and ``depths`` are the least and the greatest depth drawn
    in any picture, 0 to 1; None where nothing was drawn, or depth was not asked for. ``layers`` has
    for each group the fragments that passed all tests so far, compressed; None where they were not
    counted.
    """

    lens: Lens
    depths: tuple[float, float] | None = None
    layers: Sequence[bytes | None] = ()


@dataclass(frozen=True)
class Shot:
    """The buffers after a group; None for one that its framebuffer does not have.

    "color" is uint8 (h, w, 3), "depth" float32 (h, w) from 0 to 1, "stencil" uint8 (h, w),
    "overdraw" uint16 (h, w): layers in the frame's own framebuffer. The top row is the first.
    """

    group: Group
    buffers: dict[str, np.ndarray | None]


def _ends(depth: np.ndarray | None) -> list[float]:
    """Return the least and the greatest depth of what is drawn; nothing if nothing is."""
    drawn = depth[depth < 1.0] if depth is not None else np.empty(0)
    return [float(drawn.min()), float(drawn.max())] if drawn.size else []


def shared_values(tape: Tape, parts: Sequence[Group], buffers: Sequence[str]) -> SharedValues:
    """Draw the frame once, in its context, to learn what ``buffers`` need."""
    if not {"depth", "overdraw"} & set(buffers):
        return SharedValues(Lens())
    tape.rewind()
    player = _Player()
    counter = LayerCounter(tape.size) if "overdraw" in buffers else None
    lens = Lens()
    depths: list[float] = []
    layers: list[bytes | None] = []
    try:
        for group in parts:
            counted = counter if not group.aside else None
            for item in group.items:
                if isinstance(item, Step):
                    issue(item.call)
                    continue
                if not group.aside and not lens.perspective:
                    lens = lens_now(lens)
                draw = partial(player.draw, item)
                if counted is None:
                    draw()
                else:
                    counted.count(item.first.call, draw)
            layers.append(None if counted is None else _packed(counted.read()))
            if "depth" in buffers and not group.aside:
                depths += _ends(read_depth(group.target, (0, 0, *tape.size)))
    finally:
        player.release()
        tape.rewind()

    return SharedValues(lens, (min(depths), max(depths)) if depths else None, layers)


def _packed(layers: np.ndarray) -> bytes:
    return zlib.compress(layers.tobytes(), 1)


def shots(
    tape: Tape, parts: Sequence[Group], buffers: Sequence[str], found: SharedValues
) -> Iterator[Shot]:
    """Draw the frame in its context, and yield the buffers after each group.

    Between two of them the context is in the middle of the frame.
    """
    tape.rewind()
    player = _Player()
    try:
        for index, group in enumerate(parts):
            for item in group.items:
                if isinstance(item, Draw):
                    player.draw(item)
                else:
                    issue(item.call)
            yield Shot(group, _read(tape, group, buffers, found, index))
    finally:
        player.release()
        tape.rewind()


class _Player:
    """Draws as the frame did; owns a display list."""

    def __init__(self) -> None:
        self._list = int(gl.glGenLists(1))

    def draw(self, draw: Draw) -> None:
        """Make the calls of a draw."""
        if "." not in draw.first.place:
            draw.issue()
            return
        # From a display list OpenGL may draw with other roundings: it splits quads along the other
        # diagonal, and has bytes as floats. So what came from a list is drawn from one.
        gl.glNewList(self._list, gl.GL_COMPILE)
        draw.issue()
        gl.glEndList()
        gl.glCallList(self._list)

    def release(self) -> None:
        """Delete the list."""
        gl.glDeleteLists(self._list, 1)


def _read(
    tape: Tape, group: Group, buffers: Sequence[str], found: SharedValues, index: int
) -> dict[str, np.ndarray | None]:
    box = (0, 0, *tape.size)
    if group.aside:
        left, low, width, height = (int(side) for side in gl.glGetIntegerv(gl.GL_VIEWPORT))
        box = (left, low, width, height)
    readers = {"color": read_color, "depth": read_depth, "stencil": read_stencil}
    result = {
        name: reader(group.target, box) for name, reader in readers.items() if name in buffers
    }
    if "overdraw" in buffers:
        packed = found.layers[index]
        if packed is None:
            result["overdraw"] = None
        else:
            layers = np.frombuffer(zlib.decompress(packed), np.uint16)
            result["overdraw"] = layers.reshape(tape.size[::-1])
    return result
