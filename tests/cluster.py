"""A cluster of Dask on 127.0.0.1: a scheduler, and workers of one thread each."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from commands import SECONDS, environment


class Cluster:
    """A scheduler and its workers; ``file`` is the scheduler file."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.file = folder, folder / "scheduler.json"
        self._started: list[subprocess.Popen[bytes]] = []
        words = ["--port", "0", "--no-dashboard", "--no-jupyter"]
        self.scheduler = self._start("scheduler", *words)
        self._wait_for(self.file.is_file)

    def _start(
        self, role: str, *words: str, env: Mapping[str, str] | None = None
    ) -> "subprocess.Popen[bytes]":
        # The dashboard's address is that of a status server, which would listen to everybody.
        alike = ["--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0"]
        alike += ["--scheduler-file", str(self.file)]
        with open(self.folder / "log", "ab") as log:
            process = subprocess.Popen(
                [sys.executable, "-m", "dask", role, *alike, *words],
                env=environment(LP_NUM_THREADS="0", **(env or {})),
                stdout=log,
                stderr=log,
                cwd=self.folder,
            )
        self._started.append(process)
        return process

    def workers(self, count: int = 1, **env: str) -> "subprocess.Popen[bytes]":
        """Start workers."""
        words = ["--nworkers", str(count), "--nthreads", "1", "--no-dashboard"]
        words += ["--memory-limit", "0", "--local-directory", str(self.folder / "scratch")]
        return self._start("worker", *words, "--death-timeout", "30", env=env)

    @property
    def address(self) -> str:
        return str(json.loads(self.file.read_text())["address"])

    def pids(self) -> list[int]:
        """Return the processes of the workers, the children of their nannies."""
        from distributed import Client

        with Client(self.address, set_as_default=False) as client:
            return [worker["pid"] for worker in self._run(client)]

    def _run(self, client) -> list[dict[str, int]]:
        return [{"pid": pid} for pid in client.run(os.getpid).values()]

    def close(self) -> None:
        """End all; the workers first, or they would look for their scheduler."""
        for process in reversed(self._started):
            with suppress(ProcessLookupError):
                process.send_signal(signal.SIGINT)
        for process in reversed(self._started):
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def _wait_for(self, there) -> None:
        deadline = time.monotonic() + SECONDS
        while not there():
            assert time.monotonic() < deadline, (self.folder / "log").read_text()
            time.sleep(0.02)


@contextmanager
def cluster(folder: Path, count: int) -> Iterator[Cluster]:
    """Provide a cluster with so many workers."""
    folder.mkdir(parents=True, exist_ok=True)
    found = Cluster(folder)
    try:
        found.workers(count)
        yield found
    finally:
        found.close()
