"""Rabbit and dragon: the report's mappings, where they stand, and how they are lit."""

import math

import numpy as np
import pytest
from animals import CUBE, CUBE_FACES, FLAT, LIT, PLATE, made
from stage import PLAIN, Stage, close, kind_in, pixel, project, small, taken, write_ply

from framelens.gl.seam import recording
from landscape.elements.animal import COLOR, read_animal
from landscape.elements.best.animals.axis_mapping import by_axis
from landscape.elements.best.animals.fine_animal import read_painted
from landscape.elements.best.animals.fine_dragon import FineDragon
from landscape.elements.best.animals.fine_rabbit import FineRabbit
from landscape.elements.best.animals.fur import (
    COMBED,
    EARS,
    Fur,
    combed_planes,
    eyes,
    glints,
    hair_lengths,
    hair_texture,
    kept_apart,
    laid,
    shells,
)
from landscape.elements.dragon import Dragon, planar
from landscape.elements.rabbit import Rabbit, cylindrical
from landscape.elements.settings import Settings
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.obstacles import Tower, Wall
from landscape.island.slots import DRAGON, RABBIT
from landscape.settings.declare import with_settings

BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
ANIMAL = np.array(PLAIN["animal.png"])


def test_the_cylindrical_mapping_at_points_computed_by_hand() -> None:
    points = np.array([(1, -1, 0), (0, 0, 1), (0, 1, -1), (-1, 0.5, 0), (1, 0, 1)], float)
    s = [0.0, 8 * 0.25, 8 * 0.25, 8 * 0.5, 8 * 0.125]
    t = [0.0, 4 * 0.5, 4 * 1.0, 4 * 0.75, 4 * 0.5]
    assert np.allclose(cylindrical(points, 8.0, 4.0), np.stack([s, t], axis=1))


def test_the_absolute_value_hides_the_seam() -> None:
    just_before, just_behind = (np.array([(-1.0, 0.0, z)]) for z in (1e-6, -1e-6))
    assert np.allclose(cylindrical(just_before, 8, 4), cylindrical(just_behind, 8, 4), atol=1e-4)


def test_the_dragon_is_mapped_by_x_and_z() -> None:
    points = np.array([(0.1, 9.0, -0.3), (2.0, 0.0, 5.0)])
    assert np.allclose(planar(points), [(0.1, -0.3), (2.0, 5.0)])


@pytest.mark.parametrize("name", ["rabbit.ply", "dragon.ply"])
def test_the_shipped_meshes_fill_minus_1_to_1_with_unit_normals(shipped: Assets, name: str) -> None:
    mesh = read_animal(shipped, name, "key")
    vertices = mesh.vertices
    normals = mesh.normals
    triangles = mesh.triangles
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    assert np.allclose(low + high, 0.0, atol=1e-5)
    assert (high - low).max() == pytest.approx(2.0, abs=1e-5)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-4)
    assert triangles.max() < len(vertices)
    assert len(triangles) > 5000


@pytest.mark.parametrize("name", ["rabbit.ply", "dragon.ply"])
def test_the_shipped_meshes_are_counter_clockwise_seen_from_outside(
    shipped: Assets, name: str
) -> None:
    mesh = read_animal(shipped, name, "key")
    vertices, triangles = mesh.vertices, mesh.triangles
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    volume = (a * np.cross(b, c)).sum() / 6
    assert volume > 0


@pytest.fixture
def cube(plain_folder) -> Assets:
    """Plain assets in which both animals are a cube."""
    for name in ("rabbit.ply", "dragon.ply"):
        write_ply(plain_folder / name, CUBE * 3 + (5, 6, 7), CUBE_FACES)
    return Assets(plain_folder)


def rows_of(picture: np.ndarray, column: int = 80) -> np.ndarray:
    """Return first and last row of what is drawn in a column."""
    drawn = (np.abs(picture[:, column] - BACKGROUND) > 3).any(axis=1)
    return np.flatnonzero(drawn)[[0, -1]]


def test_the_rabbit_stands_on_the_ground_at_its_size(stage: Stage, cube: Assets) -> None:
    settings = small(LIT)
    rabbit = Rabbit(settings, cube, FLAT)
    pose = Pose(20.0, 2.5, 23.5, 0.0, 0.0)
    with stage.frame(settings, pose) as frame:
        rabbit.draw(frame)
        picture = stage.read()
    rabbit.release()
    sunk = 2.0 - 0.02 * 0.5  # a fiftieth of its size, so that no light shows under it
    bottom, top = project(pose, (20.0, sunk, 20.5)), project(pose, (20.0, sunk + 1.0, 20.5))
    assert rows_of(picture) == pytest.approx([top[1], bottom[1] - 1], abs=1)


def test_the_dragon_sinks_to_its_water_line(stage: Stage, cube: Assets) -> None:
    settings = small(LIT)
    dragon = Dragon(settings, cube)
    pose = Pose(20.0, 0.6, 23.5, 0.0, 0.0)
    with stage.frame(settings, pose) as frame:
        dragon.draw(frame)
        picture = stage.read()
    dragon.release()
    # sink 0.2: the mesh's height 0.2 of -1..1, times the scale 0.5, is at the water.
    top, bottom = (project(pose, (20.0, 0.6 + (y - 0.2) * 0.5, 20.5)) for y in (1, -1))
    assert rows_of(picture) == pytest.approx([top[1], bottom[1] - 1], abs=1)


@pytest.mark.parametrize("animal", ["rabbit", "dragon"])
@pytest.mark.parametrize("scale", [0.2, 0.5, 1.0])
def test_an_animals_light_is_ambient_plus_diffuse_whatever_its_size(
    stage: Stage, plain_folder, animal: str, scale: float
) -> None:
    write_ply(plain_folder / f"{animal}.ply", PLATE, np.array([(0, 1, 2, 3)]))
    assets = Assets(plain_folder)
    settings = small({**LIT, f"{animal}.scale": scale})
    thing = made(animal, settings, assets)
    y = 2.0 + scale if animal == "rabbit" else 0.6
    pose = Pose(20.0, y, 20.0 + 5 * scale, 0.0, 0.0)
    with stage.frame(settings, pose) as frame:
        thing.draw(frame)
        got = pixel(stage.read(), (80.5, 60.5))
    thing.release()
    # The plate leans back by 60 degrees from the sun, which stands low in the south.
    light = np.array([0.3, 0.2, 0.1]) + np.array([0.5, 0.6, 0.7]) * 0.5
    assert close(got, np.array(COLOR[:3]) * light * ANIMAL, 2)


def test_the_rabbit_turns_with_its_yaw(stage: Stage, plain_folder) -> None:
    # A plank along x, seen from the south: long at yaw 0, short at 90.
    write_ply(plain_folder / "rabbit.ply", CUBE * (3.0, 1.0, 0.3), CUBE_FACES)
    widths = []
    for yaw in (0.0, 90.0):
        settings = small({**LIT, "rabbit.yaw": yaw})
        rabbit = Rabbit(settings, Assets(plain_folder), FLAT)
        with stage.frame(settings, Pose(20.0, 2.2, 23.5)) as frame:
            rabbit.draw(frame)
            picture = stage.read()
        rabbit.release()
        widths.append((np.abs(picture - BACKGROUND) > 3).any(axis=2).any(axis=0).sum())
    assert widths[0] > 5 * widths[1] > 0


def paint_ply(path, colours: list[tuple[int, int, int]]) -> None:
    """Add colours to the vertices of an ASCII PLY file."""
    head, body = path.read_text().split("end_header\n")
    wanted = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    head = head.replace("element face", wanted + "element face")
    lines = body.splitlines()
    for k, colour in enumerate(colours):
        lines[k] += " " + " ".join(map(str, colour))
    path.write_text(head + "end_header\n" + "\n".join(lines) + "\n")


@pytest.mark.parametrize("animal", ["rabbit", "dragon"])
@pytest.mark.parametrize("painted", [False, True])
@pytest.mark.parametrize("mapping", ["2006", "axis"])
def test_a_painted_animal_has_the_colours_of_its_file(
    stage: Stage, plain_folder, animal: str, painted: bool, mapping: str
) -> None:
    path = write_ply(plain_folder / f"{animal}.ply", PLATE, np.array([(0, 1, 2, 3)]))
    paint_ply(path, [(250, 120, 40)] * 4)
    mapping = {"rabbit": "cylindrical", "dragon": "planar"}[animal] if mapping == "2006" else "axis"
    changed = {f"{animal}.painted": painted, f"{animal}.mapping": mapping}
    settings = small({**LIT, **changed})
    assets = Assets(plain_folder)
    thing = made(animal, settings, assets)
    pose = Pose(20.0, 2.5 if animal == "rabbit" else 0.6, 22.5, 0.0, 0.0)
    with stage.frame(settings, pose) as frame:
        thing.draw(frame)
        got = pixel(stage.read(), (80.5, 60.5))
    thing.release()
    light = np.array([0.3, 0.2, 0.1]) + np.array([0.5, 0.6, 0.7]) * 0.5
    colour = np.array([250, 120, 40]) / 255 if painted else np.array(COLOR[:3])
    assert close(got, colour * light * ANIMAL, 2)


def test_a_glossy_dragon_glints_over_its_texture_and_a_dull_one_does_not(
    stage: Stage, plain_folder
) -> None:
    # The plate's normal halves the angle between a sun at 60 degrees over the south and the eye.
    tilt = np.radians(30)
    plate = np.array(
        [(x, y * np.cos(tilt), -y * np.sin(tilt)) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    )
    write_ply(plain_folder / "dragon.ply", plate, np.array([(0, 1, 2, 3)]))
    got = []
    for gloss in (0.0, 0.25):
        settings = small({**LIT, "sun.elevation": 60.0, "dragon.gloss": gloss})
        dragon = made("dragon", settings, Assets(plain_folder))
        with stage.frame(settings, Pose(20.0, 0.5, 40.0, 0.0, 0.0)) as frame:
            dragon.draw(frame)
            got.append(pixel(stage.read(), (80.5, 60.5)))
        dragon.release()

    # A quarter of the light's specular colour is added; the texture does not multiply it.
    glint = (got[1] - got[0]) / 255
    assert np.allclose(glint, 0.25 * np.array([1.0, 0.95, 0.85]), atol=0.03)


def test_every_face_is_mapped_along_the_axis_it_faces(shipped: Assets) -> None:
    read = read_animal(shipped, "rabbit.ply", "key")
    vertices, triangles = read.vertices, read.triangles
    mesh = by_axis(read, 4.0)
    assert len(mesh.triangles) == len(triangles)
    assert np.allclose(mesh.vertices[mesh.triangles], vertices[triangles])

    def stretch(coordinates: np.ndarray, corners: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Return texture area over area for each face; 4 if it is mapped along its normal."""
        s, p = coordinates[corners], points[corners].astype(np.float64)
        a, b = s[:, 1] - s[:, 0], s[:, 2] - s[:, 0]
        size = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
        return np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / np.maximum(size, 1e-12)

    charts = stretch(mesh.coordinates[0], mesh.triangles, mesh.vertices)
    # No face is stretched; a few on edges, where the smooth normals differ, are compressed.
    assert charts.max() < 4.0 + 1e-3
    assert np.quantile(charts, 0.02) > 4.0 / math.sqrt(3) * 0.8


def test_the_setting_chooses_the_rabbits_mapping(stage: Stage, shipped: Assets) -> None:
    pictures = {}
    for mapping in ("cylindrical", "axis"):
        settings = small({"rabbit.mapping": mapping, "rabbit.x": 20.0, "rabbit.z": 20.0})
        rabbit = made("rabbit", settings, shipped)
        with stage.frame(settings, Pose(20.0, 2.5, 20.2, 0.0, -60.0)) as frame:
            rabbit.draw(frame)
            pictures[mapping] = stage.read()
        rabbit.release()
    changed = (np.abs(pictures["axis"] - pictures["cylindrical"]) > 4).any(axis=2)
    assert changed.sum() > 500


@pytest.mark.parametrize("animal", ["rabbit", "dragon"])
def test_an_animal_accepts_settings_read_each_frame_and_refuses_the_rest(
    stage: Stage, cube: Assets, animal: str
) -> None:
    for changes in ({}, {f"{animal}.mapping": "axis", "camera.lod_pixels": 0.5}):
        settings = small({**LIT, **changes})
        thing = made(animal, settings, cube)
        assert taken(thing, with_settings(settings, {"camera.cull": True, "fog.density": 0.5}))
        with stage.frame(settings, Pose(20.0, 2.5, 23.5)) as frame, recording() as recorder:
            thing.draw(frame)
        assert any("CULL_FACE" in str(call.shown) for call in recorder.calls)
        for key, value in ((f"{animal}.x", 3.0), (f"{animal}.painted", True)):
            assert not taken(thing, with_settings(settings, {key: value}))
        other = 0.0 if changes else 0.5
        assert not taken(thing, with_settings(settings, {"camera.lod_pixels": other}))
        thing.release()


def test_a_glossy_dragon_may_become_glossier_but_not_dull(stage: Stage, cube: Assets) -> None:
    settings = small({**LIT, "dragon.gloss": 0.25})
    dragon = made("dragon", settings, cube)
    assert taken(dragon, with_settings(settings, {"dragon.gloss": 0.5}))
    with stage.frame(settings, Pose(20.0, 2.5, 23.5)) as frame, recording() as recorder:
        dragon.draw(frame)
    shown = [call.args[2] for call in recorder.calls if call.name == "glMaterialfv"]
    assert np.allclose(shown[0][:3], 0.5)
    assert not taken(dragon, with_settings(settings, {"dragon.gloss": 0.0}))
    dragon.release()


def test_animals_are_obstacles_of_their_size(stage: Stage, cube: Assets) -> None:
    settings = small({**LIT, "dragon.yaw": 90.0, "rabbit.scale": 0.25})
    rabbit, dragon = (made(name, settings, cube) for name in ("rabbit", "dragon"))
    assert rabbit.obstacles() == (Tower(20.0, 20.0, 0.6 * 0.25, 2.0 + 0.5),)
    assert dragon.obstacles() == (
        Wall(20.0, 20.0, 0.85 * 0.5, 0.16 * 0.5, math.radians(90.0), 0.6 + 0.5),
    )
    rabbit.release()
    dragon.release()


def test_what_is_out_of_view_is_not_drawn(stage: Stage, cube: Assets) -> None:
    settings = small({**LIT, "camera.cull": True, "camera.lod_pixels": 0.5})
    for animal in ("rabbit", "dragon"):
        thing = made(animal, settings, cube)
        counts = []
        for yaw in (0.0, 180.0):
            with stage.frame(settings, Pose(20.0, 1.5, 23.5, yaw)) as frame:
                with recording() as recorder:
                    thing.draw(frame)
            counts.append(len(recorder.calls))
        thing.release()
        assert counts[0] > 5 and counts[1] == 0


def test_the_settings_choose_the_class_of_an_animal() -> None:
    assert kind_in(RABBIT, Settings()) is Rabbit and kind_in(DRAGON, Settings()) is Dragon
    for key, value in (("mapping", "axis"), ("painted", True)):
        assert kind_in(RABBIT, small({f"rabbit.{key}": value})) is FineRabbit
        assert kind_in(DRAGON, small({f"dragon.{key}": value})) is FineDragon
    assert kind_in(RABBIT, small({"camera.lod_pixels": 0.1})) is FineRabbit
    assert kind_in(DRAGON, small({"dragon.gloss": 0.1})) is FineDragon


# Fur


def test_shells_of_fur_lie_outside_each_other_and_leave_eyes_and_feet_short(
    shipped: Assets,
) -> None:
    mesh = read_painted(shipped, "rabbit.ply", "key", True)
    skin, at = laid(mesh), eyes(mesh)
    every = shells(skin, at, 5)
    away = [np.linalg.norm(shell.vertices - skin.vertices, axis=1) for shell in every]
    assert (np.diff(away, axis=0) >= -1e-6).all() and away[-1].max() > 0.03
    lengths = hair_lengths(skin, at)
    assert len(at) == 2
    for middle, _ in at:
        assert lengths[np.linalg.norm(skin.vertices - middle, axis=1) < 0.05].max() < 0.05
    assert lengths[skin.vertices[:, 1] < -0.85].mean() < 0.5 < np.median(lengths)


def test_ears_and_face_have_shorter_hair_than_the_back(shipped: Assets) -> None:
    mesh = read_painted(shipped, "rabbit.ply", "key", False)
    lengths = hair_lengths(mesh, [])
    x, y, _ = mesh.vertices.T
    back = lengths[(x < 0.0) & (y > -0.5) & (y < 0.2)].min()
    assert lengths[y > EARS].max() < 0.5 * back
    assert lengths[(x > 0.7) & (y > 0.0)].max() < 0.5 * back


@pytest.mark.seldom(3, first=2)
def test_hairs_lie_along_s_which_is_the_direction_they_are_combed_in() -> None:
    height = hair_texture()[..., 3].astype(float)
    # Along a hair neighbouring texels differ less than across it, over the edges of the tile, too.
    along = np.abs(height - np.roll(height, 1, axis=1))
    across = np.abs(height - np.roll(height, 1, axis=0))
    assert along.mean() < 0.6 * across.mean()
    assert along[:, 0].mean() < 1.5 * along.mean() and across[0].mean() < 1.5 * across.mean()
    for axis, (s, t) in enumerate(combed_planes(COMBED)):
        assert np.allclose([s @ s, t @ t, s @ t, s[axis], t[axis]], [1, 1, 0, 0, 0], atol=1e-6)
        assert s @ COMBED > 0.7


@pytest.mark.seldom(3)
def test_in_each_mip_level_hairs_differ_in_height_as_in_the_first() -> None:
    levels = kept_apart(hair_texture())
    first = levels[0][..., 3].std()
    for level in levels[1:6]:
        assert abs(level[..., 3].std() / first - 1.0) < 0.15


def test_each_eye_of_a_painted_rabbit_has_a_glint_and_an_unpainted_one_has_none(
    shipped: Assets,
) -> None:
    mesh = read_painted(shipped, "rabbit.ply", "key", True)
    discs = glints(mesh)
    assert len(discs) == 2 and discs[0, :, 2].mean() > 0 > discs[1, :, 2].mean()
    assert len(glints(read_painted(shipped, "rabbit.ply", "key", False))) == 0


def test_fur_makes_the_outline_ragged_near_by_and_is_not_drawn_far_away(
    stage: Stage, shipped: Assets
) -> None:
    def differing(z: float) -> int:
        pictures = []
        for fur in (0, 6):
            settings = small({**LIT, "rabbit.painted": True, "rabbit.fur": fur})
            rabbit = made("rabbit", settings, shipped)
            with stage.frame(settings, Pose(20.0, 2.5, z, 0.0, 0.0)) as frame:
                rabbit.draw(frame)
                pictures.append(stage.read())
            rabbit.release()
        return int((np.abs(pictures[0] - pictures[1]).max(axis=2) > 12).sum())

    assert differing(21.0) > 100
    assert differing(60.0) == 0


def test_fewer_shells_are_drawn_where_a_hair_is_shorter_than_a_pixel_and_the_outermost_always(
    stage: Stage, shipped: Assets
) -> None:
    with stage.borrowed():
        fur = Fur(read_painted(shipped, "rabbit.ply", "key", True), "rabbit", 0.044, 6)
        drawn = {seen: [number for number, _ in fur.drawn(seen)] for seen in (1.0, 0.5, 0.01)}
        fur.release()
    assert drawn == {1.0: [0, 1, 2, 3, 4, 5], 0.5: [1, 3, 5], 0.01: [2, 5]}
