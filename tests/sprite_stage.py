"""What the tests of sprites share: a camera, a plain atlas, sprites where a test wants them."""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from stage import SIZE, Stage, small, taken, write_plain

from landscape.elements.atlas import CELL, CELLS
from landscape.elements.best.sprites.refined_planting import TintedSprites
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.ground import Ground
from landscape.elements.planting import PLANT, Sprites
from landscape.elements.transparent_elements import TransparentElements
from landscape.files.assets import Assets
from landscape.frame import Frame, Pose

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
RED, BLUE, GLASS, PLANT_GREEN = (
    *((250, 0, 0, 255), (0, 0, 250, 255)),
    *((250, 0, 0, 128), (20, 230, 30, 255)),
)
TREE, CONIFER, GLASS_TREE = 0, 1, 2  # atlas cells in RED, BLUE and GLASS
COLOURS = {
    **{name: (9, 9, 9, 255) for name in CELLS},
    **{CELLS[TREE]: RED, CELLS[CONIFER]: BLUE, CELLS[GLASS_TREE]: GLASS, CELLS[PLANT]: PLANT_GREEN},
}
WIDE = {"transparent.radius": 50.0}
NORTH = Pose(20.0, 3.5, 20.0, 0.0, 0.0)
KINDS = {"trees", "deer", "plants"}

AnySprites = TransparentElements | RefinedSprites


def looking(pose: Pose, kt: float = 0.0, size: tuple[int, int] = SIZE) -> Frame:
    """Return a frame whose modelview is computed from the definition of the camera."""
    yaw = math.radians(pose.yaw)
    right, ahead = np.array([math.cos(yaw), 0.0, math.sin(yaw)]), np.array(pose.forward)
    matrix = np.eye(4)
    matrix[:3, :3] = right, np.cross(right, ahead), -ahead
    matrix[:3, 3] = -matrix[:3, :3] @ (pose.x, pose.y, pose.z)
    return Frame(pose, size, kt, matrix.T.ravel(), 60.0)


def pictures(folder: Path, changed: Mapping[str, Any] | None = None) -> Assets:
    """Fill a folder with plain assets and one-coloured sprites; some may be images of their own."""
    write_plain(folder)
    for name, value in {**COLOURS, **(changed or {})}.items():
        plain = isinstance(value, tuple)
        image = Image.new("RGBA", (CELL, CELL), value) if plain else Image.fromarray(value)
        image.save(folder / name)
    return Assets(folder)


@contextmanager
def element(
    stage: Stage, kind: type, assets: Assets, changes: Mapping[str, Any] | None = None
) -> Iterator[Any]:
    """Build sprites of one class on a small island, and release them."""
    stage.enter()
    settings = small({**WIDE, **(changes or {})})
    ground = Ground(settings, assets, np.array([0, 1, 0], np.float32))
    made = kind(settings, assets, ground, 1, KINDS)
    yield made
    stage.enter()
    made.release()
    ground.release()


def put(
    sprites: AnySprites,
    places: Any,
    cells: Any,
    size: tuple[float, float] = (1.0, 1.0),
    flipped: bool = False,
    slope: tuple[float, float] = (0.0, 0.0),
    tint: tuple[float, ...] = (255.0,) * 4,
) -> None:
    """Place these sprites and no others; slope and tint are for refined ones."""
    n = len(places)
    stand = Sprites(
        np.array(places, float),
        np.tile(np.array(size, float), (n, 1)),
        np.array(cells),
        np.full(n, flipped),
    )
    if isinstance(sprites, TransparentElements):
        sprites.stand(stand)
    else:
        more = np.tile(np.array(tint), (n, 1)), np.tile(np.array(slope), (n, 1))
        sprites.stand(TintedSprites(*vars(stand).values(), *more, stand.cells))


def seen(
    stage: Stage,
    sprites: AnySprites,
    pose: Pose = NORTH,
    kt: float = 0.0,
    size: tuple[int, int] = SIZE,
    **changes: Any,
) -> np.ndarray:
    """Return a picture of the sprites under some settings; the state must be left as found."""
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    settings = small({**WIDE, **keys})
    assert taken(sprites, settings)
    with stage.frame(settings, pose, kt, size=size) as frame:
        sprites.draw(frame)
        return stage.read()


def covered(picture: np.ndarray) -> np.ndarray:
    """Return which pixels show something, (h, w)."""
    return np.asarray(np.abs(picture - BACKGROUND).max(axis=2) > 12)
