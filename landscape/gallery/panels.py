"""The panels of the gallery: what each shows, the command that makes it, and how it is drawn.

A panel is an asset, a named view rendered with its own settings, or one half of a fix's
before-and-after pair.
"""

import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
from landscape.elements.unfolded_sky import unfolded
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Pose
from landscape.gallery.asset_captions import ASSET_PANELS
from landscape.gallery.view_captions import VIEW_PANELS
from landscape.island.fixes import FIXES, Fix
from landscape.island.island import ELEMENTS
from landscape.island.views import VIEWS
from landscape.offscreen import Offscreen, Place

SIZE = (400, 300)  # chosen: large enough to see what each shows, small enough to commit them all
REPORT_PRESET = "2006"  # the report's figures are drawn with the report's settings
BACKGROUND = (214, 218, 222)  # chosen: a light grey behind transparent assets


@dataclass(frozen=True)
class FigurePanel:
    """One picture of the gallery: its name, title, captions and command, and how to draw it.

    ``name`` is the stem of its file. ``seen`` describes the picture for readers who cannot see it;
    ``look`` says what to look for.
    """

    name: str
    title: str
    seen: str
    look: str
    command: str
    draw: Callable[["PanelRenderer"], np.ndarray]

    @property
    def figure(self) -> str:
        """The figure's number, as in "35", or the fix's name, as in "R6a"."""
        return self.name[3:-1] if self.name.startswith("fig") else self.name.split("_")[0]


class PanelRenderer:
    """Draws panels: holds the assets, and an Offscreen that opens at the first render."""

    def __init__(self, options: Mapping[str, Any]) -> None:
        self._options = dict(options)
        self.assets = Assets(Path(options["assets"]) if options.get("assets") else None)
        self._offscreen: Offscreen | None = None
        self._opened_for: tuple[object, ...] = ()

    def render(
        self,
        view: Place,
        settings: Mapping[str, object],
        kt: float | None = None,
        only: tuple[str, ...] = ELEMENTS,
    ) -> np.ndarray:
        """Draw a view with some settings changed; those of the command line take precedence."""
        changes = {**settings, **self._options.get("settings", {})}
        allowed = self._options.get("only") or ELEMENTS
        only = tuple(name for name in allowed if name in only)
        wanted = (tuple(sorted(changes.items())), only)
        if wanted != self._opened_for:
            self.close()
            options = {k: v for k, v in self._options.items() if k not in ("settings", "only")}
            self._offscreen = Offscreen(SIZE, REPORT_PRESET, changes, only=only, **options)
            self._opened_for = wanted

        assert self._offscreen is not None
        self._offscreen.look(view, kt)
        return self._offscreen.draw()

    def scene_picture(
        self,
        place: str,
        view: Place,
        settings: Mapping[str, object],
        kt: float | None,
        size: tuple[int, int],
        only: tuple[str, ...] | None = None,
    ) -> np.ndarray:
        """Draw a view of the scene ``place``, or a pose there, with some settings changed."""
        wanted = place, size, only, tuple(sorted(settings.items()))
        if wanted != self._opened_for:
            self.close()
            options = {k: v for k, v in self._options.items() if k not in ("settings", "only")}
            changes = {**settings, **self._options.get("settings", {})}
            shown = self._options.get("only") or only
            self._offscreen = Offscreen(size, None, changes, only=shown, place=place, **options)
            self._opened_for = wanted

        assert self._offscreen is not None
        self._offscreen.look(view, kt)
        return self._offscreen.draw()

    @property
    def opengl(self) -> str:
        """Renderer and version of the OpenGL in use; empty before the first render."""
        return self._offscreen.renderer if self._offscreen is not None else ""

    def close(self) -> None:
        """Release the context."""
        if self._offscreen is not None:
            self._offscreen.close()
        self._offscreen, self._opened_for = None, ()


def panels() -> list[FigurePanel]:
    """Return the report's 87 panels in order, then two for each fix."""
    found = [asset_panel(name, *entry) for name, entry in ASSET_PANELS.items()]
    found += [view_panel(name) for name in VIEW_PANELS]
    found.sort(key=lambda panel: (int(panel.figure), panel.name[-1]))
    return found + [fix_panel(fix, after) for fix in FIXES for after in (False, True)]


def named_panels(names: list[str]) -> list[FigurePanel]:
    """Return the panels of figures ("35"), panels ("fig35a") or fixes ("R6"); all if no names."""
    every = panels()
    if not names:
        return every
    found = []
    for name in names:
        figure = name.removeprefix("fig")
        match = [
            panel
            for panel in every
            if name in (panel.name, panel.figure.rstrip("ab")) or figure == panel.figure
        ]
        if not match:
            raise InputError(
                "figures {name!r}: expected a figure such as 35, fig35a or R6, a scene with a "
                "page, or a picture of one",
                name=name,
            )
        found += [panel for panel in match if panel not in found]
    return found


def asset_panel(name: str, files: tuple[str, ...], title: str, seen: str, look: str) -> FigurePanel:
    """Return the panel of one asset, or of the sky box's five faces unfolded."""

    def draw(renderer: PanelRenderer) -> np.ndarray:
        images = [read_image(renderer.assets.path(file)) for file in files]
        return on_grey(unfolded(images, 256, 80) if len(images) == 5 else images[0])

    return FigurePanel(name, title, seen, look, "landscape assets build " + " ".join(files), draw)


def view_panel(name: str) -> FigurePanel:
    """Return the panel of a named view."""
    command = f"landscape render {name} --preset {REPORT_PRESET} --size {SIZE[0]}x{SIZE[1]}"

    def draw(renderer: PanelRenderer) -> np.ndarray:
        return renderer.render(name, {})

    return FigurePanel(name, VIEWS[name].shows, *VIEW_PANELS[name], command, draw)


def fix_panel(fix: Fix, after: bool) -> FigurePanel:
    """Return one half of a fix's pair."""
    settings, pose = fix.settings(after), fix.pose(after)
    command = ["landscape", "render", as_option(pose), "--only", ",".join(fix.only)]
    command += ["--preset", REPORT_PRESET, "--size", f"{SIZE[0]}x{SIZE[1]}", "--kt", f"{fix.kt:g}"]
    for key, value in settings.items():
        command += ["--set", f"{key}={as_text(value)}"]

    def draw(renderer: PanelRenderer) -> np.ndarray:
        return renderer.render(pose, settings, fix.kt, fix.only)

    when, seen = "after" if after else "before", fix.seen[after]
    name, title = f"{fix.name}_{when}", f"{fix.title}: {when}"
    return FigurePanel(name, title, seen, fix.look, shlex.join(command), draw)


def as_option(pose: Pose) -> str:
    """Return a pose as the option that asks for it."""
    numbers = (pose.x, pose.y, pose.z, pose.yaw, pose.pitch)
    return "--pose=" + ",".join("ground" if v is None else f"{v:g}" for v in numbers)


def as_text(value: object) -> str:
    """Return a setting's value as `--set` takes it."""
    if isinstance(value, (tuple, list)):
        return ",".join(f"{v:g}" for v in value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def on_grey(rgba: np.ndarray) -> np.ndarray:
    """Fit an image (h, w, 4) into SIZE and centre it on grey, uint8 (h, w, 3).

    A small image is enlarged by a whole factor, with nearest-neighbour sampling.
    """
    image = Image.fromarray(rgba)
    times = max(SIZE[1] // (2 * image.height), 1)
    image = image.resize((image.width * times, image.height * times), Image.Resampling.NEAREST)
    image.thumbnail(SIZE, Image.Resampling.LANCZOS)
    sheet = Image.new("RGBA", SIZE, (*BACKGROUND, 255))
    corner = ((SIZE[0] - image.width) // 2, (SIZE[1] - image.height) // 2)
    sheet.alpha_composite(image, corner)
    return np.asarray(sheet.convert("RGB"))
