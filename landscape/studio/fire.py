"""The torch flame: sixteen frames of a two-dimensional fluid, looped, on one 4x4 sheet.

Stable fluids (Stam, "Stable Fluids", SIGGRAPH 1999): semi-Lagrangian advection and a projection
done in the Fourier domain; vorticity confinement (Fedkiw, Stam and Jensen 2001) puts back the
curls that the advection blurs; heat rises and cools faster the hotter it is, as radiating gas
does. The loop is closed by fading the end of the run into the frames that came before its start.
"""

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from landscape.studio.images import bleed, shrink, smoothstep, to_uint8

GRID = 256  # cells per side: twice the frame, for supersampled edges
FRAME = 128  # texels per side of a frame
FRAMES = 16  # 4 x 4, as the 2006 sheet
WARM_UP = 260  # chosen: steps until the flame stands
STEPS_PER_FRAME = 6  # chosen: about 25 frames a second
SEED = 1999  # chosen
BUOYANCY = 0.085  # chosen: upward speed gained per step and unit heat, cells
CONFINEMENT = 0.30  # chosen
EXPANSION = 0.085  # chosen: divergence of the burning gas, per step; without it the plume necks
SOURCE_WIDTH = 0.10  # chosen: half width of the burning top of the torch, share of the frame
ASPECT = 0.64  # about width to height of the 2006 quad, 0.06 by 0.10: the scene narrows the frame
GUTTER = 4  # texels left transparent at the sides
# Heat to colour, sRGB: deep orange at the cool edge, yellow, near white in the core. Chosen.
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
    """The state of the fluid: heat and velocity on a periodic grid, row 0 at the bottom."""

    def __init__(self) -> None:
        self.rng = np.random.default_rng(SEED)
        self.heat = np.zeros((GRID, GRID))
        self.u = np.zeros((GRID, GRID))
        self.v = np.zeros((GRID, GRID))
        self.rows, self.columns = np.mgrid[0:GRID, 0:GRID].astype(float)
        k_x = np.fft.rfftfreq(GRID)[None, :]
        k_y = np.fft.fftfreq(GRID)[:, None]
        k2 = np.maximum(k_x**2 + k_y**2, 1e-12)
        self.k_x, self.k_y, self.k2 = k_x, k_y, k2
        x = (self.columns + 0.5) / GRID - 0.5
        y = (self.rows + 0.5) / GRID
        bowl = np.hypot(x / SOURCE_WIDTH, (y - 0.055) / 0.055)
        self.source = 1.0 - smoothstep(0.55, 1.15, bowl)
        # The domain is periodic: what leaves by the top must not come back from below.
        self.keep = 1.0 - smoothstep(0.78, 0.95, y)
        self.still = smoothstep(0.5, 0.30, np.abs(x)) * (1.0 - smoothstep(0.93, 0.99, y))
        self.x, self.y = x, y
        self.time = 0

    def step(self) -> None:
        """Advance one step: source, buoyancy, confinement, projection, advection, cooling."""
        self.time += 1
        # Slow random flicker of the source, left against right.
        t = self.time
        swing = np.sin(0.071 * t) + 0.7 * np.sin(0.113 * t + 1.0) + 0.5 * np.sin(0.197 * t + 2.2)
        burn = self.source * (0.9 + 0.25 * np.sin(34.0 * self.x + 1.6 * swing))
        self.heat = np.maximum(self.heat, burn)
        self.v += BUOYANCY * self.heat
        # Entrainment: the surrounding air is drawn in, which tapers the flame to a tip.
        self.u -= 0.016 * np.sign(self.x) * np.minimum(np.abs(self.x) / 0.06, 1.0) * self.heat
        self.u += 0.012 * swing * self.heat * self.y
        kick = ndimage.gaussian_filter(self.rng.standard_normal((GRID, GRID)), 5, mode="wrap")
        self.u += 1.0 * kick * (self.heat > 0.05)
        self._confine()
        self.u *= self.still
        self.v *= self.still
        self._project()
        back = [self.rows - self.v, self.columns - self.u]
        self.u, self.v, self.heat = (
            ndimage.map_coordinates(f, back, order=1, mode="grid-wrap")
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
        """Take the unwanted divergence out of the velocity, in the Fourier domain."""
        u, v = np.fft.rfft2(self.u), np.fft.rfft2(self.v)
        # Burning gas expands (Feldman et al. 2003): this much of the divergence is to stay.
        swell = EXPANSION * self.source + 0.10 * EXPANSION * self.heat**2 * (self.y < 0.55)
        stays = np.fft.rfft2(swell - swell.mean()) / (2j * np.pi)
        divergence = (self.k_x * u + self.k_y * v - stays) / self.k2
        self.u = np.fft.irfft2(u - self.k_x * divergence, s=(GRID, GRID))
        self.v = np.fft.irfft2(v - self.k_y * divergence, s=(GRID, GRID))


def simulate() -> np.ndarray:
    """Return FRAMES looping heat fields, (FRAMES, GRID, GRID), row 0 at the top."""
    flame = Flame()
    for _ in range(WARM_UP):
        flame.step()
    run = []
    for _ in range(2 * FRAMES):
        for _ in range(STEPS_PER_FRAME):
            flame.step()
        run.append(flame.heat[::-1].copy())
    # Frame 0 is run[FRAMES], which follows run[FRAMES - 1]: so the last frame must be that one.
    weight = smoothstep(0.35, 1.0, np.arange(FRAMES) / (FRAMES - 1))[:, None, None]
    loop = (1.0 - weight) * np.array(run[FRAMES:]) + weight * np.array(run[:FRAMES])
    # A loop has no first frame of its own: begin where it moves least.
    steps = np.abs(np.roll(loop, -1, axis=0) - loop).mean(axis=(1, 2))
    return np.roll(loop, -1 - int(steps.argmin()), axis=0)


def shade(heat: np.ndarray) -> np.ndarray:
    """Turn (GRID, GRID) heat into a (FRAME, FRAME, 4) uint8 frame with straight alpha."""
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
    """Return the sheet, (512, 512, 4) uint8, frame i at column i % 4 and row i // 4."""
    frames = [bleed(bleed(shade(heat), 2)) for heat in simulate()]
    return np.vstack([np.hstack(frames[row * 4 : row * 4 + 4]) for row in range(4)])


ASSETS: dict[str, Callable[[], np.ndarray]] = {"fire.png": fire}
