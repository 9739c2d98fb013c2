"""Three turns: about the object, about the world, about the view

T places the house in the world, and V takes the world to the camera: a point P is seen at V T P.
The same rotation R can stand in three places. Next to P it turns the house about itself; between
V and T about an axis of the world; in front of all it turns what the camera sees, with the world
and its axes. A rotation acts about the axis of the frame that is made by what is to its left.

Keys: Left and Right change the angle; Space turns about the y axis instead of z.
"""
# topic: cameras
# needs: frames
# picture: frame 0
# keys: LEFT RIGHT SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

angle = 30  # degrees
axis = (0, 0, 1)
# The column and the row of each picture, where R stands in its product, and the product.
PICTURES = (
    (0, 1, "nowhere", "V T P"),
    (1, 1, "object", "V T R P"),
    (0, 0, "camera", "R V T P"),
    (1, 0, "world", "V R T P"),
)
AXES = (("x", (2.9, 0, 0)), ("y", (0, 1.9, 0)), ("z", (0, 0, 1.6)))
GABLE = ((-0.5, -0.4), (0.5, -0.4), (0.5, 0.3), (0, 0.8), (-0.5, 0.3))
HOUSE_COLORS = (
    (0.55, 0.36, 0.2),
    (0.75, 0.5, 0.28),
    (0.85, 0.35, 0.2),
    (0.7, 0.28, 0.16),
    (0.55, 0.36, 0.2),
)
LABELS = {
    "nowhere": "not turned",
    "object": "in its own frame",
    "camera": "in the camera's frame",
    "world": "in the world's frame",
}


def set_product(place):
    """Set the modelview matrix with which the world is drawn."""
    glLoadIdentity()
    if place == "camera":
        glRotatef(angle, *axis)
    glTranslatef(-0.8, -0.5, -8)  # the inverse of placing the camera
    glRotatef(22, 1, 0, 0)
    glRotatef(-28, 0, 1, 0)


def go_to_house(place):
    if place == "world":
        glRotatef(angle, *axis)
    glTranslatef(1.9, 0, 0)
    if place == "object":
        glRotatef(angle, *axis)


def draw_world():
    """Draw the axes, and a floor on which the house stands."""
    glBegin(GL_LINES)
    for _name, tip in AXES:
        glColor3f(*(0.45 + 0.5 * (value > 0) for value in tip))
        glVertex3f(0, 0, 0)
        glVertex3f(*tip)

    glColor3f(0.26, 0.31, 0.38)
    for n in range(-2, 7):
        for x, z in ((n / 2, -1), (n / 2, 1.5)):
            glVertex3f(x, -0.4, z)
        for x in (-1, 3):
            glVertex3f(x, -0.4, min(n, 3) / 2)
    glEnd()
    for name, tip in AXES:
        write(3, 0, "{name}", at=tip, name=name)


def draw_house():
    """Draw a house around its own origin, 1 wide and deep, with a roof along z."""
    for z in (-0.5, 0.5):  # the two gables
        glColor3f(0.95, 0.62, 0.35)
        glBegin(GL_POLYGON)
        for x, y in GABLE:
            glVertex3f(x, y, z)
        glEnd()

    # From each side of the gable to the next: floor, wall, two sides of the roof, wall.
    glBegin(GL_QUADS)
    for number, color in enumerate(HOUSE_COLORS):
        x0, y0 = GABLE[number]
        x1, y1 = GABLE[(number + 1) % 5]
        glColor3f(*color)
        for x, y, z in ((x0, y0, 0.5), (x0, y0, -0.5), (x1, y1, -0.5), (x1, y1, 0.5)):
            glVertex3f(x, y, z)
    glEnd()


def draw(width, height):
    scale = height // 480 or height / 480  # of the pixels that write counts in
    glLineWidth(height / 240)
    for column, row, place, product in PICTURES:
        glViewport(column * width // 2, row * height // 2, width // 2, height // 2)
        glMatrixMode(GL_PROJECTION)
        glLoadIdentity()
        glOrtho(-2.2 * width / height, 2.2 * width / height, -2.2, 2.2, 1, 20)
        glMatrixMode(GL_MODELVIEW)
        set_product(place)
        draw_world()
        go_to_house(place)
        draw_house()
        write(16, height / 2 / scale - 28, "{product}", (0.95, 0.62, 0.35), product=product)
        write(16, 8, LABELS[place])

    glViewport(0, 0, width, height)
    name = "y" if axis[1] else "z"
    write(
        width / scale - 96,
        height / scale - 28,
        "R: {angle}°, {axis}",
        (0.6, 0.65, 0.7),
        angle=angle,
        axis=name,
    )


def on_key(window, key, scancode, action, mods):
    global angle, axis
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        angle -= 10
    elif key == glfw.KEY_RIGHT:
        angle += 10
    elif key == glfw.KEY_SPACE:
        axis = (0, 1, 0) if axis == (0, 0, 1) else (0, 0, 1)
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Three turns"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glEnable(GL_DEPTH_TEST)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        draw(*glfw.get_framebuffer_size(window))
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
