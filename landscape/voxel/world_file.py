"""Changed worlds as files: the blocks that differ from the land that is made anew each time.

The first line is JSON: the format's version, what the land was made from, the names of the kinds of
blocks, how many blocks have changed, and a digest of what follows. That is, compressed by zlib, the
place of each changed block in the array (uint32, increasing) and then the kind of each (uint8), its
place in the list of names.
"""

import hashlib
import json
import zlib
from collections.abc import Mapping

import numpy as np

from framelens.base.errors import InputError, Message, short
from landscape.voxel.blocks import BLOCKS, NUMBERS
from landscape.voxel.world import Changes, World

VERSION = 1
HEAD = "landscape voxel world"
LONGEST_HEAD = 1 << 16  # bytes, chosen
MOST_CHANGES = 500_000  # blocks, chosen: who digs five a second has them after 27 hours
PLACE, KIND = np.dtype("<u4"), np.dtype("u1")
UNCHANGED = -1  # beside the kinds of blocks
WHAT = Message("expected a file that `walk voxel --world` has saved")


def encoded(changes: Changes, land: Mapping[str, object]) -> bytes:
    """Return changes as the content of a file; ``land`` says what it is made from."""
    places, kinds = changes.places.astype(PLACE), changes.kinds.astype(KIND)
    body = zlib.compress(places.tobytes() + kinds.tobytes(), 6)
    head = {
        HEAD: VERSION,
        "land": dict(land),
        "kinds": [each.name for each in BLOCKS],
        "changes": len(places),
        "digest": hashlib.sha256(body).hexdigest(),
    }
    return json.dumps(head).encode() + b"\n" + body


def decoded(data: bytes, name: str, world: World, land: Mapping[str, object]) -> Changes:
    """Return the blocks that a file's content changes; ``name`` stands for the file in messages.

    InputError if it is no such file, is damaged, or belongs to a land made from something else.
    """
    head, body = _head(data, name)
    _check_land(head.get("land"), name, land)
    count, digest = head.get("changes"), head.get("digest")
    if type(count) is not int or not 0 <= count <= MOST_CHANGES:
        raise InputError(
            "{name}: changes {count}: expected a number of blocks, at most {most}",
            name=name,
            count=short(count),
            most=MOST_CHANGES,
        )
    if hashlib.sha256(body).hexdigest() != digest:
        raise InputError(
            "{name}: truncated or damaged: its digest is another; {what}", name=name, what=WHAT
        )
    numbers = _kinds(head.get("kinds"), name)
    unpacked = _unpacked(body, count, name)
    places = np.frombuffer(unpacked, PLACE, count).astype(np.intp)
    kinds = np.frombuffer(unpacked, KIND, count, count * PLACE.itemsize)
    if count and int(places.max()) >= world.blocks.size:
        raise InputError("{name}: changes a block outside the map", name=name)
    if (np.diff(places) <= 0).any():
        raise InputError("{name}: expected each changed block once, in order", name=name)
    if count and int(kinds.max()) >= len(numbers):
        raise InputError(
            "{name}: has a block of an unknown kind, {int}", name=name, int=int(kinds.max())
        )
    return Changes(places, np.array(numbers, np.uint8)[kinds])


def merged(base: Changes, mine: Changes, theirs: Changes) -> tuple[Changes, int]:
    """Return what two walks have changed that both began with ``base``, each somewhere else.

    Also in how many places they have made different changes; there it is ``mine``.
    """
    places = np.unique(np.concatenate([each.places for each in (base, mine, theirs)]))
    was, now, other = (_at(places, each) for each in (base, mine, theirs))
    here, there = now != was, other != was
    kinds = np.where(here, now, other)
    changed = kinds != UNCHANGED
    conflicts = here & there & (now != other)
    found = Changes(places[changed], kinds[changed].astype(np.uint8))
    return found, int(np.count_nonzero(conflicts))


def _at(places: np.ndarray, changes: Changes) -> np.ndarray:
    """Return the kinds (n,) of changes at places (n,) that include theirs, else UNCHANGED."""
    kinds = np.full(len(places), UNCHANGED)
    kinds[np.searchsorted(places, changes.places)] = changes.kinds
    return kinds


def _unpacked(body: bytes, count: int, name: str) -> bytes:
    """Return the places and kinds of ``count`` blocks."""
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
    return unpacked


def _head(data: bytes, name: str) -> tuple[dict[str, object], bytes]:
    """Return the first line of a file and what follows."""
    line, newline, body = data.partition(b"\n")
    head: object = None
    if newline and len(line) <= LONGEST_HEAD:
        try:
            head = json.loads(line)
        except (ValueError, RecursionError):
            head = None
    if not isinstance(head, dict) or HEAD not in head:
        value = Message("something else") if data else Message("an empty file")
        raise InputError("{name}: {what}, found {value}", name=name, what=WHAT, value=value)
    if type(head[HEAD]) is not int or head[HEAD] != VERSION:
        raise InputError(
            "{name}: version {head} of the format: expected {version}",
            name=name,
            head=short(head[HEAD]),
            version=VERSION,
        )
    return head, body


def _check_land(found: object, name: str, land: Mapping[str, object]) -> None:
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


def _kinds(names: object, name: str) -> list[int]:
    """Return the numbers of kinds of blocks by their names."""
    if not isinstance(names, list) or not names:
        raise InputError(
            "{name}: does not name the kinds of its blocks; {what}", name=name, what=WHAT
        )
    for each in names:
        if not isinstance(each, str) or each not in NUMBERS:
            raise InputError("{name}: unknown kind of block {kind}", name=name, kind=short(each))
    return [NUMBERS[each] for each in names]
