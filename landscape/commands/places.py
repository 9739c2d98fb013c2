"""`landscape places`: where the island's trees, deer and plants stand, saved to a file."""

import argparse

from framelens.base.errors import InputError
from framelens.base.output import check_writable, write_whole
from framelens.commands import option_values
from landscape.commands.changes import given_changes, offscreen_options
from landscape.commands.common import drawing_options
from landscape.elements.places_file import as_csv
from landscape.island.island import SPRITES, Island
from landscape.offscreen import Offscreen
from landscape.scene.scene import scene

EXAMPLE = "mine.csv --preset 2006"
PLACES = "the file to write, which the setting transparent.places reads"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("file", type=option_values.pathname, metavar="FILE.csv", help=PLACES)
    drawing_options(parser, samples=0, preset="best or 2006; default: best")


def run(options: argparse.Namespace) -> int:
    """Write the file; return the exit status."""
    check_writable(options.file)
    island = scene("island")
    given = offscreen_options(options)
    only = tuple(name for name in (given["only"] or SPRITES) if name in SPRITES)
    if not only:
        raise InputError("--only: expected some of {names}", names=", ".join(SPRITES))
    given |= {"only": only, "settings": given_changes(options, island)}
    with Offscreen((16, 16), place=island.name, **given) as offscreen:
        offscreen.look(island.start)
        assert isinstance(offscreen.scene, Island)
        planted = offscreen.scene.sprites
    assert planted is not None
    sprites = planted.sprites
    write_whole(options.file, as_csv(sprites).encode())
    if not options.quiet:
        print(f"{options.file}: {len(sprites.cells)} sprites")
        print(f"landscape walk --set transparent.places={options.file}")
    return 0
