"""The specification as a table, against PyOpenGL and against the OpenGL that runs."""

import importlib
from collections.abc import Iterator

import numpy as np
import pytest
from stage import Stage

from framelens.base.errors import InputError
from framelens.gl.seam import gl
from framelens.spec import spec, spec_enumerants, spec_table
from framelens.spec.spec_functions import LEFT_OUT
from framelens.state import state

INVALID_ENUM, INVALID_VALUE = 0x500, 0x501
WRONG = 0xBAD  # no enumerant of OpenGL has this value
VERSIONS = ("1_0", "1_1", "1_2", "1_3", "1_4", "1_5")


@pytest.fixture(autouse=True)
def platform(the_stage: Stage) -> None:
    """A platform is chosen before any enumerant is looked up, which imports OpenGL."""


def value(text):
    """Return an argument written as text: an enumerant's value, or anything else as it is."""
    return spec.value_of(text) if isinstance(text, str) else text


def test_every_function_of_opengl_1_0_to_1_5_is_in_the_table_or_left_out_for_a_reason() -> None:
    for version in VERSIONS:
        module = importlib.import_module(f"OpenGL.GL.VERSION.GL_{version}")
        for name in dir(module):
            if not (name.startswith("gl") and name[2].isupper()):
                continue
            left_out = any(part in name for part in LEFT_OUT)
            assert (spec.function(name) is None) == left_out, name


def test_every_function_of_the_table_is_in_pyopengl() -> None:
    modules = [importlib.import_module(f"OpenGL.{name}") for name in ("GL", "GLU", "GLUT")]
    for name in spec.functions():
        assert any(hasattr(module, name) for module in modules), name


def test_a_function_has_as_many_parameters_as_pyopengl_accepts() -> None:
    glu = importlib.import_module("OpenGL.GLU")
    for name, function in spec.functions().items():
        known = getattr(glu if name.startswith("glu") else gl, name, None)
        names = getattr(known, "pyConverterNames", None) or getattr(known, "argNames", None)
        if names is not None and not name.startswith("glut"):
            assert [each.name for each in function.parameters] == list(names), name


def test_every_enumerant_of_the_table_is_in_pyopengl_and_has_its_value() -> None:
    glu = importlib.import_module("OpenGL.GLU")
    extensions = (
        *("EXT.texture_compression_s3tc", "EXT.texture_filter_anisotropic"),
        "NV.fog_distance",
    )
    beside = [glu, *(importlib.import_module(f"OpenGL.GL.{name}") for name in extensions)]
    for group in (*spec_enumerants.GROUPS, *spec_enumerants.BY_PNAME):
        for name in spec_table.names(group):
            if name in spec_enumerants.BESIDE:
                found = next(getattr(each, name) for each in beside if hasattr(each, name))
                assert int(found) == spec_enumerants.BESIDE[name], name
            elif not name[0].isdigit():
                assert hasattr(gl, name), name


def test_every_group_that_a_parameter_names_exists() -> None:
    groups = {*spec_enumerants.GROUPS, *spec_enumerants.BY_PNAME, *spec_enumerants.BY_OTHER}
    for name, function in spec.functions().items():
        for form in function.forms:
            for each in form:
                if each.kind in ("enum", "mask", "by"):
                    assert each.of in groups, (name, each)
    for pnames in spec_enumerants.BY_PNAME.values():
        for text in pnames.values():
            each = spec_table.read_parameter(f"param:{text}")
            assert each.kind != "enum" or each.of in groups, each


@pytest.mark.parametrize(
    ("name", "index", "args", "kind"),
    [
        ("glBegin", 0, (1,), "enum"),
        ("glClear", 0, (1,), "mask"),
        ("glDepthMask", 0, (1,), "boolean"),
        ("glVertex3f", 2, (1.0, 2.0, 3.0), "float"),
        ("glVertex3i", 2, (1, 2, 3), "int"),
        ("glVertex3fv", 0, ((1.0, 2.0, 3.0),), "vector"),
        ("glVertex", 0, ((1.0, 2.0, 3.0),), "vector"),
        ("glVertex", 0, (1.0, 2.0, 3.0), "float"),
        ("glColor3ub", 1, (1, 2, 3), "int"),
        ("glAlphaFunc", 1, (516, 0.5), "clampf"),
        ("glRotatef", 0, (30.0, 0.0, 1.0, 0.0), "angle"),
        ("glLoadMatrixf", 0, (np.eye(4),), "matrix"),
        ("glBindTexture", 1, (3553, 7), "object"),
        ("glDrawArrays", 2, (4, 0, 3), "count"),
        ("glLightfv", 2, ("GL_LIGHT0", "GL_POSITION", (0, 0, 1, 0)), "vector"),
        ("glLightf", 2, ("GL_LIGHT0", "GL_SPOT_CUTOFF", 30.0), "angle"),
        ("glLightModeli", 1, ("GL_LIGHT_MODEL_LOCAL_VIEWER", 1), "boolean"),
        ("glFogi", 1, ("GL_FOG_MODE", 9729), "enum"),
        ("glFogi", 1, ("GL_FOG_DENSITY", 1), "int"),
        ("glFogf", 1, ("GL_FOG_DENSITY", 0.1), "float"),
        ("glTexParameteri", 2, ("GL_TEXTURE_2D", "GL_TEXTURE_MIN_FILTER", 9729), "enum"),
        ("glTexParameterf", 2, ("GL_TEXTURE_2D", "GL_TEXTURE_MIN_LOD", 0.0), "float"),
        ("glTexEnvfv", 2, ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_COLOR", (0, 0, 0, 0)), "vector"),
        ("glVertexPointer", 3, (3, 5126, 0, np.zeros(3)), "array"),
        ("glVertexPointer", 3, (3, 5126, 0, None), "offset"),
        ("glBufferData", 1, ("GL_ARRAY_BUFFER", np.zeros(3), "GL_STATIC_DRAW"), "array"),
        ("glBufferData", 1, ("GL_ARRAY_BUFFER", 12, None, "GL_STATIC_DRAW"), "count"),
        ("glStencilMask", 0, (255,), "bits"),
        ("glActiveTextureARB", 0, ("GL_TEXTURE1",), "enum"),
        ("glUseProgram", 0, (1,), ""),
        ("glBegin", 5, (1,), ""),
    ],
)
def test_the_kind_of_an_argument_follows_from_the_others(name, index, args, kind) -> None:
    assert spec.kind_of(name, index, tuple(map(value, args))) == kind


@pytest.mark.parametrize(
    ("name", "index", "args", "names"),
    [
        ("glShadeModel", 0, (0,), "FLAT SMOOTH"),
        ("glFogi", 1, ("GL_FOG_MODE", 0), "EXP EXP2 LINEAR"),
        ("glFogi", 1, ("GL_FOG_DENSITY", 0), ""),
        ("glLightfv", 0, (0, 0, 0), " ".join(f"LIGHT{k}" for k in range(8))),
        (
            "glLightModeli",
            0,
            (0, 0),
            "LIGHT_MODEL_LOCAL_VIEWER LIGHT_MODEL_TWO_SIDE LIGHT_MODEL_COLOR_CONTROL",
        ),
        ("glTexParameteri", 2, (3553, "GL_TEXTURE_MAG_FILTER", 0), "NEAREST LINEAR"),
        ("glTexEnvi", 1, ("GL_TEXTURE_FILTER_CONTROL", 0, 0), "TEXTURE_LOD_BIAS"),
        ("glTexGeni", 2, ("GL_Q", "GL_TEXTURE_GEN_MODE", 0), "OBJECT_LINEAR EYE_LINEAR"),
        ("glDepthMask", 0, (1,), "FALSE TRUE"),
        (
            "glClear",
            0,
            (0,),
            "COLOR_BUFFER_BIT DEPTH_BUFFER_BIT STENCIL_BUFFER_BIT ACCUM_BUFFER_BIT",
        ),
        ("glVertex3f", 0, (0.0, 0.0, 0.0), ""),
        ("glUseProgram", 0, (0,), ""),
    ],
)
def test_the_legal_enumerants_follow_from_the_others(name, index, args, names) -> None:
    expected = tuple(f"GL_{each}" for each in names.split())
    assert spec.legal(name, index, tuple(map(value, args))) == expected


def test_packed_pixel_types_are_legal_for_their_formats_only() -> None:
    image = [gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 4, 4, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, None]
    assert "GL_UNSIGNED_SHORT_5_6_5" in spec.legal("glTexImage2D", 7, image)
    image[6] = gl.GL_RGBA
    assert "GL_UNSIGNED_SHORT_5_6_5" not in spec.legal("glTexImage2D", 7, image)
    assert "GL_UNSIGNED_SHORT_4_4_4_4" in spec.legal("glTexImage2D", 7, image)


@pytest.mark.parametrize(
    ("name", "index", "args", "text"),
    [
        ("glBegin", 0, (1,), "GL_LINES"),
        ("glBlendFunc", 0, (1, 771), "GL_ONE"),
        ("glBlendFunc", 1, (1, 771), "GL_ONE_MINUS_SRC_ALPHA"),
        ("glStencilOp", 0, (0, 0, 0), "GL_ZERO"),
        ("glDepthMask", 0, (1,), "GL_TRUE"),
        ("glDepthMask", 0, (False,), "GL_FALSE"),
        ("glClear", 0, (0x4100,), "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT"),
        ("glPushAttrib", 0, (0xFFFFF,), "GL_ALL_ATTRIB_BITS"),
        ("glClear", 0, (0,), "0"),
        ("glActiveTexture", 0, (0x84C2,), "GL_TEXTURE2"),
        ("glEnable", 0, (0x3000,), "GL_CLIP_PLANE0"),
        ("glTexEnvf", 2, ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", 8448.0), "GL_MODULATE"),
        ("glTexEnvi", 1, ("GL_TEXTURE_ENV", 0x8580, "GL_TEXTURE"), "GL_SRC0_RGB"),
        ("glTexEnvf", 2, ("GL_TEXTURE_ENV", "GL_RGB_SCALE", 2), "2.0"),
        ("glTexImage2D", 2, ("GL_TEXTURE_2D", 0, 3, 4, 4, 0, 6407, 5121, None), "3"),
        ("glFogf", 1, ("GL_FOG_DENSITY", 0.1 + 0.2), "0.3"),
        ("glTranslated", 0, (0.1 + 0.2, 0.0, 0.0), "0.30000000000000004"),
        ("glTranslatef", 0, (np.float32(0.1), 0.0, 0.0), "0.1"),
        ("glTranslatef", 0, (1, 0, 0), "1"),
        ("glFogfv", 1, ("GL_FOG_COLOR", np.array([0.5, 1, 0, 1], "f")), "(0.5, 1.0, 0.0, 1.0)"),
        ("glStencilMask", 0, (255,), "0xFF"),
        ("glStencilMask", 0, (-1,), "0xFFFFFFFF"),
        ("glBegin", 0, (4711,), "4711"),
        ("gluQuadricDrawStyle", 1, (None, 100011), "GLU_LINE"),
        ("glVertexPointer", 3, (3, 5126, 0, np.zeros((9, 3), "f")), "float32[9, 3]"),
    ],
)
def test_an_argument_is_written_as_in_code(name, index, args, text) -> None:
    assert spec.written(name, index, tuple(map(value, args))) == text


@pytest.mark.parametrize(
    ("name", "index", "args", "text", "result"),
    [
        ("glBegin", 0, (1,), "GL_TRIANGLES", 4),
        ("glBegin", 0, (1,), "TRIANGLES", 4),
        ("glBlendFunc", 0, (1, 0), "1", 1),
        ("glDepthMask", 0, (1,), "False", 0),
        ("glPushAttrib", 0, (0,), "GL_FOG_BIT | GL_ENABLE_BIT", 0x2080),
        ("glTexEnvf", 2, ("GL_TEXTURE_ENV", "GL_RGB_SCALE", 1.0), "4", 4),
        ("glFogf", 1, ("GL_FOG_DENSITY", 0.1), "0.25", 0.25),
        ("glLightf", 2, ("GL_LIGHT0", "GL_SPOT_CUTOFF", 45.0), "180", 180),
        ("glLighti", 2, ("GL_LIGHT0", "GL_SPOT_CUTOFF", 45), "30", 30),
        ("glStencilMask", 0, (1,), "0xFE", 254),
        ("glBindTexture", 1, (3553, 1), "7", 7),
    ],
)
def test_a_text_becomes_the_argument_it_means(name, index, args, text, result) -> None:
    got = spec.parsed(name, index, tuple(map(value, args)), text)
    assert got == result
    assert not (name == "glLighti" and isinstance(got, float))


def test_a_vector_keeps_its_type_and_shape() -> None:
    given = (gl.GL_FOG_COLOR, np.zeros(4, np.float32))
    got = spec.parsed("glFogfv", 1, given, "(0.5, 1, 0, 1)")
    assert got.dtype == np.float32
    assert got.tolist() == [0.5, 1.0, 0.0, 1.0]
    rows = spec.parsed("glMultMatrixd", 0, (np.eye(4),), str(tuple(range(16))))
    assert rows.shape == (4, 4)


@pytest.mark.parametrize(
    ("name", "index", "args", "text", "message"),
    [
        (
            "glDepthFunc",
            0,
            (515,),
            "GL_ADD",
            "glDepthFunc func GL_ADD: expected GL_NEVER, ",
        ),
        ("glFogf", 1, ("GL_FOG_DENSITY", 0.1), "-1", "expected a number of at least 0"),
        ("glLightf", 2, ("GL_LIGHT0", "GL_SPOT_CUTOFF", 4.0), "100", "from 0 to 90 or 180"),
        ("glLineWidth", 0, (1.0,), "0", "expected a number greater than 0"),
        ("glColor3ub", 0, (0, 0, 0), "256", "expected a whole number from 0 to 255"),
        ("glViewport", 0, (0, 0, 9, 9), "5000000000", "expected a number of 32 bits"),
        ("glViewport", 0, (0, 0, 9, 9), "9" * 5000, "expected a whole number"),
        ("glAlphaFunc", 1, (516, 0.5), "nan", "expected a number from 0 to 1"),
        ("glAlphaFunc", 1, (516, 0.5), "half", "expected a number from 0 to 1"),
        ("glClear", 0, (0,), "GL_FOG", "expected GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT |"),
        ("glClear", 0, (0,), "1", "expected GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT |"),
        ("glFogfv", 1, ("GL_FOG_COLOR", (0, 0, 0, 0)), "(1, 1, 1)", "expected 4 numbers"),
        ("glFogfv", 1, ("GL_FOG_COLOR", (0, 0, 0, 0)), "(1, 1, 1, 2)", "a number from 0 to 1"),
        ("glFogfv", 1, ("GL_FOG_COLOR", (0, 0, 0, 0)), "(1, [", "expected 4 numbers"),
        ("glVertexPointer", 3, (3, 5126, 0, np.zeros(3)), "(1,)", "cannot be changed"),
        ("glUseProgram", 0, (1,), "2", "not in the table of OpenGL 1.5"),
    ],
)
def test_an_illegal_text_is_refused_with_what_is_expected(name, index, args, text, message) -> None:
    with pytest.raises(InputError) as refused:
        spec.parsed(name, index, tuple(map(value, args)), text)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("name", "index", "args", "limits"),
    [
        ("glFogf", 1, ("GL_FOG_DENSITY", 0.1), (0, np.inf)),
        ("glFogf", 1, ("GL_FOG_START", 0.1), None),
        ("glLightf", 2, ("GL_LIGHT0", "GL_SPOT_EXPONENT", 1.0), (0, 128)),
        ("glLightf", 2, ("GL_LIGHT0", "GL_SPOT_CUTOFF", 1.0), (0, 90)),
        ("glMaterialf", 2, ("GL_FRONT", "GL_SHININESS", 1.0), (0, 128)),
        ("glMaterialfv", 2, ("GL_FRONT", "GL_DIFFUSE", (0, 0, 0, 0)), None),
        ("glLineWidth", 0, (1.0,), (spec_table.SMALLEST, np.inf)),
        ("glAlphaFunc", 1, (516, 0.5), (0, 1)),
        ("glColor3f", 1, (0.0, 0.0, 0.0), None),
        ("glColor3ub", 1, (0, 0, 0), (0, 255)),
        ("glViewport", 2, (0, 0, 9, 9), (0, np.inf)),
    ],
)
def test_limits_are_those_of_the_specification(name, index, args, limits) -> None:
    assert spec.limits(name, index, tuple(map(value, args))) == limits


@pytest.mark.seldom(3, first=1)
def test_what_is_written_is_read_as_the_same_value() -> None:
    for function in spec.functions().values():
        for form in function.forms:
            args = [1] * len(form)
            for index, parameter in enumerate(form):
                for name in spec.legal(function.name, index, args):
                    given = [*args[:index], spec.value_of(name), *args[index + 1 :]]
                    text = spec.written(function.name, index, given)
                    found = spec.parsed(function.name, index, given, text)
                    assert found == given[index], (function.name, parameter, name)


TEXTURE = ("GL_TEXTURE_2D",)
IMAGE = ("GL_TEXTURE_2D", 0, "GL_RGBA", 4, 4, 0, "GL_RGBA", "GL_UNSIGNED_BYTE", bytes(512))
DEPTH = ("GL_TEXTURE_2D", 0, "GL_DEPTH_COMPONENT", 4, 4, 0, "GL_DEPTH_COMPONENT", "GL_FLOAT", None)
ENV = "GL_TEXTURE_ENV"

# Name, index, arguments: each legal value is tried in the place of the argument at the index.
CALLS = [
    ("glEnable", 0, (0,)),
    ("glDisable", 0, (0,)),
    ("glIsEnabled", 0, (0,)),
    ("glEnableClientState", 0, (0,)),
    ("glAlphaFunc", 0, (0, 0.0)),
    ("glDepthFunc", 0, (0,)),
    ("glStencilFunc", 0, (0, 0, 1)),
    *(("glStencilOp", k, ("GL_KEEP",) * 3) for k in range(3)),
    ("glBlendFunc", 0, (0, "GL_ONE")),
    ("glBlendFunc", 1, ("GL_ONE", 0)),
    *(("glBlendFuncSeparate", k, ("GL_ONE",) * 4) for k in range(4)),
    ("glBlendEquation", 0, (0,)),
    ("glLogicOp", 0, (0,)),
    ("glShadeModel", 0, (0,)),
    ("glFrontFace", 0, (0,)),
    ("glCullFace", 0, (0,)),
    ("glPolygonMode", 0, (0, "GL_FILL")),
    ("glPolygonMode", 1, ("GL_FRONT", 0)),
    ("glMatrixMode", 0, (0,)),
    ("glHint", 0, (0, "GL_NICEST")),
    ("glHint", 1, ("GL_FOG_HINT", 0)),
    ("glClipPlane", 0, (0, np.zeros(4))),
    ("glColorMaterial", 0, (0, "GL_DIFFUSE")),
    ("glColorMaterial", 1, ("GL_FRONT", 0)),
    ("glLightf", 0, (0, "GL_SPOT_EXPONENT", 1.0)),
    ("glLightf", 1, ("GL_LIGHT0", 0, 1.0)),
    ("glLightfv", 1, ("GL_LIGHT0", 0, np.ones(4, "f"))),
    ("glLightModeli", 0, (0, 0)),
    ("glLightModeli", 1, ("GL_LIGHT_MODEL_COLOR_CONTROL", 0)),
    ("glMaterialfv", 0, (0, "GL_DIFFUSE", np.ones(4, "f"))),
    ("glMaterialfv", 1, ("GL_FRONT", 0, np.ones(4, "f"))),
    ("glMaterialf", 1, ("GL_FRONT", 0, 1.0)),
    ("glFogi", 1, ("GL_FOG_MODE", 0)),
    ("glFogi", 1, ("GL_FOG_COORD_SRC", 0)),
    ("glPointParameterf", 0, (0, 1.0)),
    ("glBindTexture", 0, (0, 0)),
    *(
        ("glTexParameteri", 2, ("GL_TEXTURE_2D", pname, 0))
        for pname in (
            "GL_TEXTURE_MIN_FILTER",
            "GL_TEXTURE_MAG_FILTER",
            "GL_TEXTURE_WRAP_S",
            "GL_TEXTURE_WRAP_R",
            "GL_DEPTH_TEXTURE_MODE",
            "GL_TEXTURE_COMPARE_MODE",
            "GL_TEXTURE_COMPARE_FUNC",
        )
    ),
    ("glGetTexParameterfv", 1, ("GL_TEXTURE_2D", 0, np.ones(4, "f"))),
    ("glGetTexLevelParameteriv", 2, ("GL_TEXTURE_2D", 0, 0, np.ones(4, "i"))),
    ("glTexEnvfv", 1, (ENV, 0, np.ones(4, "f"))),
    *(
        ("glTexEnvi", 2, (ENV, f"GL_{pname}", 0))
        for pname in (
            "TEXTURE_ENV_MODE",
            "COMBINE_RGB",
            "COMBINE_ALPHA",
            "SRC0_RGB",
            "SRC2_ALPHA",
            "OPERAND1_RGB",
            "OPERAND0_ALPHA",
            "RGB_SCALE",
            "ALPHA_SCALE",
        )
    ),
    *(("glTexGeni", 2, (f"GL_{coord}", "GL_TEXTURE_GEN_MODE", 0)) for coord in "STRQ"),
    ("glTexGenfv", 0, (0, "GL_OBJECT_PLANE", np.ones(4, "f"))),
    ("glActiveTexture", 0, (0,)),
    ("glClientActiveTexture", 0, (0,)),
    ("glTexImage2D", 2, IMAGE),
    ("glTexImage2D", 6, IMAGE),
    ("glTexImage2D", 7, IMAGE),
    ("glTexImage2D", 7, DEPTH),
    ("glPixelStorei", 0, (0, 1)),
    ("glPixelStorei", 1, ("GL_UNPACK_ALIGNMENT", 0)),
    ("glPixelTransferf", 0, (0, 1.0)),
    ("glCopyPixels", 4, (0, 0, 1, 1, 0)),
    ("glVertexPointer", 0, (0, "GL_FLOAT", 0, None)),
    ("glVertexPointer", 1, (3, 0, 0, None)),
    ("glColorPointer", 1, (4, 0, 0, None)),
    ("glNormalPointer", 0, (0, 0, None)),
    ("glInterleavedArrays", 0, (0, 0, bytes(64))),
    ("glBindBuffer", 0, (0, 0)),
    ("glGetFloatv", 0, (0, np.zeros(64, "f"))),
    ("glGetString", 0, (0,)),
    ("glMultiTexCoord2f", 0, (0, 0.0, 0.0)),
]

# Where OpenGL takes numbers, it calls a wrong one an invalid value, not an invalid enumerant.
NUMBERS = {("glTexImage2D", 2), ("glVertexPointer", 0), ("glPixelStorei", 1)}
SCALES = ("GL_RGB_SCALE", "GL_ALPHA_SCALE")
# OpenGL leaves undefined what a wrong unit does; PyOpenGL itself refuses a wrong pixel type.
UNCHECKED = {("glMultiTexCoord2f", 0), ("glTexImage2D", 7)}


def error_of(name: str, args) -> int:
    """Make a call and return the error it causes, or 0."""
    from OpenGL.error import GLError

    try:
        getattr(gl, name)(*args)
    except GLError as error:
        return int(error.err)
    except KeyError:  # how PyOpenGL without its accelerator refuses the type of an array
        return INVALID_ENUM
    return 0


def fitted(name: str, given: list, index: int) -> list:
    """Return the arguments, of which those after ``index`` are made legal again."""
    given = list(given)
    for k in range(index + 1, len(given)):
        names = spec.legal(name, k, given)
        if names and spec.written(name, k, given).strip("(,)") not in names:
            first = spec.value_of(names[0])
            given[k] = np.array([first], "f") if isinstance(given[k], np.ndarray) else first
    return given


@pytest.fixture
def undone(stage: Stage) -> Iterator[None]:
    """A texture of its own, and state that is restored after the test."""
    before = state.read()
    texture = int(gl.glGenTextures(1))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexImage2D(*map(value, IMAGE))
    yield
    state.restore(before)
    gl.glDeleteTextures(1, np.array([texture], np.uint32))


@pytest.mark.parametrize(("name", "index", "args"), CALLS)
def test_opengl_takes_each_legal_value_and_refuses_another(undone, name, index, args) -> None:
    given = list(map(value, args))
    names = spec.legal(name, index, given)
    assert names
    for each in names:
        given[index] = spec.parsed(name, index, given, each)
        assert error_of(name, fitted(name, given, index)) not in (INVALID_ENUM, INVALID_VALUE), each
    given[index] = WRONG
    number = (name, index) in NUMBERS or (name == "glTexEnvi" and args[1] in SCALES)
    if (name, index) not in UNCHECKED:
        assert error_of(name, given) == (INVALID_VALUE if number else INVALID_ENUM)


@pytest.mark.parametrize(
    ("name", "args", "names"),
    [
        ("glEnable", ("GL_FOG",), "GL_FOG"),
        ("glEnable", ("GL_TEXTURE_2D",), "GL_TEXTURE1.GL_TEXTURE_2D"),
        ("glDisableClientState", ("GL_TEXTURE_COORD_ARRAY",), "GL_TEXTURE2.GL_TEXTURE_COORD_ARRAY"),
        ("glFogf", ("GL_FOG_DENSITY", 0.1), "GL_FOG_DENSITY"),
        ("glLightfv", ("GL_LIGHT1", "GL_POSITION", (0, 0, 1, 0)), "GL_LIGHT1.GL_POSITION"),
        (
            "glMaterialfv",
            ("GL_FRONT_AND_BACK", "GL_AMBIENT_AND_DIFFUSE", (0, 0, 0, 0)),
            "GL_FRONT.GL_AMBIENT GL_FRONT.GL_DIFFUSE GL_BACK.GL_AMBIENT GL_BACK.GL_DIFFUSE",
        ),
        (
            "glTexEnvi",
            ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", "GL_MODULATE"),
            "GL_TEXTURE1.GL_TEXTURE_ENV.GL_TEXTURE_ENV_MODE",
        ),
        (
            "glTexGeni",
            ("GL_S", "GL_TEXTURE_GEN_MODE", "GL_EYE_LINEAR"),
            "GL_TEXTURE1.GL_S.GL_TEXTURE_GEN_MODE",
        ),
        (
            "glTexParameteri",
            ("GL_TEXTURE_2D", "GL_TEXTURE_MIN_FILTER", "GL_LINEAR"),
            "GL_TEXTURE_2D.GL_TEXTURE_MIN_FILTER",
        ),
        ("glBindTexture", ("GL_TEXTURE_2D", 3), "GL_TEXTURE1.GL_TEXTURE_BINDING_2D"),
        ("glBindBuffer", ("GL_ARRAY_BUFFER", 3), "GL_ARRAY_BUFFER_BINDING"),
        ("glTranslatef", (1.0, 0.0, 0.0), "GL_PROJECTION_MATRIX"),
        ("gluLookAt", (0.0,) * 9, "GL_PROJECTION_MATRIX"),
        ("glClipPlane", ("GL_CLIP_PLANE0", (0, 0, 0, 0)), "GL_CLIP_PLANE0.equation"),
        ("glMultiTexCoord2f", ("GL_TEXTURE3", 0.0, 0.0), "GL_TEXTURE3.GL_CURRENT_TEXTURE_COORDS"),
        ("glColor3f", (0.0, 0.0, 0.0), "GL_CURRENT_COLOR GL_BACK.GL_DIFFUSE"),
        (
            "glStencilOpSeparate",
            ("GL_BACK", "GL_KEEP", "GL_KEEP", "GL_KEEP"),
            "GL_STENCIL_BACK_FAIL GL_STENCIL_BACK_PASS_DEPTH_FAIL GL_STENCIL_BACK_PASS_DEPTH_PASS",
        ),
        ("glDrawArrays", ("GL_TRIANGLES", 0, 3), ""),
        ("glUseProgram", (0,), ""),
    ],
)
def test_a_call_sets_these_variables(name, args, names) -> None:
    known = {
        "GL_ACTIVE_TEXTURE": "GL_TEXTURE1",
        "GL_CLIENT_ACTIVE_TEXTURE": int(gl.GL_TEXTURE2),
        "GL_MATRIX_MODE": "GL_PROJECTION",
        "GL_COLOR_MATERIAL": True,
        "GL_COLOR_MATERIAL_FACE": "GL_BACK",
        "GL_COLOR_MATERIAL_PARAMETER": "GL_DIFFUSE",
    }
    given = [value(each) if isinstance(each, str) else each for each in args]
    assert spec.sets(name, given, known) == tuple(names.split())


def test_a_matrix_mode_of_an_extension_is_named_as_well() -> None:
    assert spec.sets("glLoadIdentity", (), {"GL_MATRIX_MODE": "GL_COLOR"}) == ("GL_COLOR_MATRIX",)


def test_without_the_state_all_matrices_and_units_may_be_set() -> None:
    names = spec.sets("glLoadIdentity", ())
    assert names[:2] == ("GL_MODELVIEW_MATRIX", "GL_PROJECTION_MATRIX")
    assert "GL_TEXTURE7.GL_TEXTURE_MATRIX" in names
    assert len(spec.sets("glEnable", (gl.GL_TEXTURE_GEN_S,))) == 8


def test_calls_are_told_apart_by_what_they_do() -> None:
    def those(question, names):
        return [name for name in names.split() if question(name)]

    names = (
        "glBegin glEnd glClear glDrawElementsui glRectf gluSphere glutSolidTeapot glCallList "
        "glGetFloatv glIsEnabled glReadPixels glGetError gluProject glGenTextures glGenLists "
        "glGenerateMipmap gluNewQuadric glDeleteTextures gluDeleteQuadric glFogf glUseProgram"
    )
    drawn = "glBegin glClear glDrawElementsui glRectf gluSphere glutSolidTeapot"
    assert those(spec.draws, names) == drawn.split()
    queries = "glGetFloatv glIsEnabled glReadPixels glGetError gluProject"
    assert those(spec.is_query, names) == queries.split()
    assert those(spec.creates, names) == ["glGenTextures", "glGenLists", "gluNewQuadric"]
    assert those(spec.deletes, names) == ["glDeleteTextures", "gluDeleteQuadric"]


LISTED = [
    # Name, arguments, and the variable that tells whether the call has been executed.
    ("glActiveTexture", ("GL_TEXTURE1",), "GL_ACTIVE_TEXTURE"),
    ("glClientActiveTexture", ("GL_TEXTURE1",), "GL_CLIENT_ACTIVE_TEXTURE"),
    ("glBindTexture", ("GL_TEXTURE_2D", 0), "GL_TEXTURE_BINDING_2D"),
    ("glBindRenderbuffer", ("GL_RENDERBUFFER", "renderbuffer"), "GL_RENDERBUFFER_BINDING"),
    ("glBindBuffer", ("GL_ARRAY_BUFFER", "buffer"), "GL_ARRAY_BUFFER_BINDING"),
    ("glPixelStorei", ("GL_UNPACK_ROW_LENGTH", 3), "GL_UNPACK_ROW_LENGTH"),
    ("glPixelTransferf", ("GL_RED_SCALE", 0.5), "GL_RED_SCALE"),
    ("glListBase", (3,), "GL_LIST_BASE"),
    ("glReadBuffer", ("GL_NONE",), "GL_READ_BUFFER"),
    ("glWindowPos2f", (5.0, 5.0), "GL_CURRENT_RASTER_POSITION"),
    ("glSampleCoverage", (0.5, 1), "GL_SAMPLE_COVERAGE_VALUE"),
    ("glMapGrid1f", (5, 0.0, 1.0), "GL_MAP1_GRID_SEGMENTS"),
    ("glVertexPointer", (2, "GL_FLOAT", 0, None), "GL_VERTEX_ARRAY_SIZE"),
    ("glEnableClientState", ("GL_NORMAL_ARRAY",), "GL_NORMAL_ARRAY"),
    ("glInterleavedArrays", ("GL_V3F", 0, bytes(48)), "GL_VERTEX_ARRAY"),
    ("glHint", ("GL_FOG_HINT", "GL_NICEST"), "GL_FOG_HINT"),
    ("glStencilMaskSeparate", ("GL_FRONT", 1), "GL_STENCIL_WRITEMASK"),
]


@pytest.mark.parametrize(("name", "args", "variable"), LISTED)
def test_opengl_agrees_about_what_goes_into_a_display_list(undone, name, args, variable) -> None:
    def now() -> list[float]:
        values = np.zeros(16, np.float32)
        gl.glGetFloatv(value(variable), values)
        return values.tolist()

    objects = {"buffer": gl.glGenBuffers, "renderbuffer": gl.glGenRenderbuffers}
    given = [int(objects[each](1)) if each in objects else value(each) for each in args]
    number, before = gl.glGenLists(1), now()
    gl.glNewList(number, gl.GL_COMPILE)
    getattr(gl, name)(*given)
    at_once = now() != before
    gl.glEndList()
    gl.glCallList(number)
    assert now() != before
    assert spec.in_list(name) is not at_once
    gl.glDeleteLists(number, 1)
    if "renderbuffer" in args:
        gl.glDeleteRenderbuffers(1, np.array(given[1:], np.uint32))
    if "buffer" in args:
        gl.glDeleteBuffers(1, np.array(given[1:], np.uint32))
