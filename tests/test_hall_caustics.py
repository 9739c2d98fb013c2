"""The pool and its caustics: generated coordinates, both ways to multiply, each safeguard."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from stage import SIZE, Stage
from state_calls import Fresh

from framelens.gl import extensions
from framelens.gl.seam import gl
from framelens.gl.texture import Texture
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.hall import plan
from landscape.hall.caustics import generate, planes
from landscape.hall.hall import SCENE, Hall
from landscape.hall.pool import INDEX, left_of_light, mirrored_share, steepness
from landscape.hall.reflected_light import lit_meshes, thrown
from landscape.scene.scene import Moment, begin_frame
from landscape.settings.declare import with_settings

OVER_POOL = Pose(1.62, 0.3, 2.5, 356.0, -40.0)
WEST = Pose(1.62, 0.15, 2.1, 270.0, 8.0)
KT = 20.0
BED: dict[str, Any] = {"caustics.reflected": 0.0}
SUN = direction(SCENE.settings.sun)


@pytest.fixture(scope="module")
def halls(the_stage: Stage) -> Iterator[dict[Any, Hall]]:
    """The halls opened so far, by what they were built with."""
    kept: dict[Any, Hall] = {}
    yield kept
    the_stage.enter()
    for hall in kept.values():
        hall.release()


def drawn(
    stage: Stage,
    halls: dict[Any, Hall],
    changed: dict[str, Any] | None = None,
    pose: Pose = OVER_POOL,
    kt: float = KT,
    shown: tuple[str, ...] = ("room", "caustics"),
) -> np.ndarray:
    """Return the picture, int64 (h, w, 3)."""
    settings = with_settings(SCENE.settings, changed or {})
    if not halls:
        halls["hall"] = Hall(settings, Assets(), 0, ("room", "caustics", "pool"))
    hall = halls["hall"]
    assert hall.apply(settings)
    hall.shown = set(shown)
    with stage.borrowed():
        hall.draw(Moment(pose, SIZE, kt))
        return stage.read()


def generated(points: np.ndarray, how: str) -> np.ndarray:
    """Return the s and t (n, 2) that OpenGL generates at points (n, 3), read by feedback."""
    with_planes = with_settings(SCENE.settings, {"caustics.planes": how})
    gl.glFeedbackBuffer(16 * len(points), gl.GL_4D_COLOR_TEXTURE)
    gl.glRenderMode(gl.GL_FEEDBACK)
    white = Texture(np.full((1, 1, 3), 255, np.uint8))  # without a texture none are generated
    white.bind()
    gl.glEnable(gl.GL_TEXTURE_2D)
    generate(planes(with_planes), how)
    gl.glBegin(gl.GL_POINTS)
    for point in points.tolist():
        gl.glVertex3f(*point)
    gl.glEnd()
    vertices = [vertex for _, vertex in gl.glRenderMode(gl.GL_RENDER)]
    white.release()
    return np.array([vertex.texture[:2] for vertex in vertices])


def test_generated_coordinates_are_the_planes_times_the_place(fresh: Fresh) -> None:
    fresh()  # OpenGL keeps the address of the feedback buffer
    values = SCENE.settings
    frame = begin_frame(Moment(OVER_POOL, SIZE), values.camera, values.sun, values.fog)
    points = np.array([(1.5, -0.05, 2.1), (1.6, 0.0, 1.95), (1.65, -0.03, 2.25)])
    places = np.concatenate([points, np.ones((3, 1))], axis=1)
    in_eye = places @ frame.modelview.reshape(4, 4)
    for how, meant in (("object", places), ("eye", places), ("eye_before_camera", in_eye)):
        found = generated(points, how)
        assert np.allclose(found, meant @ planes(values).T, atol=1e-4), how


@pytest.mark.seldom(12, first=11)
def test_both_ways_to_multiply_the_bed_give_the_same_picture(stage: Stage, halls) -> None:
    switches = "caustics.doubled", "caustics.smooth", "caustics.sunlit"
    for more in ({}, *({each: False} for each in switches)):
        two = drawn(stage, halls, BED | more)
        one = drawn(stage, halls, BED | more | {"caustics.passes": "one"})
        assert np.abs(two - one).max() <= 2
    assert np.abs(two - drawn(stage, halls, shown=("room",))).max() > 40


@pytest.mark.seldom(3, first=2)
def test_object_and_eye_planes_agree_only_if_the_camera_is_set_first(stage: Stage, halls) -> None:
    object_linear = drawn(stage, halls, BED)
    eye = drawn(stage, halls, BED | {"caustics.planes": "eye"})
    before = drawn(stage, halls, BED | {"caustics.planes": "eye_before_camera"})
    assert np.abs(object_linear - eye).max() <= 2
    assert np.abs(object_linear - before).max() > 40


def test_as_printed_the_net_only_darkens_and_doubled_it_keeps_the_mean(stage: Stage, halls) -> None:
    dry = drawn(stage, halls, shown=("room",))
    everywhere = BED | {"caustics.sunlit": False}
    doubled = drawn(stage, halls, everywhere)
    printed = drawn(stage, halls, everywhere | {"caustics.doubled": False})
    bed = (doubled != dry).any(axis=2)
    assert (printed <= dry).all() and printed[bed].mean() < 0.6 * dry[bed].mean()
    assert (doubled[bed] > dry[bed] + 15).mean() > 0.1
    assert doubled[bed].mean() == pytest.approx(dry[bed].mean(), rel=0.2)


def test_the_net_is_strong_where_the_sun_reaches_the_bed_and_weak_in_shade(
    stage: Stage, halls
) -> None:
    dry = drawn(stage, halls, shown=("room",))
    bed = (drawn(stage, halls, BED | {"caustics.sunlit": False}) != dry).any(axis=2)
    sunny = bed & (dry.mean(axis=2) > 100)
    shady = bed & (dry.mean(axis=2) < 60)
    assert min(sunny.sum(), shady.sum()) > 200

    def contrast(sunlit: bool, part: np.ndarray) -> float:
        change = drawn(stage, halls, BED | {"caustics.sunlit": sunlit}) / np.maximum(dry, 1)
        return float(change[part].std())

    assert contrast(True, sunny) > 5 * contrast(True, shady)
    assert contrast(False, shady) > 0.6 * contrast(False, sunny)


def test_with_one_plane_for_both_coordinates_the_net_becomes_stripes() -> None:
    both = planes(with_settings(SCENE.settings, {"caustics.own_t": False}))
    assert (both[0] == both[1]).all()
    assert not (planes(SCENE.settings)[0] == planes(SCENE.settings)[1]).all()


def test_between_two_frames_the_picture_is_their_mean(stage: Stage, halls) -> None:
    step = SCENE.settings.caustics.period / 32
    first, half, second = (drawn(stage, halls, BED, kt=k * step) for k in (3.0, 3.5, 4.0))
    assert np.abs(first - second).max() > 30
    unclamped = (first < 255) & (second < 255)
    assert np.abs(half - (first + second) / 2)[unclamped].max() <= 3
    jumping = drawn(stage, halls, BED | {"caustics.smooth": False}, kt=3.99 * step)
    assert (jumping == first).all()


def test_the_product_of_sines_is_another_film(stage: Stage, halls) -> None:
    sines = drawn(stage, halls, BED | {"caustics.pattern": "sines"})
    assert np.abs(sines - drawn(stage, halls, BED)).max() > 40


def test_the_pool_only_adds_light_to_the_stone_around_it(stage: Stage, halls) -> None:
    dry = drawn(stage, halls, pose=WEST, shown=("room",))
    lit = drawn(stage, halls, pose=WEST)
    assert (lit >= dry).all()
    assert (lit > dry + 8).any(axis=2).mean() > 0.1


def test_thrown_light_fades_with_distance_and_leaves_what_turns_away_dark() -> None:
    height = 0.3
    near = np.array([[1.3, height, 2.1], [1.1, height, 2.1], [1.0, height, 2.1]])
    facing = np.tile([1.0, 0.0, 0.0], (3, 1))
    light = thrown(near, facing, SUN)
    assert light[0] > light[1] > light[2] > 0
    assert (thrown(near, -facing, SUN) == 0).all()
    below = np.array([[1.0, plan.POOL_WATER - 0.1, 2.1]])
    assert thrown(below, facing[:1], SUN) == 0


def test_most_light_is_thrown_away_from_the_sun() -> None:
    x, _, z = SUN / np.hypot(SUN[0], SUN[2])
    middle = np.array([1.6, 0.3, 2.1])
    ways = np.array([[-x, 0.0, -z], [x, 0.0, z]])
    away, towards = thrown(middle + 0.25 * ways, -ways, SUN)
    assert away > 2 * towards > 0


@pytest.mark.seldom(14, first=1)
def test_no_mesh_reaches_beyond_the_light() -> None:
    for _, mesh in lit_meshes(SUN):
        assert mesh.triangles.max() < len(mesh.vertices)
        colours = mesh.colors
        assert colours is not None and (colours[mesh.triangles].max(axis=(1, 2)) > 0).all()


def test_water_dims_red_most_and_more_the_flatter_it_is_looked_at() -> None:
    straight, flat = left_of_light(np.array([1.0, 0.1]), 0.05, (0.1, 0.4, 0.5))
    assert straight == pytest.approx(np.exp(-0.1 / np.array([0.1, 0.4, 0.5])))
    assert (flat < straight).all() and straight[0] < straight[1] < straight[2]


def test_water_mirrors_two_hundredths_from_above_and_all_along_its_surface() -> None:
    above, along = mirrored_share(np.array([1.0, 0.0]))
    assert above == pytest.approx(((INDEX - 1) / (INDEX + 1)) ** 2) and along == 1.0
    eye = np.array([1.6, 0.3, 2.1])
    places = np.array([[1.6, 0.0, 2.1], [1.6, 0.0, 2.5]])
    assert steepness(places, eye) == pytest.approx([1.0, 0.6])


@pytest.mark.seldom(3, first=2)
def test_with_too_few_texture_units_the_pool_is_drawn_without_caustics(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(extensions, "texture_units", lambda: 1)
    monkeypatch.setattr(extensions, "_told", set())
    for passes in ("two", "one"):
        settings = with_settings(SCENE.settings, {"caustics.passes": passes})
        hall = Hall(settings, Assets(), 0, ("room", "caustics"))
        pictures = []
        for shown in ({"room"}, {"room", "caustics"}):
            hall.shown = shown
            with stage.borrowed():
                hall.draw(Moment(OVER_POOL, SIZE, KT))
                pictures.append(stage.read())
        hall.release()
        assert (pictures[0] == pictures[1]).all()
    assert capsys.readouterr().err.count("landscape: caustics: off, for it needs 2 texture") == 1
