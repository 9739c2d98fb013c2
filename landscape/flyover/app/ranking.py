"""Results of `flyover --bench --json` ranked by frames a second, for each environment.

The source document asks for such a ranking: who flies fastest over the same environment. Results
are comparable if the environment's hash, the size of the picture and the number of frames are the
same; so each of these has a table of its own.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from framelens.base.errors import InputError
from framelens.base.input import read_bounded

ROW = "all"  # of a result: all techniques, in lines, without the removal of hidden ones
MOST_BYTES = 1 << 20  # chosen: a result takes some kilobytes
MACHINE = "machine"


def read(path: Path) -> dict[str, object]:
    """Return a result; InputError if the file is none."""
    wrong = InputError("{path}: expected a result of `landscape flyover --bench --json`", path=path)
    try:
        found = json.loads(read_bounded(path, MOST_BYTES))
    except (ValueError, RecursionError) as error:
        raise InputError("{wrong} ({error})", wrong=wrong, error=error) from None
    try:
        row = found["rows"][ROW]
        numbers = [*map(float, (row["fps"], row["ms"], found["frames"], *found["size"]))]
        texts = [found["environment"], found["hash"], found["version"]]
        texts += [found[MACHINE][name] for name in ("processor", "python", "numpy")]
    except (KeyError, TypeError, ValueError, OverflowError, RecursionError):
        raise wrong from None
    if len(numbers) != 5 or not all(isinstance(text, str) for text in texts):
        raise wrong
    return {**found, "file": path.name}


def ranking(results: Sequence[dict[str, Any]]) -> str:
    """Return a table for each environment, size and number of frames, the fastest first."""
    tables: dict[tuple[Any, ...], list[dict[str, Any]]] = {}
    for result in results:
        key = result["environment"], result["hash"], *result["size"], result["frames"]
        tables.setdefault(key, []).append(result)
    lines: list[str] = []
    for (environment, digest, width, height, frames), found in sorted(tables.items()):
        lines += [""] if lines else []
        lines.append(
            f"{environment} ({digest[:8]}), {width}x{height}, {frames} frames, row {ROW!r}"
        )
        lines.append(
            f"{'':>3}{'frames/s':>9}{'ms':>9}  processes  version  machine, Python, numpy, file"
        )
        found.sort(key=lambda each: -float(each["rows"][ROW]["fps"]))
        for rank, each in enumerate(found, 1):
            row, machine = each["rows"][ROW], each[MACHINE]
            lines.append(
                f"{rank:>3}{row['fps']:9.1f}{row['ms']:9.1f}  {each.get('processes', 1):>9}  "
                f"{each['version']:<7}  {machine['processor']}, {machine['python']}, "
                f"{machine['numpy']}, {each['file']}"
            )

    return "\n".join(lines)
