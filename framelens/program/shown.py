"""A frame as a window on a screen would show it, where that differs from the program's drawing.

A program that is run to a frame draws into a hidden window, and its picture is read before it is
shown. So a frame that is never shown looks like one that is; these lines say the difference.
"""

from collections.abc import Iterator, Sequence

from framelens.gl.seam import Call, GluCall
from framelens.program.program_run import Window
from framelens.spec import spec

FRONT = {0x0400, 0x0401, 0x0404}  # GL_FRONT_LEFT, GL_FRONT_RIGHT, GL_FRONT


def shown_otherwise(window: Window, calls: Sequence[Call], begin: int) -> Iterator[str]:
    """Yield lines about a frame that a window would not show as it was drawn.

    ``calls`` are those of the setup and of the frame, which begins with ``calls[begin]``.
    """
    showing, doubled = window.showing, window.double_buffered
    drew = any(spec.draws(call.name) for call in calls[begin:])
    if showing.way == "never":
        yield (
            "draws, asks for events, and never swaps the buffers: the window stays as it was, "
            "whatever the picture here shows"
        )
    elif showing.way == "callback" and doubled:
        yield (
            "the display callback returns without glutSwapBuffers: the window, which has two "
            "buffers, shows nothing of this picture"
        )
    elif showing.way == "callback" and drew and not showing.flushed:
        yield (
            "the display callback returns without glFlush: with a single buffer the window may "
            "show nothing of this picture"
        )

    if showing.way == "swap" and doubled and (line := front_line(calls)):
        yield (
            f"line {line}: draws to the front buffer, which the swap then replaces: "
            "the window shows the back buffer, not this picture"
        )

    if showing.forced and showing.stirred:
        yield (
            "nothing asks for this redraw (glutPostRedisplay), though callbacks were called: "
            "a window goes on to show the frame before"
        )

    if showing.again and showing.way == "swap" and not drew:
        yield (
            f"line {showing.line}: swaps once more without drawing in between: the window shows "
            "the other buffer, not the picture that was drawn"
        )


def without_effect(notes: Sequence[GluCall]) -> Iterator[str]:
    """Yield lines about calls of GLU that make none of OpenGL, as others of the same name do."""
    for note in notes:
        if note.name in MATRICES and note.begin == note.end:
            values = ", ".join(
                f"{value:g}" for value in note.args if isinstance(value, (int, float))
            )
            why = ": the aspect is 0" if note.name == "gluPerspective" and not note.args[1] else ""
            yield f"line {note.site.line}: {note.name}({values}) has no effect{why}"


MATRICES = ("gluPerspective", "gluPickMatrix")


def front_line(calls: Sequence[Call]) -> int:
    """Return the line that lets the frame draw to the front buffer alone, 0 if none."""
    line = 0
    for call in calls:
        if call.name == "glDrawBuffer":
            line = call.site.line if int(call.args[0]) in FRONT else 0
    return line
