"""Textures: rows, mip levels that keep a sprite's coverage, wrapping, ownership."""

import numpy as np
import pictures
import pytest
from PIL import Image
from stage import Stage, close, live_names, quad, small

from framelens.gl.seam import gl, recording
from framelens.gl.state import attrib
from framelens.gl.texture import Texture, halves_evenly, mip_levels
from landscape.files.images import mip_chain, read_image
from landscape.frame import Pose

SCREEN = np.array([(-4.0, -3.0, -5.196), (4, -3, -5.196), (4, 3, -5.196), (-4, 3, -5.196)])
"""The quad that fills the 4:3 target at a field of view of 60 degrees."""


def shown(stage: Stage, texture: Texture, corners: np.ndarray = SCREEN) -> np.ndarray:
    """Return the picture of a quad that fills the screen, s to the right, t upward."""
    with stage.frame(small(), Pose(0.0, 0.0, 0.0)):
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT):
            gl.glEnable(gl.GL_TEXTURE_2D)
            texture.bind()
            quad(corners)
        picture = stage.read()
    texture.release()
    return picture


def noise(h: int, w: int, channels: int) -> np.ndarray:
    return np.random.default_rng(1).integers(0, 256, (h, w, channels), dtype=np.uint8)


@pytest.mark.seldom(3, first=2)
@pytest.mark.parametrize(("h", "w"), [(6, 8), (3, 5), (5, 7)])
@pytest.mark.parametrize("channels", [3, 4])
def test_at_any_size_every_texel_lands_in_its_place_with_row_0_at_t_0(
    stage: Stage, h: int, w: int, channels: int
) -> None:
    image = noise(h, w, channels)
    picture = shown(stage, Texture(image, repeat=False))
    for row in range(h):
        for column in range(w):
            # Linear filtering is exact at a texel's centre; a pixel's centre is near enough to
            # it for a few levels times the contrast.
            x, y = (column + 0.5) / w * 160, 120 - (row + 0.5) / h * 120
            got = picture[min(int(y), 119), int(x)]
            assert close(got, image[row, column, :3], 12), (row, column)


def test_clamping_keeps_out_the_opposite_border_and_repeating_lets_it_in(stage: Stage) -> None:
    image = np.zeros((4, 4, 3), np.uint8)
    image[:, 3] = 255  # the right column is white
    clamped = shown(stage, Texture(image, repeat=False))
    repeated = shown(stage, Texture(image, repeat=True))
    assert clamped[60, 0].max() == 0
    assert repeated[60, 0].min() > 100


def driver_levels(image: np.ndarray) -> list[np.ndarray]:
    """Return the mip levels that OpenGL makes of an image."""
    name, (height, width, channels) = gl.glGenTextures(1), image.shape
    form = gl.GL_RGB if channels == 3 else gl.GL_RGBA
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_GENERATE_MIPMAP, gl.GL_TRUE)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, form, width, height, 0, form, gl.GL_UNSIGNED_BYTE, image)
    levels = []
    for level in range(max(height, width).bit_length()):
        shape = max(height >> level, 1), max(width >> level, 1), channels
        read = gl.glGetTexImage(gl.GL_TEXTURE_2D, level, form, gl.GL_UNSIGNED_BYTE)
        levels.append(np.frombuffer(read, np.uint8).reshape(shape))
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
    gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 4)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    gl.glDeleteTextures(np.array([name], np.uint32))
    return levels


@pytest.mark.parametrize("shape", [(64, 64, 3), (32, 128, 4), (256, 8, 3), (1, 16, 4)])
def test_the_mip_levels_are_those_that_the_driver_would_make(
    stage: Stage, shape: tuple[int, ...]
) -> None:
    image = noise(*shape)
    ours, wanted = mip_levels(image), driver_levels(image)
    assert len(ours) == len(wanted)
    exact = pictures.same_renderer()
    for level, (got, expected) in enumerate(zip(ours, wanted, strict=True)):
        # A driver that rounds to the nearest is off by half a level of 255 at each mip level. One
        # that filters in floating point (Mesa 26) is off from the mean of four by up to one more.
        assert got.shape == expected.shape, level
        assert close(got, expected, 0 if exact or level == 0 else level + 1), level
        assert abs(np.mean(got.astype(float) - expected)) <= 0.5 * level + 0.1, level


def test_the_driver_is_not_asked_for_mip_levels_where_the_sides_are_powers_of_two(
    stage: Stage,
) -> None:
    with recording() as recorder:
        Texture(noise(64, 32, 3)).release()
        assert "GL_GENERATE_MIPMAP" not in str([call.args for call in recorder.calls])
    assert not halves_evenly(noise(64, 96, 3)) and halves_evenly(noise(1, 2, 3))


@pytest.mark.parametrize("side", [64, 96])
def test_far_away_a_texture_shows_its_mean(stage: Stage, side: int) -> None:
    image = np.zeros((side, side, 3), np.uint8)
    image[::2, ::2] = image[1::2, 1::2] = 200  # a fine chequered pattern
    picture = shown(stage, Texture(image), SCREEN * (0.05, 0.05, 1.0))
    assert close(picture[58:62, 78:82], 100, 3)


@pytest.mark.parametrize("side", [64, 96])
def test_far_away_a_texture_whose_image_was_replaced_shows_the_mean_of_the_new_one(
    stage: Stage, side: int
) -> None:
    texture = Texture(np.zeros((side, side, 3), np.uint8))
    texture.replace(np.full((side, side, 3), 120, np.uint8))
    picture = shown(stage, texture, SCREEN * (0.05, 0.05, 1.0))
    assert close(picture[58:62, 78:82], 120, 1)


def test_given_mip_levels_are_used_as_they_are(stage: Stage) -> None:
    levels = [np.full((64 >> k, 64 >> k, 3), 40 * k, np.uint8) for k in range(5)]
    picture = shown(stage, Texture(levels), SCREEN * (0.01, 0.01, 1.0))
    assert close(picture[60, 80], 160)  # level 4, the last one given, though smaller would fit


def test_two_mip_levels_are_interpolated_or_the_nearer_one_is_used(stage: Stage) -> None:
    # 340 texels on 120 pixels: half-way between level 1 and level 2.
    levels = [np.full((340 >> k, 340 >> k, 3), 28 * k, np.uint8) for k in range(9)]
    mixed = shown(stage, Texture(levels))[60, 80]
    assert 30 < mixed[0] < 54
    nearer = shown(stage, Texture(levels, trilinear=False))
    assert set(np.unique(nearer)) <= {28, 56}
    sharper = shown(stage, Texture(levels, trilinear=False, lod_bias=-1.0))
    assert set(np.unique(sharper)) <= {0, 28} and (sharper < nearer).all()


def test_making_a_texture_leaves_the_bound_one_bound(stage: Stage) -> None:
    first = Texture(noise(4, 4, 3))
    first.bind()
    second = Texture(noise(4, 4, 3))
    assert int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D)) == first.name
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    first.release()
    second.release()


def test_releasing_twice_deletes_once_and_spares_other_textures(stage: Stage) -> None:
    before = live_names()
    one = Texture(noise(4, 4, 3))
    one.release()
    assert one.name == 0, "another texture may get the name"
    two = Texture(noise(4, 4, 3))
    one.release()
    assert gl.glIsTexture(two.name)
    two.release()
    assert live_names() == before


def disc(size: int = 64, soft: float = 2.0) -> np.ndarray:
    """Return a green sprite, a disc with a soft edge, on transparent magenta."""
    y, x = np.mgrid[0:size, 0:size] - (size - 1) / 2
    alpha = np.clip((0.35 * size - np.hypot(x, y)) / soft + 0.5, 0, 1)
    image = np.zeros((size, size, 4), np.uint8)
    image[..., :3] = np.where(alpha[..., None] > 0, (30, 200, 40), (255, 0, 255))
    image[..., 3] = (alpha * 255).astype(np.uint8)
    return image


def test_each_mip_level_is_half_as_large_and_the_first_is_the_image() -> None:
    chain = mip_chain(disc(), 5)
    assert [level.shape for level in chain] == [(64 >> k, 64 >> k, 4) for k in range(5)]
    assert (chain[0] == disc()).all()
    assert len(mip_chain(disc(8), 9)) == 4


def test_mip_levels_cover_as_much_as_the_sprite() -> None:
    rng = np.random.default_rng(2)
    twigs = disc()
    twigs[..., 3] = 255 * rng.random((64, 64)) ** 2  # thin: by averaging alone all would vanish
    wanted = (twigs[..., 3] > 127).mean()
    for level in mip_chain(twigs, 4)[1:]:
        assert (level[..., 3] > 127).mean() == pytest.approx(wanted, abs=0.05)


def test_no_colour_of_transparent_texels_leaks_into_a_mip_level() -> None:
    for level in mip_chain(disc(), 5):
        visible = level[level[..., 3] > 8]
        assert close(visible[:, :3], (30, 200, 40), 2)


def test_a_sprite_with_hard_edges_stays_opaque_in_all_levels() -> None:
    solid = np.full((64, 64, 4), 255, np.uint8)
    solid[:16, :, 3] = 0
    for level in mip_chain(solid, 4):
        assert set(np.unique(level[..., 3])) == {0, 255}


def test_palette_and_grey_images_are_read_as_colours(tmp_path) -> None:
    grey = Image.fromarray(np.array([[0, 128], [200, 255]], np.uint8))
    grey.save(tmp_path / "grey.png")
    grey.convert("P").save(tmp_path / "palette.png")
    for name in ("grey.png", "palette.png"):
        image = read_image(tmp_path / name, "RGB")
        assert image.shape == (2, 2, 3) and image[..., 0].tolist() == [[0, 128], [200, 255]]
    assert read_image(tmp_path / "grey.png").shape == (2, 2, 4)


def test_a_16_bit_image_is_scaled_to_8(tmp_path) -> None:
    Image.fromarray(np.array([[0, 65535, 32896]], np.uint16)).save(tmp_path / "deep.png")
    assert read_image(tmp_path / "deep.png", "RGB")[0, :, 1].tolist() == [0, 255, 128]
