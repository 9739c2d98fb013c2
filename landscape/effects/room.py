"""The room: everything of stone that stands still, but for the floor.

Technique: surfaces as grids of triangles (architecture.py), one display list a material.
State used: GL_TEXTURE_2D, GL_LIGHTING, GL_CULL_FACE.
"""

from collections.abc import Iterable, Sequence

from landscape.effects import architecture, plan
from landscape.effects.settings import Settings
from landscape.effects.surfaces import Surface, charts, mesh
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import Mesh
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.state import attrib, front_faces
from landscape.gl.texture import Texture

TEXELS = 1024, 200.0  # chosen: side of the light map, and texels per unit
TEXTURES = {"wall": "castle_brick.png", "alcove": "torch_stone.png", "vault": "torch_stone.png",
            "pillar": "torch_stone.png", "plinth": "torch_stone.png", "pool": "mosaic.png",
            "floor": "torch_stone.png"}  # fmt: skip


def is_north(surface: Surface) -> bool:
    """Return whether a surface is a part of the north wall's inner face."""
    return bool((surface.points[..., 2] == plan.INSIDE.north).all())


def send(meshes: Sequence[Mesh]) -> None:
    """Send several meshes."""
    for each in meshes:
        draw_mesh(each)


class Room:
    """Walls, pillars, vault, plinth and the pool's basin; the floor is drawn on its own."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the textures and compile a display list for each material."""
        surfaces = architecture.hall()
        side, texels = TEXELS
        placed = list(zip(surfaces, charts(surfaces, side, texels), strict=True))
        self._textures = {
            name: Texture(read_image(assets.path(name), "RGB"))
            for name in sorted(set(TEXTURES.values()))
        }

        def compiled(material: str) -> DisplayList:
            meshes = [mesh(s, chart, side) for s, chart in placed if s.material == material]

            return DisplayList(lambda: send(meshes))

        self._lists = {name: compiled(name) for name in TEXTURES}
        north = [mesh(s, chart, side) for s, chart in placed if is_north(s)]
        plinth = [mesh(s, chart, side) for s, chart in placed if s.material == "plinth"]
        self._north = DisplayList(lambda: send(north))
        self._plinth = DisplayList(lambda: send(plinth))

    def apply(self, settings: Settings) -> bool:
        """Apply new settings; nothing depends on them."""
        return True

    def draw(self, frame: Frame) -> None:
        """Draw all but the floor and the pool's basin."""
        self._draw(name for name in TEXTURES if name not in ("floor", "pool"))

    def draw_floor(self) -> None:
        """Draw the floor, in the current colour."""
        self._draw(["floor"])

    def send_floor(self) -> None:
        """Send the floor's triangles that face the viewer, without any texture."""
        with attrib(gl.GL_ENABLE_BIT), front_faces():
            self._lists["floor"].call()

    def send_north(self) -> None:
        """Send the north wall's triangles that face the viewer, without any texture."""
        with attrib(gl.GL_ENABLE_BIT), front_faces():
            self._north.call()

    def send_plinth(self) -> None:
        """Send the plinth's triangles as they are."""
        self._plinth.call()

    def send_foundation(self) -> None:
        """Send the triangles of floor and basin as they are."""
        for name in ("floor", "pool"):
            self._lists[name].call()

    def draw_pool(self) -> None:
        """Draw the pool's bed and sides."""
        self._draw(["pool"])

    def send(self, material: str) -> None:
        """Send what is of a material, whatever the state."""
        self._lists[material].call()

    def texture(self, material: str) -> Texture:
        """Return the texture of a material."""
        return self._textures[TEXTURES[material]]

    def _draw(self, materials: Iterable[str]) -> None:
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT), front_faces():
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glEnable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_COLOR_MATERIAL)
            for name in materials:
                self._textures[TEXTURES[name]].bind()
                self._lists[name].call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        for compiled in (*self._lists.values(), self._north, self._plinth):
            compiled.release()
        for texture in self._textures.values():
            texture.release()
