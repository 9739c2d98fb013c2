"""The ``framelens`` command: ``python -m framelens``, and the script of that name."""

import sys
from collections.abc import Callable

from framelens.base import starting


def main() -> int:
    """Run the command of this process's command line; return its exit status."""
    return starting.run(_imported)


def _imported() -> Callable[[], int]:
    from framelens.cli import main

    return main


if __name__ == "__main__":
    sys.exit(main())
