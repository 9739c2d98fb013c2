"""Switches off the voxel island's passes that the current OpenGL cannot do, with a line for each.

Their requirements are in framelens/gl/features.py. Here the settings are changed accordingly, so
that all other code only asks the settings.
"""

from dataclasses import replace

from framelens.gl.extensions import largest_texture, tell
from landscape.gl.features import possible
from landscape.voxel.settings import Settings


def supported(settings: Settings) -> Settings:
    """Return settings without the passes that the current OpenGL cannot draw."""
    shadow, debug = settings.shadow, settings.debug
    if shadow.enabled and not possible("shadow"):
        shadow = replace(shadow, enabled=False)
    if shadow.enabled and shadow.size > largest_texture():
        most = largest_texture()
        tell(f"shadow.size: {most} instead of {shadow.size}, this OpenGL's largest")
        shadow = replace(shadow, size=most)
    voxel = settings.voxel
    if voxel.highlights and not possible("voxel.highlights"):
        voxel = replace(voxel, highlights=0.0)
    wanted = debug.textures or debug.picture != "none"
    if wanted and not possible("debug.textures"):
        debug = replace(debug, textures=False, picture="none")
    return replace(settings, voxel=voxel, shadow=shadow, debug=debug)
