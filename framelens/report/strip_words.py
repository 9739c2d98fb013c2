"""A strip's texts. The translations are in locale/LANGUAGE/strip.po."""

from framelens.base.texts import Texts, translator

TEXTS: Texts = {
    "title": "{name}: a frame growing",
    "intro": "{width} × {height} pixels, {calls}, {draws}; {steps}",
    "steps.pass": "a picture for each pass",
    "steps.element": "a picture for each element, in the order in which they draw",
    "steps.draw": "a picture for each draw call, with its number in the trace",
    "calls": "{n} calls",
    "calls.one": "{n} call",
    "listed": "{n} more in display lists",
    "changed": "changes {percent}\u00a0% of the pixels",
    "hardly": "changes less than {percent}\u00a0% of the pixels",
    "unchanged": "changes no pixel's colour",
    "draws": "{n} draws",
    "draws.one": "{n} draw",
    "vertices": "{n} vertices",
    "vertices.one": "{n} vertex",
    "clear": "clear",
    "in_pass": "{element} ({pass_})",
    "aside": "into framebuffer object {target}",
    "layers": "{mean} layers per pixel, at most {most}",
    "color": "colour",
    "depth": "depth",
    "stencil": "stencil",
    "overdraw": "overdraw",
    "between": "; ",
    "legend.depth": "Depth, as distance from the eye in units of the scene (logarithmic)",
    "legend.window_depth": "Depth, as in the depth buffer",
    "legend.stencil": "Stencil values",
    "legend.overdraw": "Overdraw: fragments that passed all tests",
    "nothing": "nothing",
    "more": "{n} more values",
    "or_more": "{n} or more",
    "lacking": "no such buffer",
    "uncounted": "not counted here",
    "number": "Number",
    "code": "Call",
    "source": "Line of code",
    "rest": "{n} more; `landscape trace` prints all",
    "contents": "Steps",
    "calls.part": "{pass_}: {element} ({calls})",
    "pixel": "Pixel {x}, {y} of {name}",
    "pixel.nothing": "Nothing was drawn there.",
    "pixel.outcome": "Outcome",
    "pixel.arithmetic": "Arithmetic",
    "pixel.after": "Then",
    "outcome.drawn": "drawn",
    "outcome.clip": "clipped",
    "outcome.scissor": "cut by the scissor test",
    "outcome.alpha": "failed the alpha test",
    "outcome.stencil": "failed the stencil test",
    "outcome.depth": "failed the depth test",
    "outcome.masked": "masked",
    "alt": "{what} after step {number}, {title}",
}


def text(language: str, key: str, **words: object) -> str:
    """Return a text in a language, else in English; ``words`` fill its {placeholders}."""
    return translator(language, "strip")(TEXTS[key], key).format(**words)


def counted(language: str, key: str, n: int) -> str:
    """Return a number of things: "1 call", "336 calls"."""
    # In French 0 is singular, too.
    single = n == 1 or (language == "fr" and n == 0)
    return text(language, f"{key}.one" if single else key, n=number(language, n))


def number(language: str, n: float, digits: int = 0) -> str:
    """Return a number as the language writes it: 1,234.5 or 1 234,5."""
    written = f"{n:,.{digits}f}"
    if language == "fr":
        written = written.replace(",", "\u202f").replace(".", ",")
    return written
