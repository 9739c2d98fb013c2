"""Differences between operating systems: one function for each, in a form per system.

``posix.py`` and ``windows.py`` define the same names; this chooses between them. Nothing else in
the package asks for a signal, a lock or a way to wait that only some systems have.
"""

import sys

if sys.platform == "win32":
    from framelens.system.windows import (
        ENDING_SIGNALS,
        claimed,
        clear,
        give_back,
        interrupts_held,
        is_closed_pipe,
        is_running,
        locked,
        memory,
        processors,
        quoted,
        read_parts,
        replace,
        starting_workers,
        still_claimed,
        user_language,
    )
else:
    from framelens.system.posix import (
        ENDING_SIGNALS,
        claimed,
        clear,
        give_back,
        interrupts_held,
        is_closed_pipe,
        is_running,
        locked,
        memory,
        processors,
        quoted,
        read_parts,
        replace,
        starting_workers,
        still_claimed,
        user_language,
    )

__all__ = [
    "ENDING_SIGNALS",
    "claimed",
    "clear",
    "give_back",
    "interrupts_held",
    "is_closed_pipe",
    "is_running",
    "locked",
    "memory",
    "processors",
    "quoted",
    "read_parts",
    "replace",
    "starting_workers",
    "still_claimed",
    "user_language",
]
