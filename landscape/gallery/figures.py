"""The report's figures, panel by panel, made again; and a page that shows them all.

A panel is an asset shown as it is, or a named view rendered with its own switches. Beside them
stand the fixes: pairs of pictures, before and after, for each remedy of the report's discussion.
"""

import re
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from landscape.errors import InputError
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.files.output import save_png, write_whole
from landscape.files.progress import Progress
from landscape.gallery.captions import (
    ADDED,
    ASSET_PANELS,
    FIXED,
    FIXES_TEXT,
    INTRODUCTION,
    PARTS,
    SEEN,
)
from landscape.gallery.compare import agree, amplified
from landscape.gallery.fixes import FIXES, Fix
from landscape.island import ELEMENTS
from landscape.render import Offscreen
from landscape.views import VIEWS

SIZE = (400, 300)  # chosen: large enough to see what each shows, small enough to keep them all
RENDERER = "renderer.txt"
GROUND = (214, 218, 222)  # chosen: what transparent assets are laid on


@dataclass(frozen=True)
class Panel:
    """One picture of the gallery: its file's stem, its title and command, and what is said of it.

    ``seen`` describes the picture to who cannot see it; ``look`` says what to look at.
    """

    name: str
    title: str
    seen: str
    look: str
    command: str
    draw: Callable[["Studio"], np.ndarray]

    @property
    def figure(self) -> str:
        """The part of the gallery it belongs to: a figure's number, or a fix's."""
        return self.name[3:-1] if self.name.startswith("fig") else self.name.split("_")[0]


class Studio:
    """What draws panels: the assets, and an Offscreen opened at the first render."""

    def __init__(self, options: Mapping[str, Any]) -> None:
        self._options = dict(options)
        self.assets = Assets(Path(options["assets"]) if options.get("assets") else None)
        self._offscreen: Offscreen | None = None
        self._kind: tuple[Any, ...] = ()

    def render(
        self,
        view: Any,
        preset: str,
        settings: Mapping[str, Any],
        kt: float | None = None,
        only: tuple[str, ...] = ELEMENTS,
    ) -> np.ndarray:
        """Draw a view under a preset with changed settings, those of the command line winning."""
        changes = {**settings, **self._options.get("settings", {})}
        only = tuple(name for name in self._options.get("only", ELEMENTS) if name in only)
        kind = (preset, tuple(sorted(changes.items())), only)
        if kind != self._kind:
            self.close()
            options = {k: v for k, v in self._options.items() if k not in ("settings", "only")}
            self._offscreen = Offscreen(SIZE, preset, changes, only=only, **options)
            self._kind = kind
        assert self._offscreen is not None
        self._offscreen.look(view, kt)
        return self._offscreen.draw()

    @property
    def renderer(self) -> str:
        """The name and version of the OpenGL that drew the last panel; empty before the first."""
        return self._offscreen.renderer if self._offscreen is not None else ""

    def close(self) -> None:
        """Release the context."""
        if self._offscreen is not None:
            self._offscreen.close()
        self._offscreen, self._kind = None, ()


def panels() -> list[Panel]:
    """Return the report's 87 panels in order, then two for each fix."""
    found = [asset_panel(name, *entry) for name, entry in ASSET_PANELS.items()]
    found += [view_panel(name) for name in VIEWS]
    found.sort(key=lambda panel: (int(panel.figure), panel.name[-1]))
    return found + [fix_panel(fix, after) for fix in FIXES for after in (False, True)]


def asset_panel(name: str, files: tuple[str, ...], title: str, seen: str, look: str) -> Panel:
    """Return the panel of one asset, or of the sky's five faces unfolded."""

    def draw(studio: Studio) -> np.ndarray:
        images = [read_image(studio.assets.path(file)) for file in files]
        return laid_on_grey(unfolded(images) if len(images) == 5 else images[0])

    return Panel(name, title, seen, look, "landscape assets build " + " ".join(files), draw)


def view_panel(name: str) -> Panel:
    """Return the panel of a named view, under the preset it belongs to."""
    view = VIEWS[name]
    size = f"{SIZE[0]}x{SIZE[1]}"
    command = f"landscape render {name} --preset {view.preset} --size {size}"

    def draw(studio: Studio) -> np.ndarray:
        return studio.render(name, view.preset, {})

    return Panel(name, view.shows, *SEEN[name], command, draw)


def fix_panel(fix: Fix, after: bool) -> Panel:
    """Return one half of a fix's pair."""
    when = "after" if after else "before"
    changes = fix.settings(after)
    place = fix.place(after)
    numbers = (place.x, place.y, place.z, place.yaw, place.pitch)
    pose = ",".join("ground" if v != v else f"{v:g}" for v in numbers)
    command = ["landscape", "render", f"--pose={pose}", "--only", ",".join(fix.only)]
    command += ["--preset", "2006", "--size", f"{SIZE[0]}x{SIZE[1]}", "--kt", f"{fix.kt:g}"]
    for key, value in changes.items():
        command += ["--set", f"{key}={as_text(value)}"]

    def draw(studio: Studio) -> np.ndarray:
        return studio.render(place, "2006", changes, fix.kt, fix.only)

    name, seen = f"{fix.name}_{when}", fix.seen[after]
    return Panel(name, f"{fix.title}: {when}", seen, fix.look, shlex.join(command), draw)


def as_text(value: Any) -> str:
    """Write a setting's value as `--set` takes it."""
    if isinstance(value, (tuple, list)):
        return ",".join(f"{v:g}" for v in value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def laid_on_grey(rgba: np.ndarray) -> np.ndarray:
    """Lay an image (h, w, 4) on grey, fitted into SIZE and centred, uint8 (h, w, 3).

    A small one is shown larger, with its pixels as squares.
    """
    image = Image.fromarray(rgba)
    times = max(SIZE[1] // (2 * image.height), 1)
    image = image.resize((image.width * times, image.height * times), Image.Resampling.NEAREST)
    image.thumbnail(SIZE, Image.Resampling.LANCZOS)
    sheet = Image.new("RGBA", SIZE, (*GROUND, 255))
    corner = ((SIZE[0] - image.width) // 2, (SIZE[1] - image.height) // 2)
    sheet.alpha_composite(image, corner)
    return np.asarray(sheet.convert("RGB"))


def unfolded(faces: list[np.ndarray]) -> np.ndarray:
    """Lay out north, east, south, west and top as the box's unfolded paper, (h, w, 4).

    The box is seen from inside: the top in the middle, each wall on its side of it with its foot
    outwards. To who looks up at it with north ahead, the top has east on its left.
    """
    side, deep = 256, 80
    north, east, south, west = (Image.fromarray(f).resize((side, deep)) for f in faces[:4])
    sheet = Image.new("RGBA", (side + 2 * deep, side + 2 * deep), (0, 0, 0, 0))
    top = Image.fromarray(faces[4]).transpose(Image.Transpose.FLIP_LEFT_RIGHT)
    sheet.paste(top.resize((side, side)), (deep, deep))
    for wall, turn, corner in (
        (north, 180, (deep, 0)),
        (south, 0, (deep, deep + side)),
        (east, 270, (0, deep)),
        (west, 90, (deep + side, deep)),
    ):
        sheet.paste(wall.rotate(turn, expand=True), corner)
    return np.asarray(sheet)


def chosen(names: list[str]) -> list[Panel]:
    """Return the panels of figures ("35"), panels ("fig35a") or fixes ("R6"); all if none named."""
    every = panels()
    if not names:
        return every
    kept = []
    for name in names:
        short = name.removeprefix("fig")
        match = [p for p in every if name in (p.name, p.figure) or short == p.figure]
        if not match:
            raise InputError(f"figures {name!r}: expected a figure such as 35, fig35a or R6")
        kept += [panel for panel in match if panel not in kept]
    return kept


def make(names: list[str], out: Path, options: Mapping[str, Any], quiet: bool) -> list[Path]:
    """Draw panels into a folder; return the files."""
    paths = []
    for panel, picture, _ in drawn(chosen(names), options, quiet):
        paths.append(out / f"{panel.name}.png")
        save_png(picture, paths[-1], small=True)
    return paths


def update(names: list[str], folder: Path, options: Mapping[str, Any], quiet: bool) -> None:
    """Renew the committed pictures that differ, the renderer's name, and the page."""
    renderer = ""
    for panel, picture, name in drawn(chosen(names), options, quiet):
        path, renderer = folder / f"{panel.name}.png", name or renderer
        if not path.exists() or not np.array_equal(read_image(path, "RGB"), picture):
            save_png(picture, path, small=True)
    if renderer:
        write_whole(folder / RENDERER, (renderer + "\n").encode())
    write_whole(folder / "README.md", page().encode())


def check(
    names: list[str], folder: Path, out: Path, options: Mapping[str, Any], quiet: bool
) -> int:
    """Compare fresh panels with the committed ones; return 1 and write what differs if any does."""
    kept = folder / RENDERER
    expected_renderer = kept.read_text(encoding="utf-8").strip() if kept.exists() else ""
    failed = 0
    for panel, picture, renderer in drawn(chosen(names), options, quiet):
        path = folder / f"{panel.name}.png"
        same = not renderer or renderer == expected_renderer
        if path.exists():
            expected = read_image(path, "RGB")
            if agree(expected, picture, same):
                continue
            save_png(expected, out / f"{panel.name}_expected.png")
            save_png(amplified(expected, picture), out / f"{panel.name}_difference.png")
        save_png(picture, out / f"{panel.name}_actual.png")
        print(f"{panel.name}: {'differs' if path.exists() else 'missing'}; see {out}")
        failed += 1
    if not quiet:
        print(f"{len(chosen(names)) - failed} of {len(chosen(names))} panels agree")
    return 1 if failed else 0


def drawn(chosen_panels: list[Panel], options: Mapping[str, Any], quiet: bool) -> Any:
    """Yield (panel, picture, renderer) one by one, showing progress on a terminal."""
    studio = Studio(options)
    try:
        with Progress(len(chosen_panels), quiet) as progress:
            for panel in chosen_panels:
                picture = panel.draw(studio)
                yield panel, picture, studio.renderer
                progress.step(panel.name)
    finally:
        studio.close()


def page() -> str:
    """Return the gallery as Markdown: the figures part by part, then the fixes in pairs."""
    every = panels()
    lines = introduction()
    for part in PARTS:
        lines += [f"## {part.heading}", "", part.text, ""]
        for figure in range(part.first, part.last + 1):
            lines += [f"### Figure {figure}", ""]
            for panel in every:
                if panel.figure == str(figure):
                    lines += figure_entry(panel)
    pairs = {panel.name: panel for panel in every}
    heading = ""
    for fix in FIXES:
        wanted = FIXED if fix.name.startswith("R") else ADDED
        if wanted != heading:
            heading = wanted
            lines += [f"## {heading}", "", FIXES_TEXT[heading], ""]
        lines += fix_entry(fix, pairs[f"{fix.name}_before"], pairs[f"{fix.name}_after"])
    return "\n".join(lines)


def introduction() -> list[str]:
    """Return the page's lines before the first figure: what this is, words, contents."""
    lines = list(INTRODUCTION)
    for part in PARTS:
        figures = f"figures {part.first} to {part.last}"
        if part.first == part.last:
            figures = f"figure {part.first}"
        lines.append(f"- [{part.heading}](#{anchor(part.heading)}): {figures}")
    for heading, start in ((FIXED, "R"), (ADDED, "best")):
        names = [fix.name for fix in FIXES if fix.name.startswith(start)]
        links = ", ".join(f"[{name}](#{anchor(name)})" for name in names)
        lines.append(f"- [{heading}](#{anchor(heading)}): {links}")
    return [*lines, ""]


def figure_entry(panel: Panel) -> list[str]:
    """Return the lines of one panel of a figure."""
    return [
        f"**{panel.name}**: {panel.title}.",
        "",
        f"![{panel.seen}]({panel.name}.png)",
        "",
        linked(panel.look, panel.figure),
        "",
        f"    {panel.command}",
        "",
    ]


def fix_entry(fix: Fix, before: Panel, after: Panel) -> list[str]:
    """Return the lines of one fix: its fault, the two pictures side by side, what changed."""
    return [
        f"### {fix.name}",
        "",
        f"**{fix.title}.** {linked(fix.fault)}",
        "",
        "| before | after |",
        "|---|---|",
        f"| ![{before.seen}]({before.name}.png) | ![{after.seen}]({after.name}.png) |",
        "",
        linked(fix.look),
        "",
        f"How: {linked(fix.how)}",
        "",
        f"    {before.command}",
        f"    {after.command}",
        "",
    ]


def linked(text: str, figure: str = "") -> str:
    """Return a caption with names of panels and fixes as links; but for those of ``figure``."""

    def link(match: re.Match[str]) -> str:
        name, number = match.group(0), match.group(1)
        if number is None:
            return f"[{name}](#{anchor(name)})"
        return name if number == figure else f"[{name}](#figure-{number})"

    return re.sub(r"\bfig(\d+)[a-i]\b|\bR\d+[ab]?\b", link, text)


def anchor(heading: str) -> str:
    """Return the name by which a heading can be linked to, as GitHub makes it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")
