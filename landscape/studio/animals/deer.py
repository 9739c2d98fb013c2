"""The deer billboards: a red deer stag and a doe in profile.

The bodies are chains of round cones (:mod:`landscape.studio.cones`), one per muscle, bone or tine;
:mod:`landscape.studio.animals.coat` paints and shades them.

Model space: x right, y up, z towards the viewer; unit: the height of the withers.
"""

import functools
from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import CubicSpline

from landscape.studio.animals.coat import (
    COAT,
    DARK,
    EYE,
    FACE,
    HOOF,
    HORN,
    IVORY,
    LEG,
    MANE,
    PALE,
    TAIL,
    render,
)
from landscape.studio.cones import Joint, Model, Point, Skin

SHANK = Skin(LEG, 0.02)
HOOVES = Skin(HOOF, 0.006, hair=0.0)
SKULL = Skin(FACE, 0.03, hair=0.7)
ANTLER = Skin(HORN, 0.003, hair=0.0)

# Chosen: one antler of a twelve-pointer. -x is forward, y is up, z is outward from the midline.
# The first number of each tine is its radius.
BEAM = (
    (0, 0, 0.035),
    (0.045, 0.11, 0.10),
    (0.115, 0.25, 0.19),
    (0.135, 0.37, 0.24),
    (0.09, 0.48, 0.25),
)
TINES = (
    (0.018, (0.01, 0.03, 0.045), (-0.08, 0.055, 0.08), (-0.15, 0.12, 0.09), (-0.165, 0.21, 0.075)),
    (
        0.0135,
        (0.035, 0.09, 0.085),
        (-0.035, 0.13, 0.13),
        (-0.085, 0.2, 0.15),
        (-0.095, 0.25, 0.145),
    ),
    (0.016, (0.115, 0.25, 0.19), (0.05, 0.28, 0.24), (-0.005, 0.35, 0.255), (-0.015, 0.41, 0.25)),
    (0.0155, (0.095, 0.465, 0.25), (0.03, 0.53, 0.24), (0, 0.58, 0.22), (-0.005, 0.62, 0.20)),
    (0.016, (0.09, 0.47, 0.25), (0.10, 0.55, 0.265), (0.085, 0.65, 0.26)),
    (0.0145, (0.13, 0.40, 0.245), (0.19, 0.47, 0.29), (0.215, 0.53, 0.305), (0.215, 0.58, 0.305)),
)


def legs(model: Model, spread: float, fore: float, hind: float) -> None:
    """Add the four legs: shoulder or thigh, joints, cannon bone, pastern and cloven hoof.

    The legs on the far side are shifted along x by ``fore`` and ``hind``.
    """
    for side, shift, back in ((1.0, 0.0, 0.0), (-1.0, fore, hind)):
        z = side * spread
        fx = -0.35 + shift
        model.limb(
            Skin(COAT, 0.04, 0.75),
            (-0.30 + 0.3 * shift, 0.81, 0.8 * z, 0.125),
            (-0.365 + 0.5 * shift, 0.67, z, 0.100),
            (fx + 0.050, 0.545, z, 0.056),
            (fx + 0.022, 0.44, z, 0.040),
            (fx, 0.335, z, 0.031),
            last=LEG,
        )
        model.ball(Skin(LEG, 0.025), (fx - 0.006, 0.325, z), 0.033)
        cannon = ((fx + 0.004, 0.22, z, 0.0195), (fx + 0.002, 0.115, z, 0.0215))
        model.limb(SHANK, (fx, 0.33, z, 0.028), *cannon)
        model.ball(SHANK, (fx + 0.008, 0.100, z), 0.025)
        model.limb(SHANK, (fx, 0.098, z, 0.021), (fx - 0.032, 0.050, z, 0.022))
        hoof(model, fx - 0.036, z)

        hx = 0.52 + back
        top = 0.35 * back
        model.limb(
            Skin(COAT, 0.045, 0.7),
            (0.40 + top, 0.83, 0.75 * z, 0.150),
            (0.375 + top, 0.68, z, 0.128),
            (0.40 + top, 0.56, z, 0.082),
            (hx - 0.045, 0.46, z, 0.050),
            (hx + 0.025, 0.385, z, 0.034),
            last=LEG,
        )
        model.limb(
            Skin(COAT, 0.045, 0.8),
            (0.50 + top, 0.74, 0.8 * z, 0.10),
            (0.49 + 0.6 * back, 0.57, z, 0.042),
            (hx + 0.048, 0.40, z, 0.019),
        )
        model.limb(
            Skin(LEG, 0.022),
            (hx + 0.036, 0.392, z, 0.034),
            (hx + 0.030, 0.30, z, 0.0265),
            (hx + 0.008, 0.205, z, 0.0205),
            (hx - 0.014, 0.115, z, 0.0225),
        )
        model.ball(SHANK, (hx - 0.012, 0.100, z), 0.026)
        model.limb(SHANK, (hx - 0.018, 0.098, z, 0.022), (hx - 0.052, 0.050, z, 0.022))
        hoof(model, hx - 0.056, z)


def hoof(model: Model, x: float, z: float) -> None:
    """Add two toes side by side and the dew claws behind them."""
    for toe in (z - 0.014, z + 0.014):
        splay = z + 1.3 * (toe - z)
        model.limb(HOOVES, (x, 0.046, toe, 0.019), (x - 0.026, 0.006, splay, 0.018))
        model.limb(HOOVES, (x + 0.004, 0.03, toe, 0.020), (x + 0.004, 0.004, toe, 0.021))
    model.ball(HOOVES, (x + 0.050, 0.075, z + 0.008), 0.012)


def trunk(model: Model, girth: float) -> None:
    """Add rib cage, back, rump, brisket and tail; ``girth`` scales the chest."""
    model.limb(
        Skin(COAT, 0.07, 0.82),
        (-0.36, 0.785, 0, 0.190 * girth),
        (-0.20, 0.762, 0, 0.205 * girth),
        (0.06, 0.768, 0, 0.188 * girth),
        (0.28, 0.805, 0, 0.150),
        (0.44, 0.82, 0, 0.150),
    )

    model.limb(
        Skin(COAT, 0.07, 0.8),
        (-0.40, 0.86, 0, 0.12),
        (-0.27, 0.885, 0, 0.118),
        (-0.05, 0.865, 0, 0.105),
        (0.25, 0.865, 0, 0.11),
        (0.44, 0.865, 0, 0.125),
    )

    model.limb(Skin(COAT, 0.06), (0.44, 0.865, 0, 0.125), (0.555, 0.80, 0, 0.095))
    brisket = ((-0.47, 0.80, 0, 0.135), (-0.45, 0.70, 0, 0.12), (-0.33, 0.60, 0, 0.07))
    model.limb(Skin(COAT, 0.07, 0.8), *brisket)
    tail = ((0.61, 0.875, 0, 0.034), (0.668, 0.815, 0, 0.032), (0.690, 0.705, 0, 0.013))
    model.limb(Skin(TAIL, 0.02, hair=0.9), *tail)


def head(
    model: Model, origin: Point, nod: float, yaw: float, ear: tuple[float, float]
) -> Callable[[float, float, float], Point]:
    """Add the head with its poll (top) at ``origin``; return the map from head to model space.

    ``nod`` turns it down and ``yaw`` towards the viewer, in radians; ``ear`` is the offset (x, y)
    of an ear's tip from its base.
    """
    c, s = np.cos(nod), np.sin(nod)
    model.stretch = 1.0

    def at(x: float, y: float, z: float) -> Point:
        # Head space: -x along the face to the nose, y up from the face.
        forward, up = c * x - s * y, s * x + c * y
        return (
            float(origin[0] + np.cos(yaw) * forward + np.sin(yaw) * z),
            float(origin[1] + up),
            float(origin[2] - np.sin(yaw) * forward + np.cos(yaw) * z),
        )

    def bone(skin: Skin, *joints: Joint) -> None:
        model.limb(skin, *((*at(x, y, z), r) for x, y, z, r in joints))

    crown = ((-0.08, -0.028, 0, 0.070), (0.0, -0.045, 0, 0.080))
    bone(Skin(FACE, 0.04, 0.8, 0.7), (-0.33, -0.010, 0, 0.040), (-0.20, -0.012, 0, 0.047), *crown)
    jaw = ((-0.305, -0.048, 0, 0.024), (-0.17, -0.075, 0, 0.035), (-0.05, -0.105, 0, 0.055))
    bone(Skin(FACE, 0.035, 0.75, 0.7), *jaw)
    for side in (1.0, -1.0):
        model.ball(SKULL, at(-0.11, 0.012, side * 0.036), 0.034)
    bone(Skin(DARK, 0.012, hair=0.0), (-0.352, 0.002, 0, 0.0235), (-0.348, -0.022, 0, 0.020))
    bone(Skin(PALE, 0.014), (-0.33, -0.054, 0, 0.016), (-0.30, -0.06, 0, 0.018))
    bx, by = ear
    for side in (1.0, -1.0):
        model.ball(Skin(EYE, 0.003, hair=0.0), at(-0.123, 0.004, side * 0.060), 0.0140)
        tip = (0.012 + bx, by, side * 0.150)
        shell = [(0.012, 0.0, side * 0.055), (0.012 + 0.4 * bx, 0.4 * by, side * 0.105), tip]
        radii = [0.020, 0.031, 0.037, 0.037, 0.031, 0.019, 0.005]
        bone(Skin(FACE, 0.006, 0.8, 0.7), *smooth(shell, radii))
        inner = [
            (-0.012 + 0.2 * bx, 0.3 * by + 0.002, side * 0.088),
            (-0.010 + 0.45 * bx, 0.5 * by, side * 0.120),
            (0.8 * bx, 0.85 * by, side * 0.145),
        ]
        bone(Skin(PALE, 0.006, hair=0.7), *smooth(inner, [0.012, 0.022, 0.018, 0.006]))
    return at


def antlers(model: Model, at: Callable[[float, float, float], Point]) -> None:
    """Add two beams, each with brow, bez and trez tines and a crown of three."""
    for side in (1.0, -1.0):

        def place(point: Point, side: float = side) -> Point:
            # Sideways in head space, but upright in model space whatever the nod.
            foot, out = at(-0.02, 0.03, 0.0), at(-0.02, 0.03, side * point[2])
            return (out[0] + point[0], foot[1] + point[1], out[2])

        beam = smooth([place(point) for point in BEAM], np.linspace(0.0275, 0.0185, 11))
        model.limb(ANTLER, *beam)
        model.ball(Skin(HORN, 0.012, hair=0.0), place((0, 0.010, 0.037)), 0.034)
        for width, *points in TINES:
            tine = smooth([place(point) for point in points], width * np.linspace(1.0, 0.30, 7))
            model.limb(ANTLER, *tine, last=IVORY)


def smooth(path: list[Point], radii: Sequence[float] | np.ndarray) -> list[Joint]:
    """Return joints with the given radii, evenly spaced along a spline through ``path``."""
    spline = CubicSpline(np.linspace(0, 1, len(path)), np.array(path))
    points = spline(np.linspace(0, 1, len(radii)))
    return [
        (float(x), float(y), float(z), float(r)) for (x, y, z), r in zip(points, radii, strict=True)
    ]


def standing_stag() -> Model:
    """Return a twelve-point stag with its head raised."""
    model = Model()
    trunk(model, 1.03)
    legs(model, 0.115, 0.075, -0.12)
    model.limb(
        Skin(COAT, 0.06, 0.80),
        (-0.645, 1.325, 0, 0.082),
        (-0.60, 1.17, 0, 0.112),
        (-0.52, 1.00, 0, 0.150),
        (-0.36, 0.84, 0, 0.19),
    )
    model.limb(
        Skin(MANE, 0.06, 0.75),
        (-0.62, 1.22, 0, 0.075),
        (-0.60, 1.05, 0, 0.10),
        (-0.53, 0.88, 0, 0.12),
        (-0.44, 0.74, 0, 0.12),
    )
    antlers(model, head(model, (-0.59, 1.40, 0.0), 0.40, 0.42, (0.11, 0.02)))
    return model


def walking_stag() -> Model:
    """Return a stag in stride, its neck stretched forward."""
    model = Model()
    trunk(model, 1.06)
    legs(model, 0.115, -0.16, -0.20)
    model.limb(
        Skin(COAT, 0.06, 0.80),
        (-0.80, 1.175, 0, 0.080),
        (-0.71, 1.08, 0, 0.108),
        (-0.58, 0.97, 0, 0.148),
        (-0.36, 0.84, 0, 0.19),
    )
    model.limb(
        Skin(MANE, 0.06, 0.75),
        (-0.78, 1.08, 0, 0.075),
        (-0.70, 0.95, 0, 0.10),
        (-0.57, 0.83, 0, 0.12),
        (-0.44, 0.72, 0, 0.12),
    )
    antlers(model, head(model, (-0.77, 1.24, 0.0), 0.34, 0.25, (0.11, 0.02)))
    return model


def standing_doe() -> Model:
    """Return a doe with her neck stretched forward."""
    model = Model(stretch=0.86)
    trunk(model, 0.90)
    legs(model, 0.10, -0.09, 0.09)
    model.limb(
        Skin(COAT, 0.06, 0.75),
        (-0.755, 1.20, 0, 0.062),
        (-0.70, 1.09, 0, 0.072),
        (-0.60, 0.97, 0, 0.098),
        (-0.42, 0.86, 0, 0.150),
    )
    head(model, (-0.655, 1.265, 0.0), 0.46, 0.34, (0.05, 0.125))
    return model


def grazing_doe() -> Model:
    """Return a doe with her muzzle in the grass."""
    model = Model(stretch=0.86)
    trunk(model, 0.90)
    legs(model, 0.10, 0.13, -0.11)
    model.limb(
        Skin(COAT, 0.06, 0.75),
        (-0.93, 0.36, 0, 0.060),
        (-0.86, 0.48, 0, 0.072),
        (-0.70, 0.66, 0, 0.098),
        (-0.44, 0.82, 0, 0.150),
    )
    head(model, (-0.805, 0.385, 0.0), 1.02, 0.20, (0.09, 0.115))
    return model


@functools.cache
def picture(model: Callable[[], Model], seed: int, mane: float, deep: bool) -> np.ndarray:
    """Return the picture of a model, see :func:`landscape.studio.animals.coat.render`."""
    return render(model(), seed, mane, deep)


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "deer_stag.png": functools.partial(picture, standing_stag, 3, 0.8, False),
    "deer_doe.png": functools.partial(picture, standing_doe, 4, 0.0, False),
    "stag.png": functools.partial(picture, standing_stag, 3, 0.8, True),
    "stag_walking.png": functools.partial(picture, walking_stag, 5, 0.8, True),
    "doe.png": functools.partial(picture, standing_doe, 4, 0.0, True),
    "doe_grazing.png": functools.partial(picture, grazing_doe, 6, 0.0, True),
}
