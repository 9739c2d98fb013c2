"""Levels of detail of the animals: which is drawn, what each saves, that all are released."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from animals import CUBE, CUBE_FACES, LIT, ball, made
from stage import Stage, live_names, small, write_ply

from framelens.gl.seam import recording
from landscape.elements.best.animals.fine_animal import FineAnimal
from landscape.elements.best.animals.levels_of_detail import AT_MOST, CUBES, levels_of_detail
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.clustering import clustered
from landscape.geometry.mesh import Mesh


@pytest.mark.seldom(10, first=3)
def test_the_farther_an_animal_the_coarser_its_mesh(stage: Stage, plain_folder) -> None:
    write_ply(plain_folder / "dragon.ply", *ball())
    assets = Assets(plain_folder)
    levels = {}
    for detail in (0.0, 1.0):
        settings = small({**LIT, "camera.lod_pixels": detail, "dragon.painted": True})
        dragon = made("dragon", settings, assets)
        assert isinstance(dragon, FineAnimal)
        for away in (2.0, 10.0, 40.0, 400.0):
            with stage.frame(settings, Pose(20.0, 0.6, 20.0 + away)) as frame:
                levels[detail, away] = dragon.level(frame)
                dragon.draw(frame)
        dragon.release()
    assert all(levels[0.0, away] == 0.0 for away in (2.0, 400.0))
    chosen = [levels[1.0, away] for away in (2.0, 10.0, 40.0, 400.0)]
    assert chosen == sorted(chosen) and chosen[0] < chosen[2] and chosen[3] == CUBES[-1]
    # 120 pixels over 60 degrees: 104 pixels a unit at one unit off; the mesh is half as large.
    assert levels[1.0, 10.0] * 0.5 * 104 / 9.0 <= 1.0


@pytest.mark.seldom(3)
def test_each_level_of_detail_saves_enough_to_be_kept() -> None:
    vertices, faces = ball()
    mesh = Mesh(vertices.astype(np.float32), vertices.astype(np.float32), faces.astype(np.uint32))
    levels = levels_of_detail(mesh, lambda level: level, CUBES)
    sizes = [len(level.triangles) for level in levels.values()]
    assert next(iter(levels)) == 0.0 and sizes[0] == len(faces)
    assert 1 < len(sizes) < len(CUBES)
    assert all(after <= AT_MOST * before for before, after in itertools.pairwise(sizes))


@pytest.mark.seldom(3)
def test_the_lists_of_all_levels_are_made_at_once_and_released(stage: Stage, plain_folder) -> None:
    write_ply(plain_folder / "dragon.ply", *ball())
    settings = small({**LIT, "camera.lod_pixels": 0.2, "camera.cull": True})
    before = live_names()[1]
    dragon, used = made("dragon", settings, Assets(plain_folder)), set()
    compiled = live_names()[1]
    for away in np.geomspace(1.2, 200.0, 40):
        with stage.frame(settings, Pose(20.0, 0.6, 20.0 + away)) as frame:
            dragon.draw(frame)
            used.add(dragon.level(frame))
    assert len(used) > 2
    assert live_names()[1] == compiled > before
    dragon.release()
    assert live_names()[1] == before


def test_levels_of_detail_from_the_cache_equal_those_just_made(
    stage: Stage, plain_folder, tmp_path, monkeypatch
) -> None:
    write_ply(plain_folder / "dragon.ply", *ball())
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))
    settings = small({**LIT, "camera.lod_pixels": 1.0})
    pictures, built = [], []
    monkeypatch.setattr(
        "landscape.elements.best.animals.levels_of_detail.clustered",
        lambda *a: built.append(a) or clustered(*a),
    )
    for _ in range(2):
        dragon = made("dragon", settings, Assets(plain_folder))
        with stage.frame(settings, Pose(20.0, 0.6, 26.0)) as frame:
            dragon.draw(frame)
        pictures.append(stage.read())
        built.append("end")
        dragon.release()

    assert np.array_equal(*pictures) and pictures[0].std() > 1
    assert built[-2:] == ["end", "end"] and len(built) > 2


def test_in_the_mirror_image_an_animal_may_be_coarser(stage: Stage, plain_folder) -> None:
    write_ply(plain_folder / "dragon.ply", *ball())
    levels = []
    for coarse in (1.0, 8.0):
        settings = small(
            {**LIT, "camera.lod_pixels": 0.05, "reflection.lod_scale": coarse, "dragon.z": 20.0}
        )
        dragon = made("dragon", settings, Assets(plain_folder))
        with stage.frame(settings, Pose(20.0, 0.6, 30.0)) as frame:
            levels += [dragon.level(frame), dragon.level(replace(frame, mirrored=True))]
        dragon.release()
    assert levels[0] == levels[1] == levels[2] < levels[3]


@pytest.mark.parametrize("closed", [True, False])
def test_back_faces_are_culled_only_on_closed_animals(
    stage: Stage, plain_folder, closed: bool
) -> None:
    """A box whose lid is missing shows its inside, with or without camera.cull."""
    faces = CUBE_FACES if closed else CUBE_FACES[[0, 1, 2, 4, 5]]  # without the face at y = 1
    write_ply(plain_folder / "dragon.ply", CUBE, faces)
    settings = small({**LIT, "camera.cull": True})
    dragon = made("dragon", settings, Assets(plain_folder))
    with stage.frame(settings, Pose(20.0, 2.5, 20.0, 0.0, -89.0)) as frame, recording() as recorder:
        dragon.draw(frame)
        picture = stage.read()
    dragon.release()
    assert (
        any(call.name == "glEnable" and "CULL_FACE" in str(call) for call in recorder.calls)
        == closed
    )
    assert (np.abs(picture[60, 80] - np.array([102, 153, 178])) > 3).any()
