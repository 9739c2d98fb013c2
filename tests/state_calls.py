"""Calls that change the classic state, each with what it must change: nothing is taken from the
table of variables that they test.

A change is a function of a random generator that makes OpenGL calls and returns the variables that
they set, name to value. All numbers are multiples of 1/256, which single precision holds exactly.
"""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

from framelens.gl.context import Context
from framelens.gl.seam import gl

Expected = dict[str, Any]
Fresh = Callable[[], Context]
"""Opens a context and makes it current: the fixture ``fresh``."""
Change = Callable[[np.random.Generator], Expected]
CHANGES: list[Change] = []

COMPARISONS = "NEVER LESS EQUAL LEQUAL GREATER NOTEQUAL GEQUAL ALWAYS"
FACTORS = "ZERO ONE DST_COLOR ONE_MINUS_DST_COLOR SRC_ALPHA ONE_MINUS_SRC_ALPHA DST_ALPHA"
OPERATIONS = "KEEP ZERO REPLACE INCR DECR INVERT INCR_WRAP DECR_WRAP"
TYPES = "SHORT INT FLOAT DOUBLE"
FACES = "FRONT BACK FRONT_AND_BACK"


def change(function: Change) -> Change:
    CHANGES.append(function)
    return function


def enum(name: str) -> int:
    return int(getattr(gl, name))


def one(rng: np.random.Generator, names: str) -> str:
    """Return one of the names, with GL_ in front."""
    return f"GL_{rng.choice(names.split())}"


def number(rng: np.random.Generator, least: float = 0.0, most: float = 1.0) -> float:
    return float(rng.integers(round(least * 256), round(most * 256), endpoint=True)) / 256


def numbers(
    rng: np.random.Generator, count: int, least: float = 0.0, most: float = 1.0
) -> list[float]:
    return [number(rng, least, most) for _ in range(count)]


def flag(rng: np.random.Generator) -> bool:
    return bool(rng.integers(2))


def array(values: list[float]) -> np.ndarray:
    return np.array(values, np.float32)


def unit(rng: np.random.Generator) -> str:
    """Make a texture unit the active one, for the client too; return its name in front of others.

    The rest of a change need not set it back: which unit is active is expected as well.
    """
    name = f"GL_TEXTURE{rng.integers(8)}"
    gl.glActiveTexture(enum(name))
    gl.glClientActiveTexture(enum(name))
    return name


def in_unit(name: str, values: Expected) -> Expected:
    active = {"GL_ACTIVE_TEXTURE": name, "GL_CLIENT_ACTIVE_TEXTURE": name}
    return active | {f"{name}.{rest}": value for rest, value in values.items()}


EVALUATED = {
    **{"COLOR_4": 4, "INDEX": 1, "NORMAL": 3, "VERTEX_3": 3, "VERTEX_4": 4},
    **{f"TEXTURE_COORD_{k}": k for k in range(1, 5)},
}
"""What evaluators give, and how many numbers one point of it has."""

SWITCHES = (
    "NORMALIZE RESCALE_NORMAL COLOR_SUM FOG LIGHTING POINT_SMOOTH POINT_SPRITE "
    "VERTEX_PROGRAM_POINT_SIZE LINE_SMOOTH LINE_STIPPLE CULL_FACE POLYGON_SMOOTH "
    "POLYGON_OFFSET_POINT POLYGON_OFFSET_LINE POLYGON_OFFSET_FILL POLYGON_STIPPLE MULTISAMPLE "
    "SAMPLE_ALPHA_TO_COVERAGE SAMPLE_ALPHA_TO_ONE SAMPLE_COVERAGE SCISSOR_TEST ALPHA_TEST "
    "STENCIL_TEST DEPTH_TEST BLEND DITHER INDEX_LOGIC_OP COLOR_LOGIC_OP AUTO_NORMAL "
    + " ".join(f"LIGHT{k}" for k in range(8))
    + " "
    + " ".join(f"CLIP_PLANE{k}" for k in range(6))
    + " "
    + " ".join(f"MAP{k}_{name}" for k in (1, 2) for name in EVALUATED)
)


@change
def switches(rng: np.random.Generator) -> Expected:
    expected: Expected = {}
    for name in SWITCHES.split():
        on = expected[f"GL_{name}"] = flag(rng)
        (gl.glEnable if on else gl.glDisable)(enum(f"GL_{name}"))
    return expected


@change
def planes_beyond_the_named_ones(rng: np.random.Generator) -> Expected:
    k, on = int(rng.integers(6, 8)), flag(rng)
    (gl.glEnable if on else gl.glDisable)(int(gl.GL_CLIP_PLANE0) + k)
    return {f"GL_CLIP_PLANE{k}": on}


def matrix(rng: np.random.Generator, mode: str) -> list[float]:
    values = numbers(rng, 16, -4, 4)
    gl.glMatrixMode(enum(mode))
    gl.glLoadMatrixf(array(values))
    return values


@change
def matrices(rng: np.random.Generator) -> Expected:
    name = one(rng, "MODELVIEW PROJECTION")
    return {f"{name}_MATRIX": matrix(rng, name), "GL_MATRIX_MODE": name}


@change
def texture_matrix(rng: np.random.Generator) -> Expected:
    name = unit(rng)
    values = matrix(rng, "GL_TEXTURE")
    return {"GL_MATRIX_MODE": "GL_TEXTURE", **in_unit(name, {"GL_TEXTURE_MATRIX": values})}


@change
def viewport(rng: np.random.Generator) -> Expected:
    box, scissors = ([int(v) for v in rng.integers(1, 99, 4)] for _ in range(2))
    gl.glViewport(*box)
    gl.glScissor(*scissors)
    near, far = numbers(rng, 2)
    gl.glDepthRange(near, far)
    return {"GL_VIEWPORT": box, "GL_SCISSOR_BOX": scissors, "GL_DEPTH_RANGE": [near, far]}


def eye_space() -> None:
    """Make the modelview matrix the identity, so that eye space is the space of the arguments."""
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()


IDENTITY = np.eye(4).ravel().tolist()
AT_EYE = {"GL_MATRIX_MODE": "GL_MODELVIEW", "GL_MODELVIEW_MATRIX": IDENTITY}


@change
def clip_plane(rng: np.random.Generator) -> Expected:
    k, values = int(rng.integers(8)), numbers(rng, 4, -4, 4)
    eye_space()
    gl.glClipPlane(int(gl.GL_CLIP_PLANE0) + k, np.array(values))
    return AT_EYE | {f"GL_CLIP_PLANE{k}.equation": values}


@change
def current_values(rng: np.random.Generator) -> Expected:
    color = numbers(rng, 4)
    second = numbers(rng, 3)
    normal = numbers(rng, 3)
    fog = number(rng)
    edge = flag(rng)
    index = number(rng)
    gl.glDisable(gl.GL_COLOR_MATERIAL)
    gl.glColor4f(*color)
    gl.glSecondaryColor3f(*second)
    gl.glNormal3f(*normal)
    gl.glFogCoordf(fog)
    gl.glEdgeFlag(edge)
    gl.glIndexf(index)
    return {
        "GL_COLOR_MATERIAL": False,
        "GL_CURRENT_COLOR": color,
        "GL_CURRENT_SECONDARY_COLOR": [*second, 1.0],
        "GL_CURRENT_NORMAL": normal,
        "GL_CURRENT_FOG_COORD": fog,
        "GL_EDGE_FLAG": edge,
        "GL_CURRENT_INDEX": index,
    }


@change
def current_coordinates(rng: np.random.Generator) -> Expected:
    name, values = f"GL_TEXTURE{rng.integers(8)}", numbers(rng, 4)
    gl.glMultiTexCoord4f(enum(name), *values)
    return {f"{name}.GL_CURRENT_TEXTURE_COORDS": values}


@change
def raster_position(rng: np.random.Generator) -> Expected:
    position, color = numbers(rng, 3), numbers(rng, 4)
    gl.glDisable(gl.GL_COLOR_MATERIAL)
    gl.glDepthRange(0.0, 1.0)
    gl.glFogi(gl.GL_FOG_COORD_SRC, gl.GL_FOG_COORD)
    distance = number(rng)
    gl.glFogCoordf(distance)
    gl.glColor4f(*color)
    expected: Expected = {}
    for k in range(8):
        values = numbers(rng, 4)
        gl.glMultiTexCoord4f(enum("GL_TEXTURE0") + k, *values)
        for name in ("CURRENT_TEXTURE_COORDS", "CURRENT_RASTER_TEXTURE_COORDS"):
            expected[f"GL_TEXTURE{k}.GL_{name}"] = values

    gl.glWindowPos3f(*position)
    return expected | {
        "GL_COLOR_MATERIAL": False,
        "GL_DEPTH_RANGE": [0.0, 1.0],
        "GL_FOG_COORD_SRC": "GL_FOG_COORD",
        "GL_CURRENT_FOG_COORD": distance,
        "GL_CURRENT_COLOR": color,
        "GL_CURRENT_RASTER_POSITION": [*position, 1.0],
        "GL_CURRENT_RASTER_POSITION_VALID": True,
        "GL_CURRENT_RASTER_DISTANCE": distance,
        "GL_CURRENT_RASTER_COLOR": color,
    }


@change
def raster_position_outside(rng: np.random.Generator) -> Expected:
    eye_space()
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.glRasterPos3f(5.0, 0.0, 0.0)
    return {
        "GL_MODELVIEW_MATRIX": IDENTITY,
        "GL_PROJECTION_MATRIX": IDENTITY,
        "GL_MATRIX_MODE": "GL_PROJECTION",
        "GL_CURRENT_RASTER_POSITION_VALID": False,
    }


@change
def fog(rng: np.random.Generator) -> Expected:
    density, start, end, index = numbers(rng, 4, 0, 9)
    color, mode = numbers(rng, 4), one(rng, "LINEAR EXP EXP2")
    source, shading = one(rng, "FRAGMENT_DEPTH FOG_COORD"), one(rng, "FLAT SMOOTH")
    gl.glFogf(gl.GL_FOG_DENSITY, density)
    gl.glFogf(gl.GL_FOG_START, start)
    gl.glFogf(gl.GL_FOG_END, end)
    gl.glFogf(gl.GL_FOG_INDEX, index)
    gl.glFogfv(gl.GL_FOG_COLOR, array(color))
    gl.glFogi(gl.GL_FOG_MODE, enum(mode))
    gl.glFogi(gl.GL_FOG_COORD_SRC, enum(source))
    gl.glShadeModel(enum(shading))
    return {
        "GL_FOG_DENSITY": density,
        "GL_FOG_START": start,
        "GL_FOG_END": end,
        "GL_FOG_INDEX": index,
        "GL_FOG_COLOR": color,
        "GL_FOG_MODE": mode,
        "GL_FOG_COORD_SRC": source,
        "GL_SHADE_MODEL": shading,
    }


@change
def light_model(rng: np.random.Generator) -> Expected:
    ambient = numbers(rng, 4)
    local = flag(rng)
    two = flag(rng)
    control = one(rng, "SINGLE_COLOR SEPARATE_SPECULAR_COLOR")
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, array(ambient))
    gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, local)
    gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, two)
    gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, enum(control))
    return {
        "GL_LIGHT_MODEL_AMBIENT": ambient,
        "GL_LIGHT_MODEL_LOCAL_VIEWER": local,
        "GL_LIGHT_MODEL_TWO_SIDE": two,
        "GL_LIGHT_MODEL_COLOR_CONTROL": control,
    }


@change
def material(rng: np.random.Generator) -> Expected:
    gl.glDisable(gl.GL_COLOR_MATERIAL)
    expected: Expected = {"GL_COLOR_MATERIAL": False}
    for face in ("GL_FRONT", "GL_BACK"):
        for name in ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_EMISSION"):
            expected[f"{face}.{name}"] = values = numbers(rng, 4)
            gl.glMaterialfv(enum(face), enum(name), array(values))
        shininess, indexes = number(rng, 0, 128), numbers(rng, 3, 0, 9)
        gl.glMaterialf(enum(face), gl.GL_SHININESS, shininess)
        gl.glMaterialfv(enum(face), gl.GL_COLOR_INDEXES, array(indexes))
        expected |= {f"{face}.GL_SHININESS": shininess, f"{face}.GL_COLOR_INDEXES": indexes}
    return expected


@change
def color_material(rng: np.random.Generator) -> Expected:
    """The materials that follow the colour take it over at once."""
    face, parameter = one(rng, FACES), one(rng, "EMISSION SPECULAR AMBIENT_AND_DIFFUSE")
    color = numbers(rng, 4)
    gl.glDisable(gl.GL_COLOR_MATERIAL)
    gl.glColorMaterial(enum(face), enum(parameter))
    gl.glEnable(gl.GL_COLOR_MATERIAL)
    gl.glColor4f(*color)
    faces = ("GL_FRONT", "GL_BACK") if face == "GL_FRONT_AND_BACK" else (face,)
    parts = ("GL_AMBIENT", "GL_DIFFUSE") if "AND" in parameter else (parameter,)
    return {
        "GL_COLOR_MATERIAL": True,
        "GL_COLOR_MATERIAL_FACE": face,
        "GL_COLOR_MATERIAL_PARAMETER": parameter,
        "GL_CURRENT_COLOR": color,
        **{f"{side}.{part}": color for side in faces for part in parts},
    }


@change
def light(rng: np.random.Generator) -> Expected:
    name = f"GL_LIGHT{rng.integers(8)}"
    values: Expected = {
        part: numbers(rng, 4) for part in ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR")
    }
    values["GL_POSITION"] = numbers(rng, 4, -9, 9)
    values["GL_SPOT_DIRECTION"] = numbers(rng, 3, -1, 1)
    eye_space()
    for part, vector in values.items():
        gl.glLightfv(enum(name), enum(part), array(vector))
    single: Expected = {
        "GL_CONSTANT_ATTENUATION": number(rng),
        "GL_LINEAR_ATTENUATION": number(rng),
        "GL_QUADRATIC_ATTENUATION": number(rng),
        "GL_SPOT_EXPONENT": number(rng, 0, 128),
        "GL_SPOT_CUTOFF": number(rng, 0, 90),
    }
    for part, value in single.items():
        gl.glLightf(enum(name), enum(part), value)
    return AT_EYE | {f"{name}.{part}": value for part, value in (values | single).items()}


@change
def points_and_lines(rng: np.random.Generator) -> Expected:
    size, least, most, fade, width = numbers(rng, 5, 1, 8)
    attenuation, origin = numbers(rng, 3), one(rng, "LOWER_LEFT UPPER_LEFT")
    repeat, pattern = int(rng.integers(1, 256)), int(rng.integers(0xFFFF))
    gl.glPointSize(size)
    gl.glPointParameterf(gl.GL_POINT_SIZE_MIN, least)
    gl.glPointParameterf(gl.GL_POINT_SIZE_MAX, most)
    gl.glPointParameterf(gl.GL_POINT_FADE_THRESHOLD_SIZE, fade)
    gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, array(attenuation))
    gl.glPointParameteri(gl.GL_POINT_SPRITE_COORD_ORIGIN, enum(origin))
    gl.glLineWidth(width)
    gl.glLineStipple(repeat, pattern)
    return {
        "GL_POINT_SIZE": size,
        "GL_POINT_SIZE_MIN": least,
        "GL_POINT_SIZE_MAX": most,
        "GL_POINT_FADE_THRESHOLD_SIZE": fade,
        "GL_POINT_DISTANCE_ATTENUATION": attenuation,
        "GL_POINT_SPRITE_COORD_ORIGIN": origin,
        "GL_LINE_WIDTH": width,
        "GL_LINE_STIPPLE_REPEAT": repeat,
        "GL_LINE_STIPPLE_PATTERN": pattern,
    }


@change
def polygons(rng: np.random.Generator) -> Expected:
    cull, front = one(rng, FACES), one(rng, "CW CCW")
    modes = [one(rng, "POINT LINE FILL") for _ in range(2)]
    factor, units = numbers(rng, 2, -4, 4)
    coverage, invert = number(rng), flag(rng)
    gl.glCullFace(enum(cull))
    gl.glFrontFace(enum(front))
    gl.glPolygonMode(gl.GL_FRONT, enum(modes[0]))
    gl.glPolygonMode(gl.GL_BACK, enum(modes[1]))
    gl.glPolygonOffset(factor, units)
    gl.glSampleCoverage(coverage, invert)
    return {
        "GL_CULL_FACE_MODE": cull,
        "GL_FRONT_FACE": front,
        "GL_POLYGON_MODE": modes,
        "GL_POLYGON_OFFSET_FACTOR": factor,
        "GL_POLYGON_OFFSET_UNITS": units,
        "GL_SAMPLE_COVERAGE_VALUE": coverage,
        "GL_SAMPLE_COVERAGE_INVERT": invert,
    }


UNPACKED = (
    *(("SWAP_BYTES", False), ("LSB_FIRST", False), ("IMAGE_HEIGHT", 0), ("SKIP_IMAGES", 0)),
    *(("ROW_LENGTH", 0), ("SKIP_ROWS", 0), ("SKIP_PIXELS", 0), ("ALIGNMENT", 4)),
)


@change
def stipple_and_pixel_maps(rng: np.random.Generator) -> Expected:
    """What comes out of memory by way of the pixel store, which is reset for it."""
    expected: Expected = {f"GL_UNPACK_{name}": value for name, value in UNPACKED}
    for name, value in expected.items():
        gl.glPixelStorei(enum(name), value)
    gl.glBindBuffer(gl.GL_PIXEL_UNPACK_BUFFER, 0)
    expected["GL_PIXEL_UNPACK_BUFFER_BINDING"] = 0
    pattern = rng.integers(0, 256, 128, np.uint8)
    gl.glPolygonStipple(pattern)
    expected["GL_POLYGON_STIPPLE.pattern"] = np.ascontiguousarray(pattern).view(">u4").tolist()
    for part in ("R_TO_R", "G_TO_G", "B_TO_B", "A_TO_A", "I_TO_R", "I_TO_G", "I_TO_B", "I_TO_A"):
        values = numbers(rng, 2 ** int(rng.integers(1, 4)))
        gl.glPixelMapfv(enum(f"GL_PIXEL_MAP_{part}"), len(values), array(values))
        expected[f"GL_PIXEL_MAP_{part}"] = values
    for name in ("I_TO_I", "S_TO_S"):
        values = [float(v) for v in rng.integers(1, 99, 4)]
        gl.glPixelMapfv(enum(f"GL_PIXEL_MAP_{name}"), 4, array(values))
        expected[f"GL_PIXEL_MAP_{name}"] = values
    return expected


@change
def pixel_store(rng: np.random.Generator) -> Expected:
    expected: Expected = {}
    for name, initial in UNPACKED:
        for way in ("PACK", "UNPACK"):
            value = flag(rng) if initial is False else int(rng.integers(1, 99))
            value = int(2 ** rng.integers(4)) if name == "ALIGNMENT" else value
            gl.glPixelStorei(enum(f"GL_{way}_{name}"), value)
            expected[f"GL_{way}_{name}"] = value
    return expected


@change
def pixel_transfer(rng: np.random.Generator) -> Expected:
    expected: Expected = {}
    for name in ("GL_MAP_COLOR", "GL_MAP_STENCIL"):
        expected[name] = flag(rng)
        gl.glPixelTransferi(enum(name), expected[name])
    for name in ("GL_INDEX_SHIFT", "GL_INDEX_OFFSET"):
        expected[name] = int(rng.integers(9))
        gl.glPixelTransferi(enum(name), expected[name])
    for part in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH"):
        for name in (f"GL_{part}_SCALE", f"GL_{part}_BIAS"):
            expected[name] = number(rng, -2, 2)
            gl.glPixelTransferf(enum(name), expected[name])
    zoom = numbers(rng, 2, -4, 4)
    gl.glPixelZoom(*zoom)
    return expected | {"GL_ZOOM_X": zoom[0], "GL_ZOOM_Y": zoom[1]}


@change
def texture_unit(rng: np.random.Generator) -> Expected:
    name = unit(rng)
    values: Expected = {}
    for target in ("1D", "2D", "3D", "CUBE_MAP", "RECTANGLE"):
        on = values[f"GL_TEXTURE_{target}"] = flag(rng)
        (gl.glEnable if on else gl.glDisable)(enum(f"GL_TEXTURE_{target}"))
    for k, target in enumerate(("1D", "2D", "3D", "CUBE_MAP", "RECTANGLE")):
        texture = 10 * k + int(rng.integers(1, 9))  # a texture's first target is its only one
        gl.glBindTexture(enum(f"GL_TEXTURE_{target}"), texture)
        values[f"GL_TEXTURE_BINDING_{target}"] = texture
    bias, replaced = number(rng, -2, 2), flag(rng)
    gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, bias)
    gl.glTexEnvi(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE, replaced)
    values["GL_TEXTURE_FILTER_CONTROL.GL_TEXTURE_LOD_BIAS"] = bias
    values["GL_POINT_SPRITE.GL_COORD_REPLACE"] = replaced
    return in_unit(name, values)


@change
def texture_environment(rng: np.random.Generator) -> Expected:
    name = unit(rng)
    parts = "REPLACE MODULATE ADD ADD_SIGNED INTERPOLATE SUBTRACT"
    chosen = {
        "TEXTURE_ENV_MODE": one(rng, "MODULATE DECAL BLEND REPLACE ADD COMBINE"),
        "COMBINE_RGB": one(rng, f"{parts} DOT3_RGB DOT3_RGBA"),
        "COMBINE_ALPHA": one(rng, parts),
    }
    for k in range(3):
        for part in ("RGB", "ALPHA"):
            sources = "TEXTURE CONSTANT PRIMARY_COLOR PREVIOUS TEXTURE1 TEXTURE5"
            chosen[f"SRC{k}_{part}"] = one(rng, sources)
            colors = "" if part == "ALPHA" else "SRC_COLOR ONE_MINUS_SRC_COLOR "
            operand = one(rng, f"{colors}SRC_ALPHA ONE_MINUS_SRC_ALPHA")
            chosen[f"OPERAND{k}_{part}"] = operand

    for rest, value in chosen.items():
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, enum(f"GL_{rest}"), enum(value))
    color, scales = numbers(rng, 4), [float(2 ** rng.integers(3)) for _ in range(2)]
    gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, array(color))
    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, scales[0])
    gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_ALPHA_SCALE, scales[1])
    numeric = {"TEXTURE_ENV_COLOR": color, "RGB_SCALE": scales[0], "ALPHA_SCALE": scales[1]}
    both: Expected = {**chosen, **numeric}
    return in_unit(name, {f"GL_TEXTURE_ENV.GL_{rest}": value for rest, value in both.items()})


@change
def texture_generation(rng: np.random.Generator) -> Expected:
    name = unit(rng)
    eye_space()
    values: Expected = {}
    for axis in "STRQ":
        on = values[f"GL_TEXTURE_GEN_{axis}"] = flag(rng)
        (gl.glEnable if on else gl.glDisable)(enum(f"GL_TEXTURE_GEN_{axis}"))
        more = {"S": " SPHERE_MAP", "T": " SPHERE_MAP", "R": " NORMAL_MAP REFLECTION_MAP"}
        mode = one(rng, "EYE_LINEAR OBJECT_LINEAR" + more.get(axis, ""))
        gl.glTexGeni(enum(f"GL_{axis}"), gl.GL_TEXTURE_GEN_MODE, enum(mode))
        values[f"GL_{axis}.GL_TEXTURE_GEN_MODE"] = mode
        for plane in ("GL_OBJECT_PLANE", "GL_EYE_PLANE"):
            values[f"GL_{axis}.{plane}"] = vector = numbers(rng, 4, -4, 4)
            gl.glTexGenfv(enum(f"GL_{axis}"), enum(plane), array(vector))
    return AT_EYE | in_unit(name, values)


@change
def fragment_tests(rng: np.random.Generator) -> Expected:
    alpha = one(rng, COMPARISONS)
    reference = number(rng)
    depth = one(rng, COMPARISONS)
    gl.glAlphaFunc(enum(alpha), reference)
    gl.glDepthFunc(enum(depth))
    expected: Expected = {
        "GL_ALPHA_TEST_FUNC": alpha,
        "GL_ALPHA_TEST_REF": reference,
        "GL_DEPTH_FUNC": depth,
    }
    for face, prefix in (("GL_FRONT", "GL_STENCIL"), ("GL_BACK", "GL_STENCIL_BACK")):
        compared, value, mask, written = one(rng, COMPARISONS), *map(int, rng.integers(0, 255, 3))
        fails = [one(rng, OPERATIONS) for _ in range(3)]
        gl.glStencilFuncSeparate(enum(face), enum(compared), value, mask)
        gl.glStencilOpSeparate(enum(face), *map(enum, fails))
        gl.glStencilMaskSeparate(enum(face), written)
        expected |= {
            f"{prefix}_FUNC": compared,
            f"{prefix}_REF": value,
            f"{prefix}_VALUE_MASK": mask,
            f"{prefix}_FAIL": fails[0],
            f"{prefix}_PASS_DEPTH_FAIL": fails[1],
            f"{prefix}_PASS_DEPTH_PASS": fails[2],
            f"{prefix}_WRITEMASK": written,
        }

    return expected


@change
def blending(rng: np.random.Generator) -> Expected:
    factors = [one(rng, FACTORS) for _ in range(4)]
    equations = [one(rng, "FUNC_ADD FUNC_SUBTRACT FUNC_REVERSE_SUBTRACT MIN MAX") for _ in "ab"]
    color, logic = numbers(rng, 4), one(rng, "AND COPY_INVERTED XOR NOOP SET")
    gl.glBlendFuncSeparate(*map(enum, factors))
    gl.glBlendEquationSeparate(*map(enum, equations))
    gl.glBlendColor(*color)
    gl.glLogicOp(enum(logic))
    names = ("SRC_RGB", "DST_RGB", "SRC_ALPHA", "DST_ALPHA", "EQUATION_RGB", "EQUATION_ALPHA")
    chosen = zip(names, (*factors, *equations), strict=True)
    found = {f"GL_BLEND_{name}": value for name, value in chosen}
    return {**found, "GL_BLEND_COLOR": color, "GL_LOGIC_OP_MODE": logic}


@change
def masks_and_clearing(rng: np.random.Generator) -> Expected:
    colors = [flag(rng) for _ in range(4)]
    depth = flag(rng)
    index = int(rng.integers(255))
    color, accum = numbers(rng, 4), numbers(rng, 4, -1, 1)
    values = [number(rng), float(rng.integers(99)), int(rng.integers(99))]
    gl.glColorMask(*colors)
    gl.glDepthMask(depth)
    gl.glIndexMask(index)
    gl.glClearColor(*color)
    gl.glClearAccum(*accum)
    gl.glClearDepth(values[0])
    gl.glClearIndex(values[1])
    gl.glClearStencil(values[2])
    return {
        "GL_COLOR_WRITEMASK": colors,
        "GL_DEPTH_WRITEMASK": depth,
        "GL_INDEX_WRITEMASK": index,
        "GL_COLOR_CLEAR_VALUE": color,
        "GL_ACCUM_CLEAR_VALUE": accum,
        "GL_DEPTH_CLEAR_VALUE": values[0],
        "GL_INDEX_CLEAR_VALUE": values[1],
        "GL_STENCIL_CLEAR_VALUE": values[2],
    }


@change
def buffers_drawn_and_read(rng: np.random.Generator) -> Expected:
    draw, read = one(rng, "NONE FRONT_LEFT"), one(rng, "NONE FRONT_LEFT")
    gl.glDrawBuffer(enum(draw))
    gl.glReadBuffer(enum(read))
    return {"GL_DRAW_BUFFER": draw, "GL_READ_BUFFER": read}


@change
def hints(rng: np.random.Generator) -> Expected:
    expected: Expected = {}
    for name in (
        *("PERSPECTIVE_CORRECTION_HINT", "POINT_SMOOTH_HINT", "LINE_SMOOTH_HINT", "FOG_HINT"),
        *("POLYGON_SMOOTH_HINT", "GENERATE_MIPMAP_HINT", "TEXTURE_COMPRESSION_HINT"),
    ):
        value = expected[f"GL_{name}"] = one(rng, "DONT_CARE FASTEST NICEST")
        gl.glHint(enum(f"GL_{name}"), enum(value))
    return expected


@change
def evaluator(rng: np.random.Generator) -> Expected:
    gl.glActiveTexture(gl.GL_TEXTURE0)  # with another one OpenGL refuses evaluators
    expected: Expected = {"GL_ACTIVE_TEXTURE": "GL_TEXTURE0"}
    for name, size in EVALUATED.items():
        domain, order = [0.0, number(rng, 1, 3)], int(rng.integers(2, 5))
        points = numbers(rng, order * size)
        curve = f"GL_MAP1_{name}"
        gl.glMap1f(enum(curve), *domain, array(points).reshape(order, size))
        expected |= {f"{curve}.GL_ORDER": order, f"{curve}.GL_DOMAIN": domain}
        expected[f"{curve}.GL_COEFF"] = points
        domain = [*domain, -1.0, number(rng, 1, 3)]
        orders = [order, int(rng.integers(2, 5))]
        points = numbers(rng, orders[0] * orders[1] * size)
        patch = f"GL_MAP2_{name}"
        gl.glMap2f(enum(patch), *domain, array(points).reshape(*orders, size))
        expected |= {f"{patch}.GL_ORDER": orders, f"{patch}.GL_DOMAIN": domain}
        expected[f"{patch}.GL_COEFF"] = points
    return expected


@change
def evaluator_grids(rng: np.random.Generator) -> Expected:
    steps, ends = [int(v) for v in rng.integers(1, 99, 3)], numbers(rng, 6, -4, 4)
    gl.glMapGrid1f(steps[0], *ends[:2])
    gl.glMapGrid2f(steps[1], *ends[2:4], steps[2], *ends[4:6])
    return {
        "GL_MAP1_GRID_SEGMENTS": steps[0],
        "GL_MAP1_GRID_DOMAIN": ends[:2],
        "GL_MAP2_GRID_SEGMENTS": steps[1:],
        "GL_MAP2_GRID_DOMAIN": ends[2:],
    }


ARRAYS: dict[str, tuple[str, tuple[int, ...], str]] = {
    "VERTEX_ARRAY": ("glVertexPointer", (2, 3, 4), TYPES),
    "NORMAL_ARRAY": ("glNormalPointer", (), "BYTE SHORT INT FLOAT DOUBLE"),
    "FOG_COORD_ARRAY": ("glFogCoordPointer", (), "FLOAT DOUBLE"),
    "COLOR_ARRAY": ("glColorPointer", (3, 4), "BYTE UNSIGNED_BYTE UNSIGNED_SHORT FLOAT"),
    "SECONDARY_COLOR_ARRAY": ("glSecondaryColorPointer", (3,), "BYTE UNSIGNED_INT FLOAT"),
    "INDEX_ARRAY": ("glIndexPointer", (), TYPES),
    "EDGE_FLAG_ARRAY": ("glEdgeFlagPointer", (), ""),
    "TEXTURE_COORD_ARRAY": ("glTexCoordPointer", (1, 2, 3, 4), TYPES),
}
MEMORY = np.zeros(64, np.uint8)


@change
def client_arrays(rng: np.random.Generator) -> Expected:
    expected: Expected = {}
    for name in ARRAYS:
        expected |= client_array(rng, name)
    return expected


def client_array(rng: np.random.Generator, name: str) -> Expected:
    function, sizes, types = ARRAYS[name]
    active, full = unit(rng), f"GL_{name}"
    buffer = int(rng.integers(3))
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, buffer)
    address = 4 * int(rng.integers(9)) + (0 if buffer else MEMORY.ctypes.data)
    on, stride = flag(rng), 4 * int(rng.integers(9))
    (gl.glEnableClientState if on else gl.glDisableClientState)(enum(full))
    values: Expected = {full: on, f"{full}_STRIDE": stride, f"{full}_POINTER": address}
    values[f"{full}_BUFFER_BINDING"] = buffer
    args: list[int] = []
    if sizes:
        values[f"{full}_SIZE"] = int(rng.choice(sizes))
        args.append(values[f"{full}_SIZE"])
    if types:
        values[f"{full}_TYPE"] = one(rng, types)
        args.append(enum(values[f"{full}_TYPE"]))
    getattr(gl, function)(*args, stride, ctypes.c_void_p(address))
    if name == "TEXTURE_COORD_ARRAY":
        values = in_unit(active, values)
    return in_unit(active, {}) | values | {"GL_ARRAY_BUFFER_BINDING": buffer}


@change
def buffers(rng: np.random.Generator) -> Expected:
    expected: Expected = {}
    for k, (target, name) in enumerate(
        (
            ("ARRAY_BUFFER", "ARRAY_BUFFER_BINDING"),
            ("ELEMENT_ARRAY_BUFFER", "ELEMENT_ARRAY_BUFFER_BINDING"),
            ("PIXEL_PACK_BUFFER", "PIXEL_PACK_BUFFER_BINDING"),
            ("PIXEL_UNPACK_BUFFER", "PIXEL_UNPACK_BUFFER_BINDING"),
        )
    ):
        expected[f"GL_{name}"] = 10 * k + int(rng.integers(3))
        gl.glBindBuffer(enum(f"GL_{target}"), expected[f"GL_{name}"])
    base = expected["GL_LIST_BASE"] = int(rng.integers(99))
    gl.glListBase(base)
    return expected


def scrambled(seed: int, count: int = 150) -> None:
    """Change the state at random, within matrix stacks of random depth."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        CHANGES[int(rng.integers(len(CHANGES)))](rng)
        if rng.random() < 0.1:
            mode = rng.choice(["GL_MODELVIEW", "GL_PROJECTION", "GL_TEXTURE"])
            gl.glMatrixMode(int(getattr(gl, str(mode))))
            gl.glPushMatrix()
            gl.glTranslatef(*rng.integers(-9, 9, 3).astype(float).tolist())
