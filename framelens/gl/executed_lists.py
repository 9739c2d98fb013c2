"""GL_COMPILE_AND_EXECUTE taken apart: the list is only compiled, and called once it is complete.

The picture is the same, and the calls that draw can be told from those that are stored. Mesa 22
needs it: it ends such a list with GL_INVALID_OPERATION where a vertex is the first of the list that
has a colour of its own, for instance, and others come before it.
"""

from collections.abc import Callable

from OpenGL.GL import GL_COMPILE, GL_COMPILE_AND_EXECUTE

Function = Callable[..., object]


def taken_apart(
    make: Callable[[str, Function], Function], call_list: Function
) -> Callable[[str, Function], Function]:
    """Return ``make`` (see foreign.py) with other replacements of glNewList and glEndList.

    ``call_list`` is OpenGL's glCallList.
    """
    due: list[int] = []  # the list that is to be called when it is complete

    def made(name: str, function: Function) -> Function:
        replaced = make(name, function)

        def begin(list: int, mode: int) -> None:
            due[:] = [list] if mode == GL_COMPILE_AND_EXECUTE else []
            replaced(list, GL_COMPILE if due else mode)

        def end() -> None:
            replaced()
            while due:
                call(due.pop())

        if name == "glNewList":
            return begin
        if name == "glEndList":
            call = make("glCallList", call_list)
            return end
        return replaced

    return made
