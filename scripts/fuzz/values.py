"""Odd words, and values of settings and numbers as text: what other inputs are made of."""

import random

from landscape.scene.scene import scene
from landscape.settings import declare

WORDS = [
    *["", " ", "-", "--", "-1", "0", "1", "7", "1e9", "nan", "inf", "-inf", "1e400", "9" * 400],
    *["²", "fig35a", "fig2a", "fig99z", "R6", "35", "island", "best", "2006", "osmesa", "metal"],
    *["é山", "ground", "ground,water", "cows", "a=b", "fog.density=0.1", "a\nb", "\x1b[31m"],
    *["x" * 300],
    *["in.toml", "in.png", "in.ply", "missing", ".", "..", "/", "/dev/null", "/proc/self/mem", "~"],
    *["%s", "{}", "$HOME", "*", "'", '"', "\\", "\udcff", "\u202e", "640x480", "1,2,3,4,5"],
]

FIELDS = declare.fields(type(scene().settings))
# Large values of these take long, as they should; what matters is tested below a bound.
COSTLY = {"grass.count": 300_000, "trees.count": 5000, "plants.count": 5000, "deer.count": 5000}
COSTLY |= {"ground.resolution": 300, "ground.texture_size": 1024, "grass.radius": 30}


def setting(rng: random.Random) -> str:
    """Return KEY=VALUE, within its limits or beyond."""
    key = rng.choice(list(FIELDS))
    return f"{key}={value(rng, key)}"


def value(rng: random.Random, key: str) -> str:
    """Return a value of a setting as text: usual, at a limit, beyond it, or none at all."""
    item = FIELDS[key]
    default = item.default
    if rng.random() < 0.05:
        return rng.choice(WORDS)
    if isinstance(default, bool):
        return rng.choice(["true", "false"] * 4 + ["on", "0", "2", "maybe"])
    if isinstance(default, str):
        return rng.choice([*item.choices, default, default, "missing.png"])
    count = len(default) if isinstance(default, tuple) else 1
    low, highest = item.limits
    high = min(highest, COSTLY.get(key, highest))
    values = []
    for _ in range(count):
        beyond = rng.choice([low - 1, highest * 2 + 1]) if rng.random() < 0.1 else low
        number = rng.choice([beyond, high, *(rng.uniform(low, high) for _ in range(4))])
        values.append(str(int(number)) if isinstance(default, int) else repr(float(number)))
    return ",".join(values)


def number(rng: random.Random) -> str:
    """Return a number as text, perhaps an odd one."""
    odd = ["0", "-0", "nan", "inf", "1e9", "1e8", "-1e8", "1e-320", "ground", "", "x", "1_0", "٣"]
    plain = [f"{rng.uniform(-50, 50):.3f}", str(rng.randint(-400, 400)), f"{rng.uniform(0, 40)}"]
    return rng.choice(plain * 4 + odd)
