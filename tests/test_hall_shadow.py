"""The statue's planar shadows: where projection puts them, no pixel darkened twice, safeguards."""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageDraw
from stage import SIZE, Stage, project

from framelens.gl.seam import recording
from landscape.elements import sun
from landscape.elements.animal import read_animal
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import grid_triangles
from landscape.geometry.planar import shadows_of
from landscape.hall import plan
from landscape.hall.architecture import hall as hall_surfaces
from landscape.hall.hall import SCENE, Hall
from landscape.hall.planar_shadow import (
    FLOOR_PLANE,
    NORTH_PLANE,
    flame,
    on_floor,
    on_north,
    reached,
)
from landscape.hall.statue import COARSER
from landscape.scene.scene import Moment, begin_frame
from landscape.settings.declare import with_settings

FINER = 16
FOV = SCENE.settings.camera.fov
STEADY: dict[str, Any] = {
    "shadow.flicker": 0.0,
    "shadow.light": "torch",
    "shadow.method": "darken",
    "shadow.strength": 0.5,
    "mirror.enabled": False,
}
AT_WALL = Pose(1.6, 0.2, 1.0, 0.0, 2.0)  # between the statue and the north wall
AT_FLOOR = Pose(1.6, 0.42, 0.95, 0.0, -70.0)  # upon the floor behind the plinth
SOUTH = Pose(1.62, 0.42, 2.5, 0.0, -80.0)  # upon the floor between pool and door
SLANTED = Pose(1.55, 0.1, 1.02, 335.0, -12.0)  # along the floor behind the plinth, to the wall
# A frame of 4 by 3 sees this much of each plane from there with nothing in front of it.
WALL_SEEN = (1.36, 1.84), (0.02, 0.32)  # x, y; a string course is above
FLOOR_SEEN = (1.36, 1.84), (0.5, 0.98)  # x, z


@pytest.fixture(scope="module")
def hall(the_stage: Stage) -> Iterator[Hall]:
    the_stage.enter()
    with the_stage.borrowed():
        opened = Hall(with_settings(SCENE.settings, STEADY), Assets(), 0)
        opened.shown -= {"torches", "shafts"}  # light that is added over shadows
    yield opened
    the_stage.enter()
    opened.release()


def drawn(stage: Stage, hall: Hall, pose: Pose, changed: dict[str, Any] | None = None):
    """Return the picture, int64 (h, w, 3), with settings changed."""
    assert hall.apply(with_settings(SCENE.settings, {**STEADY, **(changed or {})}))
    with stage.borrowed():
        hall.draw(Moment(pose, SIZE))
        return stage.read()


def statue_triangles() -> np.ndarray:
    """Return the triangles (m, 3, 3) of the mesh that casts the shadow, where it stands."""
    unit = read_animal(Assets(), "dragon.ply", "dragon.mesh")
    mesh = clustered(unit, COARSER)
    turn = math.radians(plan.STATUE_YAW)
    x, y, z = (mesh.vertices.astype(np.float64) * plan.STATUE_SCALE).T
    (east, south), (_, top) = plan.STATUE, plan.PLINTH
    lift = top - plan.STATUE_SUNK - float(unit.vertices[:, 1].min()) * plan.STATUE_SCALE
    placed = [
        east + x * math.cos(turn) + z * math.sin(turn),
        y + lift,
        south - x * math.sin(turn) + z * math.cos(turn),
    ]
    return np.stack(placed, axis=1)[mesh.triangles]


def plinth_triangles() -> np.ndarray:
    """Return the triangles (m, 3, 3) of the plinth, which casts a shadow, too."""
    found = []
    for surface in hall_surfaces():
        if surface.material == "plinth":
            rows, columns = surface.points.shape[:2]
            found.append(surface.points.reshape(-1, 3)[grid_triangles(columns, rows)])
    return np.concatenate(found)


def filled(pose: Pose, shadows: np.ndarray) -> np.ndarray:
    """Return the pixels, bool (h, w), whose middles triangles (m, 3, 3) cover.

    They are drawn FINER times as large: ImageDraw fills half a pixel beyond each edge.
    """
    image = Image.new("1", (SIZE[0] * FINER, SIZE[1] * FINER))
    draw = ImageDraw.Draw(image)
    for triangle in shadows[~np.isnan(shadows).any(axis=(1, 2))]:
        corners = [project(pose, tuple(corner), FOV) for corner in triangle]
        draw.polygon([(FINER * c, FINER * r) for c, r in corners], fill=1)
    return np.asarray(image)[FINER // 2 :: FINER, FINER // 2 :: FINER]


def seen(pose: Pose, plane: np.ndarray) -> np.ndarray:
    """Return the pixels, bool (h, w), of the part of a plane that nothing hides."""
    wall = plane is NORTH_PLANE
    (low, high), (first, last) = WALL_SEEN if wall else FLOOR_SEEN
    area = [(low, first), (high, first), (high, last), (low, last)]
    corners = [(a, b, plan.INSIDE.north) if wall else (a, 0.0, b) for a, b in area]
    return filled(
        pose, np.array([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]])
    )


LIGHTS = {
    "torch": flame(0.0, replace(SCENE.settings.shadow, flicker=0.0)),
    "sun": np.append(sun.direction(SCENE.settings.sun), 0.0),
}


@pytest.mark.seldom(13, first=4)
@pytest.mark.parametrize(
    ("light", "plane", "pose"),
    [
        ("torch", NORTH_PLANE, AT_WALL),
        ("torch", FLOOR_PLANE, AT_FLOOR),
        ("sun", FLOOR_PLANE, Pose(1.38, 0.37, 1.2, 0.0, -88.0)),
    ],
    ids=["torch on the wall", "torch on the floor", "sun on the floor"],
)
def test_the_shadow_covers_what_projection_covers(stage, hall, light, plane, pose) -> None:
    unlit = drawn(stage, hall, pose, {"shadow.light": light, "shadow.strength": 0.0})
    dark = drawn(stage, hall, pose, {"shadow.light": light, "shadow.strength": 1.0})
    triangles = np.concatenate([statue_triangles(), plinth_triangles()])
    shadows = shadows_of(triangles.reshape(-1, 3), plane, LIGHTS[light]).reshape(-1, 3, 3)
    where = seen(pose, plane) if light == "torch" else np.ones(SIZE[::-1], bool)
    if light == "sun":
        # West of the plinth, east of the pillars; nothing hides the floor from above there.
        corners = [(1.35, 0, 1.0), (1.41, 0, 1.0), (1.41, 0, 1.4), (1.35, 0, 1.4)]
        where = filled(pose, np.array([[corners[k] for k in t] for t in ((0, 1, 2), (0, 2, 3))]))
    got, wanted = (dark != unlit).any(axis=2) & where, filled(pose, shadows) & where
    assert wanted.sum() > 500 and (where & ~wanted).sum() > 100
    assert (got & wanted).sum() / (got | wanted).sum() > 0.99


@pytest.mark.seldom(12, first=7)
@pytest.mark.parametrize("pose", [AT_WALL, AT_FLOOR], ids=["wall", "floor"])
def test_no_pixel_is_darkened_twice_by_one_light(stage, hall, pose) -> None:
    plain = drawn(stage, hall, pose, {"shadow.strength": 0.0})
    once = drawn(stage, hall, pose)
    darkened = (once != plain).any(axis=2)
    assert darkened.sum() > 2000
    assert np.abs(once - plain * 0.5)[darkened].max() <= 1
    twice = drawn(stage, hall, pose, {"shadow.stencil": False})
    assert (twice < plain * 0.3 - 1).any(axis=2).sum() > 500


def test_two_lights_darken_what_neither_reaches_once_each(stage, hall) -> None:
    pose = Pose(1.42, 0.3, 1.05, 0.0, -60.0)
    plain = drawn(stage, hall, pose, {"shadow.strength": 0.0})
    both = drawn(stage, hall, pose, {"shadow.light": "both"})
    factor = np.full(plain.shape[:2], np.nan)
    for times in (1.0, 0.5, 0.25):
        factor[np.abs(both - plain * times).max(axis=2) <= 1.5] = times
    assert not np.isnan(factor).any()
    assert all((factor == times).sum() > 300 for times in (1.0, 0.5, 0.25))


@pytest.mark.parametrize("light", ["torch", "sun", "both"])
@pytest.mark.parametrize("pose", [AT_WALL, AT_FLOOR], ids=["wall", "floor"])
@pytest.mark.sweep(3)
def test_a_relit_surface_is_in_each_part_what_its_light_maps_say(stage, hall, pose, light) -> None:
    lights = ("sun", "torch") if light == "both" else (light,)
    given = {"shadow.light": light}
    lit = drawn(stage, hall, pose, {**given, "shadow.strength": 0.0})
    relit = drawn(stage, hall, pose, {**given, "shadow.method": "relight"})
    plane = NORTH_PLANE if pose is AT_WALL else FLOOR_PLANE
    masks = {}
    for name in lights:
        changed = {"shadow.light": name, "shadow.strength": 1.0}
        masks[name] = (drawn(stage, hall, pose, changed) != lit).any(axis=2)
    where = seen(pose, plane)
    expected = lit.copy()
    room = hall.room
    for count in range(1, len(lights) + 1):
        for without in combinations(lights, count):
            with stage.borrowed():
                values = hall.settings
                begin_frame(Moment(pose, SIZE), values.camera, values.sun, values.fog)
                (room.draw_north if pose is AT_WALL else room.draw_floor)(*without)
                alone = stage.read()
            part = np.logical_and.reduce([masks[name] for name in without])
            expected[part] = alone[part]

    assert np.abs(relit - expected).max(axis=2)[where].max() <= 1
    darker = 15 if pose is AT_WALL else 5  # the floor there is farther from the torch's beam
    assert light == "sun" or ((relit < lit - darker).any(axis=2) & where).sum() > 500


def test_a_shadow_that_cannot_reach_its_receiver_is_left_out() -> None:
    box = np.array([(x, y, z) for x in (1.4, 1.8) for y in (0.0, 0.4) for z in (1.0, 1.4)])
    floor, north = on_floor(lambda: None), on_north(lambda: None)
    assert reached(box, floor, LIGHTS["sun"]) is not None
    assert reached(box, north, LIGHTS["sun"]) is None
    assert reached(box, floor, LIGHTS["torch"]) is not None
    assert reached(box, north, LIGHTS["torch"]) is not None
    assert reached(box, north, np.array([0.1, 0.3, -1.0, 0.0])) is None, "from behind the wall"


def test_without_the_stencil_the_shadow_hangs_in_the_rose_window(stage, hall) -> None:
    hall.shown.remove("sky")
    pose = Pose(1.6, plan.ROSE[0], 0.62, 0.0, 0.0)
    middle = slice(80, 98), slice(40, 100)  # the lower petals, before which the horns' shadow lies
    plain = drawn(stage, hall, pose, {"shadow.strength": 0.0})
    assert (drawn(stage, hall, pose)[middle] == plain[middle]).all()
    assert (drawn(stage, hall, pose, {"shadow.stencil": False}) != plain)[middle].any(axis=2).any()
    hall.shown.add("sky")


def test_without_the_offset_wall_and_shadow_fight_pixel_by_pixel(stage, hall) -> None:
    plain = drawn(stage, hall, SLANTED, {"shadow.strength": 0.0})
    whole = (drawn(stage, hall, SLANTED) != plain).any(axis=2)
    torn = (drawn(stage, hall, SLANTED, {"shadow.offset": False}) != plain).any(axis=2)
    assert 0.05 * whole.sum() < torn.sum() < 0.95 * whole.sum()

    def edges(mask: np.ndarray) -> int:
        return int((mask[:, 1:] != mask[:, :-1]).sum())

    assert edges(torn) > 3 * edges(whole)


def test_without_its_safeguard_what_is_higher_than_the_torch_has_an_anti_shadow(
    stage, hall
) -> None:
    # So low and near that the lines through it meet the hall's floor.
    low = {"shadow.flame": (1.47, 0.21, 1.6)}
    plain = drawn(stage, hall, SOUTH, {**low, "shadow.strength": 0.0})
    lit = drawn(stage, hall, SOUTH, low)
    assert (lit == plain).all(), "no light is taken away before the statue"
    anti = drawn(stage, hall, SOUTH, {**low, "shadow.behind": False})
    assert ((anti != plain).any(axis=2)).sum() > 300


@pytest.mark.seldom(3)
def test_a_flame_before_the_wall_casts_the_statue_upside_down_only_without_its_safeguard(
    stage, hall
) -> None:
    flame_at = np.array([1.6, 0.22, 0.85])
    before = {"shadow.light": "torch", "shadow.flame": tuple(flame_at)}
    plain = drawn(stage, hall, AT_WALL, {**before, "shadow.strength": 0.0})
    got, anti = (
        drawn(stage, hall, AT_WALL, {**before, "shadow.behind": on}) for on in (True, False)
    )
    wall = seen(AT_WALL, NORTH_PLANE)
    assert (got == plain)[wall].all()
    # Each point of the statue, on a line through the flame, as far behind it as the wall is.
    triangles = np.concatenate([statue_triangles(), plinth_triangles()])
    away = triangles - flame_at
    shadows = flame_at + away * ((plan.INSIDE.north - flame_at[2]) / away[..., 2:])
    wanted = filled(AT_WALL, shadows) & wall
    dark = (anti != plain).any(axis=2) & wall
    assert wanted.sum() > 1000 and (wall & ~wanted).sum() > 1000
    assert (dark & wanted).sum() / (dark | wanted).sum() > 0.98


@pytest.mark.seldom(10, first=3)
def test_a_sun_behind_the_north_wall_casts_nothing_on_its_inside(stage, hall) -> None:
    # A hall of its own: caustics are built for one place of the sun.
    with stage.borrowed():
        elements = ("room", "floor", "statue", "shadow")
        hall = Hall(with_settings(SCENE.settings, STEADY), Assets(), 0, elements)
    low = {"sun.azimuth": 3.0, "sun.elevation": 6.0, "shadow.light": "sun"}
    plain = drawn(stage, hall, AT_WALL, {**low, "shadow.strength": 0.0})
    got, anti = (drawn(stage, hall, AT_WALL, {**low, "shadow.behind": b}) for b in (True, False))
    hall.release()
    wall = seen(AT_WALL, NORTH_PLANE)
    assert (got == plain)[wall].all()
    assert (anti != plain)[wall].any(axis=1).sum() > 300


def test_the_torch_s_flame_wavers_with_kt_and_stays_near(stage, hall) -> None:
    wavers, still = (replace(SCENE.settings.shadow, flicker=f) for f in (0.004, 0.0))
    places = np.array([flame(kt, wavers) for kt in np.linspace(0, 300, 500)])
    assert np.abs(places - flame(0.0, still)).max() <= 0.004
    assert (places[:, 3] == 1.0).all() and np.ptp(places[:, :3], axis=0).min() > 0.003
    steps = np.abs(np.diff(np.array([flame(kt, wavers) for kt in range(90)]), axis=0))
    assert steps.max() < 0.004, "it does not jump"


@pytest.mark.seldom(13, first=9)
def test_the_shadow_on_the_wall_shows_in_the_floor_s_mirror_image(stage, hall) -> None:
    pose = Pose(1.6, 0.14, 0.9, 0.0, -22.0)
    image = {"mirror.enabled": True, "mirror.strength": 1.0}
    rebuilt = with_settings(SCENE.settings, {**STEADY, **image})
    with stage.borrowed():
        other = Hall(rebuilt, Assets(), 0)
        other.shown -= {"torches", "shafts"}
        pictures = []
        for strength in (0.0, 0.5):
            assert other.apply(with_settings(rebuilt, {"shadow.strength": strength}))
            other.draw(Moment(pose, SIZE))
            pictures.append(stage.read())
        other.release()
    floor = slice(75, 115), slice(40, 120)
    plain, dark = (picture[floor] for picture in pictures)
    assert (dark < plain * 0.3 - 1).all(axis=2).sum() > 300
    assert (dark >= plain * 0.25 - 1.5).all(), "by the wall's shadow and by the floor's, once each"


def test_a_trace_names_the_shadow_s_calls(stage, hall) -> None:
    drawn(stage, hall, AT_WALL)
    with stage.borrowed(), recording() as recorder:
        hall.draw(Moment(AT_WALL, SIZE))
    own = [call.name for call in recorder.calls if call.element == "shadow"]
    assert own.count("glMultMatrixf") == 2 and "glPolygonOffset" in own


def test_a_lamp_that_is_no_point_has_a_soft_shadow_as_dark_within_and_none_outside(
    stage: Stage, hall: Hall
) -> None:
    def left(**changed: Any) -> np.ndarray:
        shadow = {f"shadow.{name}": value for name, value in changed.items()}
        lit, shaded = (
            drawn(stage, hall, AT_FLOOR, {**shadow, "shadow.enabled": on}) for on in (False, True)
        )
        bright = lit.min(axis=2) > 30
        return np.where(bright, shaded.sum(axis=2) / np.maximum(lit.sum(axis=2), 1), np.nan)

    hard, soft = left(), left(lamp=0.03)
    edge = [((each > 0.55) & (each < 0.95)).sum() for each in (hard, soft)]
    assert edge[1] > 300 and edge[0] < edge[1] / 10, edge
    inside = soft < 0.55
    assert inside.sum() > 200 and (hard[inside] < 0.6).all()
    assert (soft[hard > 0.95] >= 0.5).all()
    assert ((hard > 0.95) & (soft > 0.95)).sum() > 1000


def test_a_torch_that_was_moved_throws_the_statue_s_shadow_on_the_plinth(
    stage: Stage, hall: Hall
) -> None:
    moved = {"shadow.casters": "all", "shadow.flame": (1.33, 0.72, 0.72)}
    above = Pose(plan.STATUE[0], 0.6, plan.STATUE[1] + 0.12, 0.0, -80.0)
    with_it, without = (
        drawn(stage, hall, above, {**moved, "shadow.enabled": on}) for on in (True, False)
    )
    darker = with_it.sum(axis=2) < 0.8 * without.sum(axis=2)
    (x, z), top = plan.STATUE, plan.PLINTH[1]
    corners = ((-0.15, 0.1), (0.15, 0.1), (0.15, 0.15), (-0.15, 0.15))
    places = [project(above, (x + east, top, z + south), FOV) for east, south in corners]
    low, high = np.min(places, axis=0).astype(int), np.max(places, axis=0).astype(int)
    assert darker[low[1] : high[1] + 1, low[0] : high[0] + 1].sum() > 20


def test_only_the_top_of_the_plinth_receives(stage: Stage, hall: Hall) -> None:
    moved = {"shadow.casters": "all", "shadow.flame": (1.6, 0.72, 1.75)}
    side = Pose(plan.STATUE[0], 0.05, 1.75, 0.0, 0.0)
    with_it, without = (
        drawn(stage, hall, side, {**moved, "shadow.enabled": on}) for on in (True, False)
    )
    x, y = project(side, (plan.STATUE[0] + 0.1, 0.05, plan.STATUE[1] + plan.PLINTH[0]), FOV)
    around = np.s_[round(y) - 2 : round(y) + 3, round(x) - 2 : round(x) + 3]
    assert (with_it[around] == without[around]).all()
