"""The page of the software fly-over: pictures of flights, and its techniques in pairs.

`landscape figures flyover` draws the pictures; they lie in screenshots/flyover, as WebP. No OpenGL
is needed.
"""

import shlex
from functools import cache

import numpy as np

from framelens.base.texts import translator
from landscape.flyover import frame
from landscape.flyover.environment import Environment, open_environment
from landscape.flyover.settings import BEST, PRESETS, Settings
from landscape.gallery.flyover_captions import (
    INTRODUCTION,
    PAIRS,
    PAIRS_HEADING,
    PAIRS_TEXT,
    STEPS,
    STEPS_HEADING,
    STEPS_TEXT,
    VIEWS,
    Pair,
    Shot,
)
from landscape.gallery.panels import FigurePanel, PanelRenderer, as_text
from landscape.gallery.scene_page import (
    PAIR_SIZE,
    STEP_SIZE,
    VIEW_SIZE,
    introduced,
    pair_entry,
    view_entry,
)
from landscape.settings.declare import preset, with_settings

NAME = "flyover"  # of its folder in screenshots, and for `landscape figures`


def panels() -> list[FigurePanel]:
    """Return the panels of the environments, of the steps, then two for each technique."""
    found = [_shot_panel(shot, VIEW_SIZE) for shot in VIEWS]
    found += [_shot_panel(shot, STEP_SIZE) for shot in STEPS]
    return found + [_shot_panel(half(pair, on), PAIR_SIZE) for pair in PAIRS for on in (0, 1)]


def half(pair: Pair, on: int) -> Shot:
    """Return one picture of a pair: without its technique, or ``on``."""
    name = f"{pair.name}_{('before', 'after')[on]}"
    settings = {**pair.settings, pair.key: bool(on)}
    seen, look = pair.seen[on], pair.look
    return Shot(name, pair.environment, pair.at, pair.title, seen, look, settings)


def _shot_panel(shot: Shot, size: tuple[int, int]) -> FigurePanel:
    words = ["landscape", "flyover", shot.environment, "--at", f"{shot.at:g}"]
    words += ["--size", "{}x{}".format(*size)]
    words += ["--preset", shot.preset] if shot.preset != BEST else []
    for key, value in shot.settings.items():
        words += ["--set", f"{key}={as_text(value)}"]
    command = shlex.join([*words, "--out", f"{shot.name}.png"])

    def draw(_renderer: PanelRenderer) -> np.ndarray:
        return picture(shot, size)

    return FigurePanel(shot.name, shot.title, shot.seen, shot.look, command, draw)


def picture(shot: Shot, size: tuple[int, int]) -> np.ndarray:
    """Draw a moment of a flight, uint8 (height, width, 3)."""
    values = with_settings(preset(Settings(), PRESETS, shot.preset), shot.settings)
    environment = _environment(shot.environment)
    terrain = environment.field(values.flyover)
    camera = environment.flight(terrain, values.flyover).camera(shot.at)
    return frame.draw(terrain, camera, values, size).picture


@cache
def _environment(name: str) -> Environment:
    return open_environment(name)


def page(language: str = "en") -> str:
    """Return the page in a language."""
    _ = translator(language, "gallery")
    by_name = {panel.name: panel for panel in panels()}
    lines = introduced(INTRODUCTION, language, _)
    for shot in VIEWS:
        lines += view_entry(by_name[shot.name], _)
    lines += [f"## {_(STEPS_HEADING)}", "", _(STEPS_TEXT), ""]
    for shot in STEPS:
        lines += view_entry(by_name[shot.name], _, level="###")
    lines += [f"## {_(PAIRS_HEADING)}", "", _(PAIRS_TEXT), ""]
    for pair in PAIRS:
        before, after = (by_name[half(pair, on).name] for on in (0, 1))
        lines += pair_entry(pair, before, after, _)
    return "\n".join(lines)
