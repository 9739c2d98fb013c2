"""What a process lets itself be limited to, on this system and as others do it."""

import subprocess
import sys

import pytest
from commands import SECONDS, environment, python

from framelens.system import limits

# Fills memory by 8 MB at a time until it may no more; says how much it got, in MB, and what it gets
# without a limit.
FILL = """
import sys, time
from framelens.system import limits

limits.system.KEEPS_MEMORY = limits.system.KEEPS_MEMORY and sys.argv[1] == "by the system"
limits.limit_memory(limits.used() + (100 << 20))
parts = []
try:
    while len(parts) < 1000:
        parts.append(b"x" * (8 << 20))
        time.sleep(0.01)
except MemoryError:
    size = 8 * len(parts)
    parts.clear()
    limits.limit_memory(None)
    print(size, len(b"x" * (200 << 20)) >> 20)
"""


@pytest.mark.parametrize("way", ["by the system", "by a thread"])
def test_memory_ends_by_an_exception_until_the_limit_is_lifted(way: str) -> None:
    done = python(FILL, way)
    assert done.status == 0, done.err
    size, after = map(int, done.out.split())
    assert 40 <= size <= 1000 and after == 200


END_WITH = """
import os, subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", '''
import os, sys, time
from framelens.system import limits
system = sys.platform
sys.platform = sys.argv[1] or system
limits.end_with(int(sys.argv[2]))
sys.platform = system
print("ready", flush=True)
while True: time.sleep(0.1)
''', sys.argv[1], str(os.getpid())], stdout=subprocess.PIPE)
child.stdout.readline()
print(child.pid, flush=True)
os._exit(0)
"""


@pytest.mark.parametrize("system", ["", "another"])
def test_a_process_ends_with_its_parent(system: str) -> None:
    if system and sys.platform == "win32":
        pytest.skip("on Windows there is one way")
    # Standard error ends when the last process that holds it does: the child of the one started.
    done = subprocess.run(
        [sys.executable, "-c", END_WITH, system],
        capture_output=True,
        env=environment(),
        timeout=SECONDS,
        check=True,
    )
    assert int(done.stdout) > 0 and done.stderr == b""


def test_crashes_have_names_and_other_ends_have_none() -> None:
    crash = python("import os; os.abort()")
    assert limits.crash(crash.status) in ("SIGABRT", "abort")
    assert [limits.crash(status) for status in (0, 1, 2)] == ["", "", ""]


def test_a_group_is_ended_and_may_have_ended_already() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", "import time; time.sleep(600)"], **limits.OWN_GROUP
    ) as process:
        limits.end_group(process.pid)
        assert process.wait(SECONDS) != 0
        limits.end_group(process.pid)
