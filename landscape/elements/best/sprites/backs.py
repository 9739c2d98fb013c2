"""A deer from above, made from its picture from the side (section 11.2.1). No OpenGL here.

A tree from above is a fan of its side view laid around the trunk; a deer is not round. Its body is
what remains of the side view when legs and antlers, which are thin, are taken away. Each column of
it becomes a row across the body: as wide as the body is deep there, with the back in the middle and
the flanks at both ends. Antlers spread outwards as they rise.
"""

import numpy as np
from PIL import Image, ImageFilter

SIDE = 192  # chosen: texels of the side view that is looked at; twice those of the result's quality
THIN = 17  # chosen: what is thinner than this many of them is a leg or an antler
NARROW = 0.34  # chosen: half a body's width, times its depth
FLANK = 0.62  # chosen: how far down the flank is seen at the body's edge, of its depth
NECK = 0.62  # chosen: the width of neck and head, times that of a trunk of the same depth
DARKER = 0.4  # chosen: how much darker the flank is at the edge
SPREAD = 0.62  # chosen: how far an antler's end is from the middle, times its height
SOFT = 4  # texels along the body over which its outline is smoothed


def back_from_above(image: np.ndarray, side: int) -> np.ndarray:
    """Return the picture (side, side, 4) of a deer from above; ``image`` (h, w, 4) is a side view.

    The body lies along the middle row, the head where it is in the side view.
    """
    view = np.asarray(Image.fromarray(image).resize((SIDE, SIDE), Image.Resampling.LANCZOS))
    solid = Image.fromarray(np.where(view[..., 3] > 127, 255, 0).astype(np.uint8))
    kept = solid.filter(ImageFilter.MinFilter(THIN)).filter(ImageFilter.MaxFilter(THIN))
    body = np.asarray(kept) > 0
    out = np.zeros((SIDE, SIDE, 4), np.uint8)
    columns = np.flatnonzero(body.any(axis=0))
    if len(columns):
        _lay_body(out, view, body, columns)
        _lay_antlers(out, view, body, columns)
    return np.asarray(Image.fromarray(out).resize((side, side), Image.Resampling.LANCZOS))


def _lay_body(out: np.ndarray, view: np.ndarray, body: np.ndarray, columns: np.ndarray) -> None:
    """Paint the body into ``out``; ``columns`` (n,) are those that it has."""
    top = body.argmax(axis=0)[columns]
    depth = body.sum(axis=0)[columns]
    trunk = np.median(top)
    deep = np.minimum(depth, np.median(depth))
    half = NARROW * deep * np.where(top < trunk - 0.04 * SIDE, NECK, 1.0)
    padded = np.pad(half, SOFT, mode="edge")
    half = np.convolve(padded, np.full(2 * SOFT + 1, 1.0 / (2 * SOFT + 1)), mode="valid")

    # Round ends: the muzzle and the rump.
    end = np.minimum(np.arange(len(half)), np.arange(len(half))[::-1]) + 1.0
    half = np.minimum(half, np.sqrt(end * (2.0 * half.mean())))
    across = (np.arange(SIDE) + 0.5 - SIDE / 2)[:, None] / half
    inside = np.abs(across) <= 1.0
    rows = top + np.abs(across).clip(0.0, 1.0) ** 1.5 * FLANK * deep
    picked = view[rows.astype(int).clip(0, SIDE - 1), columns]

    # The back is flat, and the flanks fall away from the light above.
    picked[..., :3] = (
        picked[..., :3] * (1.0 - DARKER * np.abs(across).clip(0.0, 1.0) ** 2)[..., None]
    )
    picked[..., 3] = 255
    out[:, columns] = np.where(inside[..., None], picked, out[:, columns])


def _lay_antlers(out: np.ndarray, view: np.ndarray, body: np.ndarray, columns: np.ndarray) -> None:
    """Paint what rises above the body, antlers and ears, into ``out`` on both sides."""
    head = columns[body[:, columns].argmax(axis=0).argmin()]
    crown = int(body[:, head].argmax())
    row, column = np.nonzero(view[:crown, :, 3] > 127)
    for sign in (-1.0, 1.0):
        aside = sign * (2.0 + SPREAD * (crown - row))
        out[(SIDE / 2 + aside).astype(int).clip(0, SIDE - 1), column] = view[row, column]
