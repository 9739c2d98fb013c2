"""The room: everything of stone, wood and iron that stands still, lit by light that was baked.

Technique: surfaces as grids of triangles (architecture.py), one display list for each bay and level
of detail: far bays have fewer triangles. Bays that are not in view are left out, and the nearest is
drawn first: what it hides of the others fails the depth test before it is textured. Texture unit 0
holds the material, unit 1 the light map, which is not repeated: GL_COMBINE multiplies the two, and
GL_RGB_SCALE doubles the product, so that light can also brighten (OpenGL 1.3). No light of OpenGL
is on.
Floor and north wall have light maps of their own, from which the direct light of the sun or of the
torch beside the pool can be left out: see light.py, and ``without`` of :meth:`draw_floor`.
State used: texture units 0 and 1, GL_CULL_FACE.
"""

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from framelens.gl.seam import gl
from framelens.gl.state import attrib, combine, front_faces, multiply, use_unit
from framelens.gl.texture import Texture
from landscape.elements.element import Element
from landscape.elements.sun import direction
from landscape.files.assets import Assets
from landscape.files.cache import recall
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.culling import boxes_in_view
from landscape.geometry.mesh import Mesh, merged
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.gl.features import possible
from landscape.hall import plan
from landscape.hall.architecture import hall
from landscape.hall.kept_meshes import Key, kept_meshes
from landscape.hall.levels import ALONG, LEVELS, bay_of, level_for, levels_of
from landscape.hall.light import FILE, SCALE, SIZES, light_map, placed
from landscape.hall.materials import MATERIALS
from landscape.hall.mirror import fading
from landscape.hall.plinth_light import ball_on_plinth, plinth_light
from landscape.hall.settings import Settings
from landscape.hall.surfaces import coarser, mesh
from landscape.hall.toned_texture import Change, TonedTexture

FLOOR = "floor", "band", "medallion"
BASIN = ("pool",)
APART = {(): (1.0, 1.0), ("sun",): (0.0, 1.0), ("torch",): (1.0, 0.0), ("sun", "torch"): (0.0, 0.0)}

BAKED_SUN = direction(Settings().sun).astype(float)
UNDER_TOP = 0.001  # chosen: units below the plinth's top, above its mouldings
BARE = (*FLOOR, *BASIN, "plinth")  # drawn on their own; the rest is drawn by bays


def meshes() -> dict[Key, Mesh]:
    """Return all triangles of the hall by key, with coordinates for both units.

    A key is the sheet, the material, the number of the bay ("" for those drawn apart), and that of
    the level of detail. Only the sheet "hall" is divided into bays.
    """
    found: dict[Key, list[Mesh]] = {}
    for each in placed(hall()):
        material = each.surface.material
        apart = each.surface.sheet != "hall" or material in BARE
        bay = "" if apart else str(bay_of(each.surface.points))
        for level in levels_of(material):
            surface, light = coarser(each.surface, each.light, LEVELS[level])
            part = mesh(surface, MATERIALS[material].repeats, light / SIZES[surface.sheet])
            found.setdefault((surface.sheet, material, bay, str(level)), []).append(part)
    return {key: merged(parts) for key, parts in found.items()}


UNLIT = 0.45  # chosen: the light on stone without a light map
Part = tuple[Texture, tuple[float, float, float], Mesh]


def toned_by(settings: Settings) -> tuple[str, Change]:
    """Return the material whose texture is changed, and how."""
    tone = settings.tone
    return tone.texture, Change(tone.texture_contrast, tone.texture_brightness)


def box_around(meshes: Iterable[Mesh]) -> np.ndarray:
    """Return the middle and the half sides (2, 3) of a box around meshes."""
    points = np.concatenate([each.vertices for each in meshes]).astype(np.float64)
    low, high = points.min(axis=0), points.max(axis=0)
    return np.stack([(low + high) / 2, (high - low) / 2])


def dimmed(part: Mesh, tint: tuple[float, float, float]) -> np.ndarray:
    """Return a tint as colours uint8 (n, 3) of a mesh, dimmed as its mirror image fades."""
    colors = fading(part.vertices[:, 1])[:, None] * np.array(tint)
    return np.ascontiguousarray(np.rint(np.clip(colors, 0.0, 1.0) * 255), np.uint8)


def compiled(parts: Sequence[Part], fades: bool = False) -> DisplayList:
    """Compile meshes, each with its texture and its tint, into one display list.

    If it ``fades``, it is the darker the higher, as the floor's image of it.
    """

    def send() -> None:
        for texture, tint, part in parts:
            texture.bind()
            gl.glColor3f(*tint)
            draw_mesh(replace(part, colors=dimmed(part, tint)) if fades else part)

    return DisplayList(send)


class Room(Element[Settings]):
    """Walls, pillars, vault, plinth and the pool's basin; the floor is drawn on its own."""

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.room

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the textures and compile a display list for each material and sheet."""
        self.settings = settings
        self._toned: tuple[str, TonedTexture] | None = None
        self._lit = possible("the hall's light maps")
        self._textures = {
            name: Texture(read_image(assets.path(name), "RGB"), trilinear=False)
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
        self._hall_light = images[wanted.index(("hall", ()))]
        self._plinth: dict[tuple[bool, str], Texture] = {}
        parts = kept_meshes(["the hall's stone"], meshes)
        self._lists = {
            (sheet, material): DisplayList(lambda part=part: draw_mesh(part))  # type: ignore[misc]
            for (sheet, material, bay, level), part in parts.items()
            if not bay and level == "0"
        }
        bays = [{k[1:]: m for k, m in parts.items() if k[2] == str(n)} for n in range(ALONG + 1)]
        self._bays = [
            [compiled(self._in_level(bay, level)) for level in range(len(LEVELS))] for bay in bays
        ]
        # The image is so dim that each bay may be coarser by one level in it.
        self._faded = [
            [compiled(self._in_level(bay, level), True) for level in range(1, len(LEVELS))]
            for bay in bays
        ]
        boxes = np.stack([box_around(bay.values()) for bay in bays])
        below = boxes * np.array([(1.0, -1.0, 1.0), (1.0, 1.0, 1.0)])
        self._boxes = {False: boxes, True: below}
        self._tone(settings)

    def _in_level(self, bay: Mapping[Key, Mesh], level: int) -> list[Part]:
        """Return the texture, the tint and the mesh of each material in a level of a bay."""
        return [
            (self.texture(material), self._tint(material), part)
            for (material, _, own), part in bay.items()
            if (material != "vault" or self.settings.room.vault)
            and int(own) == min(level, levels_of(material)[-1])
        ]

    def _tint(self, material: str) -> tuple[float, float, float]:
        """Return the colour that multiplies a material's texture."""
        red, green, blue = MATERIALS[material].tint
        light = 1.0 if self._lit else UNLIT
        return red * light, green * light, blue * light

    def take(self, settings: Settings) -> None:
        """Take other settings, and the tones of the textures that they ask for."""
        former, self.settings = self.settings, settings
        if toned_by(settings) != toned_by(former):
            self._tone(settings)

    def _tone(self, settings: Settings) -> None:
        """Give the texture that ``tone.texture`` names its contrast and brightness."""
        name, change = toned_by(settings)
        if self._toned and self._toned[0] != name:
            self._toned[1].change(Change())
            self._toned[1].release()
            self._toned = None
        if name == "none" or not possible("tone.texture"):
            return
        if self._toned is None:
            self._toned = name, TonedTexture(self.texture(name))
        self._toned[1].change(change)

    def draw(self, frame: Frame) -> None:
        """Draw all but the floor and the pool's basin."""
        boxes = self._boxes[frame.mirrored]
        order = np.argsort(np.abs(boxes[:, 0, 2] - frame.pose.z), kind="stable")
        levels = self.levels(frame)
        fades = frame.mirrored and self.settings.mirror.fades
        with attrib(gl.GL_CURRENT_BIT):
            with self._textured():
                self._lay_light("hall")
                for number in order.tolist():
                    if number in levels:
                        self._bay(number, levels[number], fades).call()
                if fades:
                    # In Mesa glPopAttrib does not restore a colour that came from an array.
                    gl.glColor3f(1.0, 1.0, 1.0)
            self._draw(("plinth",))
            self._draw(("wall",), () if self.settings.shadow.sunlit else ("sun",), ("north",))

    def _bay(self, number: int, level: int, fades: bool) -> DisplayList:
        """Return a bay's list of a level, or of the next coarser one, if it ``fades``."""
        faded = self._faded[number]
        return faded[min(level, len(faded) - 1)] if fades else self._bays[number][level]

    def levels(self, frame: Frame) -> dict[int, int]:
        """Return the number of the level of detail of each bay in view, by the bay's number."""
        middles, halves = self._boxes[frame.mirrored].swapaxes(0, 1)
        outside = np.maximum(np.abs(frame.eye - middles) - halves, 0.0)
        away = np.linalg.norm(outside, axis=1).tolist()
        seen = np.flatnonzero(boxes_in_view(frame, middles, halves)).tolist()
        return {number: level_for(away[number], frame) for number in seen}

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

    def draw_pool(self, sun_in_alpha: bool = False) -> None:
        """Draw the pool's bed and sides; ``sun_in_alpha`` hands the sun's share to later units."""
        self._draw(BASIN, alpha="TEXTURE" if sun_in_alpha else "PREVIOUS")

    def bind_light(self) -> None:
        """Bind the light map of all but floor and north wall, with the sun as alpha."""
        self._light["hall", ()].bind()

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

    def send_plinth_top(self) -> None:
        """Send the triangles of the plinth's top that face the viewer: clipped, it has no sides."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TRANSFORM_BIT), front_faces():
            above = np.array([0.0, 1.0, 0.0, UNDER_TOP - plan.PLINTH[1]])
            gl.glClipPlane(gl.GL_CLIP_PLANE1, above)
            gl.glEnable(gl.GL_CLIP_PLANE1)
            self.send_plinth()

    def send_foundation(self) -> None:
        """Send the triangles of floor and basin as they are."""
        self._send((*FLOOR, *BASIN))

    def _send(self, materials: Iterable[str]) -> None:
        for name in materials:
            for sheet in SIZES:
                if (sheet, name) in self._lists:
                    self._lists[sheet, name].call()

    @contextmanager
    def _textured(self, alpha: str = "PREVIOUS") -> Iterator[None]:
        """Let unit 1 multiply what unit 0 samples by a light map; unit 0 is active then.

        With a single texture unit the stone has no light on it. ``alpha`` is where unit 1 takes its
        alpha from, "PREVIOUS" or "TEXTURE".
        """
        with attrib(gl.GL_ENABLE_BIT | gl.GL_TEXTURE_BIT), front_faces():
            gl.glDisable(gl.GL_LIGHTING)
            gl.glEnable(gl.GL_TEXTURE_2D)
            if self._lit:
                use_unit(1)
                gl.glEnable(gl.GL_TEXTURE_2D)
                multiply(SCALE)
                if possible("doubled textures"):
                    combine({"SRC0_RGB": "PREVIOUS", "SRC1_RGB": "TEXTURE"})
                    combine({"COMBINE_ALPHA": "REPLACE", "SRC0_ALPHA": alpha})
                use_unit(0)
            yield

    def _lay_light(self, sheet: str, without: tuple[str, ...] = ()) -> None:
        """Let unit 1 sample the light map of a sheet; unit 0 is active then."""
        if self._lit:
            use_unit(1)
            self._light[sheet, without if sheet != "hall" else ()].bind()
            use_unit(0)

    def _lay_plinth_light(self) -> None:
        """Let unit 1 sample the plinth's own light map, if its light is not the baked one."""
        sunlit, figure = self.settings.shadow.sunlit, self.settings.statue.figure
        if not self._lit or (sunlit and figure != "ball"):
            return
        if (sunlit, figure) not in self._plinth:
            ball = ball_on_plinth() if figure == "ball" else None
            image = plinth_light(self._hall_light, BAKED_SUN, ball, sunlit)
            self._plinth[sunlit, figure] = Texture(image, repeat=False, mipmaps=False)
        use_unit(1)
        self._plinth[sunlit, figure].bind()
        use_unit(0)

    def _draw(
        self,
        materials: Iterable[str],
        without: tuple[str, ...] = (),
        sheets: Sequence[str] = tuple(SIZES),
        alpha: str = "PREVIOUS",
    ) -> None:
        with self._textured(alpha):
            for name in materials:
                self.texture(name).bind()
                if name not in FLOOR:
                    gl.glColor3f(*self._tint(name))
                for sheet in sheets:
                    if (sheet, name) not in self._lists:
                        continue
                    self._lay_light(sheet, without)
                    if name == "plinth":
                        self._lay_plinth_light()
                    self._lists[sheet, name].call()

    def release(self) -> None:
        """Delete the lists and the textures; may be called twice."""
        if self._toned:
            self._toned[1].release()
        for each in (
            *self._lists.values(),
            *(level for bay in (*self._bays, *self._faded) for level in bay),
        ):
            each.release()
        for texture in (*self._textures.values(), *self._light.values(), *self._plinth.values()):
            texture.release()
