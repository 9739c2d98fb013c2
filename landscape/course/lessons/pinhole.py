"""The pinhole camera: projection by hand

A camera at O looks along z. The image of a point is where the ray from O to it meets the image
plane, at the distance f. By similar triangles, X = f x/z and Y = f y/z: a point twice as far has an
image half as large. Without the division by z the rays are parallel, and the image keeps its size
at any distance. Nothing here is projected by OpenGL: the program works out each image itself.

Keys: Left and Right move the house nearer and farther, Up and Down move it up and down; F changes
the distance f; Space makes the rays parallel.
"""
# topic: cameras
# needs: transform_order
# picture: frame 0
# keys: LEFT RIGHT UP DOWN F SPACE

import sys

import glfw
from OpenGL.GL import *
from text import _, write

HOUSE = ((0, 1), (-0.6, 0.4), (-0.6, -0.6), (0.6, -0.6), (0.6, 0.4))  # the first vertex is P
# The middle of the house, which is 0.6 to the right of the axis.
y = 0.2
z = 5.5
f = 2
parallel = False


def image(point):
    """Return the image of a point."""
    x, y, z = point
    return (x, y, f) if parallel else (f * x / z, f * y / z, f)


def draw_shape(kind, points, color):
    glColor3f(*color)
    glBegin(kind)
    for point in points:
        glVertex3f(*point)
    glEnd()


def draw():
    house = [(0.6 + right, y + up, z) for right, up in HOUSE]
    images = [image(point) for point in house]
    origins = [(x, y, 0) if parallel else (0, 0, 0) for x, y, z in house]
    plane = [(u * 1.6, v * 1.4, f) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    draw_shape(GL_LINES, ((0, 0, f), (0, 0, 8.5)), (0.35, 0.4, 0.47))
    draw_shape(GL_POLYGON, house, (0.85, 0.35, 0.2))
    for point, seen in zip(house, images, strict=True):
        draw_shape(GL_LINES, (seen, point), (0.95, 0.62, 0.35))

    # From back to front: the plane covers what is behind it, and the rays come out in front.
    draw_shape(GL_POLYGON, plane, (0.22, 0.27, 0.34))
    draw_shape(GL_LINE_LOOP, plane, (0.6, 0.65, 0.7))
    draw_shape(GL_LINES, ((0, 0, 0), (0, 0, f)), (0.35, 0.4, 0.47))
    draw_shape(GL_POLYGON, images, (0.85, 0.35, 0.2))
    for origin, seen in zip(origins, images, strict=True):
        draw_shape(GL_LINES, (origin, seen), (0.95, 0.62, 0.35))
    draw_shape(GL_POINTS, (house[0], images[0], (0, 0, 0)), (0.95, 0.9, 0.8))
    write_names(house[0], images[0])


def write_names(point, seen):
    """Write the names in the drawing, and the numbers of a point and of its image."""
    write(-18, -10, "O", at=(0, 0, 0))
    write(8, -10, "z", at=(0, 0, 8.5))
    write(8, -10, "P", at=point)
    write(8, -10, "P'", at=seen)
    write(8, -10, "f = {f}", at=(-1.6, 1.5, f), f=f)
    write(16, 64, "P: {x:.1f}, {y:.1f}, {z:.1f}", x=point[0], y=point[1], z=z)
    write(16, 40, "X = x = {X:.2f}" if parallel else "X = f x/z = {X:.2f}", X=seen[0])
    write(16, 16, "Y = y = {Y:.2f}" if parallel else "Y = f y/z = {Y:.2f}", Y=seen[1])


def on_key(window, key, scancode, action, mods):
    global y, z, f, parallel
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        z = max(4, z - 0.5)
    elif key == glfw.KEY_RIGHT:
        z = min(8, z + 0.5)
    elif key == glfw.KEY_DOWN:
        y = max(-0.8, y - 0.2)
    elif key == glfw.KEY_UP:
        y = min(0.4, y + 0.2)
    elif key == glfw.KEY_F:
        f = f % 3 + 1
    elif key == glfw.KEY_SPACE:
        parallel = not parallel
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("The pinhole camera"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        glViewport(0, 0, width, height)
        glClear(GL_COLOR_BUFFER_BIT)
        glPointSize(height / 60)
        glLineWidth(height / 320)
        glLoadIdentity()
        glScalef(0.32 * height / width, 0.32, 0.05)
        glTranslatef(-3.3, 0, 0)
        glRotatef(20, 1, 0, 0)
        glRotatef(-52, 0, 1, 0)
        glScalef(1, 1, -1)  # z forwards, as on paper; with OpenGL it points backwards
        draw()
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
