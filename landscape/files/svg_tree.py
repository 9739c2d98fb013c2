"""The drawn elements of an SVG file as a tree, read with care. No OpenGL.

Entities, which can make a file of a few lines fill the memory or read another file, are refused;
so is whatever is larger or deeper than any drawing by hand. Only what is drawn is kept, and of it
only the attributes that say what is where.
"""

from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from framelens.base.errors import InputError
from framelens.base.input import read_bounded

MOST_BYTES = 64 << 20  # chosen: an image of 4096 x 4096 pixels of 16 bits, embedded, takes 45 MB
MOST_DEPTH = 100  # chosen: groups within groups
MOST_ELEMENTS = 20_000  # chosen

SPACES = {
    "http://www.inkscape.org/namespaces/inkscape": "inkscape:",
    "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd": "sodipodi:",
    "http://www.w3.org/1999/xlink": "",  # xlink:href, and href since SVG 2
}
SHAPES = ("path", "line", "polyline", "polygon", "circle", "ellipse", "rect")
TAGS = frozenset({"svg", "g", "a", "switch", "image", "use", *SHAPES})
PLACING = {"transform", "viewBox", "preserveAspectRatio", "x", "y", "width", "height"}
DRAWN = {"href", "style", "display", "opacity", "d", "points", "x1", "y1", "x2", "y2", "cx", "cy"}
INKSCAPE = {"inkscape:label", "sodipodi:type", "sodipodi:cx", "sodipodi:cy"}
ATTRIBUTES = PLACING | DRAWN | INKSCAPE


@dataclass
class Element:
    """An element: its tag without namespace, some attributes, and the elements in it."""

    tag: str
    attributes: dict[str, str]
    children: list["Element"] = field(default_factory=list)

    def get(self, name: str) -> str:
        """Return an attribute without the spaces around it, "" if it is not there."""
        return self.attributes.get(name, "").strip()

    @property
    def hidden(self) -> bool:
        """Whether it is not drawn, as an object or a layer that was hidden in Inkscape."""
        style = self.get("style").replace(" ", "").split(";")
        return self.get("display") == "none" or "display:none" in style

    @property
    def faded(self) -> bool:
        """Whether one sees through it."""
        style = [part.partition(":") for part in self.get("style").replace(" ", "").split(";")]
        given = {name: value for name, _, value in style}
        text = given.get("opacity") or self.get("opacity") or "1"
        try:
            return float(text.rstrip("%")) / (100.0 if text.endswith("%") else 1.0) < 1.0
        except ValueError:
            return False


def read_tree(path: Path) -> Element:
    """Read an SVG file; InputError, one line, if it is none or more than any drawing should be."""
    data = read_bounded(path, MOST_BYTES)
    if data[:2] == b"\x1f\x8b":
        raise InputError("{path}: compressed; expected a plain SVG file", path=path)

    builder = _Builder(str(path))
    # Names come as "namespace name".
    parser = expat.ParserCreate(None, " ")
    parser.StartElementHandler = builder.start
    parser.EndElementHandler = builder.end
    parser.StartDoctypeDeclHandler = builder.doctype
    parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)

    try:
        parser.Parse(data, True)
    except InputError:
        raise
    except (expat.ExpatError, LookupError, ValueError) as error:  # the last two: its encoding
        raise InputError("{path}: expected an SVG file ({error})", path=path, error=error) from None

    if builder.root is None:
        raise InputError(
            "{path}: expected an SVG file, with <svg> as its outermost element", path=path
        )
    return builder.root


class _Builder:
    """Builds the tree while the file is parsed."""

    def __init__(self, name: str) -> None:
        self._name = name
        self.root: Element | None = None
        self._open: list[Element | None] = []  # None: left out, with all that is in it
        self._count = 0

    def doctype(self, name: str, system: str | None, public: str | None, inside: bool) -> None:
        """Accept a mere <!DOCTYPE svg PUBLIC ...>, which is not read, but no declarations."""
        if inside:
            raise InputError(
                "{name}: expected an SVG file without declarations in a DTD", name=self._name
            )

    def start(self, name: str, given: dict[str, str]) -> None:
        """Begin an element."""
        self._count += 1
        if len(self._open) >= MOST_DEPTH or self._count > MOST_ELEMENTS:
            raise InputError(
                "{name}: too large, expected at most {most_elements} elements, and "
                "{most_depth} one in another",
                name=self._name,
                most_elements=MOST_ELEMENTS,
                most_depth=MOST_DEPTH,
            )
        tag = name.rpartition(" ")[2]
        parent = self._open[-1] if self._open else None
        element = None
        if tag in TAGS and (parent is not None or (not self._open and tag == "svg")):
            element = Element(tag, _attributes(given))
            if parent is None:
                self.root = element
            else:
                parent.children.append(element)
        self._open.append(element)

    def end(self, name: str) -> None:
        """End the element that was begun last."""
        self._open.pop()


def _attributes(given: dict[str, str]) -> dict[str, str]:
    """Return the attributes that are kept, under short names."""
    parts = [(*name.rpartition(" ")[::2], value) for name, value in given.items()]
    short = {SPACES.get(space, f"{space}:" if space else "") + name: v for space, name, v in parts}
    return {name: value for name, value in short.items() if name in ATTRIBUTES}
