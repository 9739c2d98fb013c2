"""Refined sprites: a selection reused for several frames, and settings applied in place."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from sprite_stage import BACKGROUND, CONIFER, NORTH, WIDE, element, looking, pictures, put, seen
from stage import Stage, close, small, taken

from landscape.elements.best.sprites import sprites_in_view
from landscape.elements.best.sprites.choice import LaidOut, choose
from landscape.elements.best.sprites.refined_planting import TintedSprites
from landscape.elements.best.sprites.refined_sprites import RefinedSprites
from landscape.elements.settings import Settings
from landscape.frame import FULL, Detail, Pose
from landscape.settings.declare import with_settings


@pytest.fixture(scope="module")
def sprites(the_stage: Stage, tmp_path_factory) -> Iterator[RefinedSprites]:
    """The element, its cells of one colour each."""
    assets = pictures(tmp_path_factory.mktemp("choice"))
    with element(the_stage, RefinedSprites, assets) as made:
        yield made


SCATTERED = {
    "transparent__fade": 0.2,
    "transparent__trimmed": True,
    "trees__crown": True,
    "plants__crossed_within": 3.0,
    "plants__rosette": True,
    "transparent__radius": 9.0,
}


def scattered(sprites: RefinedSprites, count: int = 300) -> None:
    """Place sprites of all kinds around the eye of NORTH."""
    rng = np.random.default_rng(8)
    places = np.stack([rng.uniform(8, 32, count), rng.uniform(1, 4, count)], axis=1)
    places = np.insert(places, 2, rng.uniform(8, 32, count), axis=1)
    put(sprites, places, rng.integers(0, 7, count), (0.5, 0.5))


@pytest.mark.seldom(10, first=6)
def test_a_selection_reused_for_several_frames_shows_what_a_new_one_would(
    stage: Stage, sprites: RefinedSprites, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = []
    monkeypatch.setattr(sprites_in_view, "choose", lambda *a: made.append(a) or choose(*a))
    poses = [
        replace(NORTH, x=20.0 + 0.018 * k, yaw=1.2 * k, pitch=-0.3 * k) for k in range(4)
    ]  # 0.054 units and 3.6 degrees in all
    settings = small({**WIDE, **{key.replace("__", "."): v for key, v in SCATTERED.items()}})

    def shown(fresh: bool) -> list[np.ndarray]:
        out = []
        for pose in poses:
            if fresh or not out:
                scattered(sprites)
            with stage.frame(settings, pose) as frame:
                sprites.draw(frame)
                out.append(stage.read())
        return out

    assert taken(sprites, settings)
    kept, anew = shown(fresh=False), shown(fresh=True)
    assert len(made) == 1 + len(poses)
    assert all((one == other).all() for one, other in zip(kept, anew, strict=True))
    assert (kept[0] != kept[-1]).any()
    # Farther on, or turned farther, all is chosen again; without fade at every step.
    shown(fresh=False)
    for change in ({"x": 20.2}, {"yaw": 9.0}):
        before = len(made)
        with stage.frame(settings, replace(NORTH, **change)) as frame:
            sprites.draw(frame)
        assert len(made) == before + 1
    settings = with_settings(settings, {"transparent.fade": 0.0})
    assert taken(sprites, settings)
    before = len(made)
    shown(fresh=False)
    assert len(made) == before + len(poses)


@pytest.mark.seldom(10, first=4)
def test_in_coarser_frames_a_selection_serves_farther_and_shows_what_a_new_one_would(
    stage: Stage, sprites: RefinedSprites, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = []
    monkeypatch.setattr(sprites_in_view, "choose", lambda *a: made.append(a) or choose(*a))
    settings = small({**WIDE, **{key.replace("__", "."): v for key, v in SCATTERED.items()}})
    assert taken(sprites, settings)

    def shown(detail: Detail, fresh: bool) -> list[np.ndarray]:
        out = []
        for k in range(3):
            if fresh or not out:
                scattered(sprites)
            with stage.frame(settings, replace(NORTH, x=20.0 + 0.08 * k, yaw=2.5 * k)) as frame:
                sprites.draw(replace(frame, detail=detail))
                out.append(stage.read())
        return out

    coarser = Detail(scale=0.5, coarser=2.0)
    kept = shown(coarser, fresh=False)
    assert len(made) == 1
    anew = shown(coarser, fresh=True)
    assert len(made) == 4
    assert all((one == other).all() for one, other in zip(kept, anew, strict=True))
    assert (kept[0] != kept[-1]).any()
    shown(FULL, fresh=False)
    assert len(made) == 7


def test_coarser_frames_show_the_quads_of_the_one_before_where_the_eye_hardly_moves(
    sprites: RefinedSprites,
) -> None:
    keys = {key.replace("__", "."): value for key, value in SCATTERED.items()}
    assert taken(sprites, small({**WIDE, **keys}))
    scattered(sprites)
    coarser = Detail(scale=0.5, coarser=2.0)

    def quads(kt: float = 0.0, detail: Detail = coarser, **pose: float) -> tuple[np.ndarray, ...]:
        return sprites.prepare(replace(looking(replace(NORTH, **pose), kt), detail=detail))

    first = quads()
    assert quads(kt=1.0, x=20.03) is first
    assert quads(kt=2.0, yaw=1.0) is first
    for change in ({"x": 20.05}, {"yaw": 2.0}, {"kt": 3.0}, {"detail": FULL}):
        first = quads()
        assert quads(**change) is not first, change
        assert quads() is not first, "a later choice has taken its place"
    # Frames with all detail depend on their own moment alone.
    assert quads(detail=FULL) is not quads(detail=FULL)


def test_a_selection_with_a_margin_contains_that_of_every_pose_within_the_margin() -> None:
    rng = np.random.default_rng(4)
    places = np.insert(rng.uniform(5, 35, (3000, 2)), 1, rng.uniform(0.7, 4, 3000), axis=1)
    sizes, cells = rng.uniform(0.1, 0.6, (3000, 2)), rng.integers(0, 7, 3000)
    flipped, tints = rng.random(3000) < 0.5, np.full((3000, 4), 255.0)
    every = TintedSprites(places, sizes, cells, flipped, tints, np.zeros((3000, 2)), cells)
    boxes = np.zeros((2, 7, 8, 2), np.float32)
    laid_out = LaidOut(every, boxes, boxes, 2)
    keys = {"transparent.fade": 0.2, "transparent.trimmed": True, "transparent.radius": 9.0}
    settings = with_settings(Settings(), {**keys, "plants.crossed_within": 4.0})
    start = Pose(20.0, 3.0, 20.0, 33.0, -8.0)
    wide = choose(laid_out, looking(start), settings, 0.06, math.radians(4.0))

    for k in range(20):
        aside = rng.uniform(-0.03, 0.03, 3)
        turn = rng.uniform(-1.9, 1.9, 2)
        pose = Pose(
            20.0 + aside[0], 3.0 + aside[1], 20.0 + aside[2], 33.0 + turn[0], -8.0 + turn[1]
        )
        plain = choose(laid_out, looking(pose), settings)
        assert 10 < len(plain.which) < len(wide.which), k
        assert np.isin(plain.which, wide.which).all()
        crossed = plain.which[plain.crossed.which]
        assert np.isin(crossed, wide.which[wide.crossed.which]).all()


def test_settings_read_each_frame_can_be_applied_and_built_in_ones_cannot(
    stage: Stage, sprites: RefinedSprites
) -> None:
    put(sprites, [(20.0, 3.0, 17.0)], [CONIFER])
    there = seen(stage, sprites)
    for change in (
        {"trees.count": 61},
        {"trees.grouped": True},
        {"plants.species": 5},
        {"rabbit.x": 3.0},
        {"ground.resolution": 41},
        {"transparent.trilinear": False},
        {"plants.shaded": True, "ground.shadows": True},
        {"ground.large_texture": "map.png"},
    ):
        assert not taken(sprites, small({**WIDE, "transparent.radius": 1.0, **change})), change
        with stage.frame(small(WIDE), NORTH) as frame:
            sprites.draw(frame)
            assert (stage.read() == there).all(), "refused settings change nothing"

    assert close(seen(stage, sprites, transparent__radius=1.0), BACKGROUND)
