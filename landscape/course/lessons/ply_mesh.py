"""PLY meshes: a rabbit read from a file, and a texture around it

An ASCII PLY file has a header, a line for each vertex and a line for each face. A vertex takes the
normalized sum of its faces' normals. The file has no texture coordinates: they come from x, y, z.
A plane stretches the texture where the surface turns away from it; cylinder and sphere pinch it
where their axis leaves the rabbit. At their seam the angle jumps from pi to -pi: its absolute value
hides that, and without it the whole texture runs backwards through one strip.

Keys: 1 plane, 2 cylinder, 3 sphere; Space leaves out the absolute value; Left and Right turn;
F draws the triangles over it.
"""
# topic: landscape
# needs: normals, vertex_arrays, textured_sphere
# picture: frame 0
# keys: 1 3 SPACE LEFT RIGHT F

import sys
from pathlib import Path

import glfw
import numpy as np
from OpenGL.GL import *
from PIL import Image
from text import _, write

LABELS = "plane: s = x, t = y", "cylinder: s = {angle}, t = y", "sphere: s = {angle}, t = latitude"
PLANE, CYLINDER, SPHERE = range(3)
mapping = CYLINDER
absolute = True
turn = 50
meshed = False  # the triangles are drawn as lines, too


def read_ply(path):
    """Return the vertices (n, 3) and the triangles (m, 3) of an ASCII PLY file."""
    header, body = path.read_text().split("end_header\n")
    elements = [line.split() for line in header.splitlines() if line.startswith("element")]
    count = int(elements[0][2])  # "element vertex 752"
    rows = [row.split() for row in body.splitlines()]
    vertices = np.array(rows[:count], np.float32)
    faces = np.array(rows[count:], np.uint32)  # each row: 3, and the numbers of 3 vertices
    return vertices, faces[:, 1:].copy()


def sum_normals(vertices, faces):
    """Return the unit normal of each vertex: larger faces count more."""
    a = vertices[faces[:, 0]]
    b = vertices[faces[:, 1]]
    c = vertices[faces[:, 2]]
    normals = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normals, faces[:, corner], np.cross(b - a, c - a))
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def map_texture(vertices):
    """Return texture coordinates (n, 2) by the chosen mapping."""
    x, y, z = vertices.T
    angle = np.arctan2(z, x) / np.pi  # from -1 to 1
    latitude = 2 * np.arctan2(y, np.hypot(x, z)) / np.pi
    if absolute:
        angle = abs(angle)
    if mapping == PLANE:
        mapped = x, y
    elif mapping == CYLINDER:
        mapped = angle, y
    else:
        mapped = angle, latitude
    return 4 * np.stack(mapped, axis=1).astype(np.float32)


def make_texture():
    """Make a texture of two by two checks."""
    image = Image.new("RGB", (128, 128), (242, 230, 204))
    for corner in (0, 64):
        image.paste((217, 89, 51), (corner, corner, corner + 64, corner + 64))
    glBindTexture(GL_TEXTURE_2D, glGenTextures(1))
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
    data = GL_RGB, GL_UNSIGNED_BYTE, image.tobytes()
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, *image.size, 0, *data)


def draw_lines(faces):
    """Draw the triangles as lines, slightly nearer than the faces, in one colour."""
    glPushAttrib(GL_ENABLE_BIT | GL_POLYGON_BIT)
    glDisable(GL_LIGHTING)
    glDisable(GL_TEXTURE_2D)
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE)
    glEnable(GL_POLYGON_OFFSET_LINE)
    glPolygonOffset(-1, -1)
    glColor3f(0.1, 0.3, 0.4)
    glDrawElements(GL_TRIANGLES, faces.size, GL_UNSIGNED_INT, faces)
    glPopAttrib()


def look(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 1, 50)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, 0.1, -5)
    glRotatef(15, 1, 0, 0)
    glRotatef(turn + 20 * glfw.get_time(), 0, 1, 0)


def on_key(window, key, scancode, action, mods):
    global mapping, absolute, meshed, turn
    if action == glfw.RELEASE:
        return
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        mapping = key - glfw.KEY_1
    elif key == glfw.KEY_SPACE:
        absolute = not absolute
    elif key == glfw.KEY_F:
        meshed = not meshed
    elif key == glfw.KEY_LEFT:
        turn -= 15
    elif key == glfw.KEY_RIGHT:
        turn += 15
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("PLY meshes"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    vertices, faces = read_ply(Path(__file__).parent / "data" / "rabbit.ply")
    normals = sum_normals(vertices, faces)
    make_texture()
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_TEXTURE_2D):
        glEnable(capability)
    for array in (GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_TEXTURE_COORD_ARRAY):
        glEnableClientState(array)
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (0.9, 0.9, 0.9, 1))
    glClearColor(0.13, 0.16, 0.21, 1)

    while not glfw.window_should_close(window):
        look(*glfw.get_framebuffer_size(window))
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
        glVertexPointer(3, GL_FLOAT, 0, vertices)
        glNormalPointer(GL_FLOAT, 0, normals)
        glTexCoordPointer(2, GL_FLOAT, 0, map_texture(vertices))
        glDrawElements(GL_TRIANGLES, faces.size, GL_UNSIGNED_INT, faces)
        if meshed:
            draw_lines(faces)

        write(16, 40, "faces: {count}", count=len(faces))
        write(16, 16, LABELS[mapping], angle="|angle|" if absolute else "angle")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
