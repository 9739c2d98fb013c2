"""A picture made larger by numpy, one without further levels, and glGenerateMipmap."""
# exercise: texture_filters
# the rest: start.py


def make_sign():
    glBindTexture(GL_TEXTURE_2D, SIGN)
    colors = {"#": (40, 60, 70), ".": (242, 170, 80)}
    load(
        np.array([[colors[letter] for letter in row] for row in ARROW], np.uint8)
        .repeat(64, axis=0)
        .repeat(64, axis=1)
    )
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)


def make_window():
    glBindTexture(GL_TEXTURE_2D, WINDOW)
    top = ((60, 110, 190), (120, 150, 210))
    bottom = ((250, 210, 150), (230, 110, 60))
    load(np.array((top, bottom), np.uint8))
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0)  # one level is all of them
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR)


def make_floor():
    glBindTexture(GL_TEXTURE_2D, FLOOR)
    image = np.zeros((32, 32, 3), np.uint8)
    image[:] = 70, 130, 130
    image[:16, :16] = 240, 230, 205
    image[16:, 16:] = 240, 230, 205
    load(image)
    glGenerateMipmap(GL_TEXTURE_2D)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
    glHint(GL_GENERATE_MIPMAP_HINT, GL_NICEST)
