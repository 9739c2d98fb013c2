"""The chessboard, with a defect where it is drawn; test_film.py plugs it in."""

from dataclasses import replace

from chessboard_scene import SCENE as BOARD
from chessboard_scene import Chessboard


class Faulty(Chessboard):
    def draw(self, moment):
        return {}["a defect"]


SCENE = replace(BOARD, name="faulty", open=Faulty)
