"""Environment files: a height image, a camera's path and points to look at, drawn in Inkscape.

The file is an SVG, as the software fly-over has it: the height image, embedded or linked, or a map
drawn with shapes, which svg_drawing.py makes an image of; a layer
named "camera" with the path; and there, or on a layer named "targets", circles, rectangles and
Inkscape's stars, whose centres are the points that the camera turns to. On the layer "targets" a
path is one, too, as a circle becomes that was turned into a path.
A layer goes by the name that Inkscape shows (inkscape:label), not by its id, and may be hidden.
Transforms, viewBox and units are those of SVG; lines, quadratic
curves and arcs are turned into cubic Bezier curves. svgelements reads paths, transforms and
lengths. No OpenGL.
"""

import base64
import contextlib
import io
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import unquote

import numpy as np
from PIL import Image

from framelens.base.errors import InputError, short
from landscape.files import svg_drawing
from landscape.files.images import decoded_image, open_image, red_values
from landscape.files.svg_tree import SHAPES, Element, read_tree

CAMERA, TARGETS = "camera", "targets"  # the layers' names: section 2.3, and chosen
PIXELS_PER_INCH = 96.0  # CSS
DRAWN_SIDE = 512  # pixels, chosen: the longer side of a map that is drawn with shapes
MOST_CURVES = 10_000  # chosen: of all paths together
MOST_TARGETS = 1_000  # chosen
FARTHEST = 1e9  # pixels, chosen: products of coordinates must not overflow
MOST_TEXT = 1 << 19  # chosen: characters of paths and transforms, which take seconds to read
MOST_CLOSED = 1_000  # chosen: svgelements takes a time that grows with their square
# No quantifier gives back what it has taken: a long text that is wrong would take for ever.
NUMBER = r"[+-]?+(?:\d++\.?+\d*+|\.\d++)(?:e[+-]?+\d++)?+[a-z%]*+"
TRANSFORM = re.compile(
    r"(?:\s*+,?+\s*+(?:matrix|(?:translate|scale|skew)[xy]?|rotate)\s*+"
    rf"\((?:\s*+,?+\s*+{NUMBER})*+\s*+\))*+\s*+",
    re.IGNORECASE,
)
PATH_DATA = re.compile(r"[\s,MmZzLlHhVvCcSsQqTtAaEe0-9.+-]*")


@dataclass(frozen=True)
class SvgEnvironment:
    """The contents of an environment file. Places are in pixels from the image's top left."""

    name: str
    image: np.ndarray  # float32 (h, w) in 0..255: the red channel, on white
    subpaths: tuple[np.ndarray, ...]  # each (n, 4, 2): n >= 1 cubics, each starts where one ends
    targets: np.ndarray  # float64 (m, 2), in the file's order
    notices: tuple[str, ...] = ()  # what could not be drawn, a line each


class Place(NamedTuple):
    """Where an element stands."""

    transform: np.ndarray  # (3, 3), to the outermost coordinates
    viewport: tuple[float, float]  # width and height that percentages refer to
    layer: str = ""  # the camera's or the targets', if it is on one of them
    hidden: bool = False
    faded: bool = False


@dataclass
class Found:
    """What was found in a file, in the outermost coordinates."""

    layer: bool = False  # a layer for the camera
    clones: bool = False  # on it
    subpaths: list[np.ndarray] = field(default_factory=list)
    curves: int = 0  # in them
    targets: list[np.ndarray] = field(default_factory=list)
    image: tuple[Element, Place] | None = None
    shapes: int = 0  # of the map, that are drawn
    page: tuple[float, float] = (0.0, 0.0)  # its size
    characters: int = 0  # of paths and transforms

    def text(self, text: str) -> str:
        """Return a text that is to be read; InputError where all of them are too long."""
        self.characters += len(text)
        if self.characters > MOST_TEXT:
            raise InputError(
                "expected at most {most_text} characters of paths and transforms",
                most_text=MOST_TEXT,
            )
        return text


def read(path: Path) -> SvgEnvironment:
    """Read an environment file; InputError, one line, where something is missing or wrong."""
    # An overflow is found by its result.
    with np.errstate(all="ignore"):
        return _read(path)


def _read(path: Path) -> SvgEnvironment:
    found = Found()
    root = read_tree(path)
    with _named(path):
        _collect(root, Place(np.eye(3), (0.0, 0.0)), found)
    if not found.layer:
        raise InputError(
            '{path}: expected a layer "{camera}", with the camera\'s path', path=path, camera=CAMERA
        )
    if not found.subpaths:
        if found.clones:
            raise InputError(
                '{path}: expected a path of more than one point on the layer "{camera}"; a clone '
                "must be unlinked first",
                path=path,
                camera=CAMERA,
            )
        raise InputError(
            '{path}: expected a path of more than one point on the layer "{camera}"',
            path=path,
            camera=CAMERA,
        )

    if found.image is None and not found.shapes:
        raise InputError("{path}: expected the height image, embedded or linked", path=path)
    image, to_pixels, notices = _map(path, found)
    with _named(path):
        subpaths = tuple(_moved(to_pixels, curves) for curves in found.subpaths)
        targets = _moved(to_pixels, np.array(found.targets, np.float64).reshape(-1, 2))
    for places in (*subpaths, targets):
        if np.abs(places).max(initial=0.0) > FARTHEST:
            raise InputError(
                "{path}: expected coordinates of at most {farthest:.0e} pixels",
                path=path,
                farthest=FARTHEST,
            )
    return SvgEnvironment(path.stem, _over_white(image), subpaths, targets, notices)


def _left_out(path: Path, found: Found, faded: bool, turned: bool) -> str:
    """Return the notice that a map is taken without its shapes, or as if it were opaque."""
    left_out = ["shapes over the height image"] * bool(found.shapes)
    left_out += ["the height image's opacity"] * faded
    why = "the image is turned" if turned else f"to draw them, {svg_drawing.EXTRA}"
    return f"{path}: {' and '.join(left_out)}: left out; {why}"


def _map(path: Path, found: Found) -> tuple[Image.Image, np.ndarray, tuple[str, ...]]:
    """Return the map, the matrix (3, 3) from the outermost coordinates to its pixels, and notices.

    An image alone is taken as it is. Shapes, and an image that one sees through, are drawn; if they
    cannot be, an image is taken without them, with a notice.
    """
    if found.image is None:
        return *_map_of_shapes(path, found), ()
    element, place = found.image
    image = _image(path, element.attributes.get("href", ""))
    with _named(path):
        to_pixels = _to_pixels(element, place, image.size)
    faded = place.faded or element.faded
    if not (found.shapes or faded):
        return image, to_pixels, ()
    turned = bool(np.abs(to_pixels[[0, 1], [1, 0]]).max() > 1e-9)
    if turned or svg_drawing.rasteriser() is None:
        return image, to_pixels, (_left_out(path, found, faded, turned),)
    return _drawing(path, found, _box(to_pixels, image.size), image.size), to_pixels, ()


def _box(to_pixels: np.ndarray, size: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return the x, y, width and height of an image that is not turned, in outer coordinates."""
    left, top = -to_pixels[:2, 2] / np.diag(to_pixels)[:2]
    width, height = np.array(size) / np.diag(to_pixels)[:2]
    return float(left), float(top), float(width), float(height)


def _map_of_shapes(path: Path, found: Found) -> tuple[Image.Image, np.ndarray]:
    """Return a map that is drawn with shapes alone, as large as the page, and its matrix."""
    width, height = found.page
    with _named(path):
        if not (min(found.page) > 0 and np.isfinite(found.page).all()):
            raise InputError("expected a page of finite size, for a map drawn with shapes")
    size = _powers(width, height)
    to_pixels = np.diag([size[0] / width, size[1] / height, 1.0])
    return _drawing(path, found, (0.0, 0.0, width, height), size), to_pixels


def _drawing(
    path: Path, found: Found, box: tuple[float, ...], size: tuple[int, int]
) -> Image.Image:
    """Return a rectangle of the drawing as a picture, without the flight."""
    x, y, width, height = box
    layers = (CAMERA, TARGETS)
    return svg_drawing.drawn(
        path, layers, (x, y, width, height), found.page, size, lambda link: _image(path, link)
    )


def _powers(width: float, height: float) -> tuple[int, int]:
    """Return the size in pixels of the picture of a page: powers of two, close to its shape."""
    short = min(width, height) / max(width, height) * DRAWN_SIDE
    other = max(2, 1 << round(np.log2(max(short, 2.0))))
    return (DRAWN_SIDE, other) if width >= height else (other, DRAWN_SIDE)


@contextlib.contextmanager
def _named(path: Path) -> Iterator[None]:
    """Let errors begin with the file's name."""
    try:
        yield
    except InputError as error:
        raise InputError("{path}: {error}", path=path, error=error) from None


def _collect(element: Element, around: Place, found: Found) -> None:
    """Add what is in an element that stands in the place ``around``."""
    if element.tag not in ("svg", "g", "a", "switch", "image") and not around.layer:
        shown = not (around.hidden or element.hidden)
        found.shapes += shown and element.tag in (*SHAPES, "use")
        return

    place = around._replace(
        transform=around.transform @ _transform(found.text(element.get("transform"))),
        hidden=around.hidden or element.hidden,
        faded=around.faded or element.faded,
    )
    if element.tag == "svg":
        outermost = not any(around.viewport)
        place = _viewport(element, place)
        if outermost:
            found.page = _page(element, place)

    label = element.get("inkscape:label").lower()
    if element.tag == "g" and label in (CAMERA, TARGETS):
        place = place._replace(layer=label)
        found.layer = found.layer or label == CAMERA
    for child in element.children:
        _collect(child, place, found)
    if element.tag == "image":
        if found.image is None and not place.layer and not place.hidden:
            found.image = element, place
    elif element.tag in ("circle", "ellipse"):
        found.targets.append(_centre(element, place, "cx", "cy"))
    elif element.get("sodipodi:type") in ("arc", "star"):  # they are paths with a centre
        found.targets.append(_centre(element, place, "sodipodi:cx", "sodipodi:cy"))
    elif element.tag == "rect":
        found.targets.append(_middle(element, place))
    elif place.layer == TARGETS and element.tag in SHAPES:
        curves = _subpaths(found.text(_path_data(element)))
        if curves:
            ends = _moved(place.transform, np.concatenate(curves)).reshape(-1, 2)
            found.targets.append((ends.min(axis=0) + ends.max(axis=0)) / 2)
    elif place.layer == CAMERA:
        found.clones = found.clones or element.tag == "use"
        curves = _subpaths(found.text(_path_data(element)))
        found.subpaths += [_moved(place.transform, each) for each in curves]
        found.curves += sum(map(len, curves))

    if found.curves > MOST_CURVES or len(found.targets) > MOST_TARGETS:
        raise InputError(
            "expected at most {nodes} nodes and {points} points to look at",
            nodes=MOST_CURVES,
            points=MOST_TARGETS,
        )


def _length(element: Element, name: str, whole: float, default: float) -> float:
    """Return a coordinate or length in user units; percentages are those of ``whole``."""
    from svgelements import Length

    text = element.get(name)
    if text in ("", "auto"):
        return default
    try:
        value = float(Length(text).value(ppi=PIXELS_PER_INCH, relative_length=whole))
    except (TypeError, ValueError):
        value = np.nan
    if not np.isfinite(value) or text[:1] not in "+-.0123456789":
        raise InputError(
            "<{tag}>, {name}: expected a length, not {text}",
            tag=element.tag,
            name=name,
            text=short(text),
        )
    return value


def _transform(text: str) -> np.ndarray:
    """Return an attribute ``transform`` as a matrix (3, 3) for columns x, y, 1."""
    from svgelements import Matrix

    if not text:
        return np.eye(3)
    try:
        if not TRANSFORM.fullmatch(text):  # svgelements leaves out what it does not know
            raise ValueError
        m = Matrix(text)
        matrix = np.array([[m.a, m.c, m.e], [m.b, m.d, m.f], [0, 0, 1]], np.float64)
        if not np.isfinite(matrix).all():
            raise ValueError
    except (ArithmeticError, IndexError, TypeError, ValueError):
        raise InputError("expected a transform, not {text}", text=short(text)) from None
    return matrix


def _fitted(element: Element, box: tuple[float, ...], inner: tuple[float, ...]) -> np.ndarray:
    """Return the matrix (3, 3) that fits a rectangle ``inner`` into a ``box``: x, y, w, h each."""
    from svgelements import Viewbox

    aspect = element.get("preserveAspectRatio") or "xMidYMid"
    return _transform(Viewbox.viewbox_transform(*box, *inner, aspect))


def _viewport(element: Element, place: Place) -> Place:
    """Return the place inside an <svg>, from its viewBox, or from its size where it has none."""
    outer = place.viewport
    box = _view_box(element)
    inside = box or (0.0, 0.0, *outer)

    # The outermost <svg> is as large as its viewBox says where its size is not given.
    whole = outer if any(outer) else inside[2:]
    corner = [_length(element, key, side, 0.0) for key, side in zip("xy", whole, strict=True)]
    sides = zip(("width", "height"), whole, strict=True)
    size = [_length(element, key, side, side) for key, side in sides]
    if box is None:
        moved = np.array([[1, 0, corner[0]], [0, 1, corner[1]], [0, 0, 1]])
        return place._replace(transform=place.transform @ moved, viewport=(size[0], size[1]))
    fitted = _fitted(element, (*corner, *size), inside)
    return place._replace(transform=place.transform @ fitted, viewport=box[2:])


def _view_box(element: Element) -> tuple[float, float, float, float] | None:
    """Return the x, y, width and height of an <svg>'s viewBox; None if it has none."""
    numbers = element.get("viewBox").replace(",", " ").split()
    if not numbers:
        return None
    try:
        x, y, width, height = map(float, numbers)
    except ValueError:
        raise InputError("expected a viewBox of four numbers") from None
    if not (width > 0 and height > 0 and np.isfinite([x, y, width, height]).all()):
        raise InputError("expected a viewBox of finite size")
    return x, y, width, height


def _page(element: Element, place: Place) -> tuple[float, float]:
    """Return the width and height of the outermost <svg> in its own coordinates."""
    width, height = (
        _length(element, name, side, side)
        for name, side in zip(("width", "height"), place.viewport, strict=True)
    )
    return width, height


def _centre(element: Element, place: Place, *names: str) -> np.ndarray:
    """Return the centre (2,) of a circle."""
    sides = zip(names, place.viewport, strict=True)
    return _moved(place.transform, np.array([_length(element, *each, 0.0) for each in sides]))


def _middle(element: Element, place: Place) -> np.ndarray:
    """Return the middle (2,) of a rectangle."""

    def pair(*names: str) -> np.ndarray:
        sides = zip(names, place.viewport, strict=True)
        return np.array([_length(element, *each, 0.0) for each in sides])

    return _moved(place.transform, pair("x", "y") + pair("width", "height") / 2)


def _moved(transform: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return points (..., 2) transformed by a matrix (3, 3)."""
    moved = points @ transform[:2, :2].T + transform[:2, 2]
    if not np.isfinite(moved).all():
        raise InputError("expected finite coordinates")
    return np.asarray(moved)


def _path_data(element: Element) -> str:
    """Return a shape as the data of a path."""
    if element.tag == "line":
        x1, y1, x2, y2 = (element.get(name) or "0" for name in ("x1", "y1", "x2", "y2"))
        return f"M {x1},{y1} {x2},{y2}"
    if element.tag in ("polyline", "polygon"):
        points = element.get("points")
        return f"M {points} {'Z' * (element.tag == 'polygon')}" if points else ""
    return element.get("d")


def _subpaths(data: str) -> list[np.ndarray]:
    """Return the data of a path as sub-paths, each (n, 4, 2), in its own coordinates.

    A sub-path of one point is left out.
    """
    from svgelements import Move
    from svgelements import Path as PathData

    if not PATH_DATA.fullmatch(data):
        raise InputError("expected the data of a path, not {data}", data=short(data))
    if data.lower().count("z") > MOST_CLOSED:
        raise InputError(
            "expected a path with at most {most_closed} closed parts", most_closed=MOST_CLOSED
        )
    found: list[list[np.ndarray]] = []
    try:
        for segment in PathData(data):
            if isinstance(segment, Move):
                found.append([])
            else:
                found[-1] += _cubics(segment)
    except (ArithmeticError, AttributeError, IndexError, TypeError, ValueError):
        raise InputError("expected the data of a path, not {data}", data=short(data)) from None
    moving = [np.array(curves) for curves in found if curves]
    return [each for each in moving if np.ptp(each.reshape(-1, 2), axis=0).any()]


def _cubics(segment: Any) -> list[np.ndarray]:
    """Return a segment of a path as cubics (4, 2)."""
    from svgelements import Arc, Close, CubicBezier, QuadraticBezier

    start, end = np.array(segment.start), np.array(segment.end)
    if isinstance(segment, Close) and (start == end).all():
        return []
    if isinstance(segment, CubicBezier):
        return [np.array([start, segment.control1, segment.control2, end])]
    curves = list(segment.as_cubic_curves()) if isinstance(segment, Arc) else []
    if curves:
        return [curve for each in curves for curve in _cubics(each)]
    # A parabola of control points s, c, e is the cubic of s, (s + 2c) / 3, (e + 2c) / 3, e; a
    # straight line is a parabola with c in the middle.
    middle = (
        np.array(segment.control) if isinstance(segment, QuadraticBezier) else (start + end) / 2
    )
    return [np.array([start, (start + 2 * middle) / 3, (end + 2 * middle) / 3, end])]


def _to_pixels(element: Element, place: Place, size: tuple[int, int]) -> np.ndarray:
    """Return the matrix (3, 3) from the outermost coordinates to an image's pixels."""
    corner = [_length(element, *each, 0.0) for each in zip("xy", place.viewport, strict=True)]
    natural = zip(("width", "height"), place.viewport, size, strict=True)
    sides = [_length(element, *each) for each in natural]
    if min(sides) <= 0:
        raise InputError("<image>: expected a width and a height above 0")
    matrix = place.transform @ _fitted(element, (*corner, *sides), (0.0, 0.0, *size))
    if not np.isfinite(matrix).all() or abs(np.linalg.det(matrix)) < 1e-24:
        raise InputError("<image>: expected a transform that leaves the image an area")
    return np.asarray(np.linalg.inv(matrix))


def _image(path: Path, link: str) -> Image.Image:
    """Return the image that a link leads to: embedded, or in the file's folder or below it."""
    kind, _, data = link.strip().partition(",")
    if kind.startswith("data:"):
        try:
            embedded = base64.b64decode(data) if kind.endswith(";base64") else b""
        except ValueError:
            embedded = b""
        if not embedded:
            raise InputError("{path}: <image>: expected data in base64", path=path)
        return decoded_image(io.BytesIO(embedded), f"{path}: embedded image")

    name = unquote(link.strip().removeprefix("file://"))

    # Compared as they are written: a symbolic link in the folder is the user's own.
    folder = os.path.abspath(path.parent)
    target = os.path.abspath(os.path.join(folder, name))
    if not name or "\0" in name or not target.startswith(os.path.join(folder, "")):
        raise InputError(
            "{path}: <image>: expected an embedded image or a file in the same folder, not {link}",
            path=path,
            link=short(link),
        )

    try:
        return open_image(Path(target))
    except InputError as error:
        raise InputError("{path}: linked image {error}", path=path, error=error) from None


def _over_white(image: Image.Image) -> np.ndarray:
    """Return an image's red channel, float32 (h, w) in 0..255; what is transparent is white.

    White is the paper that one sees in Inkscape, and the lowest height.
    """
    if image.mode in ("RGBA", "LA", "PA"):
        paper = Image.new("RGBA", image.size, "white")
        image = Image.alpha_composite(paper, image.convert("RGBA"))
    return red_values(image)
