"""The command `landscape film`: from its options to a film on the disk."""

import argparse
import os

from framelens.base.texts import choose
from framelens.system.processes import cores
from landscape.commands.changes import given_changes, tell_of_no_effect
from landscape.film.encode import check
from landscape.film.making import finished, write
from landscape.film.sources import Wanted, film_of, places
from landscape.film.stage import Drawing


def run(options: argparse.Namespace) -> int:
    """Draw a film; return the exit status. Raises InputError and NoOpenGLError."""
    drawing = Drawing(options.size, options.samples, options.backend, options.assets, options.seed)
    wanted = Wanted(
        drawing,
        fps=options.fps,
        seconds=options.seconds,
        scene=options.scene,
        preset=options.preset,
        only=options.only,
        kt=options.kt,
        wireframe=options.wireframe,
        language=options.lang or choose(os.environ),
    )
    found = places(options.views, wanted)
    changes = given_changes(options, *(kind for kind, _ in found))
    wanted = Wanted(**{**vars(wanted), "changes": changes})
    check(options.out, options.size, wanted.rate)
    film = film_of(options.views, wanted)
    kept = write(film, options.out, options.jobs or cores(), options.quiet)
    if found:
        tell_of_no_effect(options, found, changes)
    return finished(film, kept, options)
