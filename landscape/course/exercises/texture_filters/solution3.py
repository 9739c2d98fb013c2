"""The filters as vectors; the levels made by gluBuild2DMipmaps."""
# exercise: texture_filters
# the rest: start.py

from OpenGL.GLU import *


def make_sign():
    glBindTexture(GL_TEXTURE_2D, SIGN)
    colors = {"#": (40, 60, 70), ".": (242, 170, 80)}
    texels = [[colors[letter] for letter in row] for row in ARROW]
    load(np.array(texels, np.uint8))
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, [GL_NEAREST])
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, [GL_NEAREST])


def make_window():
    glBindTexture(GL_TEXTURE_2D, WINDOW)
    top = ((60, 110, 190), (120, 150, 210))
    bottom = ((250, 210, 150), (230, 110, 60))
    load(np.array((top, bottom), np.uint8))
    # The larger filter is GL_LINEAR from the beginning.
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, [GL_LINEAR])


def make_floor():
    glBindTexture(GL_TEXTURE_2D, FLOOR)
    image = np.zeros((32, 32, 3), np.uint8)
    image[:] = 70, 130, 130
    image[:16, :16] = 240, 230, 205
    image[16:, 16:] = 240, 230, 205
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, 32, 32, GL_RGB, GL_UNSIGNED_BYTE, image)
