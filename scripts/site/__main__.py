"""The site of the course: its pages are written from the code, in each language, and built.

    python scripts/site build [--out build/site] [--jobs N] [--pages]
    python scripts/site check [--out build/site]

It draws the pictures of the lessons, writes the sources of the pages for each language into
build/site-source, and runs Sphinx on them with warnings as errors. English is at the site's top,
the other languages are in folders beside it. What is built is checked in headless Chromium: links,
pictures, the console, the sliders, the search.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import Executor
from functools import partial
from operator import call
from pathlib import Path

import calls
import documents
import exercise_pages
import gallery
import lesson_pages
import share
import start
import theme
from drawn import Drawn, draw_exercise, draw_lesson, read_scene, shrink

from framelens.base.engine import engine
from framelens.base.errors import InputError
from framelens.base.executor import ahead, in_order, lent_or_own
from framelens.base.progress import Progress
from framelens.base.texts import LANGUAGES
from landscape.course.ladder import lessons
from landscape.course.shelf import NAMES
from landscape.gallery.scene_captions import VIEW_TEXTS
from landscape.maker import maker
from landscape.scene.scene import scene

ROOT = Path(__file__).resolve().parents[2]
ENGINE = "a cluster of Dask that shares this checkout, with PYTHONPATH=scripts/site"
PAGES = "write only the pages anew; the pictures stay those of the last build"
SOURCE = ROOT / "build" / "site-source"
PICTURES = SOURCE / "pictures"


def main() -> int:
    """Run the command line and return the exit status."""
    parser = argparse.ArgumentParser(prog="site", description=__doc__.split("\n")[0])
    parser.add_argument("command", choices=("build", "check"))
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "site", metavar="DIR")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N")
    parser.add_argument("--pages", action="store_true", help=PAGES)
    parser.add_argument("--engine", metavar="ADDRESS|FILE.json", help=ENGINE)
    options = parser.parse_args()
    if options.command == "check":
        from check import check

        faults = check(options.out.resolve())
        print("\n".join(faults) or "the site is whole")
        return 1 if faults else 0
    if options.pages:
        try:
            return build(options.out, options.jobs, only_pages=True)
        except InputError as error:
            parser.error(str(error))
    if options.engine is None:
        return build(options.out, options.jobs)
    with engine(options.engine, maker, lambda line: print(line, file=sys.stderr)) as workers:
        return build(options.out, workers.workers, workers)


def build(out: Path, jobs: int, workers: Executor | None = None, only_pages: bool = False) -> int:
    """Build the site; return the exit status."""
    begin = time.monotonic()
    drawn = Drawn.kept(PICTURES) if only_pages else draw(PICTURES, jobs, workers)
    for stale in (out, SOURCE / "doctrees"):
        shutil.rmtree(stale, ignore_errors=True)
    for language in LANGUAGES:
        folder = SOURCE / language
        write(folder, language, drawn)
        built = out if language == "en" else out / language
        if status := sphinx(folder, built, language, jobs):
            return status
        if language != "en":
            theme.reword_labels(built, language)
            share.pictures(out, built)
    print(f"{out / 'index.html'}, made in {time.monotonic() - begin:.0f} s")
    return 0


def draw(folder: Path, jobs: int, engine: Executor | None = None) -> Drawn:
    """Draw all pictures into a folder; return what was seen on the way.

    The workers are ``jobs`` processes of this machine, or those of an ``engine`` that shares its
    folders.
    """
    shutil.rmtree(folder, ignore_errors=True)
    for language in LANGUAGES:
        (folder / language).mkdir(parents=True)
    drawn = Drawn(folder)
    views: list[tuple[str, str | None]] = []
    views += [(name, preset) for preset in ("2006", "best") for name in scene().main]
    views += [(name, None) for shown in VIEW_TEXTS.values() for name in shown]
    work = [
        *(
            partial(draw_lesson, each.name, word, folder)
            for each in lessons()
            for word in LANGUAGES
        ),
        *(partial(draw_exercise, name, folder) for name in NAMES),
        *(partial(read_scene, name, preset) for name, preset in views),
        *(partial(shrink, path, folder) for path in gallery.pictures()),
    ]
    with lent_or_own(engine, jobs) as workers, Progress(len(work), False) as progress:
        for seen in in_order(workers, call, work, ahead(jobs)):
            drawn.add(seen)
            progress.step("pictures")
    drawn.keep()
    return drawn


def write(folder: Path, language: str, drawn: Drawn) -> None:
    """Write the sources of all pages in a language."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs" / "site", folder)
    (folder / "pictures").symlink_to(drawn.pictures(language))
    index = calls.index(drawn)
    pages = {
        **start.pages(language),
        **lesson_pages.pages(language, drawn),
        **exercise_pages.pages(language),
        **gallery.pages(language),
        **documents.pages(language),
        **calls.pages(language, index),
    }
    for name, text in pages.items():
        path = folder / f"{name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    links = {name: entry.page for name, entry in index.items()}
    (folder / "calls.json").write_text(json.dumps(links), encoding="utf-8")
    theme.write_words(folder, language)
    for source in documents.pictures():
        shutil.copy(source, folder / "documents" / source.name)


def sphinx(folder: Path, out: Path, language: str, jobs: int) -> int:
    """Build the pages of a language; return Sphinx's exit status."""
    words = [sys.executable, "-m", "sphinx", "-b", "html", "-q", "-W", "--keep-going"]
    words += ["-j", str(jobs), "-D", f"language={language}"]
    words += ["-d", str(folder.parent / "doctrees" / language)]
    return subprocess.run([*words, str(folder), str(out)]).returncode


if __name__ == "__main__":
    sys.exit(main())
