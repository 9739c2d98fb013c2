"""The sandbox's waiting process, which forks for each program (see sandbox.py).

It answers each line of standard input, a list of jobs, by a line that says how each of them ended.
"""

import contextlib
import json
import os
import select
import sys
import time
from typing import Any

from framelens.system import limits
from landscape.course.grader.sandbox import GRACE, ended
from landscape.course.grader.sandboxed import prepare, run_program

assert sys.platform != "win32"


def serve() -> None:
    """Answer until standard input ends."""
    limits.end_with(os.getppid())
    # Programs inherit the numbers 0 and 1, which must not lead to whoever asks.
    asked, replies = os.fdopen(os.dup(0)), os.fdopen(os.dup(1), "w")
    discard = os.open(os.devnull, os.O_RDWR)
    for number in range(2):
        os.dup2(discard, number)
    with contextlib.ExitStack() as stack:
        no_opengl = prepare(stack)
        for line in asked:
            answer = {"no_opengl": no_opengl} if no_opengl else {"ended": _run(json.loads(line))}
            print(json.dumps(answer), file=replies, flush=True)


def _run(jobs: list[dict[str, Any]]) -> list[str]:
    """Run jobs beside each other; return how each ended."""
    running: dict[int, tuple[int, int, float]] = {}
    us = os.getpid()
    for index, job in enumerate(jobs):
        ends, held = os.pipe()  # the program holds one end as long as it lives
        pid = os.fork()
        if pid == 0:
            os.close(ends)
            os.setsid()
            run_program(job, us)
        os.close(held)
        running[ends] = index, pid, time.monotonic() + job["seconds"] + GRACE

    reasons = [""] * len(jobs)
    while running:
        left = min(end for _, _, end in running.values()) - time.monotonic()
        ready = select.select(list(running), [], [], max(left, 0))[0]
        for ends, (index, pid, deadline) in list(running.items()):
            if ends not in ready and time.monotonic() < deadline:
                continue
            limits.end_group(pid)
            status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
            reasons[index] = ended(status, ends not in ready)
            os.close(ends)
            del running[ends]

    return reasons


if __name__ == "__main__":
    serve()
