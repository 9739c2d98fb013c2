"""Changed worlds as files: the blocks that differ from the land that is made anew each time.

The first line is JSON: the format's version, what the land was made from, the names of the kinds of
blocks, how many blocks have changed, and a digest of what follows. That is, compressed by zlib, the
place of each changed block in the array (uint32) and then the kind of each (uint8), its place in
the list of names.
"""

import hashlib
import json
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from framelens.base.errors import InputError, short
from landscape.voxel.blocks import BLOCKS, NUMBERS
from landscape.voxel.world import Cell, World

VERSION = 1
HEAD = "landscape voxel world"
LONGEST_HEAD = 1 << 16  # bytes, chosen
MOST_CHANGES = 32 << 20  # blocks, chosen: what fits into 160 MB
PLACE, KIND = np.dtype("<u4"), np.dtype("u1")
WHAT = "expected a file that `walk voxel --world` has saved"


def encoded(world: World, land: Mapping[str, Any]) -> bytes:
    """Return a world's changes as the content of a file; ``land`` says what it is made from."""
    cells = np.array(sorted(world.former), np.intp).reshape(-1, 3)
    places = np.ravel_multi_index(tuple(cells.T), world.blocks.shape).astype(PLACE)
    kinds = world.blocks[tuple(cells.T)].astype(KIND)
    body = zlib.compress(places.tobytes() + kinds.tobytes(), 6)
    head = {
        HEAD: VERSION,
        "land": dict(land),
        "kinds": [each.name for each in BLOCKS],
        "changes": len(cells),
        "digest": hashlib.sha256(body).hexdigest(),
    }
    return json.dumps(head).encode() + b"\n" + body


def decoded(data: bytes, name: str, world: World, land: Mapping[str, Any]) -> dict[Cell, int]:
    """Return the blocks that a file's content changes; ``name`` stands for the file in messages.

    InputError if it is no such file, is damaged, or belongs to a land made from something else.
    """
    head, body = _head(data, name)
    _check_land(head.get("land"), name, land)
    count, digest = head.get("changes"), head.get("digest")
    if type(count) is not int or not 0 <= count <= MOST_CHANGES:
        raise InputError(
            "{name}: changes {count}: expected a number of blocks", name=name, count=short(count)
        )
    if hashlib.sha256(body).hexdigest() != digest:
        raise InputError(
            "{name}: truncated or damaged: its digest is another; {what}", name=name, what=WHAT
        )
    numbers = _kinds(head.get("kinds"), name)
    size = count * (PLACE.itemsize + KIND.itemsize)
    try:
        unpacked = zlib.decompressobj().decompress(body, size + 1)
    except zlib.error:
        raise InputError("{name}: cannot be decompressed; {what}", name=name, what=WHAT) from None

    if len(unpacked) != size:
        raise InputError(
            "{name}: expected {count} changed blocks, as its first line says",
            name=name,
            count=count,
        )
    places = np.frombuffer(unpacked, PLACE, count)
    kinds = np.frombuffer(unpacked, KIND, count, count * PLACE.itemsize)
    if count and int(places.max()) >= world.blocks.size:
        raise InputError("{name}: changes a block outside the map", name=name)
    if count and int(kinds.max()) >= len(numbers):
        raise InputError(
            "{name}: has a block of an unknown kind, {int}", name=name, int=int(kinds.max())
        )
    cells = np.stack(np.unravel_index(places, world.blocks.shape), axis=1).tolist()
    found = np.array(numbers, np.intp)[kinds].tolist()
    return {(x, z, y): kind for (x, z, y), kind in zip(cells, found, strict=True)}


def _head(data: bytes, name: str) -> tuple[dict[str, Any], bytes]:
    """Return the first line of a file and what follows."""
    line, newline, body = data.partition(b"\n")
    head: Any = None
    if newline and len(line) <= LONGEST_HEAD:
        try:
            head = json.loads(line)
        except (ValueError, RecursionError):
            head = None
    if not isinstance(head, dict) or HEAD not in head:
        found = "an empty file" if not data else "something else"
        raise InputError("{name}: {what}, found {value}", name=name, what=WHAT, value=found)
    if type(head[HEAD]) is not int or head[HEAD] != VERSION:
        raise InputError(
            "{name}: version {head} of the format: expected {version}",
            name=name,
            head=short(head[HEAD]),
            version=VERSION,
        )
    return head, body


def _check_land(found: Any, name: str, land: Mapping[str, Any]) -> None:
    """Raise InputError unless a file belongs to this land."""
    if not isinstance(found, dict):
        raise InputError(
            "{name}: does not say what its land is made from; {what}", name=name, what=WHAT
        )
    for key, value in land.items():
        if type(found.get(key)) is not type(value) or found[key] != value:
            raise InputError(
                "{name}: made with {key} {get}: expected {value}, as for the land that it "
                "is to change",
                name=name,
                key=key,
                get=short(found.get(key)),
                value=short(value),
            )


def _kinds(names: Any, name: str) -> list[int]:
    """Return the numbers of kinds of blocks by their names."""
    if not isinstance(names, list) or not names:
        raise InputError(
            "{name}: does not name the kinds of its blocks; {what}", name=name, what=WHAT
        )
    for each in names:
        if not isinstance(each, str) or each not in NUMBERS:
            raise InputError("{name}: unknown kind of block {kind}", name=name, kind=short(each))
    return [NUMBERS[each] for each in names]
