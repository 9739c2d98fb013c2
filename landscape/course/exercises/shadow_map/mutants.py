"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

COPY = "    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 0, 0, SIZE, SIZE, 0)\n"
COMPARE = "    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)\n"
VIEWPORT = "    glViewport(0, 0, SIZE, SIZE)\n"
NO_COLORS = "    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE)\n"
COLORS = "    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE)\n"
OFFSET, ENABLE = "    glPolygonOffset(3, 4)\n", "    glEnable(GL_POLYGON_OFFSET_FILL)\n"
DRAWN = "    draw_scene()\n    glDisable(GL_POLYGON_OFFSET_FILL)\n"
ROWS = "    x, y, z, w = glGetFloatv(GL_PROJECTION_MATRIX).T  # its rows\n"
PLANES = "((x + w) / 2, (y + w) / 2, (z + w) / 2, w)"
LOOP = f"""    for axis, plane in zip(AXES, {PLANES}):
        glTexGenfv(axis, GL_EYE_PLANE, plane)
"""
ONCE = "    if lamp == -35:\n" + "".join(f"    {row}\n" for row in LOOP.splitlines())
FIRST = "    viewport = glGetIntegerv(GL_VIEWPORT)\n    glPushMatrix()\n    glLoadIdentity()\n"
POP = "    glMatrixMode(GL_MODELVIEW)\n    glPopMatrix()\n"
LAMP = "    glLoadIdentity()\n    look_from_lamp()\n"
CLEAR = "    glClear(GL_DEPTH_BUFFER_BIT)\n"

MUTANTS = {
    "no_copy": Mutant("copies nothing", "copied", [(COPY, "")]),
    "color_copied": Mutant(
        "copies colors", "copied", [(COPY, COPY.replace("GL_DEPTH_COMPONENT", "GL_RGB"))]
    ),
    "too_early": Mutant(
        "copies before drawing", "copied", [(COPY, ""), (ENABLE + DRAWN, COPY + ENABLE + DRAWN)]
    ),
    "quarter": Mutant(
        "copies a quarter", "copied", [(COPY, COPY.replace("SIZE, SIZE", "SIZE // 2, SIZE // 2"))]
    ),
    "camera_view": Mutant(
        "keeps the camera's modelview matrix",
        "seen",
        [(FIRST, FIRST.replace("    glLoadIdentity()\n", ""))],
    ),
    "camera_projection": Mutant(
        "keeps the camera's projection matrix", "seen", [(LAMP, "    look_from_lamp()\n")]
    ),
    "whole_window": Mutant("sets no viewport", "seen", [(VIEWPORT, "")]),
    "no_offset": Mutant("forgets to enable the offset", "offset", [(ENABLE, "")]),
    "toward": Mutant(
        "moves toward the lamp", "offset", [(OFFSET, OFFSET.replace("3, 4", "-2, -4"))]
    ),
    "units_only": Mutant("gives no factor", "offset", [(OFFSET, OFFSET.replace("3, 4", "0, 4"))]),
    "no_compare": Mutant("does not compare", "compared", [(COMPARE, "")]),
    "greater": Mutant(
        "compares the other way round",
        "compared",
        [
            (
                COMPARE,
                COMPARE
                + COMPARE.replace("MODE", "FUNC").replace("GL_COMPARE_R_TO_TEXTURE", "GL_GEQUAL"),
            )
        ],
    ),
    "no_bias": Mutant("forgets the bias", "planes", [(PLANES, "(x, y, z, w)")]),
    "identity": Mutant(
        "gives the planes under the identity",
        "planes",
        [(LOOP, ""), (POP, "    glMatrixMode(GL_MODELVIEW)\n" + LOOP + "    glPopMatrix()\n")],
    ),
    "swapped": Mutant(
        "swaps s and t", "planes", [(PLANES, "((y + w) / 2, (x + w) / 2, (z + w) / 2, w)")]
    ),
    "columns": Mutant("takes columns for rows", "planes", [(ROWS, ROWS.replace(".T", ""))]),
    "no_q": Mutant(
        "gives no plane of q", "planes", [(PLANES, "((x + w) / 2, (y + w) / 2, (z + w) / 2)")]
    ),
    "once": Mutant("gives the planes of the first frame", "planes", [(LOOP, ONCE)]),
    "viewport_left": Mutant(
        "keeps the lamp's viewport", "restored", [("    glViewport(*viewport)\n", "")]
    ),
    "no_depth_clear": Mutant("does not clear the depths", "restored", [(CLEAR, "")]),
    "color_left": Mutant("leaves the colors masked", "restored", [(COLORS, "")]),
    "painted": Mutant("draws the lamp's picture in color", "restored", [(NO_COLORS, "")]),
}
