"""The file of a film: MP4 (H.264) and WebM (VP9) by PyAV, GIF without it.

A film appears in its place when it is complete, or when it is ended early: whatever has been added
until then can be played.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

import numpy as np

from framelens.base.errors import InputError
from framelens.base.installation import how_to_add
from framelens.base.output import Output, check_writable
from landscape.files.gif import FASTEST, GifFile, palette_of
from landscape.files.gif import MOST as MOST_OF_GIF

ENDINGS = (".mp4", ".webm", ".gif")
# Codec and options by ending. Chosen: as good as one sees no difference at normal size; `veryfast`
# takes a quarter of the time of x264's default, for a tenth more bytes.
CODECS: dict[str, tuple[str, dict[str, str]]] = {
    ".mp4": ("libx264", {"crf": "19", "preset": "veryfast"}),
    ".webm": ("libvpx-vp9", {"crf": "31", "b": "0", "cpu-used": "5", "row-mt": "1"}),
}
KEY_SECONDS = 4  # chosen: seconds between pictures that need no earlier one, to which players jump
BT709 = 1  # as in ITU-T H.273: primaries, transfer and matrix of high-definition television


class Encoder(Protocol):
    """A film's file while it is written."""

    def add(self, pixels: np.ndarray) -> None:
        """Add the next picture, uint8 (h, w, 3); InputError where it cannot be written."""

    def finish(self) -> None:
        """Complete the file; InputError where that is impossible."""

    def discard(self) -> None:
        """Leave what stood there before; may be called at any time."""


def check(out: Path, size: tuple[int, int], fps: Fraction) -> None:
    """Raise InputError where it is clear before anything is drawn that the film cannot be written.

    ``size`` is in pixels, ``fps`` in frames per second.
    """
    ending = out.suffix.lower()
    if ending not in ENDINGS:
        raise InputError(
            "--out {out}: expected a name that ends in {names}", out=out, names=", ".join(ENDINGS)
        )
    check_writable(out, "--out ")
    if out.exists() and not out.is_file():
        raise InputError("--out {out}: expected a file, not a device or a pipe", out=out)
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
    _av(out)


def _av(out: Path) -> ModuleType:
    """Return PyAV; InputError if it is not installed."""
    try:
        import av
    except ImportError:
        add = how_to_add("av", extra="film")
        raise InputError(
            "--out {out}: {suffix} needs PyAV: run `{add}`, or name a file .gif",
            out=out,
            suffix=out.suffix,
            add=add,
        ) from None
    return av


def encoder(
    out: Path, size: tuple[int, int], fps: Fraction, sample: Callable[[], list[np.ndarray]]
) -> Encoder:
    """Return the encoder for a file; ``sample`` returns pictures from which a palette is made.

    InputError if it cannot be written.
    """
    if out.suffix.lower() == ".gif":
        return _Gif(out, size, fps, sample)
    return _Video(out, size, fps)


class _Gif:
    """A GIF."""

    def __init__(
        self, out: Path, size: tuple[int, int], fps: Fraction, sample: Callable[[], list]
    ) -> None:
        self._output = Output(out, f"--out {out}")
        try:
            self._file = GifFile(self._output, size, float(fps), palette_of(sample()))
        except BaseException:
            self.discard()
            raise

    def add(self, pixels: np.ndarray) -> None:
        self._file.add(pixels)

    def finish(self) -> None:
        self._file.finish()
        self._output.finish()

    def discard(self) -> None:
        self._output.discard()


class _Video:
    """A video, by PyAV."""

    def __init__(self, out: Path, size: tuple[int, int], fps: Fraction) -> None:
        self._av, self._name = _av(out), f"--out {out}"
        ending = out.suffix.lower()
        codec, options = CODECS[ending]
        self._output = Output(out, self._name)
        self._container: Any = None

        try:
            with self._named():
                self._container = self._av.open(self._output.place, "w", format=ending[1:])
                stream = self._container.add_stream(codec, rate=fps, options=options)
                stream.width, stream.height = size
                stream.pix_fmt = "yuv420p"
                context = stream.codec_context
                context.gop_size = math.ceil(KEY_SECONDS * fps)
                context.color_primaries = context.color_trc = context.colorspace = BT709
                context.color_range = 1  # levels 16 to 235, as all players expect
                context.thread_count = 1  # x264's threads give other bytes each time
                self._stream = stream
        except BaseException:
            self.discard()
            raise

    def _named(self) -> "_Named":
        return _Named(self._av, self._name)

    def add(self, pixels: np.ndarray) -> None:
        with self._named():
            frame = self._av.VideoFrame.from_ndarray(pixels, format="rgb24")
            frame = frame.reformat(
                format="yuv420p", dst_colorspace="ITU709", dst_color_range="MPEG"
            )
            # A copy: the bytes of a film would depend on what lies beside the rows of the frame.
            frame = self._av.VideoFrame.from_ndarray(frame.to_ndarray(), format="yuv420p")
            frame.pts = None
            self._container.mux(self._stream.encode(frame))

    def finish(self) -> None:
        with self._named():
            self._container.mux(self._stream.encode())
            self._container.close()
            self._container = None
        self._output.finish()

    def discard(self) -> None:
        container, self._container = self._container, None
        if container is not None:
            with suppress(Exception):
                container.close()
        self._output.discard()


class _Named:
    """Turns the errors of PyAV inside a block into an InputError that names the file."""

    def __init__(self, av: ModuleType, name: str) -> None:
        self._error, self._name = av.error.FFmpegError, name

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: Any, error: BaseException | None, traceback: Any) -> None:
        if isinstance(error, self._error):
            reason = getattr(error, "strerror", None) or str(error)
            raise InputError(
                "{name}: cannot be written ({reason})", name=self._name, reason=reason
            ) from None
