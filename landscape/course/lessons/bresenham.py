"""Bresenham's line: whole numbers and an error term

The pixels of a line, drawn large; the number in each is the error term, a whole number that says
when to go one row further. Rounding y = mx + b chooses the same pixels, except halfway between two:
Python's round() goes to the even one, so that a line of slope 1/2 has uneven steps. A steep line
needs x and y swapped, or it has one pixel a column: it misses its end, or falls apart.

Keys: arrows move the end of the coral line; F rounds y = mx + b instead, S leaves out the swap.
"""
# topic: flyover
# needs: projection_by_hand
# picture: frame 1
# keys: LEFT RIGHT UP DOWN F S

import sys

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "Bresenham: the error term", "round(mx + b): hundredths of a pixel beside the line"
SIDE = 32  # a pixel of the small screen is a square of so many real ones
COLUMNS = 20
ROWS = 15
SLATE, CREAM, AMBER = np.array(((33, 41, 54), (245, 232, 205), (242, 158, 70)))
CORAL, TEAL = np.array(((205, 82, 52), (58, 140, 140)))

end = [17, 9]  # of the coral line
rounding = False
swapping = True


def bresenham(x0, y0, x1, y1, swap):
    """Return column, row and error term of each pixel of a line."""
    dx = abs(x1 - x0)
    dy = abs(y1 - y0)
    if dy > dx and swap:
        return [(x, y, error) for y, x, error in bresenham(y0, x0, y1, x1, swap)]

    step_x = 1 if x1 > x0 else -1
    step_y = 1 if y1 > y0 else -1
    y = y0
    error = 2 * dy - dx
    pixels = []
    for x in range(x0, x1 + step_x, step_x):
        pixels.append((x, y, error))
        if error >= 0:  # in the next column the line is halfway to the next row, or beyond
            y += step_y
            error -= 2 * dx
        error += 2 * dy
    return pixels


def rounded(x0, y0, x1, y1, swap):
    """Return column and row, and how far the line is from the pixel's middle, in hundredths."""
    if abs(y1 - y0) > abs(x1 - x0) and swap:
        return [(x, y, beside) for y, x, beside in rounded(y0, x0, y1, x1, swap)]

    slope = (y1 - y0) / (x1 - x0) if x1 != x0 else 0  # of a vertical line there is none
    pixels = []
    for x in range(min(x0, x1), max(x0, x1) + 1):
        y = slope * (x - x0) + y0
        pixels.append((x, round(y), round(100 * (y - round(y)))))
    return pixels


def the_lines():
    """Return the two lines, each with its colour."""
    return ((1, 3, 6, 12), TEAL), ((1, 1, *end), CORAL)


def set_pixels():
    """Return the small screen (ROWS, COLUMNS, 3), and column, row and number of each pixel.

    A pixel that Bresenham's line has not is amber; one that it has and the other not is dark.
    """
    screen = np.full((ROWS, COLUMNS, 3), SLATE)
    numbers = []
    for line, color in the_lines():
        right = [(column, row) for column, row, _error in bresenham(*line, True)]
        for column, row in right:
            screen[row, column] = (SLATE + color) // 3

        algorithm = rounded if rounding else bresenham
        for column, row, number in algorithm(*line, swapping):
            screen[row, column] = color if (column, row) in right else AMBER
            numbers.append((column, row, number))
    return screen, numbers


def enlarge(screen):
    """Return the picture: each pixel of the small screen a square, with gaps between them."""
    picture = screen.repeat(SIDE, 0).repeat(SIDE, 1)
    picture[::SIDE] = 0.7 * SLATE
    picture[:, ::SIDE] = 0.7 * SLATE
    return picture


def draw_thin(picture, line):
    """Return the picture with a line on it, 3 pixels wide and with soft edges."""
    columns, rows = np.meshgrid(np.arange(COLUMNS * SIDE), np.arange(ROWS * SIDE))
    places = np.stack((columns, rows), 2) + 0.5
    start = SIDE * (np.array(line[:2]) + 0.5)
    way = SIDE * np.subtract(line[2:], line[:2])

    # How much of each pixel is covered follows from its distance to the nearest point of the line.
    part = np.clip((places - start) @ way / max(1, way @ way), 0, 1)[..., np.newaxis]
    distance = np.linalg.norm(places - start - part * way, axis=2, keepdims=True)
    cover = np.clip(1.5 - distance, 0, 1)
    return np.uint8(picture + cover * (CREAM - picture))


def draw():
    """Return the picture, and the numbers with the column and row of their pixels."""
    screen, numbers = set_pixels()
    picture = enlarge(screen)
    for line, _color in the_lines():
        picture = draw_thin(picture, line)
    return picture, numbers


def show(picture):
    """Load the picture into the texture, and draw it over the whole viewport."""
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 640, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
    glBegin(GL_QUADS)
    for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
        glTexCoord2f(x * 640 / 1024, (1 - y) * 480 / 512)  # the first row is the top
        glVertex2f(2 * x - 1, 2 * y - 1)
    glEnd()


def write_numbers(numbers):
    """Write each number into the middle of its pixel."""
    for column, row, number in numbers:
        middle = (2 * column + 1) / COLUMNS - 1, 1 - (2 * row + 1) / ROWS, 0
        write(-5 * len(str(number)), -10, "{number}", at=middle, number=number)


def on_key(window, key, scancode, action, mods):
    global rounding, swapping
    if action == glfw.RELEASE:
        return
    if key == glfw.KEY_LEFT:
        end[0] = max(0, end[0] - 1)
    elif key == glfw.KEY_RIGHT:
        end[0] = min(COLUMNS - 1, end[0] + 1)
    elif key == glfw.KEY_UP:
        end[1] = max(0, end[1] - 1)
    elif key == glfw.KEY_DOWN:
        end[1] = min(ROWS - 1, end[1] + 1)
    elif key == glfw.KEY_F:
        rounding = not rounding
    elif key == glfw.KEY_S:
        swapping = not swapping
    elif key == glfw.KEY_ESCAPE:
        glfw.set_window_should_close(window, True)


def main():
    if not glfw.init():
        sys.exit(_("GLFW cannot start: is there a screen?"))

    window = glfw.create_window(640, 480, _("Bresenham's line"), None, None)
    if not window:
        sys.exit(_("GLFW cannot open a window with OpenGL."))

    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1024, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    drawn = None

    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        scale = max(
            1, min(width // COLUMNS, height // ROWS)
        )  # whole, so that all squares are equal
        wide = COLUMNS * scale
        high = ROWS * scale
        glViewport((width - wide) // 2, (height - high) // 2, wide, high)
        glClear(GL_COLOR_BUFFER_BIT)

        # Computed again only when something has changed.
        if drawn != (*end, rounding, swapping):
            drawn = (*end, rounding, swapping)
            picture, numbers = draw()
        show(picture)
        write_numbers(numbers)

        write(16, 40, LABELS[rounding])
        write(16, 16, "steep: x and y swapped" if swapping else "steep: x and y not swapped")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
