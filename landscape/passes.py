"""Passes for compositing: how far away each pixel is, and which element it shows.

A frame is recorded, and drawn again element by element: a pixel belongs to the element that last
changed it. Passes are drawn without antialiasing: a pixel is of one element, and at one distance.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.output import png
from framelens.tape.strip import groups, shared_values, shots
from framelens.tape.tape import Tape
from landscape.files.png_strips import PngStrips
from landscape.offscreen import Offscreen, Place

FARTHEST = 65535  # the level of the far plane, and of what has no depth
ALSO = "frame"  # what clears and sets up, which is no element


def passes(
    view: Place, arguments: Mapping[str, Any], kt: float | None, wireframe: bool
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Return depths, uint16 (h, w), and masks by element, uint8 (h, w) of 0 and 255.

    A depth is the distance along the line of sight, linear, FARTHEST at ``camera.far``. Top row
    first. ``arguments`` are an Offscreen's.
    """
    with Offscreen(**{**arguments, "samples": 0}) as offscreen:
        with offscreen.taped(view, kt, wireframe) as tape:
            depth, owner, names = _layers(tape, offscreen.size)
        assert offscreen.scene is not None
        camera = offscreen.scene.settings.camera
        near, far = camera.near, max(camera.far, 2 * camera.near)
        away = near * far / (far - depth.astype(np.float64) * (far - near))
        level = np.rint(away / far * FARTHEST).astype(np.uint16)
    masks = {
        name: np.where(owner == k, np.uint8(255), np.uint8(0))
        for k, name in enumerate(names)
        if name != ALSO and (owner == k).any()
    }
    return level, masks


def _layers(tape: Tape, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Draw a frame element by element; return its depth buffer, float32 (h, w), and its elements.

    Of these, the second array has for each pixel the number of the last that changed it, or -1,
    and the list has their names.
    """
    parts = groups(tape, "element")
    found = shared_values(tape, parts, ("color",))
    before: np.ndarray | None = None
    depth = np.ones(size[::-1], np.float32)
    owner = np.full(size[::-1], -1)
    names: list[str] = []
    for shot in shots(tape, parts, ("color", "depth"), found):
        colours = shot.buffers["color"]
        if shot.group.aside or colours is None:
            continue
        if before is not None:
            name = next(iter(shot.group.elements), ALSO)
            if name not in names:
                names.append(name)
            owner[(colours != before).any(axis=2)] = names.index(name)
        before = colours.copy()
        levels = shot.buffers["depth"]
        depth = depth if levels is None else levels.copy()
    return depth, owner, names


def files(picture: Path, depth: np.ndarray, masks: Mapping[str, np.ndarray]) -> dict[Path, bytes]:
    """Return the files of passes beside that of their picture: NAME.depth.png, NAME.ELEMENT.png."""
    pieces: list[bytes] = []
    writer = PngStrips(pieces.append, (depth.shape[1], depth.shape[0]), grey16=True)
    writer.add(depth)
    writer.finish()
    found = {picture.with_suffix(".depth.png"): b"".join(pieces)}
    for name, mask in masks.items():
        found[picture.with_suffix(f".{name}.png")] = png(mask)
    return found
