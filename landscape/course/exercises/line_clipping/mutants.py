"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

BEGIN = "    first = 0  # the part of the line that is left\n    last = 1\n"
BOTH = "((x0, x1 - x0, LEFT, RIGHT), (y0, y1 - y0, TOP, BOTTOM))"
NO_WAY = "            if not low <= begin <= high:\n                return None\n"
SWAP = "        if way < 0:\n            enters, leaves = leaves, enters\n"
FIRST = "        first = max(first, enters)\n"
LAST = "        last = min(last, leaves)\n"
MISS = "    if first > last:\n        return None\n"
TEST = "LEFT <= x{0} <= RIGHT and TOP <= y{0} <= BOTTOM"
FIRST_IN, SECOND_IN = TEST.format(0), TEST.format(1)
ENDS = """\
        x0 + first * (x1 - x0),
        y0 + first * (y1 - y0),
        x0 + last * (x1 - x0),
        y0 + last * (y1 - y0),
"""

MUTANTS = {
    "only_columns": Mutant(
        "cuts only at the left and the right", "outside", [(BOTH, "((x0, x1 - x0, LEFT, RIGHT),)")]
    ),
    "only_rows": Mutant(
        "cuts only above and below", "outside", [(BOTH, "((y0, y1 - y0, TOP, BOTTOM),)")]
    ),
    "no_right": Mutant(
        "forgets the right border",
        "outside",
        [(BOTH, BOTH.replace("LEFT, RIGHT", "LEFT, WIDTH + 40"))],
    ),
    "no_bottom": Mutant(
        "forgets the lower border",
        "outside",
        [(BOTH, BOTH.replace("TOP, BOTTOM", "TOP, HEIGHT + 60"))],
    ),
    "only_first": Mutant("cuts only the first end", "outside", [(LAST, "")]),
    "only_second": Mutant("cuts only the second end", "outside", [(FIRST, "")]),
    "misses": Mutant("keeps lines that pass by", "outside", [(MISS, "")]),
    "parallel": Mutant("does not test lines along a border", "outside", [(NO_WAY, "")]),
    "complement": Mutant(
        "keeps lines that are not in the frame",
        "outside",
        [
            (
                BEGIN,
                f"    if {FIRST_IN} and {SECOND_IN}:\n        return None\n"
                "    return x0, y0, x1, y1\n" + BEGIN,
            )
        ],
    ),
    "whole_lines": Mutant(
        "keeps lines with an end in the frame",
        "outside",
        [
            (
                BEGIN,
                f"    if {FIRST_IN} or {SECOND_IN}:\n        return x0, y0, x1, y1\n"
                + "    return None\n"
                + BEGIN,
            )
        ],
    ),
    "only_inside": Mutant(
        "keeps only lines that are all inside",
        "kept",
        [(BEGIN, f"    if not ({FIRST_IN} and {SECOND_IN}):\n        return None\n" + BEGIN)],
    ),
    "one_inside": Mutant(
        "drops lines with both ends outside",
        "kept",
        [(BEGIN, f"    if not ({FIRST_IN} or {SECOND_IN}):\n        return None\n" + BEGIN)],
    ),
    "no_vertical": Mutant(
        "drops vertical and horizontal lines", "kept", [(NO_WAY, "            return None\n")]
    ),
    "to_right": Mutant("lets all lines lead to the right and down", "kept", [(SWAP, "")]),
    "one_less": Mutant(
        "leaves the borders out",
        "kept",
        [(BOTH, "((x0, x1 - x0, LEFT + 1, RIGHT - 1), (y0, y1 - y0, TOP + 1, BOTTOM - 1))")],
    ),
    "first_dropped": Mutant(
        "drops lines that begin outside",
        "kept",
        [(BEGIN, f"    if not ({FIRST_IN}):\n        return None\n" + BEGIN)],
    ),
    "moved": Mutant(
        "moves the ends to the borders",
        "straight",
        [
            (
                ENDS,
                """\
        min(max(x0, LEFT), RIGHT),
        min(max(y0, TOP), BOTTOM),
        min(max(x1, LEFT), RIGHT),
        min(max(y1, TOP), BOTTOM),
""",
            )
        ],
    ),
    "endless": Mutant(
        "takes the whole straight line",
        "straight",
        [(BEGIN, "    first = -1000\n    last = 1000\n")],
    ),
    "swapped": Mutant(
        "returns the second end first",
        "straight",
        [(ENDS, "".join(ENDS.splitlines(keepends=True)[2:] + ENDS.splitlines(keepends=True)[:2]))],
    ),
    "from_other": Mutant(
        "counts the part from the other end",
        "outside",
        [
            (
                ENDS,
                ENDS.replace("x0 + last * (x1 - x0)", "x1 + last * (x0 - x1)").replace(
                    "y0 + last * (y1 - y0)", "y1 + last * (y0 - y1)"
                ),
            )
        ],
    ),
}
