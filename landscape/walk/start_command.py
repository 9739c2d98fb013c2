"""Run a command of the program in a process, and a window, of its own."""

from collections.abc import Sequence

from framelens.base.isolated import started


def start_command(words_: Sequence[str]) -> int:
    """Run a command of the program until it ends; return its exit status.

    It ends with this process, if that is interrupted meanwhile.
    """
    with started(["-m", "landscape", *words_], {}) as command:
        try:
            return command.wait()
        except BaseException:
            command.kill()
            raise
