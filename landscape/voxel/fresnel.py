"""How much water mirrors, for every line of sight: a cube map of alphas.

Technique: Fresnel's term depends on the angle between the line of sight and the water's normal,
and so on the direction from the eye to the point alone. A cube map looked up with that direction,
vertex minus eye, which may be interpolated without error over any polygon, gives it per pixel
(GL_ARB_texture_cube_map, OpenGL 1.3). The document did this in a shader.
"""

import numpy as np

from landscape.gl.cube_map import face_directions

SIDE = 128  # texels, chosen: side of a face
EVEN = 0.172  # chosen: the cosine at which water mirrors 40 % of the light
STRAIGHT = 0.02  # of water, refractive index 1.33, looked at from straight above


def reflectance(cosine: np.ndarray) -> np.ndarray:
    """Return the fraction of light that water mirrors at angles of these cosines (Schlick 1994)."""
    return STRAIGHT + (1.0 - STRAIGHT) * (1.0 - np.clip(cosine, 0.0, 1.0)) ** 5


def fresnel_faces(strength: float, by_angle: bool = True) -> np.ndarray:
    """Return the faces, uint8 (6, n, n, 1), for lines of sight (x, y, z) onto a level surface.

    Without ``by_angle`` it mirrors as much in all directions, which is what a constant would do.
    """
    downwards = -face_directions(SIDE)[..., 1:2]
    if not by_angle:
        downwards = np.full_like(downwards, EVEN)
    return (255.0 * np.clip(strength * reflectance(downwards), 0.0, 1.0) + 0.5).astype(np.uint8)
