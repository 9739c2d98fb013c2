"""The options that say who works: processes of this machine, or an engine of many machines."""

import argparse
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager

from framelens.base.engine import engine
from framelens.base.errors import InputError
from framelens.base.texts import said
from framelens.commands.option_values import jobs
from framelens.commands.reporting import notify
from framelens.system.processes import cores
from landscape.maker import maker

JOBS = "processes that work, each on a core of its own; default: as many as pay"
ENGINE = (
    "work on a cluster of Dask (extra `cluster`), in place of --jobs: its scheduler's address, as "
    "tcp://127.0.0.1:8786 or tls://HOST:PORT, or its scheduler file"
)


def work_options(parser: argparse.ArgumentParser, help: str = JOBS) -> None:
    """Add --jobs and --engine."""
    parser.add_argument("--jobs", type=jobs, metavar="N", help=help)
    parser.add_argument("--engine", metavar="ADDRESS|FILE.json", help=ENGINE)


@contextmanager
def work(options: argparse.Namespace) -> Iterator[tuple[Executor | None, int]]:
    """Provide the engine that the options name, or None; and how many tasks it does at a time.

    InputError where there is no engine, or none that can be trusted.
    """
    if options.engine is None:
        yield None, options.jobs or cores()
        return
    if options.jobs is not None:
        raise InputError("--engine: not with {what}", what="--jobs")

    def refused(line: InputError) -> None:
        notify(options, [said(line, "en")])

    with engine(options.engine, maker, refused) as found:
        yield found, found.workers
