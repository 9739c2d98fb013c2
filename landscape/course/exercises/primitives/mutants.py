"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant


def drawn(part, right, wrong, vertices=None):
    """Return the change that draws a part as another kind, or with other vertices."""
    table = "[*SUN, SUN[1]]" if part == "SUN" else part
    return [(f"(GL_{right}, {table})", f"(GL_{wrong}, {vertices or table})")]


MUTANTS = {
    "trees_joined": Mutant(
        "draws the trees as a strip", "trees", drawn("TREES", "TRIANGLES", "TRIANGLE_STRIP")
    ),
    "trees_polygon": Mutant(
        "draws the trees as one polygon", "trees", drawn("TREES", "TRIANGLES", "POLYGON")
    ),
    "trees_fan": Mutant(
        "draws the trees as a fan", "trees", drawn("TREES", "TRIANGLES", "TRIANGLE_FAN")
    ),
    "trees_lines": Mutant(
        "draws the outlines of the trees", "trees", drawn("TREES", "TRIANGLES", "LINE_LOOP")
    ),
    "fence_joined": Mutant("joins the pickets", "fence", drawn("FENCE", "LINES", "LINE_STRIP")),
    "fence_filled": Mutant(
        "draws the fence as a strip", "fence", drawn("FENCE", "LINES", "QUAD_STRIP")
    ),
    "fence_quads": Mutant("draws the fence as quads", "fence", drawn("FENCE", "LINES", "QUADS")),
    "path_gaps": Mutant(
        "draws every second piece of the path", "path", drawn("PATH", "LINE_STRIP", "LINES")
    ),
    "path_closed": Mutant("closes the path", "path", drawn("PATH", "LINE_STRIP", "LINE_LOOP")),
    "path_filled": Mutant("fills the path", "path", drawn("PATH", "LINE_STRIP", "TRIANGLE_STRIP")),
    "pond_open": Mutant(
        "does not close the pond", "pond", drawn("POND", "LINE_LOOP", "LINE_STRIP")
    ),
    "pond_filled": Mutant("fills the pond", "pond", drawn("POND", "LINE_LOOP", "POLYGON")),
    "pond_gaps": Mutant(
        "draws every second side of the pond", "pond", drawn("POND", "LINE_LOOP", "LINES")
    ),
    "hill_teeth": Mutant(
        "draws triangles of their own", "hill", drawn("HILL", "TRIANGLE_STRIP", "TRIANGLES")
    ),
    "hill_quads": Mutant("draws quads", "hill", drawn("HILL", "TRIANGLE_STRIP", "QUADS")),
    "hill_fan": Mutant("draws a fan", "hill", drawn("HILL", "TRIANGLE_STRIP", "TRIANGLE_FAN")),
    "sun_gap": Mutant(
        "does not close the fan", "sun", drawn("SUN", "TRIANGLE_FAN", "TRIANGLE_FAN", "SUN")
    ),
    "sun_to_middle": Mutant(
        "closes the fan at its middle",
        "sun",
        drawn("SUN", "TRIANGLE_FAN", "TRIANGLE_FAN", "[*SUN, SUN[0]]"),
    ),
    "sun_strip": Mutant(
        "draws the sun as a strip", "sun", drawn("SUN", "TRIANGLE_FAN", "TRIANGLE_STRIP")
    ),
    "sun_triangles": Mutant(
        "draws the sun as triangles of their own",
        "sun",
        drawn("SUN", "TRIANGLE_FAN", "TRIANGLES", "SUN"),
    ),
    "sun_rays": Mutant(
        "draws the sun's rim", "sun", drawn("SUN", "TRIANGLE_FAN", "LINE_LOOP", "SUN[1:]")
    ),
}
