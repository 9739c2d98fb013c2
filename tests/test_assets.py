"""The shipped assets pass every check, every check finds its fault, builds leave complete files."""

import io
import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import SECONDS, running
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.output import write_whole
from landscape.cli import main
from landscape.files.assets import Assets, shipped
from landscape.files.meshes import read_ply
from landscape.geometry.mesh import vertex_normals
from landscape.studio import asset_check as checks
from landscape.studio import asset_measures as measures
from landscape.studio.asset_check import check, report


@pytest.fixture(scope="module")
def studio() -> Any:
    """The studio's build module, if its extra is installed."""
    for name in ("scipy", "numba", "skimage", "fast_simplification"):
        pytest.importorskip(name, reason="the extra `studio` is not installed")
    from landscape.studio import build

    return build


# ---- the shipped assets -----------------------------------------------------------------------


@pytest.mark.seldom(10)
def test_the_shipped_assets_pass_every_check() -> None:
    found = list(check())
    assert len(found) > 90
    assert [finding.line() for finding in found if not finding.ok] == []


@pytest.mark.seldom(5)
def test_every_asset_of_the_studio_is_checked(studio: Any) -> None:
    meshes = {**checks.MESHES, **checks.TEXTURED, **checks.SKINNED}
    kinds = checks.SIZES, meshes, checks.ENVIRONMENTS, checks.PLACES_FILES
    assert set(studio.table()) == {name for kind in kinds for name in kind}


# ---- every measure finds its fault ------------------------------------------------------------


def grain(seed: int = 1, size: int = 64) -> np.ndarray:
    """Return coarse tiling noise, uint8 (size, size, 3)."""
    noise = np.random.default_rng(seed).random((size, size, 3))
    for axis in (0, 1):
        noise = np.mean([np.roll(noise, k, axis) for k in range(5)], axis=0)
    return (noise * 255).astype(np.uint8)


def test_a_tile_has_no_seam() -> None:
    tile = np.tile(grain(), (2, 2, 1))[:64, :64]
    assert all(seam.ok for seam in measures.seams(tile))


@pytest.mark.parametrize("axis", [0, 1])
def test_a_cut_tile_has_a_seam(axis: int) -> None:
    cut = np.take(grain(), np.arange(40), axis=axis)
    assert [seam.ok for seam in measures.seams(cut)] == [axis == 1, axis == 0][::-1]


def test_a_step_in_brightness_is_found_in_fine_grain() -> None:
    noise = np.random.default_rng(2).integers(60, 180, (128, 128, 3))
    assert all(seam.ok for seam in measures.seams(noise.astype(np.uint8)))
    slope = np.linspace(0, 40, 128)[None, :, None]
    columns, rows = measures.seams((noise + slope).astype(np.uint8))
    assert not columns.ok and rows.ok


def sky() -> dict[str, np.ndarray]:
    """Return five small faces that match; the walls have twice the resolution of the top."""

    def colour(x: Any, y: Any, z: Any) -> np.ndarray:
        x, y, z = np.broadcast_arrays(x, y, z)
        return np.stack([120 + 6 * x, 100 + 9 * y, 120 + 6 * z], axis=-1).round().astype(np.uint8)

    across, down = np.linspace(-8, 8, 33)[None, :], np.linspace(5, 0, 9)[:, None]
    coarse = np.linspace(-8, 8, 17)
    return {
        "north": colour(across, down, -8.0),
        "east": colour(8.0, down, across),
        "south": colour(-across, down, 8.0),
        "west": colour(-8.0, down, -across),
        "top": colour(coarse[None, :], 5.0, coarse[:, None]),
    }


def test_the_faces_of_one_sky_match_along_all_eight_edges() -> None:
    edges = measures.sky_edges(sky())
    assert len(edges) == 8
    assert max(edges.values()) <= 2.0


@pytest.mark.parametrize(
    ("face", "part", "edge"),
    [
        ("north", np.s_[:, -1], "north-east"),
        ("west", np.s_[:, 0], "south-west"),
        ("south", np.s_[0], "south-top"),
        ("top", np.s_[:, -1], "east-top"),
    ],
)
def test_a_face_that_does_not_match_is_found(face: str, part: Any, edge: str) -> None:
    faces = sky()
    faces[face][part] += 20
    assert measures.sky_edges(faces)[edge] >= 18.0


def test_a_mirrored_face_is_found() -> None:
    faces = sky()
    faces["top"] = faces["top"][:, ::-1]
    assert max(measures.sky_edges(faces).values()) > 20.0


def sprite() -> np.ndarray:
    """Return a red and a green square on transparency, with bled colours, (24, 24, 4)."""
    rgba = np.zeros((24, 24, 4), np.uint8)
    rgba[:, :12] = (200, 20, 20, 0)
    rgba[:, 12:] = (20, 200, 20, 0)
    rgba[8:16, 4:8, 3] = rgba[8:16, 16:20, 3] = 255
    return rgba


def test_bled_colours_may_come_from_either_of_two_equally_near_texels() -> None:
    rgba = sprite()
    assert measures.count_unbled(rgba) == 0
    rgba[3, 11] = (200, 20, 20, 0)
    assert measures.count_unbled(rgba) == 0  # the red and the green square are equally near
    rgba[3, 11] = (20, 200, 20, 0)
    assert measures.count_unbled(rgba) == 1


def test_a_sprite_on_black_is_found() -> None:
    rgba = sprite()
    rgba[rgba[..., 3] == 0] = 0
    assert measures.count_unbled(rgba) == 24 * 24 - 64


def test_coverage_is_kept_for_a_disc_and_lost_for_scattered_dots() -> None:
    y, x = np.mgrid[0:512, 0:512]
    disc = np.zeros((512, 512, 4), np.uint8)
    disc[..., 3] = np.where(np.hypot(x - 256, y - 256) < 180, 255, 0)
    first, last = measures.coverage(disc)
    assert abs(last / first - 1) < 0.05
    dots = np.zeros((512, 512, 4), np.uint8)
    dots[4::12, 4::12, 3] = dots[5::12, 4::12, 3] = dots[4::12, 5::12, 3] = 255
    first, last = measures.coverage(dots)
    assert abs(last / first - 1) > 0.05


def test_a_jump_at_the_end_of_a_loop_is_found() -> None:
    frames = np.zeros((16, 8, 32, 4), np.uint8)
    frames[..., 3] = 255
    for k in range(16):
        frames[k, :, 2 * k : 2 * k + 2, :3] = 200
    assert measures.loop_steps(frames)[-1] <= measures.loop_steps(frames)[:-1].max()
    frames[15] = 255
    assert measures.loop_steps(frames)[-1] > measures.loop_steps(frames)[:-2].max()


def test_frames_are_cut_row_by_row() -> None:
    sheet = np.arange(16).reshape(4, 4).repeat(3, 0).repeat(3, 1)[..., None]
    cut = measures.frames(sheet, 4)
    assert cut.shape == (16, 3, 3, 1)
    assert (cut[:, 0, 0, 0] == np.arange(16)).all()


CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)


def test_a_closed_mesh_passes_and_a_hole_or_a_flipped_face_is_found() -> None:
    assert measures.open_edges(TETRAHEDRON) == 0
    assert measures.volume(CORNERS, TETRAHEDRON) == pytest.approx(1 / 6)
    assert measures.open_edges(TETRAHEDRON[:3]) == 3
    turned = TETRAHEDRON.copy()
    turned[3] = turned[3, ::-1]
    assert measures.open_edges(turned) > 0


def test_a_mesh_turned_inside_out_is_found() -> None:
    assert measures.volume(CORNERS, TETRAHEDRON[:, ::-1]) < 0


def test_normals_that_point_inward_are_found() -> None:
    regular = np.array([[1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1]], np.float32)
    assert measures.volume(regular, TETRAHEDRON) > 0
    normals = vertex_normals(regular, TETRAHEDRON)
    assert measures.flipped_normals(regular, TETRAHEDRON, normals) == 0.0
    assert measures.flipped_normals(regular, TETRAHEDRON, -normals) == 1.0


# ---- faults in files --------------------------------------------------------------------------


def failures(folder: Path, group: Any) -> set[tuple[str, str]]:
    """Return asset and measure of each check that fails with the files in ``folder``."""
    return {(f.asset, f.measure) for f in group(Assets(folder)) if not f.ok}


def save(pixels: np.ndarray, path: Path) -> None:
    Image.fromarray(pixels).save(path)


@pytest.mark.seldom(5)
def test_an_image_of_the_wrong_size_or_mode_is_found(tmp_path: Path) -> None:
    save(np.zeros((100, 100, 3), np.uint8), tmp_path / "blade.png")
    save(np.zeros((512, 512, 3), np.uint8), tmp_path / "plant.png")
    found = failures(tmp_path, checks.check_files)
    assert found == {("plant.png", "size"), ("blade.png", "size")}


@pytest.mark.seldom(10)
def test_exceeding_the_total_size_is_found(tmp_path: Path) -> None:
    shutil.copy(shipped() / "dragon.ply", tmp_path)
    with (tmp_path / "dragon.ply").open("ab") as file:
        file.write(bytes(checks.MAX_BYTES))
    assert failures(tmp_path, checks.check_files) == {("all", "bytes")}


def test_a_map_whose_path_is_short_is_found(tmp_path: Path) -> None:
    text = (shipped() / "flyover_alps.svg").read_text(encoding="utf-8")
    short = re.sub(r' d="[^"]*"', ' d="M 1,1 L 300,300"', text)
    (tmp_path / "flyover_alps.svg").write_text(short, encoding="utf-8")
    found = failures(tmp_path, checks.check_environments)
    assert found == {("flyover_alps.svg", "flight")}


def test_a_sprite_in_the_sea_is_found(tmp_path: Path) -> None:
    text = (shipped() / "avenue.csv").read_text(encoding="utf-8")
    (tmp_path / "avenue.csv").write_text(text + "birch,1,1,0.5,0.5,0\n", encoding="utf-8")
    assert failures(tmp_path, checks.check_places) == {("avenue.csv", "places")}


@pytest.mark.seldom(3, first=1)
def test_a_detail_that_darkens_is_found(tmp_path: Path) -> None:
    detail = np.asarray(Image.open(shipped() / "ground_detail.png").convert("RGB"))
    save((detail * 0.9).astype(np.uint8), tmp_path / "ground_detail.png")
    assert failures(tmp_path, checks.check_tiles) == {("ground_detail.png", "mean")}


@pytest.mark.seldom(7)
def test_a_horizon_without_the_fog_colour_is_found(tmp_path: Path) -> None:
    wall = np.asarray(Image.open(shipped() / "sky_north.png")).copy()
    wall[-1] += 9
    save(wall, tmp_path / "sky_north.png")
    assert failures(tmp_path, checks.check_sky) == {
        ("sky_*.png", "horizon"),
        ("sky_*.png", "edges"),
    }


@pytest.mark.seldom(13, first=1)
def test_a_step_along_an_edge_of_coded_sky_is_found_and_noise_of_coding_is_not(
    tmp_path: Path,
) -> None:
    wall = np.asarray(Image.open(shipped() / "sky_fair_north.jpg")).astype(int)
    noise = np.random.default_rng(1).integers(-5, 6, (*wall.shape[:2], 1))
    kept = tmp_path / "sky_fair_north.jpg"
    for off, found in ((noise, set()), (5, {"horizon", "edges"})):
        Image.fromarray(np.clip(wall + off, 0, 255).astype(np.uint8)).save(kept, "PNG")
        assert {measure for _, measure in failures(tmp_path, checks.check_sky)} == found


def test_different_heights_and_a_displaced_hill_are_found(tmp_path: Path) -> None:
    heights = np.asarray(Image.open(shipped() / "height16.png"))
    save(np.roll(heights, 20, axis=1), tmp_path / "height16.png")
    found = failures(tmp_path, checks.check_heights)
    assert found >= {("height.png", "agreement"), ("height16.png", "place")}
    raised = heights.copy()
    raised[0] = 30000
    save(raised, tmp_path / "height16.png")
    assert ("height16.png", "border") in failures(tmp_path, checks.check_heights)


def ply(vertices: np.ndarray, triangles: np.ndarray) -> bytes:
    rows = [f"{x} {y} {z}" for x, y, z in vertices.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    head = f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty float x\n"
    head += "property float y\nproperty float z\n"
    head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    return (head + "\n".join(rows) + "\n").encode()


@pytest.mark.seldom(3, first=1)
def test_every_fault_of_a_mesh_is_found(tmp_path: Path) -> None:
    (tmp_path / "rabbit.ply").write_bytes(ply(CORNERS, TETRAHEDRON[:, ::-1]))
    found = failures(tmp_path, checks.check_meshes)
    assert found >= {("rabbit.ply", name) for name in ("count", "winding", "centred")}
    vertices, triangles = read_ply(shipped() / "rabbit.ply")
    (tmp_path / "rabbit.ply").write_bytes(ply(vertices, triangles[1:]))
    found = failures(tmp_path, checks.check_meshes)
    assert found >= {("rabbit.ply", name) for name in ("watertight", "winding")}


@pytest.mark.seldom(3, first=1)
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_a_broken_file_is_a_finding_and_the_checks_continue(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    data = (shipped() / "fire.png").read_bytes()
    (tmp_path / "fire.png").write_bytes(data[: len(data) // 2])
    monkeypatch.setattr(checks, "CHECKS", (checks.check_files, checks.check_heights))
    assert report(tmp_path, as_json=False) == 1
    out = capsys.readouterr().out
    assert "FAIL" in out and "fire.png" in out and "1 of" in out
    assert "height16.png" in out  # the other checks were run


def test_the_exit_status_of_the_command_says_whether_a_check_failed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(checks, "CHECKS", (checks.check_heights,))
    assert main(["assets", "check"]) == 0
    assert "passed" in capsys.readouterr().out
    shutil.copy(shipped() / "map.png", tmp_path / "height.png")
    assert main(["assets", "check", "--json", "--assets", str(tmp_path)]) == 1
    assert '"ok": false' in capsys.readouterr().out
    assert main(["assets", "check", "--assets", str(tmp_path / "nowhere")]) == 2


# ---- building ---------------------------------------------------------------------------------


def pixels(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data))).astype(int)


@pytest.mark.parametrize("name", ["blade.png", "castle_light.png", "animal.png"])
@pytest.mark.sweep(3)
def test_a_rebuilt_asset_is_the_shipped_one(studio: Any, name: str) -> None:
    made, kept = studio.make(name), (shipped() / name).read_bytes()
    assert made == studio.make(name)
    if made != kept:
        # Another processor may round a sine differently; another zlib may compress differently.
        difference = np.abs(pixels(made) - pixels(kept))
        assert difference.max() <= 1 and (difference > 0).mean() < 1e-3


@pytest.mark.seldom(10, first=6)
def test_the_hall_s_light_was_baked_from_the_hall_as_it_is(
    studio: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from landscape.hall import plan
    from landscape.studio.hall import bake, light

    # The statue is the shipped dragon, which would take ten seconds to sculpt again.
    mesh = read_ply(shipped() / "dragon.ply")
    monkeypatch.setattr(light, "sculpted", lambda: (*mesh, None))
    with Image.open(shipped() / bake.FILE) as image:
        kept = image.info[studio.MADE_FROM]
    now = bake.baked_from()
    assert kept == now, "hall_light.png is stale: landscape assets build hall_light.png"
    moves = {"PILLAR": plan.PILLAR + 0.001, "TORCH": (*plan.TORCH[:2], 1.0), "STATUE_YAW": 1.0}
    for name, moved in moves.items():
        with monkeypatch.context() as changed:
            changed.setattr(plan, name, moved)
            assert bake.baked_from() != now, name


def test_what_an_asset_is_made_from_is_in_its_png_beside_the_pixels(studio: Any) -> None:
    pixels = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
    with Image.open(io.BytesIO(studio.encoded(pixels, made_from="0123abc"))) as image:
        assert image.info == {studio.MADE_FROM: "0123abc"}
        np.testing.assert_array_equal(np.asarray(image), pixels)
    with Image.open(io.BytesIO(studio.encoded(pixels))) as image:
        assert image.info == {}


def test_a_jpeg_keeps_its_colours_at_full_resolution(studio: Any) -> None:
    stripes = np.full((16, 16, 3), 200, np.uint8)
    stripes[:, ::2] = (200, 120, 200)
    off = np.abs(pixels(studio.jpeg(stripes)) - stripes)
    assert off.mean() < 8, "half the colours would be lost in columns of one texel"


@pytest.mark.seldom(13, first=3)
def test_two_processes_make_the_same_bytes_as_one(studio: Any) -> None:
    names = ["blade.png", "castle_light.png"]
    assert dict(studio.make_all(names)) == {name: studio.make(name) for name in names}


def test_the_error_for_an_unknown_asset_names_it(studio: Any, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="moon"):
        studio.build(["moon.png"], tmp_path, quiet=True)


def test_an_interrupted_build_leaves_only_complete_files(
    studio: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def make_all(
        names: list[str], executor: Executor | None, jobs: int
    ) -> Iterator[tuple[str, bytes]]:
        yield names[0], b"whole"
        raise KeyboardInterrupt

    monkeypatch.setattr(studio, "make_all", make_all)
    with pytest.raises(KeyboardInterrupt):
        studio.build(["blade.png", "fire.png"], tmp_path, quiet=True)
    assert [path.name for path in tmp_path.iterdir()] == ["blade.png"]
    assert (tmp_path / "blade.png").read_bytes() == b"whole"


@pytest.mark.parametrize("step", ["chmod", "replace"])
def test_an_interrupted_write_keeps_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: str
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    path = tmp_path / "blade.png"
    path.write_bytes(b"old")
    monkeypatch.setattr(os, step, interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, b"new")
    assert [p.name for p in tmp_path.iterdir()] == ["blade.png"]
    assert path.read_bytes() == b"old"


@pytest.mark.seldom(13, first=3)
@pytest.mark.posix_only("nothing sends Ctrl-C to one process alone")
def test_a_build_interrupted_by_the_user_ends_at_once_and_leaves_nothing(
    studio: Any, tmp_path: Path
) -> None:
    words = ["assets", "build", "sky_north.png", "fire.png", "--assets", tmp_path / "made"]
    with running(*words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        deadline = time.monotonic() + SECONDS
        while not (tmp_path / "made").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        time.sleep(1.0)  # the pool is starting or working
        os.killpg(process.pid, signal.SIGINT)
        _, error = process.communicate(timeout=SECONDS)
    assert process.returncode == 130
    assert error.splitlines() == ["landscape: interrupted"]
    assert list((tmp_path / "made").iterdir()) == []
