"""Clouds that move (R1): a disc that fades out, blended over the box, drifting with kt."""

from typing import Any

import numpy as np
import pytest
from stage import Stage, close, kind_in, live_names, small, write_plain

from landscape.elements.best.sky.clouds import ALPHA, DRIFT, RINGS, cloud_disc, cloud_opacity
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.island.island import SCENE
from landscape.island.slots import SKY

TOP = np.array((0, 200, 200))


def drawn(stage: Stage, assets: Assets, pose: Pose, kt: float = 0.0, **sky: Any) -> np.ndarray:
    settings = small({f"sky.{key}": value for key, value in sky.items()})
    before = live_names()
    box = kind_in(SKY, settings)(settings, assets)
    with stage.frame(settings, pose, kt) as frame:
        box.draw(frame)
        picture = stage.read()
    box.release()
    assert live_names() == before
    return picture


def test_the_cloud_disc_hangs_over_the_eye_and_fades_out_to_its_rim() -> None:
    vertices, colors, _coordinates, triangles = cloud_disc()
    assert np.allclose(vertices[:, 1], 1.0)
    radius = np.hypot(vertices[:, 0], vertices[:, 2])
    assert radius.max() == pytest.approx(RINGS[-1])
    assert np.allclose(colors[radius > RINGS[-1] - 1e-4, 3], 0.0)
    assert colors[radius < 1e-6, 3] == pytest.approx(ALPHA)
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    assert (np.cross(b - a, c - a)[:, 1] <= 1e-9).all(), "counter-clockwise from below"


def test_clouds_are_blended_over_the_top_and_drift_with_kt(stage: Stage, plain_folder) -> None:
    clouds = np.full((64, 64, 4), 255, np.uint8)
    clouds[..., :3] = 200
    folder = write_plain(plain_folder, {"clouds.png": clouds})
    up = Pose(20.0, 1.0, 20.0, 0.0, 89.0)
    got = drawn(stage, Assets(folder), up, moving=True)[60, 80]
    wanted = ALPHA * 200 + (1 - ALPHA) * TOP
    assert close(got, wanted, 3)
    clouds[:, :32, 3] = 0  # half clouds, half none
    assets = Assets(write_plain(plain_folder, {"clouds.png": clouds}))
    now, later = (drawn(stage, assets, up, kt=kt, moving=True) for kt in (0.0, 500.0))
    assert (now != later).any()
    # After 100,000 kt the texture has moved by whole widths, so all is as it was.
    assert np.allclose(np.array(DRIFT) * 100_000, (5, -2))
    whole = drawn(stage, assets, up, kt=100_000.0, moving=True)
    assert np.abs(whole - now).mean() < 2


def test_the_cloud_disc_fades_to_nothing_and_faces_down() -> None:
    vertices, colors, _, triangles = cloud_disc()
    rim = np.hypot(vertices[:, 0], vertices[:, 2]) > 5.9
    assert rim.any() and (colors[rim, 3] == 0).all() and (colors[~rim, 3] > 0).all()
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    area = np.cross(b - a, c - a)[:, 1]
    assert (area <= 1e-6).all() and (area < 0).any()


def test_clouds_move_with_kt_and_only_where_asked(stage: Stage) -> None:
    up = Pose(20.0, 1.0, 20.0, 40.0, 40.0)
    still = [drawn(stage, Assets(), up, kt) for kt in (0, 900)]
    assert (still[0] == still[1]).all()
    moved = [drawn(stage, Assets(), up, kt, moving=True) for kt in (0, 900)]
    assert (np.abs(moved[0] - moved[1]).max(axis=2) > 8).mean() > 0.05


def test_the_moving_clouds_are_streaks_along_one_wind() -> None:
    vertices, _, coordinates, _ = cloud_disc()
    texels = np.linalg.lstsq(vertices[:, ::2].astype(float), coordinates, rcond=None)[0]
    along, across = np.linalg.norm(texels, axis=0)
    assert across > 3.0 * along, "a texture is stretched along the wind"
    assert abs(texels[:, 0] @ texels[:, 1]) < 1e-6, "the two axes are at right angles"


def test_the_moving_clouds_are_thin_in_front_of_the_sun() -> None:
    for time in ("noon", "sunset"):
        sun = SCENE.values("best", {"time": time}).sun
        at, opposite = (cloud_opacity(way * direction(sun)[None], sun)[0] for way in (3.0, -3.0))
        assert at < 0.4 and opposite > 0.99


@pytest.mark.parametrize(("width", "tall"), [(400.0, 150.0), (1000.0, 400.0), (2400.0, 900.0)])
def test_a_cumulus_of_domes_is_wider_than_high_and_fills_its_base(
    width: float, tall: float
) -> None:
    pytest.importorskip("numba", reason="the extra `studio` is not installed")
    from landscape.studio.sky.domes import cloud_spheres

    for seed in range(5):
        spheres = cloud_spheres(np.random.default_rng(seed), 0.0, 0.0, width, tall)
        x, up, z, radius = spheres.T
        high = (up + radius).max()
        spread = max((a + radius).max() - (a - radius).min() for a in (x, z))
        assert spread > 1.3 * high
        at_base = np.abs(up) < radius
        reach = np.sqrt(radius[at_base] ** 2 - up[at_base] ** 2)
        widest = max((a[at_base] + reach).max() - (a[at_base] - reach).min() for a in (x, z))
        assert widest > 0.75 * spread, "no narrow foot under a wide head"
