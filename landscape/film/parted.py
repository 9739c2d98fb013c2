"""Drawing a film into a folder of parts: what is missing is drawn, and what fails is told.

The parts that are there are the checkpoint: a run that was cut off, by whatever, is repeated with
the same command. A part that fails TRIES times is left out, and the others go on.
"""

import time
from collections import Counter, deque
from collections.abc import Callable, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    wait,
)
from contextlib import AbstractContextManager
from pathlib import Path

from framelens.base.engine import EngineGone
from framelens.base.errors import InputError, Message, NoOpenGLError, located
from framelens.base.executor import KILLED, WorkerKilled
from framelens.base.output import write_whole
from framelens.base.progress import Progress
from landscape.film.cut import Film
from landscape.film.encode import Format, format_of, joined
from landscape.film.folder import Parts, plan_of
from landscape.film.frames import DIED, TooLarge, close, packed, part, part_count, samples, single
from landscape.film.sound import sound_part
from landscape.maker import maker

TRIES = 3
POLL = 1.0  # chosen: seconds between two looks at what others have done
LOST = "the engine that draws is gone: run the same command again, it draws what is missing"

Pool = Callable[[], AbstractContextManager[Executor]]
"""A function that opens the workers, once more after one of them has been killed."""


class Parting:
    """A film that is being drawn in parts, by ``jobs`` workers at a time."""

    def __init__(self, film: Film, parts: Parts, format: Format, jobs: int, share: bool) -> None:
        """Draw nothing yet; ``share``: other processes draw parts of it, too."""
        self.parts = parts
        self.failed: dict[int, str | Message] = {}
        self._task = packed(film), format
        self._jobs, self._share = jobs, share
        self._todo = deque(parts.missing())
        self._tries: Counter[int] = Counter()
        self._pending: dict[Future[bytes], int] = {}
        self._broken = False  # a process of the executor has been killed
        self._begun = False  # the executor has taken a part

    @property
    def missing(self) -> int:
        """How many parts are not there and have not failed."""
        return len(self._todo)

    def work(self, executor: Executor, progress: Progress) -> None:
        """Draw what is missing, until there is no more or a process of the executor is killed."""
        self._broken = self._begun = False
        with self.parts.claims.kept():
            while (self._todo and not self._broken) or self._pending:
                if not self._broken:
                    self._submit(executor, progress)
                if not self._pending:
                    if self._todo:
                        time.sleep(POLL)  # others draw all that is missing
                    continue
                timeout = POLL if self._share else None
                done, _ = wait(self._pending, timeout, FIRST_COMPLETED)
                for future in done:
                    self._take(future, self._pending.pop(future), progress)

    def _submit(self, executor: Executor, progress: Progress) -> None:
        """Claim parts and hand them over, as many as keep the workers busy."""
        for _ in range(len(self._todo)):
            # Who was at work when a process was killed is not known; the last try is made alone.
            last = self._tries[self._todo[0]] == TRIES - 1
            alone = any(self._tries[number] == TRIES - 1 for number in self._pending.values())
            if len(self._pending) >= self._jobs or alone or (last and self._pending):
                return
            number = self._todo.popleft()
            if self._is_there(number):
                progress.step("frames", len(self.parts.plan.frames_of(number)))
            elif not self._claimed(number):
                self._todo.append(number)
            elif not self._handed_over(executor, number):
                return

    def _handed_over(self, executor: Executor, number: int) -> bool:
        """Hand a part over; return False if a process of the executor has been killed meanwhile."""
        try:
            future = executor.submit(part, *self._task, number)
        except BrokenExecutor:
            if not self._begun:
                raise InputError(DIED) from None  # an executor that will never work
            # Only the parts that were at work then have failed.
            self._broken = True
            self.parts.claims.release(self.parts.name(number))
            self._todo.appendleft(number)
            return False
        self._begun = True
        self._pending[future] = number
        return True

    def _is_there(self, number: int) -> bool:
        return self.parts.path(number).exists()

    def _claimed(self, number: int) -> bool:
        """Return whether a part is this process's to draw; InputError if it should have been."""
        claims, name = self.parts.claims, self.parts.name(number)
        if claims.take(name):
            if not self._is_there(number):
                return True
            claims.release(name)  # another process has just written it
            return False
        if not self._share:
            raise InputError(
                "--parts {folder}: {holder} draws this film: with --share both do",
                folder=self.parts.folder,
                holder=str(claims.holder(name) or "another process"),
            )
        return False

    def _take(self, future: Future[bytes], number: int, progress: Progress) -> None:
        """Take the result of a task."""
        try:
            data = future.result()
        except EngineGone:
            raise InputError(LOST) from None
        except BrokenExecutor:
            self._broken = True
            self._note(number, Message(KILLED))
        except WorkerKilled:
            self._note(number, Message(KILLED))
        except TooLarge as error:
            self._note(number, Message(str(error.args[0]), **error.values))
        except (InputError, NoOpenGLError):
            raise  # it would be the same for all parts
        except Exception as error:
            self._note(number, located(error))
        else:
            self.parts.store(number, data)
            progress.step("frames", len(self.parts.plan.frames_of(number)))

    def _note(self, number: int, reason: str | Message) -> None:
        """Note that a part has failed: try it once more, or give it up."""
        self.parts.claims.release(self.parts.name(number))
        self._tries[number] += 1
        if self._tries[number] < TRIES:
            self._todo.append(number)
        else:
            self.failed[number] = reason

    def told(self) -> list[Message]:
        """Return a line for each part that has failed: its frames, and why."""
        lines = []
        for number, why in sorted(self.failed.items()):
            frames = self.parts.plan.frames_of(number)
            lines.append(
                Message(
                    "frames {first} to {last}: {why} (tried {tries} times)",
                    first=frames[0],
                    last=frames[-1],
                    why=why,
                    tries=TRIES,
                )
            )
        return lines


def draw(
    film: Film,
    folder: Path,
    ending: str,
    pool: Pool,
    jobs: int,
    share: bool = False,
    sources: Sequence[str] = (),
    quiet: bool = True,
) -> Parting:
    """Draw the parts of a film that a folder lacks; return what there is to tell of them.

    ``ending`` is that of the film's file, ``sources`` are told by the folder's status. InputError
    and NoOpenGLError, as they are raised where a part is drawn, end it; and so does Ctrl-C. The
    parts that are there stay.
    """
    parting: Parting | None = None
    try:
        with Progress(film.frames, quiet) as progress:
            while parting is None or parting.missing:
                with pool() as workers:
                    if parting is None:
                        parting = _begun(film, folder, ending, workers, jobs, share, sources)
                        there = parting.parts.drawn_frames()
                        progress.step("frames", there)
                    parting.work(workers, progress)
    finally:
        close()
    return parting


def _begun(
    film: Film,
    folder: Path,
    ending: str,
    workers: Executor,
    jobs: int,
    share: bool,
    sources: Sequence[str],
) -> Parting:
    """Return a film of which nothing is drawn yet in this run; a GIF gets its palette first."""
    backend = film.drawing.backend if film.needs_opengl else ""
    # Of each worker that will get a part, so that all start at once.
    count = part_count(film, Format(ending, film.drawing.size, film.fps))
    who = single(workers, maker, backend, times=min(jobs, count))
    parts = Parts.begun(folder, plan_of(film, ending, who, sources))
    if ending == ".gif" and not parts.palette.is_file():
        found = format_of(
            folder / f"film{ending}",
            film.drawing.size,
            film.fps,
            lambda: samples(film, workers, jobs),
        )
        write_whole(parts.palette, found.palette)
    if film.sound and not parts.sound.is_file():
        # Who shares the folder may make it, too: it is the same.
        write_whole(parts.sound, single(workers, sound_part, packed(film), ending))
    return Parting(film, parts, parts.format(), jobs, share)


def join(parts: Parts, out: Path) -> None:
    """Join the parts of a film into its file; InputError where some are missing."""
    missing = parts.missing()
    if missing:
        raise InputError(
            "{folder}: {missing} of {count} parts of {name} are missing: run the same "
            "`film --parts` again",
            folder=parts.folder,
            missing=len(missing),
            count=parts.plan.parts,
            name=f"film-{parts.plan.hash}.json",
        )
    file = joined(out, parts.format(), parts.read_sound())
    try:
        for number in range(parts.plan.parts):
            frames = len(parts.plan.frames_of(number))
            file.add(parts.read(number), frames, str(parts.path(number)))
        file.finish()
    finally:
        file.discard()


def status(parts: Parts) -> list[Message]:
    """Return lines that say which parts are there, who works on what, and how long it takes."""
    plan, missing = parts.plan, parts.missing()
    lines = [
        Message(
            "{name}: {sources}, {frames} frames of {width}x{height} at {fps} per second",
            name=f"film-{plan.hash}.json",
            sources=" ".join(plan.sources),
            frames=plan.frames,
            width=plan.size[0],
            height=plan.size[1],
            fps=f"{float(plan.format.fps):g}",
        ),
        Message("{there} of {count} parts", there=plan.parts - len(missing), count=plan.parts),
    ]

    for number, holder in sorted(parts.at_work().items()):
        frames = plan.frames_of(number)
        lines.append(
            Message(
                "frames {first} to {last}: {holder}, for {minutes:.1f} min",
                first=frames[0],
                last=frames[-1],
                holder=str(holder),
                minutes=holder.held / 60,
            )
        )

    left = parts.seconds_left()
    if missing and left is not None:
        lines.append(Message("about {minutes:.0f} min more", minutes=max(left / 60, 1.0)))
    return lines
