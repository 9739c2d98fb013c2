"""Run lessons where GLFW finds no screen: a line for each, with what it says when it ends.

    python without_screen.py FILE ...

Each runs twice: as it is, and with a GLFW that starts but gives no window. A lesson that goes on
nevertheless ends this process: GLFW aborts when it is given no window.
"""

import runpy
import sys
import warnings
from collections.abc import Callable
from pathlib import Path

import glfw


def ended(file: str) -> str:
    """Return what a program says when it ends by itself."""
    sys.path.insert(0, str(Path(file).parent))
    try:
        runpy.run_path(file, run_name="__main__")
    except SystemExit as error:
        return str(error.code)
    finally:
        sys.path.pop(0)
    return "it ended without a word"


def main() -> None:
    """Print for each file its name and the two texts, separated by tabs."""
    warnings.simplefilter("ignore", glfw.GLFWError)  # the reason, which GLFW gives as a warning
    init: Callable[[], bool] = glfw.init
    for file in sys.argv[1:]:
        print(Path(file).stem, end="\t", flush=True)
        glfw.init = init
        print(ended(file), end="\t", flush=True)
        glfw.init = lambda: True
        print(ended(file), flush=True)


if __name__ == "__main__":
    main()
