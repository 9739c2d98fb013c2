"""A folder of a film's parts: the part that is there is done, whoever looks, and whenever.

``film-HASH.json`` says which film it is, ``part-00017-HASH.mp4`` is a part of it. The hash is that
of the film, of its format and of who draws it, so parts of another film, of another version or of
another renderer are never joined with these. A part appears whole or not at all. Whoever draws one
holds its claim (framelens/base/claims.py).
"""

import hashlib
import json
import pickle
import statistics
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from framelens.base.claims import Claims, Holder
from framelens.base.errors import InputError, reason
from framelens.base.output import write_whole
from landscape.files.assets import Assets
from landscape.film.cut import Film
from landscape.film.encode import Format
from landscape.maker import Maker

VERSION = 1
NAME_BYTES = 8  # of the hash in a name
MOST_BYTES = 1 << 20  # of a film-HASH.json, far more than one has
MOST_FRAMES = 10_000_000  # far more than a film has
RECENT = 12  # chosen: parts by whose times the rest of the work is estimated


@dataclass(frozen=True)
class Plan:
    """A folder's record of its film: all that joining needs, and who draws it."""

    frames: int
    length: int
    ending: str
    size: tuple[int, int]
    fps: str
    film: str
    maker: dict[str, str]
    sources: tuple[str, ...] = ()
    sound: bool = False

    @property
    def format(self) -> Format:
        """The format of the file, but for the palette of a GIF."""
        return Format(self.ending, *self.picture)

    @property
    def picture(self) -> tuple[tuple[int, int], Fraction]:
        """Size in pixels, and frames per second."""
        return self.size, Fraction(self.fps)

    @property
    def parts(self) -> int:
        """How many parts there are."""
        return -(-self.frames // self.length)

    @cached_property
    def hash(self) -> str:
        """The hash in the names of the files."""
        known = {**asdict(self), "sources": ()}
        return _hashed(json.dumps(known, sort_keys=True).encode())

    def frames_of(self, number: int) -> range:
        """Return the numbers of a part's frames."""
        return range(number * self.length, min((number + 1) * self.length, self.frames))


def plan_of(film: Film, ending: str, maker: Maker, sources: Sequence[str]) -> Plan:
    """Return the plan of a film that a maker draws."""
    format = Format(ending, film.drawing.size, film.fps)
    return Plan(
        film.frames,
        format.length,
        ending,
        film.drawing.size,
        str(film.fps),
        film_hash(film),
        maker.values,
        tuple(sources),
        film.sound,
    )


def film_hash(film: Film) -> str:
    """Return a hash of what a film shows, with the contents of the files that it is made from."""
    digest = hashlib.blake2b(digest_size=NAME_BYTES)
    texts: list[str] = []
    for part in _described(film, texts):
        digest.update(len(part).to_bytes(8, "little") + part)
    if film.needs_opengl:
        for content in Assets(film.drawing.assets).contents(*dict.fromkeys(texts)):
            digest.update(content)
    return digest.hexdigest()


def _described(value: object, texts: list[str]) -> Iterator[bytes]:
    """Yield bytes that say what a value is, the same in each process; collect the texts in it."""
    yield type(value).__name__.encode()
    if is_dataclass(value):
        for field in fields(value):
            yield field.name.encode()
            yield from _described(getattr(value, field.name), texts)
    elif isinstance(value, dict):
        for key in sorted(value, key=repr):
            yield from _described(key, texts)
            yield from _described(value[key], texts)
    elif isinstance(value, (tuple, list)):
        yield str(len(value)).encode()
        for each in value:
            yield from _described(each, texts)
    elif isinstance(value, np.ndarray):
        yield repr((value.dtype.str, value.shape)).encode()
        yield value.tobytes()
    elif isinstance(value, (str, Path)):
        texts.append(str(value))
        yield str(value).encode()
    elif isinstance(value, (int, float, Fraction, type(None))):
        yield repr(value).encode()
    else:
        yield pickle.dumps(value)


def _hashed(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=NAME_BYTES).hexdigest()


class Parts:
    """The parts of one film in a folder."""

    def __init__(self, folder: Path, plan: Plan) -> None:
        """Write nothing yet."""
        self.folder, self.plan = folder, plan
        self.claims = Claims(folder)

    @classmethod
    def begun(cls, folder: Path, plan: Plan) -> "Parts":
        """Return the parts of a film that is to be drawn; InputError if the folder forbids it.

        That is so while others draw the same film there in another way: theirs are not joined with
        these.
        """
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(
                "--parts {folder}: cannot be created ({reason})",
                folder=folder,
                reason=reason(error),
            ) from None

        parts = cls(folder, plan)
        for other in plans(folder):
            if other.film == plan.film and other.maker != plan.maker:
                busy = Parts(folder, other).at_work()
                if busy:
                    expected, mine = Maker(**other.maker), Maker(**plan.maker)
                    raise InputError(
                        "--parts {folder}: {holder} draws this film there; here is another {what}",
                        folder=folder,
                        holder=str(next(iter(busy.values()))),
                        what=expected.differences(mine),
                    )

        path = folder / f"film-{plan.hash}.json"
        if not path.is_file():
            data = {"version": VERSION, **asdict(plan)}
            write_whole(path, f"{json.dumps(data, indent=1)}\n".encode())
        return parts

    def name(self, number: int) -> str:
        """Return the name of a part, without its ending."""
        return f"part-{number:05}-{self.plan.hash}"

    def path(self, number: int) -> Path:
        """Return the file of a part."""
        return self.folder / f"{self.name(number)}{self.plan.ending}"

    @property
    def palette(self) -> Path:
        """The file of a GIF's palette, RGB, a byte each."""
        return self.folder / f"palette-{self.plan.hash}.rgb"

    @property
    def sound(self) -> Path:
        """The file of the film's sound."""
        return self.folder / f"sound-{self.plan.hash}{self.plan.ending}"

    def read_sound(self) -> bytes:
        """Return the film's sound, nothing if it has none; InputError if it is not there."""
        return _content(self.sound) if self.plan.sound else b""

    def missing(self) -> list[int]:
        """Return the numbers of the parts that are not there."""
        there = {path.name for path in self.folder.glob(f"part-*-{self.plan.hash}*")}
        return [k for k in range(self.plan.parts) if self.path(k).name not in there]

    def drawn_frames(self) -> int:
        """Return how many frames are in the parts that are there."""
        return self.plan.frames - sum(len(self.plan.frames_of(k)) for k in self.missing())

    def store(self, number: int, data: bytes) -> None:
        """Write a part, and give up its claim; InputError where it cannot be written."""
        write_whole(self.path(number), data)
        self.claims.release(self.name(number))

    def at_work(self) -> dict[int, Holder]:
        """Return who works on which part now."""
        found = {}
        numbers = {self.name(number): number for number in self.missing()}
        for name, holder in self.claims.holders().items():
            if name in numbers and not holder.gone:
                found[numbers[name]] = holder
        return found

    def read(self, number: int) -> bytes:
        """Return a part; InputError if it is not there."""
        return _content(self.path(number))

    def format(self) -> Format:
        """Return the format of the film; InputError where the palette of a GIF is missing."""
        plan = self.plan
        if plan.ending != ".gif":
            return plan.format
        try:
            palette = self.palette.read_bytes()
        except OSError as error:
            raise InputError(
                "{path}: cannot be read ({reason})", path=self.palette, reason=reason(error)
            ) from None
        return Format(plan.ending, *plan.picture, palette)

    def seconds_left(self) -> float | None:
        """Return how many seconds the missing parts take, by the times of the last ones."""
        numbers = set(range(self.plan.parts)) - set(self.missing())
        times = sorted(self.path(number).stat().st_mtime for number in numbers)[-RECENT:]
        if len(times) < 2:
            return None
        each = statistics.median(b - a for a, b in zip(times, times[1:], strict=False))
        return each * (self.plan.parts - len(numbers))


def _content(path: Path) -> bytes:
    """Return the content of a file; InputError if it is not there."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputError(
            "{path}: cannot be read ({reason})", path=path, reason=reason(error)
        ) from None


def plans(folder: Path) -> list[Plan]:
    """Return the plans of all films in a folder; InputError for a file that is none."""
    return [read_plan(path) for path in sorted(folder.glob("film-*.json"))]


def read_plan(path: Path) -> Plan:
    """Return the plan in a film-HASH.json; InputError where it is none."""
    try:
        with open(path, "rb") as file:
            data = json.loads(file.read(MOST_BYTES))
        if data.pop("version") != VERSION:
            raise ValueError

        known: dict[str, Callable[[Any], Any]] = {
            "frames": _count,
            "length": _count,
            "ending": str,
            "size": lambda size: (_count(size[0]), _count(size[1])),
            "fps": lambda text: str(Fraction(text)),
            "film": str,
            "maker": lambda values: asdict(Maker(**{k: str(v) for k, v in values.items()})),
            "sources": lambda words: tuple(map(str, words)),
            "sound": lambda sound: bool(sound),
        }
        plan: Plan | None = Plan(**{name: read(data[name]) for name, read in known.items()})
    except OSError as error:
        raise InputError(
            "{path}: cannot be read ({reason})", path=path, reason=reason(error)
        ) from None
    except (ValueError, TypeError, LookupError, AttributeError, ArithmeticError, RecursionError):
        plan = None

    if plan is None or path.name != f"film-{plan.hash}.json":
        raise InputError("{path}: expected a film's plan, as --parts writes it", path=path)
    return plan


def _count(value: object) -> int:
    if not isinstance(value, int) or not 0 < value <= MOST_FRAMES:
        raise ValueError
    return value


def opened(given: Path, option: str) -> list[Parts]:
    """Return the films in a folder, or that of a film-HASH.json; InputError if there is none."""
    if given.suffix == ".json":
        return [Parts(given.parent, read_plan(given))]
    if not given.is_dir():
        raise InputError("{option} {folder}: no such folder", option=option, folder=given)
    found = [Parts(given, plan) for plan in plans(given)]
    if not found:
        raise InputError(
            "{option} {folder}: no film: expected a folder that `film --parts` has made",
            option=option,
            folder=given,
        )
    return found
