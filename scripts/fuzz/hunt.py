"""Look for files that a reader stumbles over; a finding is made as small as it can be.

    python scripts/fuzz/hunt.py svg --seed 7 --seconds 60
    python scripts/fuzz/hunt.py svg FILE                    # read a file that was found again

A finding is an error that is no InputError, an InputError of several lines, a warning of numpy, or
more than SECONDS of the processor or MEGABYTES of memory.
"""

import argparse
import random
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1])]

# Found by the path above.
from hypothesis import HealthCheck, Phase, given, seed, settings  # noqa: E402
from readers import READERS, Reader  # noqa: E402

from framelens.base.errors import InputError  # noqa: E402

CORPUS = HERE / "corpus"  # what was once found: READER-WHAT.ending
SECONDS = 20  # processor time of one file
MEGABYTES = 1536
ROUND = 200  # files of one seed


def attempt(reader: Reader, data: bytes, folder: Path) -> None:
    """Let a reader read a file of this content; what it raises is a finding."""
    path = folder / reader.file
    path.write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        try:
            reader.read(path)
        except InputError as error:
            if len(str(error).splitlines()) != 1:
                raise AssertionError(f"not one line: {str(error)!r}") from error


def look(name: str, number: int, count: int, folder: Path) -> tuple[bytes, str] | None:
    """Read ``count`` files of the seed ``number``; return the smallest finding and its error."""
    reader = READERS[name]
    last = b""

    @seed(number)
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        phases=(Phase.generate, Phase.shrink),
        suppress_health_check=list(HealthCheck),
        report_multiple_bugs=False,
    )
    @given(reader.content)
    def read(data: bytes) -> None:
        nonlocal last
        last = data
        with _limited():
            attempt(reader, data, folder)

    try:
        read()
    except Exception as error:
        where = traceback.format_tb(error.__traceback__)[-1].strip()
        return last, f"{type(error).__name__}: {str(error)[:300]}\n    {where}"
    return None


@contextmanager
def _limited() -> Iterator[None]:
    """Raise TimeoutError inside the block once it has taken SECONDS of the processor."""
    if sys.platform == "win32":
        yield
        return

    def late(*_: object) -> None:
        raise TimeoutError(f"took more than {SECONDS} seconds of the processor")

    before = signal.signal(signal.SIGPROF, late)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def limit_memory() -> None:
    """Let this process take no more than MEGABYTES from now on."""
    if sys.platform == "linux":
        import resource

        pages = int(Path("/proc/self/statm").read_text().split()[0])
        most = pages * resource.getpagesize() + (MEGABYTES << 20)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def main() -> int:
    """Hunt for as long as is asked, or read one file; return 1 if something was found."""
    parser = argparse.ArgumentParser(prog="hunt", description=__doc__.splitlines()[0])
    parser.add_argument("reader", choices=READERS)
    parser.add_argument("file", type=Path, nargs="?", help="read this one")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6), help="default: random")
    parser.add_argument("--seconds", type=float, default=60.0, help="default: 60")
    parser.add_argument("--count", type=int, help="read as many files instead")
    parser.add_argument("--folder", type=Path, help="where findings are kept; default: temporary")
    options = parser.parse_args()

    limit_memory()
    kept = options.folder or Path(tempfile.mkdtemp(prefix="landscape-fuzz-"))
    with tempfile.TemporaryDirectory() as folder:
        if options.file:
            attempt(READERS[options.reader], options.file.read_bytes(), Path(folder))
            return 0
        return _hunt(options, Path(folder), kept)


def _hunt(options: argparse.Namespace, folder: Path, kept: Path) -> int:
    end, number, count = time.monotonic() + options.seconds, options.seed, 0
    while count < options.count if options.count else time.monotonic() < end:
        files = min(ROUND, options.count - count) if options.count else ROUND
        found = look(options.reader, number, files, folder)
        count += files
        if found is not None:
            data, error = found
            path = kept / f"{options.reader}-{number}{Path(READERS[options.reader].file).suffix}"
            path.write_bytes(data)
            print(f"{options.reader}, seed {number}: {error}")
            print(f"    python scripts/fuzz/hunt.py {options.reader} {path}", flush=True)
            return 1
        number += 1
    print(f"{options.reader}: {count} files from seed {options.seed} on, no findings", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
