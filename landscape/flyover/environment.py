"""Environments: a terrain, a path over it, and points to look at (section 2.3).

An environment is a file drawn in Inkscape (:mod:`landscape.files.svg_environment`), or one of those
that come with the program, by its name.
"""

import hashlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from framelens.base.errors import InputError, Message
from framelens.base.output import write_whole
from landscape.files.assets import shipped
from landscape.files.svg_environment import SvgEnvironment, read
from landscape.files.svg_writing import environment_text
from landscape.flyover import island
from landscape.flyover.flight import Flight
from landscape.flyover.height_field import HeightField, check_image, height_field
from landscape.flyover.settings import Flyover
from landscape.geometry.bezier import BezierPath

ISLAND = "island"
NAMES = (ISLAND, "alps", "canyon")  # of those that come with the program
PREFIX = "flyover_"  # of their files
WHITE16 = np.float32(257.0)  # a grey of 16 bits over one of 8
SHORTEST = 1.0  # pixels, chosen: the length of a path


@dataclass(frozen=True)
class Environment(SvgEnvironment):
    """An environment that is flown over: its image holds heights."""

    @property
    def side(self) -> int:
        """The number of pixels on the image's longer side."""
        return max(self.image.shape)

    @cached_property
    def hash(self) -> str:
        """A hash of all that is flown over and along; two environments are the same by it."""
        digest = hashlib.blake2b(digest_size=20)
        for part in (self.image.astype(np.float32), *self.subpaths, self.targets):
            digest.update(repr(part.shape).encode() + np.ascontiguousarray(part).tobytes())
        return digest.hexdigest()

    @cached_property
    def path(self) -> BezierPath:
        """The camera's path, in pixels."""
        return BezierPath(self.subpaths)

    def field(self, settings: Flyover) -> HeightField:
        """Return the terrain; it is computed anew at each call."""
        return height_field(self.image, settings, self.name)

    def duration(self, settings: Flyover) -> float:
        """Return how long a flight along the path takes, in seconds."""
        return self.path.length * settings.unit / settings.speed

    def flight(self, field: HeightField, settings: Flyover) -> Flight:
        """Return the flight along the path over a terrain."""
        path = BezierPath([each * settings.unit for each in self.subpaths])
        return Flight(path, self.targets * settings.unit, field.height, settings)


def open_environment(file: str | Path, any_size: bool = False) -> Environment:
    """Return the environment in an SVG file, or a shipped one by its name.

    Its image has sides that are powers of two, unless it may have ``any_size``. InputError, one
    line, where something is missing or wrong.
    """
    path = Path(file)
    if str(file) in NAMES and not path.exists():
        if str(file) == ISLAND:
            return Environment(ISLAND, island.image() / WHITE16, (island.path(),), island.targets())
        path = shipped() / f"{PREFIX}{file}.svg"
    elif path.suffix.lower() != ".svg":
        raise InputError(
            "{file}: expected a file that ends in .svg, or one of {names}",
            file=file,
            names=", ".join(NAMES),
        )
    found = read(path)
    environment = Environment(str(file), found.image, found.subpaths, found.targets, found.notices)
    return checked(environment, any_size, path)


def checked(environment: Environment, any_size: bool, path: Path | str = "") -> Environment:
    """Return an environment whose path and points are on its map; InputError names ``path``."""
    path = path or environment.name
    check_image(environment.image, f"{path}: height image", any_size)
    if environment.path.length < SHORTEST:
        raise InputError(
            "{path}: expected a path of at least {shortest:g} pixel", path=path, shortest=SHORTEST
        )
    flown = environment.path.at(np.linspace(0, environment.path.length, 100_000))
    for places, what in (
        (flown, Message("the path")),
        (environment.targets, Message("a point to look at")),
    ):
        height, width = environment.image.shape
        outside = places[((places < 0) | (places > (width, height))).any(axis=1)]
        if len(outside):
            x, y = outside[0]
            ends = Message(
                "x from 0 to {width} and y from 0 to {height}", width=width, height=height
            )
            if width == height:
                ends = Message("x and y from 0 to {width}", width=width)
            raise InputError(
                "{path}: {what} is outside the map: expected {ends} pixels, not {x:.6g}, {y:.6g}",
                path=path,
                what=what,
                ends=ends,
                x=x,
                y=y,
            )

    return environment


def export_island(path: Path) -> None:
    """Write the environment of the island as an SVG for Inkscape, whole or not at all.

    InputError if it cannot be written, its name does not end in .svg, so that it could not be
    opened, or another drawing has it: somebody may have meant to read that one.
    """
    if path.suffix.lower() != ".svg":
        raise InputError("{path}: expected a name that ends in .svg", path=path)
    text = environment_text(island.image(), [island.path()], island.targets()).encode()
    if path.is_file() and path.read_bytes() != text:
        raise InputError(
            "{path}: is there already, expected the name of a new file; what a drawing holds is "
            "written by: flyover {path} --export DIR",
            path=path,
        )
    write_whole(path, text)
