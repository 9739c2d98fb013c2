"""The sky: five textured walls round the walker (Sky_box, section 4).

Technique: a sky box in a display list, translated with the viewer before it is called. In 2006 it
follows in x and z, never in y, stands in the fog and hides what lies behind its walls. Three fixes:
``sky.follow_y`` centres it on the eye in every axis; ``sky.background`` gives it the greatest depth
by glDepthRange(1, 1), so that it shows only where nothing else is, however near its walls;
``sky.unfogged`` leaves the fog off, as the haze is painted on its walls. Together they put the sky
at infinity. ``sky.moving`` adds a cloud layer, whose texture matrix drifts with kt.
State used: GL_TEXTURE_2D, fog, depth range and writes, GL_CLIP_PLANE0, GL_BLEND, texture matrix.
"""

import numpy as np

from landscape.files.assets import Assets
from landscape.files.images import read_image
from landscape.frame import Frame
from landscape.geometry.mesh import grid_triangles
from landscape.gl.calls import gl
from landscape.gl.display_list import DisplayList
from landscape.gl.state import attrib, client_arrays, matrix
from landscape.gl.texture import Texture
from landscape.settings import Settings

ELEMENT = "sky"

FACES = ("west", "north", "east", "south", "top")
CLOUD_RINGS = (0.0, 0.5, 1.2, 2.2, 3.8, 6.0)  # chosen: radii of the cloud disc, its height being 1
CLOUD_SIDES = 24  # chosen
CLOUD_ALPHA = 0.75  # chosen
CLOUD_REPEAT = 0.3  # chosen: textures per unit of the disc
CLOUD_DRIFT = (0.00013, -0.00005)  # chosen: textures per kt, east and south


def face_corners(d: float, h: float) -> dict[str, np.ndarray]:
    """Return each face's corners (4, 3), from the picture's top left, going down, seen from inside.

    The top face has north at its top and west at its left, as on a map.
    """
    wall = {"west": (-1, 1, -1, -1), "north": (-1, -1, 1, -1)}
    wall |= {"east": (1, -1, 1, 1), "south": (1, 1, -1, 1)}
    faces = {}
    for name, (x0, z0, x1, z1) in wall.items():
        faces[name] = np.array(
            [
                (x0 * d, h, z0 * d),
                (x0 * d, 0, z0 * d),
                (x1 * d, 0, z1 * d),
                (x1 * d, h, z1 * d),
            ],
            np.float32,
        )
    faces["top"] = np.array([(-d, h, -d), (-d, h, d), (d, h, d), (d, h, -d)], np.float32)
    return faces


def face_coordinates(width: int, height: int) -> np.ndarray:
    """Return texture coordinates (4, 2) of the corners that touch the border texels' centres.

    The faces' border texels agree, so the box shows no seam.
    """
    s, t = 0.5 / width, 0.5 / height
    return np.array([(s, t), (s, 1 - t), (1 - s, 1 - t), (1 - s, t)], np.float32)


def cloud_disc() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return a disc one unit above the eye: vertices (n, 3), colours (n, 4), coordinates (n, 2).

    The last array is the triangles (m, 3), counter-clockwise from below. Opacity falls to nothing
    at the rim, which stands CLOUD_RINGS[-1] units out, about 9 degrees above the horizon.
    """
    angle = np.arange(CLOUD_SIDES + 1) * 2 * np.pi / CLOUD_SIDES
    radius, turn = (grid.ravel() for grid in np.meshgrid(CLOUD_RINGS, angle, indexing="ij"))
    x, z = radius * np.cos(turn), radius * np.sin(turn)
    vertices = np.stack([x, np.ones_like(x), z], axis=1).astype(np.float32)
    fade = 1.0 - radius / CLOUD_RINGS[-1]
    colors = np.ones((len(x), 4), np.float32)
    colors[:, 3] = CLOUD_ALPHA * np.clip(2.0 * fade, 0.0, 1.0)
    coordinates = np.ascontiguousarray(vertices[:, ::2] * CLOUD_REPEAT)
    return vertices, colors, coordinates, grid_triangles(CLOUD_SIDES + 1, len(CLOUD_RINGS))


def send_clouds(layer: Texture) -> None:
    """What the cloud layer's display list holds."""
    vertices, colors, coordinates, triangles = cloud_disc()
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glDepthMask(gl.GL_FALSE)
    layer.bind()
    with client_arrays(vertices, None, colors, [coordinates]):
        gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


class SkyBox:
    """The box; ``draw`` follows the viewer."""

    def __init__(self, settings: Settings, assets: Assets) -> None:
        """Read the five faces and compile the display list."""
        self._settings = settings
        prefix = "sky_" if settings.sky.set == "day" else f"sky_{settings.sky.set}_"
        images = [read_image(assets.path(f"{prefix}{face}.png"), "RGB") for face in FACES]
        # A sky is so smooth that no eye finds where one mip level gives way to the next.
        self._textures = [Texture(image, repeat=False, trilinear=False) for image in images]
        corners = face_corners(settings.sky.half_width, settings.sky.height)

        def send() -> None:
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glColor4f(1.0, 1.0, 1.0, 1.0)
            for face, texture, image in zip(FACES, self._textures, images, strict=True):
                texture.bind()
                gl.glBegin(gl.GL_QUADS)
                coordinates = face_coordinates(image.shape[1], image.shape[0])
                for (s, t), corner in zip(coordinates.tolist(), corners[face], strict=True):
                    gl.glTexCoord2f(s, t)
                    gl.glVertex3f(*corner.tolist())
                gl.glEnd()
            gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
            gl.glDisable(gl.GL_TEXTURE_2D)

        self._list = DisplayList(send)
        self._clouds: DisplayList | None = None
        if settings.sky.moving:
            layer = Texture(read_image(assets.path("clouds.png")), trilinear=False)
            self._textures.append(layer)
            self._clouds = DisplayList(lambda: send_clouds(layer))

    def draw(self, frame: Frame) -> None:
        """Draw the box about the viewer, mirrored or not as the frame says."""
        level = self._settings.water.level
        x, y, z = frame.eye.tolist()
        sky = self._settings.sky
        groups = gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_COLOR_BUFFER_BIT
        groups |= gl.GL_DEPTH_BUFFER_BIT | gl.GL_VIEWPORT_BIT
        with matrix(), attrib(groups):
            if sky.background:
                gl.glDepthRange(1.0, 1.0)
                gl.glDepthFunc(gl.GL_LEQUAL)
                gl.glDepthMask(gl.GL_FALSE)
            if sky.unfogged:
                gl.glDisable(gl.GL_FOG)
            if sky.anchored:
                x = z = self._settings.ground.size / 2
            if sky.follow_y:
                gl.glDisable(gl.GL_CLIP_PLANE0)
                # Under the mirror matrix the eye's own place is that of its mirror image.
                gl.glTranslatef(x, 2 * level - y if frame.mirrored else y, z)
            else:
                gl.glTranslatef(x, level, z)
            self._list.call()
            if self._clouds is not None:
                self._draw_clouds(frame.kt)

    def _draw_clouds(self, kt: float) -> None:
        """Blend the cloud layer over the box; its place in the texture moves with ``kt``."""
        assert self._clouds is not None
        gl.glMatrixMode(gl.GL_TEXTURE)
        with matrix():
            gl.glTranslatef(-CLOUD_DRIFT[0] * kt, -CLOUD_DRIFT[1] * kt, 0.0)
            self._clouds.call()
        gl.glMatrixMode(gl.GL_MODELVIEW)

    def release(self) -> None:
        """Delete the list and the textures; may be called twice."""
        self._list.release()
        if self._clouds is not None:
            self._clouds.release()
        for texture in self._textures:
            texture.release()
