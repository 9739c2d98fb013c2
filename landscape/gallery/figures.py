"""The figures command: draws the gallery's panels into a folder, updates or checks the gallery.

There is a gallery of the report's figures and fixes, one of each scene that has captions, and one
of the software fly-over.
"""

import io
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from PIL import Image

from framelens.base.errors import InputError
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

    The name of a scene, or of the fly-over, means all panels of its own page. InputError for other
    names, and where one of these stands beside others.
    """
    if names == [flyover_page.NAME]:
        panels, page_of = flyover_page.panels(), flyover_page.page
        return Gallery(flyover_page.NAME, "webp", panels, page_of, captions.QUALITY)
    if len(names) == 1 and names[0] in VIEW_TEXTS:
        kind = scene(names[0])
        of_scene = partial(scene_page.page, kind.name)
        panels = scene_page.panels(kind)
        return Gallery(kind.name, "webp", panels, of_scene, QUALITY[kind.name])
    for name in names:
        if name in (*VIEW_TEXTS, flyover_page.NAME):
            raise InputError("figures {name!r}: expected no other names beside it", name=name)
    return Gallery("", "png", named_panels(names), page.page)


def make(names: list[str], out: Path, options: Mapping[str, object], quiet: bool) -> list[Path]:
    """Draw panels into a folder; return the files."""
    check_output_folder(out)
    paths = []
    for panel, picture, _ in drawn(gallery(names).panels, options, quiet):
        paths.append(out / f"{panel.name}.png")
        save_png(picture, paths[-1], small=True)
    return paths


def update(names: list[str], folder: Path, options: Mapping[str, object], quiet: bool) -> None:
    """Rewrite the committed pictures that differ, the renderer's name, and the pages."""
    wanted = gallery(names)
    folder, renderer = folder / wanted.folder, ""
    for panel, picture, opengl in drawn(wanted.panels, options, quiet):
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


def check(
    names: list[str], folder: Path, out: Path, options: Mapping[str, object], quiet: bool
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
    for panel, picture, opengl in drawn(wanted.panels, options, quiet):
        path = folder / wanted.folder / f"{panel.name}.{wanted.suffix}"
        same = not opengl or opengl == expected_renderer
        if path.exists():
            expected = read_image(path, "RGB")
            if agree_lossy(expected, picture) if wanted.lossy else agree(expected, picture, same):
                continue
            save_png(expected, out / f"{panel.name}_expected.png")
            save_png(amplified(expected, picture), out / f"{panel.name}_difference.png")
        save_png(picture, out / f"{panel.name}_actual.png")
        print(f"{panel.name}: {'differs' if path.exists() else 'missing'}; see {out}")
        failed += 1

    if not quiet:
        print(f"{len(wanted.panels) - failed} of {len(wanted.panels)} panels agree")
    return 1 if failed else 0


def drawn(
    wanted: list[FigurePanel], options: Mapping[str, object], quiet: bool
) -> Iterator[tuple[FigurePanel, np.ndarray, str]]:
    """Yield each panel, its picture and the OpenGL in use, with progress on a terminal."""
    renderer = PanelRenderer(options)
    try:
        with Progress(len(wanted), quiet) as progress:
            for panel in wanted:
                picture = panel.draw(renderer)
                yield panel, picture, renderer.opengl
                progress.step(panel.name)
    finally:
        renderer.close()
