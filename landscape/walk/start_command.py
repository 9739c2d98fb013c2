"""Run a command of the program in a process, and a window, of its own."""

import subprocess
import sys
from collections.abc import Sequence


def start_command(words_: Sequence[str]) -> int:
    """Run a command of the program until it ends; return its exit status."""
    return subprocess.run([sys.executable, "-m", "landscape", *words_], check=False).returncode
