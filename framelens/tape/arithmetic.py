"""What OpenGL computes for a fragment, in numbers: texture units, fog, and how it is blended."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.notes import plain
from framelens.tape.probe import enabled, number


def colour(values: Sequence[float] | np.ndarray, digits: int = 3) -> str:
    """Write red, green and blue from 0 to 1: "(0.200, 0.200, 0.400)"."""
    return "(" + ", ".join(f"{float(value):.{digits}f}" for value in values[:3]) + ")"


def token(value: Any, *families: Sequence[str]) -> str:
    """Return the name of an enumerant that OpenGL gave as a number, out of the given names."""
    for name in (each for family in families for each in family):
        if int(gl_constant(name)) == int(value):
            return name
    return str(plain(value))


COMBINED: dict[str, Callable[[np.ndarray, np.ndarray], np.ndarray]] = {
    "GL_FUNC_ADD": lambda source, before: source + before,
    "GL_FUNC_SUBTRACT": lambda source, before: source - before,
    "GL_FUNC_REVERSE_SUBTRACT": lambda source, before: before - source,
}
"""The equations of blending, of a source and what was there, each times its factor."""

COMPARISONS = (
    *("GL_NEVER", "GL_LESS", "GL_EQUAL", "GL_LEQUAL", "GL_GREATER", "GL_NOTEQUAL", "GL_GEQUAL"),
    "GL_ALWAYS",
)
FACTORS = (
    *("GL_ZERO", "GL_ONE", "GL_SRC_COLOR", "GL_ONE_MINUS_SRC_COLOR", "GL_DST_COLOR"),
    *("GL_ONE_MINUS_DST_COLOR", "GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA", "GL_DST_ALPHA"),
    *("GL_ONE_MINUS_DST_ALPHA", "GL_CONSTANT_COLOR", "GL_ONE_MINUS_CONSTANT_COLOR"),
    *("GL_CONSTANT_ALPHA", "GL_ONE_MINUS_CONSTANT_ALPHA", "GL_SRC_ALPHA_SATURATE"),
)
EQUATIONS = (*("GL_FUNC_ADD", "GL_FUNC_SUBTRACT", "GL_FUNC_REVERSE_SUBTRACT", "GL_MIN", "GL_MAX"),)
LOGIC = (
    *("GL_CLEAR", "GL_AND", "GL_AND_REVERSE", "GL_COPY", "GL_AND_INVERTED", "GL_NOOP", "GL_XOR"),
    *("GL_OR", "GL_NOR", "GL_EQUIV", "GL_INVERT", "GL_OR_REVERSE", "GL_COPY_INVERTED"),
    *("GL_OR_INVERTED", "GL_NAND", "GL_SET"),
)
MODES = ("GL_MODULATE", "GL_DECAL", "GL_BLEND", "GL_REPLACE", "GL_ADD", "GL_COMBINE")


@dataclass(frozen=True)
class Blend:
    """How a fragment is mixed with the framebuffer, as OpenGL's state has it now."""

    logic: str
    factors: tuple[str, str, str, str] | None  # source and destination, of RGB and of alpha
    equations: tuple[str, str]
    constant: np.ndarray
    mask: tuple[bool, bool, bool, bool]

    @classmethod
    def now(cls) -> "Blend":
        """Read the state."""
        names = ("SRC_RGB", "DST_RGB", "SRC_ALPHA", "DST_ALPHA")
        sources = [token(number(f"GL_BLEND_{name}"), FACTORS) for name in names]
        blend = enabled("GL_BLEND")
        red, green, blue, alpha = (bool(bit) for bit in np.ravel(number("GL_COLOR_WRITEMASK")))
        return cls(
            token(number("GL_LOGIC_OP_MODE"), LOGIC) if enabled("GL_COLOR_LOGIC_OP") else "",
            (sources[0], sources[1], sources[2], sources[3]) if blend else None,
            (
                token(number("GL_BLEND_EQUATION_RGB"), EQUATIONS),
                token(number("GL_BLEND_EQUATION_ALPHA"), EQUATIONS),
            ),
            np.array(number("GL_BLEND_COLOR")),
            (red, green, blue, alpha),
        )

    def mix(self, source: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, str]:
        """Return the colour that results, float64 (4,), and how, as text; both are from 0 to 1.

        A framebuffer of 8 bits rounds a fragment's colour before it mixes.
        """
        source = np.rint(np.clip(source, 0.0, 1.0) * 255) / 255
        if self.logic:
            result, text = self._combine_bits(source, before)
        elif self.factors is None:
            result, text = source, f"{colour(source)} replaces {colour(before)}"
        else:
            result, text = self._blend(source, before)
        result = np.clip(result, 0.0, 1.0)
        if not all(self.mask[:3]):
            written = "".join(name for name, on in zip("RGBA", self.mask, strict=True) if on)
            text += f", of which {written or 'nothing'} is written"
        result = np.where(self.mask, result, before)
        return result, f"{text} = {colour(result, 4)}"

    def _weights(self, k: int, source: np.ndarray, before: np.ndarray) -> np.ndarray:
        """Return the factors of the source (0) or of what was there (1), RGBA."""
        assert self.factors is not None
        return np.append(
            _factor(self.factors[k], source, before, self.constant)[:3],
            _factor(self.factors[k + 2], source, before, self.constant)[3],
        )

    def _blend(self, source: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, str]:
        first, second = (self._weights(k, source, before) for k in (0, 1))
        rgb, alpha = self.equations
        if rgb in ("GL_MIN", "GL_MAX"):
            least = np.minimum if rgb == "GL_MIN" else np.maximum
            return least(source, before), f"{rgb} of {colour(source)} and {colour(before)}"

        terms = first * source, second * before
        result = COMBINED.get(rgb, np.add)(*terms)
        result[3] = COMBINED.get(alpha, np.add)(*terms)[3]

        sides = [
            f"{_weight(weight)} x {colour(value)}"
            for weight, value in ((first, source), (second, before))
        ]
        if rgb == "GL_FUNC_REVERSE_SUBTRACT":
            sides.reverse()
        return result, (" + " if rgb == "GL_FUNC_ADD" else " - ").join(sides)

    def _combine_bits(self, source: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, str]:
        s, d = (np.rint(np.clip(each, 0, 1) * 255).astype(np.uint8) for each in (source, before))

        results = {
            "GL_CLEAR": s * 0,
            "GL_SET": s * 0 + 255,
            "GL_COPY": s,
            "GL_COPY_INVERTED": ~s,
            "GL_NOOP": d,
            "GL_INVERT": ~d,
            "GL_AND": s & d,
            "GL_NAND": ~(s & d),
            "GL_OR": s | d,
            "GL_NOR": ~(s | d),
            "GL_XOR": s ^ d,
            "GL_EQUIV": ~(s ^ d),
            "GL_AND_REVERSE": s & ~d,
            "GL_AND_INVERTED": ~s & d,
            "GL_OR_REVERSE": s | ~d,
            "GL_OR_INVERTED": ~s | d,
        }

        text = f"{self.logic} of the bits of {colour(source)} and {colour(before)}"
        return results[self.logic] / 255.0, text


def _factor(name: str, s: np.ndarray, d: np.ndarray, constant: np.ndarray) -> np.ndarray:
    """Return a blend factor for the four components."""
    name, less = name.removeprefix("GL_"), False
    if name.startswith("ONE_MINUS_"):
        name, less = name.removeprefix("ONE_MINUS_"), True
    values = {
        "ZERO": np.zeros(4),
        "ONE": np.ones(4),
        "SRC_COLOR": s,
        "DST_COLOR": d,
        "SRC_ALPHA": np.full(4, s[3]),
        "DST_ALPHA": np.full(4, d[3]),
        "CONSTANT_COLOR": constant,
        "CONSTANT_ALPHA": np.full(4, constant[3]),
        "SRC_ALPHA_SATURATE": np.array([*[min(s[3], 1 - d[3])] * 3, 1.0]),
    }
    return 1.0 - values[name] if less else values[name]


def _weight(values: np.ndarray) -> str:
    """Write a factor: one number where red, green and blue have the same."""
    return f"{values[0]:.3f}" if np.ptp(values[:3]) < 5e-4 else colour(values)


def fogged(before: np.ndarray, after: np.ndarray, fog: np.ndarray) -> tuple[float, str]:
    """Return how much of a colour the fog leaves, and that as text."""
    distance = before[:3] - fog[:3]
    most = int(np.argmax(np.abs(distance)))
    if abs(distance[most]) < 1e-4:
        return 1.0, f"fog has this colour already {colour(after)}"
    left = float(np.clip((after[most] - fog[most]) / distance[most], 0.0, 1.0))
    text = f"fog: {left:.3f} x {colour(before)} + {1 - left:.3f} x {colour(fog)}"
    return left, f"{text} = {colour(after)}"
