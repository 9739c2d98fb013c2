"""Which variables of the state a call sets, by the names of :mod:`framelens.state.state`.

In the table, {light} stands for the enumerant of the parameter "light", {unit} for the active
texture unit, {client} for that of the client arrays, {matrix} for the current matrix stack
(GL_MODELVIEW, GL_PROJECTION or GL_TEXTURE0.GL_TEXTURE), and {side} for nothing, _BACK or both, as
the parameter "face" says.
"""

import itertools
import re
from collections.abc import Mapping, Sequence

from framelens.spec.spec_arguments import function, name_in
from framelens.spec.spec_table import names
from framelens.spec.spec_values import written

ARRAY = "{0}_TYPE {0}_STRIDE {0}_POINTER {0}_BUFFER_BINDING"
SIZED = "{0}_SIZE " + ARRAY
MATRIX = "{matrix}_MATRIX"
RASTER = (
    "GL_CURRENT_RASTER_POSITION GL_CURRENT_RASTER_POSITION_VALID GL_CURRENT_RASTER_DISTANCE "
    "GL_CURRENT_RASTER_COLOR"
)

SETS = {
    # Current values.
    "glColor": "GL_CURRENT_COLOR",
    "glSecondaryColor": "GL_CURRENT_SECONDARY_COLOR",
    "glIndex": "GL_CURRENT_INDEX",
    "glNormal": "GL_CURRENT_NORMAL",
    "glTexCoord": "GL_TEXTURE0.GL_CURRENT_TEXTURE_COORDS",
    "glMultiTexCoord": "{target}.GL_CURRENT_TEXTURE_COORDS",
    "glFogCoord": "GL_CURRENT_FOG_COORD",
    "glEdgeFlag": "GL_EDGE_FLAG",
    "glEdgeFlagv": "GL_EDGE_FLAG",
    "glRasterPos": RASTER,
    "glWindowPos": RASTER,
    "glBitmap": "GL_CURRENT_RASTER_POSITION",
    # Matrices and the viewport.
    "glMatrixMode": "GL_MATRIX_MODE",
    **dict.fromkeys(
        (
            *("glLoadIdentity", "glLoadMatrix", "glMultMatrix", "glLoadTransposeMatrix"),
            *("glMultTransposeMatrix", "glRotate", "glTranslate", "glScale", "glOrtho"),
            *("glFrustum", "gluPerspective", "gluLookAt", "gluOrtho2D", "gluPickMatrix"),
        ),
        MATRIX,
    ),
    "glPushMatrix": "{matrix}_STACK {matrix}_STACK_DEPTH",
    "glPopMatrix": f"{MATRIX} {{matrix}}_STACK {{matrix}}_STACK_DEPTH",
    "glViewport": "GL_VIEWPORT",
    "glDepthRange": "GL_DEPTH_RANGE",
    "glClipPlane": "{plane}.equation",
    # Capabilities that glEnable switches.
    "glEnable": "{cap}",
    "glDisable": "{cap}",
    "glEnableClientState": "{array}",
    "glDisableClientState": "{array}",
    # Points, lines, polygons.
    "glPointSize": "GL_POINT_SIZE",
    "glPointParameter": "{pname}",
    "glLineWidth": "GL_LINE_WIDTH",
    "glLineStipple": "GL_LINE_STIPPLE_PATTERN GL_LINE_STIPPLE_REPEAT",
    "glCullFace": "GL_CULL_FACE_MODE",
    "glFrontFace": "GL_FRONT_FACE",
    "glPolygonMode": "GL_POLYGON_MODE",
    "glPolygonOffset": "GL_POLYGON_OFFSET_FACTOR GL_POLYGON_OFFSET_UNITS",
    "glPolygonStipple": "GL_POLYGON_STIPPLE.pattern",
    "glSampleCoverage": "GL_SAMPLE_COVERAGE_VALUE GL_SAMPLE_COVERAGE_INVERT",
    # Light and fog.
    "glShadeModel": "GL_SHADE_MODEL",
    "glLight": "{light}.{pname}",
    "glLightModel": "{pname}",
    "glMaterial": "{face}.{pname}",
    "glColorMaterial": "GL_COLOR_MATERIAL_FACE GL_COLOR_MATERIAL_PARAMETER",
    "glFog": "{pname}",
    # Textures.
    "glActiveTexture": "GL_ACTIVE_TEXTURE",
    "glBindTexture": "{unit}.{target}_BINDING",
    "glTexParameter": "{target}.{pname}",
    "glTexEnv": "{unit}.{target}.{pname}",
    "glTexGen": "{unit}.{coord}.{pname}",
    # Fragments and the framebuffer.
    "glScissor": "GL_SCISSOR_BOX",
    "glAlphaFunc": "GL_ALPHA_TEST_FUNC GL_ALPHA_TEST_REF",
    "glStencilFunc": "GL_STENCIL_FUNC GL_STENCIL_REF GL_STENCIL_VALUE_MASK GL_STENCIL_BACK_FUNC "
    "GL_STENCIL_BACK_REF GL_STENCIL_BACK_VALUE_MASK",
    "glStencilOp": "GL_STENCIL_FAIL GL_STENCIL_PASS_DEPTH_FAIL GL_STENCIL_PASS_DEPTH_PASS "
    "GL_STENCIL_BACK_FAIL GL_STENCIL_BACK_PASS_DEPTH_FAIL GL_STENCIL_BACK_PASS_DEPTH_PASS",
    "glStencilMask": "GL_STENCIL_WRITEMASK GL_STENCIL_BACK_WRITEMASK",
    "glStencilFuncSeparate": "GL_STENCIL{side}_FUNC GL_STENCIL{side}_REF "
    "GL_STENCIL{side}_VALUE_MASK",
    "glStencilOpSeparate": "GL_STENCIL{side}_FAIL GL_STENCIL{side}_PASS_DEPTH_FAIL "
    "GL_STENCIL{side}_PASS_DEPTH_PASS",
    "glStencilMaskSeparate": "GL_STENCIL{side}_WRITEMASK",
    "glDepthFunc": "GL_DEPTH_FUNC",
    "glDepthMask": "GL_DEPTH_WRITEMASK",
    "glBlendFunc": "GL_BLEND_SRC_RGB GL_BLEND_DST_RGB GL_BLEND_SRC_ALPHA GL_BLEND_DST_ALPHA",
    "glBlendFuncSeparate": "GL_BLEND_SRC_RGB GL_BLEND_DST_RGB GL_BLEND_SRC_ALPHA "
    "GL_BLEND_DST_ALPHA",
    "glBlendEquation": "GL_BLEND_EQUATION_RGB GL_BLEND_EQUATION_ALPHA",
    "glBlendEquationSeparate": "GL_BLEND_EQUATION_RGB GL_BLEND_EQUATION_ALPHA",
    "glBlendColor": "GL_BLEND_COLOR",
    "glLogicOp": "GL_LOGIC_OP_MODE",
    "glColorMask": "GL_COLOR_WRITEMASK",
    "glIndexMask": "GL_INDEX_WRITEMASK",
    "glDrawBuffer": "GL_DRAW_BUFFER",
    "glReadBuffer": "GL_READ_BUFFER",
    "glClearColor": "GL_COLOR_CLEAR_VALUE",
    "glClearDepth": "GL_DEPTH_CLEAR_VALUE",
    "glClearStencil": "GL_STENCIL_CLEAR_VALUE",
    "glClearAccum": "GL_ACCUM_CLEAR_VALUE",
    "glClearIndex": "GL_INDEX_CLEAR_VALUE",
    "glBindFramebuffer": "{target}_BINDING",
    "glBindRenderbuffer": "{target}_BINDING",
    # Pixels, evaluators, hints.
    "glPixelStore": "{pname}",
    "glPixelTransfer": "{pname}",
    "glPixelMap": "{map}",
    "glPixelZoom": "GL_ZOOM_X GL_ZOOM_Y",
    "glMap1": "{target}.GL_ORDER {target}.GL_DOMAIN {target}.GL_COEFF",
    "glMap2": "{target}.GL_ORDER {target}.GL_DOMAIN {target}.GL_COEFF",
    "glMapGrid1": "GL_MAP1_GRID_DOMAIN GL_MAP1_GRID_SEGMENTS",
    "glMapGrid2": "GL_MAP2_GRID_DOMAIN GL_MAP2_GRID_SEGMENTS",
    "glHint": "{target}",
    # Arrays and buffers.
    "glClientActiveTexture": "GL_CLIENT_ACTIVE_TEXTURE",
    "glVertexPointer": SIZED.format("GL_VERTEX_ARRAY"),
    "glColorPointer": SIZED.format("GL_COLOR_ARRAY"),
    "glSecondaryColorPointer": SIZED.format("GL_SECONDARY_COLOR_ARRAY"),
    "glTexCoordPointer": SIZED.format("{client}.GL_TEXTURE_COORD_ARRAY"),
    "glNormalPointer": ARRAY.format("GL_NORMAL_ARRAY"),
    "glFogCoordPointer": ARRAY.format("GL_FOG_COORD_ARRAY"),
    "glIndexPointer": ARRAY.format("GL_INDEX_ARRAY"),
    "glEdgeFlagPointer": "GL_EDGE_FLAG_ARRAY_STRIDE GL_EDGE_FLAG_ARRAY_POINTER "
    "GL_EDGE_FLAG_ARRAY_BUFFER_BINDING",
    "glInterleavedArrays": " ".join(
        f"{array} {SIZED.format(array)}"
        for array in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY", "{client}.GL_TEXTURE_COORD_ARRAY")
    )
    + f" GL_NORMAL_ARRAY {ARRAY.format('GL_NORMAL_ARRAY')} GL_INDEX_ARRAY GL_EDGE_FLAG_ARRAY",
    "glBindBuffer": "{target}_BINDING",
    # Stacks, lists, queries, selection.
    "glPushAttrib": "GL_ATTRIB_STACK_DEPTH",
    "glPopAttrib": "GL_ATTRIB_STACK_DEPTH",
    "glPushClientAttrib": "GL_CLIENT_ATTRIB_STACK_DEPTH",
    "glPopClientAttrib": "GL_CLIENT_ATTRIB_STACK_DEPTH",
    "glListBase": "GL_LIST_BASE",
    "glBeginQuery": "{target}.GL_CURRENT_QUERY",
    "glEndQuery": "{target}.GL_CURRENT_QUERY",
    "glRenderMode": "GL_RENDER_MODE",
    "glInitNames": "GL_NAME_STACK_DEPTH",
    "glPushName": "GL_NAME_STACK_DEPTH",
    "glPopName": "GL_NAME_STACK_DEPTH",
    "glSelectBuffer": "GL_SELECTION_BUFFER_SIZE GL_SELECTION_BUFFER_POINTER",
    "glFeedbackBuffer": "GL_FEEDBACK_BUFFER_SIZE GL_FEEDBACK_BUFFER_TYPE "
    "GL_FEEDBACK_BUFFER_POINTER",
}

# Enumerants that stand for two others.
BOTH = {
    "GL_FRONT_AND_BACK": ("GL_FRONT", "GL_BACK"),
    "GL_AMBIENT_AND_DIFFUSE": ("GL_AMBIENT", "GL_DIFFUSE"),
    "GL_FRAMEBUFFER": ("GL_DRAW_FRAMEBUFFER", "GL_READ_FRAMEBUFFER"),
}
SIDES = {"GL_FRONT": ("",), "GL_BACK": ("_BACK",), "GL_FRONT_AND_BACK": ("", "_BACK")}
MODES = {
    "GL_MODELVIEW": "GL_MODELVIEW",
    "GL_PROJECTION": "GL_PROJECTION",
    "GL_TEXTURE": "{unit}.GL_TEXTURE",
}


NOT_LISTED = {"GL_FOG_DISTANCE_MODE_NV"}


def sets(
    name: str, args: Sequence[object], known: Mapping[str, object] | None = None
) -> tuple[str, ...]:
    """Return the names of the variables that a call sets, whether or not their values change.

    ``known`` is the state before the call, as state.read() returns it, or a part of it:
    GL_MATRIX_MODE, GL_ACTIVE_TEXTURE and GL_CLIENT_ACTIVE_TEXTURE say which matrix and which unit
    are meant, and GL_COLOR_MATERIAL and its two companions, whether glColor sets the material.
    Without them the names for all modes and units are returned. glPopAttrib and
    glPopClientAttrib set what was saved, glCallList what its calls set: not said here. Nor is what
    an extension adds (NOT_LISTED), as the state is that of OpenGL 1.5.
    """
    found, state = function(name), known or {}
    if found is None or found.base not in SETS:
        return ()
    values = {
        each.name: written(name, index, args)
        for index, each in enumerate(found.form(len(args)))
        if each.kind == "enum" and index < len(args)
    }
    result: dict[str, None] = {}
    for template in SETS[found.base].split():
        result |= dict.fromkeys(_filled(template, values, state))
    follows = found.base == "glEnable" and values.get("cap") == "GL_COLOR_MATERIAL"
    if follows or found.base in ("glColor", "glColorMaterial"):
        result |= dict.fromkeys(_tracked(values, state))
    return tuple(name for name in result if name not in NOT_LISTED)


def _filled(template: str, values: Mapping[str, str], state: Mapping[str, object]) -> list[str]:
    """Return the names that a template stands for."""
    found = re.search(r"\{(\w+)\}", template)
    if found is None:
        return [re.sub(r"(TEXTURE)_(1D|2D|3D|CUBE_MAP)_BINDING$", r"\1_BINDING_\2", template)]
    choices = _choices(found[1], values, state)
    filled = (template.replace(found[0], each) for each in choices)
    return list(itertools.chain.from_iterable(_filled(each, values, state) for each in filled))


def _choices(word: str, values: Mapping[str, str], state: Mapping[str, object]) -> Sequence[str]:
    """Return what a word in braces stands for."""
    if word in ("unit", "client"):
        variable = "GL_ACTIVE_TEXTURE" if word == "unit" else "GL_CLIENT_ACTIVE_TEXTURE"
        return _current(variable, names("unit"), "unit", state)
    if word == "matrix":
        modes = _current("GL_MATRIX_MODE", MODES, "matrix_mode", state)
        return [MODES.get(mode, mode) for mode in modes]
    if word == "side":
        return SIDES.get(values.get("face", ""), ("", "_BACK"))
    value = values.get(word, "")
    if value in names("texture_cap") and word == "cap":
        return ["{unit}." + value]
    if value == "GL_TEXTURE_COORD_ARRAY":
        return ["{client}." + value]
    return BOTH.get(value, (value,))


def _current(
    variable: str,
    every: Sequence[str] | Mapping[str, object],
    group: str,
    state: Mapping[str, object],
) -> Sequence[str]:
    """Return the value of a selecting variable by name, or all values where it is not known."""
    if variable not in state:
        return list(every)
    value = state[variable]
    text = value if isinstance(value, str) else name_in(group, value)
    return [text] if text else list(every)


def _tracked(values: Mapping[str, str], state: Mapping[str, object]) -> list[str]:
    """Return the parts of the material that follow the current colour."""
    if not state.get("GL_COLOR_MATERIAL") and values.get("cap") != "GL_COLOR_MATERIAL":
        return []
    face = values.get("face") or str(state.get("GL_COLOR_MATERIAL_FACE", ""))
    part = values.get("mode") or str(state.get("GL_COLOR_MATERIAL_PARAMETER", ""))
    return [f"{a}.{b}" for a in BOTH.get(face, (face,)) for b in BOTH.get(part, (part,)) if a and b]
