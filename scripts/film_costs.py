"""Measure what it costs to draw a film in parts, or by an engine.

    python scripts/film_costs.py pairs --ways plain,parts --words fig35a --preset 2006 --jobs 2
    python scripts/film_costs.py pairs --ways plain,engine --engine FILE.json --words fig35a
    python scripts/film_costs.py empty --jobs 2
    PYTHONPATH=scripts python scripts/film_costs.py empty --engine FILE.json

``pairs`` draws a film in several ways in turn, each a command of its own, and compares each with
the first way of its round: from its start to its end, by the wall clock and by the processors'
time, which other programs disturb less. Choose ``--seconds`` so that each process has as many parts
of four seconds as the others; what starting costs weighs less in a long film. ``empty`` schedules,
encodes and joins a long film of black pictures, which cost nothing to draw, and says how long it
took and the most memory of a process. The workers of an engine, which is there already, need
PYTHONPATH=scripts for that, too.
"""

import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np

from framelens.base.engine import Engine, engine, trusted
from framelens.base.executor import lent_or_own
from landscape.film.cut import Film, Part
from landscape.film.parted import draw, join
from landscape.film.stage import Drawing, Stage
from landscape.maker import maker

FPS = 30


@dataclass(frozen=True)
class Black:
    """Black pictures."""

    seconds: float
    needs_opengl: ClassVar[bool] = False

    def open(self, stage: Stage) -> Callable[[float], np.ndarray]:
        """Return the function that draws them."""
        picture = np.zeros((*stage.size[::-1], 3), np.uint8)
        return lambda seconds: picture


@dataclass(frozen=True)
class Cost:
    """How long a film took, and how much of the processors: seconds."""

    wall: float
    processor: float


def pairs(options: argparse.Namespace) -> int:
    """Draw a film in turns in each way, and print how much longer than the first each takes."""
    ways = options.ways.split(",")
    measured = Measured(options)
    rounds = []
    for number in range(options.pairs):
        order = ways if number % 2 == 0 else ways[::-1]
        rounds.append({way: measured.cost(way, options.seconds) for way in order})
    for kind in ("wall", "processor"):
        print(f"{kind}:")
        taken = [{way: getattr(each[way], kind) for way in ways} for each in rounds]
        for way in ways:
            more = [each[way] / each[ways[0]] - 1 for each in taken]
            middle = statistics.median(each[way] for each in taken)
            print(
                f"  {way}: {middle:.2f} s; {statistics.median(more):+.1%} "
                f"({min(more):+.1%} to {max(more):+.1%})"
            )
    return 0


class Measured:
    """Films that are drawn by commands and measured."""

    def __init__(self, options: argparse.Namespace) -> None:
        """Draw nothing yet."""
        self._options = options
        self._films = 0

    def cost(self, way: str, seconds: float) -> Cost:
        """Draw a film of so many seconds; return what that took."""
        options = self._options
        # Each film is another one: the workers of an engine keep the last one open.
        self._films += 1
        words = [*options.words, "--kt", f"{self._films / 1000:g}"]
        words += ["--fps", str(FPS), "--seconds", f"{seconds:g}", "-q"]
        words += ["--engine", options.engine] if "engine" in way else ["--jobs", str(options.jobs)]
        with tempfile.TemporaryDirectory() as place:
            words += ["--out", f"{place}/film.mp4"]
            words += ["--parts", f"{place}/parts"] if "parts" in way else []
            command = [sys.executable, "-m", "landscape", "film", *words]
            processor, begun = self._processor(), time.monotonic()
            subprocess.run(command, check=True, env={**os.environ, "LP_NUM_THREADS": "0"})
            return Cost(time.monotonic() - begun, self._processor() - processor)

    def _processor(self) -> float:
        """Return the seconds of commands that have ended, and of the engine's workers."""
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        found = children.ru_utime + children.ru_stime
        if self._options.engine is not None:
            from distributed import Client

            with Client(trusted(self._options.engine), set_as_default=False) as client:
                found += sum(sum(each[:2]) for each in client.run(os.times).values())
        return found


def empty(options: argparse.Namespace) -> int:
    """Draw a long film of black pictures in parts, and join them."""
    from film_costs import Black as Known  # as the workers find it

    width, height = map(int, options.size.split("x"))
    film = Film(
        (Part(Known(options.frames / FPS)),), Drawing((width, height), samples=0), Fraction(FPS)
    )
    with tempfile.TemporaryDirectory() as place, opened(options.engine) as workers:
        jobs = options.jobs if workers is None else workers.workers
        begun = time.monotonic()
        parting = draw(
            film, Path(place) / "parts", ".mp4", partial(lent_or_own, workers, jobs), jobs
        )
        drawn = time.monotonic()
        join(parting.parts, Path(place) / "film.mp4")
        joined = time.monotonic()
        size = (Path(place) / "film.mp4").stat().st_size
    print(
        f"{film.frames} frames in {parting.parts.plan.parts} parts: {drawn - begun:.1f} s, "
        f"joined in {joined - drawn:.1f} s, {size / 1e6:.1f} MB"
    )
    processes = {"this process": resource.RUSAGE_SELF, "a worker": resource.RUSAGE_CHILDREN}
    if options.engine is not None:
        del processes["a worker"]  # it is none of this command's
    for name, who in processes.items():
        print(f"{name}: at most {resource.getrusage(who).ru_maxrss / 1024:.0f} MB")
    return 0


@contextmanager
def opened(address: str | None) -> Iterator[Engine | None]:
    """Provide the engine of an address, or None."""
    with nullcontext() if address is None else engine(address, maker, print) as found:
        yield found


def main() -> int:
    """Measure one of the two."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("what", choices=("pairs", "empty"))
    parser.add_argument("--ways", default="plain,parts", help="plain, parts, engine, engine+parts")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=40.0, help="of a film")
    parser.add_argument("--frames", type=int, default=100_000)
    parser.add_argument("--size", default="16x16", help="of empty frames")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--engine", help="a scheduler's address or file")
    parser.add_argument("--words", nargs=argparse.REMAINDER, default=[], help="of the film")
    options = parser.parse_args()
    return pairs(options) if options.what == "pairs" else empty(options)


if __name__ == "__main__":
    sys.exit(main())
