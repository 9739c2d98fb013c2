"""An engine: the workers of a cluster of Dask `distributed`, as an executor.

They may be on many computers, which draw the same picture only where the same draws: in its first
task, and in each, a worker says who it is. One that differs is refused by name and sent away, and
what it was to do goes to another. Whoever reaches a scheduler runs code on all its machines, so
one that is not on this machine must speak TLS.
"""

import ipaddress
import json
import logging
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Protocol, TypeVar
from urllib.parse import urlsplit

from framelens.base.errors import InputError
from framelens.base.executor import KILLED, WorkerKilled
from framelens.base.installation import how_to_add
from framelens.system.beside import beside, threads

Result = TypeVar("Result")

ANSWER = 30.0  # chosen: seconds in which a scheduler answers
COME = 120.0  # chosen: seconds in which the first worker comes
LARGEST = 1 << 16  # bytes of a scheduler file, far more than one has
GONE = "the engine is gone: run the same command again"


class EngineGone(InputError):
    """The scheduler of a cluster has ended before its work was done."""


class Identity(Protocol):
    """Who works in a process."""

    def differences(self, other: Any) -> str:
        """Return in which words another differs from what is expected; "" if it does not."""


Task = tuple[Callable[..., Result], tuple[object, ...], dict[str, object]]
"""A function and its arguments."""

Who = Callable[[str], Identity]
"""A function of a module that returns the Identity of this process, with an OpenGL backend."""


@dataclass(frozen=True)
class Refused:
    """The answer of a worker that cannot join: its address, and how it differs from the rest."""

    address: str
    differences: str


class Engine(Executor):
    """The workers of a cluster; used as ``with engine(...) as workers``."""

    def __init__(self, client: Any, who: Who, refused: Callable[[InputError], None]) -> None:
        """Wait for the first worker. InputError if there is none that may work."""
        self._client = client
        self._who = who
        self._refused = refused
        self._executor = client.get_executor(pure=False)
        self._clerk = threads(1)
        self._gone: set[str] = set()
        self._expected: Identity = who("")
        self._expected = self.submit(who, "auto").result()

    @property
    def workers(self) -> int:
        """How many tasks are done at a time."""
        return max(sum(self._client.nthreads().values()), 1)

    def submit(
        self, function: Callable[..., Result], /, *arguments: object, **named: object
    ) -> "Future[Result]":
        asked: Future[Result] = Future()
        self._send(asked, (function, arguments, named))
        return asked

    def _send(self, asked: "Future[Result]", task: Task[Result]) -> None:
        """Hand a task to the cluster, and its outcome to the future that was asked for."""
        inner = self._executor.submit(work, self._expected, self._who, *task)
        inner.add_done_callback(partial(self._arrived, asked, task))
        asked.add_done_callback(lambda done: inner.cancel() if done.cancelled() else None)

    def _arrived(
        self, asked: "Future[Result]", task: Task[Result], inner: "Future[Result | Refused]"
    ) -> None:
        """Take the outcome of a task."""
        from distributed import KilledWorker

        if asked.cancelled():
            return
        try:
            found = inner.result()
        except CancelledError:
            asked.set_exception(EngineGone(GONE))
        except KilledWorker:
            asked.set_exception(WorkerKilled(KILLED))
        except BaseException as error:
            asked.set_exception(error)
        else:
            if isinstance(found, Refused):
                # Not here: this thread is the one that speaks with the scheduler.
                self._clerk.submit(self._send_away, asked, task, found)
            else:
                asked.set_result(found)

    def _send_away(self, asked: "Future[Result]", task: Task[Result], refused: Refused) -> None:
        """Close a worker that may not work, and hand its task to another."""
        try:
            line = InputError(
                "worker {address}: refused: {differences}",
                address=refused.address,
                differences=refused.differences,
            )
            if refused.address not in self._gone:
                self._gone.add(refused.address)
                self._refused(line)
                self._client.retire_workers([refused.address], close_workers=True)
            if not set(self._client.nthreads()) - self._gone:
                raise line
            self._send(asked, task)
        except BaseException as error:
            asked.set_exception(error)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self._clerk.shutdown(wait=False, cancel_futures=True)
        self._executor.shutdown(wait=wait and not cancel_futures)


def work(
    expected: Identity,
    who: Who,
    function: Callable[..., Result],
    arguments: tuple[object, ...],
    named: dict[str, object],
) -> Result | Refused:
    """Do a task in a worker, unless that is not what is expected."""
    differences = expected.differences(who("auto"))
    if differences:
        return Refused(_address(), differences)
    return function(*arguments, **named)


def _address() -> str:
    from distributed import get_worker

    return str(get_worker().address)


@contextmanager
def engine(given: str, who: Who, refused: Callable[[InputError], None]) -> Iterator[Engine]:
    """Provide the engine that a scheduler's address or scheduler file leads to.

    ``refused`` is called with a line for each worker that is sent away. InputError if the address
    is none that can be trusted, nothing answers there, or `distributed` is not installed.
    """
    address = trusted(given)
    try:
        from distributed import Client
    except ImportError:
        add = how_to_add("distributed", extra="cluster")
        raise InputError(
            "--engine {given}: needs Dask: run `{add}`", given=given, add=add
        ) from None
    # Dask logs pages about a lost scheduler; the command says it in one line.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    try:
        client = Client(address, timeout=ANSWER, set_as_default=False)
    except (OSError, ValueError, TypeError, RuntimeError) as error:  # a TypeError: no certificate
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(
            "--engine {given}: no scheduler answers ({reason})", given=given, reason=reason
        ) from None

    try:
        try:
            client.wait_for_workers(1, timeout=COME)
        except TimeoutError:
            raise InputError("--engine {given}: it has no worker", given=given) from None
        found = Engine(client, who, refused)
        try:
            yield found
        finally:
            found.shutdown(cancel_futures=True)
    finally:
        _closed(client)


def _closed(client: Any) -> None:
    """Close a client; not for ever where its scheduler is gone."""
    beside(partial(client.close, timeout=2)).join(5.0)


def trusted(given: str) -> str:
    """Return the address of a scheduler; InputError unless it is on this machine or speaks TLS."""
    address = _from_file(given) if given.endswith(".json") else given
    parts = urlsplit(address)
    try:
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if parts.scheme not in ("tcp", "tls") or not host or port is None:
        raise InputError(
            "--engine {given}: expected tcp://127.0.0.1:PORT, tls://HOST:PORT or a scheduler file",
            given=given,
        )
    if parts.scheme == "tcp" and not _is_loopback(host):
        raise InputError(
            "--engine {given}: expected tls://, as {host} is not this machine: whoever reaches a "
            "scheduler without TLS runs code on all its machines",
            given=given,
            host=host,
        )
    return address


def _from_file(given: str) -> str:
    try:
        with open(Path(given), "rb") as file:
            return str(json.loads(file.read(LARGEST))["address"])
    except OSError as error:
        raise InputError(
            "--engine {given}: cannot be read ({reason})", given=given, reason=error.strerror
        ) from None
    except (ValueError, TypeError, KeyError, RecursionError):
        raise InputError("--engine {given}: expected a scheduler file", given=given) from None


def _is_loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
