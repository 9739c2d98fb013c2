"""Making a film: its frames are drawn side by side and encoded in order into one file."""

import argparse
from concurrent.futures import Executor
from contextlib import closing, suppress
from functools import partial
from pathlib import Path

from framelens.base.executor import lent_or_own
from framelens.base.progress import Progress
from framelens.commands.reporting import notify
from framelens.system import interrupts_held
from landscape.film.cut import Film
from landscape.film.encode import FilmFile, Format, format_of
from landscape.film.frames import drawn, packed, part_frames, parts, samples, single
from landscape.film.sound import sound_part


def write(
    film: Film, out: Path, jobs: int, quiet: bool = True, executor: Executor | None = None
) -> int:
    """Draw a film by ``jobs`` workers into a file; return how many frames it has.

    The workers are processes of this machine, to each of which a task is a frame, or those of an
    ``executor``, to which it is a part: they may be far away. The file is the same.

    The frames are fewer than the film's after Ctrl-C. If there is none yet, or they would take the
    place of an earlier file, KeyboardInterrupt goes on, and nothing is written. InputError and
    NoOpenGLError, too, leave what stood there before.
    """
    file: FilmFile | None = None
    earlier = out.is_file()

    try:
        with (
            suppress(KeyboardInterrupt),
            Progress(film.frames, quiet) as progress,
            lent_or_own(executor, min(jobs, film.frames)) as workers,
        ):
            palette = partial(samples, film, workers, jobs)
            format = format_of(out, film.drawing.size, film.fps, palette)
            sound = b""
            if film.sound:
                sound = single(workers, sound_part, packed(film), format.ending)
            file = FilmFile(out, format, sound)
            if executor is None:
                _draw(film, file, workers, jobs, progress)
            else:
                _draw_parts(film, format, file, workers, jobs, progress)

        if file is None or not file.frames or (earlier and file.frames < film.frames):
            raise KeyboardInterrupt
        with interrupts_held():
            file.finish()
        return file.frames
    finally:
        if file is not None:
            file.discard()


def _draw(film: Film, file: FilmFile, workers: Executor, jobs: int, progress: Progress) -> None:
    """Draw frame by frame."""
    with closing(drawn(film, workers, jobs)) as pictures:
        for pixels in pictures:
            with interrupts_held():
                file.add(pixels)
            progress.step("frames")


def _draw_parts(
    film: Film, format: Format, file: FilmFile, workers: Executor, jobs: int, progress: Progress
) -> None:
    """Draw part by part."""
    with closing(parts(film, format, workers, jobs)) as encoded:
        for number, data in enumerate(encoded):
            count = len(part_frames(film, format, number))
            with interrupts_held():
                file.add_part(data, count)
            progress.step("frames", count)


def finished(film: Film, kept: int, options: argparse.Namespace) -> int:
    """Say what was written, ``kept`` frames of a film; return the exit status."""
    if kept < film.frames:
        notify(options, [f"interrupted: {options.out} has {kept} of {film.frames} frames"])
        return 130
    if not options.quiet:
        print(options.out)
    return 0
