"""Inputs that are damaged or hostile files: images, meshes, recordings, entries of the cache."""

import json
import os
import random
import shutil
import struct
import zlib
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from case import RENDER, Case
from PIL import Image
from values import FIELDS, value

import landscape
from framelens.gl.context import BACKENDS
from landscape.walk.recording import ACTIONS


def damaged(rng: random.Random, data: bytes, times: int) -> bytes:
    """Return data with bytes changed, cut out, repeated or inserted."""
    found = bytearray(data)
    for _ in range(times):
        at = rng.randrange(len(found) + 1)
        match rng.randrange(6):
            case 0 | 1:
                found[at : at + 1] = bytes([rng.randrange(256)])
            case 2:
                found[at : at + 4] = rng.choice([b"\xff" * 4, b"\x00" * 4, b"\x7f\xff\xff\xff"])
            case 3:
                del found[at : at + rng.choice([1, 4, 100, 10**6])]
            case 4:
                found[at:at] = found[at : at + rng.choice([1, 8, 64])]
            case 5:
                found[at:at] = rng.randbytes(rng.choice([1, 4, 50]))
    return bytes(found)


def picture(rng: random.Random, form: str = "PNG") -> bytes:
    """Return a small image file."""
    pixels = np.random.default_rng(rng.randrange(2**32)).integers(0, 256, (24, 24, 3), np.uint8)
    mode = rng.choice(["RGB", "L", "P"]) if form in ("PNG", "GIF", "TIFF", "BMP") else "RGB"
    file = BytesIO()
    Image.fromarray(pixels).convert(mode).save(file, form)
    return file.getvalue()


def huge_png(rng: random.Random) -> bytes:
    """Return a PNG whose header promises more than the file holds, with a right checksum."""
    width, height = rng.choice([(2**31 - 1, 1), (60000, 60000), (0, 5), (13000, 13000), (1, 10**9)])
    kind = bytes([rng.choice([1, 8, 16, 3]), rng.choice([0, 2, 3, 6, 7]), 0, 0, rng.choice([0, 1])])
    header = b"IHDR" + struct.pack(">II", width, height) + kind
    data = zlib.compress(bytes(rng.choice([10, 10**5])))
    chunks = [header, b"IDAT" + data, b"IEND"]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
        for chunk in chunks
    )


def image(rng: random.Random) -> Case:
    """Return a damaged image as height image, or as a texture."""
    form = rng.choice(["PNG", "PNG", "JPEG", "GIF", "TIFF", "BMP", "WEBP", "PPM", "TGA"])
    data = (
        huge_png(rng)
        if rng.random() < 0.15
        else damaged(rng, picture(rng, form), rng.randint(0, 4))
    )
    name, element = rng.choice(
        [("ground_large.png", "ground"), ("water.png", "water"), ("castle_brick.png", "castle")]
        + [("tree_broadleaf.png", "trees"), ("blade.png", "grass"), ("sky_north.png", "sky")]
        + [("map.png", "map"), ("animal.png", "rabbit"), ("sword_rest.png", "sword")]
    )
    case = Case(args=[*RENDER, "fig35a", "--only", element], size=(40, 30), outputs=["out.png"])
    if rng.random() < 0.5:
        name = f"in.{form.lower()}"
        case.args[-1] = "ground"
        case.args += ["--set", f"ground.height_image={name}"]
        case.add(name, data)
    else:
        case.args[case.args.index("../assets")] = "mine"
        case.add(f"mine/{name}", data)

    case.args += [f"--set={group}.count=40" for group in ("trees", "grass")]
    return case


def mesh(rng: random.Random) -> Case:
    """Return a damaged mesh in place of the rabbit or the dragon."""
    form = rng.choice(["ply", "ply", "ply", "obj", "stl", "off", "glb", "stl_ascii"])
    shape = trimesh.creation.icosphere(subdivisions=1)
    if form == "ply" and rng.random() < 0.5:
        data = shape.export(file_type="ply", encoding="ascii")
    else:
        data = shape.export(file_type=form)

    data = data.encode() if isinstance(data, str) else data
    if rng.random() < 0.3:
        words = [b"0", b"-1", b"nan", b"inf", b"1e39", b"99999999999", b"999999999", b""]
        numbers = [word for word in data[:3000].split() if word.lstrip(b"-").isdigit()] or [
            b"vertex"
        ]
        data = data.replace(rng.choice(numbers), rng.choice(words), rng.choice([1, 3, 10**6]))

    data = damaged(rng, data, rng.choice([0, 1, 1, 2, 5]))
    name = f"in.{form[:3]}"
    element = rng.choice(["rabbit", "dragon"])
    args = [*RENDER, "fig35c", "--only", element, "--set", f"{element}.mesh={name}"]
    if rng.random() < 0.5:
        args[args.index("2006")] = "best"
        args += ["--set=ground.shadows=off", "--set=ground.resolution=30"]
    case = Case(args=args, size=(40, 30), outputs=["out.png"])
    case.add(name, data)
    return case


def frame(rng: random.Random) -> dict[str, Any]:
    """Return a frame of a walk, perhaps with switches or with settings changed in the list."""
    made: dict[str, Any] = {"dt": 0.03, "look": [0.0, 1.5], "run": True}
    if rng.random() < 0.4:
        made["do"] = rng.choices([*ACTIONS, "time", "go_to_fix"], k=rng.randint(1, 3))
    if rng.random() < 0.3:
        made["list"] = rng.choice([*FIELDS, ""])
    if rng.random() < 0.3:
        made["set"] = {key: value(rng, key) for key in rng.sample(list(FIELDS), rng.randint(1, 2))}
    if rng.random() < 0.2:
        made["size"] = rng.choice([[1, 1], [64, 20], [300, 200]])
    return made


def recording(rng: random.Random) -> Case:
    """Return an edited recording of a walk, to be replayed without a screen."""
    plan: dict[str, Any] = {
        "landscape walk": 1,
        "view": "fig35a",
        "pose": [8.0, None, 33.0, 28.0, -1],
    }
    plan |= {
        "kt": 40,
        "size": [40, 30],
        "seed": 2006,
        "only": ["ground", "sky"],
        "wireframe": False,
    }
    plan |= {"language": "en", "settings": {"ground.resolution": 20}}
    frames: list[Any] = [frame(rng) for _ in range(rng.randint(2, 5))]
    lines = [plan, *frames, {"frames": len(frames)}]
    odd = [
        None,
        True,
        -1,
        0,
        1e9,
        1e400,
        -1e9,
        10**400,
        float("nan"),
        "",
        "x",
        [],
        [1, 2],
        {},
        10**6,
    ]
    for _ in range(rng.randint(0, 3)):
        line = rng.choice(lines)
        key = rng.choice([*line, "extra", "forward", "size", "do", "set", "list", "pose", "strike"])
        line[key] = rng.choice(odd)

    data = "\n".join(json.dumps(line) for line in lines).encode()
    if rng.random() < 0.3:
        data = damaged(rng, data, rng.randint(1, 3))
    backend = ["--backend", "osmesa"] if BACKENDS[0] == "osmesa" else []
    case = Case(args=["walk", "--replay", "in.jsonl", *backend, "--assets", "../assets", "-q"])
    if rng.random() < 0.5:
        case.args += ["--record", rng.choice(["in.jsonl", "new.jsonl"])]
        case.outputs = ["in.jsonl"]
    case.add("in.jsonl", data)
    return case


def cache(rng: random.Random) -> Case:
    """Return a damaged entry of the cache, which must not be seen in the picture."""
    return Case(expression=f"damage.edited_cache({rng.randrange(10**9)})", size=(40, 30))


def edited_cache(seed: int) -> np.ndarray:
    """Draw with an empty cache, damage an entry, and draw again: the same picture."""
    rng = random.Random(seed)
    before, os.environ["LANDSCAPE_CACHE"] = os.environ.get("LANDSCAPE_CACHE", ""), "cache"
    options = {"size": (40, 30), "preset": "2006", "only": "ground,sky,trees", "samples": 0}
    changes = {"trees.count": 40}
    try:
        first, second = None, None
        for turn in range(2):
            drawn = landscape.render("fig35a", assets="../assets", settings=changes, **options)
            first, second = second, np.asarray(drawn)
            if turn == 0:
                edit_cache(rng, Path("cache"))
    finally:
        os.environ["LANDSCAPE_CACHE"] = before
    assert second is not None and (first == second).all(), "the picture shows the damage"
    return second


def edit_cache(rng: random.Random, folder: Path) -> None:
    """Damage entries of a cache, exchange two, or put something else in their place."""
    entries = {path: path.read_bytes() for path in sorted(folder.glob("*.arrays"))}
    for path in rng.sample(list(entries), rng.randint(1, len(entries))):
        match rng.randrange(6):
            case 0:
                path.unlink()
                path.mkdir()
            case 1:
                path.unlink()
                path.symlink_to(rng.choice(["/dev/null", "missing", path.name]))
            case 2:
                path.write_bytes(rng.choice(list(entries.values())))
            case 3:
                path.write_bytes(b"")
            case _:
                path.write_bytes(damaged(rng, entries[path], rng.randint(1, 3)))

    if rng.random() < 0.1:
        shutil.rmtree(folder)
        folder.write_bytes(b"")
