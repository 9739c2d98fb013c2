"""Pictures that are drawn in parts, over several frames, while the last whole one is shown.

Technique: the next picture grows in a texture, some of its parts in each frame, as it will be seen
in the middle of the frames that are to show it. Every frame shows the last whole picture, moved to
where its things are seen now (reprojection.py), and in front of it, sharp, what the walker holds.
So a picture may take several times as long to draw as a frame is shown. What moves by itself moves
at the pictures' rate.

State used: framebuffer objects, viewport, both matrices, GL_TEXTURE_2D; depth test, fog and
lighting off.
"""

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from framelens.gl.seam import drawing, gl
from landscape.frame import FULL, Frame, scaled
from landscape.geometry.flown import Flown
from landscape.gl.texture_target import TextureTarget
from landscape.scene.scene import Moment, Parted
from landscape.walk.covering import cover, cover_by_grid, sized
from landscape.walk.reprojection import (
    COLUMNS,
    ROWS,
    Seen,
    ahead,
    apart,
    distances,
    reprojected,
)

TRIED = 8  # chosen: of so many pictures one is compared with the one before
SAMPLES = 160, 90  # chosen: pixels that are compared
APART = 16  # levels of 255; pixels that differ by more are wrong
LATELY = 0.3  # chosen: weight of the last time that a part took, in what it is expected to take


@dataclass(frozen=True)
class Picture:
    """A whole picture: the ``part`` pixels of a texture, its frame, and from where it was seen."""

    target: TextureTarget
    part: tuple[float, float]
    frame: Frame
    seen: Seen


class Growing:
    """A picture that is being drawn."""

    def __init__(self, moment: Moment, opened: Parted, target: TextureTarget) -> None:
        """Begin with nothing drawn."""
        self.moment = moment
        self.target = target
        self.drawn = 0  # parts
        self.shown = 0  # frames since it was begun
        self.frame: Frame | None = None
        self.parts: Iterator[Frame] = opened.parts(moment)

    def next_part(self) -> bool:
        """Draw another part; return False if there is none."""
        frame = next(self.parts, None)
        if frame is None:
            return False
        self.frame = frame
        self.drawn += 1
        return True

    def close(self) -> None:
        """Give up what is left, and put back the state that the parts hold."""
        close = getattr(self.parts, "close", None)
        if close is not None:
            close()


def seen_by(opened: object, moment: Moment) -> Moment:
    """Return a moment with the pose of the camera, where that flies by itself."""
    if not isinstance(opened, Flown):
        return moment
    return replace(moment, pose=opened.eye(moment.pose, moment.kt))


class Spread:
    """Owner of two pictures, the one that is shown and the one that grows."""

    def __init__(self) -> None:
        """Create nothing yet."""
        self._targets: list[TextureTarget | None] = [None, None]
        self._depths: TextureTarget | None = None
        self._growing: Growing | None = None
        self._picture: Picture | None = None
        self._last: Moment | None = None  # what the last frame showed
        self._began: Moment | None = None  # what the frame showed in which the picture was begun
        self._frames = 0  # since then
        self._of: tuple[object, ...] = ()  # of what the pictures are
        self._costs: list[float] = []  # seconds that each part is expected to take
        self._small: list[TextureTarget | None] = [None, None]  # for comparing pictures
        self._whole = 0  # pictures that were drawn
        self.wrong: float | None = None  # of the pixels of a picture, when it was shown last

    def draw(self, moment: Moment, opened: Parted) -> None:
        """Show a moment by the last picture, and draw a share of the next one."""
        moment = seen_by(opened, moment)
        of = id(opened), id(opened.settings), frozenset(opened.shown), moment.size, moment.wireframe
        last = self._last
        if of != self._of or last is None or apart(last.pose, moment.pose):
            self.forget()
            self._of = of
        frames = moment.detail.spread
        if self._growing is None:
            # It is shown as long as it takes to draw the next one.
            then = self._began
            if self._picture is None or then is None or not self._frames:
                self._begin(moment, opened)
            else:
                # By the mean of several frames: the last one may have been short or late.
                self._begin(ahead(then, moment, 1.5 * (frames - 1) / self._frames), opened)
            self._began, self._frames = moment, 0
        self._frames += 1
        self._grow()
        self._last = moment
        gl.glViewport(0, 0, *moment.size)
        if frames > 1:
            self.cover(moment)
        else:
            assert self._picture is not None
            with drawing("stretch"):
                cover(self._picture.target, self._picture.part)
        self._draw_overlay(moment, opened)

    def _begin(self, moment: Moment, opened: Parted) -> None:
        """Begin the picture of a moment, in the texture that is not shown."""
        shown = None if self._picture is None else self._picture.target
        slot = 1 if self._targets[0] is not None and self._targets[0] is shown else 0
        size = tuple(scaled(side, moment.detail.scale) for side in moment.size)
        target = self._targets[slot] = sized(self._targets[slot], (size[0], size[1]))
        self._growing = Growing(moment, opened, target)

    def _grow(self) -> None:
        """Draw this frame's share of the picture's parts; all that are left in its last frame."""
        growing = self._growing
        assert growing is not None
        growing.shown += 1
        last = self._picture is None or growing.shown >= growing.moment.detail.spread
        share = growing.shown / growing.moment.detail.spread
        with growing.target.drawing(clear=False):
            while last or self._expected(growing.drawn) < share:
                begin = time.perf_counter()
                if not growing.next_part():
                    break
                if growing.moment.detail.spread == 1:
                    continue
                gl.glFinish()
                self._note(growing.drawn - 1, time.perf_counter() - begin)
        if last:
            former = self._picture
            self._picture = self._finished(growing)
            self._growing = None
            self._whole += 1
            if former is not None and self._whole % TRIED == 0:
                self.wrong = self._compared(former, self._picture)

    def _expected(self, drawn: int) -> float:
        """Return how much of a picture, 0..1, is drawn in the middle of a part of that number."""
        if not self._costs:
            return 0.0
        before = sum(self._costs[:drawn]) + sum(self._costs[drawn : drawn + 1]) / 2.0
        return before / sum(self._costs)

    def _note(self, number: int, seconds: float) -> None:
        """Take note of how long a part took."""
        if number == len(self._costs):
            self._costs.append(seconds)
        else:
            self._costs[number] += LATELY * (seconds - self._costs[number])

    def _finished(self, growing: Growing) -> Picture:
        """Return the picture, all parts of which are drawn."""
        frame, moment = growing.frame, growing.moment
        assert frame is not None
        projection = np.asarray(gl.glGetFloatv(gl.GL_PROJECTION_MATRIX), np.float64).ravel()
        self._depths = sized(self._depths, (COLUMNS, ROWS))
        growing.target.copy_depths(self._depths)
        with self._depths.drawing(clear=False):
            read = gl.glReadPixels(0, 0, COLUMNS, ROWS, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
        depths = np.asarray(read, np.float32).reshape(ROWS, COLUMNS)
        width, height = moment.size
        part = width * moment.detail.scale, height * moment.detail.scale
        seen = Seen(frame.pose, frame.fov, moment.size, distances(depths, projection))
        return Picture(growing.target, part, frame, seen)

    def _compared(self, former: Picture, picture: Picture) -> float:
        """Return how much of a picture, 0..1, is not as the former one would have shown it."""
        pixels = []
        for slot, shown in enumerate((former, picture)):
            target = self._small[slot] = sized(self._small[slot], SAMPLES)
            vertices = reprojected(shown.seen, picture.seen.pose)
            with drawing("stretch"), target.drawing(clear=False):
                cover_by_grid(shown.target, shown.part, vertices)
                read = gl.glReadPixels(0, 0, *SAMPLES, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
            pixels.append(np.frombuffer(read, np.uint8).reshape(-1, 3).astype(int))
        return float((np.abs(pixels[0] - pixels[1]).max(axis=1) > APART).mean())

    def _draw_overlay(self, moment: Moment, opened: Parted) -> None:
        """Draw what is in front of the picture, as sharp as the window."""
        assert self._picture is not None
        frame = replace(
            self._picture.frame,
            pose=moment.pose,
            size=moment.size,
            kt=moment.kt,
            step=moment.step,
            stroke=moment.stroke,
            detail=FULL,
        )
        opened.draw_overlay(frame)

    @property
    def has_picture(self) -> bool:
        """Whether there is a whole picture."""
        return self._picture is not None

    def cover(self, moment: Moment) -> None:
        """Cover the viewport with the picture as it is seen at a moment."""
        picture = self._picture
        assert picture is not None
        vertices = reprojected(picture.seen, moment.pose)
        with drawing("stretch"):
            cover_by_grid(picture.target, picture.part, vertices)

    def forget(self) -> None:
        """Give up the pictures: the next frame begins with a whole one."""
        if self._growing is not None:
            self._growing.close()
        self._growing = self._picture = self._last = self._began = None

    def release(self) -> None:
        """Delete the textures; may be called twice."""
        self.forget()
        for target in (*self._targets, *self._small, self._depths):
            if target is not None:
                target.release()
        self._targets, self._small, self._depths = [None, None], [None, None], None
