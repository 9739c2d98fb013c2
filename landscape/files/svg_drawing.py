"""A height map drawn in Inkscape with shapes, gradients and blur, as a picture. No OpenGL.

resvg draws it, by the package resvg-py (the extra ``svg``). Given to it is the file without the
layers of the camera and of the points to look at, within an outer <svg> that shows the map's
rectangle alone. Linked images are embedded before, as they are read for :mod:`.svg_environment`, so
that it opens no other file.
"""

import base64
import io
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

from PIL import Image

from framelens.base.errors import InputError
from framelens.base.input import read_bounded
from landscape.files.images import decoded_image
from landscape.files.svg_tree import MOST_BYTES

SVG = "{http://www.w3.org/2000/svg}"
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
LINKS = ("href", "{http://www.w3.org/1999/xlink}href")
EXTRA = (
    "install the extra svg (pip install 'landscape-gl[svg]'), or export the map in Inkscape as a "
    "PNG whose sides are powers of two (File > Export), and import that"
)


def rasteriser() -> ModuleType | None:
    """Return the package that draws, None if it is not installed."""
    try:
        return import_module("resvg_py")
    except ImportError:
        return None


def _remove_layers(root: ElementTree.Element, names: tuple[str, ...]) -> None:
    """Remove the layers of these names, in small letters."""
    for parent in list(root.iter()):
        for child in list(parent):
            if child.get(LABEL, "").lower() in names:
                parent.remove(child)


def _embed_images(root: ElementTree.Element, linked: Callable[[str], Image.Image]) -> None:
    """Put the images that a drawing links to, which ``linked`` returns, into it."""
    for image in root.iter(f"{SVG}image"):
        for name in LINKS:
            if name in image.attrib and not image.get(name, "").strip().startswith("data:"):
                image.set(name, embedded(linked(image.get(name, ""))))


def drawn(
    path: Path,
    left_out: tuple[str, ...],
    box: tuple[float, float, float, float],
    page: tuple[float, float],
    size: tuple[int, int],
    linked: Callable[[str], Image.Image],
) -> Image.Image:
    """Return the rectangle ``box`` (x, y, width, height) of a drawing as a picture of ``size``.

    ``left_out`` are the names of layers, in small letters, that do not belong to it; ``page`` is
    the size of the page, in the units of ``box``. ``linked`` returns the image of a link. What is
    transparent is white. InputError if the drawing cannot be drawn.
    """
    resvg = rasteriser()
    if resvg is None:
        raise InputError("{path}: a map drawn with shapes: {extra}", path=path, extra=EXTRA)
    root = ElementTree.fromstring(read_bounded(path, MOST_BYTES))
    _remove_layers(root, left_out)
    _embed_images(root, linked)
    root.set("width", repr(page[0]))
    root.set("height", repr(page[1]))
    outer = ElementTree.Element(
        f"{SVG}svg",
        {
            "width": str(size[0]),
            "height": str(size[1]),
            "viewBox": " ".join(map(repr, box)),
            "preserveAspectRatio": "none",
        },
    )
    outer.append(root)
    try:
        data = resvg.svg_to_bytes(
            svg_string=ElementTree.tostring(outer, encoding="unicode"),
            width=size[0],
            height=size[1],
            background="#ffffff",
            skip_system_fonts=True,
        )
    except ValueError as error:
        raise InputError("{path}: cannot be drawn ({error})", path=path, error=error) from None

    return decoded_image(io.BytesIO(bytes(data)), f"{path}: its picture").convert("RGB")


def embedded(image: Image.Image) -> str:
    """Return an image as a link that holds it."""
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    return f"data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}"
