"""Fresnel by a cube map: water that reflects and refracts

The scene is drawn into two textures: mirrored at the water, and as it is seen through the water.
GL_INTERPOLATE mixes them by the alpha of a cube map, which holds for each direction how much the
water reflects: 2 % straight down, all when grazing. Its coordinates are the vertex minus the eye;
without the eye, they begin in the middle of the scene.

Keys: 1 to 5 choose: the reflection, the refraction, the alpha, the mix without the eye, the mix.
"""
# topic: voxels
# needs: mirror, water, cube_map, texture_units, projective_texture
# picture: frame 60
# loop: 360 frames
# keys: 1 2 3 4

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

AIR, SAND, GRASS, RED, WHITE = range(5)
COLORS = np.array(((0, 0, 0), (235, 212, 158), (124, 172, 78), (214, 98, 62), (250,) * 3)) / 255
SHADES = ((0.62, 0.85), (0.72, 1), (0.75, 0.7))  # of the two faces across x, y and z
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
MIDDLE = (17, 7.8, 17)  # of the scene, on the water: the origin of all vertices
SEA = 7  # the highest block under water
WATER = np.array((0.8, 0.93, 0.95))  # what a block's depth of water leaves of light
DEEP = (0.05, 0.28, 0.36, 1)
SKY = (0.62, 0.79, 0.92, 1)

# What each texture unit holds.
REFLECTION = GL_TEXTURE0
REFRACTION = GL_TEXTURE1
FRESNEL = GL_TEXTURE2
TARGETS = {REFLECTION: GL_TEXTURE_2D, REFRACTION: GL_TEXTURE_2D, FRESNEL: GL_TEXTURE_CUBE_MAP}

ONLY_REFLECTION, ONLY_REFRACTION, ONLY_ALPHA, WITHOUT_EYE, MIX = range(5)
LABELS = "reflection", "refraction", "alpha", "mix without the eye", "mix"
chosen = MIX


def build_islands():
    """Return the kind of block at each place, [x, y, z]: islands with a lighthouse."""
    blocks = np.full((34, 22, 34), AIR)
    for x, z in np.ndindex(32, 32):
        wave = np.sin(0.42 * x + 0.3) * np.cos(0.36 * z) + 0.5 * np.sin(0.8 * z + 0.5 * x)
        top = int(np.clip(5.5 + 3.8 * wave - 0.012 * ((x - 16) ** 2 + (z - 16) ** 2), 1, 20))
        blocks[x + 1, 1:top, z + 1] = SAND
        blocks[x + 1, top, z + 1] = GRASS if top > SEA else SAND

    blocks[17:20, 1:15, 12:15] = WHITE
    blocks[17:20, 8:15:2, 12:15] = RED  # rings
    return blocks


def make_mesh(blocks):
    """Return the vertices of all faces beside air, and last of the water: colour and place."""
    vertices = []
    for axis, side in np.ndindex(3, 2):
        corners = [np.roll((side, s, t), axis) - MIDDLE for s, t in SQUARE]
        beside = np.roll(blocks, 1 - 2 * side, axis)  # the neighbour of each block
        for place in np.argwhere((blocks != AIR) & (beside == AIR)):
            depth = max(SEA - place[1], 0)
            color = COLORS[blocks[tuple(place)]] * SHADES[axis][side] * WATER**depth
            for corner in corners:
                vertices.append((*color, *(place + corner)))

    for s, t in SQUARE:  # the water, out to the horizon
        vertices.append((1, 1, 1, 16000 * s - 8000, 0, 16000 * t - 8000))
    return np.array(vertices, np.float32)


def make_textures():
    for unit, target in TARGETS.items():
        glActiveTexture(unit)
        glBindTexture(target, glGenTextures(1))
        glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
        for name in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):
            glTexParameteri(target, name, GL_CLAMP_TO_EDGE)
    make_cube_map()


def make_cube_map():
    """Load for each direction how much the water reflects, by Schlick's formula."""
    t, s = np.mgrid[-1:1:512j, -1:1:512j]
    for face in range(6):
        # Of a direction on a face, the largest part is 1; only across y is this the vertical part.
        vertical = 1 if face in (2, 3) else t
        cosine = np.abs(vertical) / np.sqrt(1 + s * s + t * t)
        alpha = np.uint8(5 + 250 * (1 - cosine) ** 5)  # 5 is 2 % of 255
        glTexImage2D(
            GL_TEXTURE_CUBE_MAP_POSITIVE_X + face,
            0,
            GL_ALPHA8,
            512,
            512,
            0,
            GL_ALPHA,
            GL_UNSIGNED_BYTE,
            alpha,
        )


def set_combiner():
    """Let unit 2 mix the textures of the units before it; its own alpha says how much of each."""
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE)
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, REFRACTION)
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE2_RGB, FRESNEL)


def look(width, height):
    for mode in (GL_MODELVIEW, GL_PROJECTION):
        glMatrixMode(mode)
        glLoadIdentity()
    glFrustum(-width / height / 4, width / height / 4, -0.25, 0.25, 0.7, 12000)
    glMatrixMode(GL_MODELVIEW)
    glTranslatef(0, -1.8, -27)
    glRotatef(11, 1, 0, 0)
    glRotatef(20 * np.sin(np.pi / 3 * glfw.get_time()), 0, 1, 0)


def draw_blocks(count, size, scale, side, background):
    """Draw the blocks above the water, side 1, or below it, -1; ``scale`` is that of heights."""
    glViewport(0, 0, *size)
    glClearColor(*background)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glPushMatrix()
    glScalef(1, scale, 1)
    glClipPlane(GL_CLIP_PLANE0, (0, side, 0, 0))
    glEnable(GL_CLIP_PLANE0)
    glDrawArrays(GL_QUADS, 0, count)
    glDisable(GL_CLIP_PLANE0)
    glPopMatrix()


def copy_to(unit, size):
    """Copy what has been drawn to the texture of a unit."""
    glActiveTexture(unit)
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, *size, 0)


def power_of_two(pixels):
    """Return the largest power of two that is not larger: the side of a texture that fits."""
    return 2 ** int(np.log2(pixels))


def generate_coordinates():
    """Let each unit find a point of the water in its texture."""
    camera = glGetFloatv(GL_MODELVIEW_MATRIX)

    # In both pictures where the point is on the screen: from -1 to 1 there, 0 to 1 in a texture.
    screen = (camera @ glGetFloatv(GL_PROJECTION_MATRIX)).T
    screen_planes = (screen + screen[3]) / 2
    generate(REFLECTION, screen_planes)
    generate(REFRACTION, screen_planes)

    # In the cube map by the direction from the eye: the vertex minus the eye.
    direction_planes = np.eye(4)
    if chosen != WITHOUT_EYE:
        eye = np.linalg.inv(camera)[3, :3]
        direction_planes[:3, 3] = -eye
    generate(FRESNEL, direction_planes)


def generate(unit, planes):
    glActiveTexture(unit)
    glEnable(TARGETS[unit])
    for row in range(4):
        glTexGeni(GL_S + row, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR)
        glTexGenfv(GL_S + row, GL_OBJECT_PLANE, planes[row])
        glEnable(GL_TEXTURE_GEN_S + row)


def choose_mix():
    """Show one of the three textures, or the mix of two by the third."""
    shown = {ONLY_REFRACTION: REFRACTION, ONLY_ALPHA: FRESNEL}.get(chosen, REFLECTION)
    mixed = chosen in (WITHOUT_EYE, MIX)
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE if mixed else GL_REPLACE)
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, shown)
    operand = GL_SRC_ALPHA if chosen == ONLY_ALPHA else GL_SRC_COLOR
    glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_RGB, operand)


def draw_water(first):
    glPushAttrib(GL_ENABLE_BIT)
    generate_coordinates()
    choose_mix()
    glDrawArrays(GL_QUADS, first, 4)
    glActiveTexture(GL_TEXTURE0)
    glPopAttrib()


def on_key(window, key, scancode, action, mods):
    global chosen
    if glfw.KEY_1 <= key < glfw.KEY_1 + len(LABELS):
        chosen = key - glfw.KEY_1
    if key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Fresnel by a cube map"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    if glGetIntegerv(GL_MAX_TEXTURE_UNITS) < 3:
        sys.exit(_("This lesson needs three texture units."))

    vertices = make_mesh(build_islands())
    count = len(vertices) - 4  # without the water
    glInterleavedArrays(GL_C3F_V3F, 0, vertices)
    glEnable(GL_DEPTH_TEST)
    make_textures()
    set_combiner()

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        look(width, height)

        # The two pictures: mirrored, and less deep, by the index of refraction of water, 4/3.
        size = power_of_two(width), power_of_two(height)
        draw_blocks(count, size, scale=-1, side=1, background=SKY)
        copy_to(REFLECTION, size)
        draw_blocks(count, size, scale=0.75, side=-1, background=DEEP)
        copy_to(REFRACTION, size)

        # The scene itself, and the water with both.
        draw_blocks(count, (width, height), scale=1, side=1, background=SKY)
        draw_water(first=count)
        write(16, 16, LABELS[chosen])
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
