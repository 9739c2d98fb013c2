"""The report's figures, panel by panel, made again; and a page that shows them all.

A panel is an asset shown as it is, or a named view rendered with its own switches. Beside them
stand the cures: pairs of pictures, before and after, for each remedy of the report's discussion.
"""

import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from landscape.assets import Assets
from landscape.captions import ASSET_PANELS, LOOK
from landscape.compare import agree, amplified
from landscape.cures import CURES, Cure
from landscape.errors import InputError
from landscape.gl.texture import read_image
from landscape.island import ELEMENTS
from landscape.output import Progress, save_png, write_whole
from landscape.render import Offscreen
from landscape.views import VIEWS

SIZE = (400, 300)  # chosen: large enough to see what each shows, small enough to keep them all
RENDERER = "renderer.txt"
GROUND = (214, 218, 222)  # chosen: what transparent assets are laid on


@dataclass(frozen=True)
class Panel:
    """One picture of the gallery: its file's stem, what it shows, what to look at, its command."""

    name: str
    title: str
    look: str
    command: str
    draw: Callable[["Studio"], np.ndarray]

    @property
    def figure(self) -> str:
        """The part of the gallery it belongs to: a figure's number, or a cure's."""
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
    """Return the report's 87 panels in order, then two for each cure."""
    found = [asset_panel(name, *entry) for name, entry in ASSET_PANELS.items()]
    found += [view_panel(name) for name in VIEWS]
    found.sort(key=lambda panel: (int(panel.figure), panel.name[-1]))
    return found + [cure_panel(cure, after) for cure in CURES for after in (False, True)]


def asset_panel(name: str, files: tuple[str, ...], title: str, look: str) -> Panel:
    """Return the panel of one asset, or of the sky's five faces unfolded."""

    def draw(studio: Studio) -> np.ndarray:
        images = [read_image(studio.assets.path(file)) for file in files]
        return laid_on_grey(unfolded(images) if len(images) == 5 else images[0])

    return Panel(name, title, look, "landscape assets build " + " ".join(files), draw)


def view_panel(name: str) -> Panel:
    """Return the panel of a named view, under the preset it belongs to."""
    view = VIEWS[name]
    size = f"{SIZE[0]}x{SIZE[1]}"
    command = f"landscape render {name} --preset {view.preset} --size {size}"

    def draw(studio: Studio) -> np.ndarray:
        return studio.render(name, view.preset, {})

    return Panel(name, view.shows, LOOK[name], command, draw)


def cure_panel(cure: Cure, after: bool) -> Panel:
    """Return one half of a cure's pair."""
    when = "after" if after else "before"
    changes = cure.settings(after)
    place = cure.place(after)
    numbers = (place.x, place.y, place.z, place.yaw, place.pitch)
    pose = ",".join("ground" if v != v else f"{v:g}" for v in numbers)
    command = ["landscape", "render", f"--pose={pose}", "--only", ",".join(cure.only)]
    command += ["--preset", "2006", "--size", f"{SIZE[0]}x{SIZE[1]}", "--kt", f"{cure.kt:g}"]
    for key, value in changes.items():
        command += ["--set", f"{key}={as_text(value)}"]

    def draw(studio: Studio) -> np.ndarray:
        return studio.render(place, "2006", changes, cure.kt, cure.only)

    title = f"{cure.title}: {when}"
    return Panel(f"{cure.name}_{when}", title, cure.sentence, shlex.join(command), draw)


def as_text(value: Any) -> str:
    """Write a setting's value as `--set` takes it."""
    if isinstance(value, (tuple, list)):
        return ",".join(f"{v:g}" for v in value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def laid_on_grey(rgba: np.ndarray) -> np.ndarray:
    """Lay an image (h, w, 4) on grey, fitted into SIZE and centred, uint8 (h, w, 3)."""
    image = Image.fromarray(rgba)
    image.thumbnail(SIZE, Image.Resampling.LANCZOS)
    sheet = Image.new("RGBA", SIZE, (*GROUND, 255))
    corner = ((SIZE[0] - image.width) // 2, (SIZE[1] - image.height) // 2)
    sheet.alpha_composite(image, corner)
    return np.asarray(sheet.convert("RGB"))


def unfolded(faces: list[np.ndarray]) -> np.ndarray:
    """Lay out north, east, south, west and top as the box's unfolded paper, (h, w, 4).

    The top stands in the middle, each wall on its side of it with its foot outwards.
    """
    side, deep = 256, 80
    north, east, south, west = (Image.fromarray(f).resize((side, deep)) for f in faces[:4])
    sheet = Image.new("RGBA", (side + 2 * deep, side + 2 * deep), (0, 0, 0, 0))
    sheet.paste(Image.fromarray(faces[4]).resize((side, side)), (deep, deep))
    for wall, turn, corner in (
        (north, 180, (deep, 0)),
        (south, 0, (deep, deep + side)),
        (east, 90, (deep + side, deep)),
        (west, 270, (0, deep)),
    ):
        # Walls are seen from inside; on the paper of a box seen from inside each has its upper
        # edge at the top's side.
        sheet.paste(wall.rotate(turn, expand=True), corner)
    return np.asarray(sheet)


def chosen(names: list[str]) -> list[Panel]:
    """Return the panels of figures ("35"), panels ("fig35a") or cures ("R6"); all if none named."""
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
    write_whole(folder / "README.md", page(panels()).encode())


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


def page(every: list[Panel]) -> str:
    """Return the gallery as Markdown: pictures, captions, commands and what to look at."""
    lines = [
        "# The figures of 2006, and their cures",
        "",
        "In December 2006 a student's report, Damien Rohmer's *TP OpenGL: Rendu de paysage naturel*"
        " (CPE Lyon), drew an island with the OpenGL of its time, figure by figure: a height image,"
        " the water that mirrors it, a sky, trees, grass, a castle, a rabbit and a sea dragon. It"
        " ends with what is wrong in the pictures (figures 36 to 43) and what could be better. Here"
        " are its 43 figures, drawn again by this program, and a cure for each flaw.",
        "",
        "How to read it: the bold name, as **fig17b**, is the figure and its panel, and the name of"
        " the view for every command. Under a picture stands what to look at, in OpenGL's own words"
        " (each is explained at the head of its file in `landscape/elements`), then the command"
        " that draws it. A *billboard* is a picture on a rectangle that turns to the viewer,"
        " *crossed quads* are two that stand still and cross; *kt* counts time, 30 a second.",
        "",
        "Each picture is made by the command under it, with no screen needed. `landscape figures"
        " --check` compares all of them with what the program draws today; `landscape figures"
        " --update` renews them, and this page.",
        "",
        "The figures come first, in the order of the report, under the preset `2006`; then, for"
        " each remedy its discussion proposes (R1 to R19), a picture before and after.",
        "",
    ]
    heading = ""
    for panel in every:
        if panel.figure != heading:
            heading = panel.figure
            word = "Figure" if heading.isdigit() else "Cure"
            lines += [f"## {word} {heading}", ""]
        lines += [
            f"**{panel.name}**: {panel.title}.",
            "",
            f"![{panel.title}]({panel.name}.png)",
            "",
            f"{panel.look}",
            "",
            f"    {panel.command}",
            "",
        ]
    return "\n".join(lines)
