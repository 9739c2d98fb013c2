"""The OpenGL features that each part of the pictures requires: one table, asked before any use.

A name says what is drawn, or is the key of the setting that asks for it. What is not possible is
left out: the rest of the picture stays. :func:`possible` says so once, in one line on stderr.
Whoever draws more adds to FEATURES.
"""

from typing import NamedTuple

from framelens.base.errors import NoOpenGLError
from framelens.gl import extensions
from framelens.gl.extensions import Need, first_missing, tell

# OpenGL 1.2.
EDGE_CLAMP = Need((1, 2), ("GL_SGIS_texture_edge_clamp",))
LEVELS = Need((1, 2), ("GL_SGIS_texture_lod",))
SPECULAR = Need((1, 2), ("GL_EXT_separate_specular_color",))
# OpenGL 1.3.
COMBINE = Need((1, 3), ("GL_ARB_texture_env_combine",))
DOT3 = Need((1, 3), ("GL_ARB_texture_env_dot3",))
CUBE_MAP = Need((1, 3), ("GL_ARB_texture_cube_map",))
BORDER = Need((1, 3), ("GL_ARB_texture_border_clamp",))
# OpenGL 1.4.
CROSSBAR = Need((1, 4), ("GL_ARB_texture_env_crossbar",))
DEPTH_TEXTURE = Need((1, 4), ("GL_ARB_depth_texture",))
SHADOW = Need((1, 4), ("GL_ARB_shadow",))
FOG_COORDINATES = Need((1, 4), ("GL_EXT_fog_coord",))
MAKES_LEVELS = Need((1, 4), ("GL_SGIS_generate_mipmap",))
LOD_BIAS = Need((1, 4))
EQUATIONS = Need((1, 4), ("GL_EXT_blend_minmax",))
SUBTRACT = Need((1, 4), ("GL_EXT_blend_subtract",))
MULTI_DRAW = Need((1, 4), ("GL_EXT_multi_draw_arrays",))
STENCIL_WRAP = Need((1, 4), ("GL_EXT_stencil_wrap",))
# OpenGL 1.5 and later.
BUFFERS = Need((1, 5), ("GL_ARB_vertex_buffer_object",))
QUERY = Need((1, 5), ("GL_ARB_occlusion_query",))
ANY_SIZE = Need((2, 0), ("GL_ARB_texture_non_power_of_two",))
# GL_EXT_framebuffer_object alone has functions of other names, and no buffer of depth and stencil.
FRAMEBUFFERS = Need((3, 0), ("GL_ARB_framebuffer_object",))
FLOAT_TEXTURES = Need((3, 0), ("GL_ARB_texture_float",))
VERTEX_ARRAYS = Need((3, 0), ("GL_ARB_vertex_array_object",))
FOG_DISTANCE = Need(None, ("GL_NV_fog_distance",))

PICTURE = (FRAMEBUFFERS, ANY_SIZE)  # to draw into a texture
DEPTHS = (FRAMEBUFFERS, DEPTH_TEXTURE, SHADOW, BORDER)  # to draw into a texture of depths


class Feature(NamedTuple):
    """The requirements of a part of the pictures: all of ``needs``, and so many texture units.

    A ``silent`` one changes the speed alone, or is replaced by something as good.
    """

    needs: tuple[Need, ...] = ()
    units: int = 1
    silent: bool = False


FEATURES = {
    "antialiasing": Feature((FRAMEBUFFERS,)),
    "stills in framebuffer objects": Feature((FRAMEBUFFERS,), silent=True),
    "edges of textures": Feature((EDGE_CLAMP,)),
    "textures of any size": Feature((ANY_SIZE, MAKES_LEVELS), silent=True),
    "a number of mip levels": Feature((LEVELS,), silent=True),
    "sharper textures": Feature((LOD_BIAS,)),
    "vertex buffers": Feature((BUFFERS,), silent=True),
    "glMultiDrawArrays": Feature((MULTI_DRAW,), silent=True),
    "a pixel's history": Feature((QUERY, FRAMEBUFFERS, FLOAT_TEXTURES)),
}


def reason(name: str) -> str:
    """Return why a feature is not possible in the current OpenGL; "" if it is."""
    feature = FEATURES[name]
    if need := first_missing(feature.needs):
        return f"this OpenGL has no {need.text}"
    units = extensions.texture_units()
    return f"it needs {feature.units} texture units of {units}" if units < feature.units else ""


def possible(name: str) -> bool:
    """Return whether the current OpenGL has all that a feature needs; if not, say once why."""
    why = reason(name)
    if why and not FEATURES[name].silent:
        tell(f"{name}: off, for {why}")
    return not why


def require(name: str) -> None:
    """Raise NoOpenGLError if a feature that a command cannot do without is not possible."""
    if why := reason(name):
        raise NoOpenGLError("{name}: {why}", name=name, why=why)


def left_out() -> dict[str, list[str]]:
    """Return what is not possible in the current OpenGL, by what is missing."""
    found: dict[str, list[str]] = {}
    for name in FEATURES:
        if why := reason(name):
            found.setdefault(why, []).append(name)
    return found
