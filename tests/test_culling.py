"""What is skipped to save time, back faces, far detail, a hidden sea: no picture shows it."""

import itertools
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from stage import Stage, live_names, quad, small, write_ply
from test_rabbit_dragon import CUBE, CUBE_FACES, LIT

from landscape.elements.animal import CUBES, SPARED, levels_of_detail
from landscape.elements.dragon import Dragon
from landscape.elements.sea.sea_watch import ABOVE, SeaWatch, compiling
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.mesh import Mesh, clustered, is_closed, vertex_normals
from landscape.gl.calls import recording
from landscape.gl.display_list import DisplayList
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
def test_a_picture_does_not_depend_on_whether_the_sea_was_seen_before(both) -> None:
    some, _ = both
    pictures = []
    for before in ("fig35c", "fig35h"):
        some.look(before)
        for _ in range(3):
            some.draw()
        some.look("fig35h")
        pictures.append(some.draw())
    assert np.array_equal(*pictures)


@pytest.mark.slow
def test_where_land_hides_the_sea_no_mirror_image_is_drawn(both) -> None:
    counts = []
    for offscreen in both:
        offscreen.look("fig35c")
        for _ in range(2):
            offscreen.draw()
        with recording() as recorder:
            offscreen.draw()
        counts.append(sum(call.name == "glBindFramebuffer" for call in recorder.calls))
    assert counts[0] < counts[1]


SEA = (-10.0, 50.0)


def watched(stage: Stage, watch: SeaWatch, wall: bool, eye_y: float = 2.0) -> tuple[bool, bool]:
    """Return what is expected, and what is found, from an eye over the sea, or before a wall."""
    settings = small({"water.level": 0.6})
    with stage.frame(settings, Pose(20.0, eye_y, 20.0, 0.0, -20.0)) as frame:
        expected = watch.expected(frame)
        if wall:
            x, y, z = (0.0, 40.0), (-40.0, 40.0), 19.0
            quad(np.array([(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]))
        before = stage.read()
        watch.ask(frame)
        found = watch.shows()
        assert np.array_equal(stage.read(), before)  # asking draws nothing
    return expected, found


def test_the_sea_is_seen_unless_a_wall_stands_before_it(stage: Stage) -> None:
    watch = SeaWatch(0.6, SEA)
    assert watched(stage, watch, wall=True) == (True, True)  # the answer is read a frame later
    assert watched(stage, watch, wall=True) == (False, False)
    assert watched(stage, watch, wall=True) == (False, False)
    # It comes into view: found at once, for the mirror image can still be drawn.
    assert watched(stage, watch, wall=False) == (False, True)
    assert watched(stage, watch, wall=False) == (True, True)
    watch.release()


def test_after_a_leap_to_another_place_nothing_is_expected(stage: Stage) -> None:
    watch = SeaWatch(0.6, SEA)
    for _ in range(2):
        assert watched(stage, watch, wall=False) == (True, True)
    assert watched(stage, watch, wall=True, eye_y=5.0) == (False, False)
    assert watched(stage, watch, wall=False, eye_y=2.0) == (False, True)
    watch.release()


def test_an_eye_among_the_waves_always_sees_them(stage: Stage) -> None:
    watch = SeaWatch(0.6, SEA)
    for _ in range(2):
        assert watched(stage, watch, wall=True, eye_y=0.6 + ABOVE / 2) == (True, True)
    watch.release()


def test_while_a_list_is_compiled_the_last_answer_stands(stage: Stage) -> None:
    watch, answers = SeaWatch(0.6, SEA), []
    for _ in range(2):
        watched(stage, watch, wall=True)
    assert not compiling()
    with stage.frame(small(), Pose(20.0, 2.0, 20.0)) as frame:

        def send() -> None:
            assert compiling()
            watch.ask(frame)
            answers.extend([watch.expected(frame), watch.shows()])

        DisplayList(send).release()
    assert answers == [False, False]
    watch.release()


def sphere(rings: int = 40) -> Mesh:
    """A closed ball of radius 1."""
    import trimesh

    ball = trimesh.creation.uv_sphere(count=(rings, rings))
    vertices = np.ascontiguousarray(ball.vertices, np.float32)
    triangles = np.ascontiguousarray(ball.faces, np.uint32)
    colors = np.full((len(vertices), 4), (10, 200, 30, 255), np.uint8)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (), colors)


@pytest.mark.parametrize("cube", [0.05, 0.2])
def test_a_coarser_mesh_leaves_out_no_more_than_its_cubes(cube: float) -> None:
    fine = sphere()
    coarse = clustered(fine, cube)
    assert len(coarse.vertices) < len(fine.vertices)
    assert coarse.triangles.max() < len(coarse.vertices)
    assert (np.abs(np.linalg.norm(coarse.vertices, axis=1) - 1) < cube).all()
    assert np.allclose(np.linalg.norm(coarse.normals, axis=1), 1.0, atol=1e-5)
    assert coarse.colors is not None and (coarse.colors == (10, 200, 30, 255)).all()
    a, b, c = coarse.triangles.T
    assert (a != b).all() and (b != c).all() and (c != a).all()
    # Every vertex of the fine mesh lies near one of the coarse.
    apart = np.linalg.norm(fine.vertices[:, None] - coarse.vertices[None], axis=2).min(axis=1)
    assert apart.max() <= cube * np.sqrt(3)


def test_a_mesh_is_closed_if_each_edge_has_its_other_half() -> None:
    faces = sphere(12).triangles
    assert is_closed(faces)
    assert not is_closed(faces[1:])
    turned = faces.copy()
    turned[0] = turned[0, ::-1]
    assert not is_closed(turned)
    assert not is_closed(np.concatenate([faces, faces[:1]]))


def rough_ball() -> tuple[np.ndarray, np.ndarray]:
    """Return vertices and triangles of a ball fine enough for several levels of detail."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    return np.asarray(ball.vertices), np.asarray(ball.faces)


def test_the_farther_an_animal_the_coarser_its_mesh(stage: Stage, plain_folder) -> None:
    write_ply(plain_folder / "dragon.ply", *rough_ball())
    assets = Assets(plain_folder)
    levels = {}
    for detail in (0.0, 1.0):
        settings = small({**LIT, "camera.lod_pixels": detail})
        dragon = Dragon(settings, assets)
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


def test_each_level_of_detail_spares_enough_to_be_kept() -> None:
    vertices, faces = rough_ball()
    mesh = Mesh(vertices.astype(np.float32), vertices.astype(np.float32), faces.astype(np.uint32))
    levels = levels_of_detail(mesh, lambda level: level, CUBES)
    sizes = [len(level.triangles) for level in levels.values()]
    assert next(iter(levels)) == 0.0 and sizes[0] == len(faces)
    assert 1 < len(sizes) < len(CUBES)
    assert all(after <= SPARED * before for before, after in itertools.pairwise(sizes))


def test_the_lists_of_all_levels_are_made_at_once_and_released(stage: Stage, plain_folder) -> None:
    write_ply(plain_folder / "dragon.ply", *rough_ball())
    settings = small({**LIT, "camera.lod_pixels": 0.2, "camera.cull": True})
    before = live_names()[1]
    dragon, used = Dragon(settings, Assets(plain_folder)), set()
    made = live_names()[1]
    for away in np.geomspace(1.2, 200.0, 40):
        with stage.frame(settings, Pose(20.0, 0.6, 20.0 + away)) as frame:
            dragon.draw(frame)
            used.add(dragon.level(frame))
    assert len(used) > 2
    assert live_names()[1] == made > before
    dragon.release()
    assert live_names()[1] == before


def test_levels_of_detail_from_the_cache_are_those_just_made(
    stage: Stage, plain_folder, tmp_path, monkeypatch
) -> None:
    write_ply(plain_folder / "dragon.ply", *rough_ball())
    monkeypatch.setenv("LANDSCAPE_CACHE", str(tmp_path / "cache"))
    settings = small({**LIT, "camera.lod_pixels": 1.0})
    pictures, made = [], []
    monkeypatch.setattr(
        "landscape.elements.animal.clustered", lambda *a: made.append(a) or clustered(*a)
    )
    for _ in range(2):
        dragon = Dragon(settings, Assets(plain_folder))
        with stage.frame(settings, Pose(20.0, 0.6, 26.0)) as frame:
            dragon.draw(frame)
        pictures.append(stage.read())
        made.append("end")
        dragon.release()
    assert np.array_equal(*pictures) and pictures[0].std() > 1
    assert made[-2:] == ["end", "end"] and len(made) > 2


def test_in_the_mirror_image_an_animal_may_be_coarser(stage: Stage, plain_folder) -> None:
    write_ply(plain_folder / "dragon.ply", *rough_ball())
    levels = []
    for coarse in (1.0, 8.0):
        settings = small(
            {**LIT, "camera.lod_pixels": 0.05, "reflection.lod_scale": coarse, "dragon.z": 20.0}
        )
        dragon = Dragon(settings, Assets(plain_folder))
        with stage.frame(settings, Pose(20.0, 0.6, 30.0)) as frame:
            levels += [dragon.level(frame), dragon.level(replace(frame, mirrored=True))]
        dragon.release()
    assert levels[0] == levels[1] == levels[2] < levels[3]


@pytest.mark.parametrize("closed", [True, False])
def test_only_a_closed_animal_is_drawn_without_its_back(
    stage: Stage, plain_folder, closed: bool
) -> None:
    """A box whose lid is missing shows its inside, with or without camera.cull."""
    faces = CUBE_FACES if closed else CUBE_FACES[[0, 1, 2, 4, 5]]  # without the face at y = 1
    write_ply(plain_folder / "dragon.ply", CUBE, faces)
    settings = small({**LIT, "camera.cull": True})
    dragon = Dragon(settings, Assets(plain_folder))
    with stage.frame(settings, Pose(20.0, 2.5, 20.0, 0.0, -89.0)) as frame, recording() as recorder:
        dragon.draw(frame)
        picture = stage.read()
    dragon.release()
    assert (
        any(call.name == "glEnable" and "CULL_FACE" in str(call) for call in recorder.calls)
        == closed
    )
    assert (np.abs(picture[60, 80] - np.array([102, 153, 178])) > 3).any()
