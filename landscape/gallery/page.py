"""The gallery as Markdown, in each language: the report's figures, then the fixes in pairs."""

import re
from dataclasses import dataclass

from framelens.base.texts import Phrases, Translator, translator
from landscape.gallery.panels import FigurePanel, panels
from landscape.island.fixes import FIXES, Fix

CODE = "../landscape"  # from the page's folder

INTRODUCTION = (
    "# The figures of 2006, and the fixes",
    "",
    "[Français](README.fr.md)",
    "",
    "[landscape](../README.md) is a Python program that draws an island with classic"
    " fixed-function OpenGL, without shaders, and lets you walk around it. It follows a student's"
    " report of December 2006, Damien Rohmer's *TP OpenGL: Rendu de paysage naturel* (CPE Lyon),"
    " which explains its techniques one by one in 43 figures.",
    "",
    "This page shows those figures again: 87 pictures, made with our own images and meshes"
    " instead of the borrowed ones of 2006. The fixes follow: for each improvement that the"
    " report suggests, and for a few more, one picture before and one after.",
    "",
    "**Terms.**",
    "",
    "- *Preset*: a complete set of values for the program's settings. `2006` has the report's"
    " numbers and its flaws; `best` turns on nearly all fixes and has many more trees and"
    f" blades of grass ([settings]({CODE}/elements/settings/presets.py) has both). The pictures"
    " on this page use `2006`. Whatever else a picture needs, such as a wider lens or thinner fog,"
    f" is set by its view ([views.py]({CODE}/island/views.py)) or in its command.",
    f"- *R1* to *R19*: the improvements that the report suggests, in our numbering"
    f" ([report_fixes.py]({CODE}/island/report_fixes.py))."
    " *best1* to *best5*: what the preset `best` adds"
    f" to them ([best_fixes.py]({CODE}/island/best_fixes.py)), and *stencil* a safeguard of the"
    " reflection.",
    "- *fig17b*: figure 17, panel b; also the name of the view, as in `landscape render fig17b`.",
    "- *Billboard*: a textured rectangle that turns to face the viewer. *Crossed quads*: two"
    " textured rectangles that cross each other and do not turn. *Alpha*: the opacity of a texel"
    " or a vertex. *Texture unit*: holds one texture; with several units, one pass combines"
    " several textures. *kt*: the animation counter, 30 per second. *Unit*: of length, about"
    " 17 m; the walker's eye is 0.1 units above the ground.",
    "",
    "The command under a picture draws it, and needs no screen. `landscape figures --check`"
    " compares all pictures with what the program draws today; `landscape figures --update`"
    " replaces those that differ, and rewrites this page.",
    "",
    "**Contents.**",
    "",
)

CONTENTS: Phrases = (
    "{part}: figures {first} to {last}",
    "{part}: figure {first}",
    "{part}: {fixes}",
)


@dataclass(frozen=True)
class Part:
    """A part of the page: its heading, its first and last figure, and its introduction."""

    heading: str
    first: int
    last: int
    text: str


PARTS = (
    Part(
        "The ground",
        1,
        5,
        "A height image becomes a triangle mesh with two textures "
        f"([ground.py]({CODE}/elements/ground.py)).",
    ),
    Part(
        "The water",
        6,
        11,
        f"The mirror image of the land ([reflection.py]({CODE}/elements/reflection.py)), seen "
        "through a blended, animated plane "
        f"([water_surface.py]({CODE}/elements/water_surface.py)).",
    ),
    Part(
        "The sky",
        12,
        14,
        f"Five textures on the inside of a box ([sky_box.py]({CODE}/elements/sky_box.py)).",
    ),
    Part(
        "Trees and deer",
        15,
        18,
        "Flat sprites that face the viewer, sorted from far to near "
        f"([transparent_elements.py]({CODE}/elements/transparent_elements.py)).",
    ),
    Part(
        "Plants and grass",
        19,
        22,
        "Two crossed quads for each plant "
        f"([transparent_elements.py]({CODE}/elements/transparent_elements.py)), three triangles "
        f"for each blade of grass ([grass.py]({CODE}/elements/grass.py)).",
    ),
    Part(
        "The castle",
        23,
        25,
        f"Walls in blended layers, and animated flames ([castle.py]({CODE}/elements/castle.py)).",
    ),
    Part(
        "Rabbit and dragon",
        26,
        29,
        "Meshes loaded from files, and two ways to map a texture onto them "
        f"([rabbit.py]({CODE}/elements/rabbit.py), [dragon.py]({CODE}/elements/dragon.py)).",
    ),
    Part(
        "Sword, map and fog",
        30,
        34,
        f"Two overlays, fixed to the window ([sword.py]({CODE}/elements/sword.py), "
        f"[map.py]({CODE}/elements/map.py)), and the fog ([fog.py]({CODE}/elements/fog.py)).",
    ),
    Part(
        "All together",
        35,
        35,
        f"Nine views of the whole scene ([island.py]({CODE}/island/island.py)).",
    ),
    Part(
        "What is wrong",
        36,
        43,
        "The report ends with the flaws of its own pictures. These panels are meant to look "
        "wrong; each names its fix.",
    ),
)
FIXED = "What the report suggests"
ADDED = "Beyond the report"
FIXES_TEXT = {
    FIXED: "The left picture is drawn without the fix, the right one with it. Everything else is "
    "the same in both: the preset `2006`, with the settings in the commands. In the walk, N "
    "selects a fix and V turns it on or off.",
    ADDED: "The report does not mention these; they show what else its techniques can do. Again, "
    "the two pictures of a pair differ in nothing else.",
}


def page(language: str = "en") -> str:
    """Return the whole page in a language."""
    _ = translator(language, "gallery", "fixes")
    every = panels()
    lines = introduction(_)
    for part in PARTS:
        lines += [f"## {_(part.heading)}", "", _(part.text), ""]
        for figure in range(part.first, part.last + 1):
            lines += [f"### {_('Figure {number}').format(number=figure)}", ""]
            for panel in every:
                if panel.figure == str(figure):
                    lines += figure_entry(panel, _)

    by_name = {panel.name: panel for panel in every}
    heading = ""
    for fix in FIXES:
        wanted = FIXED if fix.name.startswith("R") else ADDED
        if wanted != heading:
            heading = wanted
            lines += [f"## {_(heading)}", "", _(FIXES_TEXT[heading]), ""]
        lines += fix_entry(fix, by_name[f"{fix.name}_before"], by_name[f"{fix.name}_after"], _)

    return "\n".join(lines)


def introduction(_: Translator) -> list[str]:
    """Return the lines before the first figure: what the page shows, terms, contents."""
    lines = [_(line) if line else "" for line in INTRODUCTION]
    for part in PARTS:
        line = _(CONTENTS[part.first == part.last])
        line = line.format(part=_link(_(part.heading)), first=part.first, last=part.last)
        lines.append(f"- {line}")
    for heading in (FIXED, ADDED):
        names = [fix.name for fix in FIXES if fix.name.startswith("R") == (heading == FIXED)]
        line = _(CONTENTS[2]).format(part=_link(_(heading)), fixes=", ".join(map(_link, names)))
        lines.append(f"- {line}")
    return [*lines, ""]


def _link(heading: str) -> str:
    """Return a link to a heading of the page."""
    return f"[{heading}](#{anchor(heading)})"


def figure_entry(panel: FigurePanel, _: Translator) -> list[str]:
    """Return the lines of one panel of a figure."""
    return [
        _("**{name}**: {title}.").format(name=panel.name, title=_(panel.title)),
        "",
        f"![{_(panel.seen)}]({panel.name}.png)",
        "",
        linked(_(panel.look), panel.figure),
        "",
        f"    {panel.command}",
        "",
    ]


def fix_entry(fix: Fix, before: FigurePanel, after: FigurePanel, _: Translator) -> list[str]:
    """Return the lines of one fix: the flaw, the two pictures side by side, and what changed."""
    return [
        f"### {fix.name}",
        "",
        f"**{_(fix.title, fix.name)}.** {linked(_(fix.flaw))}",
        "",
        f"| {_('before')} | {_('after')} |",
        "|---|---|",
        f"| ![{_(before.seen)}]({before.name}.png) | ![{_(after.seen)}]({after.name}.png) |",
        "",
        linked(_(fix.look)),
        "",
        linked(_("How: {how}").format(how=_(fix.how))),
        "",
        f"    {before.command}",
        f"    {after.command}",
        "",
    ]


def linked(text: str, figure: str = "") -> str:
    """Return a caption with the names of panels and fixes as links, except those of ``figure``."""

    def link(match: re.Match[str]) -> str:
        name, number = match.group(0), match.group(1)
        if number is None:
            return f"[{name}](#{anchor(name)})"
        return name if number == figure else f"[{name}](#figure-{number})"

    return re.sub(r"\bfig(\d+)[a-i]\b|\bR\d+[ab]?\b", link, text)


def anchor(heading: str) -> str:
    """Return the anchor GitHub gives a heading."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")
