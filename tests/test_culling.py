"""What is skipped to save time, back faces and far detail: no picture shows it."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from test_transparent_elements import looking

from landscape.elements.sprites.sprite_rules import radii
from landscape.frame import Pose
from landscape.geometry.camera import ball_in_view, in_view, is_near
from landscape.render import Offscreen

SIZE = (320, 240)
ALL_DRAWN = {"camera.cull": False, "camera.lod_pixels": 0.0, "water.query": False}
FEW = {
    "grass.count": 200_000, "trees.count": 700, "plants.count": 500, "reflection.lod_scale": 1.0
}  # fmt: skip


@pytest.fixture(scope="module")
def both() -> Iterator[tuple[Offscreen, Offscreen]]:
    """The island in best, with all that is skipped, and drawn in full."""
    with (
        Offscreen(SIZE, "best", FEW, samples=0) as some,
        Offscreen(SIZE, "best", {**FEW, **ALL_DRAWN}, samples=0) as everything,
    ):
        yield some, everything


@pytest.mark.slow
@pytest.mark.parametrize("view", ["fig35a", "fig35c", "fig35f", "fig35g", "fig35i"])
def test_the_picture_is_that_of_everything_drawn(both, view: str) -> None:
    pictures = []
    for offscreen in both:
        offscreen.look(view)
        offscreen.draw()  # the second frame knows what the first found out about the sea
        pictures.append(offscreen.draw().astype(int))
    off = np.abs(pictures[0] - pictures[1]).max(axis=2)
    assert (off > 4).mean() < 0.001
    assert off.mean() < 0.02


@pytest.mark.slow
def test_a_coarser_mirror_image_changes_the_water_alone_and_little(both) -> None:
    fine, _ = both
    with Offscreen(SIZE, "best", {**FEW, "reflection.lod_scale": 8.0}, samples=0) as coarse:
        for view, horizon in (("fig35a", 115), ("fig35i", 115)):
            pictures = []
            for offscreen in (fine, coarse):
                offscreen.look(view)
                offscreen.draw()
                pictures.append(offscreen.draw().astype(int))
            off = np.abs(pictures[0] - pictures[1]).max(axis=2)
            assert (off[:horizon] == 0).all()
            assert 0.0 < off.mean() < 0.3
            assert (off > 4).mean() < 0.03


@pytest.mark.slow
def test_what_was_chosen_for_several_frames_shows_as_if_chosen_anew(both) -> None:
    some, _ = both
    for view in ("fig35d", "fig35g"):
        some.look(view)
        some.draw()
        start, island = some.moment, some.scene
        sprites, grass = island.sprites._view, island.grass
        chosen = sprites._choice, grass._chosen
        for step in (1, 2, 3):
            pose = replace(
                start.pose,
                x=start.pose.x + 0.018 * step,
                yaw=start.pose.yaw + 1.2 * step,
                pitch=start.pose.pitch - 0.3 * step,
            )
            some.moment = replace(start, pose=pose)
            kept = some.draw()
            assert (sprites._choice, grass._chosen) == chosen
            frame = replace(looking(pose), size=SIZE)
            places = sprites._places[island.settings.transparent.rooted]
            far = radii(island.settings, sprites._cells, sprites._sizes[:, 1], frame)
            now = sprites._around(frame, island.settings, places, far, 0.0, 0.0)
            assert len(now) > 10 and np.isin(now, chosen[0].which).all()
        sprites._choice = grass._chosen = None
        assert np.array_equal(some.draw(), kept)
        # Farther on, all is chosen anew.
        some.moment = replace(start, pose=replace(start.pose, yaw=start.pose.yaw + 9.0))
        before = sprites._choice
        some.draw()
        assert sprites._choice is not before


def test_the_eye_is_near_until_it_has_moved_or_turned_too_far() -> None:
    then = looking(Pose(5.0, 1.0, 5.0, 30.0, -10.0))
    for change, near in (
        ({"x": 5.05}, True), ({"x": 5.05, "y": 1.05}, False), ({"yaw": 33.0}, True),
        ({"yaw": 35.0}, False), ({"pitch": -13.5}, True), ({"pitch": -15.0}, False),
        ({"yaw": 33.0, "pitch": -13.5}, False),
    ):  # fmt: skip
        assert is_near(then, looking(replace(then.pose, **change))) == near, change
    assert not is_near(then, replace(then, size=(120, 160)))
    assert is_near(then, then, 0.0, 0.0)
    assert not is_near(then, looking(replace(then.pose, x=5.001)), 0.0, 0.0)
    # Straight down the line of sight stays where it is; the window turns all the same.
    down = looking(Pose(5.0, 1.0, 5.0, 0.0, -90.0))
    assert not is_near(down, looking(replace(down.pose, yaw=10.0)))


def test_one_ball_is_in_view_as_many_are() -> None:
    frame = looking(Pose(20.0, 3.0, 20.0, 33.0, -12.0))
    rng = np.random.default_rng(3)
    places, sizes = rng.random((300, 3)) * (40, 6, 40), rng.random(300)
    one_by_one = [
        ball_in_view(frame, place, radius)
        for place, radius in zip(places.tolist(), sizes.tolist(), strict=True)
    ]
    assert one_by_one == in_view(frame, places, sizes).tolist()
    assert 0.05 < np.mean(one_by_one) < 0.6
