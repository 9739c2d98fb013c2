"""The keys of the inspector, and what is printed on the keys of the user's keyboard.

GLFW names its key codes after the US layout. A sign or a letter is looked for where the user's
keyboard prints it.
"""

from collections.abc import Callable, Collection

from framelens.gl.glfw_library import glfw

Namer = Callable[[int], str]  # from a key's code to what is printed on it

# Keys that print something: GLFW's codes are the ASCII codes of what a US keyboard prints.
PRINTING = (*map(ord, "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789',-./;=[\\]`"), glfw.KEY_WORLD_1)
SIGNS = {"+": "more", "=": "more", "-": "less"}

# The keys of the open inspector, alone, with Shift and with Control; a sign is written as the
# character itself, as in the list of keys.
INSPECTING = {
    glfw.KEY_UP: "up",
    glfw.KEY_DOWN: "down",
    glfw.KEY_LEFT: "left",
    glfw.KEY_RIGHT: "right",
    glfw.KEY_PAGE_UP: "page_up",
    glfw.KEY_PAGE_DOWN: "page_down",
    glfw.KEY_HOME: "home",
    glfw.KEY_END: "end",
    glfw.KEY_ENTER: "enter",
    glfw.KEY_KP_ENTER: "enter",
    glfw.KEY_TAB: "next_value",
    glfw.KEY_SPACE: "stop",
    glfw.KEY_DELETE: "switch",
    glfw.KEY_BACKSPACE: "undo_here",
    glfw.KEY_ESCAPE: "close",
    glfw.KEY_F1: "why",
    glfw.KEY_KP_ADD: "more",
    glfw.KEY_KP_SUBTRACT: "less",
}
INSPECTING_SHIFT = {
    "next_value": "previous_value",
    "more": "more_fine",
    "less": "less_fine",
    "why": "why_all",
}
INSPECTING_CONTROL = {
    "undo_here": "undo_all",
    "Z": "undo",
    "S": "save",
    "more": "more_fine",
    "less": "less_fine",
}
INSPECTING_LETTERS = {"O": "pixel"}
INSPECTING_REPEATED = (
    *("up", "down", "left", "right", "page_up", "page_down", "next_value", "previous_value"),
    *("more", "less", "more_fine", "less_fine", "undo"),
)


def us_name(key: int) -> str:
    """Return what a US keyboard prints on a key, "" if it prints nothing."""
    return chr(key) if key in PRINTING and key < glfw.KEY_WORLD_1 else ""


def system_name(key: int) -> str:
    """Return what the user's keyboard prints on a key; GLFW must be running."""
    printed = (glfw.get_key_name(key, 0) or us_name(key)).strip()
    # The German sharp s has two capitals.
    return printed.upper() if len(printed.upper()) == 1 else printed


def sign(key: int, name: Namer, taken: Collection[int] = ()) -> str:
    """Return "more" or "less" if a key prints + or -, else ""; keys in ``taken`` do not count.

    The plus key, or the one that prints = without Shift. On a keyboard that prints neither, their
    places on a US keyboard stand for them.
    """
    printed = {name(each): each for each in PRINTING if each not in taken}
    signs = {place: SIGNS[sign] for sign, place in printed.items() if sign in SIGNS}
    for sign in "=-":
        if SIGNS[sign] not in signs.values():
            signs.setdefault(ord(sign), SIGNS[sign])
    return signs.get(key, "")


def inspect_pick(key: int, mods: int, name: Namer) -> str:
    """Return what a key does in the open inspector, "" if nothing; ``mods`` are GLFW's bits."""
    found = INSPECTING.get(key) or sign(key, name)
    printed = name(key) if key in PRINTING else ""
    if mods & (glfw.MOD_CONTROL | glfw.MOD_SUPER):
        return INSPECTING_CONTROL.get(found or printed, "")
    if mods & glfw.MOD_SHIFT and printed != "=":  # there Shift types the plus sign
        return INSPECTING_SHIFT.get(found, found)
    return found or INSPECTING_LETTERS.get(printed, "")
