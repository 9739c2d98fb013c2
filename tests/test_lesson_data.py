"""The data of the lessons: each file can be made again from the assets and from code."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from landscape.studio.lessons.lesson_data import DATA, FONT, MAKERS, main, sky
from landscape.studio.lessons.planet import planet
from landscape.studio.lessons.teapot import patches


def test_every_file_has_a_maker_and_all_are_small() -> None:
    files = [path for path in DATA.iterdir() if path.is_file()]
    assert {path.name for path in files} == set(MAKERS)
    assert sum(path.stat().st_size for path in files) < 500_000


SLOW = ("planet.png", "sky.jpg")  # of these only small ones are made


@pytest.mark.parametrize("name", [name for name in MAKERS if name not in SLOW])
@pytest.mark.sweep(3)
def test_a_file_is_made_again_as_it_is(name: str) -> None:
    if name == "letters.png" and not _has_font():
        pytest.skip(f"the font {FONT[0]} is not installed")
    if name == "rabbit.ply":
        pytest.importorskip("fast_simplification", reason="the extra `studio` is not installed")
    made, kept = MAKERS[name](), (DATA / name).read_bytes()
    if name.endswith((".ply", ".txt")):
        assert made == kept
        return
    ours, theirs = (_texels(each) for each in (made, kept))
    assert ours.shape == theirs.shape
    # Other versions of Pillow may choose other palettes and round elsewhere.
    assert np.abs(ours - theirs).mean() < 1 and (np.abs(ours - theirs) > 24).mean() < 0.002


def test_the_planet_and_the_sky_are_made_again_as_they_are() -> None:
    for made, name in (
        (np.roll(planet(64), 64, axis=1), "planet.png"),
        (_texels(sky(32))[..., :3], "sky.jpg"),
    ):
        height, width = made.shape[:2]
        kept = Image.open(DATA / name).convert("RGB").resize((width, height), Image.Resampling.BOX)
        assert np.abs(made - np.asarray(kept).astype(float)).mean() < 8, name
        flipped = np.abs(made[:, ::-1] - np.asarray(kept).astype(float)).mean()
        assert flipped > 12, name


def _has_font() -> bool:
    from PIL import ImageFont

    try:
        ImageFont.truetype(*FONT)
    except OSError:
        return False
    return True


def _texels(data: bytes) -> np.ndarray:
    image = Image.open(io.BytesIO(data))
    if image.mode.startswith("I"):
        return np.asarray(image).astype(float) / 257
    return np.asarray(image.convert("RGBA")).astype(float)


def test_files_are_written_where_they_are_wanted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["water.png", "--out", str(tmp_path / "new")]) == 0
    assert (tmp_path / "new" / "water.png").stat().st_size > 1000
    assert capsys.readouterr().out.strip() == str(tmp_path / "new" / "water.png")
    with pytest.raises(InputError, match=r"expected one of brick\.png"):
        main(["no.png"])
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="--out"):
        main(["water.png", "--out", str(tmp_path / "file" / "x")])


def test_the_teapot_is_symmetric_and_the_normals_of_its_patches_point_outwards() -> None:
    points = patches()
    assert points.shape == (32, 4, 4, 3)
    mirrored = {tuple(point) for point in (points.reshape(-1, 3) * (1, 1, -1)).round(4) + 0.0}
    assert mirrored == {tuple(point) for point in points.reshape(-1, 3).round(4) + 0.0}
    weights, slopes = np.array((1, 3, 3, 1)) / 8, np.array((-3, -3, 3, 3)) / 4  # at the middle
    middles = np.einsum("i,j,pijk->pk", weights, weights, points)
    along_u = np.einsum("i,j,pijk->pk", slopes, weights, points)
    along_v = np.einsum("i,j,pijk->pk", weights, slopes, points)
    normals = np.cross(along_u, along_v)
    body = slice(4, 12)  # the sides, away from the axis
    assert (np.sum(normals[body] * middles[body] * (1, 0, 1), 1) > 0).all()
    assert (normals[16:20, 1] > 0).all() and (normals[20:24, 1] < 0).all(), "lid and bottom"
    assert (normals[24:, 2] * middles[24:, 2] > 0).all(), "both sides of handle and spout"
