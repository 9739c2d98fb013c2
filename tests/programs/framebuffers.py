"""A window in which a program asks about its framebuffer, draws aside, and resizes."""

import glfw
from OpenGL.GL import *


def bits(name: int) -> int:
    return int(glGetIntegerv(name))


glfw.init()
window = glfw.create_window(64, 48, "framebuffers", None, None)
glfw.make_context_current(window)

assert glfw.get_framebuffer_size(window) == (64, 48)
assert list(glGetIntegerv(GL_VIEWPORT)) == [0, 0, 64, 48]
assert list(glGetIntegerv(GL_SCISSOR_BOX)) == [0, 0, 64, 48]
assert bits(GL_FRAMEBUFFER_BINDING) == bits(GL_READ_FRAMEBUFFER_BINDING) == 0
assert bits(GL_DRAW_BUFFER) == bits(GL_READ_BUFFER) == GL_BACK
assert glGetBooleanv(GL_DOUBLEBUFFER)
assert bits(GL_DEPTH_BITS) == 24 and bits(GL_STENCIL_BITS) == 8

# Aside: a texture that is drawn into, without a colour to read in between.
texture = glGenTextures(1)
glBindTexture(GL_TEXTURE_2D, texture)
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, None)
frame = glGenFramebuffers(1)
glBindFramebuffer(GL_FRAMEBUFFER, frame)
assert bits(GL_FRAMEBUFFER_BINDING) == frame
glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0)
assert glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE
assert bits(GL_DRAW_BUFFER) == GL_COLOR_ATTACHMENT0
glViewport(0, 0, 8, 8)
glClearColor(0, 1, 0, 1)
glClear(GL_COLOR_BUFFER_BIT)
glBindFramebuffer(GL_FRAMEBUFFER, 0)
assert bits(GL_FRAMEBUFFER_BINDING) == 0
glViewport(0, 0, 64, 48)

while not glfw.window_should_close(window):
    width, height = glfw.get_framebuffer_size(window)
    glViewport(0, 0, width, height)
    for side in (GL_FRONT_AND_BACK, GL_NONE, GL_BACK):
        glDrawBuffer(side)
        assert bits(GL_DRAW_BUFFER) == side
    glClearColor(1, 0, 0, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
    glEnable(GL_TEXTURE_2D)
    glBegin(GL_TRIANGLE_STRIP)
    for x, y in ((0, -1), (1, -1), (0, 1), (1, 1)):
        glTexCoord2f(x, y)
        glVertex2f(x, y)
    glEnd()
    glReadBuffer(GL_BACK)
    left = glReadPixels(width // 4, height // 2, 1, 1, GL_RGB, GL_UNSIGNED_BYTE)
    right = glReadPixels(width * 3 // 4, height // 2, 1, 1, GL_RGB, GL_UNSIGNED_BYTE)
    assert bytes(left) == b"\xff\0\0" and bytes(right) == b"\0\xff\0", (left, right)
    assert glGetError() == GL_NO_ERROR
    glfw.swap_buffers(window)
    glfw.poll_events()
