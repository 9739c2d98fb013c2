"""A round pond with waves from its middle, drawn from vertex arrays. Arrow keys walk around it."""

import numpy as np
import OpenGL.GL as gl
import pygame
from OpenGL.GLU import gluLookAt, gluPerspective

RINGS, SIDES = 60, 96


def make_indices():
    """Triangles between neighbouring rings."""
    ring, side = np.meshgrid(np.arange(RINGS - 1), np.arange(SIDES), indexing="ij")
    a = ring * SIDES + side
    b = ring * SIDES + (side + 1) % SIDES
    quads = np.stack([a, a + SIDES, b, b, a + SIDES, b + SIDES], axis=-1)
    return quads.astype(np.uint32).ravel()


def pond(seconds):
    """Positions and colours at a time; waves run outwards and grow weaker."""
    radius = np.linspace(0.02, 3, RINGS)[:, None]
    angle = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)[None, :]
    phase = 5 * radius - 4 * seconds + 0.6 * np.cos(3 * angle)
    height = 0.28 * np.sin(phase) * np.exp(-0.4 * radius)
    points = np.stack([radius * np.cos(angle), height, radius * np.sin(angle)], axis=-1).astype(
        np.float32
    )
    crest = (0.5 + 0.5 * np.sin(phase + 0.7)) ** 2
    deep, light = np.array([0.02, 0.16, 0.35]), np.array([0.65, 0.95, 0.9])
    colours = (deep + crest[..., None] * (light - deep)).astype(np.float32)
    return points.reshape(-1, 3), colours.reshape(-1, 3)


def main():
    pygame.init()
    pygame.display.set_mode((400, 300), pygame.OPENGL | pygame.DOUBLEBUF)
    pygame.display.set_caption("Waves")
    clock = pygame.time.Clock()
    indices = make_indices()
    turned = 0.0

    gl.glClearColor(0.86, 0.91, 0.95, 1)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gluPerspective(45, 400 / 300, 0.1, 100)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glEnableClientState(gl.GL_COLOR_ARRAY)

    running = True
    while running:
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                running = False
            if event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE:
                running = False
        keys = pygame.key.get_pressed()
        turned += 3.0 * (keys[pygame.K_RIGHT] - keys[pygame.K_LEFT])

        points, colours = pond(pygame.time.get_ticks() / 1000)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glLoadIdentity()
        gluLookAt(0, 3.2, 5.2, 0, -0.2, 0, 0, 1, 0)
        gl.glRotatef(turned, 0, 1, 0)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, points)
        gl.glColorPointer(3, gl.GL_FLOAT, 0, colours)
        gl.glDrawElements(gl.GL_TRIANGLES, len(indices), gl.GL_UNSIGNED_INT, indices)

        pygame.display.flip()
        clock.tick(60)
    pygame.quit()


if __name__ == "__main__":
    main()
