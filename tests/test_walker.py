"""The walker: heights and speeds by the report's formula, borders, walls, flight and stroke."""

import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from commands import SECONDS

from landscape.elements.dragon import dragon_obstacles
from landscape.elements.rabbit import rabbit_obstacles
from landscape.elements.settings import Castle, Dragon, Rabbit, Settings
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField
from landscape.geometry.masonry import FOOT, MERLON, TOWER_RADIUS, TOWER_TOP, WALL, walls_mesh
from landscape.geometry.obstacles import Obstacle, courtyard
from landscape.settings.declare import with_settings
from landscape.walk.walker import (
    AFLOAT,
    FALL,
    FLOOR,
    FLY,
    GRAVITY,
    LEAP,
    MARGIN,
    RADIUS,
    RIPPLE,
    Intent,
    Walker,
    advance,
    aimed,
    start,
)

SETTINGS = Settings()
WALK = SETTINGS.walk
FORWARD = Intent(forward=1.0)
CASTLE = Castle(x=20.0, z=20.0, yaw=-160.0)
BASE = 1.0


def castle_obstacles(castle: Castle, base: float) -> tuple[Obstacle, ...]:
    """Return the obstacles of a castle whose foot is at the height ``base``."""
    towers = TOWER_RADIUS, base + TOWER_TOP
    return courtyard(castle.x, castle.z, castle.yaw, WALL, base + 1 + MERLON, towers)


def flat(height: float = 1.0, water: float = 0.6) -> HeightField:
    return HeightField(np.full((50, 50), height, np.float32), 40.0, water)


def hills(seed: int = 1) -> HeightField:
    heights = np.random.default_rng(seed).uniform(0.0, 3.0, (50, 50)).astype(np.float32)
    return HeightField(heights, 40.0, 0.6)


def at(x: float, z: float, yaw: float = 0.0, field: HeightField | None = None) -> Walker:
    return start(Pose(x, None, z, yaw, 0.0), field or flat(), SETTINGS)


def go(walker, intent, seconds, field=None, obstacles=(), frames=1, settings=SETTINGS):
    for _ in range(frames):
        walker = advance(walker, intent, seconds / frames, field or flat(), obstacles, settings)
    return walker


def gap(walker: Walker, obstacles) -> float:
    return min(o.gap(walker.x, walker.z)[0] for o in obstacles)


def test_the_eye_stands_above_the_ground_by_the_report_s_formula():
    field, walker = hills(), at(7.3, 9.1, 40.0, hills())
    for _ in range(50):
        walker = advance(walker, FORWARD, 1 / 30, field, (), SETTINGS)
        ground = float(field.height(walker.x, walker.z))
        expected = ground + 0.006 * math.cos(walker.step / 3) + 0.1
        assert walker.y == pytest.approx(expected, abs=1e-12)
    assert walker.step == pytest.approx(50 / 30 * WALK.speed * WALK.steps_per_unit)


def test_walking_forward_matches_the_report_s_sum_over_steps():
    yaw, steps = 30.0, 54
    length = 1 / WALK.steps_per_unit
    x, z = 20.0, 20.0
    for step in range(steps):
        x += length * math.sin(math.radians(yaw))
        z -= length * math.cos(math.radians(yaw)) + 0.0005 * math.cos(step / 4)
    walker = go(at(20.0, 20.0, yaw), FORWARD, steps * length / WALK.speed, frames=7)
    assert walker.step == pytest.approx(steps)
    # The sum and its integral differ by half a step's term at each end.
    assert (walker.x, walker.z) == pytest.approx((x, z), abs=0.0006)
    straight = 20.0 - steps * length * math.cos(math.radians(yaw))
    assert abs(walker.z - straight) > 0.0008, "the small term is missing"


@pytest.mark.parametrize("frames", [1, 14, 60, 480])
def test_a_walk_does_not_depend_on_the_frame_rate(frames):
    for intent in (FORWARD, Intent(forward=-1, right=1, run=True), Intent(right=-1)):
        once, often = (go(at(20, 20, 77.0), intent, 2.0, frames=n) for n in (1, frames))
        assert (often.x, often.y, often.z) == pytest.approx((once.x, once.y, once.z), abs=1e-9)
        assert often.step == pytest.approx(once.step)


def test_walking_and_running_cover_their_units_per_second():
    for run, speed in ((False, WALK.speed), (True, WALK.speed * WALK.run)):
        walker = go(at(20, 20, 90.0), Intent(forward=1, run=run), 2.0, frames=33)
        assert walker.x - 20 == pytest.approx(2.0 * speed)


def test_a_diagonal_is_no_faster():
    settings = with_settings(SETTINGS, {"walk.steps_per_unit": 0})
    for forward in (-1, 1):
        for right in (-1, 1):
            walker = go(at(20, 20), Intent(forward, right), 1.0, settings=settings)
            assert math.hypot(walker.x - 20, walker.z - 20) == pytest.approx(WALK.speed)
            assert (walker.x > 20, walker.z < 20) == (right > 0, forward > 0)


def test_the_sides_are_left_and_right_of_the_line_of_sight():
    east = go(at(20, 20, 0.0), Intent(right=1), 1.0)
    south = go(at(20, 20, 90.0), Intent(right=1), 1.0)
    assert east.x > 20.8
    assert south.z > 20.8


@pytest.mark.seldom(3)
@pytest.mark.parametrize("yaw", [0, 45, 90, 135, 180, 225, 270, 315])
@pytest.mark.parametrize("flying", [False, True])
def test_nobody_leaves_the_map(yaw, flying):
    walker = replace(at(20, 20, yaw), flying=flying)
    for seconds in (1 / 60, 0.5, 1000.0):
        walker = go(walker, Intent(forward=1, run=True), seconds, frames=60)
        assert MARGIN <= walker.x <= 40 - MARGIN
        assert MARGIN <= walker.z <= 40 - MARGIN
    low = min(walker.x, walker.z, 40 - walker.x, 40 - walker.z)
    assert low == pytest.approx(MARGIN), "he stopped before the border"


def test_a_walker_wades_and_never_goes_under():
    sea = flat(height=0.1, water=0.6)
    walker = go(at(20, 20, 0.0, sea), FORWARD, 3.0, sea, frames=50)
    assert walker.y == pytest.approx(0.6 + 0.006 * math.cos(walker.step / 3) + 0.1)


def test_the_obstacles_stand_where_opengl_draws_the_walls():
    obstacles = castle_obstacles(CASTLE, BASE)
    corners = walls_mesh(4.0).vertices.astype(float)
    feet = corners[np.isclose(corners[:, 1], -FOOT)]
    assert len(feet) >= 16
    a = math.radians(CASTLE.yaw)
    # glRotatef(yaw, 0, 1, 0) after glTranslatef(-0.5, 0, -0.5).
    turn = np.array([[math.cos(a), math.sin(a)], [-math.sin(a), math.cos(a)]])
    for u, w in feet[:, [0, 2]] - 0.5:
        x, z = turn @ (u, w) + (CASTLE.x, CASTLE.z)
        walls = [o.gap(x, z)[0] for o in obstacles[:4]]
        assert min(abs(g) for g in walls) < 1e-6
    gate = turn @ (0.0, -0.5 - 0.2) + (CASTLE.x, CASTLE.z)
    assert min(o.gap(*gate)[0] for o in obstacles) == pytest.approx(0.2)
    assert min(o.gap(CASTLE.x, CASTLE.z)[0] for o in obstacles) == pytest.approx(0.5 - 0.045)


@pytest.mark.seldom(13, first=3)
@pytest.mark.parametrize("inside", [False, True])
def test_no_random_walk_crosses_a_wall(inside):
    obstacles, field = castle_obstacles(CASTLE, BASE), flat(BASE)
    rng = np.random.default_rng(7)
    touched = 0
    for _ in range(20):
        angle = rng.uniform(0, 2 * math.pi)
        away = 0.2 if inside else 1.0
        walker = at(20 + away * math.cos(angle), 20 + away * math.sin(angle))
        for _ in range(60):
            homeward = math.degrees(math.atan2(20 - walker.x, walker.z - 20))
            walker = replace(walker, yaw=(homeward + rng.normal(0, 60)) % 360)
            intent = Intent(float(rng.integers(0, 2)), float(rng.integers(-1, 2)), run=True)
            before = walker
            walker = advance(walker, intent, rng.exponential(0.3), field, obstacles, SETTINGS)
            assert gap(walker, obstacles) >= RADIUS - 1e-5
            assert _in_square(walker) == inside, f"from {before} to {walker}"
            touched += gap(walker, obstacles) < RADIUS + 1e-5
    assert touched > 100, "the walks met too few walls to prove anything"


def test_no_walk_goes_through_an_animal_but_the_walker_can_go_round_it():
    rabbit, dragon = Rabbit(x=20.0, z=20.0, scale=0.4), Dragon(x=25.0, z=20.0, yaw=90.0, scale=1.0)
    field = flat(BASE)
    obstacles = (*rabbit_obstacles(rabbit, field), *dragon_obstacles(dragon, field.water_level))
    for start_x in (19.0, 22.0):
        walker = at(start_x, 20.05)
        for _ in range(200):
            # Eastward, over both: what stands in the way turns the walker aside.
            walker = advance(
                replace(walker, yaw=90.0), Intent(1.0), 0.05, field, obstacles, SETTINGS
            )
            assert gap(walker, obstacles) >= RADIUS - 1e-5
        assert walker.x > 24.0 if start_x > 20 else walker.x > 20.5
    # The dragon's own x axis, turned by 90 degrees, runs along z.
    long, across = obstacles[1].gap(25.0, 21.5)[0], obstacles[1].gap(26.5, 20.0)[0]
    assert long == pytest.approx(1.5 - 0.85) and across == pytest.approx(1.5 - 0.16)


def _in_square(walker: Walker) -> bool:
    """Tell whether a walker stands within the castle's unit square."""
    a = math.radians(CASTLE.yaw)
    dx, dz = walker.x - CASTLE.x, walker.z - CASTLE.z
    u = math.cos(a) * dx - math.sin(a) * dz
    w = math.sin(a) * dx + math.cos(a) * dz
    return max(abs(u), abs(w)) < 0.5


@pytest.mark.parametrize("seconds", [0.1, 1.0, 30.0, 1e6])
def test_no_frame_is_long_enough_to_tunnel(seconds):
    castle = Castle(x=20.0, z=20.0, yaw=0.0)
    obstacles = castle_obstacles(castle, BASE)
    walker = at(20.1, 21.0)
    for _ in range(20):
        walker = advance(walker, FORWARD, seconds, flat(BASE), obstacles, SETTINGS)
        assert walker.z >= 20.5 + RADIUS - 1e-6
    assert walker.z == pytest.approx(20.5 + RADIUS, abs=1e-3)


@pytest.mark.parametrize("side", [0, 90, 180, 270])
@pytest.mark.parametrize("yaw", [0.0, -160.0])
def test_a_walker_slides_along_a_wall_met_at_an_angle(side, yaw):
    castle = Castle(x=20.0, z=20.0, yaw=yaw)
    obstacles = castle_obstacles(castle, BASE)

    def along_and_off(x, z):
        """Return a position relative to the wall: units along it, and from the castle's centre."""
        a = math.radians(side + yaw)
        return (
            math.cos(a) * (x - 20) - math.sin(a) * (z - 20),
            math.sin(a) * (x - 20) + math.cos(a) * (z - 20),
        )

    a = math.radians(side + yaw)
    x = 20 + math.cos(a) * -0.2 + math.sin(a) * 0.6
    z = 20 - math.sin(a) * -0.2 + math.cos(a) * 0.6
    assert along_and_off(x, z) == pytest.approx((-0.2, 0.6))
    walker = go(at(x, z, 45.0 - side - yaw), FORWARD, 0.3, flat(BASE), obstacles, frames=10)
    along, off = along_and_off(walker.x, walker.z)
    assert off == pytest.approx(0.5 + RADIUS, abs=1e-3)
    assert along == pytest.approx(-0.2 + 0.3 * WALK.speed * math.sin(math.pi / 4), abs=0.01)


def test_a_flyer_comes_down_on_a_wall_and_stays_above_it():
    obstacles = castle_obstacles(Castle(x=20.0, z=20.0, yaw=0.0), BASE)
    walker = replace(at(20.0, 20.48), y=3.0, flying=True)
    for _ in range(3):
        walker = go(walker, Intent(up=-1), 1.0, flat(BASE), obstacles, frames=9)
    assert (walker.x, walker.z) == (20.0, 20.48)
    assert walker.y == pytest.approx(BASE + 1.07 + FLOOR)


def test_flight_follows_the_line_of_sight_both_ways_and_up():
    walker = replace(at(20, 20, 90.0), y=5.0, flying=True, pitch=30.0)
    reach = FLY * WALK.speed
    there = go(walker, FORWARD, 1.0)
    assert there.x - 20 == pytest.approx(reach * math.cos(math.radians(30)))
    assert there.y - 5 == pytest.approx(reach * 0.5)
    assert there.step == walker.step
    assert go(walker, Intent(up=1), 1.0).y - 5 == pytest.approx(reach)
    both = go(walker, Intent(forward=1, right=1, up=1), 1.0)
    moved = math.dist((20, 5, 20), (both.x, both.y, both.z))
    assert moved == pytest.approx(reach)


@pytest.mark.seldom(13, first=2)
def test_no_random_flight_enters_the_ground_the_water_or_the_castle():
    field, obstacles = hills(3), castle_obstacles(CASTLE, 2.0)
    rng = np.random.default_rng(5)
    walker = replace(at(20, 22, 0.0, field), y=4.0, flying=True)
    low = over = 0
    for _ in range(1500):
        homeward = math.degrees(math.atan2(20 - walker.x, walker.z - 20))
        look = Pose(0, 0, 0, (homeward + rng.normal(0, 50)) % 360, rng.uniform(-89, 60))
        walker = replace(walker, yaw=look.yaw, pitch=look.pitch)
        intent = Intent(1.0, float(rng.integers(-1, 2)), float(rng.integers(-1, 2)))
        walker = advance(walker, intent, rng.exponential(0.2), field, obstacles, SETTINGS)
        floor = float(field.height(walker.x, walker.z)) + FLOOR
        assert floor - 1e-9 <= walker.y <= 40
        low += walker.y < floor + 1e-6
        for o in obstacles:
            if o.gap(walker.x, walker.z)[0] < RADIUS - 1e-5:
                over += 1
                assert walker.y >= o.top + FLOOR - 1e-9

    assert low > 100
    assert over > 20, "the flights met too little to prove anything"


def test_landing_falls_to_the_ground_and_the_formula_holds_again():
    walker = replace(at(20, 20), y=4.1, flying=True)
    walker = go(walker, Intent(fly=True), 0.0)
    assert not walker.flying
    assert walker.y == pytest.approx(4.1)
    falling = go(walker, Intent(), 0.25, frames=5)
    assert falling.y == pytest.approx(4.1 - 0.25 * FALL)
    landed = go(falling, Intent(), 2.0, frames=20)
    assert landed.y == pytest.approx(1.0 + 0.1 + 0.006 * math.cos(landed.step / 3))
    again = go(landed, Intent(fly=True), 0.1)
    assert again.flying
    assert again.y == pytest.approx(landed.y)


def test_a_walker_who_falls_on_a_wall_slips_off_it():
    castle = Castle(x=20.0, z=20.0, yaw=0.0)
    obstacles, field = castle_obstacles(castle, BASE), flat(BASE)
    for z in (20.5 - 0.03, 20.5 - 0.01):
        walker = replace(at(20.0, z), y=6.0, flying=True)
        walker = go(walker, Intent(fly=True), 0.0, field, obstacles)
        walker = go(walker, Intent(), 3.0, field, obstacles, frames=90)
        assert walker.y == pytest.approx(1.0 + 0.1 + 0.006)
        assert gap(walker, obstacles) >= RADIUS - 1e-6


def test_a_view_from_above_starts_in_flight_and_one_at_eye_height_on_foot():
    assert start(Pose(20, 3.0, 20), flat(), SETTINGS).flying
    for y in (None, 1.1, 0.2):
        walker = start(Pose(20, y, 20, 12.0, -3.0), flat(), SETTINGS)
        assert not walker.flying
        assert walker.y == pytest.approx(1.106)
        assert (walker.yaw, walker.pitch) == (12.0, -3.0)


def test_the_mouse_turns_the_view_within_the_limits_of_pitch():
    walker = go(at(20, 20, 350.0), Intent(look=(200.0, -100.0)), 0.0)
    assert walker.yaw == pytest.approx((350 + 200 * WALK.mouse) % 360)
    assert walker.pitch == pytest.approx(100 * WALK.mouse)
    assert go(walker, Intent(look=(0, -1e6)), 0.1).pitch == 89.0
    assert go(walker, Intent(look=(0, 1e6)), 0.1).pitch == -89.0


@pytest.mark.parametrize("frames", [1, 10, 90])
def test_the_arrow_keys_turn_at_a_rate_per_second(frames):
    walker = go(at(20, 20, 0.0), Intent(turn=-1), 1.0, frames=frames)
    assert walker.yaw == pytest.approx(360 - WALK.turn)


@pytest.mark.parametrize("rate", [20, 60, 144])
def test_a_stroke_shows_its_four_frames_in_time_and_then_rests(rate):
    per_frame = SETTINGS.walk.stroke_kt / SETTINGS.clock.kt_per_second
    walker = go(at(20, 20), Intent(strike=True), 1 / rate)
    shown: dict[int, int] = {walker.stroke: 1}
    order = [walker.stroke]
    for _ in range(3 * rate):
        walker = go(walker, Intent(), 1 / rate)
        shown[walker.stroke] = shown.get(walker.stroke, 0) + 1
        if order[-1] != walker.stroke:
            order.append(walker.stroke)
    assert order == [1, 2, 3, 4, 0]
    for stroke in (1, 2, 3, 4):
        assert shown[stroke] / rate == pytest.approx(per_frame, abs=1.01 / rate)


def test_a_stroke_is_not_restarted_while_it_runs():
    walker = go(at(20, 20), Intent(strike=True), 0.0)
    seen = []
    for _ in range(60):
        walker = go(walker, Intent(strike=walker.stroke > 0), 1 / 60)
        seen.append(walker.stroke)
    assert seen == sorted(seen[: seen.index(0)]) + [0] * (len(seen) - seen.index(0))


@pytest.mark.seldom(3)
def test_the_walker_needs_no_opengl():
    code = (
        "import sys, landscape.walk.walker;"
        "sys.exit('OpenGL' in sys.modules or 'glfw' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], timeout=SECONDS).returncode == 0


@pytest.mark.parametrize(
    ("cursor", "yaw", "pitch"),
    [
        ((200, 100), 0.0, 0.0),
        ((300, 100), 90.0, 0.0),
        ((100, 50), 270.0, 44.5),
        ((999, 300), 180, -89),
    ],
)
def test_an_absolute_mouse_turns_the_view_to_where_it_points(cursor, yaw, pitch) -> None:
    walker = Walker(20.0, 1.0, 20.0, yaw=33.0, pitch=-20.0)
    look = aimed(walker, cursor, (400, 200), WALK.mouse)
    after = go(walker, Intent(look=look), 0.0)
    assert after.yaw == pytest.approx(yaw, abs=1e-9) or after.yaw == pytest.approx(yaw + 360)
    assert after.pitch == pytest.approx(pitch, abs=1e-9)


def test_an_absolute_mouse_without_sensitivity_turns_nothing() -> None:
    walker = Walker(20.0, 1.0, 20.0)
    assert aimed(walker, (10, 10), (400, 200), 0.0) == (0.0, 0.0)
    assert aimed(walker, (10, 10), (0, 0), 0.12) == (0.0, 0.0)


def beach(slope: float = 0.1) -> HeightField:
    """A beach that runs into the sea to the north; the water's edge is at z = 20."""
    z = np.linspace(0.0, 40.0, 81)
    heights = np.repeat((0.6 + slope * (z - 20.0))[:, None], 81, axis=1)
    return HeightField(heights.astype(np.float32), 40.0, 0.6)


SWIMMER = with_settings(SETTINGS, {"walk.swim": True, "walk.bob": 0.0})


def into_the_sea(frames: int = 300) -> list[Walker]:
    """Return a swimmer's walkers, frame by frame, on a way of ten seconds north from the beach."""
    walker, way = start(Pose(20.0, None, 20.5), beach(), SWIMMER), []
    for _ in range(frames):
        walker = advance(walker, FORWARD, 10.0 / frames, beach(), (), SWIMMER)
        way.append(walker)
    return way


def test_a_walker_wades_until_he_swims_with_his_eye_just_above_the_water():
    for walker in into_the_sea():
        depth = float(beach().depth(walker.x, walker.z))
        floor = float(beach().terrain_height(walker.x, walker.z))
        assert walker.y == pytest.approx(max(floor + 0.1, 0.6 + AFLOAT), abs=RIPPLE + 1e-6)
        assert walker.y > 0.6 + 0.03, "waves would cover the eye"
        if not 0.02 < depth < 0.06:
            assert walker.swimming == (depth > 0.04)
    assert walker.swimming


@pytest.mark.seldom(3)
def test_an_eye_in_the_water_never_jumps():
    heights = np.array([walker.y for walker in into_the_sea(600)])
    assert np.abs(np.diff(heights)).max() < 0.003
    resting = into_the_sea(60)[-1]
    rise = []
    for _ in range(90):
        resting = advance(resting, Intent(), 1 / 30, beach(), (), SWIMMER)
        rise.append(resting.y)
    assert max(rise) - min(rise) == pytest.approx(2 * RIPPLE, rel=0.02), "a swimmer bobs"


@pytest.mark.seldom(5, first=4)
def test_a_swimmer_is_half_as_fast_at_any_frame_rate():
    far, swum = into_the_sea()[-1], []
    for frames in (2, 30, 240):
        walker = go(far, FORWARD, 2.0, beach(), frames=frames, settings=SWIMMER)
        swum.append(far.z - walker.z)
    assert swum == pytest.approx([0.5 * 2.0 * WALK.speed] * 3, rel=1e-3)
    ends = [into_the_sea(frames)[-1].z for frames in (10, 100, 1000)]
    assert ends == pytest.approx([ends[-1]] * 3, abs=0.01)


def test_on_the_shore_swimming_begins_and_ends_once_each():
    walker, states = start(Pose(20.0, None, 20.0, 0.0), beach(), SWIMMER), []
    for _ in range(80):
        walker = advance(walker, FORWARD, 1 / 30, beach(), (), SWIMMER)
        states.append(walker.swimming)
    for k in range(400):
        step = Intent(forward=-1.0 if k % 3 else 0.5)
        walker = advance(walker, step, 1 / 30, beach(), (), SWIMMER)
        states.append(walker.swimming)
    assert not states[0] and not states[-1]
    assert np.abs(np.diff(np.array(states, int))).sum() == 2


def test_without_the_setting_one_walks_on_the_water_as_in_2006():
    walker = go(start(Pose(20.0, None, 20.5), beach(), SETTINGS), FORWARD, 5.0, beach(), frames=50)
    assert float(beach().depth(walker.x, walker.z)) > 0.3
    assert walker.y == pytest.approx(0.6 + 0.1 + 0.006 * math.cos(walker.step / 3))
    assert not walker.swimming


def test_a_walker_knows_that_he_is_at_the_edge_of_the_map():
    for yaw in (0.0, 90.0, 180.0, 270.0):
        for flying in (False, True):
            walker = replace(at(20.0, 20.0, yaw), flying=flying)
            assert not go(walker, FORWARD, 10.0).at_edge
            assert go(walker, FORWARD, 60.0, frames=60).at_edge


JUMP = with_settings(SETTINGS, {"walk.jump": True, "walk.bob": 0.0})


@pytest.mark.parametrize("frames", [20, 60, 240])
def test_a_jump_is_as_high_and_as_long_at_any_frame_rate(frames: int) -> None:
    walker = start(Pose(20.0, None, 20.0, 0.0, 0.0), flat(), JUMP)
    ground = walker.y
    heights = []
    for frame in range(frames):
        wish = Intent(forward=1.0, up=float(frame == 0))
        walker = advance(walker, wish, 1.0 / frames, flat(), (), JUMP)
        heights.append(walker.y - ground)
    assert max(heights) == pytest.approx(LEAP**2 / (2 * GRAVITY), rel=0.02)
    aloft = sum(height > 0 for height in heights) / frames
    assert aloft == pytest.approx(2 * LEAP / GRAVITY, abs=1.5 / frames)
    assert walker.rise == walker.drop == 0.0 and walker.z < 20.0  # he went on in the air


def test_only_one_who_stands_jumps_and_only_where_the_setting_says_so() -> None:
    up = Intent(up=1.0)
    assert go(at(20.0, 20.0), up, 0.1).drop == 0.0
    one = go(start(Pose(20.0, None, 20.0), flat(), JUMP), up, 0.1, settings=JUMP)
    assert go(one, up, 0.1, settings=JUMP).rise < one.rise < LEAP  # no second leap in the air
    flying = go(one, Intent(fly=True), 0.01, settings=JUMP)
    assert flying.flying and flying.rise == flying.drop == 0.0


def test_a_swimmer_does_not_jump() -> None:
    sea = flat(0.0)
    walker = start(Pose(20.0, None, 20.0), sea, with_settings(JUMP, {"walk.swim": True}))
    swimming = with_settings(JUMP, {"walk.swim": True})
    walker = advance(walker, Intent(), 0.1, sea, (), swimming)
    assert walker.swimming
    assert advance(walker, Intent(up=1.0), 0.1, sea, (), swimming).rise == 0.0
