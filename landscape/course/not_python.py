"""What is said of a file that should be a Python program."""

from pathlib import Path

from framelens.base.errors import InputError


def not_python(path: Path, error: SyntaxError | ValueError) -> InputError:
    """Return the error for a file that Python cannot parse: the line, and why.

    A ValueError, as for a null byte, names no line.
    """
    return InputError(
        "{path}, line {line}: is not Python ({reason})",
        path=path,
        line=getattr(error, "lineno", None) or 1,
        reason=getattr(error, "msg", None) or str(error),
    )
