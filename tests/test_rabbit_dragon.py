"""Rabbit and dragon: the report's mappings, where they stand, and how they are lit."""

import numpy as np
import pytest
from stage import PLAIN, Stage, close, pixel, project, small, write_ply

from landscape.elements.animal import COLOR, read_animal
from landscape.elements.dragon import Dragon, planar
from landscape.elements.rabbit import Rabbit, cylindrical
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.height_field import HeightField

FLAT = HeightField(np.full((4, 4), 2.0, np.float32), 40.0, 0.6)
BACKGROUND = np.array([0.4, 0.6, 0.7]) * 255
ANIMAL = np.array(PLAIN["animal.png"])

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
CUBE_FACES = np.array(
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
)

# A plate that faces south and up: its normal has a height of sin 60 degrees.
PLATE = np.array([(-1, -0.5, 0.866), (1, -0.5, 0.866), (1, 0.5, -0.866), (-1, 0.5, -0.866)])


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
    vertices, normals, triangles = read_animal(shipped, name, "key")
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    assert np.allclose(low + high, 0.0, atol=1e-5)
    assert (high - low).max() == pytest.approx(2.0, abs=1e-5)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-4)
    assert triangles.max() < len(vertices)
    assert len(triangles) > 5000


@pytest.mark.parametrize("name", ["rabbit.ply", "dragon.ply"])
def test_the_shipped_meshes_turn_counter_clockwise_seen_from_outside(
    shipped: Assets, name: str
) -> None:
    vertices, _, triangles = read_animal(shipped, name, "key")
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    volume = (a * np.cross(b, c)).sum() / 6
    assert volume > 0


@pytest.fixture
def cube(plain_folder) -> Assets:
    """Plain assets in which both animals are a cube."""
    for name in ("rabbit.ply", "dragon.ply"):
        write_ply(plain_folder / name, CUBE * 3 + (5, 6, 7), CUBE_FACES)
    return Assets(plain_folder)


LIT = {
    "rabbit.x": 20.0,
    "rabbit.z": 20.0,
    "rabbit.yaw": 0.0,
    "rabbit.scale": 0.5,
    "dragon.x": 20.0,
    "dragon.z": 20.0,
    "dragon.yaw": 0.0,
    "dragon.scale": 0.5,
    "dragon.sink": 0.2,
    "water.level": 0.6,
    "sun.ambient": (0.3, 0.2, 0.1),
    "sun.diffuse": (0.5, 0.6, 0.7),
    "sun.azimuth": 180.0,
    "sun.elevation": 0.0,
}


def rows_of(picture: np.ndarray, column: int = 80) -> np.ndarray:
    """Return first and last row of what is drawn in a column."""
    drawn = (np.abs(picture[:, column] - BACKGROUND) > 3).any(axis=1)
    return np.flatnonzero(drawn)[[0, -1]]


def test_the_rabbit_stands_on_the_ground_at_its_size(stage: Stage, cube: Assets) -> None:
    settings = small(LIT)
    rabbit = Rabbit(settings, cube, FLAT)
    pose = Pose(20.0, 2.5, 23.5, 0.0, 0.0)
    with stage.frame(settings, pose):
        rabbit.draw()
        picture = stage.read()
    rabbit.release()
    sunk = 2.0 - 0.02 * 0.5  # a fiftieth of its size, so that no light shows under it
    bottom, top = project(pose, (20.0, sunk, 20.5)), project(pose, (20.0, sunk + 1.0, 20.5))
    assert rows_of(picture) == pytest.approx([top[1], bottom[1] - 1], abs=1)


def test_the_dragon_sinks_to_its_water_line(stage: Stage, cube: Assets) -> None:
    settings = small(LIT)
    dragon = Dragon(settings, cube)
    pose = Pose(20.0, 0.6, 23.5, 0.0, 0.0)
    with stage.frame(settings, pose):
        dragon.draw()
        picture = stage.read()
    dragon.release()
    # sink 0.2: the mesh's height 0.2 of -1..1, times the scale 0.5, is at the water.
    top, bottom = (project(pose, (20.0, 0.6 + (y - 0.2) * 0.5, 20.5)) for y in (1, -1))
    assert rows_of(picture) == pytest.approx([top[1], bottom[1] - 1], abs=1)


@pytest.mark.parametrize("animal", ["rabbit", "dragon"])
@pytest.mark.parametrize("scale", [0.2, 0.5, 1.0])
def test_its_light_is_ambient_plus_diffuse_whatever_its_size(
    stage: Stage, plain_folder, animal: str, scale: float
) -> None:
    write_ply(plain_folder / f"{animal}.ply", PLATE, np.array([(0, 1, 2, 3)]))
    assets = Assets(plain_folder)
    settings = small({**LIT, f"{animal}.scale": scale})
    thing = Rabbit(settings, assets, FLAT) if animal == "rabbit" else Dragon(settings, assets)
    y = 2.0 + scale if animal == "rabbit" else 0.6
    pose = Pose(20.0, y, 20.0 + 5 * scale, 0.0, 0.0)
    with stage.frame(settings, pose):
        thing.draw()
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
        with stage.frame(settings, Pose(20.0, 2.2, 23.5)):
            rabbit.draw()
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
    thing = Rabbit(settings, assets, FLAT) if animal == "rabbit" else Dragon(settings, assets)
    pose = Pose(20.0, 2.5 if animal == "rabbit" else 0.6, 22.5, 0.0, 0.0)
    with stage.frame(settings, pose):
        thing.draw()
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
        dragon = Dragon(settings, Assets(plain_folder))
        with stage.frame(settings, Pose(20.0, 0.5, 40.0, 0.0, 0.0)):
            dragon.draw()
            got.append(pixel(stage.read(), (80.5, 60.5)))
        dragon.release()
    # A quarter of the light's specular colour is added; the texture does not multiply it.
    glint = (got[1] - got[0]) / 255
    assert np.allclose(glint, 0.25 * np.array([1.0, 0.95, 0.85]), atol=0.03)
