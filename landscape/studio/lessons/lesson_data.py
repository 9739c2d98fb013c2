"""The data of the lessons, made from the assets and from code.

    python -m landscape.studio.lessons.lesson_data [--out DIR] [NAME...]

writes landscape/course/lessons/data anew, all of it or the files named. A lesson's file is small:
an asset with fewer pixels, colours or triangles. The bytes are those of the committed files, with
the same versions of Pillow, numpy and fast-simplification. letters.png requires the font DejaVu
Sans Mono Bold.
"""

import argparse
import io
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageEnhance, ImageFont

from framelens.base.errors import InputError
from framelens.base.output import write_whole
from landscape.files.assets import shipped
from landscape.files.meshes import read_mesh
from landscape.studio.lessons import teapot

DATA = Path(__file__).resolve().parents[2] / "course" / "lessons" / "data"
ISLAND = (20, 16, 480)  # chosen: left, top and side of the island, in texels of height16.png
HIGHEST = 0.84  # of 65535: the island's summit, which becomes 1
LETTER = (10, 20)  # pixels; course/lessons/text.py has them, too
FONT = ("DejaVuSansMono-Bold.ttf", 15)
TRIANGLES = 1500  # chosen: of the rabbit


def asset(name: str) -> Image.Image:
    """Open a picture of the project's assets."""
    return Image.open(shipped() / name)


def png(image: Image.Image) -> bytes:
    """Encode a picture as PNG."""
    buffer = io.BytesIO()
    image.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def palette(image: Image.Image, colours: int) -> bytes:
    """Encode a picture as PNG with a palette; one with alpha keeps it in the palette."""
    method = Image.Quantize.FASTOCTREE if image.mode == "RGBA" else Image.Quantize.MEDIANCUT
    return png(image.quantize(colours, method=method, dither=Image.Dither.NONE))


def filled(image: Image.Image, colour: tuple[int, int, int]) -> Image.Image:
    """Give the invisible texels of a picture with alpha a colour that does not show at edges."""
    texels = np.array(image)
    texels[texels[..., 3] == 0, :3] = colour
    return Image.fromarray(texels)


def normal(values: np.ndarray) -> np.ndarray:
    """Shift and scale values to the mean 0 and the standard deviation 1."""
    return np.asarray((values - values.mean()) / values.std())


def grey(name: str) -> np.ndarray:
    """Return an asset in grey, 128 x 128, from 0 to 255."""
    image = asset(name).convert("L").resize((128, 128), Image.Resampling.BOX)
    return np.asarray(image).astype(float)


def steps(values: np.ndarray, width: int) -> bytes:
    """Encode values in 0..255 as a grey PNG in steps of ``width`` levels, which compress well."""
    level = np.round(np.clip(values, 0, 255) / width).clip(0, 256 // width - 1)
    return png(Image.fromarray(level.astype(np.uint8) * width))


def heights() -> bytes:
    """The island's heights, 129 x 129, 16 bits of which the last four are 0."""
    left, top, side = ISLAND
    field = Image.fromarray(np.asarray(asset("height16.png")).astype(np.float32))
    box = (left, top, left + side, top + side)
    small = np.asarray(field.resize((129, 129), Image.Resampling.BOX, box=box)) / 65535
    level = np.round(np.clip(small / HIGHEST, 0, 1) * 4095) * 16
    return png(Image.fromarray(level.astype(np.uint16)))


def ground() -> bytes:
    """The ground of the same part of the island, 256 x 256."""
    left, top, side = (4 * value for value in ISLAND)
    box = (left, top, left + side, top + side)
    small = asset("ground_large.png").resize((256, 256), Image.Resampling.BOX, box=box)
    return palette(small, 128)


def detail() -> bytes:
    """Grass and rock as one grey texture that is repeated, softened by 1.2 texels."""
    frequency = np.fft.fftfreq(128)
    squared = frequency[:, None] ** 2 + frequency[None] ** 2
    soft = np.exp(-squared * 2 * (np.pi * 1.2) ** 2)
    grass = np.real(np.fft.ifft2(np.fft.fft2(normal(grey("ground_detail.png"))) * soft))
    mixed = normal(normal(grass) * 0.8 + normal(grey("ground_rock.png")) * 0.5)
    return steps(128 + mixed * 30, 8)


def water() -> bytes:
    """The water in grey, bright."""
    return steps(170 + normal(grey("water.png")) * 38, 4)


def tree() -> bytes:
    """A conifer, 256 x 256, with 40 colours and 16 levels of alpha.

    What is invisible does not darken its edges: it has the mean of the colours.
    """
    texels = np.asarray(asset("tree_conifer.png")).astype(np.float32)
    alpha = texels[..., 3] / 255
    weighted = [*(texels[..., each] * alpha for each in range(3)), alpha]
    size, box = (256, 256), Image.Resampling.BOX
    *colours, alpha = (np.asarray(Image.fromarray(part).resize(size, box)) for part in weighted)
    summed = np.stack(colours, -1)
    rgb = summed / np.maximum(alpha, 1e-3)[..., None]
    rgb = np.where(alpha[..., None] > 0.02, rgb, summed.sum((0, 1)) / alpha.sum())
    few = Image.fromarray(np.round(rgb).clip(0, 255).astype(np.uint8))
    few = few.quantize(40, dither=Image.Dither.NONE).convert("RGB")
    levels = np.round(alpha * 255 / 17) * 17
    return png(Image.fromarray(np.dstack([np.asarray(few), levels.astype(np.uint8)])))


WALL = 5 / 8  # height over width of the pictures of the horizon, in units of half a side


def _sample(picture: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return the colours (n, 3) at u, v in 0..1, linearly between texels."""
    height, width = picture.shape[:2]
    x = np.clip(u * width - 0.5, 0, width - 1.001)
    y = np.clip(v * height - 0.5, 0, height - 1.001)
    i, j = x.astype(int), y.astype(int)
    right, down = (x - i)[..., None], (y - j)[..., None]
    above = picture[j, i] * (1 - right) + picture[j, i + 1] * right
    below = picture[j + 1, i] * (1 - right) + picture[j + 1, i + 1] * right
    return np.asarray(above * (1 - down) + below * down)


def _look(pictures: dict[str, np.ndarray], way: np.ndarray) -> np.ndarray:
    """Return what the sky at sunset shows in directions (..., 3) from the horizon upwards."""
    x, y, z = (way[..., axis] for axis in range(3))
    side = np.maximum(abs(x), abs(z)) + 1e-9
    found = np.zeros(way.shape)
    v = 1 - np.clip(y / side / WALL, 0, 1)
    along = abs(z) >= abs(x)
    for mask, name, u in (
        (along & (z < 0), "north", x / side),
        (along & (z >= 0), "south", -x / side),
        (~along & (x > 0), "east", z / side),
        (~along & (x <= 0), "west", -z / side),
    ):
        found[mask] = _sample(pictures[name], (u / 2 + 0.5)[mask], v[mask])
    top = y / side > WALL
    up = np.where(top, y, 1)
    u, v = (value / up * WALL / 2 + 0.5 for value in (x, z))
    found[top] = _sample(pictures["top"], u[top], v[top])
    return found


def _sky_and_sea(pictures: dict[str, np.ndarray], way: np.ndarray) -> np.ndarray:
    """Return the sky in directions (..., 3), and below it a sea that mirrors it with ripples."""
    way = way / np.linalg.norm(way, axis=-1, keepdims=True)
    x, y, z = (way[..., axis] for axis in range(3))
    sky = _look(pictures, np.stack([x, abs(y), z], -1))
    deep = np.maximum(-y, 1e-3)
    px, pz = x / deep, z / deep
    ripples = np.sin(px * 9 + 3 * np.sin(pz * 5)) * np.sin(pz * 23 + 2 * np.sin(px * 7))
    ripples = (ripples + np.sin(px * 4.3 + pz * 17)) * 0.5
    mirrored = np.clip(deep * 0.9 + 0.03 * ripples * np.clip(deep * 3, 0, 1), 0.002, 1)
    seen = _look(pictures, np.stack([x, mirrored, z], -1))
    bright = ((1 - np.clip(deep * 1.15, 0, 1)) ** 3)[..., None]
    sea = seen * (0.08 + 0.72 * bright) * np.array([0.85, 0.9, 0.95])
    return np.where((y > 0)[..., None], sky, sea + np.array([4, 14, 24]) * (1 - bright))


def sky(size: int = 256) -> bytes:
    """A sky box as a row of six: from the north by the east, up, down: squares of ``size``."""
    pictures = {
        name: np.asarray(asset(f"sky_sunset_{name}.png").convert("RGB")).astype(float)
        for name in ("north", "east", "south", "west", "top")
    }
    across = (np.arange(2 * size) + 0.5) / size - 1  # two samples a pixel
    u, v = np.meshgrid(across, -across)
    one = np.ones_like(u)
    faces = [(u, v, -one), (one, v, u), (-u, v, one), (-one, v, -u), (u, one, v), (u, -one, -v)]
    drawn = (_sky_and_sea(pictures, np.stack(face, -1)) for face in faces)
    sheet = np.concatenate([f.reshape(size, 2, size, 2, 3).mean((1, 3)) for f in drawn], 1)
    buffer = io.BytesIO()
    image = Image.fromarray(sheet.clip(0, 255).astype(np.uint8))
    image.save(buffer, "JPEG", quality=88, subsampling=0, optimize=True)
    return buffer.getvalue()


def plant() -> bytes:
    """The plant, 256 x 256."""
    small = asset("plant.png").convert("RGBa").resize((256, 256), Image.Resampling.LANCZOS)
    return palette(filled(small.convert("RGBA"), (52, 84, 36)), 200)


def fire() -> bytes:
    """The sixteen pictures of the fire, each moved up by 4 texels, with an invisible frame."""
    dark = (60, 14, 6)
    pictures = np.array(asset("fire.png").convert("RGBA"))
    pictures = pictures.reshape(4, 128, 4, 128, 4).swapaxes(1, 2)
    moved = np.zeros_like(pictures)
    moved[...] = (*dark, 0)
    moved[:, :, 4:124] = pictures[:, :, 8:]
    sheet = np.ascontiguousarray(moved.swapaxes(1, 2).reshape(512, 512, 4))
    return palette(filled(Image.fromarray(sheet), dark), 256)


def brick() -> bytes:
    """The castle's bricks, 256 x 256, brighter, so that a light map has something to darken."""
    small = asset("castle_brick.png").convert("RGB").resize((256, 256), Image.Resampling.LANCZOS)
    bright = ImageEnhance.Brightness(small).enhance(1.3)
    return palette(ImageEnhance.Contrast(bright).enhance(1.25), 64)


def sword() -> bytes:
    """The sword in the hand, the right half of its picture."""
    return palette(filled(asset("sword_rest.png").crop((256, 0, 512, 512)), (90, 70, 50)), 256)


def rabbit() -> bytes:
    """The rabbit with TRIANGLES triangles, from -1 to 1, as a PLY that a text editor shows."""
    import fast_simplification

    vertices, faces = read_mesh(shipped() / "rabbit.ply")
    low, high = vertices.min(0), vertices.max(0)
    vertices = (vertices - (high + low) / 2) / ((high - low).max() / 2)
    points, triangles = fast_simplification.simplify(
        np.ascontiguousarray(vertices, np.float32),
        faces.astype(np.int32),
        target_count=TRIANGLES,
        agg=5,
    )
    lines = ["ply", "format ascii 1.0", "comment the rabbit of the landscape, simplified"]
    lines += [f"element vertex {len(points)}", *(f"property float {axis}" for axis in "xyz")]
    lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices"]
    lines += ["end_header", *("{:.3f} {:.3f} {:.3f}".format(*point) for point in points)]
    lines += ["3 {} {} {}".format(*triangle) for triangle in triangles]
    return ("\n".join(lines).replace("-0.000", "0.000") + "\n").encode()


def letters() -> bytes:
    """The 256 characters of code page 1252, in rows of sixteen, white on black."""
    try:
        font = ImageFont.truetype(*FONT)
    except OSError:
        raise InputError(f"letters.png: requires the font {FONT[0]}") from None
    sheet = Image.new("L", (256, 512))
    for code in range(32, 256):
        cell = Image.new("L", LETTER)
        character = bytes([code]).decode("cp1252", "ignore")
        ImageDraw.Draw(cell).text((1, 1), character, 255, font=font)
        sheet.paste(cell, (code % 16 * LETTER[0], code // 16 * LETTER[1]))
    return png(sheet)


def _planet() -> bytes:
    from landscape.studio.lessons.planet import planet

    image = Image.fromarray(planet()).resize((512, 256), Image.Resampling.LANCZOS)
    # The continent is in the middle, and the seam of the map in the sea.
    return palette(Image.fromarray(np.roll(np.asarray(image), 256, axis=1)), 160)


MAKERS: dict[str, Callable[[], bytes]] = {
    "brick.png": brick,
    "detail.png": detail,
    "fire.png": fire,
    "ground.png": ground,
    "heights.png": heights,
    "letters.png": letters,
    "planet.png": _planet,
    "plant.png": plant,
    "rabbit.ply": rabbit,
    "sky.jpg": sky,
    "sword.png": sword,
    "teapot.txt": teapot.text,
    "tree.png": tree,
    "water.png": water,
}


def main(words: list[str] | None = None) -> int:
    """Write the files that are named, or all."""
    parser = argparse.ArgumentParser(prog="python -m landscape.studio.lessons.lesson_data")
    parser.add_argument("names", nargs="*", metavar="NAME", help="file names; default: all")
    parser.add_argument("--out", type=Path, default=DATA, metavar="DIR", help="default: in place")
    options = parser.parse_args(words)
    for name in options.names:
        if name not in MAKERS:
            raise InputError(f"{name}: expected one of {', '.join(MAKERS)}")
    try:
        options.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {options.out}: cannot be created ({error.strerror})") from None
    for name in options.names or MAKERS:
        write_whole(options.out / name, MAKERS[name]())
        print(options.out / name)
    return 0


if __name__ == "__main__":
    try:
        raise SystemExit(main())
    except InputError as error:
        print(f"landscape: {error}", file=sys.stderr)
        raise SystemExit(2) from None
