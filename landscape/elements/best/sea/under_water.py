"""Under water: what an eye below the sea's surface sees (``water.under``; glSkel, caustics).

Technique: thick blue-green fog takes the place of the sky; by GL_EXP2, so that what is near stays
clear and the far bed is lost in it. Ground and dragon are drawn below the surface only (a clip
plane), and a second time for the net of light: that multiplies what
is there by twice the film of caustics (GL_DST_COLOR, GL_SRC_COLOR), with coordinates generated from
the place in the world (GL_EYE_LINEAR, its planes given under the camera). The sun, bent by the
surface, lights the second pass, and where something turns away from it, GL_INTERPOLATE moves the
net towards 1/2, which changes nothing. So the net runs over the sunny side of what swims and leaves
its belly. In this pass the fog is grey 1/2 for the same reason.
The surface from below is a grid of rings around the eye. Each vertex bends the line of sight by
Snell's law at the waves' normal: near the zenith one looks out, into a round window full of sky and
sun; beyond 48 degrees all light is reflected, and the surface mirrors the deep, the bed and what
swims. These are drawn upside down into a texture first, as for the sea from above
(mirror_image.py), and each vertex looks up the texture where its tilted mirror would show it: so
the waves break the image up. A veil, blended over it, holds the window, and the waves' shading:
facets that mirror the water towards the bed are darker, those that mirror it towards the surface
are lighter. The surface is lifted by its waves and hides what reaches through it.
What is wrong with it: what stands above the water is not seen through the window, and nothing casts
a shadow on the net.
State used: GL_FOG, GL_CLIP_PLANE0, GL_LIGHTING, a texture unit with GL_COMBINE (OpenGL 1.3),
generated coordinates, GL_BLEND, a framebuffer object, a texture matrix.
"""

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Self

import numpy as np

from framelens.gl.named import gl_constant
from framelens.gl.seam import gl
from framelens.gl.state import attrib, client_arrays, combine, matrix
from landscape.elements import fog, sun
from landscape.elements.best.sea.mirror_image import MirrorImage
from landscape.elements.best.sea.mirror_pass import draw_mirror
from landscape.elements.best.sea.waves import surface_normals, waves
from landscape.elements.best.terrain.bed_light import PERIOD, REPEAT, SLANT, sea_film
from landscape.elements.caustic_film import MixedFilm
from landscape.elements.element import Element, Site
from landscape.elements.ground import Ground
from landscape.elements.reflection import MIRROR
from landscape.elements.settings import Settings
from landscape.elements.water_surface import wave_time
from landscape.files.assets import Assets
from landscape.frame import Frame
from landscape.geometry.height_field import HeightField
from landscape.geometry.mesh import grid_triangles
from landscape.gl.features import possible

INDEX = 1.333  # of refraction, of water
# Chosen: RGB of the water around the eye, and how thick it is, per unit.
WATER, DENSITY = (0.07, 0.33, 0.38), 0.6
SKY, HIGH = (0.62, 0.86, 0.93), (0.80, 0.96, 0.98)  # chosen: RGB of the window's rim and middle
GLARE, POWER = (1.0, 0.97, 0.85), 90.0  # chosen: RGB of the sun in the window, and how small it is
DARK, LIGHT = (0.03, 0.19, 0.24), (0.24, 0.60, 0.64)  # chosen: RGB of the shading of the waves
SHADING = 1.6  # chosen: how much of it a facet has whose mirrored line of sight rises by 1
SHADED = 0.75  # chosen: the most of it
NEAREST, FARTHEST = 0.012, 16.0  # chosen: radii of the grid's rings, units
RINGS, SIDES = 140, 240  # chosen
RELIEF = 2.0  # chosen: how much higher the waves are from below
PROUD = 0.05  # chosen: units above the level to which things are drawn, for waves to hide
BROKEN = 0.45  # chosen: fraction of a wave's tilt that moves the mirror image; 1 is a rough sea
LEVEL_SIGHT = 0.02  # chosen: least rise of the line of sight at which the image is looked up
TILT = 1.1  # chosen: how much steeper the waves look from below
STRENGTH, AROUND = 0.8, 0.3  # chosen: of the net on what faces the sun, and on all else


def rings(frame: Frame) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x and z (RINGS, SIDES + 1) of the grid around the eye, and the gaps (RINGS,)."""
    radius = np.geomspace(NEAREST, FARTHEST, RINGS)
    turn = np.linspace(0.0, 2 * np.pi, SIDES + 1)
    x = frame.pose.x + radius[:, None] * np.cos(turn)
    z = frame.pose.z + radius[:, None] * np.sin(turn)
    return x.astype(np.float32), z.astype(np.float32), np.gradient(radius).astype(np.float32)


def looked_out(
    sight: np.ndarray, normals: np.ndarray, towards: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return colours (n, 3) of the sky as seen from below, and how much light comes through (n,).

    ``sight`` (n, 3) are unit lines of sight upwards, ``normals`` (n, 3) the waves', ``towards``
    (3,) the sun. The share of light follows Schlick's approximation, by the angle in the air.
    """
    met = np.clip((sight * normals).sum(axis=1), 0.0, 1.0)
    outside = 1.0 - INDEX**2 * (1.0 - met**2)  # square of the cosine in the air
    seen = outside > 0.0
    cosine = np.sqrt(np.where(seen, outside, 0.0))
    facing = ((INDEX - 1.0) / (INDEX + 1.0)) ** 2
    through = np.where(seen, 1.0 - (facing + (1.0 - facing) * (1.0 - cosine) ** 5), 0.0)
    bent = INDEX * sight + (cosine - INDEX * met)[:, None] * normals
    rise = np.clip(bent[:, 1:2], 0.0, 1.0)
    sky = np.array(SKY) * (1.0 - rise) + np.array(HIGH) * rise
    glare = np.clip(bent @ towards, 0.0, 1.0)[:, None] ** POWER
    return sky + glare * (np.array(GLARE) - sky), through


def mirrored_lines(sight: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Return the lines of sight (n, 3) after the surface mirrored them."""
    return sight - 2.0 * (sight * normals).sum(axis=1, keepdims=True) * normals


def shading(sight: np.ndarray, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return colours (n, 3) of the waves' shading, and how much of them there is (n,)."""
    rise = mirrored_lines(sight, normals)[:, 1] + sight[:, 1]  # level, it would be 0
    strength = np.clip(SHADING * np.abs(rise), 0.0, SHADED)
    return np.where(rise[:, None] > 0.0, np.array(LIGHT), np.array(DARK)), strength


def refracted(towards: np.ndarray) -> np.ndarray:
    """Return the direction (3,) of the sun as seen through level water, of one in the air (3,)."""
    x, z = towards[[0, 2]] / INDEX
    return np.array([x, np.sqrt(max(1.0 - x * x - z * z, 0.0)), z])


class UnderWater(Element[Settings]):
    """The sea around an eye below its surface."""

    asked_by = ("water.under",)

    @classmethod
    def built_from(cls, settings: Settings) -> Hashable:
        """Return what the constructor uses of the settings."""
        return settings.water.level

    @classmethod
    def build(cls, site: Site[Settings]) -> Self:
        """Build it over the ground."""
        return cls(site.settings, site.assets, site.elements[Ground].field)

    def __init__(self, settings: Settings, assets: Assets, field: HeightField) -> None:
        """Read the film of caustics; the sea is as large as ``field``."""
        self.settings, self._level = settings, field.water_level
        self._film = MixedFilm(sea_film(assets))
        self._possible = possible("water.under")
        self._image = MirrorImage()

    @contextmanager
    def around(self, frame: Frame) -> Iterator[None]:
        """Let the block draw what is in the water, in its fog, and nothing above the surface."""
        haze = replace(self.settings.fog, enabled=True, mode="exp2", density=DENSITY, color=WATER)
        with attrib(gl.GL_FOG_BIT | gl.GL_ENABLE_BIT):
            gl.glClearColor(*WATER, 1.0)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            fog.enable(haze)
            self.keep_below()
            yield

    def keep_below(self) -> None:
        """Clip what is above the waves, under the current matrix.

        Planes are not saved by GL_TRANSFORM_BIT: in Mesa one that is given again after it was
        restored has no effect.
        """
        plane = np.array([0.0, -1.0, 0.0, self._level + PROUD], np.float64)
        gl.glClipPlane(gl.GL_CLIP_PLANE0, plane)
        gl.glEnable(gl.GL_CLIP_PLANE0)

    @contextmanager
    def mirroring(self, frame: Frame) -> Iterator[Frame]:
        """Let the block draw what the surface mirrors; yield the frame to draw it by."""
        sharp = replace(frame, mirrored=True, detail=replace(frame.detail, mirror=1.0))
        groups = gl.GL_POLYGON_BIT | gl.GL_LIGHTING_BIT
        with self._image.drawing(sharp) as smaller, matrix(), attrib(groups):
            gl.glTranslatef(0.0, self._level, 0.0)
            gl.glMultMatrixf(MIRROR)
            gl.glTranslatef(0.0, -self._level, 0.0)
            gl.glFrontFace(gl.GL_CW)
            sun.place(self.settings.sun)
            self.keep_below()
            yield smaller
        self.keep_below()

    def lay_net(self, frame: Frame, send: Callable[[], None]) -> None:
        """Multiply what ``send`` sends once more by the net of light, where it faces upwards."""
        if not (self._possible and self.settings.water.caustics):
            return
        groups = gl.GL_ENABLE_BIT | gl.GL_LIGHTING_BIT | gl.GL_TEXTURE_BIT | gl.GL_FOG_BIT
        groups |= gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups):
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_DST_COLOR, gl.GL_SRC_COLOR)
            gl.glDepthMask(gl.GL_FALSE)
            gl.glDepthFunc(gl.GL_LEQUAL)
            grey = np.array([0.5, 0.5, 0.5, 1.0], np.float32)
            gl.glFogfv(gl.GL_FOG_COLOR, grey)
            self._shine()
            gl.glEnable(gl.GL_TEXTURE_2D)
            self._film.bind(frame.kt / PERIOD)
            gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, grey)
            combine({"COMBINE_RGB": "INTERPOLATE", "SRC0_RGB": "TEXTURE", "SRC1_RGB": "CONSTANT"})
            combine({"SRC2_RGB": "PRIMARY_COLOR", "OPERAND2_RGB": "SRC_COLOR"})
            slant = SLANT * REPEAT
            for name, plane in zip(
                "ST", ((REPEAT, slant, 0.0, 0.0), (0.0, slant, REPEAT, 0.0)), strict=True
            ):
                coordinate = gl_constant(f"GL_{name}")
                gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, gl.GL_EYE_LINEAR)
                gl.glTexGenfv(coordinate, gl.GL_EYE_PLANE, np.array(plane, np.float32))
                gl.glEnable(gl_constant(f"GL_TEXTURE_GEN_{name}"))

            send()

    def _shine(self) -> None:
        """Let the primary colour be how strong the net is: on what faces the sun, and around."""
        black, white = np.zeros(4, np.float32), np.ones(4, np.float32)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glDisable(gl.GL_COLOR_MATERIAL)
        gl.glEnable(gl.GL_NORMALIZE)
        gl.glDisable(gl.GL_LIGHT1)
        gl.glEnable(gl.GL_LIGHT0)
        gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, white * np.float32(AROUND))
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_AMBIENT, black)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_SPECULAR, black)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_DIFFUSE, white * np.float32(STRENGTH))
        place = np.append(refracted(sun.direction(self.settings.sun)), 0.0).astype(np.float32)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, place)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_AMBIENT_AND_DIFFUSE, white)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, black)

    def draw(self, frame: Frame) -> None:
        """Draw the surface from below: the mirror image, and the veil over it."""
        x, z, gaps = rings(frame)
        t = wave_time(frame.kt, self.settings.water)
        lift, slope_x, slope_z = waves(x, z, gaps, t)
        normals = surface_normals(TILT * slope_x, TILT * slope_z)
        height = self._level + np.minimum(RELIEF * lift, PROUD)
        places = np.stack([x.ravel(), height.ravel(), z.ravel()], axis=1)
        sight = places - frame.eye
        away = np.linalg.norm(sight, axis=1, keepdims=True)
        sight /= away
        triangles = grid_triangles(SIDES + 1, RINGS)
        vertices = np.ascontiguousarray(places, np.float32)
        groups = gl.GL_ENABLE_BIT | gl.GL_COLOR_BUFFER_BIT | gl.GL_CURRENT_BIT
        with attrib(groups | gl.GL_DEPTH_BUFFER_BIT):
            gl.glDisable(gl.GL_CLIP_PLANE0)
            gl.glDisable(gl.GL_LIGHTING)
            gl.glDisable(gl.GL_FOG)  # the image has its own, and the veil is faded by vertices
            mirror = self._image.take()
            if mirror is not None:
                looked_up = self._looked_up(frame, sight, away, normals)
                draw_mirror(mirror, vertices, looked_up, 1.0, triangles)
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA)
            with client_arrays(vertices, None, self._veil(sight, away[:, 0], normals)):
                gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles)

        gl.glColor4f(1.0, 1.0, 1.0, 1.0)

    @staticmethod
    def _looked_up(
        frame: Frame, sight: np.ndarray, away: np.ndarray, normals: np.ndarray
    ) -> np.ndarray:
        """Return where each vertex looks up the mirror image, float32 (n, 3) in units."""
        seen = mirrored_lines(sight, normals)
        seen[:, 1] *= -1.0
        seen = sight + BROKEN * (seen - sight)
        seen[:, 1] = np.maximum(seen[:, 1], LEVEL_SIGHT)
        return np.ascontiguousarray(frame.eye + away * seen, np.float32)

    def _veil(self, sight: np.ndarray, away: np.ndarray, normals: np.ndarray) -> np.ndarray:
        """Return the window and the shading as colours, float32 (n, 4), multiplied by alpha."""
        sky, through = looked_out(sight, normals, sun.direction(self.settings.sun))
        tint, shaded = shading(sight, normals)
        clear = fog.visibility(away, DENSITY)
        shaded *= clear * (1.0 - through)
        # The sky in the window is seen through the water, the shading fades out in it.
        window = np.array(WATER) + clear[:, None] * (sky - np.array(WATER))
        veil = np.empty((len(sight), 4), np.float32)
        veil[:, :3] = through[:, None] * window + shaded[:, None] * tint
        veil[:, 3] = through + shaded
        return veil

    def release(self) -> None:
        """Delete the film and the mirror image; may be called twice."""
        self._film.release()
        self._image.release()
