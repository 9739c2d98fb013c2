"""Stroke text: letters made of lines

A letter can be a drawing of lines, as in GLUT's stroke fonts. Each one is given here as strokes
over a grid of 3 by 5 points, and compiled into a display list, which moves on by a width at its
end. So a text goes through all transformations as any shape does: it is scaled, turned and seen in
perspective, as wide as glLineWidth says, and it may be dashed. Letters from a texture stay sharp at
one size alone.

Keys: Up and Down roll the text; Left and Right change the width of the lines; Space dashes them.
"""
# topic: textures
# needs: text, display_list, lines
# picture: frame 75
# loop: 360 frames
# keys: UP DOWN LEFT RIGHT SPACE

import sys

import glfw
from OpenGL.GL import *
from OpenGL.GLU import gluPerspective
from text import _, write

# The strokes of a letter, separated by spaces; each is a line over points of a grid: ABC the top of
# the letter, DEF, GHI, JKL, MNO its base line
STROKES = {
    " ": "",
    "A": "MDBFO GI",
    "B": "MABFHLNM GH",
    "C": "CBDJNO",
    "D": "MABFLNM",
    "E": "CAMO GH",
    "F": "CAM GH",
    "G": "CBDJNLIH",
    "H": "AM CO GI",
    "I": "AC BN MO",
    "J": "CLNJ",
    "K": "AM CGO",
    "L": "AMO",
    "M": "MAHCO",
    "N": "MAOC",
    "O": "BDJNLFB",
    "P": "MABFHG",
    "Q": "BDJNLFB KO",
    "R": "MABFHG HO",
    "S": "CBDHLNM",
    "T": "AC BN",
    "U": "AJNLC",
    "V": "ANC",
    "W": "AMHOC",
    "X": "AO CM",
    "Y": "AHC HN",
    "Z": "ACMO",
}
POINTS = {chr(65 + n): (n % 3, 4 - n // 3) for n in range(15)}
WIDTH = 3.2  # from one letter to the next, in the units of the grid
LABELS = (
    "GLUT HAS A FONT",
    "MADE OF STROKES",
    "EACH LETTER IS A",
    "DISPLAY LIST THAT",
    "MOVES THE ORIGIN",
    "SO A TEXT CAN BE",
    "SCALED AND TURNED",
    "LIKE ANY SHAPE",
)
lists = 0  # the display list of the character with code 0
rolled = 0
width = 2
dashed = False


def make_letters():
    global lists
    lists = glGenLists(128)
    for letter, strokes in STROKES.items():
        glNewList(lists + ord(letter), GL_COMPILE)
        for stroke in strokes.split():
            glBegin(GL_LINE_STRIP)
            for point in stroke:
                glVertex2f(*POINTS[point])
            glEnd()
        glTranslatef(WIDTH, 0, 0)
        glEndList()


def draw_text(text):
    """Draw a line of text from the origin, as glutStrokeCharacter does letter by letter."""
    glPushMatrix()
    glListBase(lists)
    glCallLists(text.encode())
    glPopMatrix()


def draw(wide, high):
    glViewport(0, 0, wide, high)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(50, wide / high, 1, 500)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -17, -58)
    glRotatef(-55, 1, 0, 0)  # the sheet leans back
    glTranslatef(0, 24 + 3 * (glfw.get_time() % 12) + rolled, 0)
    glLineWidth(width * high / 480)
    if dashed:
        glEnable(GL_LINE_STIPPLE)
    glLineStipple(max(1, round(high / 240)), 0x0FFF)

    for number, text in enumerate(map(_, LABELS)):
        glPushMatrix()
        glTranslatef(-WIDTH * len(text) / 2, -8 * number, 0)
        glColor3f(0.95, 0.82 - 0.06 * number, 0.6 - 0.06 * number)
        draw_text(text)
        glPopMatrix()

    glDisable(GL_LINE_STIPPLE)
    top = high / (high // 480 or high / 480)  # as write counts
    write(16, top - 30, "lines of {width} pixels", (0.6, 0.65, 0.7), width=width)


def on_key(window, key, scancode, action, mods):
    global dashed, rolled, width
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_DOWN:
        rolled -= 2
    elif key == glfw.KEY_UP:
        rolled += 2
    elif key == glfw.KEY_LEFT:
        width = max(1, width - 1)
    elif key == glfw.KEY_RIGHT:
        width = min(8, width + 1)
    elif key == glfw.KEY_SPACE:
        dashed = not dashed
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Stroke text"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    make_letters()

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
