"""The soft shadow where a tree or a deer meets the ground (``transparent.contact``).

Its baked shadow lies where the sun's rays end; right at the feet, where neither sun nor sky gets
through, the ground is darker still. Technique: a quad parallel to the slope, with the picture of a
soft dot, in the sort just before its sprite. Its corners are moved a little towards the eye along
the line of sight, so that on the screen they stay where they are, but no terrain between the feet
hides the quad and the grass around the feet is darkened, too. No OpenGL here.
"""

import numpy as np

from landscape.elements.atlas import cell_coordinates
from landscape.elements.best.sprites.choice import Choice
from landscape.elements.best.sprites.individuals import BRAMBLE, CONTACT, HAZEL, ROWS
from landscape.elements.best.sprites.refined_quads import Quads
from landscape.elements.best.sprites.rules import is_deer
from landscape.elements.best.sprites.slope_billboards import upright_axes
from landscape.elements.planting import PLANT
from landscape.elements.settings import Settings
from landscape.elements.sun import direction
from landscape.elements.transparent_elements import QUAD, QUAD_S, QUAD_T
from landscape.frame import Frame

ACROSS, ALONG = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
PLACE = cell_coordinates(np.array([CONTACT]), np.array([False]), QUAD_S, QUAD_T, ROWS)
# All chosen. Half the quad's sides across and along the line of sight, times the sprite's width.
REACHES = np.array([(0.26, 0.22), (0.50, 0.34), (0.52, 0.30)])  # trees, bushes, deer
DEER_ROW = 2
WITHIN, FADES = 5.0, 0.3  # units: how far away they are drawn; the last part of it, fading out
NEARER = 0.045  # units: how far the corners are moved towards the eye
SHIFT = 0.12  # times the width: how far the shadow lies away from the sun
BEFORE = 0.004  # units: how much farther than its sprite it is in the sort


def contact_quads(
    frame: Frame,
    settings: Settings,
    choice: Choice,
    away: np.ndarray,
    alpha: np.ndarray,
    depth: np.ndarray,
    slopes: np.ndarray,
) -> Quads | None:
    """Return the shadows of the trees and deer of a choice; None if none is near.

    ``away``, ``alpha`` 0..1 and ``depth`` (n,) are those of the sprites, ``slopes`` (n, 2) the
    ground's.
    """
    which = np.flatnonzero((choice.cells < PLANT) & (away < WITHIN) & (alpha > 0.0))
    if not len(which):
        return None

    widths, pictures = choice.sizes[which, 0], choice.pictures[which]
    bush = (pictures == HAZEL) | (pictures == BRAMBLE)
    reach = REACHES[np.where(is_deer(choice.cells[which]), DEER_ROW, bush)]
    right, _ = upright_axes(frame.right)
    ahead = np.array([right[2], 0.0, -right[0]])
    shift = SHIFT * direction(settings.sun) * (1.0, 0.0, 1.0)
    across, along = reach[:, :1] * ACROSS, reach[:, 1:] * ALONG
    x, z = (
        (across * right[axis] + along * ahead[axis] - shift[axis]) * widths[:, None]
        for axis in (0, 2)
    )

    # The corners lie on the slope, and a little nearer to the eye, so that the ground is behind.
    slope, feet = slopes[which], choice.positions[which].T[..., None]
    corners = np.stack([x, x * slope[:, :1] + z * slope[:, 1:], z]) + feet
    line = frame.eye[:, None, None] - corners
    far = np.sqrt(line[0] * line[0] + line[1] * line[1] + line[2] * line[2])
    corners += line * np.minimum(NEARER / np.maximum(far, 1e-6), 0.5)

    fade = np.clip((WITHIN - away[which]) / (FADES * WITHIN), 0.0, 1.0)
    colours = np.full((len(which), 4), 255.0)
    colours[:, 3] *= settings.transparent.contact * alpha[which] * fade
    return Quads.of(
        np.ascontiguousarray(corners.transpose(1, 2, 0), np.float32),
        np.repeat(PLACE, len(which), axis=0),
        colours.astype(np.uint8),
        QUAD,
        depth[which] - BEFORE,
    )
