"""How much water mirrors, for every line of sight: a cube map of alphas.

Technique: Fresnel's term depends on the angle between the line of sight and the water's normal,
and so on the direction from the eye to the point alone. A cube map looked up with that direction,
vertex minus eye, which may be interpolated without error over any polygon, gives it per pixel
(GL_ARB_texture_cube_map, OpenGL 1.3). The document did this in a shader.
Lines of sight that lead upwards meet the surface from beneath: half of the same cube map is theirs.
"""

import numpy as np

from landscape.gl.cube_map import face_directions
from landscape.voxel.water_grid import INDEX

SIDE = 128  # texels, chosen: side of a face
EVEN = 0.172  # chosen: the cosine at which water mirrors 40 % of the light
STRAIGHT = 0.02  # of water, looked at from straight above


def reflectance(cosine: np.ndarray) -> np.ndarray:
    """Return the fraction of light that water mirrors at angles of these cosines (Schlick 1994)."""
    return STRAIGHT + (1.0 - STRAIGHT) * (1.0 - np.clip(cosine, 0.0, 1.0)) ** 5


def reflectance_beneath(cosine: np.ndarray) -> np.ndarray:
    """Return the same for light in the water: all of it beyond the critical angle.

    The cosine that counts is that of the ray in the air (Snell's law).
    """
    sine = INDEX * np.sqrt(1.0 - np.clip(cosine, 0.0, 1.0) ** 2)
    return reflectance(np.sqrt(np.maximum(1.0 - sine**2, 0.0)))


def fresnel_faces(strength: float, by_angle: bool = True) -> np.ndarray:
    """Return the faces, uint8 (6, n, n, 1), for lines of sight (x, y, z) that meet level water.

    Without ``by_angle`` it mirrors as much in all directions, which is what a constant would do.
    """
    upwards = face_directions(SIDE)[..., 1:2]
    mirrored = np.where(upwards > 0, reflectance_beneath(upwards), reflectance(-upwards))
    if not by_angle:
        mirrored = np.full_like(mirrored, reflectance(np.array(EVEN)))
    return (255.0 * np.clip(strength * mirrored, 0.0, 1.0) + 0.5).astype(np.uint8)
