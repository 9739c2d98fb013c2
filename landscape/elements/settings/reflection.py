"""The settings of the mirror image in the water."""

from dataclasses import dataclass

from landscape.settings.declare import setting


@dataclass(frozen=True)
class Reflection:
    """The scene drawn a second time, mirrored at the water plane (section 3)."""

    enabled: bool = setting(True, "section 3.1", "draw the mirrored scene", needs=("reflection",))
    stencil: bool = setting(
        False,
        "glskel effects",
        "limit the reflection to the water by the stencil buffer",
        needs=("reflection", "water", "reflection.enabled", "not reflection.rippled"),
    )
    castle: bool = setting(
        False,
        "chosen",
        "the castle is mirrored too",
        needs=("reflection", "castle", "reflection.enabled"),
    )
    rippled: bool = setting(
        False,
        "R16, section 12",
        "render the mirror image to a texture and distort it by the waves",
        # Without a mirror image it only chooses a sea without patches, as each of these does.
        needs=(
            *("water", "reflection.enabled or not water.relief"),
            *("reflection.enabled or not water.shallow", "reflection.enabled or not water.fresnel"),
            *("reflection.enabled or not water.glitter", "reflection.enabled or not water.foam"),
            "reflection.enabled or not water.ripples",
            "reflection.enabled or not water.horizon_contrast",
        ),
    )
    lod_scale: float = setting(
        1.0,
        "chosen",
        "meshes in the mirror image may err by more pixels, and the ground's tiles are coarser",
        1,
        100,
        unit="times camera.lod_pixels",
        needs=("reflection", "reflection.enabled", "camera.lod_pixels or ground.tiles>1"),
    )
