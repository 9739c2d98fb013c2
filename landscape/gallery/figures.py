"""The figures command: draws the gallery's panels into a folder, updates or checks the gallery.

There is a gallery of the report's figures and fixes, one of each scene that has captions, and one
of the software fly-over.
"""

import io
import pickle
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
from framelens.base.executor import Kept, ahead, in_order, lent_or_own
from framelens.base.output import check_output_folder, save_png, write_whole
from framelens.base.progress import Progress
from framelens.base.texts import LANGUAGES
from landscape.files.images import read_image
from landscape.gallery import flyover_captions as captions
from landscape.gallery import flyover_page, page, scene_page
from landscape.gallery.compare import agree, agree_lossy, amplified
from landscape.gallery.panels import FigurePanel, PanelRenderer, named_panels
from landscape.gallery.scene_captions import QUALITY, VIEW_TEXTS
from landscape.scene.scene import scene

RENDERER = "renderer.txt"  # names the OpenGL that drew the committed pictures


@dataclass(frozen=True)
class Gallery:
    """Where a gallery's pictures lie, their format, its panels, and its page by language.

    ``quality`` is that of pictures in a format with a loss, 0 to 100.
    """

    folder: str
    suffix: str
    panels: list[FigurePanel]
    page: Callable[[str], str]
    quality: int = 0

    @property
    def lossy(self) -> bool:
        """Whether its pictures are compressed with a loss."""
        return self.suffix == "webp"


def gallery(names: list[str]) -> Gallery:
    """Return the panels of these figures or fixes, all of the report's without names.

    The name of a scene, or of the fly-over, means all panels of its own page; that of a picture
    there, or of a pair without "_before" and "_after", means these. InputError for other names, and
    where they are of different pages.
    """
    own = [each for each in map(_elsewhere, names) if each is not None]
    if not own:
        return Gallery("", "png", named_panels(names), page.page)
    if len(own) < len(names) or len({each.folder for each in own}) > 1:
        raise InputError(
            "figures {names}: expected names of one page, of the report, a scene or the fly-over",
            names=", ".join(names),
        )
    panels = {panel.name: panel for each in own for panel in each.panels}
    return replace(own[0], panels=list(panels.values()))


def _elsewhere(name: str) -> Gallery | None:
    """Return the panels of a name on the page of a scene or of the fly-over; None for another."""
    for each in _pages():
        if name == each.folder:
            return each
        named = [panel for panel in each.panels if name in (panel.name, _pair(panel.name))]
        if named:
            return replace(each, panels=named)
    return None


def _pair(name: str) -> str:
    """Return the name of the pair that a panel is one half of, else that of the panel."""
    return name.removesuffix("_before").removesuffix("_after")


def _pages() -> Iterator[Gallery]:
    """Yield the galleries of the scenes and of the fly-over, with all panels."""
    for name in VIEW_TEXTS:
        panels = scene_page.panels(scene(name))
        yield Gallery(name, "webp", panels, partial(scene_page.page, name), QUALITY[name])
    panels, page_of = flyover_page.panels(), flyover_page.page
    yield Gallery(flyover_page.NAME, "webp", panels, page_of, captions.QUALITY)


@dataclass(frozen=True)
class Workers:
    """Who draws panels: ``jobs`` processes of this machine, or an ``executor``'s."""

    executor: Executor | None = None
    jobs: int = 1


ALONE = Workers()


def make(
    names: list[str],
    out: Path,
    options: Mapping[str, object],
    quiet: bool,
    workers: Workers = ALONE,
) -> list[Path]:
    """Draw panels into a folder; return the files."""
    check_output_folder(out)
    paths = []
    for panel, picture, _ in drawn(names, options, quiet, workers):
        paths.append(out / f"{panel.name}.png")
        save_png(picture, paths[-1], small=True)
    return paths


def update(
    names: list[str],
    folder: Path,
    options: Mapping[str, object],
    quiet: bool,
    workers: Workers = ALONE,
) -> None:
    """Rewrite the committed pictures that differ, the renderer's name, and the pages."""
    wanted = gallery(names)
    folder, renderer = folder / wanted.folder, ""
    for panel, picture, opengl in drawn(names, options, quiet, workers):
        path, renderer = folder / f"{panel.name}.{wanted.suffix}", opengl or renderer
        if wanted.lossy:
            if not path.exists() or not agree_lossy(read_image(path, "RGB"), picture):
                write_whole(path, as_webp(picture, wanted.quality))
        elif not path.exists() or not np.array_equal(read_image(path, "RGB"), picture):
            save_png(picture, path, small=True)
    if renderer and not wanted.lossy:
        write_whole(folder / RENDERER, (renderer + "\n").encode())
    _write_pages(wanted, folder)


def update_pages(names: list[str], folder: Path) -> None:
    """Rewrite the pages of these panels; no picture is drawn."""
    wanted = gallery(names)
    _write_pages(wanted, folder / wanted.folder)


def _write_pages(wanted: Gallery, folder: Path) -> None:
    """Write the page in each language."""
    for language in LANGUAGES:
        name = "README.md" if language == "en" else f"README.{language}.md"
        write_whole(folder / name, wanted.page(language).encode())


def as_webp(picture: np.ndarray, quality: int) -> bytes:
    """Return a picture as a WebP file, of a quality from 0 to 100.

    If the file is smaller without any loss, as of thin lines in few colours, that one is returned.
    """
    files = []
    for lossless in (False, True):
        buffer = io.BytesIO()
        image = Image.fromarray(picture)
        image.save(
            buffer, "WEBP", quality=100 if lossless else quality, method=6, lossless=lossless
        )
        files.append(buffer.getvalue())
    return min(files, key=len)


def _save_beside(out: Path, name: str, expected: np.ndarray | None, picture: np.ndarray) -> None:
    """Save a new picture and, where there is another one, that and their difference."""
    if expected is not None:
        save_png(expected, out / f"{name}_expected.png")
        save_png(amplified(expected, picture), out / f"{name}_difference.png")
    save_png(picture, out / f"{name}_actual.png")


def check(
    names: list[str],
    folder: Path,
    out: Path,
    options: Mapping[str, object],
    quiet: bool,
    workers: Workers = ALONE,
) -> int:
    """Compare new panels with the committed ones; return 1 if any differs.

    For each panel that differs, the expected picture, the new one and their difference are written
    to ``out``.
    """
    check_output_folder(out)
    kept = folder / RENDERER
    expected_renderer = kept.read_text(encoding="utf-8").strip() if kept.exists() else ""
    wanted = gallery(names)
    failed = 0
    for panel, picture, opengl in drawn(names, options, quiet, workers):
        path = folder / wanted.folder / f"{panel.name}.{wanted.suffix}"
        expected = read_image(path, "RGB") if path.exists() else None
        if expected is not None:
            same = not opengl or opengl == expected_renderer
            if agree_lossy(expected, picture) if wanted.lossy else agree(expected, picture, same):
                continue
        _save_beside(out, panel.name, expected, picture)
        print(f"{panel.name}: {'missing' if expected is None else 'differs'}; see {out}")
        failed += 1

    if not quiet:
        print(f"{len(wanted.panels) - failed} of {len(wanted.panels)} panels agree")
    return 1 if failed else 0


def drawn(
    names: list[str], options: Mapping[str, object], quiet: bool, workers: Workers = ALONE
) -> Iterator[tuple[FigurePanel, np.ndarray, str]]:
    """Yield each panel, its picture and the OpenGL in use, with progress on a terminal."""
    wanted = gallery(names).panels
    count = workers.jobs
    task = partial(draw, tuple(names), pickle.dumps(dict(options)))
    try:
        with (
            Progress(len(wanted), quiet) as progress,
            lent_or_own(workers.executor, count) as executor,
            closing(in_order(executor, task, range(len(wanted)), ahead(count))) as pictures,
        ):
            for panel, (picture, opengl) in zip(wanted, pictures, strict=True):
                yield panel, picture, opengl
                progress.step(panel.name)
    finally:
        _open.close()  # where the executor is one in this process


def draw(names: tuple[str, ...], packed: bytes, number: int) -> tuple[np.ndarray, str]:
    """Return a panel's picture, and the OpenGL in use: a task for any executor."""
    with _open.opened(packed, lambda: PanelRenderer(pickle.loads(packed))) as renderer:
        return gallery(list(names)).panels[number].draw(renderer), renderer.opengl


_open: Kept[PanelRenderer] = Kept()
