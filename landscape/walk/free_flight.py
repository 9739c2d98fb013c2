"""Free flight over a terrain: the camera that keys and mouse move. No OpenGL."""

import math
from dataclasses import replace

from landscape.flyover.camera import Camera
from landscape.flyover.height_field import HeightField
from landscape.walk.walker import Intent

TURN = math.radians(70.0)  # radians per second, chosen: of the arrow keys
LOOK = math.radians(0.15)  # radians per pixel that the mouse moves, chosen
STEEPEST = math.radians(85.0)  # chosen
FASTER = 4.0  # chosen: times, with Shift
LEAST = 0.5  # units above the ground, chosen
FARTHEST = 1e6  # units, chosen: beyond, a float32 no longer tells neighbouring pixels apart


def moves(intent: Intent) -> bool:
    """Return whether keys or the mouse ask the camera to go or turn."""
    return any((intent.forward, intent.right, intent.up, intent.turn, *intent.look))


def advance(
    camera: Camera, intent: Intent, terrain: HeightField, speed: float, seconds: float
) -> Camera:
    """Return the camera after ``seconds``, at ``speed`` units per second, never in the ground.

    It goes where it looks, as a glider does; and stays level.
    """
    yaw = camera.theta_z + intent.turn * TURN * seconds + intent.look[0] * LOOK
    pitch = min(max(camera.theta_y + intent.look[1] * LOOK, -STEEPEST), STEEPEST)
    step = speed * seconds * (FASTER if intent.run else 1.0)
    ahead = math.cos(pitch) * intent.forward
    x = camera.x + step * (math.cos(yaw) * ahead - math.sin(yaw) * intent.right)
    y = camera.y + step * (math.sin(yaw) * ahead + math.cos(yaw) * intent.right)
    z = camera.z + step * (intent.up - math.sin(pitch) * intent.forward)
    x, y = (min(max(each, -FARTHEST), FARTHEST) for each in (x, y))
    z = min(max(z, float(terrain.height(x, y)) + LEAST), FARTHEST)
    return replace(camera, x=x, y=y, z=z, theta_x=0.0, theta_y=pitch, theta_z=yaw)
