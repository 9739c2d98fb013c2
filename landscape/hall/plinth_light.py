"""The light on the plinth where the light map does not fit: under the ball, and without the sun.

The hall's light is baked with the dragon on the plinth. A ball (``statue.figure``) would float over
it without a shadow of its own: here the texels of the plinth lose the sun where the ball hides it,
and of all light the fraction of the sky that the ball takes up. With ``shadow.sunlit`` off they
lose the sun everywhere. No OpenGL.
"""

from typing import NamedTuple

import numpy as np

from landscape.hall import plan
from landscape.hall.architecture import hall
from landscape.hall.light import GAMMA, placed
from landscape.hall.surfaces import cells

SHADED = 0.05  # chosen: the sun's share of a texel's light below which it lies in shade
PENUMBRA = 0.12  # chosen, in radii: how wide the edge of the ball's shadow is


class Ball(NamedTuple):
    """A ball: its centre (3,) and its radius, in units."""

    centre: tuple[float, float, float]
    radius: float


def ambient(place: np.ndarray, normal: np.ndarray, ball: Ball) -> np.ndarray:
    """Return the fraction of soft light (...) that a ball leaves at places and normals (..., 3).

    It covers cos(angle) * (radius / distance)^2 of what light the surface would receive from all
    directions, each weighted by its cosine.
    """
    towards = np.array(ball.centre) - place
    distance = np.linalg.norm(towards, axis=-1)
    cosine = (normal * towards).sum(axis=-1) / distance
    return 1.0 - np.maximum(cosine, 0.0) * np.minimum(ball.radius / distance, 1.0) ** 2


def sunlight(place: np.ndarray, sun: np.ndarray, ball: Ball) -> np.ndarray:
    """Return the fraction of the sun (...) that passes a ball on its way to places (..., 3).

    ``sun`` (3,) is the unit vector to it. The shadow's edge is soft, as the sun is no point.
    """
    towards = np.array(ball.centre) - place
    along = towards @ sun
    missed = np.linalg.norm(towards - along[..., None] * sun, axis=-1) / ball.radius
    hidden = np.clip((1.0 + PENUMBRA / 2 - missed) / PENUMBRA, 0.0, 1.0)
    return np.where(along > 0.0, 1.0 - hidden, 1.0)


def plinth_light(
    light: np.ndarray, sun: np.ndarray, ball: Ball | None, sunlit: bool = True
) -> np.ndarray:
    """Return the hall's light map, uint8 (h, w, 4), with other light on the plinth.

    Its alpha is the sun's share of each texel's light.
    """
    out = light.copy()
    for lit in placed(hall()):
        if lit.chart is None or lit.surface.material != "plinth":
            continue
        chart = lit.chart
        texels = np.s_[chart.y : chart.y + chart.height, chart.x : chart.x + chart.width]
        place, normal = cells(lit.surface, chart)
        whole = (light[texels][..., :3] / 255.0) ** GAMMA
        shaded = without_sun(whole, light[texels][..., 3] / 255.0)
        passed = np.full(whole.shape[:2], float(sunlit))
        soft = np.ones(whole.shape[:2])
        if ball is not None:
            passed = passed * sunlight(place, sun, ball)
            soft = ambient(place, normal, ball)

        left = shaded * soft[..., None] + (whole - shaded) * passed[..., None]
        out[texels][..., :3] = np.rint(255.0 * left ** (1.0 / GAMMA))
    return out


def without_sun(light: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Return a chart's linear light (h, w, 3) without the sun, whose share is (h, w).

    The share is known too coarsely to be subtracted: it would leave a grey patch. What is sunlit is
    as bright as the middle of what is not.
    """
    shade = share < SHADED
    if shade.all() or not shade.any():
        return light
    middle = np.median(light[shade], axis=0)
    sunlit = np.minimum(share / SHADED, 1.0)[..., None]
    return np.minimum(light, light + sunlit * (middle - light))


def ball_on_plinth() -> Ball:
    """Return the ball that stands on the plinth, let into it as the statue is."""
    (x, z), (_, top) = plan.STATUE, plan.PLINTH
    radius = plan.BALL * plan.STATUE_SCALE
    return Ball((x, top - plan.STATUE_SUNK + radius, z), radius)
