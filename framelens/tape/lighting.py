"""Lighting's formula in numbers, for the fragment of a draw: which light gives which share.

Technique: OpenGL itself computes each share, in the pixel, with the others switched off. Only
lights and the scene's ambient light are changed, which nothing between glBegin and glEnd can set
back; so materials, normals and the interpolation between the vertices are those of the program.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.tape.arithmetic import colour
from framelens.tape.probe import enabled

LIGHTS = 8
BLACK = np.array((0.0, 0.0, 0.0, 1.0), np.float32)
WHITE = np.ones(4, np.float32)
SHARES = ("ambient", "diffuse", "specular")
Fragment = Callable[[Callable[[], None]], np.ndarray]
"""Return the colour of a fragment, RGB and alpha, after other state is set."""


@dataclass(frozen=True)
class Light:
    """The parts of a light's contribution to a fragment, each RGB.

    ``facing`` is N.L, the cosine of the angle between normal and light, 0 where the light is behind
    the surface; ``reach`` is what attenuation and the cone of a spotlight leave. They are None
    where materials are set between glBegin and glEnd.
    """

    name: str
    ambient: np.ndarray
    diffuse: np.ndarray
    specular: np.ndarray
    facing: float | None
    reach: float | None

    def as_text(self) -> str:
        """Return the shares in a line."""
        diffuse = f"diffuse {colour(self.diffuse)}"
        if self.facing is not None:
            diffuse += f" by N.L {self.facing:.3f}"
            if self.facing == 0.0:
                diffuse += ", the light is behind the surface"
        if self.reach is not None and self.reach < 0.9995:
            diffuse += f" and attenuation {self.reach:.3f}"
        ambient = f"ambient {colour(self.ambient)}"
        return f"{self.name}: {ambient} + {diffuse} + specular {colour(self.specular)}"

    def as_json(self) -> dict[str, object]:
        """Return the shares as `landscape pixel --json` prints them."""
        shares = {name: _list(getattr(self, name)) for name in SHARES}
        return {"light": self.name, **shares, "n_l": self.facing, "attenuation": self.reach}


def shares(fragment: Fragment) -> tuple[list[str], dict[str, object]]:
    """Return how lighting comes to a fragment's colour, as text and as numbers.

    ``fragment`` draws it without fog and textures. GL_LIGHTING must be enabled.
    """
    names = [f"GL_LIGHT{k}" for k in range(LIGHTS) if enabled(f"GL_LIGHT{k}")]
    emission = fragment(lambda: _only((), scene=False))[:3]
    scene = fragment(lambda: _only((), scene=True))[:3] - emission
    lights = [_light(fragment, name, emission) for name in names]
    total = fragment(lambda: None)[:3]

    texts = [f"emission {colour(emission)} + ambient of the scene {colour(scene)}"]
    texts += [light.as_text() for light in lights] or ["no light is enabled"]
    texts.append(f"lighting: {colour(total)}")
    parts = {
        "emission": _list(emission),
        "scene_ambient": _list(scene),
        "lights": [light.as_json() for light in lights],
        "result": _list(total),
    }
    return texts, parts


def _light(fragment: Fragment, name: str, emission: np.ndarray) -> Light:
    def share(kind: str) -> np.ndarray:
        def prepare() -> None:
            _only((name,), scene=False)
            for other in SHARES:
                if other != kind:
                    _set(name, other.upper(), BLACK)

        return np.maximum(fragment(prepare)[:3] - emission, 0.0)

    ambient, diffuse, specular = (share(kind) for kind in SHARES)
    reached = _grey(fragment(lambda: _white(name)))
    facing = _grey(fragment(lambda: _white(name, everywhere=True)))
    reach = reached / facing if reached is not None and facing else None
    return Light(name, ambient, diffuse, specular, facing, reach)


def _only(names: Sequence[str], scene: bool) -> None:
    """Leave these lights on, and the scene's ambient light where ``scene`` says so."""
    for k in range(LIGHTS):
        if f"GL_LIGHT{k}" not in names:
            gl.glDisable(gl.GL_LIGHT0 + k)
    if not scene:
        gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, BLACK)


def _set(light: str, name: str, value: np.ndarray) -> None:
    gl.glLightfv(gl_constant(light), gl_constant(f"GL_{name}"), value)


def _white(name: str, everywhere: bool = False) -> None:
    """Light a white, matt material by one white light, which reaches ``everywhere``."""
    _only((name,), scene=False)
    gl.glDisable(gl.GL_COLOR_MATERIAL)
    both = gl.GL_FRONT_AND_BACK
    gl.glMaterialfv(both, gl.GL_DIFFUSE, WHITE)
    for what in ("AMBIENT", "SPECULAR", "EMISSION"):
        gl.glMaterialfv(both, gl_constant(f"GL_{what}"), BLACK)
    for what, value in (("AMBIENT", BLACK), ("DIFFUSE", WHITE), ("SPECULAR", BLACK)):
        _set(name, what, value)
    if everywhere:
        light = gl_constant(name)
        gl.glLightf(light, gl.GL_CONSTANT_ATTENUATION, 1.0)
        gl.glLightf(light, gl.GL_LINEAR_ATTENUATION, 0.0)
        gl.glLightf(light, gl.GL_QUADRATIC_ATTENUATION, 0.0)
        gl.glLightf(light, gl.GL_SPOT_CUTOFF, 180.0)


def _grey(color: np.ndarray) -> float | None:
    """Return the one number of a grey colour, None for another colour."""
    if np.ptp(color[:3]) > 1e-3:
        return None
    return round(float(color[0]), 5)


def _list(values: np.ndarray) -> list[float]:
    return [round(float(value), 5) for value in values]
