"""Files for every reader: strategies of Hypothesis that know the format, and what reads it.

A file is made whole, with a value here and there that should not be there; its bytes may then be
damaged. Each reader must return something or raise InputError, in one line.
"""

import base64
import csv
import hashlib
import io
import json
import lzma
import struct
import warnings
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import strategies as st
from PIL import Image

from framelens.program.program_events import read_events
from framelens.program.program_source import read_source
from framelens.tape import edit_files
from landscape.course.exercise import _evidence
from landscape.course.grader import recorded, stream
from landscape.course.grader.evidence import Evidence
from landscape.course.grader.grading import same_drawing
from landscape.course.grader.sandbox import Outcome
from landscape.course.ladder import NAMES
from landscape.course.lecture import plan
from landscape.course.roster import moodle
from landscape.course.roster.submissions import submissions
from landscape.course.shelf import COURSE
from landscape.elements.places_file import KINDS, MORE_COLUMNS, NEEDED, read_places
from landscape.files import cache, svg_environment
from landscape.files.images import read_heights, read_image
from landscape.files.meshes import PLY_TYPES, read_colours, read_mesh
from landscape.flyover import exchange
from landscape.flyover.app import ranking
from landscape.geometry.height_field import HeightField
from landscape.scene.scene import SCENES, scene
from landscape.settings import declare
from landscape.voxel.blocks import BLOCKS
from landscape.voxel.world import World
from landscape.voxel.world_file import decoded
from landscape.walk import recording

Strategy = st.SearchStrategy[Any]

# --- values that should not be there ---------------------------------------------------------

INTEGERS = st.sampled_from([0, 1, -1, 2, 7, 255, 256, 65_536, 2**31, 2**32 - 1, 2**63, 10**30])
FLOATS = st.floats(width=64) | st.sampled_from([1e308, -1e308, 1e-320, 0.5, 1e9])
TEXTS = st.text(max_size=12) | st.sampled_from(["", " ", "x", "-1", "1e400", "nan", "\ud800", "é"])
DEEP = st.integers(1, 4000).map(lambda depth: "[" * depth + "]" * depth)
ODD = st.recursive(
    st.none() | st.booleans() | INTEGERS | FLOATS | TEXTS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=6,
)


@st.composite
def spoiled(draw: Any, value: Any) -> Any:
    """Return a tree of JSON with up to three of its parts exchanged, left out or added."""
    for _ in range(draw(st.integers(0, 3))):
        value = draw(_changed(value))
    return value


@st.composite
def _changed(draw: Any, value: Any) -> Any:
    if isinstance(value, dict) and value and draw(st.integers(0, 9)):
        key = draw(st.sampled_from(sorted(value, key=str)))
        match draw(st.integers(0, 9)):
            case 0:
                return {name: part for name, part in value.items() if name != key}
            case 1:
                return value | {draw(TEXTS): draw(ODD)}
            case _:
                return value | {key: draw(_changed(value[key]))}
    if isinstance(value, list) and value and draw(st.integers(0, 9)):
        at = draw(st.integers(0, len(value) - 1))
        match draw(st.integers(0, 9)):
            case 0:
                return value[:at] + value[at + 1 :]
            case 1:
                return value[:at] + [draw(ODD)] + value[at:]
            case _:
                return value[:at] + [draw(_changed(value[at]))] + value[at + 1 :]
    return draw(ODD)


@st.composite
def damaged(draw: Any, whole: Strategy) -> bytes:
    """Return bytes, three times in four as they are, or with some changed, cut out or repeated."""
    data = bytearray(draw(whole))
    for _ in range(draw(st.sampled_from([0, 0, 0, 1, 2, 4]))):
        at = draw(st.integers(0, len(data)))
        match draw(st.integers(0, 4)):
            case 0:
                data[at : at + 1] = bytes([draw(st.integers(0, 255))])
            case 1:
                data[at : at + 4] = draw(st.sampled_from([b"\xff" * 4, bytes(4), b"\x7f" * 4]))
            case 2:
                del data[at : at + draw(st.sampled_from([1, 4, 100, 10**6]))]
            case 3:
                data[at:at] = data[at : at + draw(st.sampled_from([1, 8, 64]))]
            case _:
                data[at:at] = draw(st.binary(max_size=8))
    return bytes(data)


def dumped(value: Any) -> bytes:
    """Return JSON, in which a lone surrogate stays one."""
    return json.dumps(value).encode()


@st.composite
def as_json(draw: Any, whole: Any) -> bytes:
    """Return a tree, spoiled, as JSON; sometimes something deep in place of a number."""
    data: bytes = dumped(draw(spoiled(whole)))
    if not draw(st.integers(0, 19)):
        data = data.replace(b"1", draw(DEEP).encode(), 1)
    return data


# --- a strategy for each format ---------------------------------------------------------------

SIDE, HEIGHT = 8, 6
LAND = {"levels": 6, "seed": 1}


def small_world() -> World:
    """Return a world of a few blocks."""
    return World(np.ones((SIDE, SIDE, HEIGHT), np.uint8), np.ones((SIDE, SIDE)), SIDE, 2, 0.1)


@st.composite
def worlds(draw: Any) -> bytes:
    """Return a world file, whose digest is right most of the time."""
    count = draw(st.integers(0, 40))
    order = st.integers(0, SIDE * SIDE * HEIGHT + 1)
    places = draw(st.lists(order, min_size=count, max_size=count, unique=draw(st.booleans())))
    places = sorted(places) if draw(st.integers(0, 4)) else places
    kinds = draw(st.lists(st.integers(0, 255 if not draw(st.integers(0, 4)) else 3), max_size=60))
    kinds = (kinds + [1] * count)[: count if draw(st.integers(0, 9)) else None]
    content = np.array(places, "<u4").tobytes() + bytes(kinds)
    body = zlib.compress(content * draw(st.sampled_from([1, 1, 1, 2])))
    head = {
        "landscape voxel world": 1,
        "land": LAND,
        "kinds": [each.name for each in BLOCKS],
        "changes": count,
        "digest": hashlib.sha256(body).hexdigest(),
    }
    return dumped(draw(spoiled(head))) + b"\n" + body


TICK = {"dt": 0.03, "forward": 1.0, "look": [0.0, 1.5], "run": True, "do": ["map", "time"]}
TICK |= {"list": "fog.density", "set": {"fog.density": 0.1}, "size": [64, 20]}


@st.composite
def recordings(draw: Any) -> bytes:
    """Return a recording of a walk."""
    first: dict[str, Any] = {"landscape walk": 1, "scene": draw(st.sampled_from([*SCENES, "x"]))}
    first |= {"view": "fig35a", "pose": [8.0, None, 33.0, 28.0, -1], "kt": 40, "size": [40, 30]}
    first |= {"seed": 1, "only": ["ground"], "wireframe": False, "language": "en", "preset": ""}
    first |= {"given": {"fog.density": 0.1}, "settings": {"ground.resolution": 20}}
    names = st.sets(st.sampled_from([*TICK])).map(lambda found: {"dt", *found})
    frames = [{name: TICK[name] for name in draw(names)} for _ in range(draw(st.integers(0, 4)))]
    lines = [first, *frames, {"frames": len(frames)}]
    return b"\n".join(dumped(draw(spoiled(line))) for line in lines)


EDIT = {"name": "glFogf", "element": "fog", "pass": "main", "file": "landscape/elements/fog.py"}
EDIT |= {"function": "enable", "text": "x", "select": ["GL_FOG_DENSITY"], "occurrence": 0}
LISTED = {"element": "", "file": "a.py", "function": "", "text": "", "occurrence": 1}
EDITS = [
    {"call": EDIT, "argument": 1, "value": 0.3},
    {"call": {**EDIT, "list": LISTED}, "argument": 1, "value": [1, 2.5], "component": 1},
    {"call": {**EDIT, "was": "x"}, "skip": True},
    {"call": {"name": "glEnable"}, "argument": 0, "value": "GL_FOG | GL_BLEND"},
]
EVENTS = [
    {"frame": 1, "key": "W", "action": "press", "mods": ["shift"]},
    {"frame": 2, "button": "left", "action": "release"},
    {"frame": 2, "move": [10, 20]},
    {"frame": 3, "scroll": [0, -1]},
    {"frame": 4, "resize": [100, 80]},
]
RESULT = {"environment": "island", "hash": "ab", "version": "1", "frames": 10, "size": [64, 48]}
RESULT |= {"machine": {"processor": "x", "python": "3", "numpy": "2"}}
RESULT |= {"rows": {"all": {"fps": 1.0, "ms": 1.0}}}
PATH = {"path": [[[1.0, 2], [1, 3], [2, 4], [3, 1]]], "targets": [[1, 2], [5.5, 6]]}

FIELDS = declare.fields(type(scene().settings))


@st.composite
def tables(draw: Any) -> bytes:
    """Return a TOML file of settings."""
    lines = []
    for key in draw(st.lists(st.sampled_from([*FIELDS, "x.y", "a"]), max_size=5)):
        value = draw(spoiled(draw(st.sampled_from([1, 0.5, True, "on", [1, 2, 3], "island"]))))
        text = json.dumps(value, ensure_ascii=draw(st.booleans()))
        key = draw(st.sampled_from([key, key, key, f"{key}." * draw(st.integers(1, 40)) + "x"]))
        lines += draw(st.sampled_from([[f"{key} = {text}"], [f"[{key}]", f"a = {text}"]]))
    return "\n".join(lines).encode(errors="surrogatepass")


@st.composite
def places(draw: Any) -> bytes:
    """Return a table of where trees and deer stand."""
    columns = [*NEEDED, *draw(st.permutations(MORE_COLUMNS))[: draw(st.integers(0, 6))]]
    file = io.StringIO()
    table = csv.writer(file)
    table.writerow(draw(st.permutations(columns)) if draw(st.booleans()) else columns)
    cell = st.sampled_from(["1", "20.5", "", "nan", "inf", "1e300", "-1", "x", *KINDS])
    for _ in range(draw(st.integers(0, 4))):
        row = [draw(st.sampled_from([*KINDS])) if name == "kind" else "1" for name in columns]
        if draw(st.booleans()) and row:
            row[draw(st.integers(0, len(row) - 1))] = draw(cell | TEXTS)
        table.writerow(row + ["more"] * draw(st.sampled_from([0, 0, 0, 1])))
    return file.getvalue().encode(errors="surrogatepass")


@st.composite
def lectures(draw: Any) -> bytes:
    """Return a lecture."""
    name = st.sampled_from([*NAMES[:4], "fig35a", "R12", "x.py", "voxel"])
    line = st.sampled_from(
        ['code: 1-3, glClear, "gl"', "code: 3-1", "code: 99999999999999999999-1", "code: new"]
        + ['code: "', "code: ,", "keys: SPACE, A", "keys: NOPE", "note: say", "title: T", "Hello"]
        + ["x: y", "# no", "  more", ""]
    )
    parts = ["title: My lecture", ""] if draw(st.booleans()) else []
    for _ in range(draw(st.integers(0, 4))):
        parts += [draw(name | TEXTS), *draw(st.lists(line | TEXTS, max_size=5)), ""]
    return "\n".join(parts).encode(errors="surrogatepass")


NUMBERS = st.sampled_from(["0", "1", "-1", "10.5", "1e400", "nan", "1e9", "100%", "5mm", "", "x"])
TRANSFORM = st.sampled_from(
    ["", "translate(1,2)", "scale(0)", "rotate(30)", "matrix(1 0 0 1 5 5)", "matrix(1)"]
    + ["translate(nan)", "scale(1e300) scale(1e300)", "skewX(90)", "evil(1)", "translate(1" * 50]
)
DATA = st.sampled_from(
    ["M 1 2 C 1 2 3 4 5 6", "M0 0L9 9 5 1z", "m1 1 q 1 1 2 2 t 3 3 a 1 1 0 0 0 5 5", "M", "C 1"]
    + ["M 1e400 1 L 1 1", "M nan nan L 1 1", "M 0 0 A 0 0 0 0 0 5 5", "z", "M1,1" + "l1,1" * 300]
)


def picture(mode: str = "L", side: int = 4, form: str = "PNG") -> bytes:
    """Return a small image file."""
    file = io.BytesIO()
    Image.new(mode, (side, side), 3).save(file, form)
    return file.getvalue()


@st.composite
def drawings(draw: Any) -> bytes:
    """Return an SVG file with an image and a path to fly along."""
    spaces = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    spaces += 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    data = draw(damaged(st.sampled_from([picture(), picture("I;16"), picture("RGBA", 1), b""])))
    link = "data:image/png;base64," + base64.b64encode(data).decode()
    link = draw(st.sampled_from([link] * 6 + ["a.png", "/dev/zero", "../..", "data:,", "http://x"]))

    def attributes(**given: str) -> str:
        given = {k: v for k, v in given.items() if draw(st.integers(0, 9))}
        return " ".join(f'{k.replace("_", ":")}="{v}"' for k, v in given.items())

    size = {"width": draw(NUMBERS | st.just("40")), "height": draw(NUMBERS | st.just("40"))}
    place = {"x": draw(NUMBERS), "y": draw(NUMBERS), "transform": draw(TRANSFORM)}
    box = draw(st.sampled_from(["0 0 40 40", "0 0 0 0", "0 0 nan 1", "1 2", "0 0 1e300 1e300"]))
    image = f"<image {attributes(xlink_href=link, **(size if draw(st.booleans()) else place))}/>"
    path = f"<path {attributes(d=draw(DATA), transform=draw(TRANSFORM))}/>"
    circle = f"<circle {attributes(cx=draw(NUMBERS), cy=draw(NUMBERS), r='1')}/>"
    line = f'<polyline points="{draw(st.sampled_from(["1,2 3,4", "1", "", "nan,1 2,3"]))}"/>'
    parts = [image, path, circle, line, "<switch><g>", "</g></switch>", "<use href='#a'/>"]
    inside = draw(st.lists(st.sampled_from(parts), max_size=6))
    label = draw(st.sampled_from(["camera", "targets", "x"]))
    group = f"<g inkscape:label='{label}' transform='{draw(TRANSFORM)}'>{path}{circle}</g>"
    encoding = draw(
        st.sampled_from(["utf-8"] * 6 + ["utf-7", "utf-16", "latin-1", "cp037", "idna", "x"])
    )
    head = f'<?xml version="1.0" encoding="{encoding}"?>'
    head += draw(st.sampled_from([""] * 5 + ["<!DOCTYPE svg>", "<!DOCTYPE svg [<!ENTITY a 'b'>]>"]))
    text = f'{head}<svg {spaces} viewBox="{box}">{image}{"".join(inside)}{group}</svg>'
    return text.encode()


@st.composite
def images(draw: Any) -> bytes:
    """Return an image file; sometimes a PNG whose header promises more than it holds."""
    if not draw(st.integers(0, 5)):
        return draw(headers())
    form = draw(st.sampled_from(["PNG", "JPEG", "GIF", "TIFF", "BMP", "WEBP", "PPM", "TGA"]))
    modes = {"PNG": ["L", "I;16", "P", "LA", "RGBA", "1"], "TIFF": ["L", "I;16", "F", "CMYK"]}
    mode = draw(st.sampled_from(modes.get(form, ["RGB", "L"] if form != "WEBP" else ["RGB"])))
    return picture(mode, draw(st.sampled_from([1, 2, 7, 24])), form)


@st.composite
def headers(draw: Any) -> bytes:
    """Return a PNG of any size in its header, with a right checksum."""
    sides = st.sampled_from([0, 1, 5, 13_000, 60_000, 2**31 - 1])
    kind = bytes([draw(st.sampled_from([1, 8, 16, 3])), draw(st.integers(0, 7)), 0, 0, 0])
    header = b"IHDR" + struct.pack(">II", draw(sides), draw(sides)) + kind
    chunks = [header, b"IDAT" + zlib.compress(bytes(draw(st.sampled_from([10, 10_000])))), b"IEND"]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
        for chunk in chunks
    )


@st.composite
def meshes(draw: Any) -> bytes:
    """Return a PLY file, as text or binary, of a few properties and elements."""
    kinds = st.sampled_from([*PLY_TYPES])
    names = draw(st.permutations(["x", "y", "z", "red", "green", "blue", "nx"]))
    names = names[: draw(st.integers(3, 7))]
    types = {name: draw(st.sampled_from(["float", "float", "double", "uchar"])) for name in names}
    form = draw(st.sampled_from(["ascii", "binary_little_endian", "binary_big_endian", "x"]))
    rows, faces = draw(st.integers(0, 5)), draw(st.integers(0, 4))
    counts = [draw(st.sampled_from([n, n, n, n, -1, 10**9, 10**30])) for n in (rows, faces)]
    length, index = draw(kinds), draw(kinds)
    head = ["ply", f"format {form} 1.0", "comment x", f"element vertex {counts[0]}"]
    head += [f"property {types[name]} {name}" for name in names]
    head += [f"element face {counts[1]}", f"property list {length} {index} vertex_indices"]
    head += draw(
        st.lists(st.sampled_from(["property float x", "element a 3", "x", ""]), max_size=1)
    )
    corner = st.sampled_from([0, 1, 2, 3, 4, 7, -1])
    lists = [draw(st.lists(corner, max_size=5)) for _ in range(faces)]
    if form == "ascii":
        cell = st.sampled_from(["0", "1", "0.5", "nan", "1e400", "x", "-3"])
        body = [" ".join(draw(cell) for _ in names) for _ in range(rows)]
        body += [" ".join(map(str, [len(each), *each])) for each in lists]
        return "\n".join([*head, "end_header", *body, ""]).encode()
    order = ">" if "big" in form else "<"

    def number(kind: str, value: float) -> bytes:
        return np.array(value).astype(f"{order}{PLY_TYPES[kind]}").tobytes()

    body_bytes = b"".join(number(types[name], draw(corner)) for _ in range(rows) for name in names)
    for each in lists:
        body_bytes += number(length, len(each)) + b"".join(number(index, at) for at in each)
    return "\n".join([*head, "end_header", ""]).encode() + body_bytes


PROGRAM = st.sampled_from(
    ["import glfw", "from OpenGL.GL import *", "x = '\\d'", "# exercise: winding", "def f(:", "\0"]
    + ["import " + ".".join("a" * 60), "(" * 300, "-" * 9000 + "1", "# coding: utf-7", "é = 1"]
    + ["# exercise: nothing", "open('x')", "\f", "f'{x!r:{y}}'", "1" * 5000, "\\", "'''"]
)


@st.composite
def programs(draw: Any) -> bytes:
    """Return the source of a program."""
    lines = draw(st.lists(PROGRAM | TEXTS, max_size=6))
    code = draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "utf-8"]))
    return "\n".join(lines).encode(code, errors="surrogatepass")


@st.composite
def entries(draw: Any) -> bytes:
    """Return an entry of the cache, whose checksum is right most of the time."""
    arrays = [np.arange(draw(st.integers(0, 4)), dtype="<f4")]
    table = [[each.dtype.str, list(each.shape)] for each in arrays]
    text = dumped(draw(spoiled(table)))
    text += b" " * (-(cache.HEAD_BYTES + len(text)) % cache.ALIGNED)
    body = [text, *(each.tobytes() + bytes(-each.nbytes % cache.ALIGNED) for each in arrays)]
    begin = cache._begin(Path(f"{ENTRY}.arrays")) + len(text).to_bytes(4, "little")
    return begin + cache._checksum([begin, *body]).to_bytes(4, "little") + b"".join(body)


ENTRY = "00" * cache.NAME_BYTES


# --- what reads them ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Reader:
    """A reader, the name of the file that it reads, and a strategy for its content."""

    file: str
    content: Strategy
    read: Callable[[Path], object]


def _read_world(path: Path) -> object:
    world = small_world()
    return world.restore(decoded(path.read_bytes(), str(path), world, LAND))


def _read_pictures(path: Path) -> object:
    return read_heights(path), read_image(path, "RGB", 16)


def _read_mesh(path: Path) -> object:
    return read_mesh(path), read_colours(path)


def _read_settings(path: Path) -> object:
    return scene().values(None, declare.read_toml(path))


def _read_places(path: Path) -> object:
    field = HeightField(np.ones((4, 4), np.float32), 10.0, 0.5)
    return read_places(path, field, set(KINDS))


CALLS = {
    "source": "x",
    "calls": [
        ["glFogf", 2914, 0.5],
        ["glColor3fv", [1, 0.5, 0]],
        ["glVertexPointer", {"offset": 4}],
    ]
    + [["glDrawPixels", 1, 1, {"array": 1, "type": "<f4", "shape": [2, 1]}, {"bytes": 1}]],
    "takes": [
        {
            "size": [8, 6],
            "frames": [0, 1],
            "events": EVENTS,
            "presses": {"1": {"A": 2}},
            "made": [0, 0],
        }
    ],
}


def _sent(answer: Any, blobs: list[bytes]) -> bytes:
    return b"".join(stream.parts(answer if isinstance(answer, dict) else {}, blobs))


@st.composite
def calls(draw: Any) -> bytes:
    """Return a recorded solution."""
    indices = draw(st.lists(st.integers(0, 4), max_size=9))
    data = _sent(draw(spoiled(CALLS)), [np.array(indices, np.int32).tobytes(), bytes(8)])
    return lzma.compress(data) if draw(st.booleans()) else data


EVIDENCE = {
    "frames": {"0": {"size": [4, 2], "pixels": 2, "calls": [0, [1, [7], {"state": 0}], 3]}},
    "setup": [0, [2, [1], {"inside": [0], "way": [[3, "main"]]}]],
    "sites": [["glVertex3f", 4, "main", True, 3], ["glBegin", 5, "main", True, 1]]
    + [["glCallList", 6, "main", False, 1], ["glDrawArrays", 7, "main", True, 3]],
    "numbers": {"of": 0, "values": 1},
    "lists": [[0, [1, [4]], 2, [3, ["GL_TRIANGLES", 0, 3], {"arrays": [0], "state": 1}]]],
    "pointers": [["glVertexPointer", [3, "GL_FLOAT", 0, [[0, 0, 0], [1, 0, 0], [0, 1, 0]]]]],
    "states": [{"GL_FOG": True, "GL_VIEWPORT": [0, 0, 4, 2]}, {"GL_FOG": False}],
    "early": None,
    "made": 3,
}


@st.composite
def evidence(draw: Any) -> bytes:
    """Return what the process of a program sends to the grader."""
    count = draw(st.integers(0, 9))
    numbers = np.zeros(count, np.int32).tobytes(), np.arange(3.0 * count).tobytes()
    made = _sent(CALLS, [bytes(4), bytes(8)])
    return _sent(draw(spoiled(EVIDENCE)), [*numbers, bytes(24), made])


def _read_evidence(path: Path) -> None:
    """Do with evidence what the grader does before its tests, which may raise errors of Python."""
    outcome = Outcome("a.py", stream.received(path.read_bytes()), "", "")
    found = _evidence(path, outcome, [0])
    if isinstance(found, Evidence):
        same_drawing(found.frame(0), found.frame(0))
        if found.made is not None:
            recorded.parsed(found.made)


@st.composite
def zips(draw: Any) -> bytes:
    """Return a zip of a class, with zips in it."""
    names = st.sampled_from(["a.py", "b/c.py", "A B_12_assignsubmission_file/x.py", "../x.py"])
    names |= st.sampled_from(["d/", "/e.py", "f.zip", "__MACOSX/a.py", "g/h/i.zip", "", "j\\k.py"])
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("a.py", "# exercise: fog\n")
    file = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(file, "w") as archive:
        warnings.simplefilter("ignore")  # of a name that is there twice
        for name in draw(st.lists(names, max_size=5)):
            content = draw(st.sampled_from([b"", b"# exercise: fog\n", inner.getvalue()]))
            kind = draw(st.sampled_from([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED]))
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), content, kind)
    return file.getvalue()


@st.composite
def worksheets(draw: Any) -> bytes:
    """Return a grading worksheet of Moodle."""
    header = draw(
        st.sampled_from(["Identifier,Name,Grade,Feedback comments", "Id;Note", '"Grade"'])
    )
    rows = draw(st.lists(st.sampled_from(["Participant 12,A,,", '12,"a ""b""",-,"', "", ",,"])))
    return "\n".join([header, *rows]).encode(draw(st.sampled_from(["utf-8", "utf-16"])))


def _read_worksheet(path: Path) -> None:
    moodle.filled(path.read_bytes(), {"12": moodle.Mark("3", 'good, "x"')}, str(path))


READERS = {
    "world": Reader("a.world", worlds(), _read_world),
    "recording": Reader("a.jsonl", recordings(), recording.read),
    "edits": Reader("a.json", as_json({"version": 1, "edits": EDITS}), edit_files.read),
    "events": Reader("a.json", as_json(EVENTS), read_events),
    "settings": Reader("a.toml", tables(), _read_settings),
    "places": Reader("a.csv", places(), _read_places),
    "lecture": Reader("a.txt", lectures(), plan.read),
    "svg": Reader("a.svg", drawings(), svg_environment.read),
    "flight": Reader("path.json", as_json(PATH), exchange.curves_in),
    "result": Reader("a.json", as_json(RESULT), ranking.read),
    "image": Reader("a.png", images(), _read_pictures),
    "ply": Reader("a.ply", meshes(), _read_mesh),
    "program": Reader("a.py", programs(), read_source),
    "submission": Reader("a.py", programs(), COURSE.named_in),
    "class": Reader("a.zip", damaged(zips()), lambda path: submissions([path])),
    "worksheet": Reader("a.csv", damaged(worksheets()), _read_worksheet),
    "calls": Reader("solution.calls", damaged(calls()), recorded.read),
    "evidence": Reader("a.evidence", damaged(evidence()), _read_evidence),
    "cache": Reader(f"{ENTRY}.arrays", entries(), cache._read),
}
