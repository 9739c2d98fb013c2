"""The report's figures and the fixes, a page for each scene with captions, and the fly-over's.

Their texts are the gallery's; each fix has a slider between its two pictures.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from framelens.base.texts import translator
from landscape.gallery import flyover_captions as captions
from landscape.gallery import flyover_page, scene_page
from landscape.gallery.page import ADDED, FIXED, FIXES_TEXT, PARTS, anchor
from landscape.gallery.panels import FigurePanel, panels
from landscape.gallery.scene_captions import INTRODUCTIONS, PAIRS_TEXT, STEPS, VIEW_TEXTS
from landscape.island.fixes import FIXES
from landscape.scene.scene import scene

KEPT = Path(__file__).resolve().parents[2] / "screenshots"


def pictures() -> Iterator[Path]:
    """Yield the committed pictures that the pages show."""
    for pattern in ("*.png", "best_*.jpg"):
        yield from sorted(KEPT.glob(pattern))
    for name in VIEW_TEXTS:
        for panel in scene_page.panels(scene(name)):
            yield KEPT / name / f"{panel.name}.webp"
    for panel in flyover_page.panels():
        yield KEPT / flyover_page.NAME / f"{panel.name}.webp"


def pages(language: str) -> dict[str, str]:
    """Return the pages by name.

    They are a list, a page for each part of the report, the fixes, and the pages of scenes and of
    the fly-over.
    """
    _ = translator(language, "site", "gallery")
    every = panels()
    names = [anchor(part.heading) for part in PARTS]
    front = [
        f"# {_('The figures of 2006, and the fixes')}",
        _(
            "A student's report of December 2006, Damien Rohmer's *TP OpenGL: Rendu de paysage "
            "naturel* (CPE Lyon), explains in 43 figures how a handful of simple techniques make a "
            "landscape. Here they are again, drawn with our own images and meshes."
        ),
        "```{toctree}\n:maxdepth: 1\n\n" + "\n".join([*names, "fixes"]) + "\n```",
    ]
    found = {"figures/index": "\n\n".join(front) + "\n"}
    for part, name in zip(PARTS, names, strict=True):
        lines = [f"# {_(part.heading)}", _plain(_(part.text))]
        for number in range(part.first, part.last + 1):
            lines.append(f"## {_('Figure {number}').format(number=number)}")
            for panel in every:
                if panel.figure == str(number):
                    lines += _figure(panel, language)
        found[f"figures/{name}"] = "\n\n".join(lines) + "\n"

    found["figures/fixes"] = _fixes({panel.name: panel for panel in every}, language)
    found[f"{flyover_page.NAME}/index"] = _flyover(language)
    return {**found, **{f"{name}/index": _scene(name, language) for name in VIEW_TEXTS}}


def _scene(name: str, language: str) -> str:
    _ = translator(language, "site", "gallery")
    kind = scene(name)
    panels = {panel.name: panel for panel in scene_page.panels(kind)}
    title, *introduction = INTRODUCTIONS[name]
    lines = [f"# {_(title)}", *(_plain(_(text)) for text in introduction)]
    for view in VIEW_TEXTS[name]:
        lines += _figure(panels[view], language)
    for heading, text, steps in STEPS.get(name, ()):
        lines += [f"## {_(heading)}", _(text)]
        for step in steps:
            lines += _figure(panels[step.name], language)
    lines += [f"## {_('Safeguards, off and on')}", _(PAIRS_TEXT)]
    for fix in kind.fixes:
        lines += _fix(fix, panels, language)
    return "\n\n".join(lines) + "\n"


def _flyover(language: str) -> str:
    _ = translator(language, "site", "gallery")
    said = captions
    panels = {panel.name: panel for panel in flyover_page.panels()}
    title, *introduction = said.INTRODUCTION
    lines = [f"# {_(title)}", *(_plain(_(text)) for text in introduction)]
    for shot in said.VIEWS:
        lines += _figure(panels[shot.name], language)
    lines += [f"## {_(said.STEPS_HEADING)}", _(said.STEPS_TEXT)]
    for shot in said.STEPS:
        lines += _figure(panels[shot.name], language)
    lines += [f"## {_(said.PAIRS_HEADING)}", _plain(_(said.PAIRS_TEXT))]
    for pair in said.PAIRS:
        lines += _fix(pair, panels, language)
    return "\n\n".join(lines) + "\n"


def _figure(panel: FigurePanel, language: str) -> list[str]:
    _ = translator(language, "site", "gallery")
    caption = _("{name}: {text}").format(name=panel.name, text=_(panel.title))
    return [
        f"```{{figure}} ../pictures/{panel.name}.webp\n:alt: {_(panel.seen)}\n"
        f":name: {panel.name}\n\n{caption}\n```",
        _plain(_(panel.look)),
        f"    {panel.command}",
    ]


def _fixes(panels: dict[str, FigurePanel], language: str) -> str:
    _ = translator(language, "site", "gallery")
    lines = [f"# {_('The fixes')}"]
    heading = ""
    for fix in FIXES:
        wanted = FIXED if fix.name.startswith("R") else ADDED
        if wanted != heading:
            heading = wanted
            lines += [f"## {_(heading)}", _plain(_(FIXES_TEXT[heading]))]
        lines += _fix(fix, panels, language)
    return "\n\n".join(lines) + "\n"


def _fix(fix: Any, panels: dict[str, FigurePanel], language: str) -> list[str]:
    _ = translator(language, "site", "gallery", "fixes")
    title = _("{name}: {text}").format(name=fix.name, text=_(fix.title, fix.name))
    before, after = panels[f"{fix.name}_before"], panels[f"{fix.name}_after"]
    return [
        f"### {title}",
        _plain(_(fix.flaw)),
        f"```{{before-after}} ../pictures/{before.name}.webp ../pictures/{after.name}.webp\n"
        f":before: {_(before.seen)}\n:after: {_(after.seen)}\n:label: {_('before and after')}\n```",
        _plain(_(fix.look)),
        _plain(_("How: {how}").format(how=_(fix.how))),
        f"    {before.command}\n    {after.command}",
    ]


def _plain(text: str) -> str:
    """Return a text whose links into the code are code, and those into docs/ lead to pages."""
    text = re.sub(r"\((?:\.\./)+docs/(\w+\.md)(#[\w-]+)?\)", r"(../documents/\1)", text)
    return re.sub(r"\[([^\]]+)\]\(\.\./(?!documents)[^)]*\)", r"`\1`", text)
