"""The errors that users see as one line, and how a line shows a value that was given."""

import re
import reprlib
import sys
import traceback
from collections.abc import Callable, Iterable

from framelens.base.packages import speaker

Phrases = tuple[str, ...]
SYSTEM: Phrases = (
    "No such file or directory",
    "Permission denied",
    "Is a directory",
    "Not a directory",
    "No space left on device",
    "Read-only file system",
    "File name too long",
)
"""What operating systems say of files, as catalogues know it."""
Translate = Callable[[str], str]
"""A function from an English template to the same in the user's language."""


class Message:
    """A text for the user: a template in English, as of str.format, and the values in its {}.

    A value may be a Message, too, and is translated with it. All other values, what the user wrote
    among them, stay as they are. ``said`` in texts.py says it in a language.
    ``scripts/catalogues`` finds a template where it stands in a call: Message("..."),
    InputError("...") or NoOpenGLError("...").
    """

    def __init__(self, template: str, /, **values: object) -> None:
        self.template = template
        self.values = values

    def __str__(self) -> str:
        return self.translated(_in_english)

    def translated(self, translate: Translate) -> str:
        """Return the text with the template translated, and those of the messages in it."""
        return _filled(self.template, self.values, translate)


class _Error(Exception):
    """An error whose text is that of a Message; without values, any text as it is."""

    def __init__(self, template: str = "", /, **values: object) -> None:
        super().__init__(template)  # by which it is pickled, with its attributes
        self.values = values

    def __str__(self) -> str:
        return self.translated(_in_english)

    def translated(self, translate: Translate) -> str:
        """Return what is wrong with the template translated, and those of the messages in it."""
        return _filled(str(self.args[0]) if self.args else "", self.values, translate)


class InputError(_Error, ValueError):
    """Bad input: one line that names the file or the key and what was expected (exit status 2)."""


class NoOpenGLError(_Error, RuntimeError):
    """No usable OpenGL: one line that names the package to install (exit status 3)."""


def _in_english(template: str) -> str:
    return template


def _filled(template: str, values: dict[str, object], translate: Translate) -> str:
    template = translate(template)
    if not values:
        return template
    words = {
        name: value.translated(translate) if isinstance(value, Message | _Error) else value
        for name, value in values.items()
    }
    return template.format(**words)


def listed(parts: Iterable[str | Message]) -> str | Message:
    """Join parts as in "a, b and c"."""
    *first, last = parts
    if not first:
        return last
    joined = first[0]
    for part in first[1:]:
        joined = Message("{some}, {another}", some=joined, another=part)
    return Message("{some} and {last}", some=joined, last=last)


def reason(error: OSError) -> Message:
    """Return what the operating system says of an error, which some languages translate."""
    return Message(error.strerror or str(error))


class UnexpectedError(RuntimeError):
    """A defect of this program that another process met; ``details`` is the traceback there."""

    def __init__(self, reason: str, details: str = "") -> None:
        super().__init__(reason)
        self.details = details


PLACE = re.compile(r'^  File "(.+)", line (\d+)', re.MULTILINE)  # as a traceback says it
UNEXPECTED = 70  # the exit status for a defect of this program: EX_SOFTWARE of sysexits.h


def say_unexpected(error: BaseException) -> int:
    """Print that this program has a defect: what and where, then the traceback; return UNEXPECTED.

    On standard error: what a command prints stays what it is documented to be.
    """
    if sys.stderr is not None:  # a program of Windows without a console has none
        what, details = located(error), "".join(traceback.format_exception(error))
        if isinstance(error, UnexpectedError):
            what, details = str(error), error.details or details
        print(f"{speaker()}: a defect of this program: {visible(what)}", file=sys.stderr)
        print(visible(details), end="", file=sys.stderr, flush=True)
    return UNEXPECTED


def located(error: BaseException) -> str:
    """Return on one line what an error is, and where it was raised."""
    reason = " ".join(str(error).split())
    what = f"{type(error).__name__}: {reason}" if reason else type(error).__name__
    # A pool raises an error of its processes once more, with the traceback there as its cause.
    cause = error.__cause__
    remote = str(cause) if type(cause).__name__ == "_RemoteTraceback" else ""
    return what + raised_at(remote or "".join(traceback.format_tb(error.__traceback__)))


def raised_at(trace: str) -> str:
    """Return where a traceback ends, as ``, in FILE, line N``; "" if the text has no place."""
    places = PLACE.findall(trace)
    return ", in {}, line {}".format(*places[-1]) if places else ""


_REPR = reprlib.Repr()
_REPR.maxstring = _REPR.maxlong = _REPR.maxother = 60  # characters, chosen


# Control characters that a terminal obeys, and marks that reverse the direction of text.
UNSEEN = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")


def visible(text: str) -> str:
    """Return a text in which control characters, but for tab and newline, are seen: \\x1b."""
    return UNSEEN.sub(lambda found: ascii(found[0])[1:-1], text)


def short(value: object) -> str:
    """Return a value as Python writes it, on one line and truncated if it is long."""
    try:
        return " ".join(_REPR.repr(value).split())
    except ValueError:  # Python converts no integer of more than 4300 digits to text
        return "a number of thousands of digits"
