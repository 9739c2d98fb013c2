"""The room: everything of stone, wood and iron that stands still, lit by light that was baked.

Technique: surfaces as grids of triangles (architecture.py), one display list for each material and
light map. Texture unit 0 holds the material, unit 1 the light map, a texture that is not repeated:
GL_COMBINE multiplies the two, and GL_RGB_SCALE doubles the product, so that light can also brighten
(OpenGL 1.3). No light of OpenGL is on.
Floor and north wall have light maps of their own, from which the direct light of the sun or of the
torch in front of the statue can be left out: see light.py, and ``without`` of :meth:`draw_floor`.
State used: texture units 0 and 1, GL_CULL_FACE.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from landscape.effects.architecture import hall
from landscape.effects.kept_meshes import kept_meshes
from landscape.effects.light import FILE, SCALE, SIZES, light_map, placed
from landscape.effects.materials import MATERIALS
from landscape.effects.settings import Settings
from landscape.effects.surfaces import mesh
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, combine, front_faces
from landscape.gl.texture import Texture

FLOOR = "floor", "band", "medallion"
BASIN = ("pool",)
APART = {(): (1.0, 1.0), ("sun",): (0.0, 1.0), ("torch",): (1.0, 0.0), ("sun", "torch"): (0.0, 0.0)}

Key = tuple[str, str]  # sheet and material


def joined(parts: Sequence[Mesh]) -> Mesh:
    """Return meshes with two texture units as one."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])]).astype(np.uint32)
    triangles = [part.triangles + start for part, start in zip(parts, starts, strict=True)]
    units = zip(*(part.coordinates for part in parts), strict=True)
    return Mesh(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate(triangles),
        tuple(np.concatenate(unit) for unit in units),
    )


def meshes() -> dict[Key, Mesh]:
    """Return all triangles of the hall by sheet and material, with coordinates for both units."""
    found: dict[Key, list[Mesh]] = {}
    for each in placed(hall()):
        surface = each.surface
        light = each.light / SIZES[surface.sheet]
        part = mesh(surface, MATERIALS[surface.material].repeats, light)
        found.setdefault((surface.sheet, surface.material), []).append(part)
    return {key: joined(parts) for key, parts in found.items()}


class Room:
    """Walls, pillars, vault, plinth and the pool's basin; the floor is drawn on its own."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the textures and compile a display list for each material and sheet."""
        self._textures = {
            name: Texture(read_image(assets.path(name), "RGB"))
            for name in sorted({each.texture for each in MATERIALS.values()})
        }
        wanted = [
            (sheet, without)
            for sheet in SIZES
            for without in APART
            if sheet != "hall" or not without
        ]

        def light_maps() -> tuple[np.ndarray, ...]:
            picture = read_image(assets.path(FILE), "RGB")
            return tuple(light_map(picture, sheet, *APART[without]) for sheet, without in wanted)

        images = recall(["the hall's light maps", *assets.contents(FILE)], light_maps)
        self._light: dict[tuple[str, tuple[str, ...]], Texture] = {
            key: Texture(image, repeat=False, mipmaps=False)
            for key, image in zip(wanted, images, strict=True)
        }
        self._lists = {
            key: DisplayList(lambda part=part: draw_mesh(part))  # type: ignore[misc]
            for key, part in kept_meshes(["the hall's stone"], meshes).items()
        }

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing depends on them."""
        return True

    def draw(self, frame: Frame) -> None:
        """Draw all but the floor and the pool's basin."""
        with attrib(gl.GL_CURRENT_BIT):
            self._draw(name for name in MATERIALS if name not in (*FLOOR, *BASIN))

    def draw_floor(self, *without: str) -> None:
        """Draw the floor, in the current colour; ``without`` the light of "sun", "torch" or both.

        Where a live shadow lies, the floor without that light is what is seen.
        """
        self._draw(FLOOR, without, ("floor", "hall"))

    def draw_north(self, *without: str) -> None:
        """Draw the north wall, as :meth:`draw_floor`."""
        self._draw(("wall",), without, ("north",))

    def send_floor(self) -> None:
        """Send the floor's triangles that face the viewer, without any texture."""
        with attrib(gl.GL_ENABLE_BIT), front_faces():
            self._send(FLOOR)

    def draw_pool(self) -> None:
        """Draw the pool's bed and sides."""
        self._draw(BASIN)

    def send(self, material: str) -> None:
        """Send what is of a material, whatever the state."""
        self._send([material])

    def texture(self, material: str) -> Texture:
        """Return the texture of a material."""
        return self._textures[MATERIALS[material].texture]

    def send_north(self) -> None:
        """Send the north wall's triangles that face the viewer, without any texture."""
        with attrib(gl.GL_ENABLE_BIT), front_faces():
            self._lists["north", "wall"].call()

    def send_plinth(self) -> None:
        """Send the plinth's triangles as they are."""
        self._send(["plinth"])

    def send_foundation(self) -> None:
        """Send the triangles of floor and basin as they are."""
        self._send((*FLOOR, *BASIN))

    def _send(self, materials: Iterable[str]) -> None:
        for name in materials:
            for sheet in SIZES:
                if (sheet, name) in self._lists:
                    self._lists[sheet, name].call()

    def _draw(
        self,
        materials: Iterable[str],
        without: tuple[str, ...] = (),
        sheets: Sequence[str] = tuple(SIZES),
    ) -> None:
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT), front_faces():
            gl.glDisable(gl.GL_LIGHTING)
            gl.glActiveTexture(gl.GL_TEXTURE1)
            gl.glEnable(gl.GL_TEXTURE_2D)
            combine({"COMBINE_RGB": "MODULATE", "SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
            combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": "PREVIOUS"})
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, gl.GL_RGB_SCALE, SCALE)
            gl.glActiveTexture(gl.GL_TEXTURE0)
            gl.glEnable(gl.GL_TEXTURE_2D)
            for name in materials:
                self._textures[MATERIALS[name].texture].bind()
                if name not in FLOOR:
                    gl.glColor3f(*MATERIALS[name].tint)
                for sheet in sheets:
                    if (sheet, name) not in self._lists:
                        continue
                    gl.glActiveTexture(gl.GL_TEXTURE1)
                    self._light[sheet, without if sheet != "hall" else ()].bind()
                    gl.glActiveTexture(gl.GL_TEXTURE0)
                    self._lists[sheet, name].call()

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        for compiled in self._lists.values():
            compiled.release()
        for texture in (*self._textures.values(), *self._light.values()):
            texture.release()
