"""Rules about textures, from the image's memory to the coordinates.

In this order: how the image was handed over (rows, order, size), whether the texture is complete,
whether it is bound and enabled, and what the coordinates say.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from framelens.gl.seam import Call, gl
from framelens.tape.image_rows import key_of
from framelens.tape.textures import completeness, size_of
from framelens.why.survey import Drawn, Survey
from framelens.why.suspects import Suspect, in_frame, off, with_state, written
from framelens.why.trial import Action, Change

ENABLED = "GL_TEXTURE0.GL_TEXTURE_2D"
BOUND = "GL_TEXTURE0.GL_TEXTURE_BINDING_2D"
CHANNELS = {0x1907: 3, 0x1908: 4, 0x80E0: 3, 0x80E1: 4, 0x1909: 1, 0x190A: 2, 0x1906: 1, 0x1903: 1}
FORMATS = {1: 0x1909, 2: 0x190A, 3: 0x1907, 4: 0x1908}  # GL_LUMINANCE to GL_RGBA
NAMES = {1: "GL_LUMINANCE", 2: "GL_LUMINANCE_ALPHA", 3: "GL_RGB", 4: "GL_RGBA"}
BYTE = 0x1401  # GL_UNSIGNED_BYTE


@dataclass(frozen=True)
class Upload:
    """A glTexImage2D: its texture, and how OpenGL takes the rows from memory."""

    call: Call
    texture: int
    alignment: int
    row_length: int
    stored: Call | None  # the call that set the length of a row


def uploads(survey: Survey) -> list[Upload]:
    """Return the calls of glTexImage2D that the tape has."""
    found = []
    bound = 0
    alignment = 4
    row_length = 0
    stored = None
    for call in survey.tape.calls:
        if call.name == "glBindTexture" and int(call.args[0]) == int(gl.GL_TEXTURE_2D):
            bound = int(call.args[1])
        elif call.name.startswith("glPixelStore"):
            if int(call.args[0]) == int(gl.GL_UNPACK_ALIGNMENT):
                alignment = int(call.args[1])
            elif int(call.args[0]) == int(gl.GL_UNPACK_ROW_LENGTH):
                row_length, stored = int(call.args[1]), call
        elif call.name == "glTexImage2D":
            found.append(Upload(call, bound, alignment, row_length, stored))
    return found


Image = tuple[int, int, int, np.ndarray]  # width, height, channels, pixels


def image_of(call: Call) -> Image | None:
    """Return width, height, channels and pixels of a glTexImage2D of unsigned bytes."""
    if len(call.args) < 9 or int(call.args[7]) != BYTE or int(call.args[6]) not in CHANNELS:
        return None
    data = call.args[8]
    if data is None:
        return None
    raw = bytes(data) if isinstance(data, (bytes, bytearray)) else np.ascontiguousarray(data)
    array = np.frombuffer(raw, np.uint8) if isinstance(raw, bytes) else raw.reshape(-1)
    if array.dtype != np.uint8:
        return None
    return int(call.args[3]), int(call.args[4]), CHANNELS[int(call.args[6])], array


def _upload_again(call: Call, texture: int, pixels: np.ndarray, channels: int = 0) -> Action:
    """Return the action that gives a texture its image again, from other pixels.

    They have so many ``channels``, 0 for those that the call says.
    """
    args = list(call.args[:8])
    if channels:
        args[6] = FORMATS[channels]

    def act() -> None:
        former = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
        gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glPixelStorei(gl.GL_UNPACK_ROW_LENGTH, 0)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexImage2D(*args, pixels)
        gl.glBindTexture(gl.GL_TEXTURE_2D, former)
        gl.glPopClientAttrib()

    return act


def handed_over(survey: Survey) -> Iterator[Suspect]:
    """Images whose rows OpenGL reads in another way than they lie in memory."""
    for upload in uploads(survey):
        call = upload.call
        texture, alignment = upload.texture, upload.alignment
        image = image_of(call)
        if image is None:
            continue
        width, height, channels, pixels = image
        row = width * channels
        if other := _channels(call, image):
            yield _otherwise(upload, image, other)
            continue
        again = Change(first=[_upload_again(call, texture, pixels[: row * height])])
        if upload.row_length not in (0, width) and pixels.size % row == 0:
            yield _other_row_length(upload, width, again)
            continue
        padded = -(-row // alignment) * alignment
        if padded != row and pixels.size < padded * (height - 1) + row:
            if pixels.size >= row * height:
                yield Suspect(
                    "unpack-alignment",
                    at=call,
                    change=again,
                    strength=94,
                    state="GL_UNPACK_ALIGNMENT",
                    value=alignment,
                    values={"width": width, "row": row, "padded": padded},
                )
        elif pixels.size < row * height:
            yield _too_small(call, int(pixels.size), row * height)

        yield from _upside_down(survey, call, texture, image)


def _other_row_length(upload: Upload, width: int, change: Change) -> Suspect:
    """Return that OpenGL takes an image's rows for longer or shorter than they are."""
    return Suspect(
        "unpack-row-length",
        at=upload.stored,
        change=change,
        strength=93,
        state="GL_UNPACK_ROW_LENGTH",
        value=upload.row_length,
        values={"width": width, "length": upload.row_length, "line": upload.call.site.line},
    )


def _too_small(call: Call, size: int, needed: int) -> Suspect:
    """Return that an image has fewer bytes than OpenGL reads."""
    return Suspect(
        "image-too-small",
        at=call,
        change=None,
        strength=88,
        state="GL_TEXTURE_2D",
        value=size,
        values={"given": size, "needed": needed},
        pixels=1,
    )


def _channels(call: Call, image: Image) -> int:
    """Return how many channels an image has, if it is not as many as the call says, else 0.

    An array tells by its last dimension; bytes by their number.
    """
    width, height, channels, pixels = image
    shape: tuple[int, ...] = tuple(getattr(call.args[8], "shape", ()))
    if len(shape) == 3 and shape[:2] == (height, width):
        return int(shape[2]) if shape[2] in FORMATS and shape[2] != channels else 0
    others = [n for n in (3, 4) if n != channels and pixels.size == width * height * n]
    return others[0] if len(shape) < 2 and channels in (3, 4) and others else 0


def _otherwise(upload: Upload, image: Image, channels: int) -> Suspect:
    """Suspect that an image has more or fewer channels than its format says."""
    width, height, said, pixels = image
    again = pixels[: width * height * channels]
    return Suspect(
        "image-format",
        at=upload.call,
        change=Change(first=[_upload_again(upload.call, upload.texture, again, channels)]),
        strength=95,
        state="GL_TEXTURE_2D",
        value=NAMES[said],
        values={"channels": channels, "said": NAMES[said], "format": NAMES[channels]},
    )


def _upside_down(survey: Survey, call: Call, texture: int, image: Image) -> Iterator[Suspect]:
    """Yield that an image comes with its top row first, and t grows upwards on the screen."""
    width, height, channels, pixels = image
    past = survey.past
    if past is None or pixels.size < width * height * channels:
        return
    origin = past.pixels.get(key_of(call.args[8]))
    if origin is None:
        return
    how, site = origin
    if not how.startswith("pygame"):
        return  # images of PIL that are drawn so may be meant so

    upright = [
        draw
        for draw in survey.shapes
        if draw.state[BOUND] == texture and draw.state[ENABLED] and _upwards(draw)
    ]
    if not upright:
        return

    rows = pixels[: width * height * channels].reshape(height, width * channels)
    turned = np.ascontiguousarray(rows[::-1]).reshape(-1)
    suspect = Suspect(
        "upside-down",
        at=None,
        change=Change(first=[_upload_again(call, texture, turned)]),
        strength=86,
        state="GL_TEXTURE_2D",
        values={"call": how},
        draws=upright,
        source=f"{site.file}:{site.line}",
    )
    yield suspect


def _upwards(draw: Drawn) -> bool:
    """Return whether t grows upwards on the screen."""
    found, placed = draw.vertices, draw.placed
    if found is None or placed is None or found.coords is None:
        return False
    if len(found.coords) != len(placed.clip):
        return False
    w = np.where(np.abs(placed.clip[:, 3]) < 1e-9, 1.0, placed.clip[:, 3])
    y, t = placed.clip[:, 1] / w, found.coords[:, 1]
    if np.ptp(y) < 1e-6 or np.ptp(t) < 1e-6:
        return False
    return bool(np.corrcoef(y, t)[0, 1] > 0.5)


def incomplete(survey: Survey) -> Iterator[Suspect]:
    """Textures that OpenGL does not use: a level is missing, or there is no image at all."""
    done: set[int] = set()
    for draw in survey.shapes:
        texture = int(draw.state[BOUND])
        if not draw.state[ENABLED] or texture in done:
            continue
        done.add(texture)
        mine = [d for d in survey.shapes if d.state[ENABLED] and int(d.state[BOUND]) == texture]
        what = completeness(texture)
        if what is None:
            continue

        state, value, values = what
        if value == "empty":
            yield from _nothing_bound(survey, mine, texture)
            continue
        setter = _parameter(survey, texture) or draw.setter(BOUND)
        action: Action = (
            "glTexParameteri",
            (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR),
        )
        yield Suspect(
            "texture-incomplete",
            at=setter,
            change=with_state(["TEXTURE"], [action], mine),
            strength=92,
            state=state,
            value=value,
            values=values | {"texture": texture},
            draws=mine,
        )


def _parameter(survey: Survey, texture: int) -> Call | None:
    """Return the call that set a texture's filter, or else the one that gave it its image."""
    bound = 0
    found = image = None
    for call in survey.tape.calls:
        if call.name == "glBindTexture":
            bound = int(call.args[1])
        elif bound == texture and call.name.startswith("glTexParameter"):
            if int(call.args[1]) == int(gl.GL_TEXTURE_MIN_FILTER):
                found = call
        elif bound == texture and call.name == "glTexImage2D":
            image = call
    return found or image


def _nothing_bound(survey: Survey, mine: Sequence[Drawn], texture: int) -> Iterator[Suspect]:
    given = [d for d in mine if d.vertices is not None and d.vertices.coords is not None]
    setter = given[0].setter(BOUND) if given else None
    if not given or (setter is not None and int(setter.args[1]) == 0):
        return  # who binds 0 may well mean it

    for upload in reversed(uploads(survey)):
        call, other = upload.call, upload.texture
        if other == texture or completeness(other) is not None:
            continue
        yield Suspect(
            "texture-not-bound",
            at=given[0].setter(BOUND) or given[0].call,
            change=with_state(["TEXTURE"], [("glBindTexture", (gl.GL_TEXTURE_2D, other))], given),
            strength=84,
            state="GL_TEXTURE_BINDING_2D",
            value=texture,
            values={"texture": texture, "other": other, "image": call.site.line},
            draws=given,
        )
        return


def not_enabled(survey: Survey) -> Iterator[Suspect]:
    """A texture bound, coordinates given, and texturing off."""
    mine = [
        d
        for d in survey.shapes
        if not d.state[ENABLED] and d.passed and _has_coords(d) and not _textured_otherwise(d)
    ]

    bound = [d for d in mine if completeness(int(d.state[BOUND])) is None]
    if not bound:
        return

    seen = any(d.state[ENABLED] for d in survey.shapes)
    if seen and survey.pixel is None:
        return  # where some are textured, others may be meant to be plain
    late = [d for d in bound if _disabled_after(survey, d)] if seen else []
    if seen and not late and _meant_plain(survey, bound[0]):
        return
    bound = late or bound
    setter = bound[0].setter(BOUND)
    yield Suspect(
        "texture-off",
        at=setter or bound[0].call,
        change=with_state(["ENABLE"], [("glEnable", (gl.GL_TEXTURE_2D,))], bound),
        strength=(80 if late else 60) if seen else 90,
        state="GL_TEXTURE_2D",
        value=False,
        values={"texture": int(bound[0].state[BOUND])},
        draws=bound,
    )


def _disabled_after(survey: Survey, draw: Drawn) -> bool:
    """Return whether texturing is disabled only after a draw, whose texture no other draw uses.

    A program that disables it when the thing is drawn means it to be on before.
    """
    texture = int(draw.state[BOUND])
    if any(d.state[ENABLED] and int(d.state[BOUND]) == texture for d in survey.shapes):
        return False
    if in_frame(survey, draw.setter(ENABLED)):
        return False
    later = [call for call in survey.calls if call.number > draw.number]
    switches = [call for call in later if call.name in ("glEnable", "glDisable")]
    names = [call.name for call in switches if int(call.args[0]) == int(gl.GL_TEXTURE_2D)]
    return names[:1] == ["glDisable"]


def _meant_plain(survey: Survey, draw: Drawn) -> bool:
    """Return whether a program that textures other things disables it for this one, too.

    It does if the first thing drawn after that glDisable has coordinates, or if it disables
    texturing somewhere, and has not enabled it yet; and if the same line draws with a texture as
    well, whose coordinates come with the shape, and none is bound after the glDisable.
    """
    setter = draw.setter(ENABLED)
    if setter is None:
        texture = int(gl.GL_TEXTURE_2D)
        return any(c.name == "glDisable" and int(c.args[0]) == texture for c in survey.calls)
    shared = any(d.state[ENABLED] and d.call.source == draw.call.source for d in survey.shapes)
    binding = draw.setter(BOUND)
    late = in_frame(survey, setter) and in_frame(survey, binding)
    if shared and not (late and binding is not None and binding.number > setter.number):
        return True
    after = [d for d in survey.shapes if d.setter(ENABLED) is setter]
    return setter.name == "glDisable" and _has_coords(after[0])


def _textured_otherwise(draw: Drawn) -> bool:
    """Return whether a draw has a texture that is not two-dimensional."""
    line = draw.state["GL_TEXTURE0.GL_TEXTURE_1D"] and draw.state[BOUND.replace("2D", "1D")]
    return bool(line) or any(draw.state[f"GL_TEXTURE0.GL_TEXTURE_{k}"] for k in ("3D", "CUBE_MAP"))


def _has_coords(draw: Drawn) -> bool:
    found = draw.vertices
    return found is not None and found.coords is not None and np.ptp(found.coords) > 0


def coordinates(survey: Survey) -> Iterator[Suspect]:
    """Coordinates in pixels, or none at all."""
    for draw in survey.shapes:
        found, texture = draw.vertices, int(draw.state[BOUND])
        if not draw.state[ENABLED] or found is None or not draw.passed:
            continue
        if completeness(texture) is not None:
            continue
        if found.coords is not None and len(found.coords):
            suspect = _in_pixels(survey, draw, texture)
            if suspect is not None:
                yield suspect
                return
    yield from _without(survey)


def _in_pixels(survey: Survey, draw: Drawn, texture: int) -> Suspect | None:
    found = draw.vertices
    assert found is not None and found.coords is not None
    former = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    width, height = size_of(0)
    gl.glBindTexture(gl.GL_TEXTURE_2D, former)
    s, t = (float(np.ptp(found.coords[:, k])) for k in (0, 1))
    matrix = np.array(draw.state["GL_TEXTURE0.GL_TEXTURE_MATRIX"], float)
    if not np.allclose(matrix, np.eye(4).reshape(-1)):
        return None
    near = (abs(s - width) <= 1.01 or abs(s - 255) < 0.01) and (abs(t - height) <= 1.01)
    if not near or s < 8 or t < 8:
        return None
    mine = [d for d in survey.shapes if d.state[ENABLED] and int(d.state[BOUND]) == texture]
    call = next(
        (
            step.call
            for step in draw.steps
            if step.call.name.startswith("glTexCoord") and max(map(float, _flat(step.call))) > 1
        ),
        draw.setter("GL_TEXTURE0.GL_TEXTURE_COORD_ARRAY_POINTER") or draw.call,
    )

    def scale() -> None:
        mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPushMatrix()
        gl.glScalef(1.0 / width, 1.0 / height, 1.0)
        gl.glMatrixMode(mode)

    def back() -> None:
        mode = int(gl.glGetIntegerv(gl.GL_MATRIX_MODE))
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPopMatrix()
        gl.glMatrixMode(mode)

    from framelens.why.trial import Around

    return Suspect(
        "coords-in-pixels",
        at=call,
        change=Change(around=(Around(0, [scale], frozenset(d.place for d in mine), [back]),)),
        strength=91,
        state="GL_CURRENT_TEXTURE_COORDS",
        value=[s, t],
        values={"s": s, "t": t, "width": width, "height": height},
        draws=mine,
    )


def _flat(call: Call) -> list[float]:
    from framelens.why.geometry import components

    return components(call)


def _without(survey: Survey) -> Iterator[Suspect]:
    """Yield that a texture made for something else is still enabled for shapes without coords."""
    bare = [
        d
        for d in survey.shapes
        if d.state[ENABLED]
        and d.passed
        and d.vertices is not None
        and (d.vertices.coords is None or np.ptp(d.vertices.coords) == 0)
        and not d.state["GL_TEXTURE0.GL_TEXTURE_GEN_S"]
        and not d.call.name.startswith("glut")
        and not d.state["GL_TEXTURE0.GL_TEXTURE_COORD_ARRAY"]
        and completeness(int(d.state[BOUND])) is None
    ]
    if not bare:
        return

    mapped = [d for d in survey.shapes if d.state[ENABLED] and _has_coords(d)]
    setter = bare[0].setter(ENABLED)
    if mapped:
        yield Suspect(
            "texture-left",
            at=setter,
            change=off("GL_TEXTURE_2D", bare),
            strength=79,
            state="GL_TEXTURE_2D",
            value=True,
            values={"later": bare[0].call.site.line},
            draws=bare,
        )
    else:
        yield Suspect(
            "no-coords",
            at=bare[0].call,
            change=_with_coords(bare),
            strength=77,
            state="GL_CURRENT_TEXTURE_COORDS",
            draws=bare,
        )


def _with_coords(draws: Sequence[Drawn]) -> Change:
    instead: dict[str, Sequence[Action]] = {}
    for draw in draws:
        found = draw.vertices
        if found is None or not found.places:
            continue
        low, high = found.positions.min(axis=0), found.positions.max(axis=0)
        order = np.argsort(-(high - low)[:3])[:2]
        a, b = sorted(int(k) for k in order)
        for index, place in enumerate(found.places):
            point = found.positions[index]
            s = (point[a] - low[a]) / ((high - low)[a] or 1.0)
            t = (point[b] - low[b]) / ((high - low)[b] or 1.0)
            step = next(x for x in draw.steps if x.place == place)
            instead[place] = [("glTexCoord2f", (s, t)), (step.call.name, step.call.args)]
    return Change(instead=instead)


def tinted(survey: Survey) -> Iterator[Suspect]:
    """A texture multiplied by a dark colour that something else has set."""
    mine = []
    for draw in survey.shapes:
        if not draw.state[ENABLED] or not draw.passed or draw.state["GL_LIGHTING"]:
            continue
        if draw.state["GL_TEXTURE0.GL_TEXTURE_ENV.GL_TEXTURE_ENV_MODE"] != "GL_MODULATE":
            continue
        if not _has_coords(draw) or draw.vertices is None or draw.vertices.color_calls:
            continue
        if max(draw.state["GL_CURRENT_COLOR"][:3]) > 0.12 or draw.state["GL_BLEND"]:
            continue
        mine.append(draw)

    if mine:
        yield Suspect(
            "texture-times-black",
            at=mine[0].setter("GL_CURRENT_COLOR"),
            change=Change(before={d.place: [("glColor4f", (1.0, 1.0, 1.0, 1.0))] for d in mine}),
            strength=83,
            state="GL_CURRENT_COLOR",
            value=[float(v) for v in mine[0].state["GL_CURRENT_COLOR"]],
            draws=mine,
        )


RULES = (handed_over, incomplete, not_enabled, coordinates, tinted)
__all__ = ["RULES", "completeness", "written"]
