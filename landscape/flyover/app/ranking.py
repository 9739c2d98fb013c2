"""Results of `flyover --bench --json` ranked by frames a second, for each environment.

The source document asks for such a ranking: who flies fastest over the same environment. Results
are comparable if the environment's hash, the size of the picture and the number of frames are the
same; so each of these has a table of its own.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from framelens.base.errors import InputError
from framelens.base.input import read_bounded

ROW = "all"  # of a result: all techniques, in lines, without the removal of hidden ones
MOST_BYTES = 1 << 20  # chosen: a result takes some kilobytes


@dataclass(frozen=True)
class Ranked:
    """What is compared of a result: how fast which machine drew a flight, and with what."""

    environment: str
    hash: str
    size: tuple[int, int]
    frames: int
    fps: float
    ms: float
    processes: int
    version: str
    machine: str  # its processor, and its versions of Python and numpy
    file: str


def read(path: Path) -> Ranked:
    """Return a result; InputError if the file is none."""
    wrong = InputError("{path}: expected a result of `landscape flyover --bench --json`", path=path)
    try:
        found = json.loads(read_bounded(path, MOST_BYTES))
    except (ValueError, RecursionError) as error:
        raise InputError("{wrong} ({error})", wrong=wrong, error=error) from None
    try:
        row, machine = found["rows"][ROW], found["machine"]
        texts = [found["environment"], found["hash"], found["version"]]
        texts += [machine[name] for name in ("processor", "python", "numpy")]
        width, height = map(int, found["size"])
        numbers = [float(row["fps"]), float(row["ms"])]
        counts = [int(found["frames"]), int(found.get("processes", 1))]
    except (KeyError, TypeError, ValueError, OverflowError, RecursionError, AttributeError):
        raise wrong from None
    if not all(isinstance(text, str) for text in texts):
        raise wrong

    environment, digest, version, *parts = texts
    return Ranked(
        environment=environment,
        hash=digest,
        size=(width, height),
        frames=counts[0],
        fps=numbers[0],
        ms=numbers[1],
        processes=counts[1],
        version=version,
        machine=", ".join(parts),
        file=path.name,
    )


def ranking(results: Sequence[Ranked]) -> str:
    """Return a table for each environment, size and number of frames, the fastest first."""
    tables: dict[tuple[str, str, tuple[int, int], int], list[Ranked]] = {}
    for result in results:
        key = result.environment, result.hash, result.size, result.frames
        tables.setdefault(key, []).append(result)
    lines: list[str] = []
    for (environment, digest, (width, height), frames), ranked in sorted(tables.items()):
        lines += [""] if lines else []
        lines.append(
            f"{environment} ({digest[:8]}), {width}x{height}, {frames} frames, row {ROW!r}"
        )
        lines.append(
            f"{'':>3}{'frames/s':>9}{'ms':>9}  processes  version  machine, Python, numpy, file"
        )
        ranked.sort(key=lambda each: -each.fps)
        for rank, each in enumerate(ranked, 1):
            lines.append(
                f"{rank:>3}{each.fps:9.1f}{each.ms:9.1f}  {each.processes:>9}  "
                f"{each.version:<7}  {each.machine}, {each.file}"
            )

    return "\n".join(lines)
