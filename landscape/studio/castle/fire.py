"""The torch flame: sixteen looping frames of a two-dimensional fluid on a 4x4 sprite sheet.

Stable fluids (Stam, "Stable Fluids", SIGGRAPH 1999): semi-Lagrangian advection, with the pressure
projection done in the Fourier domain. Vorticity confinement (Fedkiw, Stam and Jensen 2001) restores
the eddies that the advection blurs. Heat rises, and cools faster the hotter it is, like a radiating
gas. The loop is closed by cross-fading the last frames into those that preceded the first.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import bleed, shrink, smoothstep, to_uint8

GRID = 256  # cells per side: twice the frame, for antialiased edges
FRAME = 128  # texels per side of a frame
FRAMES = 16  # 4 x 4, as the 2006 sheet
WARM_UP = 260  # chosen: steps until the flame is fully developed
STEPS_PER_FRAME = 6  # chosen: about 25 frames a second
SEED = 1999  # chosen
BUOYANCY = 0.085  # chosen: upward acceleration per unit of heat, in cells per step
CONFINEMENT = 0.30  # chosen
EXPANSION = 0.085  # chosen: divergence of the burning gas; without it the plume narrows to a neck
SOURCE_WIDTH = 0.10  # chosen: half width of the flame source, as a fraction of the frame
ASPECT = 0.64  # about the aspect of the 2006 quad, 0.06 by 0.10, which narrows the frame
GUTTER = 4  # transparent texels at the sides
# Chosen: heat to sRGB colour, from deep orange at the cool edge to near white in the core.
RAMP_HEAT = np.array([0.0, 0.16, 0.36, 0.62, 0.88, 1.12])
RAMP_RGB = np.array(
    [
        [0.55, 0.08, 0.01],
        [0.82, 0.20, 0.02],
        [0.98, 0.42, 0.05],
        [1.00, 0.66, 0.16],
        [1.00, 0.86, 0.42],
        [1.00, 0.97, 0.80],
    ]
)


class Flame:
    """The state of the fluid: heat and velocity (u, v) on a periodic grid, row 0 at the bottom."""

    def __init__(self) -> None:
        self.rng = np.random.default_rng(SEED)
        self.heat = np.zeros((GRID, GRID))
        self.u = np.zeros((GRID, GRID))
        self.v = np.zeros((GRID, GRID))
        self.rows, self.columns = np.mgrid[0:GRID, 0:GRID].astype(float)
        k_x = np.fft.rfftfreq(GRID)[None, :]
        k_y = np.fft.fftfreq(GRID)[:, None]
        k2 = np.maximum(k_x**2 + k_y**2, 1e-12)
        self.k_x = k_x
        self.k_y = k_y
        self.k2 = k2
        x = (self.columns + 0.5) / GRID - 0.5
        y = (self.rows + 0.5) / GRID
        bowl = np.hypot(x / SOURCE_WIDTH, (y - 0.055) / 0.055)
        self.source = 1.0 - smoothstep(0.55, 1.15, bowl)

        # The domain is periodic: heat that leaves at the top must not re-enter at the bottom.
        self.keep = 1.0 - smoothstep(0.78, 0.95, y)
        self.damping = smoothstep(0.5, 0.30, np.abs(x)) * (1.0 - smoothstep(0.93, 0.99, y))
        self.x, self.y = x, y
        self.time = 0

    def step(self) -> None:
        """Advance by one step: source, buoyancy, confinement, projection, advection, cooling."""
        self.time += 1

        # Slow flicker of the source between left and right.
        t = self.time
        swing = np.sin(0.071 * t) + 0.7 * np.sin(0.113 * t + 1.0) + 0.5 * np.sin(0.197 * t + 2.2)
        burn = self.source * (0.9 + 0.25 * np.sin(34.0 * self.x + 1.6 * swing))
        self.heat = np.maximum(self.heat, burn)
        self.v += BUOYANCY * self.heat

        # Entrainment: the flame draws in the surrounding air, which tapers it to a tip.
        self.u -= 0.016 * np.sign(self.x) * np.minimum(np.abs(self.x) / 0.06, 1.0) * self.heat
        self.u += 0.012 * swing * self.heat * self.y
        kick = ndimage.gaussian_filter(self.rng.standard_normal((GRID, GRID)), 5, mode="wrap")
        self.u += 1.0 * kick * (self.heat > 0.05)
        self._confine()
        self.u *= self.damping
        self.v *= self.damping
        self._project()
        departure = [self.rows - self.v, self.columns - self.u]
        self.u, self.v, self.heat = (
            ndimage.map_coordinates(f, departure, order=1, mode="grid-wrap")
            for f in (self.u, self.v, self.heat)
        )
        cooling = 0.0060 * (0.35 + self.heat**3) + 0.0012 + 0.020 * smoothstep(0.30, 0.88, self.y)
        self.heat = np.clip(self.heat - cooling, 0.0, None) * self.keep
        self.u *= 0.992
        self.v *= 0.992

    def _confine(self) -> None:
        """Add vorticity confinement."""
        curl = np.gradient(self.v)[1] - np.gradient(self.u)[0]
        grad_y, grad_x = np.gradient(np.abs(curl))
        length = np.hypot(grad_x, grad_y) + 1e-5
        self.u += CONFINEMENT * grad_y / length * curl * 0.5
        self.v -= CONFINEMENT * grad_x / length * curl * 0.5

    def _project(self) -> None:
        """Remove the unwanted divergence from the velocity, in the Fourier domain."""
        u, v = np.fft.rfft2(self.u), np.fft.rfft2(self.v)
        # Burning gas expands (Feldman et al. 2003), so this much of the divergence is kept.
        expansion = EXPANSION * self.source + 0.10 * EXPANSION * self.heat**2 * (self.y < 0.55)
        kept = np.fft.rfft2(expansion - expansion.mean()) / (2j * np.pi)
        divergence = (self.k_x * u + self.k_y * v - kept) / self.k2
        self.u = np.fft.irfft2(u - self.k_x * divergence, s=(GRID, GRID))
        self.v = np.fft.irfft2(v - self.k_y * divergence, s=(GRID, GRID))


def simulate() -> np.ndarray:
    """Run the fluid; return looping heat fields (FRAMES, GRID, GRID), row 0 at the top."""
    flame = Flame()
    for _ in range(WARM_UP):
        flame.step()
    run = []
    for _ in range(2 * FRAMES):
        for _ in range(STEPS_PER_FRAME):
            flame.step()
        run.append(flame.heat[::-1].copy())
    # Frame 0 is run[FRAMES]. The frame before it is run[FRAMES - 1], so the loop must end there.
    weight = smoothstep(0.35, 1.0, np.arange(FRAMES) / (FRAMES - 1))[:, None, None]
    loop = (1.0 - weight) * np.array(run[FRAMES:]) + weight * np.array(run[:FRAMES])
    # A loop may start at any frame: start where the motion is least.
    steps = np.abs(np.roll(loop, -1, axis=0) - loop).mean(axis=(1, 2))
    return np.roll(loop, -1 - int(steps.argmin()), axis=0)


def shade(heat: np.ndarray) -> np.ndarray:
    """Convert heat (GRID, GRID) to a frame, uint8 (FRAME, FRAME, 4), with straight alpha."""
    columns = (np.arange(GRID) - (GRID - 1) / 2) * ASPECT + (GRID - 1) / 2
    where = np.meshgrid(np.arange(GRID), columns, indexing="ij")
    heat = ndimage.map_coordinates(heat, where, order=1)
    rgb = np.stack([np.interp(heat, RAMP_HEAT, channel) for channel in RAMP_RGB.T], axis=-1)
    alpha = smoothstep(0.02, 0.46, heat)
    side = np.minimum(np.arange(GRID), np.arange(GRID)[::-1]) / (GRID / FRAME)
    alpha = alpha * smoothstep(GUTTER, GUTTER + 8, side)[None, :]
    alpha = alpha * smoothstep(2, 10, np.arange(GRID) / (GRID / FRAME))[:, None]
    small = shrink(np.dstack([rgb * alpha[..., None], alpha]), GRID // FRAME)
    cover = small[..., 3:]
    return to_uint8(np.dstack([small[..., :3] / np.maximum(cover, 1e-4), cover]))


def fire() -> np.ndarray:
    """Return the sheet, uint8 (512, 512, 4), with frame i at column i % 4 and row i // 4."""
    frames = [bleed(bleed(shade(heat), 2)) for heat in simulate()]
    return np.vstack([np.hstack(frames[row * 4 : row * 4 + 4]) for row in range(4)])


ASSETS: dict[str, Callable[[], np.ndarray]] = {"fire.png": fire}
