"""The settings of sound, which a walk and a film have."""

from dataclasses import dataclass
from typing import ClassVar

from landscape.elements.settings.walk import WALKING
from landscape.settings.declare import setting


@dataclass(frozen=True)
class Sound:
    """What a walk sounds like; it needs the extra ``sound`` and a device (see docs/sound.md)."""

    NEEDS: ClassVar[tuple[str, ...]] = WALKING

    volume: float = setting(
        1.0,
        "chosen",
        "how loud it is; 1 leaves 14 dB of headroom",
        0,
        8,
        unit="times the usual amplitude",
    )
    muted: bool = setting(False, "chosen", "no sound; a key switches it in a walk")
    captions: str = setting(
        "muted",
        "chosen",
        "what is heard, in words, with an arrow to where it comes from: never, while the sound is "
        "muted, or always",
        choices=("off", "muted", "on"),
    )
