"""A test that always fails marks the glass; the buffer is cleared to another value."""
# exercise: stencil_mirror
# the rest: start.py


def draw_reflection():
    """Draw what the mirror shows, where its glass is."""
    glClearStencil(5)
    glClear(GL_STENCIL_BUFFER_BIT)
    glPushAttrib(GL_STENCIL_BUFFER_BIT | GL_ENABLE_BIT)
    glEnable(GL_STENCIL_TEST)
    # A test that fails always: nothing is drawn, neither color nor depth.
    glStencilFunc(GL_NEVER, 2, 255)
    glStencilOp(GL_REPLACE, GL_KEEP, GL_KEEP)
    draw_glass()
    glStencilFunc(GL_GREATER, 5, 255)
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    draw_image()
    glPopAttrib()
