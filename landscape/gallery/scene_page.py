"""A scene's own page of the gallery: its views, and its safeguards in pairs, without and with.

Between them may stand other pictures of the views, such as a frame's passes. `landscape figures
hall` draws the pictures; they lie in screenshots/hall, as WebP.
"""

import shlex
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from framelens.base.texts import Translator, translator
from landscape.gallery.panels import FigurePanel, PanelRenderer, as_option, as_text
from landscape.gallery.scene_captions import INTRODUCTIONS, PAIRS_TEXT, STEPS, VIEW_TEXTS, Step
from landscape.scene.scene import Scene, View, scene

# Chosen: pixels of the pictures of views, of steps, and in pairs.
VIEW_SIZE = (960, 540)
STEP_SIZE = (640, 360)
PAIR_SIZE = (480, 300)


def panels(kind: Scene) -> list[FigurePanel]:
    """Return the panels of a scene's views that have a caption, of steps, then two for each fix."""
    found = [_view_panel(kind, kind.views[name]) for name in VIEW_TEXTS[kind.name]]
    for _heading, _text, steps in STEPS.get(kind.name, ()):
        found += [_step_panel(kind, step) for step in steps]
    return found + [_fix_panel(kind, fix, after) for fix in kind.fixes for after in (False, True)]


def _view_panel(kind: Scene, view: View) -> FigurePanel:
    size = "{}x{}".format(*VIEW_SIZE)

    def draw(renderer: PanelRenderer) -> np.ndarray:
        return renderer.scene_picture(kind.name, view.name, {}, None, VIEW_SIZE)

    seen, look = VIEW_TEXTS[kind.name][view.name]
    command = f"landscape render {view.name} --size {size}"
    return FigurePanel(view.name, view.shows, seen, look, command, draw)


def _step_panel(kind: Scene, step: Step) -> FigurePanel:
    only = step.only or None
    command = ["landscape", "render", step.view, "--size", "{}x{}".format(*STEP_SIZE)]
    command += ["--only", ",".join(only)] if only else []
    for key, value in step.settings.items():
        command += ["--set", f"{key}={as_text(value)}"]

    def draw(renderer: PanelRenderer) -> np.ndarray:
        return renderer.scene_picture(kind.name, step.view, step.settings, None, STEP_SIZE, only)

    return FigurePanel(step.name, step.title, step.seen, step.look, shlex.join(command), draw)


def _fix_panel(kind: Scene, fix: Any, after: bool) -> FigurePanel:
    settings: Mapping[str, object] = fix.settings(after)
    pose = fix.pose(after)
    only = fix.as_view().shown
    command = ["landscape", "render", "--scene", kind.name, as_option(pose)]
    command += ["--size", "{}x{}".format(*PAIR_SIZE), "--kt", f"{fix.kt:g}"]
    hidden = [name for name in kind.elements if name not in only]
    command += ["--only", ",".join(only)] if hidden else []
    for key, value in settings.items():
        command += ["--set", f"{key}={as_text(value)}"]

    def draw(renderer: PanelRenderer) -> np.ndarray:
        return renderer.scene_picture(kind.name, pose, settings, fix.kt, PAIR_SIZE, only)

    when = "after" if after else "before"
    name = f"{fix.name}_{when}"
    title = f"{fix.title}: {when}"
    drawn_by = shlex.join(command)
    return FigurePanel(name, title, fix.seen[after], fix.look, drawn_by, draw)


def page(name: str, language: str = "en") -> str:
    """Return a scene's page in a language."""
    _ = translator(language, "gallery", "fixes")
    kind = scene(name)
    by_name = {panel.name: panel for panel in panels(kind)}
    lines = introduced(INTRODUCTIONS[name], language, _)
    for view in VIEW_TEXTS[name]:
        lines += view_entry(by_name[view], _)
    for heading, text, steps in STEPS.get(name, ()):
        lines += [f"## {_(heading)}", "", _(text), ""]
        for step in steps:
            lines += view_entry(by_name[step.name], _, level="###")

    lines += [f"## {_('Safeguards, off and on')}", "", _(PAIRS_TEXT), ""]
    for fix in kind.fixes:
        lines += pair_entry(fix, by_name[f"{fix.name}_before"], by_name[f"{fix.name}_after"], _)
    return "\n".join(lines)


def introduced(texts: Sequence[str], language: str, _: Translator) -> list[str]:
    """Return the lines with which a page begins: its title, the other language, and paragraphs."""
    title, *introduction = texts
    other = "[Français](README.fr.md)" if language == "en" else "[English](README.md)"
    lines = [f"# {_(title)}", "", other, ""]
    for paragraph in introduction:
        lines += [_(paragraph), ""]
    return lines


def view_entry(panel: FigurePanel, _: Translator, level: str = "##") -> list[str]:
    """Return the lines of one picture: its title, itself, what to look at, and its command."""
    return [
        f"{level} {panel.name}",
        "",
        _("**{name}**: {title}.").format(name=panel.name, title=_(panel.title)),
        "",
        f"![{_(panel.seen)}]({panel.name}.webp)",
        "",
        _(panel.look),
        "",
        f"    {panel.command}",
        "",
    ]


def pair_entry(fix: Any, before: FigurePanel, after: FigurePanel, _: Translator) -> list[str]:
    """Return the lines of a fix: the flaw, both pictures, what to look at, and how it is done."""
    return [
        f"### {fix.name}",
        "",
        f"**{_(fix.title, fix.name)}.** {_(fix.flaw)}",
        "",
        f"| {_('without')} | {_('with')} |",
        "|---|---|",
        f"| ![{_(before.seen)}]({before.name}.webp) | ![{_(after.seen)}]({after.name}.webp) |",
        "",
        _(fix.look),
        "",
        _("How: {how}").format(how=_(fix.how)),
        "",
        f"    {before.command}",
        f"    {after.command}",
        "",
    ]
