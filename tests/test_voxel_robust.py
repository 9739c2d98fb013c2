"""The voxel island where OpenGL lacks a piece, in odd sizes and places, and the state it leaves."""

import itertools
import threading
from typing import Any

import numpy as np
import pytest
from drivers import KNOWN
from gl_state import changes, snapshot
from stage import Stage

from framelens.base.errors import InputError
from framelens.gl import extensions
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.offscreen import Offscreen
from landscape.scene.scene import Moment
from landscape.settings.declare import with_settings
from landscape.voxel import build, region_buffer
from landscape.voxel.blocks import AIR, block
from landscape.voxel.build import source
from landscape.voxel.mesh import PLANTS, UP, Look, RegionMesh, region_mesh
from landscape.voxel.packed_mesh import packed, unpacked
from landscape.voxel.region_buffer import Light, RegionBuffer
from landscape.voxel.region_buffers import RegionBuffers
from landscape.voxel.voxel import SCENE, Voxel
from landscape.voxel.world import Changes, World

SMALL = {"voxel.regions": 4, "voxel.region_size": 30, "shadow.size": 256}
SEEN = ("land", "sky", "water")
POSE = Pose(2.0, 1.5, 6.5, 35.0, -10.0)  # sea, land and sky


def hide(monkeypatch: pytest.MonkeyPatch, *hidden: str, units: int = 8) -> None:
    """Let OpenGL seem to be 1.1 with all extensions but those hidden, and with fewer units."""
    monkeypatch.setattr(extensions, "version", lambda: (1, 1))
    monkeypatch.setattr(extensions, "extensions", lambda: KNOWN - set(hidden))
    if "GL_ARB_multitexture" not in hidden:
        monkeypatch.setattr(extensions, "texture_units", lambda: units)
    monkeypatch.setattr(extensions, "_told", set())


def picture(stage: Stage, pose: Pose = POSE, **given: Any) -> np.ndarray:
    """Return the picture of a small island, int64 (h, w, 3)."""
    changed = SMALL | {key.replace("__", "."): value for key, value in given.items()}
    settings = with_settings(SCENE.settings, changed)
    scene = Voxel(settings, Assets(), 0, SEEN)
    try:
        with stage.borrowed():
            scene.draw(Moment(pose, stage.size, 20.0))
        return stage.read()
    finally:
        scene.release()


@pytest.mark.parametrize("kind", [RegionBuffer, RegionBuffers])
@pytest.mark.parametrize("kept", [True, False])
def test_shares_of_the_buffer_hold_their_meshes_wherever_the_vertices_are(
    stage: Stage, kept: bool, kind: type[RegionBuffer], monkeypatch: pytest.MonkeyPatch
) -> None:
    if kept:
        hide(monkeypatch, "GL_ARB_vertex_buffer_object")
    blocks = np.pad(np.full((6, 6, 4), 1, np.uint8), 1)
    colours = Look(np.ones((6, 4)), np.zeros((60, 60), np.float32))
    meshes = [region_mesh(blocks[: 4 + k], (0, 0, 0), colours, "none") for k in range(4)]
    buffer = kind(list(meshes[:3]))
    try:
        assert buffer.replace(1, meshes[3]) and buffer.replace(2, meshes[0])
        for share, mesh in enumerate((meshes[0], meshes[3], meshes[0])):
            found = buffer.mesh(share)
            assert (found.vertices == mesh.vertices).all() and (found.counts == mesh.counts).all()
    finally:
        buffer.release()


@pytest.mark.parametrize("kind", [RegionBuffer, RegionBuffers])
@pytest.mark.parametrize("kept", [True, False])
def test_meshes_are_lit_anew_where_they_lie_and_given_back_as_they_were_made(
    stage: Stage, kept: bool, kind: type[RegionBuffer], monkeypatch: pytest.MonkeyPatch
) -> None:
    if kept:
        hide(monkeypatch, "GL_ARB_vertex_buffer_object")
    rng = np.random.default_rng(1)
    blocks = np.pad(rng.choice([0, 1, block("fern")], (9, 6, 6)).astype(np.uint8), 1)
    white = Look(np.ones((6, 4)), np.zeros((60, 60), np.float32))
    meshes = [region_mesh(blocks[: 5 + k], (0, 0, 0), white) for k in range(5)]
    buffer = kind(list(meshes[:4]))
    times = rng.uniform(0.3, 1.4, (7, 3)).astype(np.float32)
    try:
        slope = rng.uniform(0.5, 1.0, (12, 12)).astype(np.float32)
        for light in (
            Light(times / 2, np.arange(7, dtype=np.uint8), slope / 2),
            Light(times, np.arange(9, 16, dtype=np.uint8), slope),
        ):
            buffer.relight(light)

        assert buffer.replace(1, meshes[4])  # in the light it was made in
        for share, mesh in enumerate((meshes[0], meshes[4], meshes[2], meshes[3])):
            turns = np.repeat(np.arange(7), mesh.counts.sum(axis=1))
            made = mesh.vertices["colour"]
            begin = int(buffer.start[share])
            shown = buffer._read(begin, len(made))["colour"]
            x, _, z = np.clip(np.rint(mesh.vertices["position"]).astype(int), 0, 11).T
            sloping = np.isin(turns, [UP, PLANTS])
            lighter = times[turns] * np.where(sloping, slope[x, z], 1.0)[:, None]
            expected = np.minimum(np.floor(made[:, :3] * lighter + 0.5), 255)
            assert len(made) and np.abs(shown[:, :3] - expected).max() <= 1
            assert (shown[:, 3] == 9 + turns).all()
            assert (buffer.mesh(share).vertices == mesh.vertices).all()
    finally:
        buffer.release()


@pytest.mark.seldom(10, first=4)
def test_without_shadows_faces_are_lit_as_if_there_were_none(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    off = picture(stage, shadow__enabled=False)
    hide(monkeypatch, "GL_ARB_shadow")
    assert (picture(stage) == off).all()


@pytest.mark.parametrize(
    ("given", "most"),
    [
        ({"regions": 64, "region_size": 1000}, 1800),
        ({"regions": 64, "region_size": 1000, "levels": 400}, 1229),
        ({"regions": 1, "region_size": 600, "levels": 400, "height_image": "none.png"}, 0),
    ],
)
def test_a_world_that_does_not_fit_in_memory_is_refused_and_so_is_a_missing_image(
    given: dict[str, Any], most: int
) -> None:
    values = with_settings(SCENE.settings, {f"voxel.{k}": v for k, v in given.items()})
    with pytest.raises(InputError) as error:
        source(values.voxel, Assets())
    if most:
        side = given["regions"] * given["region_size"]
        assert str(error.value).startswith("settings voxel.regions=64 and voxel.region_size=1000: ")
        assert f"at most {most} x {most}" in str(error.value)
        assert f"{side} x {side}" in str(error.value)
    else:
        assert str(error.value) == "setting voxel.height_image: none.png: no such file"


ODD: dict[str, dict[str, Any]] = {
    "one column": {"voxel.regions": 1, "voxel.region_size": 1},
    "regions of one column": {"voxel.regions": 5, "voxel.region_size": 1},
    "two columns, all under water": {
        "voxel.regions": 1,
        "voxel.region_size": 2,
        "voxel.levels": 1,
        "voxel.sea": 400,
    },
    "sea above the relief": {"voxel.sea": 400},
    "no sea": {"voxel.sea": 0},
    "the highest relief": {"voxel.levels": 400, "voxel.sea": 120},
    "tiny blocks": {"voxel.block": 0.001},
    "huge blocks": {"voxel.block": 100.0},
    "nothing in reach": {"voxel.distance": 0.1},
    "every picture tiny": {"water.resolution": 0.05, "shadow.size": 16},
}


@pytest.mark.sweep(8, first=5)
@pytest.mark.parametrize("name", ODD)
def test_an_odd_world_is_drawn_without_a_word(
    stage: Stage, name: str, recwarn: pytest.WarningsRecorder, capsys: pytest.CaptureFixture[str]
) -> None:
    given = {"voxel.regions": 2, "voxel.region_size": 15} | ODD[name]
    found = picture(stage, **given)
    assert found.max() > 100  # something lit: haze, sky, land or water
    assert not recwarn.list and capsys.readouterr() == ("", "")


POSES = {
    "beyond the map": Pose(-30.0, 2.0, -30.0, 135.0, -5.0),
    "far away": Pose(1e6, 5.0, 1e6, 10.0, -20.0),
    "under water": Pose(0.5, 0.2, 0.5, 135.0, 10.0),
    "at the water's level": Pose(2.0, 0.7888, 6.5, 35.0, 0.0),
    "inside a block": Pose(5.0, 0.4, 5.0, 0.0, 0.0),
    "straight up": Pose(5.0, 5.0, 5.0, 0.0, 90.0),
    "straight down": Pose(2.0, 1.5, 6.5, 0.0, -90.0),
    "upside down": Pose(2.0, 1.5, 6.5, 35.0, -10.0, 180.0),
    "rolled": Pose(2.0, 1.5, 6.5, 35.0, -10.0, 90.0),
    "very high": Pose(5.0, 1000.0, 5.0, 0.0, -90.0),
    "very deep": Pose(5.0, -1e6, 5.0, 0.0, 30.0),
}


@pytest.mark.seldom(10, first=4)
def test_odd_places_are_drawn_without_a_word(
    stage: Stage, recwarn: pytest.WarningsRecorder, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = with_settings(SCENE.settings, SMALL)
    scene = Voxel(settings, Assets(), 0, SEEN)
    try:
        for name, pose in POSES.items():
            with stage.borrowed():
                scene.draw(Moment(pose, stage.size, 20.0))
            assert stage.read().max() > 40, name
    finally:
        scene.release()
    assert not recwarn.list and capsys.readouterr() == ("", "")


DRAWN: dict[str, tuple[set[str], dict[str, Any]]] = {
    "land": ({"land"}, {"shadow.enabled": False}),
    "land with shadows": ({"land"}, {}),
    "sky": ({"sky"}, {}),
    "water": ({"water"}, {}),
    "water over land, with the sky": ({"land", "sky", "water"}, {}),
    "regions": ({"land"}, {"debug.regions": True}),
    "textures": ({"land", "water"}, {"debug.textures": True}),
    "what a walker holds": ({"land", "highlight", "crosshair", "sword"}, {}),
}


@pytest.mark.sweep(12, first=10)
@pytest.mark.parametrize("name", DRAWN)
def test_every_pass_leaves_the_state_as_a_frame_without_it_does(stage: Stage, name: str) -> None:
    shown, changed = DRAWN[name]
    settings = with_settings(SCENE.settings, SMALL | changed)
    scene = Voxel(settings, Assets(), 0, (*SEEN, "highlight", "crosshair", "sword"))
    moment = Moment(POSE, stage.size, 20.0)
    try:
        with stage.borrowed():
            scene.shown = set()
            scene.draw(moment)
            before = snapshot()
            scene.shown = set(shown)
            scene.draw(moment)
            found = changes(before, snapshot())
    finally:
        scene.release()
    assert not found


@pytest.mark.seldom(10, first=4)
def test_a_large_world_whose_meshes_are_packed_looks_like_a_small_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def picture_and_meshes(dug: bool) -> tuple[np.ndarray, list[RegionMesh]]:
        values = {"voxel.regions": 2, "voxel.region_size": 16}
        with Offscreen((96, 72), None, values, "auto", 0, place="voxel") as drawn:
            drawn.look((1.28, "ground", 1.28, 40.0, -40.0))
            land = drawn.scene.land  # type: ignore[union-attr]
            if dug:
                with drawn.targeted():
                    y = int(land.world.ground[15, 15])
                    cells = itertools.product(range(12, 20), range(12, 20), range(y - 4, y + 9))
                    places = np.array([land.world.place(cell) for cell in cells])
                    land.restore(Changes(places, np.full(len(places), AIR)))
            picture = drawn.draw()
            with drawn.targeted():
                return picture, land.meshes

    for dug in (False, True):
        plain, meshes = picture_and_meshes(dug)
        with monkeypatch.context() as patch:
            # As if the world were large, with no room for another face.
            patch.setattr(build, "MOST_KEPT", 0)
            for name in ("LARGE", "LITTLE_SPARE", "RESERVE"):
                patch.setattr(region_buffer, name, 0)
            patch.setattr(region_buffer, "MOST_SENT", 1000)  # so that land is drawn in parts
            large, theirs = picture_and_meshes(dug)
        np.testing.assert_array_equal(plain, large)
        for one, other in zip(meshes, theirs, strict=True):
            np.testing.assert_array_equal(one.counts, other.counts)
            np.testing.assert_array_equal(one.vertices, other.vertices)


def test_a_packed_mesh_takes_a_fifth_of_its_vertices_and_is_unpacked_as_it_was() -> None:
    x, z, y = np.ogrid[:42, :42, :30]
    ground = 14 + 6 * np.sin(x / 7.0) * np.cos(z / 5.0)
    hills = np.where(y < ground, block("rock"), AIR).astype(np.uint8)
    look = Look(np.ones((6, 4)), np.random.default_rng(3).uniform(-1, 1, (42, 42)), shore=(8, 10))
    for mesh in (region_mesh(hills, (0, 0, 0), look), region_mesh(hills * 0, (0, 0, 0), look)):
        small = packed(mesh)
        assert len(small.data) < max(mesh.vertices.nbytes / 5, 20), mesh.size
        again = unpacked(small)
        assert again.vertices.dtype == mesh.vertices.dtype
        np.testing.assert_array_equal(again.vertices, mesh.vertices)


@pytest.mark.seldom(13, first=5)
def test_a_region_and_a_land_that_do_not_fit_in_memory_are_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    region = {"voxel.regions": 1, "voxel.region_size": 1000, "voxel.levels": 400}
    with pytest.raises(InputError, match=r"voxel\.region_size=1000: expected at most 614"):
        source(with_settings(SCENE.settings, region).voxel, Assets())

    monkeypatch.setenv("LANDSCAPE_CACHE", "")
    small = {"voxel.regions": 2, "voxel.region_size": 16}
    monkeypatch.setattr(build, "LARGE", 1000)
    monkeypatch.setattr(build, "MOST_VERTICES", 2000)
    refusal = pytest.raises(InputError, match="more than 2000 vertices")
    with refusal, Offscreen((8, 8), None, small, "auto", 0, place="voxel") as drawn:
        drawn.draw()


@pytest.mark.seldom(3, first=1)
def test_of_a_land_that_is_refused_no_more_is_meshed_and_nothing_twice(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    meshed, begun, refused = build.meshed, [], threading.Event()

    def counted(place: World, region: int, *rest: Any) -> Any:
        begun.append(region)
        if len(begun) > 40 and not refused.wait(20):  # the refusal needs less
            refused.set()
        return meshed(place, region, *rest)

    monkeypatch.setattr(build, "meshed", counted)
    monkeypatch.setattr(build, "MOST_CELLS", 1)
    monkeypatch.setattr(build, "LARGE", 1000)
    monkeypatch.setattr(build, "MOST_VERTICES", 2000)
    monkeypatch.setenv("LANDSCAPE_CACHE", "")
    settings = with_settings(SCENE.settings, {"voxel.regions": 16, "voxel.region_size": 8})
    before = set(threading.enumerate())
    with pytest.raises(InputError, match="more than 2000 vertices"):
        build.built(settings, Assets(), 0)
    refused.set()
    for thread in set(threading.enumerate()) - before:
        thread.join(60)
    assert len(set(begun)) == len(begun) <= 40 + build.THREADS, begun
