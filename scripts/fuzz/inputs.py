"""The inputs: for each kind, a function that makes one from a random generator.

A kind's function is named in KINDS. Those that damage files are in damage.py.
"""

import random
from collections.abc import Callable

from case import ELEMENTS, RENDER, Case
from damage import cache, damaged, image, mesh, picture, recording
from values import FIELDS, WORDS, number, setting, value

from landscape.scene.scene import SCENES, scene


def make(name: str, seed: int) -> Case:
    """Return an input by its name, KIND-NUMBER: the same for the same seed."""
    rng = random.Random(f"{seed} {name}")
    case = KINDS[name.rpartition("-")[0]](rng)
    case.name = name
    return case


# --- commands ----------------------------------------------------------------------------------

FIXES = [fix.name for fix in scene().fixes]
VIEWS = [*scene().views, *FIXES, "fig99z", "R99", *SCENES]
SIZES = ["1x1", "2x1", "40x30", "64x48", "1x3000", "3000x1", "16384x1", "1x16384", "700x500"]
BAD_SIZES = ["0x0", "-1x5", "16385x1", "16384x16384", "1e3x4", "x", "800", "nanxnan", "1x1x1"]
OPTIONS: dict[str, Callable[[random.Random], str]] = {
    "--size": lambda rng: rng.choice(SIZES + BAD_SIZES),
    "--pose": lambda rng: ",".join(number(rng) for _ in range(rng.choice([5, 5, 5, 5, 4, 6]))),
    "--kt": lambda rng: number(rng),
    "--seed": lambda rng: rng.choice(["0", "7", "-1", "1.5", "9" * 18, "9" * 19, "x"]),
    "--samples": lambda rng: rng.choice(["0", "4", "1", "8", "-4", "x"]),
    "--backend": lambda rng: rng.choice(["auto", "osmesa", "glfw", "metal", ""]),
    "--preset": lambda rng: rng.choice(["2006", "2006", "best", "1996", ""]),
    "--only": lambda rng: ",".join(rng.choices([*ELEMENTS, "cows", ""], k=rng.randint(1, 3))),
    "--set": lambda rng: setting(rng),
    "--settings": lambda rng: rng.choice(["in.toml", "in.png", "missing.toml", "."]),
    "--assets": lambda rng: rng.choice(["../assets", ".", "missing", "in.png", ""]),
    "--out": lambda rng: rng.choice(["out.png", "new/out.png", "new", ".", "in.png/x", "x.jpg"]),
    "--element": lambda rng: rng.choice([*ELEMENTS, "frame", "cows", ""]),
    "--frames": lambda rng: rng.choice(["0", "1", "2", "-1", "x"]),
    "--replay": lambda rng: rng.choice(["tour", "in.toml", "missing.jsonl", "."]),
    "--fps": lambda rng: rng.choice(["0", "30", "1000", "0.5", "nan", "x"]),
    "--lang": lambda rng: rng.choice(["en", "fr", "de", ""]),
    "--record": lambda rng: rng.choice(["walk.jsonl", "new/walk.jsonl", ".", "in.png/x"]),
}
FLAGS = ["--json", "--wireframe", "-q", "--quiet", "--help", "--check", "--no-such", "--fullscreen"]
# These would take long, need the network, or change the checkout; they end before they begin.
ENDLESS = {"bench": "fig99z", "figures": "fig99z", "assets build": "x.png", "assets check": "x"}
COMMANDS = ["render", "render", "render", "trace", "walk", "views", "settings", "doctor", "dance"]
COMMANDS += ["assets sheet", *ENDLESS]


def command(rng: random.Random) -> Case:
    """Return a command with random options, most of them its own."""
    name = rng.choice(COMMANDS)
    args = name.split()
    if name in ENDLESS:
        args.append(ENDLESS[name])
    elif name == "render":
        args += [
            "--preset",
            "2006",
            "--size",
            "40x30",
            *rng.sample(VIEWS, rng.choice([0, 1, 1, 2])),
        ]
        args += ["--only", rng.choice(ELEMENTS), "--assets", "../assets"]
    elif name == "trace":
        args += [rng.choice(VIEWS), "--only", rng.choice(ELEMENTS), "--assets", "../assets"]
    elif name == "walk":
        args += ["--backend", rng.choice(["osmesa", "osmesa", "egl", "auto"]), "--frames", "2"]
        args += ["--size", "40x30", "--preset", "2006", "--assets", "../assets", "-q"]
        args += ["--only", rng.choice(ELEMENTS), *rng.sample(VIEWS, rng.choice([0, 1]))]
    elif name == "settings":
        args += rng.sample(["fog", "light", "zzz", rng.choice(list(FIELDS))], rng.choice([0, 1]))

    for _ in range(rng.randint(0, 4)):
        match rng.random():
            case x if x < 0.6:
                option = rng.choice(list(OPTIONS))
                args += [option, OPTIONS[option](rng)]
            case x if x < 0.8:
                args.append(rng.choice(FLAGS))
            case _:
                args.insert(rng.randint(1, len(args)), rng.choice(WORDS))

    case = Case(args=args, outputs=["in.png"])
    case.add("in.png", picture(rng))
    case.add("in.toml", b"[fog]\ndensity = 0.1\n")
    return case


# --- settings ----------------------------------------------------------------------------------


def settings(rng: random.Random) -> Case:
    """Return a picture with one to three settings changed."""
    changes = [part for _ in range(rng.randint(1, 3)) for part in ("--set", setting(rng))]
    view = rng.choice(["fig35a", "fig35c", "fig35f", "fig8a"])
    only = rng.sample(ELEMENTS, rng.randint(1, 4))
    few = [f"--set={group}.count=40" for group in ("trees", "plants", "deer", "grass")]
    args = [*RENDER, view, "--only", ",".join(only), *few, *changes]
    if rng.random() < 0.3:
        args[args.index("2006")] = "best"
    return Case(args=args, size=(40, 30), outputs=["out.png"])


def toml(rng: random.Random) -> Case:
    """Return a file of settings, right, wrong or damaged."""
    lines = []
    for key in rng.sample(list(FIELDS), rng.randint(1, 5)):
        group, _, name = key.rpartition(".")
        plain = value(rng, key)
        quoted, listed = f'"{plain}"', f"[{plain}]"
        right = {str: quoted, tuple: listed}.get(type(FIELDS[key].default), plain)
        text = rng.choice([plain, quoted, listed]) if rng.random() < 0.1 else right
        lines.append(f"{key} = {text}")
        if group and rng.random() < 0.1:
            lines += [f"[{group}]", f"{name} = {text}"]
    data = "\n".join(lines).encode(errors="surrogateescape")
    if rng.random() < 0.3:
        data = damaged(rng, data, rng.randint(1, 4))
    case = Case(args=["settings", "--settings", "in.toml", *rng.choice([[], ["--json"]])])
    case.add("in.toml", data)
    return case


# --- outputs, places and Python ----------------------------------------------------------------

KEPT = b"an earlier file, which must survive a failure"


def output(rng: random.Random) -> Case:
    """Return an output that goes to an odd place, of a picture that may fail."""
    case = Case(args=[*RENDER, "fig35a", "--only", "ground"], outputs=["old.png", "target.png"])
    case.add("old.png", KEPT)
    case.add("target.png", KEPT)
    targets: list[tuple[str, list[tuple[str, str, str]]]] = [
        ("old.png", []),
        ("old.png", [("mode", "old.png", "444")]),
        ("folder", [("folder", "folder", "")]),
        ("folder.png", [("folder", "folder.png", "")]),
        ("folder/x.png", [("folder", "folder", ""), ("mode", "folder", "555")]),
        ("pipe.png", [("pipe", "pipe.png", "")]),
        ("pipe", [("pipe", "pipe", "")]),
        ("link.png", [("link", "link.png", "target.png")]),
        ("link.png", [("link", "link.png", "new.png")]),
        ("link.png", [("link", "link.png", "no/such/folder.png")]),
        ("link.png", [("link", "link.png", "link.png")]),
        ("link.png", [("link", "link.png", "/dev/full")]),
        ("link", [("link", "link", "/dev/null")]),
        ("link/x.png", [("folder", "folder", ""), ("link", "link", "folder")]),
        *((name, []) for name in ("/dev/full", "/dev/null", "/proc/x.png", "old.png/x.png")),
        *((name, []) for name in ("new/deep/x.png", "new", "x" * 250 + ".png", "x" * 300, "a\nb")),
        *((name, []) for name in ("", ".", "..", "-", "é 山.png", "x.jpg", "x.PNG", ".png", "x.")),
    ]
    out, case.special = rng.choice(targets)
    case.args[case.args.index("out.png")] = out
    case.pipes = [name for kind, name, _ in case.special if kind == "pipe"]
    if rng.random() < 0.4:
        fail = ["ground.height_image=none.png", "ground.height_image=old.png", "fog.density=x"]
        case.args += ["--set", rng.choice(fail)]
    if rng.random() < 0.3:
        case.args.insert(1, "fig35b")
    return case


def place(rng: random.Random) -> Case:
    """Return a pose that may be far away, or a very small or large size."""
    far = ["0", "1e8", "-1e8", "999999999", "1e-40", "ground", "20", "19.99", "-5", "45", "1e4"]
    x, z = (rng.choice([f for f in far if f != "ground"]) for _ in range(2))
    yaw, pitch = (rng.choice(["0", "90", "-90", "89.9999", "1e8", "360", "33"]) for _ in range(2))
    y = rng.choice(far)
    size = rng.choice([*SIZES, "3000x2000", "40x30", "40x30", "40x30"])
    only = rng.sample(ELEMENTS, rng.randint(1, 5))
    args = [*RENDER, "--pose", f"{x},{y},{z},{yaw},{pitch}", "--only", ",".join(only)]
    args += [f"--set={group}.count=200" for group in ("trees", "plants", "deer", "grass")]
    args += ["--kt", rng.choice(["0", "-1", "1e8", "-999999999", "0.5"])]
    args[args.index("40x30")] = size
    args[args.index("2006")] = rng.choice(["2006", "2006", "best"])
    width, height = map(int, size.split("x"))
    return Case(args=args, size=(width, height), outputs=["out.png"])


PYTHON = [
    *["None", "True", "False", "0", "1", "-1", "4", "0.5", "nan", "inf", "1e8", "10**400", "'x'"],
    *["''", "b'x'", "[]", "()", "{}", "object()", "1j", "np.float32(nan)", "np.int64(4)"],
    *["np.zeros(5)", "np.zeros((2, 2))", "np.array([20.0, 3.0, 24.0, 0.0, 0.0])", "lambda: 0"],
    *["Pose(20, None, 24)", "Pose(nan, 1, 2)", "(20, 'ground', 24)", "[20, None, 24, 0, -10]"],
    *["'fig35a'", "'island'", "'R12'", "{'time': 'dawn'}", "{'time': {}}", "{'fog': {'x': 1}}"],
    *["{'fog.density': 0.1}", "{'fog': {'density': np.float64(0.1)}}", "{'fog': 1}", "{1: 2}"],
    *["{'fog.color': np.ones(3)}", "'ground'", "['sky', 'ground']", "Path('.')", "'../assets'"],
    *["(40, 30)", "[1, 1]", "np.array([40, 30])", "(40.0, 30.0)", "(10**9, 1)", "np.bool_(True)"],
    *["2006", "'2006'", "'best'", "'osmesa'", "Fraction(1, 3)", "Decimal('0.5')", "'\\ud800'"],
    *["np.datetime64('2006-12-01')", "np.array(None)", "range(3)", "np.array(['a'])", "set()"],
]
USUAL = {
    "view": ["'fig35a'", "(20, 'ground', 24)", "np.array([20.0, 3.0, 24.0, 0.0, 0.0])"],
    "size": ["(40, 30)"],
    "kt": ["None", "40"],
    "wireframe": ["False", "True"],
    "preset": ["'2006'"],
    "settings": [
        "{'trees.count': 40}",
        "{'ground': {'resolution': 20}}",
        "{'time': 'sunset', 'ground': {'resolution': 20}}",
    ],
    "backend": ["'auto'"],
    "samples": ["0"],
    "assets": ["'../assets'"],
    "only": ["'ground'", "('ground', 'sky')"],
    "seed": ["7"],
}


def face(rng: random.Random) -> Case:
    """Return a call of the Python face with up to two odd arguments."""
    given = {name: rng.choice(values) for name, values in USUAL.items()}
    for name in rng.sample(list(given), rng.randint(0, 2)):
        given[name] = rng.choice(PYTHON)
    size = (40, 30) if given["size"] == "(40, 30)" else None
    listed = ", ".join(f"{name}={text}" for name, text in given.items())
    return Case(expression=f"landscape.render({listed})", size=size)


KINDS: dict[str, Callable[[random.Random], Case]] = {
    "command": command,
    "setting": settings,
    "toml": toml,
    "image": image,
    "mesh": mesh,
    "recording": recording,
    "cache": cache,
    "face": face,
    "output": output,
    "place": place,
}
