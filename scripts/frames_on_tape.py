"""Hashes of frames: every OpenGL call with its element and pass, and the picture's bytes.

    python scripts/frames_on_tape.py --out before.json [VIEW...]
    python scripts/frames_on_tape.py --compare before.json [VIEW...]

A change that is to leave the pictures alone must not change one call: run the first before it and
the second after it. Which line of which function makes a call is left out. Without VIEW: the views
of figure 35 in both presets, and some of each scene. On another computer or driver the pictures may
differ.
"""

import argparse
import hashlib
import json
import subprocess
import sys
from pathlib import Path

SIZE = "320x240"
LEFT_OUT = ("source", "call", "text", "function")
VIEWS = (
    *(f"fig35{letter}" for letter in "abcdefghi"),
    *("fig4b", "fig10a", "fig14a", "fig17b", "fig22a", "fig25d", "fig29d", "fig36a", "fig38a"),
    *("hall", "hall_mirror", "hall_caustics", "hall_exhibits", "hall_mist", "hall_one_floor"),
    *("voxel_bay", "voxel_castle", "voxel_water", "voxel_slope", "voxel_below"),
)
PRESETS = ("2006", "best")


def run(*words: str) -> bytes:
    """Return what a command of the program prints; raise CalledProcessError if it fails."""
    command = [sys.executable, "-m", "landscape", *words]
    return subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout


def without_places(call: dict[str, object]) -> dict[str, object]:
    """Return a call of a trace without its number and source line, nor those of its list."""
    kept = {name: value for name, value in call.items() if name not in LEFT_OUT}
    inside = kept.get("list")
    if isinstance(inside, list):
        kept["list"] = [without_places(each) for each in inside]
    return kept


def hashes(view: str, preset: str) -> dict[str, str]:
    """Return the hash of a frame's calls, and that of its picture."""
    common = ("--preset", preset, "--size", SIZE, "-q", "--backend", "osmesa")
    calls = [without_places(call) for call in json.loads(run("trace", view, "--json", *common))]
    picture = Path(f"/dev/shm/tape-{view}-{preset}.png")
    try:
        run("render", view, "--out", str(picture), "--samples", "0", *common)
        pixels = picture.read_bytes()
    finally:
        picture.unlink(missing_ok=True)
    return {
        "calls": hashlib.sha256(json.dumps(calls, sort_keys=True).encode()).hexdigest()[:16],
        "picture": hashlib.sha256(pixels).hexdigest()[:16],
    }


def main() -> int:
    """Write the hashes of the views, or compare them; the exit status is 1 if one differs."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("views", nargs="*", default=VIEWS, metavar="VIEW")
    parser.add_argument("--out", type=Path, help="a file to write")
    parser.add_argument("--compare", type=Path, help="a file that --out has written")
    options = parser.parse_args()

    known = {each["name"] for each in json.loads(run("views", "--json"))}
    found = {}
    for view in options.views:
        if view not in known:
            print(f"{view}: no such view")
            continue
        scene_has_presets = PRESETS if view.startswith("fig") else ("best",)
        for preset in scene_has_presets:
            found[f"{view} {preset}"] = hashes(view, preset)

    if options.out:
        options.out.write_text(json.dumps(found, indent=1) + "\n")
    if not options.compare:
        return 0
    before = json.loads(options.compare.read_text())
    differ = [name for name in found if found[name] != before.get(name)]
    for name in differ:
        print(f"{name}: {before.get(name)} -> {found[name]}")
    print(f"{len(found) - len(differ)} of {len(found)} frames are the same")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
