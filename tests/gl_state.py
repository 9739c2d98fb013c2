"""The whole state of classic OpenGL as a dictionary, for the tests' state check.

Every group of glPushAttrib is here, the matrices and stacks, the client state, and the bindings of
later versions that the program uses. Left out is what OpenGL leaves undefined after a draw call:
the current normal and texture coordinates, which each element that reads them sends.
"""

import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from landscape.gl.calls import gl

CAPS = (
    *("ALPHA_TEST", "BLEND", "COLOR_LOGIC_OP", "DITHER", "DEPTH_TEST", "STENCIL_TEST"),
    *("SCISSOR_TEST", "FOG", "LIGHTING", "COLOR_MATERIAL", "NORMALIZE", "RESCALE_NORMAL"),
    *("COLOR_SUM", "CULL_FACE", "POLYGON_OFFSET_FILL", "POLYGON_OFFSET_LINE", "POLYGON_SMOOTH"),
    *("POLYGON_OFFSET_POINT", "POLYGON_STIPPLE", "LINE_SMOOTH", "LINE_STIPPLE", "POINT_SMOOTH"),
    *("MULTISAMPLE", "SAMPLE_ALPHA_TO_COVERAGE", "SAMPLE_ALPHA_TO_ONE", "SAMPLE_COVERAGE"),
    *("AUTO_NORMAL", "POINT_SPRITE", "VERTEX_PROGRAM_POINT_SIZE"),
    *(f"LIGHT{k}" for k in range(8)),
    *(f"CLIP_PLANE{k}" for k in range(6)),
    # Client state.
    *("VERTEX_ARRAY", "NORMAL_ARRAY", "COLOR_ARRAY", "SECONDARY_COLOR_ARRAY", "INDEX_ARRAY"),
    *("FOG_COORD_ARRAY", "EDGE_FLAG_ARRAY"),
)
"""What glEnable and glEnableClientState switch for all texture units together."""

VALUES = (
    # Stacks and matrices.
    *("MATRIX_MODE", "MODELVIEW_STACK_DEPTH", "PROJECTION_STACK_DEPTH", "NAME_STACK_DEPTH"),
    *("ATTRIB_STACK_DEPTH", "CLIENT_ATTRIB_STACK_DEPTH", "MODELVIEW_MATRIX", "PROJECTION_MATRIX"),
    # Current values, points, lines, polygons.
    *("CURRENT_COLOR", "CURRENT_SECONDARY_COLOR", "CURRENT_FOG_COORD", "EDGE_FLAG"),
    *("POINT_SIZE", "POINT_SIZE_MIN", "POINT_SIZE_MAX", "POINT_DISTANCE_ATTENUATION"),
    *("LINE_WIDTH", "LINE_STIPPLE_PATTERN", "LINE_STIPPLE_REPEAT", "POLYGON_MODE"),
    *("CULL_FACE_MODE", "FRONT_FACE", "POLYGON_OFFSET_FACTOR", "POLYGON_OFFSET_UNITS"),
    # Light and fog.
    *("SHADE_MODEL", "COLOR_MATERIAL_FACE", "COLOR_MATERIAL_PARAMETER", "LIGHT_MODEL_AMBIENT"),
    *("LIGHT_MODEL_LOCAL_VIEWER", "LIGHT_MODEL_TWO_SIDE", "LIGHT_MODEL_COLOR_CONTROL"),
    *("FOG_MODE", "FOG_DENSITY", "FOG_START", "FOG_END", "FOG_COLOR", "FOG_COORD_SRC"),
    # Fragments and the framebuffer.
    *("ALPHA_TEST_FUNC", "ALPHA_TEST_REF", "BLEND_SRC_RGB", "BLEND_DST_RGB", "BLEND_SRC_ALPHA"),
    *("BLEND_DST_ALPHA", "BLEND_EQUATION_RGB", "BLEND_EQUATION_ALPHA", "BLEND_COLOR"),
    *("LOGIC_OP_MODE", "COLOR_WRITEMASK", "COLOR_CLEAR_VALUE", "DRAW_BUFFER", "READ_BUFFER"),
    *("DEPTH_FUNC", "DEPTH_WRITEMASK", "DEPTH_CLEAR_VALUE", "DEPTH_RANGE", "VIEWPORT"),
    *("STENCIL_FUNC", "STENCIL_REF", "STENCIL_VALUE_MASK", "STENCIL_WRITEMASK", "STENCIL_FAIL"),
    *("STENCIL_PASS_DEPTH_FAIL", "STENCIL_PASS_DEPTH_PASS", "STENCIL_CLEAR_VALUE"),
    *("STENCIL_BACK_FUNC", "STENCIL_BACK_REF", "STENCIL_BACK_WRITEMASK", "SCISSOR_BOX"),
    *("SAMPLE_COVERAGE_VALUE", "SAMPLE_COVERAGE_INVERT"),
    # Hints, lists, pixels.
    *("FOG_HINT", "LINE_SMOOTH_HINT", "POINT_SMOOTH_HINT", "POLYGON_SMOOTH_HINT"),
    *("PERSPECTIVE_CORRECTION_HINT", "GENERATE_MIPMAP_HINT", "LIST_BASE", "LIST_INDEX"),
    *("LIST_MODE", "RENDER_MODE", "MAP_COLOR", "MAP_STENCIL", "ZOOM_X", "ZOOM_Y"),
    *("RED_SCALE", "GREEN_SCALE", "BLUE_SCALE", "ALPHA_SCALE", "DEPTH_SCALE"),
    *("RED_BIAS", "GREEN_BIAS", "BLUE_BIAS", "ALPHA_BIAS", "DEPTH_BIAS"),
    # Bindings.
    *("ACTIVE_TEXTURE", "CLIENT_ACTIVE_TEXTURE", "ARRAY_BUFFER_BINDING"),
    *("ELEMENT_ARRAY_BUFFER_BINDING", "PIXEL_PACK_BUFFER_BINDING", "PIXEL_UNPACK_BUFFER_BINDING"),
    *("DRAW_FRAMEBUFFER_BINDING", "READ_FRAMEBUFFER_BINDING", "RENDERBUFFER_BINDING"),
    "CURRENT_PROGRAM",
)
"""What glGetFloatv returns for all texture units together."""

PIXEL_STORE = tuple(
    f"{way}_{name}"
    for way in ("PACK", "UNPACK")
    for name in ("ROW_LENGTH", "SKIP_ROWS", "SKIP_PIXELS", "SWAP_BYTES", "LSB_FIRST")
)
"""How images are laid out in memory; the alignment is set before each transfer."""

LIGHTS = range(2)
LIGHT = (
    *("AMBIENT", "DIFFUSE", "SPECULAR", "POSITION", "SPOT_DIRECTION", "SPOT_EXPONENT"),
    *("SPOT_CUTOFF", "CONSTANT_ATTENUATION", "LINEAR_ATTENUATION", "QUADRATIC_ATTENUATION"),
)
MATERIAL = ("AMBIENT", "DIFFUSE", "SPECULAR", "EMISSION", "SHININESS")

UNITS = range(4)
TARGETS = ("TEXTURE_1D", "TEXTURE_2D", "TEXTURE_3D", "TEXTURE_CUBE_MAP")
ENVIRONMENT = (
    *("TEXTURE_ENV_MODE", "TEXTURE_ENV_COLOR", "RGB_SCALE", "ALPHA_SCALE"),
    *("COMBINE_RGB", "COMBINE_ALPHA"),
    *(
        f"{kind}{k}_{part}"
        for kind in ("SRC", "OPERAND")
        for k in range(3)
        for part in ("RGB", "ALPHA")
    ),
)
GENERATED = ("TEXTURE_GEN_MODE", "OBJECT_PLANE", "EYE_PLANE")


BUFFER = np.zeros(16, np.float32)  # large enough for a matrix, the largest of all values


@functools.cache
def _enum(name: str) -> int:
    return int(getattr(gl, f"GL_{name}"))


def _get(get: Callable[..., Any], *names: str) -> tuple[float, ...]:
    """Return what a query gives. PyOpenGL does not know the size of every value, so BUFFER does."""
    BUFFER.fill(0.0)
    get(*map(_enum, names), BUFFER)
    return tuple(BUFFER.tolist())


def _enabled(name: str) -> bool:
    return bool(gl.glIsEnabled(_enum(name)))


def snapshot() -> dict[str, Any]:
    """Return the state that elements share, by name."""
    state: dict[str, Any] = {"error": int(gl.glGetError())}
    for name in (*VALUES, *PIXEL_STORE):
        state[name] = _get(gl.glGetFloatv, name)
    for name in CAPS:
        state[name] = _enabled(name)
    for face in ("FRONT", "BACK"):
        for name in MATERIAL:
            state[f"material {face} {name}"] = _get(gl.glGetMaterialfv, face, name)
    for light in LIGHTS:
        for name in LIGHT:
            state[f"LIGHT{light} {name}"] = _get(gl.glGetLightfv, f"LIGHT{light}", name)
    for plane in range(6):
        equation = gl.glGetClipPlane(_enum(f"CLIP_PLANE{plane}"))
        state[f"CLIP_PLANE{plane} equation"] = tuple(map(float, equation))
    active = int(gl.glGetIntegerv(gl.GL_ACTIVE_TEXTURE))
    client = int(gl.glGetIntegerv(gl.GL_CLIENT_ACTIVE_TEXTURE))
    for unit in UNITS:
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        gl.glClientActiveTexture(gl.GL_TEXTURE0 + unit)
        state[f"unit {unit}"] = _unit()
    gl.glActiveTexture(active)
    gl.glClientActiveTexture(client)
    return state


def _unit() -> dict[str, Any]:
    """Return the state of the active texture unit."""
    state: dict[str, Any] = {"matrix": _get(gl.glGetFloatv, "TEXTURE_MATRIX")}
    state["matrices"] = _get(gl.glGetFloatv, "TEXTURE_STACK_DEPTH")
    state["coordinates sent"] = _enabled("TEXTURE_COORD_ARRAY")
    state["LOD bias"] = _get(gl.glGetTexEnvfv, "TEXTURE_FILTER_CONTROL", "TEXTURE_LOD_BIAS")
    for name in TARGETS:
        state[name] = _enabled(name)
        state[f"{name} bound"] = _get(gl.glGetFloatv, name.replace("TEXTURE_", "TEXTURE_BINDING_"))
    for name in ENVIRONMENT:
        state[name] = _get(gl.glGetTexEnvfv, "TEXTURE_ENV", name)
    for axis in "STRQ":
        state[f"TEXTURE_GEN_{axis}"] = _enabled(f"TEXTURE_GEN_{axis}")
        for name in GENERATED:
            state[f"{axis} {name}"] = _get(gl.glGetTexGenfv, axis, name)
    return state


def _shown(value: Any) -> Any:
    """Return a value without the zeros that fill BUFFER."""
    return tuple(np.trim_zeros(value, "b")) if isinstance(value, tuple) else value


def changes(before: Mapping[str, Any], after: Mapping[str, Any]) -> dict[str, tuple[Any, Any]]:
    """Return the differences between two snapshots: name to (before, after)."""
    found: dict[str, tuple[Any, Any]] = {}
    for name, value in before.items():
        if isinstance(value, Mapping):
            parts = changes(value, after[name])
            found |= {f"{name} {part}": pair for part, pair in parts.items()}
        elif value != after[name]:
            found[name] = (_shown(value), _shown(after[name]))
    return found
