"""A WAV file of a sound, by the standard library: 16 bits, so that any player takes it."""

import io
import wave
from pathlib import Path

import numpy as np

from framelens.base.output import write_whole
from landscape.sound.signal import RATE


def pcm16(samples: np.ndarray) -> np.ndarray:
    """Return samples in -1..1 of any shape as int16; each is rounded to the nearest level."""
    return np.rint(np.clip(samples, -1.0, 1.0) * 32767.0).astype("<i2")


def wave_bytes(samples: np.ndarray) -> bytes:
    """Return samples (n, 2) as the content of a WAV file."""
    content = io.BytesIO()
    with wave.open(content, "wb") as file:
        file.setnchannels(samples.shape[1])
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(pcm16(samples).tobytes())
    return content.getvalue()


def write_wave(path: Path, samples: np.ndarray) -> None:
    """Write samples (n, 2) to a WAV file, whole or not at all; InputError."""
    write_whole(path, wave_bytes(samples))
