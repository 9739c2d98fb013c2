"""The texts of the inspector, by key. The translations are in locale/LANGUAGE/inspector.po."""

from framelens.base.texts import Texts, Wording

TEXTS: Texts = {
    "inspector.title": "Inspector",
    "inspector.stopped": "stopped",
    "inspector.going": "live, listed 4 times a second",
    "inspector.calls": "{count} calls",
    "inspector.calls.one": "{count} call",
    "inspector.frame": "frame {number}",
    "inspector.edits": "{count} edits",
    "inspector.edits.one": "{count} edit",
    "inspector.pixel": "What happened to pixel {x}, {y}",
    "inspector.about_pass": "{name}: a pass of {count} calls. Right opens it.",
    "inspector.about_pass.one": "{name}: a pass of {count} call. Right opens it.",
    "inspector.about_element": "{name}: {count} calls. Right opens them.",
    "inspector.about_element.one": "{name}: {count} call. Right opens it.",
    "inspector.left_out": "left out",
    "inspector.redundant": "= redundant: it sets what is set already",
    "inspector.from_to": "from {low} to {high}",
    "inspector.from": "from {low}",
    "inspector.under": "In the cross-hair: {element}, {call}. O shows every draw there",
    "inspector.needed": "the program needs this call to go on",
    "inspector.nothing": "nothing was changed yet",
    "saved": "{name} saved",
    "inspector.not_saved": "the edits could not be saved here",
    "inspector.keys": "Up Down: row. Right Left: open, close. Tab: value. + - or drag: change, "
    "with Ctrl finely. Del: call off, on. Ctrl+Z: undo. Backspace: undo here, with Ctrl all. "
    "Ctrl+S: save. Space: stop, go on. {pixel}: pixel in the middle, or click one. "
    "F1: why it looks so, with Shift the picture. {letter}: close",
    "inspector.keys_few": "Tab: value. + - or drag: change. Del: off, on. Ctrl+Z: undo. "
    "Ctrl+S: save. Space: go on. {letter}: close",
    "inspector.keys_pixel": "Up Down: draw. Enter or Left: its call in the frame. "
    "{pixel}: pixel in the middle, or click one. F1: why it looks so. {letter}: close",
    "inspector.drawn": "drawn",
    "inspector.clip": "clip",
    "inspector.scissor": "scissor",
    "inspector.alpha": "alpha",
    "inspector.stencil": "stencil",
    "inspector.depth": "depth",
    "inspector.masked": "masked",
    "inspector.depth_value": "depth",
}

WORDING = Wording(TEXTS, "inspector")
text = WORDING.text
counted = WORDING.counted
