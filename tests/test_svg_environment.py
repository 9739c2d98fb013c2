"""Environment files: what is read from an SVG, and what is refused in one line."""

import gzip
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest
from environments import embedded, image, layer, path, png, svg, written
from PIL import Image

from framelens.base.errors import InputError
from landscape.files.svg_environment import read

LINE = "M 10,20 L 40,50"
CIRCLE = '<circle cx="12" cy="40" r="2"/>'


def refused(folder: Path, text: str) -> str:
    """Return the line with which a file is refused, without its path."""
    file = written(folder, text)
    with warnings.catch_warnings(), pytest.raises(InputError) as caught:
        warnings.simplefilter("error")
        read(file)
    line = str(caught.value)
    assert line.startswith(f"{file}: ") and "\n" not in line
    return line.removeprefix(f"{file}: ")


def ends(folder: Path, camera: str, more: str = "", before: str = image()) -> np.ndarray:
    """Return where the only curve of a camera's layer starts and ends, in pixels."""
    arguments = {"more": more} if more else {}
    found = read(written(folder, svg(before, layer(camera), **arguments)))
    return found.subpaths[0][[0, -1], [0, -1]]


def test_an_environment_has_an_image_a_path_and_targets(tmp_path: Path) -> None:
    found = read(written(tmp_path, svg(image(), layer(path() + CIRCLE)), "valley.svg"))
    assert found.name == "valley"
    assert found.image.shape == (64, 64) and found.image.dtype == np.float32
    assert (found.image[:, 0] == 250).all() and (found.image[:, -1] == 5).all()
    assert [each.shape for each in found.subpaths] == [(2, 4, 2)]
    np.testing.assert_allclose(found.subpaths[0][0], [(10, 32), (10, 10), (54, 10), (54, 32)])
    # The control point of the smooth segment is the mirror image of the one before.
    np.testing.assert_allclose(found.subpaths[0][1], [(54, 32), (54, 54), (10, 54), (10, 32)])
    np.testing.assert_allclose(found.targets, [(12, 40)])


def test_targets_may_be_on_a_layer_of_their_own_and_keep_their_order(tmp_path: Path) -> None:
    old = '<path sodipodi:type="arc" sodipodi:cx="5" sodipodi:cy="6" d="M 7,6 a 2,2 0 1 1 -4,0"/>'
    inside = CIRCLE + '<ellipse cx="50%" cy="25%" rx="1" ry="3"/>' + old
    found = read(written(tmp_path, svg(image(), layer(path()), layer(inside, "Targets"))))
    np.testing.assert_allclose(found.targets, [(12, 40), (32, 16), (5, 6)])


def test_circles_elsewhere_and_paths_elsewhere_are_no_part_of_the_flight(tmp_path: Path) -> None:
    other = layer(path("M 0 0 L 9 9") + CIRCLE, "notes")
    found = read(written(tmp_path, svg(image(), CIRCLE, other, layer(path(LINE)))))
    assert len(found.subpaths) == 1 and found.targets.shape == (0, 2)


def test_transforms_of_groups_and_of_the_path_apply_from_the_inside_out(tmp_path: Path) -> None:
    inner = path("M 1,2 L 4,5", 'transform="translate(10,20)"')
    moved = f'<g transform="scale(2)"><g transform="rotate(90)">{inner}</g></g>'
    # (1, 2) -> (11, 22) -> (-22, 11) -> (-44, 22).
    np.testing.assert_allclose(ends(tmp_path, moved), [(-44, 22), (-50, 28)], atol=1e-9)


def test_places_are_in_the_images_pixels_wherever_the_image_stands(tmp_path: Path) -> None:
    placed = image(more='x="100" y="200" width="640" height="320" transform="translate(5,5)"')
    line = path("M 105,205 L 745,525")
    np.testing.assert_allclose(ends(tmp_path, line, before=placed), [(0, 0), (64, 64)], atol=1e-9)


def test_an_image_that_keeps_its_proportions_is_centred_in_its_rectangle(tmp_path: Path) -> None:
    placed = image(more='width="128" height="64"').replace(' preserveAspectRatio="none"', "")
    np.testing.assert_allclose(ends(tmp_path, path(LINE), before=placed), [(-22, 20), (8, 50)])


def test_units_and_the_view_box_do_not_displace_the_path(tmp_path: Path) -> None:
    # A document in millimetres: 64 user units are 64 mm, and an image of 128 px is 33.87 of them.
    page = 'width="64mm" height="64mm" viewBox="0 0 64 64"'
    in_mm = image(more='width="16mm" height="16mm"')  # 16 * 96 / 25.4 = 60.47 user units
    found = ends(tmp_path, path("M 0,0 L 60.4724,30.2362"), page, in_mm)
    np.testing.assert_allclose(found, [(0, 0), (64, 32)], atol=1e-3)
    half = image(more='width="50%" height="50%"')
    np.testing.assert_allclose(
        ends(tmp_path, path("M 0,0 L 32,16"), page, half), [(0, 0), (64, 32)]
    )


def test_an_inner_svg_has_a_view_box_of_its_own(tmp_path: Path) -> None:
    inner = (
        f'<svg x="4" y="8" width="20" height="20" viewBox="0 0 10 10">{path("M 0,0 L 5,5")}</svg>'
    )
    np.testing.assert_allclose(ends(tmp_path, inner), [(4, 8), (14, 18)])


@pytest.mark.parametrize(
    ("data", "middle"),
    [
        ("M 10,10 30,10", (20, 10)),
        ("m 10,10 h 20", (20, 10)),
        ("M 10,10 Q 20,30 30,10", (20, 20)),
        ("M 10,10 A 10,10 0 0 1 30,10", (20, 0)),
        ("m10-2e1c0,0,20,0,20,0", (20, -20)),
    ],
)
def test_every_kind_of_segment_becomes_cubics(tmp_path: Path, data: str, middle: tuple) -> None:
    from landscape.geometry.bezier import BezierPath

    found = read(written(tmp_path, svg(image(), layer(path(data)))))
    flown = BezierPath(found.subpaths)
    np.testing.assert_allclose(flown.at(flown.length / 2), middle, atol=2e-3)


def test_other_shapes_than_paths_are_flown_as_well(tmp_path: Path) -> None:
    shapes = '<line x1="1" y1="2" x2="3" y2="4"/><polyline points="5,6 7,8 9,6"/>'
    shapes += '<polygon points="1 1 5 1 5 5"/>'
    found = read(written(tmp_path, svg(image(), layer(shapes))))
    assert [len(each) for each in found.subpaths] == [1, 2, 3]


def test_several_parts_of_a_path_and_several_paths_follow_one_another(tmp_path: Path) -> None:
    two = path("m 1,1 2,0 m 10,10 0,3") + path("M 30,30 H 40")
    found = read(written(tmp_path, svg(image(), layer(two))))
    starts = [each[0, 0].tolist() for each in found.subpaths]
    assert starts == [[1, 1], [13, 11], [30, 30]]


def test_hidden_layers_are_flown_but_a_hidden_image_is_not_the_map(tmp_path: Path) -> None:
    hidden = layer(path(LINE), more='style="display:none"')
    other = f'<g style="display: none">{image(embedded(png(32)))}</g>'
    found = read(written(tmp_path, svg(other, image(), hidden)))
    assert found.image.shape == (64, 64) and len(found.subpaths) == 1


def test_an_image_may_be_linked_in_the_same_folder_or_below_it(tmp_path: Path) -> None:
    (tmp_path / "my maps").mkdir()
    (tmp_path / "my maps" / "a.png").write_bytes(png(32))
    for link in ("my maps/a.png", "./my%20maps/a.png", f"file://{tmp_path}/my%20maps/a.png"):
        found = read(written(tmp_path, svg(image(link), layer(path()))))
        assert found.image.shape == (32, 32)


def test_sixteen_bits_keep_their_precision_and_transparent_pixels_are_white(tmp_path: Path) -> None:
    deep = np.full((8, 8), 1000, np.uint16)
    Image.fromarray(deep).save(tmp_path / "deep.png")
    found = read(written(tmp_path, svg(image("deep.png"), layer(path()))))
    np.testing.assert_allclose(found.image, 1000 / 257)
    clear = np.zeros((8, 8, 4), np.uint8)
    clear[:4, :, 3] = 255
    Image.fromarray(clear).save(tmp_path / "clear.png")
    found = read(written(tmp_path, svg(image("clear.png"), layer(path()))))
    assert (found.image[:4] == 0).all() and (found.image[4:] == 255).all()


def test_a_doctype_without_declarations_is_accepted(tmp_path: Path) -> None:
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://example.org/svg11.dtd">'
    text = svg(image(), layer(path())).replace("?><svg", f"?>{doctype}<svg")
    assert len(read(written(tmp_path, text)).subpaths) == 1


BOMB = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 10))
HUGE = 'transform="scale(1e300)"'
DECLARATIONS = "expected an SVG file without declarations in a DTD"
LARGE = "too large, expected at most 20000 elements, and 100 one in another"
ONE_POINT = 'expected a path of more than one point on the layer "camera"'
OUTSIDE = "<image>: expected an embedded image or a file in the same folder, not "
NO_IMAGE = "embedded image: expected an image such as PNG"
WRONG = {
    "nothing": ("", "expected an SVG file (no element found: line 1, column 0)"),
    "text": ("hello", "expected an SVG file (syntax error: line 1, column 0)"),
    "html": ("<html><svg/></html>", "expected an SVG file, with <svg> as its outermost element"),
    "cut off": (svg(image())[:-9], "expected an SVG file ("),
    "encoding of several bytes": (
        '<?xml version="1.0" encoding="utf-7"?><svg/>',
        "expected an SVG file (multi-byte encodings are not supported)",
    ),
    "unknown encoding": (
        '<?xml version="1.0" encoding="no-such"?><svg/>',
        "expected an SVG file (",
    ),
    "no prefix": (
        "<svg><g inkscape:label='camera'/></svg>",
        "expected an SVG file (unbound prefix",
    ),
    "entity bomb": (f'<!DOCTYPE svg [<!ENTITY a0 "ha">{BOMB}]><svg>&a9;</svg>', DECLARATIONS),
    "entity of a file": (
        '<!DOCTYPE svg [<!ENTITY x SYSTEM "/etc/passwd">]><svg>&x;</svg>',
        DECLARATIONS,
    ),
    "deep": ("<svg>" + "<g>" * 300 + "</g>" * 300 + "</svg>", LARGE),
    "wide": ("<svg>" + "<g/>" * 30_000 + "</svg>", LARGE),
    "no layer": (svg(image(), path()), 'expected a layer "camera", with the camera\'s path'),
    "an id is no name": (svg(image(), f'<g id="camera">{path()}</g>'), 'expected a layer "camera"'),
    "no path": (svg(image(), layer(CIRCLE)), ONE_POINT),
    "one point": (svg(image(), layer(path("M 5,5"))), ONE_POINT),
    "one place": (svg(image(), layer(path("M 5,5 L 5,5 Z"))), ONE_POINT),
    "a clone": (
        svg(image(), layer('<use xlink:href="#p"/>')),
        ONE_POINT + "; a clone must be unlinked first",
    ),
    "no image": (svg(layer(path())), "expected the height image, embedded or linked"),
    "no number": (
        svg(image(), layer(path("M 0,0 L nan,3"))),
        "expected the data of a path, not 'M 0,0 L nan,3'",
    ),
    "half a point": (svg(image(), layer(path("M 0,0 L 3"))), "expected the data of a path"),
    "no start": (svg(image(), layer(path("L 3,3 4,4"))), "expected the data of a path"),
    "infinite": (svg(image(), layer(path("M 0,0 L 1e999,3"))), "expected finite coordinates"),
    "very far": (
        svg(image(), layer(path("M 0,0 L 1e200,3"))),
        "expected coordinates of at most 1e+09 pixels",
    ),
    "overflow": (
        svg(image(), layer(layer(path(LINE), more=HUGE), more=HUGE)),
        "expected finite coordinates",
    ),
    "transform that there is not": (
        svg(image(), layer(path(), more='transform="evil(1)"')),
        "expected a transform, not 'evil(1)'",
    ),
    "transform to nowhere": (
        svg(image(more='transform="translate(nan)"'), layer(path())),
        "expected a transform, not 'translate(nan)'",
    ),
    "transform": (
        svg(image(), layer(path(), more='transform="matrix(1 2 3)"')),
        "expected a transform, not 'matrix(1 2 3)'",
    ),
    "flat image": (
        svg(image(more='width="64" height="64" transform="scale(1,0)"'), layer(path())),
        "<image>: expected a transform that leaves the image an area",
    ),
    "image without width": (
        svg(image(more='width="0" height="3"'), layer(path())),
        "<image>: expected a width and a height above 0",
    ),
    "length": (
        svg(image(more='width="wide" height="64"'), layer(path())),
        "<image>, width: expected a length, not 'wide'",
    ),
    "view box": (svg(image(), layer(path()), more='viewBox="0 0 nan 5"'), "expected a viewBox of"),
    "missing link": (svg(image("gone.png"), layer(path())), "linked image "),
    "link to the web": (svg(image("http://example.org/a.png"), layer(path())), "linked image "),
    "link above": (svg(image("../a.png"), layer(path())), OUTSIDE + "'../a.png'"),
    "link elsewhere": (svg(image("/dev/zero"), layer(path())), OUTSIDE),
    "link to nothing": (svg("<image/>", layer(path())), OUTSIDE),
    "link to itself": (svg(image("map.svg"), layer(path())), "linked image "),
    "no base64": (
        svg(image("data:image/png,abc"), layer(path())),
        "<image>: expected data in base64",
    ),
    "damaged image": (svg(image(embedded(png()[:60])), layer(path())), NO_IMAGE),
    "no such image": (svg(image(embedded(b"<svg/>")), layer(path())), NO_IMAGE),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_with_a_file_is_said_in_one_line(tmp_path: Path, name: str) -> None:
    text, expected = WRONG[name]
    assert refused(tmp_path, text).startswith(expected)


def test_a_file_that_is_compressed_missing_or_a_folder_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "map.svgz"
    file.write_bytes(gzip.compress(svg().encode()))
    for wrong in (file, tmp_path / "gone.svg", tmp_path):
        with pytest.raises(InputError, match=r"compressed|cannot be read"):
            read(wrong)


@pytest.mark.seldom(14, first=5)
@pytest.mark.parametrize(
    "text",
    [
        layer(path("M 0,0" + "z" * 60_000)),
        layer(path("M 0,0" + " 1 1" * 11_000)),
        layer(path("M 0,0 " + "1" * 500_000)),
        layer(path("M 0,0" + "m1 1" * 80_000) + path("m0 0" * 80_000)),
        layer(path(LINE) * 10_001),
        layer(path() + CIRCLE * 10_001),
        layer(path(), more=f'transform="{"scale(1)" * 70_000}"'),
    ],
)
def test_a_drawing_of_a_hundred_thousand_parts_is_refused_soon(tmp_path: Path, text: str) -> None:
    started = time.process_time()
    line = refused(tmp_path, svg(image(), text))
    assert "at most" in line or line.startswith("expected the data of a path, not ")
    assert time.process_time() - started < 10


def test_svgelements_is_only_imported_where_a_file_is_read() -> None:
    code = "import sys, landscape.files.svg_environment; sys.exit('svgelements' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
