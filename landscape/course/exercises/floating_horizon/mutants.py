"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

BEGIN = "    horizon = [-1] * WIDTH\n"
ROW = "    for row, (low, high) in enumerate(rows):\n"
COLUMN = "        for x in range(WIDTH):\n"
SPAN = "range(max(low[x], horizon[x] + 1), high[x] + 1)"
DRAWN = f"            for height in {SPAN}:\n                plot(picture, x, height, row)\n"
RAISED = "            horizon[x] = max(horizon[x], high[x])\n"
TERRAIN = "def draw_terrain(picture, rows):\n"


def span(new):
    """Return the change of the heights that are drawn."""
    return [(SPAN, new)]


def raised(new):
    """Return the change of how the horizon is raised."""
    return [(RAISED, f"            {new}\n")]


MUTANTS = {
    "raised_first": Mutant(
        "raises the horizon before the comparison", "front", [(DRAWN + RAISED, RAISED + DRAWN)]
    ),
    "back_to_front": Mutant(
        "draws the farthest row first",
        "front",
        [("in enumerate(rows)", "in reversed(list(enumerate(rows)))")],
    ),
    "first_skipped": Mutant(
        "begins with the horizon of the first row",
        "front",
        [(BEGIN, "    horizon = list(rows[0][1])\n")],
    ),
    "no_top": Mutant(
        "leaves out the upper end", "front", span("range(max(low[x], horizon[x] + 1), high[x])")
    ),
    "only_tops": Mutant(
        "draws one pixel in each column",
        "front",
        span("range(max(high[x], horizon[x] + 1), high[x] + 1)"),
    ),
    "only_hidden": Mutant(
        "compares the other way round", "front", span("range(low[x], min(high[x], horizon[x]) + 1)")
    ),
    "begins_high": Mutant(
        "begins in the middle of the picture", "front", [(BEGIN, "    horizon = [10] * WIDTH\n")]
    ),
    "kept": Mutant(
        "keeps the horizon of the last frame",
        "front",
        [(BEGIN, ""), (TERRAIN, BEGIN.strip() + "\n\n\n" + TERRAIN)],
    ),
    "only_previous": Mutant(
        "takes each row for the horizon", "hidden", raised("horizon[x] = high[x]")
    ),
    "raised_to_low": Mutant(
        "raises to the lower end", "hidden", raised("horizon[x] = max(horizon[x], low[x])")
    ),
    "whole_column": Mutant(
        "draws what is hidden of a column, too",
        "hidden",
        span("range(low[x], high[x] + 1) if high[x] > horizon[x] else ()"),
    ),
    "same_height": Mutant(
        "draws at the horizon", "hidden", span("range(max(low[x], horizon[x]), high[x] + 1)")
    ),
    "only_in_picture": Mutant(
        "is not raised above the picture",
        "hidden",
        raised("if high[x] < HEIGHT:\n                horizon[x] = max(horizon[x], high[x])"),
    ),
    "one_late": Mutant(
        "raises the horizon one row too late",
        "hidden",
        raised("if row:\n                horizon[x] = max(horizon[x], rows[row - 1][1][x])"),
    ),
    "undersides": Mutant(
        "takes a smaller height for higher",
        "hidden",
        [
            (BEGIN, "    horizon = [HEIGHT] * WIDTH\n"),
            (SPAN, "range(low[x], min(high[x], horizon[x] - 1) + 1)"),
            (RAISED, "            horizon[x] = min(horizon[x], low[x])\n"),
        ],
    ),
    "beside": Mutant(
        "compares with the column beside",
        "hidden",
        span("range(max(low[x], horizon[min(x + 1, WIDTH - 1)] + 1), high[x] + 1)"),
    ),
    "whole_row": Mutant(
        "draws a whole row if a part is seen",
        "hidden",
        [
            (COLUMN, "        seen = any(high[x] > horizon[x] for x in range(WIDTH))\n" + COLUMN),
            (SPAN, "range(low[x], high[x] + 1) if seen else ()"),
        ],
    ),
    "one_for_all": Mutant(
        "has one horizon for all columns",
        "seen",
        [(RAISED, "        horizon = [max(*horizon, *high)] * WIDTH\n")],
    ),
    "only_whole_columns": Mutant(
        "draws no column that is partly hidden",
        "seen",
        span("range(low[x], high[x] + 1) if low[x] > horizon[x] else ()"),
    ),
    "one_too_high": Mutant(
        "raises by one too much", "seen", raised("horizon[x] = max(horizon[x], high[x] + 1)")
    ),
    "ends_early": Mutant(
        "ends a row where it is hidden",
        "seen",
        [
            (COLUMN, "        seen = True\n" + COLUMN),
            (
                DRAWN,
                "            seen = seen and high[x] > horizon[x]\n"
                + DRAWN.replace(SPAN, SPAN + " if seen else ()"),
            ),
        ],
    ),
    "only_whole_rows": Mutant(
        "draws only rows that nothing hides",
        "seen",
        [
            (COLUMN, "        seen = all(high[x] > horizon[x] for x in range(WIDTH))\n" + COLUMN),
            (SPAN, "range(low[x], high[x] + 1) if seen else ()"),
        ],
    ),
}
