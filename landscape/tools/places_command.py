"""`landscape places`: where the island's trees, deer and plants stand, saved to a file."""

import argparse

from landscape.elements.places_file import as_csv
from landscape.errors import InputError
from landscape.files.output import check_writable, write_whole
from landscape.island import SPRITES, Island
from landscape.render import Offscreen
from landscape.scene import scene
from landscape.tools.given import given_changes, offscreen_options


def run(options: argparse.Namespace) -> int:
    """Write the file; return the exit status."""
    check_writable(options.file)
    island = scene("island")
    given = offscreen_options(options)
    only = tuple(name for name in (given["only"] or SPRITES) if name in SPRITES)
    if not only:
        raise InputError(f"--only: expected some of {', '.join(SPRITES)}")
    given |= {"only": only, "settings": given_changes(options, island)}
    with Offscreen((16, 16), place=island.name, **given) as offscreen:
        offscreen.look(island.start)
        assert isinstance(offscreen.scene, Island)
        sprites = offscreen.scene.sprites.sprites
    write_whole(options.file, as_csv(sprites).encode())
    if not options.quiet:
        print(f"{options.file}: {len(sprites.cells)} sprites")
        print(f"landscape walk --set transparent.places={options.file}")
    return 0
