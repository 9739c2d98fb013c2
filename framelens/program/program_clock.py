"""The held clock: what a program reads as the time depends on its frames alone, so that it repeats.

Frame n begins n/60 of a second after the start (chosen), or later if the program sleeps: sleeping
takes no time, and moves the clock. A loop that waits by reading the clock over and over ends,
because many readings in one frame move it, too. Random numbers begin from a fixed seed.
"""

import datetime
import random
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np

RATE = 60.0  # frames in a second, chosen
SEED = 2006  # chosen
EPOCH = 1164974400.0  # time.time() at the start: 2006-12-01 12:00 UTC, chosen
STARTED = 1000.0  # time.monotonic() and its like at the start, in seconds, chosen
# Readings in one frame before each further one moves the clock, and by how many seconds; chosen.
READINGS = 1000
STEP = 1e-5


class Clock:
    """Seconds since the program's start; ``held`` says whether the program is running.

    With ``true``, which returns seconds, the clock is not held: it goes as that one does.
    """

    def __init__(self, true: Callable[[], float] | None = None) -> None:
        self._true = true
        self._began = true() if true is not None else 0.0
        self.now = 0.0
        self.held = False
        self.waits: Callable[[float], None] | None = None  # lets a wait take its time, if anything
        self._readings = 0
        self._thread = threading.get_ident()

    def begin_frame(self, number: int) -> None:
        """Move the clock on to the beginning of a frame."""
        self.now = max(self.now, number / RATE)
        self._readings = 0

    def read(self) -> float:
        """Return the seconds since the start."""
        if self._true is not None:
            self.now = self._true() - self._began
            return self.now
        self._readings += 1
        if self._readings > READINGS:
            self.now += STEP
        return self.now

    def move(self, seconds: float) -> None:
        """Move the clock on, as sleeping does; one that is not held moves by itself."""
        self.now += max(0.0, seconds)
        if self.waits is not None:
            self.waits(max(0.0, seconds))

    @contextmanager
    def released(self) -> Iterator[None]:
        """Give the true time inside the block."""
        before, self.held = self.held, False
        try:
            yield
        finally:
            self.held = before

    @contextmanager
    def holding(self) -> Iterator[None]:
        """Hold the clock and fix the seeds of random numbers, for the program in the block."""
        with ExitStack() as stack:
            if self._true is not None:
                yield
                return
            for module, name, held in self._replacements():
                stack.callback(setattr, module, name, getattr(module, name))
                setattr(module, name, held)
            stack.callback(random.setstate, random.getstate())
            stack.callback(np.random.set_state, np.random.get_state())
            stack.callback(setattr, np.random, "default_rng", np.random.default_rng)
            random.seed(SEED)
            np.random.seed(SEED)
            fresh = np.random.default_rng
            np.random.default_rng = lambda seed=None: fresh(SEED if seed is None else seed)
            stack.callback(setattr, self, "held", False)
            self.held = True
            yield

    def _replacements(self) -> list[tuple[object, str, object]]:
        found: list[tuple[object, str, object]] = []
        for name, start in (
            *(("time", EPOCH), ("perf_counter", STARTED), ("monotonic", STARTED)),
            *(("process_time", 0.0), ("thread_time", 0.0)),
        ):
            found.append((time, name, self._reader(getattr(time, name), start)))
            nanoseconds = self._reader(getattr(time, f"{name}_ns"), start, 10**9)
            found.append((time, f"{name}_ns", nanoseconds))
        found.append((time, "sleep", self._sleeper(time.sleep)))
        for name, at in (("localtime", 0), ("gmtime", 0), ("ctime", 0), ("strftime", 1)):
            found.append((time, name, self._formatter(getattr(time, name), at)))
        moment, day = _held_dates(self)
        return [*found, (datetime, "datetime", moment), (datetime, "date", day)]

    def _reader(
        self, true: Callable[[], object], start: float, unit: int = 0
    ) -> Callable[[], object]:
        """Return the held form of a function that reads a clock; ``unit`` for whole numbers."""

        def read() -> object:
            if not self.held:
                return true()
            return start + self.read() if not unit else round((start + self.read()) * unit)

        return read

    def _sleeper(self, true: Callable[[float], None]) -> Callable[[float], None]:
        def sleep(seconds: float) -> None:
            if self.held and threading.get_ident() == self._thread:
                if seconds < 0:
                    raise ValueError("sleep length must be non-negative")
                self.move(seconds)
            else:
                true(seconds)

        return sleep

    def _formatter(self, true: Callable[..., object], at: int) -> Callable[..., object]:
        """Return the held form of a function that takes a time, or none for the present one."""

        def formatted(*args: object) -> object:
            if self.held and len(args) == at:
                now = EPOCH + self.read()
                args += (now,) if at == 0 else (_localtime(now),)
            return true(*args)

        return formatted


_localtime = time.localtime


def _held_dates(clock: Clock) -> tuple[type, type]:
    """Return classes for datetime.datetime and datetime.date that read the held clock."""
    true_moment, true_day = datetime.datetime, datetime.date

    class Moment(type):
        def __instancecheck__(cls, value: object) -> bool:
            return isinstance(value, true_moment)

    class Day(type):
        def __instancecheck__(cls, value: object) -> bool:
            return isinstance(value, true_day)

    class HeldMoment(true_moment, metaclass=Moment):  # type: ignore[misc, valid-type]
        @classmethod
        def now(cls, tz: Any = None) -> Any:
            if not clock.held:
                return true_moment.now(tz)
            return true_moment.fromtimestamp(EPOCH + clock.read(), tz)

        @classmethod
        def today(cls) -> object:
            return cls.now()

        @classmethod
        def utcnow(cls) -> Any:
            return cls.now(datetime.UTC).replace(tzinfo=None)

    class HeldDay(true_day, metaclass=Day):  # type: ignore[misc, valid-type]
        @classmethod
        def today(cls) -> Any:
            return HeldMoment.now().date() if clock.held else true_day.today()

    for held, true in ((HeldMoment, true_moment), (HeldDay, true_day)):
        held.__name__ = held.__qualname__ = true.__name__
        held.__module__ = "datetime"
    return HeldMoment, HeldDay


def milliseconds(clock: Clock) -> int:
    """Return the held time as GLUT and pygame count it."""
    return int(clock.read() * 1000.0 + 1e-6)
