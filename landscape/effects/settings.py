"""The hall's constants as settings; see :mod:`landscape.keys`. Each effect has a group of its own.

A safeguard is a setting that is on: turned off, it shows the artefact that it prevents.
"""

from dataclasses import dataclass

from landscape.keys import Value
from landscape.settings import Camera, Clock, Fog, Sun, Walk


@dataclass(frozen=True)
class Settings:
    """All groups, with the hall's own defaults of those it shares with the island."""

    camera: Camera = Camera(fov=66.0, far=40.0, cull=True)
    clock: Clock = Clock()
    walk: Walk = Walk(speed=0.35, mouse_relative=True, bob=0.003, solid=True)
    # Chosen: in the south-east, so that the windows' light falls across the nave.
    sun: Sun = Sun(azimuth=103.0, elevation=36.0, diffuse=(1.0, 0.92, 0.78), ambient=(0.3,) * 3)
    fog: Fog = Fog(enabled=False)


PRESETS: dict[str, dict[str, Value]] = {"best": {}}
