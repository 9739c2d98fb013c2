"""Why a program could not be graded, as sentences; the words are those of witness.py."""

from collections.abc import Mapping

from framelens.base.texts import Texts, Translator, filled

SENTENCES: Texts = {
    "raised": "line {line}: the program raised {error}",
    "invalid_enumerant": "line {line}: the program raised GLError: invalid enumerant, in {call}: a "
    "name in it is not one that this function accepts",
    "invalid_value": "line {line}: the program raised GLError: invalid value, in {call}: a number "
    "in it is not one that this function accepts",
    "invalid_operation": "line {line}: the program raised GLError: invalid operation, in {call}: "
    "OpenGL allows it only at other moments, not between glBegin and glEnd for instance",
    "stack_overflow": "line {line}: the program raised GLError: stack overflow, in {call}: the "
    "stack is full, because more is pushed than popped",
    "stack_underflow": "line {line}: the program raised GLError: stack underflow, in {call}: the "
    "stack has nothing left to pop, because less was pushed",
    "memory": "line {line}: the program needs more than {megabytes} MB of memory",
    "calls": "calls OpenGL more often in a frame than the grader can note down: more can be drawn "
    "with each call",
    "network": "line {line}: the program uses the network, which it cannot while it is checked",
    "start": "line {line}: the program starts another one, which it cannot while it is checked",
    "write": "line {line}: the program writes a file, which it cannot while it is checked",
    "read": "line {line}: the program reads files of the course, which it cannot while it is "
    "checked",
    "unclosed": "line {line}: {call} is called between glBegin and glEnd: a glEnd is missing "
    "before it",
    "late_window": "opened no window within {seconds:g} s: does a loop before it never end?",
    "no_window": "ended without opening a window",
    "no_context": "shows a frame without a context: glfw.make_context_current(window) must come "
    "before the first call of OpenGL",
    "early": "line {line}: {call} is called before glfw.make_context_current(window): without a "
    "context it has no effect",
    "no_frame": "showed no frame within {seconds:g} s: glfw.swap_buffers(window) shows it",
    "late_frame": "got no farther than frame {frames} within {seconds:g} s",
    "ended": "ended in frame {frames}: it must go on until its window is closed",
    "late": "did not end within {seconds:g} s, and could not be interrupted",
    "full": "writes more into files, or draws larger pictures, than an exercise needs",
    "much": "takes more threads, or shared memory, than an exercise needs",
    "crashed": "the program crashed ({signal})",
    "crashed_at": "line {line}: the program crashed ({signal}): OpenGL reads arrays as far as it "
    "is told, even beyond their end",
    "forged": "what it shows in frame {frame} is not what the program drew: its calls of OpenGL "
    "give another picture",
    "died": "ended the Python process by itself ({signal})",
    "two_windows": "opens two windows; an exercise needs only one",
    "no_toolkit": "does not import glfw, so it opens no window",
    "package": "needs a Python package that is not installed: {reason}",
    "grader": "uses {reason}, which it cannot while it is checked: the solutions are in it",
    "syntax": "line {line}: is not Python ({error})",
    "not_python": "is not a Python program",
    "refused": "cannot be run: {reason}",
}


MOST_LINES = 10**7  # chosen: of a program
LONGEST = 400  # chosen: characters of a sentence


def sentence(error: Mapping[str, object], _: Translator) -> str:
    """Return what went wrong in a language, on one line; ``error`` has the "word" and values."""
    word = str(error["word"])
    return " ".join(filled(_(SENTENCES[word], word), error, _(".")).split())[:LONGEST]


def known(error: object) -> bool:
    """Return whether an error has a known word and the values of its sentence.

    A program may have sent another one: all its values are to be short texts or numbers, and its
    line one that a file may have.
    """
    if not isinstance(error, dict) or not _is_line(error.get("line", 0)):
        return False
    if not all(type(each) in (str, int, float) for each in error.values()):
        return False
    try:
        sentence({"seconds": 0.0, "megabytes": 0, **error}, lambda text, context="": text)
    except (AttributeError, LookupError, TypeError, ValueError):
        return False
    return True


def _is_line(value: object) -> bool:
    return type(value) is int and 0 <= value < MOST_LINES
