"""The filters by one function; the levels made by numpy, each a mean of four."""
# exercise: texture_filters
# the rest: start.py


def set_filters(smaller, larger):
    for name, value in ((GL_TEXTURE_MIN_FILTER, smaller), (GL_TEXTURE_MAG_FILTER, larger)):
        glTexParameterf(GL_TEXTURE_2D, name, value)


def make_sign():
    glBindTexture(GL_TEXTURE_2D, SIGN)
    colors = {"#": (40, 60, 70), ".": (242, 170, 80)}
    texels = [[colors[letter] for letter in row] for row in ARROW]
    load(np.array(texels, np.uint8))
    set_filters(GL_NEAREST, GL_NEAREST)


def make_window():
    glBindTexture(GL_TEXTURE_2D, WINDOW)
    top = ((60, 110, 190), (120, 150, 210))
    bottom = ((250, 210, 150), (230, 110, 60))
    load(np.array((top, bottom), np.uint8))
    set_filters(GL_LINEAR, GL_LINEAR)


def make_floor():
    glBindTexture(GL_TEXTURE_2D, FLOOR)
    image = np.zeros((32, 32, 3), np.uint8)
    image[:] = 70, 130, 130
    image[:16, :16] = 240, 230, 205
    image[16:, 16:] = 240, 230, 205
    load(image)
    level = 0
    while len(image) > 1:
        level += 1
        size = len(image) // 2
        image = image.reshape(size, 2, size, 2, 3).mean(axis=(1, 3)).astype(np.uint8)
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGB, size, size, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
    set_filters(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR)
