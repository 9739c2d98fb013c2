"""A complete scene in about seventy lines: a chessboard to walk on. test_scene.py plugs it in."""

from dataclasses import dataclass

from framelens.gl.seam import drawing, gl
from landscape.elements.settings import Camera, Clock, Fog, Sound, Sun, Walk
from landscape.frame import Pose
from landscape.geometry.obstacles import Tower
from landscape.scene.scene import Scene, View, begin_frame
from landscape.settings.declare import Toggle, setting


@dataclass(frozen=True)
class Board:
    squares: int = setting(8, "chosen", "squares per side", 1, 64)
    dark: tuple[float, ...] = setting((0.1, 0.2, 0.1), "chosen", "RGB", 0, 1)


@dataclass(frozen=True)
class Settings:
    camera: Camera = Camera()
    clock: Clock = Clock()
    sound: Sound = Sound()
    walk: Walk = Walk()
    sun: Sun = Sun()
    fog: Fog = Fog()
    board: Board = Board()


class Chessboard:
    size, obstacles = 8.0, (Tower(2.0, 2.0, 0.5, 3.0),)

    def __init__(self, settings, assets, seed, only):
        self.settings, self.shown = settings, set(only)

    def height(self, x, z):
        return 1.0

    def draw(self, moment):
        begin_frame(moment, self.settings.camera, self.settings.sun, self.settings.fog)
        with drawing("squares"):
            gl.glBegin(gl.GL_QUADS)
            side = self.size / self.settings.board.squares
            for k in range(self.settings.board.squares**2 if "squares" in self.shown else 0):
                row, column = divmod(k, self.settings.board.squares)
                gl.glColor3f(*((0.9, 0.9, 0.8) if (row + column) % 2 else self.settings.board.dark))
                for x, z in ((0, 0), (0, 1), (1, 1), (1, 0)):
                    gl.glVertex3f((column + x) * side, 1.0, (row + z) * side)
            gl.glEnd()

    def apply(self, settings):
        self.settings = settings
        return True

    def release(self):
        pass


SCENE = Scene(
    name="chessboard",
    elements=("squares", "fog"),
    views={"board": View("board", "the board", Pose(4.0, None, 7.0, 0.0, -20.0), 3.0)},
    settings=Settings(),
    presets={"best": {}, "2006": {"board.dark": (0.0, 0.0, 0.0)}},
    preset="best",
    start="board",
    main=("board",),
    open=Chessboard,
    terrain=lambda settings, assets: Chessboard(settings, assets, 0, ()),
    digits={"1": Toggle("fog.enabled", "haze"), "2": Toggle("fog.mode", "formula of the haze")},
)
