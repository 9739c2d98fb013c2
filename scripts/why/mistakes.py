"""Mistakes to sow into a program: a text that is replaced, and the causes that may be named."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mistake:
    """Text that is replaced, once, and the causes that may be named for it."""

    name: str
    pattern: str
    replacement: str
    causes: tuple[str, ...]
    everywhere: bool = False  # whether the whole picture is asked about


OUTSIDE = ("behind", "beyond-near", "beyond-far", "beside", "no-projection")
MISTAKES = (
    Mistake("no swap", r"glfw\.swap_buffers\(window\)", "pass", ("no-swap",), everywhere=True),
    Mistake("no depth test", r"glEnable\(GL_DEPTH_TEST\)", "pass", ("no-depth-test",)),
    Mistake(
        "depth func",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glDepthFunc(GL_GREATER)",
        ("depth-func",),
    ),
    Mistake(
        "clear depth",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glClearDepth(0)",
        ("clear-depth", "depth-func"),
    ),
    Mistake(
        "viewport", r"glViewport\(0, 0, width, height\)", "glViewport(0, 0, 0, 0)", ("viewport",)
    ),
    Mistake(
        "behind",
        r"glTranslatef\((\S+), (\S+), -(\d+\.?\d*)\)",
        r"glTranslatef(\1, \2, \3)",
        OUTSIDE,
    ),
    Mistake(
        "near",
        r"gluPerspective\(([^,\n]+), ([^,\n]+), [^,\n]+, ([^,\n]+)\)\n",
        r"gluPerspective(\1, \2, 20, 300)\n",
        ("beyond-near",),
    ),
    Mistake(
        "far",
        r"gluPerspective\(([^,\n]+), ([^,\n]+), [^,\n]+, ([^,\n]+)\)\n",
        r"gluPerspective(\1, \2, 0.1, 0.5)\n",
        ("beyond-far",),
    ),
    Mistake(
        "near 0",
        r"gluPerspective\(([^,\n]+), ([^,\n]+), [^,\n]+, ([^,\n]+)\)\n",
        r"gluPerspective(\1, \2, 0, \3)\n",
        ("near-zero",),
    ),
    Mistake(
        "aspect 0", r"gluPerspective\(([^,]+), ([^,]+),", r"gluPerspective(\1, 0,", ("aspect-zero",)
    ),
    Mistake(
        "radians",
        r"gluPerspective\(([^,]+),",
        r"gluPerspective(\1 * 3.14159 / 180,",
        ("fovy-radians",),
    ),
    Mistake(
        "matrix mode",
        r"(gluPerspective\([^\n]*\n\s*)glMatrixMode\(GL_MODELVIEW\)",
        r"\1pass",
        ("projection-wiped", *OUTSIDE),
    ),
    Mistake("light off", r"glEnable\(GL_LIGHT0\)", "pass", ("light-off",)),
    Mistake("lighting off", r"glEnable\(GL_LIGHTING\)", "pass", ("lighting-off",)),
    Mistake(
        "no material",
        r"(?<=glEnable\()GL_COLOR_MATERIAL(?=\))|GL_COLOR_MATERIAL(?=(, \w+)*\):)",
        "GL_DITHER",  # is enabled at the start
        ("no-color-material",),
    ),
    Mistake(
        "far side",
        r"glLightfv\(GL_LIGHT0, GL_POSITION, [^\n]*\)",
        "glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, -1, 0))",
        ("light-far-side", "light-before-camera"),
    ),
    Mistake(
        "cull front",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glEnable(GL_CULL_FACE); glCullFace(GL_FRONT)",
        ("cull-front",),
    ),
    Mistake(
        "winding",
        r"glEnable\(GL_DEPTH_TEST\)",
        r"\g<0>; glEnable(GL_CULL_FACE); glFrontFace(GL_CW)",
        ("front-face", "inside-out", "culled"),
    ),
    Mistake(
        "incomplete",
        r"glTexParameteri\(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, [^\n]*\)",
        "pass",
        ("texture-incomplete",),
    ),
    Mistake("texture off", r"glEnable\(GL_TEXTURE_2D\)", "pass", ("texture-off",)),
    Mistake(
        "black times",
        r"glEnable\(GL_TEXTURE_2D\)",
        r"\g<0>; glColor3f(0, 0, 0)",
        ("texture-times-black",),
    ),
    Mistake("no blend", r"glEnable\(GL_BLEND\)", "pass", ("no-blend",)),
    Mistake(
        "no clear",
        r"glClear\((GL_COLOR_BUFFER_BIT \| )?GL_DEPTH_BUFFER_BIT\)",
        "glClear(GL_COLOR_BUFFER_BIT)",
        ("no-depth-clear",),
    ),
    Mistake(
        "late clear",
        r"( +)glfw\.swap_buffers\(window\)",
        r"\1glClear(GL_COLOR_BUFFER_BIT)\n\g<0>",
        ("late-clear",),
    ),
    Mistake("array", r"glEnableClientState\(GL_VERTEX_ARRAY\)", "pass", ("array-not-enabled",)),
    Mistake(
        "color mask",
        r"glClear\([^\n]*\)",
        r"\g<0>; glColorMask(False, False, False, True)",
        ("color-mask", "clear-masked", "leak"),
    ),
    Mistake("no end", r"glEnd\(\)", "pass", ("no-end", "inside-begin"), everywhere=True),
)
