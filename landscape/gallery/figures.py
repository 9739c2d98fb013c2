"""The figures command: draws the gallery's panels into a folder, updates or checks the gallery."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from landscape.files.images import read_image
from landscape.files.output import check_output_folder, save_png, write_whole
from landscape.files.progress import Progress
from landscape.gallery.compare import agree, amplified
from landscape.gallery.page import page
from landscape.gallery.panels import FigurePanel, PanelRenderer, named_panels
from landscape.languages import LANGUAGES

RENDERER = "renderer.txt"  # names the OpenGL that drew the committed pictures


def make(names: list[str], out: Path, options: Mapping[str, Any], quiet: bool) -> list[Path]:
    """Draw panels into a folder; return the files."""
    check_output_folder(out)
    paths = []
    for panel, picture, _ in drawn(named_panels(names), options, quiet):
        paths.append(out / f"{panel.name}.png")
        save_png(picture, paths[-1], small=True)
    return paths


def update(names: list[str], folder: Path, options: Mapping[str, Any], quiet: bool) -> None:
    """Rewrite the committed pictures that differ, the renderer's name, and the pages."""
    renderer = ""
    for panel, picture, opengl in drawn(named_panels(names), options, quiet):
        path, renderer = folder / f"{panel.name}.png", opengl or renderer
        if not path.exists() or not np.array_equal(read_image(path, "RGB"), picture):
            save_png(picture, path, small=True)
    if renderer:
        write_whole(folder / RENDERER, (renderer + "\n").encode())
    for language in LANGUAGES:
        name = "README.md" if language == "en" else f"README.{language}.md"
        write_whole(folder / name, page(language).encode())


def check(
    names: list[str], folder: Path, out: Path, options: Mapping[str, Any], quiet: bool
) -> int:
    """Compare new panels with the committed ones; return 1 if any differs.

    For each panel that differs, the expected picture, the new one and their difference are written
    to ``out``.
    """
    check_output_folder(out)
    kept = folder / RENDERER
    expected_renderer = kept.read_text(encoding="utf-8").strip() if kept.exists() else ""
    wanted = named_panels(names)
    failed = 0
    for panel, picture, opengl in drawn(wanted, options, quiet):
        path = folder / f"{panel.name}.png"
        same = not opengl or opengl == expected_renderer
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
        print(f"{len(wanted) - failed} of {len(wanted)} panels agree")
    return 1 if failed else 0


def drawn(
    wanted: list[FigurePanel], options: Mapping[str, Any], quiet: bool
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
