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

import glfw
import numpy as np
from OpenGL.GL import *
from text import _, write

LABELS = "Bresenham: the error term", "round(mx + b): hundredths of a pixel beside the line"
SIDE, COLUMNS, ROWS = 32, 20, 15  # a pixel of the small screen is a square of SIDE
SLATE, CREAM, AMBER = np.array(((33, 41, 54), (245, 232, 205), (242, 158, 70)))
CORAL, TEAL = np.array(((205, 82, 52), (58, 140, 140)))
end = [17, 9]
rounding = False
swapping = True
numbers, picture = [], None  # the numbers with the column and row of their pixels


def bresenham(x0, y0, x1, y1, swap):
    """Return column, row and error term of each pixel of a line."""
    dx, dy = abs(x1 - x0), abs(y1 - y0)
    if dy > dx and swap:
        return [(x, y, error) for y, x, error in bresenham(y0, x0, y1, x1, swap)]
    step_x, step_y = (1 if x1 > x0 else -1), (1 if y1 > y0 else -1)
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
    points = [(x, slope * (x - x0) + y0) for x in range(min(x0, x1), max(x0, x1) + 1)]
    return [(x, round(y), round(100 * (y - round(y)))) for x, y in points]


def draw():
    """Set the picture: the pixels, large, and the lines themselves, thin."""
    global picture
    numbers.clear()
    screen = np.full((ROWS, COLUMNS, 3), SLATE)
    lines = ((1, 3, 6, 12), TEAL), ((1, 1, *end), CORAL)
    for line, color in lines:
        right = [pixel[:2] for pixel in bresenham(*line, True)]
        for column, row in right:
            screen[row, column] = (SLATE + color) // 3
        for column, row, number in (rounded if rounding else bresenham)(*line, swapping):
            screen[row, column] = color if (column, row) in right else AMBER
            numbers.append((column, row, number))

    picture = screen.repeat(SIDE, 0).repeat(SIDE, 1)
    picture[::SIDE] = picture[:, ::SIDE] = 0.7 * SLATE
    places = np.stack(np.meshgrid(np.arange(COLUMNS * SIDE), np.arange(ROWS * SIDE)), 2) + 0.5
    for line, _color in lines:
        start, way = SIDE * (np.array(line[:2]) + 0.5), SIDE * np.subtract(line[2:], line[:2])
        part = np.clip((places - start) @ way / max(1, way @ way), 0, 1)[..., None]
        cover = 1.5 - np.linalg.norm(places - start - part * way, axis=2, keepdims=True)
        picture = np.uint8(picture + np.clip(cover, 0, 1) * (CREAM - picture))


def on_key(window, key, scancode, action, mods):
    global rounding, swapping
    if action != glfw.RELEASE:
        end[0] = min(19, max(0, end[0] + (key == glfw.KEY_RIGHT) - (key == glfw.KEY_LEFT)))
        end[1] = min(14, max(0, end[1] + (key == glfw.KEY_DOWN) - (key == glfw.KEY_UP)))
        rounding ^= key == glfw.KEY_F
        swapping ^= key == glfw.KEY_S
        glfw.set_window_should_close(window, key == glfw.KEY_ESCAPE)
        draw()


def main():
    glfw.init()
    window = glfw.create_window(640, 480, _("Bresenham's line"), None, None)
    glfw.make_context_current(window)
    glfw.set_key_callback(window, on_key)
    glClearColor(0.13, 0.16, 0.21, 1)
    glEnable(GL_TEXTURE_2D)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 1024, 512, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR)
    draw()
    while not glfw.window_should_close(window):
        width, height = glfw.get_framebuffer_size(window)
        wide, high = np.array((COLUMNS, ROWS)) * max(1, min(width // COLUMNS, height // ROWS))
        glViewport((width - wide) // 2, (height - high) // 2, wide, high)
        glClear(GL_COLOR_BUFFER_BIT)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 640, 480, GL_RGB, GL_UNSIGNED_BYTE, picture)
        glBegin(GL_QUADS)
        for x, y in (0, 0), (1, 0), (1, 1), (0, 1):
            glTexCoord2f(x * 640 / 1024, (1 - y) * 480 / 512)  # the first row is the top
            glVertex2f(2 * x - 1, 2 * y - 1)
        glEnd()
        for column, row, number in numbers:
            middle = (2 * column + 1) / COLUMNS - 1, 1 - (2 * row + 1) / ROWS, 0
            write(-5 * len(str(number)), -10, "{number}", at=middle, number=number)
        write(16, 40, LABELS[rounding])
        write(16, 16, "steep: x and y swapped" if swapping else "steep: x and y not swapped")
        glfw.swap_buffers(window)
        glfw.poll_events()

    glfw.terminate()


if __name__ == "__main__":
    main()
