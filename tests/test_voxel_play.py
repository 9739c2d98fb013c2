"""Playing on the island in voxels: a body among blocks, digging and placing, saved worlds."""

import contextlib
import hashlib
import json
import math
import subprocess
import sys
import time
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import environment, landscape, need_library, python, refused
from PIL import Image

from framelens.base.errors import InputError
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.geometry.bodies import Body, Wish
from landscape.offscreen import Offscreen
from landscape.scene.scene import scene
from landscape.voxel.blocks import AIR, SOLID, block
from landscape.voxel.body import AFLOAT, GAP, HALF, HEIGHT, JUMP, RISE, UPWARDS, Place, moved
from landscape.voxel.mesh import (
    BAND,
    BANDS,
    PLANTS,
    SETS,
    SHORE,
    WET,
    Look,
    RegionMesh,
    region_mesh,
)
from landscape.voxel.patch import patched, regions_around
from landscape.voxel.picking import picked, picked_through_water
from landscape.voxel.tile_column import PLACES, ROWS
from landscape.voxel.water_images import FLATTER
from landscape.voxel.world import Changes, World
from landscape.voxel.world_file import decoded, encoded
from landscape.walk.app import Walk
from landscape.walk.builder import WorldFile
from landscape.walk.recording import Plan, Tick
from landscape.walk.walker import Intent

EYE = 1.625
SEA = 4  # the lowest level of dry land
ROCK = block("rock")


def flat(side: int = 24, height: int = 20, ground: int = 4) -> np.ndarray:
    """Return level land: rock up to ``ground``."""
    blocks = np.full((side, side, height), AIR, np.uint8)
    blocks[:, :, :ground] = ROCK
    return blocks


def wish(east=0.0, south=0.0, up=0.0, jump=False, flying=False, dive=False) -> Wish:
    return Wish(east, up, south, jump, flying, EYE, dive)


def go(place: Place, body: Body, way: Wish, seconds: float, frames: int) -> list[Body]:
    found = []
    for _ in range(frames):
        body = moved(place, body, way, seconds)
        found.append(body)
    return found


def is_inside(blocks: np.ndarray, body: Body) -> bool:
    """Return whether a body has a part in a solid block, cell by cell."""
    half, height = HALF * EYE, HEIGHT * EYE
    n, top = len(blocks), blocks.shape[2]
    for x in range(math.floor(body.x - half), math.ceil(body.x + half)):
        for z in range(math.floor(body.z - half), math.ceil(body.z + half)):
            for y in range(math.floor(body.y), min(math.ceil(body.y + height), top)):
                if y < 0 or SOLID[blocks[min(max(x, 0), n - 1), min(max(z, 0), n - 1), y]]:
                    return True
    return False


@pytest.mark.sweep(5, first=4)
@pytest.mark.parametrize("seed", range(6))
def test_a_body_is_never_inside_a_solid_block_in_any_world_at_any_speed(seed: int) -> None:
    rng = np.random.default_rng(seed)
    blocks = (rng.random((12, 12, 12)) < rng.uniform(0.05, 0.5)).astype(np.uint8) * ROCK
    blocks[rng.random(blocks.shape) < 0.05] = block("poppy")
    place = Place(blocks, water=[-math.inf, 5.9][seed % 2])
    body = Body(6.0, 6.0, 6.0)
    for _ in range(250):
        speed = 10.0 ** rng.uniform(-1, 4)
        east, south, up = rng.uniform(-1, 1, 3) * speed
        jump, flying = rng.random(2) < (0.5, 0.2)
        body = moved(place, body, wish(east, south, up, jump, flying), 10.0 ** rng.uniform(-4, 0))
        assert not is_inside(blocks, body), body
        assert 1.0 <= body.x <= 11.0 and 1.0 <= body.z <= 11.0
        eye = math.floor(body.y + EYE - body.lag)
        if eye < blocks.shape[2]:
            assert not SOLID[blocks[math.floor(body.x), math.floor(body.z), eye]], body


@pytest.mark.seldom(3, first=1)
@pytest.mark.parametrize("speed", [1.0, 30.0, 1e5])
@pytest.mark.parametrize("seconds", [0.001, 1 / 30, 1.0])
def test_a_wall_stops_a_body_whatever_its_speed_and_the_frame_s_length(
    speed: float, seconds: float
) -> None:
    blocks = flat()
    blocks[12, :, :] = ROCK
    frames = min(math.ceil(12 / (speed * seconds)), 400)
    for way in (wish(east=speed), wish(east=speed, flying=True)):
        last = go(Place(blocks), Body(6.0, 4.0, 12.0), way, seconds, frames)[-1]
        if speed * seconds * frames > 10:
            assert last.x == pytest.approx(12 - HALF * EYE, abs=2 * GAP)
        assert last.x < 12 - HALF * EYE


def test_a_step_of_one_block_is_climbed_smoothly_and_one_of_two_is_not() -> None:
    blocks = flat()
    for k in range(3):  # stairs
        blocks[10 + k, :, : 5 + k] = ROCK
    blocks[13:, :, :7] = ROCK
    blocks[18:, :, :9] = ROCK
    place = Place(blocks)
    path = go(place, Body(6.0, 4.0, 12.0, grounded=True), wish(east=6.0), 1 / 60, 240)
    assert path[-1].x == pytest.approx(18 - HALF * EYE, abs=2 * GAP)
    assert path[-1].y == pytest.approx(7.0, abs=2 * GAP)
    eyes = [body.y - body.lag for body in path]
    assert max(np.diff(eyes)) < 0.25, "the eye would jump"
    back = go(place, path[-1], wish(east=-6.0), 1 / 60, 240)
    assert back[-1].y == pytest.approx(4.0, abs=2 * GAP)
    assert min(np.diff([body.y - body.lag for body in back])) > -0.25
    assert all(body.grounded for body in back), "steps down are walked, not fallen"


def test_a_jump_reaches_the_top_of_one_block_but_not_of_two() -> None:
    place = Place(flat())
    start = moved(place, Body(12.0, 4.0, 12.0), wish(), 0.1)
    for seconds in (1 / 240, 1 / 60, 1 / 20):
        path = go(place, start, wish(jump=True), seconds, round(0.5 / seconds))
        assert 5.1 < max(body.y for body in path) < 5.5
    falling = go(place, start, wish(jump=True), 1 / 60, 20)[-1]
    path = go(place, falling, wish(), 1 / 60, 60)
    assert path[-1].grounded and path[-1].y == pytest.approx(4.0, abs=2 * GAP)


def test_a_roof_lower_than_the_body_keeps_it_out_and_one_above_stops_a_jump() -> None:
    low, high = flat(), flat()
    low[12:, :, 5] = ROCK
    high[:, :, 6] = ROCK
    start = Body(6.0, 4.0, 12.0, grounded=True)
    assert go(Place(low), start, wish(east=5.0), 1 / 30, 90)[-1].x < 12 - HALF * EYE
    path = go(Place(high), start, wish(east=5.0, jump=True), 1 / 30, 90)
    assert path[-1].x > 18, "a roof of two blocks is high enough"
    assert max(body.y for body in path) <= 6 - HEIGHT * EYE


def test_plants_do_not_stop_and_a_body_in_a_block_is_set_on_top_of_it() -> None:
    blocks = flat()
    blocks[10:14, :, 4] = block("tall grass")
    walked = go(Place(blocks), Body(6.0, 4.0, 12.0), wish(east=6.0), 1 / 30, 60)
    assert walked[-1].x == pytest.approx(18.0, abs=0.1)
    assert max(body.y for body in walked) < 4.01
    blocks[5:8, 11:14, :9] = ROCK
    assert moved(Place(blocks), Body(6.0, 4.0, 12.0), wish(), 0.0).y == pytest.approx(9, abs=1e-3)


def test_a_body_floats_in_deep_water_wades_in_shallow_and_climbs_the_bank() -> None:
    blocks = flat()
    blocks[6:, :, :8] = ROCK
    blocks[4:6, :, :7] = ROCK
    place = Place(blocks, water=7.88)
    floats = 7.88 - AFLOAT * EYE
    fallen = go(place, Body(2.0, 15.0, 12.0), wish(), 1 / 30, 90)
    assert min(body.y for body in fallen) > floats - 0.5, "the eye stays above the water"
    assert fallen[-1].swimming and fallen[-1].y == pytest.approx(floats, abs=0.01)
    path = go(place, fallen[-1], wish(east=5.0), 1 / 30, 90)
    wading = [body for body in path if 4.5 < body.x < 5.5]
    assert wading and not any(body.swimming for body in wading)
    assert path[-1].y == pytest.approx(8.0, abs=1e-3) and not path[-1].swimming
    assert go(Place(blocks, floor=7.88), Body(2.0, 9.0, 12.0), wish(), 1 / 30, 60)[-1].y == 7.88


def test_a_swimmer_dives_down_to_the_bed_and_comes_up_again_not_too_fast() -> None:
    place = Place(flat(), water=14.0)
    floats = 14.0 - AFLOAT * EYE
    start = go(place, Body(2.0, 14.0, 12.0), wish(), 1 / 30, 60)[-1]
    assert start.y == pytest.approx(floats, abs=0.01)
    down = go(place, start, wish(dive=True), 1 / 30, 90)
    assert down[-1].y == pytest.approx(4.0, abs=2 * GAP) and down[-1].swimming
    for given, fastest in (({}, RISE), ({"jump": True}, UPWARDS)):
        up = go(place, down[-1], wish(**given), 1 / 30, 150)
        steps = np.diff([body.y for body in up])
        assert steps.max() == pytest.approx(fastest / 30, rel=0.01)
        assert up[-1].y == pytest.approx(floats, abs=0.01)


def test_diving_on_land_does_nothing() -> None:
    place = Place(flat(), water=2.0)
    start = moved(place, Body(12.0, 4.0, 12.0), wish(), 0.1)
    still, diving = (go(place, start, wish(dive=dive), 1 / 30, 10)[-1] for dive in (False, True))
    assert still == diving


def test_the_path_hardly_depends_on_the_frame_rate() -> None:
    blocks = flat()
    blocks[10:, :, :5] = ROCK
    ends = []
    for frames in (15, 30, 120):
        body = go(Place(blocks), Body(6.0, 9.0, 12.0), wish(east=4.0), 2 / frames, frames)[-1]
        ends.append((body.x, body.y))
    assert np.ptp(ends, axis=0) == pytest.approx([0, 0], abs=0.02)
    assert JUMP > 0


# Which block is under the cross-hair.


def test_through_water_the_block_is_picked_that_is_seen_there() -> None:
    """A point of the bed, drawn flatter as the refraction is, is picked where it is drawn."""
    rng = np.random.default_rng(3)
    blocks = flat()
    blocks[:, :, :8] = np.where(rng.random((24, 24, 8)) < 0.5, ROCK, AIR)
    blocks[:, :, 0] = ROCK
    level, picks = 9.86, 0
    for _ in range(300):
        target = np.array([*rng.uniform(2, 22, 2), rng.uniform(1, 8)])
        eye = np.array([*rng.uniform(2, 22, 2), rng.uniform(10.5, 14)])
        seen = target.copy()
        seen[2] = level + FLATTER * (target[2] - level)
        reach = float(np.linalg.norm(seen - eye))
        way = (seen - eye) / reach
        hit = picked_through_water(blocks, eye, way, reach, level, FLATTER)
        cell = tuple(np.floor(target).astype(int).tolist())
        if hit is None:
            assert blocks[cell] == AIR
            continue
        # What is picked lies on the bent line, not beyond the point that was looked at.
        met = eye + (level - eye[2]) / way[2] * way
        points = met + np.linspace(0, 1, 2001)[:, None] * (target - met)
        passed = {tuple(each) for each in np.floor(points).astype(int).tolist()}
        assert hit.block in passed
        picks += 1

    assert picks > 200


def test_from_under_water_a_block_above_is_picked_lower_than_it_is_seen() -> None:
    blocks = flat()
    blocks[12, :, 13] = ROCK
    level, eye = 10.0, np.array([8.0, 12.5, 7.0])
    target = np.array([12.1, 12.5, 13.5])
    seen = target.copy()
    seen[2] = level + (target[2] - level) / FLATTER
    way = (seen - eye) / np.linalg.norm(seen - eye)
    hit = picked_through_water(blocks, eye, way, 20.0, level, FLATTER)
    assert hit is not None and hit.block == (12, 12, 13)
    assert picked(blocks, eye, way, 20.0) is None


def first_by_small_steps(blocks: np.ndarray, eye: np.ndarray, way: np.ndarray, reach: float):
    """Return the first block on a ray by looking at a point every ten-thousandth of a block."""
    at = np.arange(0.0, reach, 1e-4)[:, None] * way + eye
    cells = np.floor(at).astype(int)
    inside = ((cells >= 0) & (cells < blocks.shape)).all(axis=1)
    met = np.zeros(len(cells), bool)
    met[inside] = blocks[tuple(cells[inside].T)] != AIR
    return tuple(cells[met.argmax()].tolist()) if met.any() else None


def test_the_block_under_the_cross_hair_is_the_first_one_on_the_line_of_sight() -> None:
    rng = np.random.default_rng(3)
    blocks = (rng.random((12, 12, 12)) < 0.06).astype(np.uint8)
    for _ in range(60):
        eye, way = rng.uniform(-2, 14, 3), rng.normal(size=3)
        way[rng.random(3) < 0.1] = 0.0
        way /= np.linalg.norm(way) or 1.0
        hit = picked(blocks, eye.tolist(), way.tolist(), 6.0)
        assert (hit and hit.block) == first_by_small_steps(blocks, eye, way, 6.0)
        if hit and hit.block != hit.before:
            assert sum(abs(a - b) for a, b in zip(*hit, strict=True)) == 1
            inside = all(0 <= at < 12 for at in hit.before)
            assert not inside or blocks[hit.before] == AIR
    assert picked(blocks, (0.5, 0.5, 0.5), (0.0, 0.0, 0.0), 5.0) is None or blocks[0, 0, 0]


# A changed block, and the mesh around it.


def unit_faces(mesh: RegionMesh, sea: int) -> dict[tuple, tuple]:
    """Return the tile and the corners' darkness of each unit face of a mesh, by place and way."""
    found = {}
    starts = np.cumsum(mesh.counts.ravel()) - mesh.counts.ravel()
    for number, (start, count) in enumerate(zip(starts, mesh.counts.ravel(), strict=True)):
        turn, part = divmod(number, SETS)
        for quad in mesh.vertices[start : start + count].reshape(-1, 4):
            corners = quad["position"][:, [0, 2, 1]]
            if turn == PLANTS:
                key = ("plant", *np.round(corners[0], 2).tolist())
                assert key not in found, "a plant is drawn twice"
                found[key] = part, []
                continue
            at = np.rint(corners).astype(int)
            low, high = at.min(axis=0), at.max(axis=0)
            # Rows of the column in which each tile is there several times.
            tile = int(quad["coordinate"][:, 1].min() * ROWS) // PLACES
            band = max(math.ceil((high[2] - sea - 1) / BAND), 1)
            dry = SETS - min(band, BANDS)
            expected = dry if low[2] >= sea + 1 else WET if high[2] <= sea - 1 else SHORE
            assert part == expected
            # Where faces are merged, the darkness does not change along them.
            dark = sorted(zip((at > low).tolist(), quad["colour"][:, 0].tolist(), strict=True))
            for cell in np.ndindex(*np.maximum(high - low, 1)):
                key = (turn, *(low + cell).tolist())
                assert key not in found, "a face is drawn twice"
                found[key] = tile, dark

    return found


@pytest.mark.seldom(13, first=3)
def test_after_any_changes_a_mesh_has_the_faces_of_one_made_anew() -> None:
    rng = np.random.default_rng(5)
    side, size = 20, 10
    heights = rng.integers(3, 9, (side, side))
    blocks = np.where(np.arange(24) < heights[..., None], ROCK, AIR).astype(np.uint8)
    blocks[8:18, 8:18, :9] = ROCK  # level, so that faces are merged
    world = World(blocks, heights, size, SEA, 0.08)
    # No noise and no differences of light: a colour tells the darkness of a corner.
    shore = SEA - 1, SEA + 1
    look = Look(np.ones((6, 4)), np.zeros((side + 1, side + 1), np.float32), shore=shore)

    def whole(region: int) -> RegionMesh:
        return region_mesh(*world.with_edge(region), look)

    meshes = [whole(region) for region in range(4)]
    kinds = [AIR, AIR, ROCK, block("sand"), block("poppy")]
    for number in range(60):
        x, z = rng.integers(6, 19, 2)
        cell = int(x), int(z), int(rng.integers(6, 11))
        world.put(cell, int(rng.choice(kinds)))
        high = [at + 1 for at in cell]
        for region in regions_around(world, cell, high):
            meshes[region] = patched(meshes[region], world, region, cell, high, look)
        if number % 6 == 5:
            for region in range(4):
                assert unit_faces(meshes[region], SEA) == unit_faces(whole(region), SEA)
    places, kinds = world.changes
    assert len(places) and all(
        world.former[place] != kind for place, kind in zip(places, kinds, strict=True)
    )


@pytest.mark.seldom(13, first=3)
def test_after_two_frames_meshes_for_far_and_shadows_are_those_of_a_scene_made_anew() -> None:
    values = {"voxel.regions": 2, "voxel.region_size": 16, "shadow.size": 512, "voxel.cull": False}
    with Offscreen((96, 72), None, values, "auto", 0, place="voxel") as drawn:
        drawn.look((1.28, "ground", 1.28, 40.0, -40.0))
        drawn.draw()
        scene: Any = drawn.scene
        land, rng = scene.land, np.random.default_rng(2)
        with drawn.targeted():
            for number in range(6):
                x, z = (int(at) for at in rng.integers(14, 19, 2))
                y = int(land.world.ground[x, z])
                land.change({(x, z, y - 1): [AIR, block("brick")][number % 2], (x, z, y): AIR})
                if number % 3 == 2:
                    drawn.submit()

        for _ in range(2):
            picture = drawn.draw()
        with drawn.targeted():
            # Meshes for where a region is distant are made again when they are first drawn.
            land.choose(np.eye(4), np.zeros(3), land.around(np.zeros(3)), near=0.0, far=0.0)
            before = [unit_faces(mesh, land.world.sea) for mesh in land.meshes]
            for region in range(4):
                land.rebuild(region)

        for patched_faces, mesh in zip(before, land.meshes, strict=True):
            assert {key: face[0] for key, face in patched_faces.items()} == {
                key: face[0] for key, face in unit_faces(mesh, land.world.sea).items()
            }

        # All of the picture of depths is drawn again: not only the parts that have changed.
        assert (np.abs(picture.astype(int) - drawn.draw()).max(axis=-1) > 12).sum() < 8


# Worlds as files.

LAND = {"regions": 1, "seed": 3, "trees": True, "height_image": "ab"}


def small_world() -> World:
    return World(flat(), np.full((24, 24), 4), 24, 4, 0.08)


def changed_world() -> World:
    world = small_world()
    for cell, kind in {(3, 4, 3): AIR, (5, 5, 4): block("lamp"), (23, 23, 19): ROCK}.items():
        world.put(cell, kind)
    return world


def test_a_saved_world_has_only_the_changed_blocks_and_comes_back_the_same() -> None:
    world = changed_world()
    world.put((9, 9, 9), ROCK)
    world.put((9, 9, 9), AIR)  # as it was
    data = encoded(world.changes, LAND)
    assert json.loads(data.partition(b"\n")[0])["changes"] == 3
    again = small_world()
    again.put((1, 1, 1), ROCK)  # which the file does not have
    again.restore(decoded(data, "a", again, LAND))
    assert (again.blocks == world.blocks).all() and again.former == world.former
    assert encoded(again.changes, LAND) == data


def forged(**head: Any) -> bytes:
    """Return a saved world with another first line."""
    line, _, body = encoded(changed_world().changes, LAND).partition(b"\n")
    return json.dumps(json.loads(line) | head).encode() + b"\n" + body


def packed(places: list[int], numbers: list[int], **head: Any) -> bytes:
    """Return a world of these changes, with a digest that fits."""
    content = np.array(places, "<u4").tobytes() + np.array(numbers, "u1").tobytes()
    body = zlib.compress(content)
    line = forged(changes=len(places), digest=hashlib.sha256(body).hexdigest(), **head)
    return line.partition(b"\n")[0] + b"\n" + body


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "an empty file"),
        (b"\x89PNG\r\n\x1a\nsomething", "something else"),
        (b"[" * 70000 + b"\n", "something else"),
        (b"{}\n", "something else"),
        (encoded(changed_world().changes, LAND)[:-4], "truncated or damaged"),
        (encoded(changed_world().changes, LAND).partition(b"\n")[0], "something else"),
        (forged(**{"landscape voxel world": 2}), "version 2"),
        (forged(**{"landscape voxel world": True}), "version True"),
        (forged(land={**LAND, "seed": 4}), "made with seed 4: expected 3"),
        (forged(land={**LAND, "trees": 1}), "made with trees 1"),
        (forged(land=[]), "what its land is made from"),
        (forged(changes=-1), "changes -1"),
        (forged(changes=True), "changes True"),
        (forged(changes=4), "expected 4 changed blocks"),
        (forged(changes=2), "expected 2 changed blocks"),
        (forged(kinds=["air", "unobtainium"]), "unknown kind of block 'unobtainium'"),
        (forged(kinds=[]), "does not name"),
        (packed([24 * 24 * 20], [1]), "outside the map"),
        (packed([7], [200]), "unknown kind, 200"),
        (packed([7], [1], kinds=["air"]), "unknown kind, 1"),
        (packed([7, 7], [1, 2]), "each changed block once"),
        (packed([8, 7], [1, 2]), "each changed block once"),
        (forged(changes=500_001), "changes 500001"),
    ],
)
def test_a_file_that_is_no_world_of_this_land_is_refused(data: bytes, said: str) -> None:
    with pytest.raises(InputError) as error:
        decoded(data, "my.world", small_world(), LAND)
    assert str(error.value).startswith("my.world: ") and said in str(error.value)
    assert "\n" not in str(error.value)


SAVING = """
import sys
from pathlib import Path
from landscape.walk.builder import WorldFile

class Scene:
    changes = slot = count = 0
    is_changed = True
    def use(self, *given): return ""
    choose = bar = covered = restore = merged = use
    def saved(self):
        self.count += 1
        return b"%08d" % self.count * 200_000 + b"end"

file, scene = WorldFile(Path(sys.argv[1])), Scene()
file.opened(scene)
while True:
    file.save(scene)
    print(".", end="", flush=True)
"""


@pytest.mark.seldom(13, first=4)
def test_a_world_being_saved_when_the_program_is_killed_is_never_lost(tmp_path: Path) -> None:
    path = tmp_path / "my.world"
    words = [sys.executable, "-c", SAVING, str(path)]
    for seconds in (0.0, 0.003, 0.007, 0.012):
        with subprocess.Popen(words, stdout=subprocess.PIPE, env=environment()) as process:
            assert process.stdout is not None and process.stdout.read(2) == b".."
            time.sleep(seconds)
            process.kill()
        data = path.read_bytes()
        assert len(data) == 1_600_003 and data.endswith(b"end")
        assert data[:8] * 200_000 + b"end" == data, "half of another"


@contextlib.contextmanager
def played(regions: int, region_size: int) -> Iterator[Any]:
    """Let the block play on a small island of as many regions."""
    values = {"voxel.regions": regions, "voxel.region_size": region_size, "shadow.enabled": False}
    with Offscreen((32, 24), None, values, "auto", 0, place="voxel", only=("land",)) as drawn:
        drawn.draw()
        with drawn.targeted():
            yield drawn.scene


@pytest.mark.seldom(13, first=3)
def test_a_saved_world_is_for_the_same_columns_however_they_are_divided_into_regions() -> None:
    with played(2, 20) as one:
        one.land.change({(19, 20, 5): block("lamp"), (20, 20, 5): AIR})
        data, changed = one.saved(), one.land.world.blocks.copy()
    line, _, body = data.partition(b"\n")
    head = json.loads(line)
    # Worlds were once saved with their regions.
    head["land"] |= {"regions": 2, "region_size": 20}
    for content in (data, json.dumps(head).encode() + b"\n" + body):
        with played(5, 8) as other:
            assert (other.land.world.blocks != changed).any()
            other.restore(content, "my.world")
            assert (other.land.world.blocks == changed).all()
    with played(3, 15) as larger, pytest.raises(InputError, match=r"my\.world: made with size"):
        larger.restore(data, "my.world")


def test_two_walks_with_one_file_keep_what_both_have_changed(tmp_path: Path) -> None:
    path = tmp_path / "my.world"
    lamp, a, b, c = block("lamp"), (19, 20, 5), (20, 20, 5), (3, 3, 5)
    with played(2, 20) as scene:
        land = scene.land
        empty = scene.saved()
        one, other = WorldFile(path), WorldFile(path)
        one.opened(scene)
        other.opened(scene)
        land.change({a: lamp})
        assert one.save(scene)
        mine = scene.saved()

        scene.restore(empty, "none")
        land.change({b: lamp})
        assert other.save(scene)
        theirs = scene.saved()

        # What the other has put there is not taken away by one who does not see it.
        scene.restore(mine, "mine")
        land.change({c: lamp})
        assert one.save(scene) and not one.save(scene)
        mine = scene.saved()
        scene.restore(path.read_bytes(), "my.world")
        places = [land.world.place(cell) for cell in (c, a, b)]
        assert scene.land.world.changes.places.tolist() == places

        # Both change the same block: the file stays, and the second is saved beside it.
        scene.restore(mine, "mine")
        land.change({(9, 9, 5): lamp})
        assert one.save(scene)
        before = path.read_bytes()
        scene.restore(theirs, "theirs")
        land.change({(9, 9, 5): block("brick"), (8, 9, 5): lamp})
        with pytest.raises(
            InputError, match=r"changed 1 of the same blocks.*my-0001\.world"
        ) as said:
            other.save(scene)
        assert "\n" not in str(said.value) and path.read_bytes() == before
        assert (tmp_path / "my-0001.world").read_bytes() == scene.saved()
        land.change({(7, 9, 5): lamp})
        assert other.save(scene) and path.read_bytes() == before
        assert (tmp_path / "my-0001.world").read_bytes() == scene.saved()
        assert {each.name for each in tmp_path.iterdir()} == {"my.world", "my-0001.world"}


@pytest.mark.seldom(10)
@pytest.mark.parametrize("content", [b"", b"notes", None])
def test_a_world_file_that_became_something_else_in_the_meantime_is_not_overwritten(
    tmp_path: Path, content: bytes | None
) -> None:
    path = tmp_path / "my.world"
    with played(2, 20) as scene:
        file = WorldFile(path)
        file.opened(scene)
        scene.land.change({(19, 20, 5): block("lamp")})
        assert file.save(scene)
        path.unlink()
        if content is not None:
            path.write_bytes(content)
        scene.land.change({(18, 20, 5): block("lamp")})
        if content is None:
            assert file.save(scene) and path.read_bytes() == scene.saved()
            return
        with pytest.raises(InputError, match="this walk is saved in"):
            file.save(scene)
        assert path.read_bytes() == content
        assert (tmp_path / "my-0001.world").read_bytes() == scene.saved()


@pytest.mark.seldom(14, first=13)
def test_hundreds_of_thousands_of_changed_blocks_are_restored_within_the_bounds() -> None:
    with played(4, 40) as scene:
        world = scene.land.world
        places = np.arange(0, world.blocks.size, 12)
        kinds = np.where(world.blocks.ravel()[places] == ROCK, AIR, ROCK).astype(np.uint8)
        began = time.process_time()
        scene.land.restore(Changes(places, kinds))
        assert time.process_time() - began < 20
        assert (world.blocks.ravel()[places] == kinds).all()
        scene.land.restore(Changes(places[:0], kinds[:0]))
        assert not world.former


# A walk on the null platform.

SMALL = ("voxel.regions=2", "voxel.region_size=40", "voxel.buildings=false", "voxel.trees=false")
SMALL = (*SMALL, "shadow.enabled=false", "water.reflection=false", "water.refraction=false")

WALKED = """
import hashlib, json, sys
from pathlib import Path
import glfw
from landscape.files.assets import Assets
from landscape.frame import Pose
from landscape.scene.scene import scene
from landscape.walk.app import Walk
from landscape.walk.builder import WorldFile
from landscape.walk.loop import run
from landscape.walk.recording import Plan, Writer, read

LEFT, RIGHT, MIDDLE = range(3)
kind = scene("voxel")
values = kind.values(None, dict(word.split("=") for word in sys.argv[2:]))
plan = Plan("voxel", values, "voxel_bay", Pose(3.2, None, 3.2, 40.0, -50.0), (96, 72))

class Watched(Walk):
    script = {}
    def listen(self):
        for event in self.script.get(len(self.seen), ()):
            event(self)
        return super().listen()
    def present(self):
        scene, walker = self.place.scene, self.walker
        self.seen.append([scene.changes, scene.slot, walker.yaw, walker.stroke,
                          hashlib.sha256(self.pixels()).hexdigest(), self._message])
        super().present()

def button(which, down=True):
    action = glfw.PRESS if down else glfw.RELEASE
    return lambda walk: walk.hands.button(which, action)
def click(which):
    return lambda walk: [button(which, down)(walk) for down in (True, False)]
def move(x, y): return lambda walk: walk.hands.motion(x, y)
def key(which): return lambda walk: walk.hands.key(which, glfw.PRESS)

path, world = Path(sys.argv[1]) / "a.jsonl", Path(sys.argv[1]) / "my.world"
live = Watched(plan, Assets(), "osmesa", world=WorldFile(world))
live.seen, live.script = [], {
    8: [move(10, 10), button(LEFT)], 9: [move(12, 11)], 10: [move(40, 11)], 11: [move(60, 11)],
    12: [button(LEFT, False)], 14: [click(LEFT)], 18: [key(glfw.KEY_7)], 19: [click(RIGHT)],
    21: [lambda walk: walk.hands.wheel(-1.0)], 22: [lambda walk: walk.hands.wheel(1.0)],
    23: [lambda walk: walk.hands.wheel(1.0)], 24: [click(MIDDLE)], 26: [key(glfw.KEY_TAB)],
    28: [key(glfw.KEY_E)], 30: [button(LEFT)], 38: [button(LEFT, False)],
}
import landscape.walk.app as app
from landscape.walk import builder
app.time.sleep = lambda seconds: None
builder.AUTOSAVE = 0.2
writer = Writer(path, plan)
clock = iter(range(10**6))
glfw.get_time = lambda: next(clock) / 20
with live:
    run(live, writer=writer, frames=42)
writer.finish()
saved = world.read_bytes()
plan, ticks = read(path)
world.unlink()
again = Watched(plan, Assets(), "osmesa")
again.seen = []
with again:
    run(again, iter(ticks))
    same = again.place.scene.saved() == saved
world.write_bytes(saved)
print(json.dumps({"live": live.seen, "again": again.seen == live.seen, "same": same}))
"""


@pytest.mark.parametrize("dug", [False, True])
@pytest.mark.sweep(10)
def test_a_fix_on_another_land_is_shown_unless_blocks_were_changed(
    dug: bool, tmp_path: Path
) -> None:
    need_library("OSMesa")
    kind, path = scene("voxel"), tmp_path / "my.world"
    small = {"voxel.regions": 2, "voxel.region_size": 40, "shadow.enabled": False}
    pose = Pose(3.2, None, 3.2, 40.0, -50.0)
    plan = Plan("voxel", kind.values(None, small), "voxel_slope", pose, (96, 72))
    with Walk(plan, Assets(), "osmesa", world=WorldFile(path)) as walk:
        before = walk.place.settings
        if dug:
            walk.advance(Tick(0.05, Intent(dig=True), (), plan.size))
            assert walk.place.scene.is_changed
        walk.advance(Tick(0.05, Intent(), ("fix",), plan.size))
        walk.draw()
        refused = "blocks were changed" in walk._message
        assert refused is dug is (walk.place.settings == before)
        assert walk.place.settings.voxel.trees is dug
    assert path.exists() is dug, "a file of another land without changes would be refused"


@pytest.fixture(scope="module")
def walked(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A scripted walk with its replay, and the folder of its world."""
    need_library("OSMesa")
    folder = tmp_path_factory.mktemp("walked")
    done = python(WALKED, str(folder), *SMALL, env=environment(LANG="C"))
    assert done.status == 0, done.err
    return done.json() | {"folder": folder}


@pytest.mark.seldom(13, first=1)
def test_a_drag_looks_and_a_click_digs_places_or_picks(walked: dict[str, Any]) -> None:
    changes, slots, yaws, strokes, _, _ = zip(*walked["live"], strict=True)
    assert changes[13] == 0 and yaws[13] == pytest.approx(40 + 20 * 0.12), "the drag dug nothing"
    assert changes[14] == 1 and changes[18] == 1, "one click digs one block"
    assert slots[18] == 6 and changes[19] == 2, "the seventh kind is placed"
    assert slots[21:24] == (7, 6, 5) and slots[24] == 6, "the wheel chooses, the middle click picks"
    assert not any(strokes[:28]) and any(strokes[28:]), "the sword is on its key"
    assert changes[30] == 3 and 4 <= changes[37] <= 6, "a held button digs one after another"
    assert len(set(changes[38:])) == 1


@pytest.mark.seldom(7, first=1)
def test_a_replay_digs_and_builds_the_same(walked: dict[str, Any]) -> None:
    assert "the world is saved" in [message for *_, message in walked["live"]]
    assert walked["again"] and walked["same"]


def render(folder: Path, name: str, *words: str) -> np.ndarray:
    """Render a spot where the walk has dug; return the picture."""
    sets = [word for change in SMALL for word in ("--set", change)]
    pose = ("--pose", "3.2,2.2,3.2,40,-70", "--scene", "voxel", "--size", "96x72")
    done = landscape(
        "render",
        *pose,
        *sets,
        "--seed",
        "0",
        "--backend",
        "osmesa",
        "-q",
        "--out",
        str(folder / name),
        *words,
    )
    assert (done.status, done.err) == (0, "")
    return np.asarray(Image.open(folder / name)).astype(int)


@pytest.mark.seldom(10, first=1)
def test_a_saved_world_is_rendered_with_its_changes(walked: dict[str, Any]) -> None:
    folder = walked["folder"]
    with_it = render(folder, "a.png", "--world", str(folder / "my.world"))
    assert (np.abs(with_it - render(folder, "b.png")).max(axis=-1) > 8).sum() > 20


@pytest.mark.seldom(13, first=10)
@pytest.mark.parametrize("view", ["voxel", "island"])
def test_a_walk_refuses_what_is_no_world_and_leaves_it_alone(view: str, tmp_path: Path) -> None:
    path = tmp_path / "notes.txt"
    path.write_text("mine")
    words = ["walk", view, "--backend", "osmesa", "--frames", "1", "--size", "32x24"]
    sets = [word for change in SMALL for word in ("--set", change) if view == "voxel"]
    refused(landscape(*words, *sets, "--world", path), "notes.txt", "expected")
    refused(landscape(*words, *sets, "--world", tmp_path), "folder" if view == "voxel" else "voxel")
    assert path.read_text() == "mine" and [p.name for p in tmp_path.iterdir()] == ["notes.txt"]


def test_a_picture_needs_a_world_that_is_there(tmp_path: Path) -> None:
    for view in ("voxel_bay", "fig35a"):
        path = tmp_path / ("none" if view == "voxel_bay" else "empty")
        (tmp_path / "empty").write_bytes(b"")
        with pytest.raises(InputError, match=path.name):
            Offscreen(world=path).look(view)
