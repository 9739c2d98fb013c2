"""What the specification says a call sets, against what changes in the state."""

from collections.abc import Iterator

import numpy as np
import pytest
from stage import Stage

from framelens.gl.seam import gl
from framelens.spec import spec
from framelens.spec.spec_variables import SETS
from framelens.state import state

HALF = np.full(4, 0.5, np.float32)
PIXELS = bytes(64)


def value(text):
    """Return an argument written as text: an enumerant's value, or anything else as it is."""
    return spec.value_of(text) if isinstance(text, str) else text


@pytest.fixture(autouse=True)
def undone(stage: Stage) -> Iterator[None]:
    """State that is restored after the test."""
    before = state.read()
    yield
    state.restore(before)


CALLS = [
    ("glColor3f", (0.5, 0.5, 0.5)),
    ("glSecondaryColor3f", (0.5, 0.5, 0.5)),
    ("glNormal3f", (1.0, 0.0, 0.0)),
    ("glTexCoord2f", (0.5, 0.5)),
    ("glMultiTexCoord2f", ("GL_TEXTURE2", 0.5, 0.5)),
    ("glFogCoordf", (0.5,)),
    ("glEdgeFlag", (0,)),
    ("glRasterPos2f", (0.5, 0.5)),
    ("glWindowPos2f", (5.0, 5.0)),
    ("glBitmap", (0, 0, 0.0, 0.0, 9.0, 0.0, None)),
    ("glMatrixMode", ("GL_TEXTURE",)),
    ("glTranslatef", (1.0, 2.0, 3.0)),
    ("glPushMatrix", ()),
    ("glViewport", (1, 2, 3, 4)),
    ("glDepthRange", (0.25, 0.75)),
    ("glClipPlane", ("GL_CLIP_PLANE1", np.ones(4))),
    ("glEnable", ("GL_FOG",)),
    ("glEnable", ("GL_TEXTURE_3D",)),
    ("glEnable", ("GL_TEXTURE_GEN_Q",)),
    ("glEnable", ("GL_COLOR_MATERIAL",)),
    ("glDisable", ("GL_DITHER",)),
    ("glEnableClientState", ("GL_TEXTURE_COORD_ARRAY",)),
    ("glEnableClientState", ("GL_FOG_COORD_ARRAY",)),
    ("glPointSize", (2.0,)),
    ("glPointParameterf", ("GL_POINT_SIZE_MIN", 2.0)),
    ("glLineWidth", (2.0,)),
    ("glLineStipple", (2, 0x5555)),
    ("glCullFace", ("GL_FRONT",)),
    ("glFrontFace", ("GL_CW",)),
    ("glPolygonMode", ("GL_FRONT", "GL_LINE")),
    ("glPolygonOffset", (1.0, 1.0)),
    ("glPolygonStipple", (np.zeros(128, np.uint8),)),
    ("glSampleCoverage", (0.5, 1)),
    ("glShadeModel", ("GL_FLAT",)),
    ("glLightfv", ("GL_LIGHT3", "GL_POSITION", HALF)),
    ("glLightModeli", ("GL_LIGHT_MODEL_TWO_SIDE", 1)),
    ("glMaterialfv", ("GL_FRONT_AND_BACK", "GL_AMBIENT_AND_DIFFUSE", HALF)),
    ("glColorMaterial", ("GL_FRONT", "GL_SPECULAR")),
    ("glFogf", ("GL_FOG_DENSITY", 0.5)),
    ("glActiveTexture", ("GL_TEXTURE1",)),
    ("glTexEnvi", ("GL_TEXTURE_ENV", "GL_COMBINE_RGB", "GL_ADD")),
    ("glTexEnvi", ("GL_TEXTURE_ENV", "GL_SRC1_ALPHA", "GL_TEXTURE")),
    ("glTexEnvf", ("GL_TEXTURE_FILTER_CONTROL", "GL_TEXTURE_LOD_BIAS", 0.5)),
    ("glTexGenfv", ("GL_R", "GL_OBJECT_PLANE", HALF)),
    ("glScissor", (1, 2, 3, 4)),
    ("glAlphaFunc", ("GL_LESS", 0.5)),
    ("glStencilFunc", ("GL_LESS", 1, 3)),
    ("glStencilOp", ("GL_ZERO", "GL_INCR", "GL_DECR")),
    ("glStencilMask", (3,)),
    ("glStencilFuncSeparate", ("GL_BACK", "GL_LESS", 1, 3)),
    ("glStencilMaskSeparate", ("GL_FRONT", 3)),
    ("glDepthFunc", ("GL_NEVER",)),
    ("glDepthMask", (0,)),
    ("glBlendFunc", ("GL_ZERO", "GL_ONE")),
    ("glBlendFuncSeparate", ("GL_ONE", "GL_ZERO", "GL_ZERO", "GL_ONE")),
    ("glBlendEquation", ("GL_MAX",)),
    ("glBlendColor", (0.5, 0.5, 0.5, 0.5)),
    ("glLogicOp", ("GL_XOR",)),
    ("glColorMask", (0, 1, 1, 1)),
    ("glReadBuffer", ("GL_NONE",)),
    ("glClearColor", (0.25, 0.25, 0.25, 0.25)),
    ("glClearDepth", (0.5,)),
    ("glClearStencil", (1,)),
    ("glClearAccum", (0.5, 0.5, 0.5, 0.5)),
    ("glPixelStorei", ("GL_UNPACK_SKIP_ROWS", 1)),
    ("glPixelTransferf", ("GL_RED_BIAS", 0.5)),
    ("glPixelMapfv", ("GL_PIXEL_MAP_I_TO_G", 2, np.ones(2, np.float32))),
    ("glPixelZoom", (2.0, 2.0)),
    ("glMap1f", ("GL_MAP1_VERTEX_3", 0.0, 2.0, np.ones((2, 3), np.float32))),
    ("glMapGrid2f", (2, 0.0, 2.0, 2, 0.0, 2.0)),
    ("glHint", ("GL_FOG_HINT", "GL_NICEST")),
    ("glClientActiveTexture", ("GL_TEXTURE1",)),
    ("glVertexPointer", (2, "GL_SHORT", 8, None)),
    ("glTexCoordPointer", (2, "GL_SHORT", 8, None)),
    ("glNormalPointer", ("GL_BYTE", 8, None)),
    ("glInterleavedArrays", ("GL_T2F_C4UB_V3F", 0, PIXELS)),
    ("glPushAttrib", ("GL_FOG_BIT",)),
    ("glPushClientAttrib", ("GL_CLIENT_VERTEX_ARRAY_BIT",)),
    ("glListBase", (3,)),
    ("gluPerspective", (60.0, 1.0, 1.0, 10.0)),
    ("gluLookAt", (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)),
]


@pytest.mark.parametrize(("name", "args"), CALLS)
def test_what_a_call_changes_is_what_it_sets(name, args) -> None:
    if name.startswith("glu"):
        from framelens.gl import glu  # it imports OpenGL, which then must know its platform

        function = getattr(glu, name)
    else:
        function = getattr(gl, name)
    given = tuple(map(value, args))
    # A raster position would take the coordinates that an earlier test has left.
    gl.glTexCoord4f(0.0, 0.0, 0.0, 1.0)
    gl.glRasterPos2f(0.0, 0.0)
    before = state.read()
    sets = spec.sets(name, given, before)
    function(*given)
    after = state.read()
    changed = state.difference(before, after)
    assert changed
    assert set(changed) <= set(sets)
    assert set(sets) <= set(after), "a name that the state does not have"


def test_the_names_are_those_of_the_state() -> None:
    """Of every function, with every value of the enumerants that the names are made of."""
    named = ("light", "target", "pname", "coord", "face", "cap", "array", "plane", "map", "mode")
    for function in spec.functions().values():
        if function.base not in SETS or function.base == "glTexParameter":
            continue
        form, calls = function.parameters, [[0] * len(function.parameters)]
        for index, parameter in enumerate(form):
            if parameter.name in named and parameter.kind == "enum":
                calls = [
                    [*args[:index], spec.value_of(name), *args[index + 1 :]]
                    for args in calls
                    for name in spec.legal(function.name, index, args)
                ]
        for args in calls:
            names = spec.sets(function.name, args, {"GL_ACTIVE_TEXTURE": "GL_TEXTURE0"})
            unknown = set(names) - set(state.DEFAULTS)
            assert not unknown, (function.name, unknown)
