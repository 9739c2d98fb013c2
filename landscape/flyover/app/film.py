"""`landscape flyover --out FILE.mp4`: a film of the software fly-over, drawn by all cores."""

import argparse
from fractions import Fraction

from framelens.base.errors import InputError
from framelens.system.processes import cores
from landscape.film.along import Software
from landscape.film.cut import Film, Part
from landscape.film.encode import check
from landscape.film.making import finished, write
from landscape.film.stage import Drawing
from landscape.flyover.app import SIZE
from landscape.flyover.environment import Environment
from landscape.flyover.settings import Settings
from landscape.frame import SEED


def run(environment: Environment, values: Settings, options: argparse.Namespace) -> int:
    """Draw the flight, or its first --frames frames, to a film; return the exit status."""
    rate = Fraction(options.fps).limit_denominator(1001)
    if options.frames == 0:
        raise InputError("--frames 0: expected a number from 1")
    if options.frames is None:
        seconds = max(environment.duration(values.flyover) - options.at, 1 / float(rate))
    else:
        seconds = options.frames / float(rate)
    drawing = Drawing(options.size or SIZE, 0, "auto", None, SEED)
    check(options.out, drawing.size, rate)
    film = Film((Part(Software(environment, values, seconds, options.at)),), drawing, rate)
    return finished(film, write(film, options.out, options.jobs or cores(), options.quiet), options)
