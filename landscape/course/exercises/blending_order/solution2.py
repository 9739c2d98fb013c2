"""One alpha for all by glBlendColor; which of the two tubes is nearer follows from the eye's x."""
# exercise: blending_order
# the rest: start.py


def draw_scene():
    draw_opaque()
    glPushAttrib(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glEnable(GL_BLEND)
    glBlendColor(0, 0, 0, 0.35)
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA)
    glDepthMask(False)
    # The middles are at z = 0: the eye is nearer to the tube on its own side of x = 0.
    first = 1 if eye()[0] < 0 else 0
    draw_tube(*TUBES[first])
    draw_tube(*TUBES[1 - first])
    glPopAttrib()
