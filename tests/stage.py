"""Shared support for the GL tests: a small render target, frames with a state check, plain assets.

A test draws inside ``with stage.frame(settings, pose) as frame``. The frame begins like the frames
of a scene. When the block ends, all state that could affect a later element must be as it was at
the beginning, or the test fails.
"""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from gl_state import changes, snapshot
from PIL import Image

from framelens.gl.context import Context
from framelens.gl.framebuffer import Framebuffer
from framelens.gl.seam import gl
from landscape.elements.element import Element, Slot
from landscape.elements.settings import Settings
from landscape.frame import Frame, Pose
from landscape.island.slots import SLOTS
from landscape.scene.scene import Moment, begin_frame
from landscape.settings.declare import with_settings

SIZE = (160, 120)

SMALL: dict[str, Any] = {
    "grass.count": 3000,
    "trees.count": 60,
    "plants.count": 60,
    "deer.count": 10,
    "ground.resolution": 40,
    "ground.texture_size": 256,
}
"""An island with few objects, for speed."""

SMALL_BEST: dict[str, Any] = {**SMALL, "ground.stones": 500}
"""The same for the preset best, where stones take time, too.

Tests that take these values and no others share what the cache keeps of the island.
"""

WHITE_LIGHT: dict[str, Any] = {"sun.ambient": (1.0, 1.0, 1.0), "sun.diffuse": (0.0, 0.0, 0.0)}
"""Lighting under which lit surfaces show their own colour whatever their normals."""


class Stage:
    """The context and the small render target that all GL tests share."""

    size = SIZE

    def __init__(self, context: Context) -> None:
        self.context = context
        self.target = Framebuffer(SIZE, 0)

    def enter(self) -> None:
        """Make the context current; another test may have opened and closed its own."""
        self.context.make_current()
        self.target.bind()

    @contextmanager
    def frame(
        self,
        settings: Settings,
        pose: Pose,
        kt: float = 0.0,
        fog: bool = False,
        step: float = 0.0,
        stroke: int = 0,
        size: tuple[int, int] = SIZE,
    ) -> Iterator[Frame]:
        """Begin a frame as a scene does; assert that the block leaves the state unchanged."""
        with self.borrowed():
            moment = Moment(pose, size, kt, step, stroke)
            far = 1.5 * settings.water.horizon
            frame = begin_frame(moment, settings.camera, settings.sun, settings.fog, fog, far)
            before = snapshot()
            yield frame
            changed = changes(before, snapshot())
        assert not changed, f"state changed: {changed}"

    @contextmanager
    def borrowed(self) -> Iterator[None]:
        """Restore all state after the block, so that tests do not affect each other."""
        # glPopAttrib in Mesa does not restore a colour that nothing was drawn with.
        color = gl.glGetFloatv(gl.GL_CURRENT_COLOR)
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
            gl.glMatrixMode(mode)
            gl.glPushMatrix()
        try:
            yield
        finally:
            for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
                gl.glMatrixMode(mode)
                gl.glPopMatrix()
            gl.glPopAttrib()
            gl.glColor4f(*color.tolist())

    def read(self) -> np.ndarray:
        """Return the rendered image, int64 (h, w, 3), top row first."""
        return self.target.read().astype(np.int64)

    def release(self) -> None:
        """Release target and context."""
        self.enter()
        self.target.release()
        self.context.release()


def live_names() -> tuple[set[int], set[int]]:
    """Return the names of all existing textures and display lists."""
    # Mesa assigns names in ascending order, so all that exist lie below the ones it gives now.
    next_texture, next_list = int(gl.glGenTextures(1)), int(gl.glGenLists(1))
    gl.glDeleteTextures(np.array([next_texture], np.uint32))
    gl.glDeleteLists(next_list, 1)
    textures = {name for name in range(1, next_texture) if gl.glIsTexture(name)}
    return textures, {name for name in range(1, next_list) if gl.glIsList(name)}


def project(
    pose: Pose, point: tuple[float, ...], fov: float = 60.0, size: tuple[int, int] = SIZE
) -> tuple[float, float]:
    """Return the column and row, from the top left, at which a camera at ``pose`` sees ``point``.

    Computed from the definition of perspective, not from the program's matrices.
    """
    yaw, pitch = math.radians(pose.yaw), math.radians(pose.pitch)
    right = np.array([math.cos(yaw), 0.0, math.sin(yaw)])
    ahead = np.array(pose.forward)
    up = np.array(
        [-math.sin(pitch) * math.sin(yaw), math.cos(pitch), math.sin(pitch) * math.cos(yaw)]
    )
    away = np.array(point) - (pose.x, pose.y, pose.z)
    scale = size[1] / 2 / math.tan(math.radians(fov / 2)) / float(away @ ahead)
    return size[0] / 2 + float(away @ right) * scale, size[1] / 2 - float(away @ up) * scale


def pixel(picture: np.ndarray, at: tuple[float, float]) -> np.ndarray:
    """Return the pixel (3,) that contains the point ``at`` = (column, row)."""
    return np.asarray(picture[int(at[1]), int(at[0])])


def close(got: np.ndarray, wanted: Any, levels: float = 1.0) -> bool:
    """Return whether colours are equal within ``levels`` (of 255)."""
    return bool((np.abs(np.asarray(got, float) - np.asarray(wanted, float)) <= levels).all())


def small(changed: Mapping[str, Any] | None = None) -> Settings:
    """Return the settings of 2006 with few objects and the given changes."""
    return with_settings(Settings(), {**SMALL, **(changed or {})})


def taken(element: Element[Any], settings: Any) -> bool:
    """Pass settings to an element as its scene does; return False if it would be built again."""
    kind = type(element)
    slot = next((slot for slot in SLOTS if kind in slot.kinds), None)
    finer = slot.kinds[: slot.kinds.index(kind)] if slot else ()
    if any(each.serves(settings) for each in finer):
        return False
    if kind.built_from(element.settings) != kind.built_from(settings):
        return False
    element.take(settings)
    return True


def kind_in(slot: Slot, settings: Any) -> Any:
    """Return the class that draws what the settings ask for."""
    return slot.kind(settings)


def quad(corners: np.ndarray) -> None:
    """Draw a quad (4, 3) in the current colour with texture coordinates (0, 0) to (1, 1)."""
    gl.glBegin(gl.GL_QUADS)
    for (s, t), corner in zip(((0, 0), (1, 0), (1, 1), (0, 1)), corners.tolist(), strict=True):
        gl.glTexCoord2f(float(s), float(t))
        gl.glVertex3f(*corner)
    gl.glEnd()


Colour = tuple[int, ...]

PLAIN: dict[str, Colour] = {
    "ground_large.png": (100, 150, 200),
    "ground_detail.png": (96, 96, 96),
    "water.png": (128, 64, 255),
    "sky_west.png": (200, 0, 0),
    "sky_north.png": (0, 200, 0),
    "sky_east.png": (0, 0, 200),
    "sky_south.png": (200, 200, 0),
    "sky_top.png": (0, 200, 200),
    "castle_brick.png": (200, 160, 120),
    "castle_door.png": (90, 60, 30, 255),
    "castle_light.png": (128, 192, 64),
    "torch_stone.png": (50, 50, 50),
    "animal.png": (255, 128, 64),
    "blade.png": (40, 220, 60),
    "map.png": (0, 255, 0, 255),
    "height.png": (128, 128, 128),
    **{f"sword_{k}.png": (60 * k, 255 - 60 * k, 10, 255) for k in range(1, 5)},
    "sword_rest.png": (255, 0, 255, 128),
}


def write_plain(folder: Path, changed: Mapping[str, Colour | np.ndarray] | None = None) -> Path:
    """Fill ``folder`` with one-colour images, so that expected pixels can be computed by hand."""
    for name, value in {**PLAIN, **(changed or {})}.items():
        image = value if isinstance(value, np.ndarray) else np.full((4, 4, len(value)), value)
        Image.fromarray(image.astype(np.uint8)).save(folder / name)
    return folder


ASCII_PLY = """ply
format ascii 1.0
element vertex {n}
property float x
property float y
property float z
element face {m}
property list uchar int vertex_indices
end_header
"""


def write_ply(path: Path, vertices: np.ndarray, faces: np.ndarray) -> Path:
    """Write vertices (n, 3) and faces (m, k) as an ASCII PLY file."""
    lines = [" ".join(f"{v:.7g}" for v in vertex) for vertex in vertices]
    lines += [" ".join(map(str, [len(face), *face])) for face in faces.tolist()]
    head = ASCII_PLY.format(n=len(vertices), m=len(faces))
    path.write_text(head + "\n".join(lines) + "\n", encoding="ascii")
    return path
