"""The magics of a notebook: `%load_ext landscape`, then %%check and %%draw above a program's cell.

The kernel does not run such a cell: its program would open a window. It is run in a process of its
own, as all that a notebook draws.
"""

import os
import shutil
import weakref
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from framelens.base.texts import choose
from framelens.report import in_cells
from framelens.report.look import Look, look
from framelens.tape.tape import Tape
from landscape.course.ladder import LESSONS
from landscape.notebook.checking import CELL, Check, check


def load_ipython_extension(shell: Any) -> None:
    """Register the magics, and how a tape is shown; IPython calls it for `%load_ext landscape`."""
    shell.register_magic_function(check_cell, "cell", "check")
    shell.register_magic_function(draw_cell, "cell", "draw")
    shown = shell.display_formatter.formatters["text/html"]
    shown.for_type(Tape, lambda tape: in_cells.calls(choose(os.environ), tape.calls))


def check_cell(line: str, cell: str) -> Check:
    """Grade the cell's program for the exercise that its line `# exercise: NAME` names."""
    return check(f"{cell}\n")


def draw_cell(line: str, cell: str) -> Look:
    """Draw a frame of the cell's program: `%%draw FRAME KEY...`, both may be left out.

    What is asked of it later runs the program once more.
    """
    words = line.split()
    frame = words.pop(0) if words and words[0].isdecimal() else "0"
    folder = TemporaryDirectory(prefix="landscape-")
    path = Path(folder.name, CELL)
    path.write_text(cell, encoding="utf-8")
    shutil.copy(LESSONS / "text.py", folder.name)  # by which lessons write in their windows
    drawn = look(path, int(frame[:9]), " ".join(words))
    weakref.finalize(drawn, folder.cleanup)
    return drawn
