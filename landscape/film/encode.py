"""The file of a film: MP4 (H.264) and WebM (VP9) by PyAV, GIF without it.

A film is encoded in parts of KEY_SECONDS, each of which needs nothing of the others, and these are
joined: so the file is the same whoever has drawn and encoded which part. It appears in its place
when it is complete, or when it is ended early: whatever has been added until then can be played.
"""

import io
import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

import numpy as np

from framelens.base.errors import InputError
from framelens.base.installation import how_to_add
from framelens.base.output import Output, check_writable
from landscape.files.gif import END, FASTEST, GifFrames, frame_count, header, palette_of
from landscape.files.gif import MOST as MOST_OF_GIF

ENDINGS = (".mp4", ".webm", ".gif")
# Codec and options by ending. Chosen: as good as one sees no difference at normal size; `veryfast`
# takes a quarter of the time of x264's default, for a tenth more bytes. Other processors would
# choose other bytes.
CODECS: dict[str, tuple[str, dict[str, str]]] = {
    ".mp4": (
        "libx264",
        {"crf": "19", "preset": "veryfast", "x264-params": "cpu-independent=1"},
    ),
    ".webm": ("libvpx-vp9", {"crf": "31", "b": "0", "cpu-used": "5", "row-mt": "1"}),
}
BITEXACT = {"fflags": "+bitexact"}  # without it, a WebM has a random number
KEY_SECONDS = 4  # chosen: seconds between pictures that need no earlier one, to which players jump
BT709 = 1  # as in ITU-T H.273: primaries, transfer and matrix of high-definition television


@dataclass(frozen=True)
class Format:
    """A film's file format: the ending of its name, size in pixels, frames per second.

    A GIF has a ``palette``, too: RGB, a byte each.
    """

    ending: str
    size: tuple[int, int]
    fps: Fraction
    palette: bytes = b""

    @property
    def length(self) -> int:
        """How many frames a part has: a part begins where a picture needs no earlier one."""
        return math.ceil(KEY_SECONDS * self.fps)

    @property
    def colours(self) -> np.ndarray:
        """The palette, uint8 (n, 3)."""
        return np.frombuffer(self.palette, np.uint8).reshape(-1, 3)


class PartEncoder(Protocol):
    """A part of a film while it is encoded."""

    def add(self, pixels: np.ndarray) -> None:
        """Add the next picture, uint8 (h, w, 3)."""

    def finish(self) -> bytes:
        """Return the part: a film of its own, or the frames of a GIF."""


class Joined(Protocol):
    """A film's file, while its parts are joined."""

    def add(self, part: bytes, frames: int, name: str = "") -> None:
        """Add the next part; InputError where it, called ``name``, has not so many frames."""

    def finish(self) -> None:
        """Complete the file; InputError where that is impossible."""

    def discard(self) -> None:
        """Leave what stood there before; may be called at any time."""


def check(out: Path, size: tuple[int, int], fps: Fraction) -> None:
    """Raise InputError where it is clear before anything is drawn that the film cannot be written.

    ``size`` is in pixels, ``fps`` in frames per second.
    """
    check_format(out, size, fps)
    check_writable(out, "--out ")
    if out.exists() and not out.is_file():
        raise InputError("--out {out}: expected a file, not a device or a pipe", out=out)


def check_format(out: Path, size: tuple[int, int], fps: Fraction) -> None:
    """Raise InputError where a film of this name cannot be encoded; arguments as of check."""
    ending = out.suffix.lower()
    if ending not in ENDINGS:
        raise InputError(
            "--out {out}: expected a name that ends in {names}", out=out, names=", ".join(ENDINGS)
        )
    if ending == ".gif":
        if fps > FASTEST:
            raise InputError(
                "--fps {float:g}: a GIF has at most {fastest:g}", float=float(fps), fastest=FASTEST
            )
        if max(size) > MOST_OF_GIF:
            raise InputError(
                "--size: a GIF has at most {most_of_gif} pixels a side", most_of_gif=MOST_OF_GIF
            )
        return

    if size[0] % 2 or size[1] % 2:
        text = f"{size[0]}x{size[1]}"
        raise InputError(
            "--size {text}: expected an even width and height for {ending}",
            text=text,
            ending=ending,
        )
    pyav(ending, out)


def pyav(ending: str, out: Path | None = None) -> ModuleType:
    """Return PyAV, for a file of this ending; InputError if it is not installed."""
    try:
        import av
    except ImportError:
        add = how_to_add("av", extra="film")
        raise InputError(
            "--out {out}: {suffix} needs PyAV: run `{add}`, or name a file .gif",
            out=out or f"FILE{ending}",
            suffix=ending,
            add=add,
        ) from None
    return av


def format_of(
    out: Path, size: tuple[int, int], fps: Fraction, sample: Callable[[], list[np.ndarray]]
) -> Format:
    """Return the format of a film's file; ``sample`` returns pictures for the palette of a GIF."""
    ending = out.suffix.lower()
    palette = palette_of(sample()).tobytes() if ending == ".gif" else b""
    return Format(ending, size, fps, palette)


def part_encoder(format: Format, first: int) -> PartEncoder:
    """Return the encoder of the part that begins with the frame ``first``."""
    return _GifPart(format, first) if format.ending == ".gif" else _VideoPart(format)


def joined(out: Path, format: Format, sound: bytes = b"") -> Joined:
    """Return the file in which parts are joined, with its ``sound``; InputError if it cannot be."""
    return _JoinedGif(out, format) if format.ending == ".gif" else _JoinedVideo(out, format, sound)


class FilmFile:
    """A film's file, written frame by frame: the same bytes as that of parts that are joined."""

    def __init__(self, out: Path, format: Format, sound: bytes = b"") -> None:
        """Begin the file; ``sound`` is the part with its sound, if it has any."""
        self._format = format
        self._joined = joined(out, format, sound)
        self._part: PartEncoder | None = None
        self.frames = 0

    def add(self, pixels: np.ndarray) -> None:
        """Add the next picture, uint8 (h, w, 3); InputError where it cannot be written."""
        if self._part is None:
            self._part = part_encoder(self._format, self.frames)
        self._part.add(pixels)
        self.frames += 1
        if self.frames % self._format.length == 0:
            self._end_part()

    def add_part(self, part: bytes, frames: int, name: str = "") -> None:
        """Add the next part, of so many frames; InputError where it cannot be written."""
        self._joined.add(part, frames, name)
        self.frames += frames

    def _end_part(self) -> None:
        if self._part is not None:
            frames = (self.frames - 1) % self._format.length + 1
            self._joined.add(self._part.finish(), frames)
            self._part = None

    def finish(self) -> None:
        """Complete the file; InputError where that is impossible."""
        self._end_part()
        self._joined.finish()

    def discard(self) -> None:
        """Leave what stood there before; may be called at any time."""
        self._joined.discard()


class _GifPart:
    """Frames of a GIF."""

    def __init__(self, format: Format, first: int) -> None:
        self._data = io.BytesIO()
        given = format.size, float(format.fps), format.colours, first
        self._frames = GifFrames(self._data, *given)

    def add(self, pixels: np.ndarray) -> None:
        self._frames.add(pixels)

    def finish(self) -> bytes:
        return self._data.getvalue()


class _JoinedGif:
    """A GIF."""

    def __init__(self, out: Path, format: Format) -> None:
        self._output = Output(out, f"--out {out}")
        self._output.write(header(format.size, format.colours))

    def add(self, part: bytes, frames: int, name: str = "") -> None:
        if frame_count(part) != frames:
            raise _damaged(name, frames)
        self._output.write(part)

    def finish(self) -> None:
        self._output.write(END)
        self._output.finish()

    def discard(self) -> None:
        self._output.discard()


class _VideoPart:
    """A part of a video, by PyAV: the same bytes of the same pictures, on whichever computer."""

    def __init__(self, format: Format) -> None:
        self._av = pyav(format.ending)
        codec, options = CODECS[format.ending]
        self._data = io.BytesIO()
        self._container = self._av.open(self._data, "w", format.ending[1:], BITEXACT)
        stream = self._container.add_stream(codec, rate=format.fps, options=options)
        stream.width, stream.height = format.size
        stream.pix_fmt = "yuv420p"
        context = stream.codec_context
        context.gop_size = format.length
        context.color_primaries = context.color_trc = context.colorspace = BT709
        context.color_range = 1  # levels 16 to 235, as all players expect
        context.thread_count = 1  # x264's threads give other bytes each time
        self._stream = stream

    def add(self, pixels: np.ndarray) -> None:
        frame = self._av.VideoFrame.from_ndarray(pixels, format="rgb24")
        frame = frame.reformat(format="yuv420p", dst_colorspace="ITU709", dst_color_range="MPEG")
        # A copy: the bytes of a film would depend on what lies beside the rows of the frame.
        frame = self._av.VideoFrame.from_ndarray(frame.to_ndarray(), format="yuv420p")
        frame.pts = None
        self._container.mux(self._stream.encode(frame))

    def finish(self) -> bytes:
        self._container.mux(self._stream.encode())
        self._container.close()
        return self._data.getvalue()


class _JoinedVideo:
    """A video: the packets of its parts one after another, not encoded again."""

    def __init__(self, out: Path, format: Format, sound: bytes = b"") -> None:
        self._av, self._name = pyav(format.ending, out), f"--out {out}"
        self._sound = _Sound(self._av, sound) if sound else None
        self._format = format
        self._output = Output(out, self._name)
        self._container: Any = None
        self._stream: Any = None
        self._frames = 0
        try:
            with self._named():
                self._container = self._av.open(
                    self._output.place, "w", format.ending[1:], BITEXACT
                )
        except BaseException:
            self.discard()
            raise

    def _named(self) -> "_Named":
        return _Named(self._av, self._name)

    def add(self, part: bytes, frames: int, name: str = "") -> None:
        try:
            opened = self._av.open(io.BytesIO(part))
        except self._av.error.FFmpegError:
            raise _damaged(name, frames) from None

        with opened, self._named():
            stream = opened.streams.video[0]
            if self._stream is None:
                self._stream = self._container.add_stream_from_template(stream)
                self._settings = stream.codec_context.extradata
                if self._sound is not None:
                    self._sound.begin(self._container)
            if stream.codec_context.extradata != self._settings:
                raise InputError("{name}: encoded by another program than the rest", name=name)

            count = 0
            for packet in opened.demux(stream):
                if packet.size:
                    count += 1
                    self._shift(packet)
                    self._container.mux(packet)
            if count != frames:
                raise _damaged(name, frames)

            self._frames += count
            if self._sound is not None:
                self._sound.mux(self._container, self._frames / self._format.fps)

    def _shift(self, packet: Any) -> None:
        """Give a packet its time in the film; its own counts from the part's beginning."""
        ticks = 1 / (self._format.fps * packet.time_base)  # of a frame
        for name in ("pts", "dts"):
            number = self._frames + round(getattr(packet, name) / ticks)
            setattr(packet, name, round(number * ticks))
        packet.stream = self._stream

    def finish(self) -> None:
        with self._named():
            self._container.close()
            self._container = None
        self._output.finish()

    def discard(self) -> None:
        container, self._container = self._container, None
        if container is not None:
            with suppress(Exception):
                container.close()
        if self._sound is not None:
            self._sound.close()
        self._output.discard()


def _damaged(name: str, frames: int) -> InputError:
    """Return the error of a part that is damaged, or of another film."""
    return InputError(
        "{name}: no part of a film with {frames} frames: delete it, and run the same "
        "`film --parts` again",
        name=name,
        frames=frames,
    )


class _Sound:
    """The part with a film's sound: its packets come between those of the pictures."""

    def __init__(self, av: ModuleType, data: bytes) -> None:
        self._opened = av.open(io.BytesIO(data))
        self._packets = self._opened.demux(audio=0)
        self._next: Any = None
        self._stream: Any = None

    def begin(self, container: Any) -> None:
        """Add a stream to a film's file, after that of the pictures."""
        self._stream = container.add_stream_from_template(self._opened.streams.audio[0])
        self._next = next(self._packets, None)

    def mux(self, container: Any, seconds: Fraction) -> None:
        """Add what is heard before a time of the film."""
        while self._next is not None and self._next.size:
            if self._next.pts * self._next.time_base >= seconds:
                return
            self._next.stream = self._stream
            container.mux(self._next)
            self._next = next(self._packets, None)

    def close(self) -> None:
        """Close the part; may be called twice."""
        self._opened.close()


class _Named:
    """Turns the errors of PyAV inside a block into an InputError that names the file."""

    def __init__(self, av: ModuleType, name: str) -> None:
        self._error, self._name = av.error.FFmpegError, name

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, traceback: object) -> None:
        if isinstance(error, self._error):
            reason = getattr(error, "strerror", None) or str(error)
            raise InputError(
                "{name}: cannot be written ({reason})", name=self._name, reason=reason
            ) from None
