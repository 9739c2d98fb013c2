"""The stone around the exhibits: each alcove's lining, its pedestal and the plate with its title.

Technique: the light of each alcove's lamp is computed once, at the vertices of fine grids, as
colours that multiply a texture: nothing is lit while drawing. The lining lies a little in front of
the room's own stone, which it covers. The plates' titles are drawn by Pillow into one texture.
State used: GL_TEXTURE_2D with GL_COMBINE (OpenGL 1.3), a colour array, GL_CULL_FACE.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager

import numpy as np
from PIL import Image, ImageDraw

from framelens.base.fonts import font, writable
from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, front_faces, multiply
from framelens.gl.texture import Texture
from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.geometry.mesh import Mesh, grid_triangles, merged, vertex_normals
from landscape.gl.display_list import DisplayList
from landscape.gl.draw import draw_mesh
from landscape.hall import plan
from landscape.hall.materials import MATERIALS
from landscape.hall.mirror import fading
from landscape.hall.shapes import halves, pointed

INSET = 0.0012  # chosen: units between the room's stone and the lining
MIDDLE = 0.895  # chosen: x of the exhibits
TOP = 0.082  # chosen: height of the pedestals
HALF = 0.05  # chosen: half the side of a pedestal's top slab
# Base, shaft and slab: half the side, lower and upper edge.
PEDESTALS = ((HALF, 0.0, 0.012), (HALF - 0.01, 0.012, TOP - 0.014), (HALF, TOP - 0.014, TOP))
LAMP = (0.985, 0.255)  # chosen: x and height of the lamp that hides above an alcove's opening
WARM = (1.0, 0.80, 0.52)  # chosen: RGB of its light on a model
BRIGHT = 1.75  # chosen: how many times as bright the stone is lit, whose textures are dark
AMBIENT = (0.42, 0.38, 0.35)  # chosen: RGB of the light from the hall
IMAGE = 0.7  # chosen: fraction of the light that shows in the floor, in which alcoves would glare
REACH = 0.16  # chosen: units from the lamp at which its light has fallen to a half
LINING, BRICKS, _ = MATERIALS["wall"]
PEDESTAL, ROCKS = "ground_rock.png", 5.0  # chosen: texture, and how often per unit
SCALE = 2.0  # GL_RGB_SCALE: what the colours of the stone's vertices are multiplied by
BRASS = (0.86, 0.84, 0.80)  # chosen: RGB of the light on the plates
TORCH = (0.975, 0.185, 0.078)  # chosen: x, y, and z from the middle, of the torch of the volume
SPHERE = (0.980, 0.212, 0.045)  # chosen: the same of the lamp of the soft shadow
# The exhibits from the north to the south.
SOLIDS, LINES, FOCUS, BLUR, SOFT, VOLUME = range(6)
WIDER = {SOFT: 0.03, FOCUS: 0.025}  # chosen: units by which half a pedestal is wider along z
PLATE = (0.040, 0.030, 0.058)  # chosen: half the width, lower and upper edge of a title's plate
TEXELS = (512, 192)  # chosen: of a plate

# Chosen: the exhibits' titles from the north to the south, in English and French.
TITLES = (
    ("Solids", "Géométrie de solides"),
    ("Hidden lines", "Lignes cachées"),
    ("Depth of field", "Profondeur de champ"),
    ("Motion blur", "Flou de mouvement"),
    ("Soft shadow", "Ombre douce"),
    ("Shadow volume", "Volume d’ombre"),
)


def lamp(number: int) -> tuple[float, float, float]:
    """Return the place of the light in an alcove."""
    z, own = plan.ALCOVES[number], {VOLUME: TORCH, SOFT: SPHERE}
    x, y, aside = own.get(number, (*LAMP, 0.0))
    return x, y, z + aside


def lamplight(
    points: np.ndarray, normals: np.ndarray, lamp: Sequence[float], power: float = 1.0
) -> np.ndarray:
    """Return a lamp's light on surfaces at points with unit normals (n, 3), RGB (n, 3).

    Lambert's cosine law times 1 / (1 + (distance / REACH)^2), as OpenGL's quadratic attenuation.
    """
    way = np.asarray(lamp) - points
    square = (way * way).sum(axis=1, keepdims=True)
    met = np.maximum((way * normals).sum(axis=1, keepdims=True), 0.0) / np.sqrt(square)
    return np.asarray(power * met / (1.0 + square / REACH**2) * np.array(WARM))


def daylight(points: np.ndarray) -> np.ndarray:
    """Return the hall's light in an alcove at points (n, 3), RGB (n, 3): less in its depth."""
    depth = (plan.INSIDE.west - points[:, :1]) / plan.ALCOVE_DEPTH
    return np.array(AMBIENT) * (1.0 - 0.35 * np.clip(depth, 0.0, 1.0))


def grid(points: np.ndarray, coordinates: np.ndarray) -> Mesh:
    """Return a grid of points (r, c, 3) as triangles, with texture coordinates (r, c, 2)."""
    rows, columns = points.shape[:2]
    vertices = np.ascontiguousarray(points.reshape(-1, 3), np.float32)
    triangles = grid_triangles(columns, rows)
    places = np.ascontiguousarray(coordinates.reshape(-1, 2), np.float32)
    return Mesh(vertices, vertex_normals(vertices, triangles), triangles, (places,))


def lining(z: float) -> Mesh:
    """Return the back, the sides and the floor of the alcove around ``z``, seen from within."""
    half, springing = plan.ALCOVE_HALF - INSET, plan.ALCOVE_SPRINGING
    top, back = plan.ALCOVE_TOP - INSET, plan.INSIDE.west - plan.ALCOVE_DEPTH + INSET
    along = halves(z + half, z - half)
    head = pointed(z, half, springing, top)(along)

    up = np.linspace(1.0, 0.0, 9)[:, None]
    heights = INSET + (head - INSET) * up
    across = np.broadcast_to(along, heights.shape)
    wall = np.stack([np.full_like(heights, back), heights, across], axis=-1)

    jamb = np.linspace(INSET, springing, 6, endpoint=False)
    edge_z = np.concatenate([np.full_like(jamb, along[0]), along, np.full_like(jamb, along[-1])])
    edge_y = np.concatenate([jamb, head, jamb[::-1]])
    length = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(edge_z), np.diff(edge_y)))])
    depth = np.linspace(plan.INSIDE.west, back, 7)[:, None]
    shape = (len(depth), len(edge_z))
    sides = np.stack([np.broadcast_to(each, shape) for each in (depth, edge_y, edge_z)], axis=-1)
    around = np.stack([np.broadcast_to(length, shape), np.broadcast_to(depth, shape)], axis=-1)

    floor_z, floor_x = np.meshgrid(np.linspace(z + half, z - half, 9), depth[::-1, 0])
    floor = np.stack([floor_x, np.full_like(floor_x, INSET), floor_z], axis=-1)
    return merged(
        [
            grid(wall, np.stack([-across, -heights], axis=-1) * BRICKS),
            grid(sides, around[..., ::-1] * BRICKS),
            grid(floor, floor[..., [2, 0]] * BRICKS),
        ]
    )


def block(x: float, z: float, half: tuple[float, float], low: float, high: float) -> Mesh:
    """Return the four sides and the top of a block around x, z, of ``half`` sides along x and z."""
    corners = np.array([(-1, 1), (1, 1), (1, -1), (-1, -1), (-1, 1)]) * half + (x, z)
    heights = np.linspace(high, low, 3)
    faces = []
    for (x0, z0), (x1, z1) in zip(corners, corners[1:], strict=False):
        t, y = np.meshgrid(np.linspace(0, 1, 4), heights)
        points = np.stack([x0 + (x1 - x0) * t, y, z0 + (z1 - z0) * t], axis=-1)
        length = np.hypot(x1 - x0, z1 - z0)
        faces.append(grid(points, np.stack([t * length, -y], axis=-1) * ROCKS))
    across, deep = np.meshgrid(
        np.linspace(-1, 1, 13) * half[0] + x, np.linspace(-1, 1, 13) * half[1] + z
    )
    top = np.stack([across, np.full_like(across, high), deep], axis=-1)
    return merged([*faces, grid(top, top[..., [0, 2]] * ROCKS)])


def pedestal(number: int) -> Mesh:
    """Return an exhibit's pedestal: base, shaft and top slab."""
    z, wider = plan.ALCOVES[number], WIDER.get(number, 0.0)
    parts = [block(MIDDLE, z, (half, half + wider), low, high) for half, low, high in PEDESTALS]
    return merged(parts)


def pedestal_top(number: int) -> tuple[float, float, float]:
    """Return where the top of an exhibit's pedestal lies: its lowest and highest x, half its z."""
    return MIDDLE - HALF, MIDDLE + HALF, HALF + WIDER.get(number, 0.0)


def pedestal_boxes(z: float) -> tuple[np.ndarray, np.ndarray]:
    """Return a pedestal as closed boxes of few triangles: float32 (n, 3), uint32 (m, 3)."""
    corners = [(x, y, w) for x in (-1, 1) for y in (0, 1) for w in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    quads = np.array(faces, np.uint32)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    vertices = []
    for half, low, high in PEDESTALS:
        size, base = np.array([half, high - low, half]), np.array([MIDDLE, low, z])
        vertices.append(np.array(corners) * size + base)
    count = len(corners)
    several = [triangles + np.uint32(count * number) for number in range(len(vertices))]
    return np.concatenate(vertices).astype(np.float32), np.concatenate(several)


def coloured(mesh: Mesh, light: np.ndarray) -> Mesh:
    """Return a mesh with half of a light (n, 3) as its vertices' colours."""
    colors = np.full((len(light), 4), 255, np.uint8)
    colors[:, :3] = np.rint(np.clip(light / SCALE, 0.0, 1.0) * 255)
    return Mesh(mesh.vertices, mesh.normals, mesh.triangles, mesh.coordinates, colors)


def plates() -> np.ndarray:
    """Return the titles' texture, uint8 (h, w, 3), one below the other."""
    width, height = TEXELS
    image = Image.new("RGB", (width, height * len(TITLES)), (150, 112, 48))
    draw = ImageDraw.Draw(image)
    for number, titles in enumerate(TITLES):
        y = number * height
        draw.rectangle((6, y + 6, width - 7, y + height - 7), (172, 134, 62), (88, 60, 20), 4)
        for text, size, at, bold in zip(titles, (60, 46), (70, 136), (True, False), strict=True):
            face = font(size, bold)
            while face.getlength(text) > width - 50:
                size -= 2
                face = font(size, bold)
            text = writable(text, face)
            draw.text((width / 2 + 2, y + at + 2), text, (214, 180, 104), face, "mm")
            draw.text((width / 2, y + at), text, (46, 30, 10), face, "mm")
    return np.asarray(image)


def send_plates() -> None:
    """Send the quads of the titles on the fronts of the pedestals."""
    half, low, high = PLATE
    x = MIDDLE + HALF - 0.01 + INSET
    count = len(TITLES)
    gl.glBegin(gl.GL_QUADS)
    for number, z in enumerate(plan.ALCOVES):
        # One looks to the west: the text runs to the north, towards smaller z.
        for s, t, y in ((0, 1, low), (1, 1, low), (1, 0, high), (0, 0, high)):
            gl.glTexCoord2f(float(s), (number + t) / count)
            gl.glVertex3f(x, y, z + half * (1 - 2 * s))
    gl.glEnd()


class Niche:
    """The stone of one alcove, in the light that it is drawn in."""

    def __init__(self, number: int, place: Sequence[float]) -> None:
        """Compile the stone around an exhibit, with a lamp at a point (3,)."""
        z = plan.ALCOVES[number]
        parts = (LINING, lining(z)), (PEDESTAL, pedestal(number))
        self._lists: dict[str, list[tuple[str, DisplayList]]] = {}
        kinds = ("both", 1, 1), ("day", 1, 0), ("lamp", 0, 1), ("image", IMAGE, IMAGE)
        for name, day, night in kinds:
            self._lists[name] = []
            for texture, mesh in parts:
                light = day * daylight(mesh.vertices)
                light = light + night * BRIGHT * lamplight(mesh.vertices, mesh.normals, place)
                if name == "image":
                    light = light * fading(mesh.vertices[:, 1])[:, None]
                self._lists[name].append((texture, DisplayList(sending(coloured(mesh, light)))))

    def send(self, light: str, textures: dict[str, Texture]) -> None:
        """Send the stone in "day" or "lamp" light, or "both", or as its "image" in the floor."""
        for name, compiled in self._lists[light]:
            textures[name].bind()
            compiled.call()

    def release(self) -> None:
        """Delete the lists; may be called twice."""
        for lists in self._lists.values():
            for _, compiled in lists:
                compiled.release()


def sending(mesh: Mesh) -> Callable[[], None]:
    """Return the function that sends a mesh."""
    return lambda: draw_mesh(mesh)


class Stone:
    """The stone of all alcoves, and the titles' plates."""

    def __init__(self, assets: Assets) -> None:
        """Read the textures and compile the lists."""
        names = sorted({LINING, PEDESTAL})
        self._textures = {name: Texture(read_image(assets.path(name), "RGB")) for name in names}
        self._titles = Texture(plates(), repeat=False)
        self._plates = DisplayList(send_plates)
        self._niches = [Niche(n, lamp(n)) for n in range(len(plan.ALCOVES))]

    def draw(self, numbers: Iterable[int], light: str = "both") -> None:
        """Draw the stone of some alcoves in "day" or "lamp" light, or "both", or its "image"."""
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_TEXTURE_BIT
        with attrib(groups), front_faces():
            gl.glEnable(gl.GL_TEXTURE_2D)
            multiply(SCALE)
            for number in numbers:
                self._niches[number].send(light, self._textures)
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def draw_plates(self) -> None:
        """Draw the plates of all alcoves."""
        with attrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT), front_faces():
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._titles.bind()
            gl.glColor3f(*BRASS)
            self._plates.call()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    def release(self) -> None:
        """Delete lists and textures; may be called twice."""
        for niche in self._niches:
            niche.release()
        self._plates.release()
        for texture in (self._titles, *self._textures.values()):
            texture.release()


@contextmanager
def lit_by(
    place: Sequence[float], ambient: Sequence[float] = AMBIENT, power: float = 1.0
) -> Iterator[None]:
    """Light the block's meshes by one lamp, ``power`` times as bright, at a point (3,).

    Their material is the colour that is current.
    """
    groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT
    with attrib(groups), front_faces():
        for name in ("LIGHT0", "LIGHT1"):
            gl.glDisable(gl_constant(f"GL_{name}"))
        for name, value in (
            ("AMBIENT", (*ambient, 1.0)),
            ("DIFFUSE", (*(power * each for each in WARM), 1.0)),
            ("SPECULAR", (*(power * each for each in WARM), 1.0)),
            ("POSITION", (*place, 1.0)),
        ):
            gl.glLightfv(gl.GL_LIGHT2, gl_constant(f"GL_{name}"), np.array(value, np.float32))
        gl.glEnable(gl.GL_LIGHT2)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        yield

    # In Mesa glPopAttrib does not restore the colour here.
    gl.glColor4f(1.0, 1.0, 1.0, 1.0)


def shiny(strength: float, exponent: float) -> None:
    """Give what follows a highlight of the light's colour; only inside :func:`lit_by`."""
    gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, np.array([strength] * 3 + [1.0], np.float32))
    gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, exponent)
