"""Tables of the variables of classic OpenGL's state: type, initial value, how each is set.

The tables follow those of the specification of OpenGL 1.5, chapter 6.2, in its order, with the few
variables of later versions that fixed-function programs use: two-sided stencil, point sprites,
pixel buffers, framebuffer objects. Not in them is what belongs to objects (a texture's filters, a
buffer's contents, a display list), and what a program cannot ask for: the name stack's contents.

A row is (name, type, initial value, how it is set, first version). The type is FLAG for what
glEnable switches, a tuple of names for an enumerant, or a type of number; a tuple as initial value
makes it a vector. In "how it is set", ``$`` stands for the value, ``&`` for an array with the
value, ``$NAME`` for the value of another variable. The first version is 1.5 where none is given.
"""

from typing import Any

from framelens.spec.spec_table import names

FLAG = "flag"
BOOL = "boolean"
INT = "integer"
MASK = "mask"
FLOAT = "float"
DOUBLE = "double"
POINTER, LIST = "pointer", "list"

MOST = 8  # chosen: lights, clip planes and texture units; no fixed-function OpenGL has more
EVERY = 0xFFFFFFFF  # a mask of all bits
IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)

Kind = str | tuple[str, ...]
Row = tuple[Any, ...]


COMPARISONS = names("compare")
FACTORS = names("source_factor")
EQUATIONS = names("blend_equation")
OPERATIONS = names("stencil_op")
FACES = names("face")
BUFFERS = names("draw_buffer")
TYPES = names("color_type")
UNITS = names("unit")
OPERANDS = names("operand_rgb")
SOURCES = names("combine_source")

TRANSFORM: tuple[Row, ...] = (
    ("GL_MATRIX_MODE", names("matrix_mode"), "GL_MODELVIEW", ""),
    ("GL_MODELVIEW_STACK_DEPTH", INT, 1, ""),
    ("GL_MODELVIEW_MATRIX", FLOAT, IDENTITY, ""),
    ("GL_PROJECTION_STACK_DEPTH", INT, 1, ""),
    ("GL_PROJECTION_MATRIX", FLOAT, IDENTITY, ""),
    ("GL_VIEWPORT", INT, (0, 0, 0, 0), "glViewport $"),
    ("GL_DEPTH_RANGE", DOUBLE, (0.0, 1.0), "glDepthRange $"),
    ("GL_NORMALIZE", FLAG, False),
    ("GL_RESCALE_NORMAL", FLAG, False),
)

CURRENT: tuple[Row, ...] = (
    ("GL_CURRENT_COLOR", FLOAT, (1.0, 1.0, 1.0, 1.0), "glColor4f $"),
    ("GL_CURRENT_SECONDARY_COLOR", FLOAT, (0.0, 0.0, 0.0, 1.0), ""),
    ("GL_CURRENT_INDEX", FLOAT, 1.0, "glIndexf $"),
    ("GL_CURRENT_NORMAL", FLOAT, (0.0, 0.0, 1.0), "glNormal3f $"),
    ("GL_CURRENT_FOG_COORD", FLOAT, 0.0, "glFogCoordf $"),
    ("GL_EDGE_FLAG", BOOL, True, "glEdgeFlag $"),
    ("GL_CURRENT_RASTER_POSITION", FLOAT, (0.0, 0.0, 0.0, 1.0), ""),
    ("GL_CURRENT_RASTER_POSITION_VALID", BOOL, True, ""),
    ("GL_CURRENT_RASTER_DISTANCE", FLOAT, 0.0, ""),
    ("GL_CURRENT_RASTER_COLOR", FLOAT, (1.0, 1.0, 1.0, 1.0), ""),
)

COLOURING: tuple[Row, ...] = (
    ("GL_SHADE_MODEL", names("shade_model"), "GL_SMOOTH", "glShadeModel $"),
    ("GL_COLOR_SUM", FLAG, False),
    ("GL_FOG", FLAG, False),
    ("GL_FOG_MODE", names("fog_mode"), "GL_EXP", "glFogi GL_FOG_MODE $"),
    ("GL_FOG_DENSITY", FLOAT, 1.0, "glFogf GL_FOG_DENSITY $"),
    ("GL_FOG_START", FLOAT, 0.0, "glFogf GL_FOG_START $"),
    ("GL_FOG_END", FLOAT, 1.0, "glFogf GL_FOG_END $"),
    ("GL_FOG_COLOR", FLOAT, (0.0, 0.0, 0.0, 0.0), "glFogfv GL_FOG_COLOR &"),
    ("GL_FOG_INDEX", FLOAT, 0.0, "glFogf GL_FOG_INDEX $"),
    (
        *("GL_FOG_COORD_SRC", names("fog_source"), "GL_FRAGMENT_DEPTH"),
        "glFogi GL_FOG_COORD_SRC $",
    ),
    ("GL_LIGHTING", FLAG, False),
    (
        *("GL_LIGHT_MODEL_AMBIENT", FLOAT, (0.2, 0.2, 0.2, 1.0)),
        "glLightModelfv GL_LIGHT_MODEL_AMBIENT &",
    ),
    ("GL_LIGHT_MODEL_LOCAL_VIEWER", BOOL, False, "glLightModeli GL_LIGHT_MODEL_LOCAL_VIEWER $"),
    ("GL_LIGHT_MODEL_TWO_SIDE", BOOL, False, "glLightModeli GL_LIGHT_MODEL_TWO_SIDE $"),
    (
        *("GL_LIGHT_MODEL_COLOR_CONTROL", names("color_control")),
        *("GL_SINGLE_COLOR", "glLightModeli GL_LIGHT_MODEL_COLOR_CONTROL $"),
    ),
    ("GL_COLOR_MATERIAL", FLAG, False, ""),
    (
        *("GL_COLOR_MATERIAL_FACE", FACES, "GL_FRONT_AND_BACK"),
        "glColorMaterial $ $GL_COLOR_MATERIAL_PARAMETER",
    ),
    (
        "GL_COLOR_MATERIAL_PARAMETER",
        names("color_material"),
        *("GL_AMBIENT_AND_DIFFUSE", "glColorMaterial $GL_COLOR_MATERIAL_FACE $"),
    ),
)

MATERIAL: tuple[Row, ...] = (
    ("GL_AMBIENT", FLOAT, (0.2, 0.2, 0.2, 1.0)),
    ("GL_DIFFUSE", FLOAT, (0.8, 0.8, 0.8, 1.0)),
    ("GL_SPECULAR", FLOAT, (0.0, 0.0, 0.0, 1.0)),
    ("GL_EMISSION", FLOAT, (0.0, 0.0, 0.0, 1.0)),
    ("GL_SHININESS", FLOAT, 0.0),
    ("GL_COLOR_INDEXES", FLOAT, (0.0, 1.0, 1.0)),
)

LIGHT: tuple[Row, ...] = (
    ("GL_AMBIENT", FLOAT, (0.0, 0.0, 0.0, 1.0)),
    ("GL_DIFFUSE", FLOAT, (0.0, 0.0, 0.0, 1.0)),
    ("GL_SPECULAR", FLOAT, (0.0, 0.0, 0.0, 1.0)),
    ("GL_POSITION", FLOAT, (0.0, 0.0, 1.0, 0.0)),
    ("GL_CONSTANT_ATTENUATION", FLOAT, 1.0),
    ("GL_LINEAR_ATTENUATION", FLOAT, 0.0),
    ("GL_QUADRATIC_ATTENUATION", FLOAT, 0.0),
    ("GL_SPOT_DIRECTION", FLOAT, (0.0, 0.0, -1.0)),
    ("GL_SPOT_EXPONENT", FLOAT, 0.0),
    ("GL_SPOT_CUTOFF", FLOAT, 180.0),
)

RASTERIZATION: tuple[Row, ...] = (
    ("GL_POINT_SIZE", FLOAT, 1.0, "glPointSize $"),
    ("GL_POINT_SMOOTH", FLAG, False),
    ("GL_POINT_SIZE_MIN", FLOAT, 0.0, "glPointParameterf GL_POINT_SIZE_MIN $"),
    ("GL_POINT_SIZE_MAX", FLOAT, 1.0, "glPointParameterf GL_POINT_SIZE_MAX $"),
    (
        *("GL_POINT_FADE_THRESHOLD_SIZE", FLOAT, 1.0),
        "glPointParameterf GL_POINT_FADE_THRESHOLD_SIZE $",
    ),
    (
        *("GL_POINT_DISTANCE_ATTENUATION", FLOAT, (1.0, 0.0, 0.0)),
        "glPointParameterfv GL_POINT_DISTANCE_ATTENUATION &",
    ),
    ("GL_POINT_SPRITE", FLAG, False, "", "2.0"),
    (
        *("GL_POINT_SPRITE_COORD_ORIGIN", ("GL_LOWER_LEFT", "GL_UPPER_LEFT"), "GL_UPPER_LEFT"),
        *("glPointParameteri GL_POINT_SPRITE_COORD_ORIGIN $", "2.0"),
    ),
    ("GL_VERTEX_PROGRAM_POINT_SIZE", FLAG, False, "", "2.0"),
    ("GL_LINE_WIDTH", FLOAT, 1.0, "glLineWidth $"),
    ("GL_LINE_SMOOTH", FLAG, False),
    ("GL_LINE_STIPPLE", FLAG, False),
    ("GL_LINE_STIPPLE_PATTERN", INT, 0xFFFF, "glLineStipple $GL_LINE_STIPPLE_REPEAT $"),
    ("GL_LINE_STIPPLE_REPEAT", INT, 1, "glLineStipple $ $GL_LINE_STIPPLE_PATTERN"),
    ("GL_CULL_FACE", FLAG, False),
    ("GL_CULL_FACE_MODE", FACES, "GL_BACK", "glCullFace $"),
    ("GL_FRONT_FACE", names("front_face"), "GL_CCW", "glFrontFace $"),
    ("GL_POLYGON_MODE", names("polygon_mode"), ("GL_FILL", "GL_FILL"), ""),
    ("GL_POLYGON_SMOOTH", FLAG, False),
    ("GL_POLYGON_OFFSET_FACTOR", FLOAT, 0.0, "glPolygonOffset $ $GL_POLYGON_OFFSET_UNITS"),
    ("GL_POLYGON_OFFSET_UNITS", FLOAT, 0.0, "glPolygonOffset $GL_POLYGON_OFFSET_FACTOR $"),
    ("GL_POLYGON_OFFSET_POINT", FLAG, False),
    ("GL_POLYGON_OFFSET_LINE", FLAG, False),
    ("GL_POLYGON_OFFSET_FILL", FLAG, False),
    ("GL_POLYGON_STIPPLE", FLAG, False),
    ("GL_MULTISAMPLE", FLAG, True),
    ("GL_SAMPLE_ALPHA_TO_COVERAGE", FLAG, False),
    ("GL_SAMPLE_ALPHA_TO_ONE", FLAG, False),
    ("GL_SAMPLE_COVERAGE", FLAG, False),
    ("GL_SAMPLE_COVERAGE_VALUE", FLOAT, 1.0, "glSampleCoverage $ $GL_SAMPLE_COVERAGE_INVERT"),
    ("GL_SAMPLE_COVERAGE_INVERT", BOOL, False, "glSampleCoverage $GL_SAMPLE_COVERAGE_VALUE $"),
)

TEXTURE_TARGETS = ("1D", "2D", "3D", "CUBE_MAP", "RECTANGLE")
ENVIRONMENT: tuple[Row, ...] = (
    (
        "GL_TEXTURE_ENV_MODE",
        names("env_mode"),
        "GL_MODULATE",
    ),
    ("GL_TEXTURE_ENV_COLOR", FLOAT, (0.0, 0.0, 0.0, 0.0)),
    (
        "GL_COMBINE_RGB",
        names("combine_rgb"),
        "GL_MODULATE",
    ),
    (
        "GL_COMBINE_ALPHA",
        names("combine_alpha"),
        "GL_MODULATE",
    ),
    ("GL_SRC0_RGB", SOURCES, "GL_TEXTURE"),
    ("GL_SRC1_RGB", SOURCES, "GL_PREVIOUS"),
    ("GL_SRC2_RGB", SOURCES, "GL_CONSTANT"),
    ("GL_SRC0_ALPHA", SOURCES, "GL_TEXTURE"),
    ("GL_SRC1_ALPHA", SOURCES, "GL_PREVIOUS"),
    ("GL_SRC2_ALPHA", SOURCES, "GL_CONSTANT"),
    ("GL_OPERAND0_RGB", OPERANDS, "GL_SRC_COLOR"),
    ("GL_OPERAND1_RGB", OPERANDS, "GL_SRC_COLOR"),
    ("GL_OPERAND2_RGB", OPERANDS, "GL_SRC_ALPHA"),
    ("GL_OPERAND0_ALPHA", OPERANDS, "GL_SRC_ALPHA"),
    ("GL_OPERAND1_ALPHA", OPERANDS, "GL_SRC_ALPHA"),
    ("GL_OPERAND2_ALPHA", OPERANDS, "GL_SRC_ALPHA"),
    ("GL_RGB_SCALE", FLOAT, 1.0),
    ("GL_ALPHA_SCALE", FLOAT, 1.0),
)
GENERATION = names("gen_mode_st")
PLANES = {"S": (1.0, 0.0, 0.0, 0.0), "T": (0.0, 1.0, 0.0, 0.0)}

PIXEL_OPERATIONS: tuple[Row, ...] = (
    ("GL_SCISSOR_TEST", FLAG, False),
    ("GL_SCISSOR_BOX", INT, (0, 0, 0, 0), "glScissor $"),
    ("GL_ALPHA_TEST", FLAG, False),
    ("GL_ALPHA_TEST_FUNC", COMPARISONS, "GL_ALWAYS", "glAlphaFunc $ $GL_ALPHA_TEST_REF"),
    ("GL_ALPHA_TEST_REF", FLOAT, 0.0, "glAlphaFunc $GL_ALPHA_TEST_FUNC $"),
    ("GL_STENCIL_TEST", FLAG, False),
    ("GL_STENCIL_FUNC", COMPARISONS, "GL_ALWAYS", ""),
    ("GL_STENCIL_REF", INT, 0, ""),
    ("GL_STENCIL_VALUE_MASK", MASK, EVERY, ""),
    ("GL_STENCIL_FAIL", OPERATIONS, "GL_KEEP", ""),
    ("GL_STENCIL_PASS_DEPTH_FAIL", OPERATIONS, "GL_KEEP", ""),
    ("GL_STENCIL_PASS_DEPTH_PASS", OPERATIONS, "GL_KEEP", ""),
    ("GL_STENCIL_BACK_FUNC", COMPARISONS, "GL_ALWAYS", "", "2.0"),
    ("GL_STENCIL_BACK_REF", INT, 0, "", "2.0"),
    ("GL_STENCIL_BACK_VALUE_MASK", MASK, EVERY, "", "2.0"),
    ("GL_STENCIL_BACK_FAIL", OPERATIONS, "GL_KEEP", "", "2.0"),
    ("GL_STENCIL_BACK_PASS_DEPTH_FAIL", OPERATIONS, "GL_KEEP", "", "2.0"),
    ("GL_STENCIL_BACK_PASS_DEPTH_PASS", OPERATIONS, "GL_KEEP", "", "2.0"),
    ("GL_DEPTH_TEST", FLAG, False),
    ("GL_DEPTH_FUNC", COMPARISONS, "GL_LESS", "glDepthFunc $"),
    ("GL_BLEND", FLAG, False),
    ("GL_BLEND_SRC_RGB", FACTORS, "GL_ONE", ""),
    ("GL_BLEND_DST_RGB", FACTORS, "GL_ZERO", ""),
    ("GL_BLEND_SRC_ALPHA", FACTORS, "GL_ONE", ""),
    ("GL_BLEND_DST_ALPHA", FACTORS, "GL_ZERO", ""),
    ("GL_BLEND_EQUATION_RGB", EQUATIONS, "GL_FUNC_ADD", ""),
    ("GL_BLEND_EQUATION_ALPHA", EQUATIONS, "GL_FUNC_ADD", "", "2.0"),
    ("GL_BLEND_COLOR", FLOAT, (0.0, 0.0, 0.0, 0.0), "glBlendColor $"),
    ("GL_DITHER", FLAG, True),
    ("GL_INDEX_LOGIC_OP", FLAG, False),
    ("GL_COLOR_LOGIC_OP", FLAG, False),
    ("GL_LOGIC_OP_MODE", names("logic_op"), "GL_COPY", "glLogicOp $"),
)

FRAMEBUFFER: tuple[Row, ...] = (
    ("GL_DRAW_FRAMEBUFFER_BINDING", INT, 0, "", "3.0"),
    ("GL_READ_FRAMEBUFFER_BINDING", INT, 0, "", "3.0"),
    ("GL_RENDERBUFFER_BINDING", INT, 0, "glBindRenderbuffer GL_RENDERBUFFER $", "3.0"),
    ("GL_DRAW_BUFFER", BUFFERS, "GL_BACK", "glDrawBuffer $"),
    ("GL_READ_BUFFER", BUFFERS, "GL_BACK", "glReadBuffer $"),
    ("GL_COLOR_WRITEMASK", BOOL, (True, True, True, True), "glColorMask $"),
    ("GL_INDEX_WRITEMASK", MASK, EVERY, "glIndexMask $"),
    ("GL_DEPTH_WRITEMASK", BOOL, True, "glDepthMask $"),
    ("GL_STENCIL_WRITEMASK", MASK, EVERY, ""),
    ("GL_STENCIL_BACK_WRITEMASK", MASK, EVERY, "", "2.0"),
    ("GL_COLOR_CLEAR_VALUE", FLOAT, (0.0, 0.0, 0.0, 0.0), "glClearColor $"),
    ("GL_INDEX_CLEAR_VALUE", FLOAT, 0.0, "glClearIndex $"),
    ("GL_DEPTH_CLEAR_VALUE", DOUBLE, 1.0, "glClearDepth $"),
    ("GL_STENCIL_CLEAR_VALUE", INT, 0, "glClearStencil $"),
    ("GL_ACCUM_CLEAR_VALUE", FLOAT, (0.0, 0.0, 0.0, 0.0), "glClearAccum $"),
)

PIXEL_STORE: tuple[Row, ...] = tuple(
    (f"GL_{way}_{name}", kind, initial, f"glPixelStorei GL_{way}_{name} $")
    for way in ("UNPACK", "PACK")
    for name, kind, initial in (
        ("SWAP_BYTES", BOOL, False),
        ("LSB_FIRST", BOOL, False),
        ("IMAGE_HEIGHT", INT, 0),
        ("SKIP_IMAGES", INT, 0),
        ("ROW_LENGTH", INT, 0),
        ("SKIP_ROWS", INT, 0),
        ("SKIP_PIXELS", INT, 0),
        ("ALIGNMENT", INT, 4),
    )
)
PIXELS: tuple[Row, ...] = (
    ("GL_MAP_COLOR", BOOL, False, "glPixelTransferi GL_MAP_COLOR $"),
    ("GL_MAP_STENCIL", BOOL, False, "glPixelTransferi GL_MAP_STENCIL $"),
    ("GL_INDEX_SHIFT", INT, 0, "glPixelTransferi GL_INDEX_SHIFT $"),
    ("GL_INDEX_OFFSET", INT, 0, "glPixelTransferi GL_INDEX_OFFSET $"),
    *(
        (f"GL_{part}_{name}", FLOAT, initial, f"glPixelTransferf GL_{part}_{name} $")
        for part in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH")
        for name, initial in (("SCALE", 1.0), ("BIAS", 0.0))
    ),
    ("GL_ZOOM_X", FLOAT, 1.0, "glPixelZoom $ $GL_ZOOM_Y"),
    ("GL_ZOOM_Y", FLOAT, 1.0, "glPixelZoom $GL_ZOOM_X $"),
)
PIXEL_MAPS = names("pixel_map")

# Each kind of evaluator, and its initial control point.
EVALUATED: dict[str, tuple[float, ...]] = {
    "COLOR_4": (1.0, 1.0, 1.0, 1.0),
    "INDEX": (1.0,),
    "NORMAL": (0.0, 0.0, 1.0),
    "TEXTURE_COORD_1": (0.0,),
    "TEXTURE_COORD_2": (0.0, 0.0),
    "TEXTURE_COORD_3": (0.0, 0.0, 0.0),
    "TEXTURE_COORD_4": (0.0, 0.0, 0.0, 1.0),
    "VERTEX_3": (0.0, 0.0, 0.0),
    "VERTEX_4": (0.0, 0.0, 0.0, 1.0),
}
EVALUATORS: tuple[Row, ...] = (
    ("GL_AUTO_NORMAL", FLAG, False),
    ("GL_MAP1_GRID_DOMAIN", FLOAT, (0.0, 1.0), ""),
    ("GL_MAP1_GRID_SEGMENTS", INT, 1, ""),
    ("GL_MAP2_GRID_DOMAIN", FLOAT, (0.0, 1.0, 0.0, 1.0), ""),
    ("GL_MAP2_GRID_SEGMENTS", INT, (1, 1), ""),
)

HINT: tuple[Row, ...] = tuple(
    (name, names("hint_mode"), "GL_DONT_CARE", f"glHint {name} $") for name in names("hint_target")
)

ARRAYS: dict[str, tuple[str, int]] = {
    "GL_VERTEX_ARRAY": ("glVertexPointer", 4),
    "GL_NORMAL_ARRAY": ("glNormalPointer", 0),
    "GL_FOG_COORD_ARRAY": ("glFogCoordPointer", 0),
    "GL_COLOR_ARRAY": ("glColorPointer", 4),
    "GL_SECONDARY_COLOR_ARRAY": ("glSecondaryColorPointer", 3),
    "GL_INDEX_ARRAY": ("glIndexPointer", 0),
    "GL_EDGE_FLAG_ARRAY": ("glEdgeFlagPointer", 0),
    "GL_TEXTURE_COORD_ARRAY": ("glTexCoordPointer", 4),
}
"""The client arrays: the function that points one at memory, and its initial size, 0 for none."""

BINDINGS: tuple[Row, ...] = (
    ("GL_CLIENT_ACTIVE_TEXTURE", UNITS, "GL_TEXTURE0", ""),
    ("GL_VERTEX_ARRAY_BINDING", INT, 0, "", "3.0"),
    ("GL_ARRAY_BUFFER_BINDING", INT, 0, ""),
    ("GL_ELEMENT_ARRAY_BUFFER_BINDING", INT, 0, "glBindBuffer GL_ELEMENT_ARRAY_BUFFER $"),
    ("GL_PIXEL_PACK_BUFFER_BINDING", INT, 0, "glBindBuffer GL_PIXEL_PACK_BUFFER $", "2.1"),
    ("GL_PIXEL_UNPACK_BUFFER_BINDING", INT, 0, "glBindBuffer GL_PIXEL_UNPACK_BUFFER $", "2.1"),
)

STACKS: tuple[Row, ...] = (
    ("GL_ATTRIB_STACK_DEPTH", INT, 0, ""),
    ("GL_CLIENT_ATTRIB_STACK_DEPTH", INT, 0, ""),
    ("GL_LIST_BASE", INT, 0, "glListBase $"),
    ("GL_RENDER_MODE", names("render_mode"), "GL_RENDER", ""),
    ("GL_NAME_STACK_DEPTH", INT, 0, ""),
    ("GL_SELECTION_BUFFER_SIZE", INT, 0, ""),
    ("GL_FEEDBACK_BUFFER_SIZE", INT, 0, ""),
    (
        "GL_FEEDBACK_BUFFER_TYPE",
        names("feedback_type"),
        *("GL_2D", ""),
    ),
    ("GL_CURRENT_PROGRAM", INT, 0, "", "2.0"),
)
