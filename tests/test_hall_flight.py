"""The hall's flying camera: closed, steady by SLERP, whirling by Euler angles."""

import numpy as np
import pytest
from hall_pictures import HallPictures
from stage import Stage

from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.quaternion import from_angles, product
from landscape.hall.flight import Flight, keyframes
from landscape.hall.hall import Hall
from landscape.hall.settings import Settings
from landscape.scene.scene import Moment, scene
from landscape.settings.declare import with_settings
from landscape.walk.place import Place

SPAN = Settings().flight.kt_per_key
KEYS = len(keyframes())


def flight(**changes: object) -> Flight:
    settings = with_settings(Settings(), {f"flight.{name}": v for name, v in changes.items()})
    return Flight(settings, Assets())


def turns(camera: Flight) -> np.ndarray:
    """Return by how many degrees it turns on the way from each key to the next."""
    found = []
    for key in range(KEYS):
        ways = [camera.camera((key + t) * SPAN)[1] for t in np.linspace(0, 1 - 1e-9, 200)]
        steps = [2 * np.arccos(min(abs(p @ q), 1.0)) for p, q in zip(ways, ways[1:], strict=False)]
        found.append(np.degrees(sum(steps)))
    return np.array(found)


def test_it_passes_its_keys_and_comes_back_to_the_first() -> None:
    camera = flight()
    for number, key in enumerate(keyframes()):
        place, turn = camera.camera(number * SPAN)
        assert place == pytest.approx(key.place) and abs(turn @ key.turn) == pytest.approx(1.0)
    assert camera.pose(KEYS * SPAN) == camera.pose(0.0)
    assert camera.pose(-SPAN) == camera.pose((KEYS - 1) * SPAN)


def test_euler_angles_whirl_where_the_camera_passes_over_the_statue() -> None:
    """Gimbal lock: from nose down to beyond, a turn of 50 degrees becomes a full one."""
    by_slerp, by_euler = (turns(flight(interpolation=each)) for each in ("slerp", "euler"))
    worst = int((by_euler - by_slerp).argmax())
    assert by_slerp.max() < 130
    assert by_euler[worst] > 300 and by_slerp[worst] < 60
    assert (np.delete(by_euler - by_slerp, worst) < 10).all()


def test_without_the_short_arc_slerp_turns_the_long_way() -> None:
    short, any_ = (turns(flight(interpolation="slerp", short=each)) for each in (True, False))
    assert (any_ > short + 90).any() and (any_ > short - 1e-3).all()


def jerks(interpolation: str) -> np.ndarray:
    """Return by how many degrees a key the angular velocity changes at each key at once."""
    camera, tiny = flight(interpolation=interpolation), 1e-4

    def velocity(key: float) -> np.ndarray:
        p, q = (camera.camera((key + each) * SPAN)[1] for each in (-tiny, tiny))
        turn = product(q if p @ q > 0 else -q, p * (1, -1, -1, -1))
        return np.degrees(turn[1:] / tiny)

    changes = [velocity(key + 4 * tiny) - velocity(key - 4 * tiny) for key in range(KEYS)]
    return np.linalg.norm(changes, axis=1)


def test_angular_velocity_is_continuous_at_the_keys_by_squad_and_not_by_slerp() -> None:
    assert jerks("squad").max() < 1.0
    assert jerks("slerp").min() > 4.0 and jerks("slerp").max() > 100.0


@pytest.mark.seldom(3, first=1)
def test_squad_turns_hardly_farther_than_slerp() -> None:
    squad, slerp = turns(flight()), turns(flight(interpolation="slerp"))
    assert (squad > slerp - 1e-6).all() and squad.sum() < 1.2 * slerp.sum()


def test_its_pose_has_its_orientation() -> None:
    camera = flight()
    for kt in np.linspace(0, KEYS * SPAN, 37):
        pose = camera.pose(kt)
        turn = from_angles(pose.yaw, pose.pitch, pose.roll)
        assert abs(turn @ camera.camera(kt)[1]) == pytest.approx(1.0)


def test_a_flight_is_a_motion_of_the_picture_though_the_walker_stands() -> None:
    class Flying:
        """As much of an open hall as the window asks for."""

        shown = frozenset({"flight"})
        settings = with_settings(Settings(), {"flight.enabled": True})
        elements = {Flight: flight()}
        eye = Hall.eye

    hall = Flying()
    place = Place(scene("hall"), hall.settings, None)
    place._scene = hall  # type: ignore[assignment]
    standing = Pose(1.0, 1.0, 1.0)

    def shows(kt: float) -> tuple[object, ...]:
        return place.shows(Moment(standing, (8, 8), kt))

    assert shows(0.0) != shows(0.1 * SPAN)
    hall.settings = Settings()
    assert shows(0.0) == shows(0.1 * SPAN)


@pytest.mark.seldom(7, first=5)
def test_the_scene_is_seen_from_the_flight_and_its_path_from_outside(
    stage: Stage, hall_pictures: HallPictures
) -> None:
    only = ("room", "floor", "statue", "flight")
    pictures = {}
    for name, changes in (
        ("walk", {}),
        ("path", {"flight.path": True}),
        ("flight", {"flight.enabled": True}),
        ("later", {"flight.enabled": True}),
        ("pose", {}),
    ):
        kt = 2.2 * SPAN if name in ("later", "pose") else 0.0
        where = flight().pose(kt) if name == "pose" else "hall"
        pictures[name] = hall_pictures(where, kt, only, changes)
    assert (pictures["walk"] != pictures["path"]).any()
    assert (pictures["walk"] != pictures["flight"]).mean() > 0.3
    assert (pictures["later"] != pictures["flight"]).mean() > 0.3
    np.testing.assert_array_equal(pictures["later"], pictures["pose"])
