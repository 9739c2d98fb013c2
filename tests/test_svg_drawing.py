"""Height maps drawn in Inkscape with shapes, and points to look at that are no circles."""

import base64
import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from framelens.base.errors import InputError
from landscape.files import svg_drawing
from landscape.files.svg_environment import read

PATH = '<path d="M 10,40 C 20,20 40,20 60,40"/>'
CIRCLE = '<circle cx="32" cy="32" r="16" style="fill:#000"/>'


def file(folder: Path, drawing: str, flight: str = PATH, targets: str = "", size: str = "") -> Path:
    """Write an environment: what is drawn on the map, on the layer camera, and on targets."""
    path = folder / "drawn.svg"
    size = size or 'width="64" height="64" viewBox="0 0 64 64"'
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" {size}>'
        f"<g>{drawing}</g>"
        f'<g inkscape:groupmode="layer" inkscape:label="Camera">{flight}</g>'
        f'<g inkscape:groupmode="layer" inkscape:label="targets">{targets}</g></svg>'
    )
    return path


def image(value: int = 100, more: str = "") -> str:
    buffer = io.BytesIO()
    Image.fromarray(np.full((64, 64), value, np.uint8)).save(buffer, "PNG")
    link = base64.b64encode(buffer.getvalue()).decode()
    return f'<image width="64" height="64" xlink:href="data:image/png;base64,{link}" {more}/>'


def needs_resvg() -> None:
    if svg_drawing.rasteriser() is None:
        pytest.skip("the extra svg is not installed")


@pytest.fixture
def without(monkeypatch: pytest.MonkeyPatch) -> None:
    """No package that draws."""
    monkeypatch.setattr(svg_drawing, "rasteriser", lambda: None)


def test_without_the_extra_a_drawn_map_is_refused_by_a_line_that_says_what_helps(
    without: None, tmp_path: Path
) -> None:
    with pytest.raises(InputError) as caught:
        read(file(tmp_path, CIRCLE))
    said = str(caught.value)
    assert "landscape-gl[svg]" in said and "File > Export" in said and "\n" not in said


@pytest.mark.parametrize(
    ("drawing", "what"),
    [
        (image() + CIRCLE, "shapes over the height image: left out"),
        (
            image(more='opacity="0.5"') + CIRCLE,
            "shapes over the height image and the height image's opacity",
        ),
        (image(more='opacity="0.5"'), "the height image's opacity"),
        (image(more='style="opacity:50%"'), "the height image's opacity"),
        (f'<g opacity="0.5">{image()}</g>', "the height image's opacity"),
    ],
)
def test_without_the_extra_an_image_is_taken_alone_with_a_notice(
    without: None, drawing: str, what: str, tmp_path: Path
) -> None:
    found = read(file(tmp_path, drawing))
    assert (found.image == 100).all()
    (notice,) = found.notices
    assert what in notice and "left out" in notice


@pytest.mark.parametrize(
    "drawing", [image(), image(more='opacity="1"'), image() + "<text>A</text>"]
)
def test_an_image_alone_is_taken_as_it_is(drawing: str, tmp_path: Path) -> None:
    found = read(file(tmp_path, drawing))
    assert (found.image == 100).all() and found.notices == ()


def test_hidden_shapes_and_those_of_the_flight_are_no_part_of_the_map(
    without: None, tmp_path: Path
) -> None:
    hidden = f'<g style="display:none">{CIRCLE}</g>'
    assert read(file(tmp_path, image() + hidden, targets=CIRCLE)).notices == ()


def test_shapes_gradients_and_blur_make_a_map(tmp_path: Path) -> None:
    needs_resvg()
    drawing = (
        '<defs><linearGradient id="g"><stop offset="0" stop-color="#000"/>'
        '<stop offset="1" stop-color="#fff"/></linearGradient></defs>'
        '<rect width="64" height="32" fill="url(#g)"/>' + CIRCLE.replace("32", "48")
    )
    found = read(file(tmp_path, drawing))
    assert found.image.shape == (512, 512)
    top = found.image[40]
    assert (np.diff(top) >= 0).all() and top[4] < 10 and top[-4] > 245
    assert found.image[384, 384] == 0 and found.image[500, 20] == 255
    # The path is not drawn, and its places are those of the picture's pixels.
    assert found.subpaths[0][0, 0].tolist() == [80.0, 320.0]
    assert (found.image[256:330, 70:90] == 255).all()


def test_a_page_that_is_not_square_becomes_a_picture_of_powers_of_two(tmp_path: Path) -> None:
    needs_resvg()
    size = 'width="297mm" height="140mm" viewBox="0 0 297 140"'
    path = '<path d="M 10,10 L 290,130"/>'
    found = read(file(tmp_path, CIRCLE, path, size=size))
    assert found.image.shape == (256, 512)
    assert found.subpaths[0][0, 0] == pytest.approx((10 / 297 * 512, 10 / 140 * 256), abs=1e-6)
    assert found.image[round(32 / 140 * 256), round(32 / 297 * 512)] == 0


def test_shapes_over_an_image_and_its_opacity_are_drawn(tmp_path: Path) -> None:
    needs_resvg()
    found = read(file(tmp_path, image() + CIRCLE))
    assert found.image.shape == (64, 64) and found.notices == ()
    assert found.image[32, 32] == 0 and found.image[4, 4] == 100
    pale = read(file(tmp_path, image(more='opacity="0.5"'))).image
    assert pale == pytest.approx(177.5, abs=1.5)


@pytest.mark.parametrize(
    ("shape", "middle"),
    [
        ('<rect x="10" y="20" width="8" height="4"/>', (14.0, 22.0)),
        (
            '<path sodipodi:type="star" sodipodi:cx="30" sodipodi:cy="9" d="M 1,1 2,2 1,3 Z"/>',
            (30, 9),
        ),
        ('<g transform="translate(5,6)"><rect width="2" height="2"/></g>', (6.0, 7.0)),
    ],
)
def test_rectangles_and_stars_are_points_to_look_at(
    shape: str, middle: tuple[float, float], tmp_path: Path
) -> None:
    on_camera = read(file(tmp_path, image(), PATH + shape))
    on_targets = read(file(tmp_path, image(), targets=shape))
    for found in (on_camera, on_targets):
        assert found.targets == pytest.approx(np.array([middle]))
        assert len(found.subpaths) == 1


def test_a_path_is_a_point_to_look_at_on_its_own_layer_only(tmp_path: Path) -> None:
    path = '<path d="M 10,10 L 20,10 L 20,16 L 10,16 Z"/>'
    assert read(file(tmp_path, image(), targets=path)).targets.tolist() == [[15.0, 13.0]]
    found = read(file(tmp_path, image(), PATH + path))
    assert len(found.targets) == 0 and len(found.subpaths) == 2
