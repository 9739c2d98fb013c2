"""Whether the program works on a computer: doctor, stills, a lesson, an exercise and traces.

    python scripts/desks/smoke.py --out DIR [--size 640x360] [--takes BACKEND]
    python scripts/desks/smoke.py --out DIR --compare OTHER

The first takes a minute or two and fills DIR. Every step is run, also after one that failed; the
exit status is 1 if one did, or if `--backend auto` takes another backend than --takes says. The
second compares the stills of two computers: pictures that differ more than those of two renderers
may are put into DIR/differ, each with what OTHER has and the difference.

It runs with the Python that has the program installed, on Windows and macOS, too.
"""

import argparse
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SECONDS = 600  # chosen: a step that takes longer hangs
STILLS = (
    *(f"fig35{letter}" for letter in "abcdefghi"),
    *("hall", "voxel", "dusk_bay"),
)


@dataclass(frozen=True)
class Step:
    """A command of the program, what it must answer, and the file that gets its output."""

    name: str
    words: tuple[str, ...]
    status: int = 0
    output: str = ""


def steps(out: Path, size: str) -> Iterator[Step]:
    """Yield what is done, in order. ``size`` is of the stills, as WIDTHxHEIGHT."""
    work = out / "winding.py"
    yield Step("doctor", ("doctor", "--json"), output="doctor.json")
    yield Step("stills", ("render", *STILLS, "--out", str(out / "stills"), "--size", size, "-q"))
    yield Step("lesson", ("lesson", "mirror", "--out", str(out / "lesson.png")))
    yield Step("exercise", ("exercise", "start", "winding", "--out", str(work)))
    yield Step("check", ("exercise", "check", str(work), "--json"), 1, "check.json")
    yield Step("trace", ("trace", "fig35f", "--element", "castle", "--json"), output="trace.json")
    yield Step("program", ("trace", str(work), "--json"), output="program.json")


def run(step: Step, out: Path) -> str:
    """Run a step; return what is wrong with it, else ""."""
    command = [sys.executable, "-m", "landscape", *step.words]
    try:
        done = subprocess.run(command, capture_output=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return f"no end after {SECONDS} seconds"
    if step.output:
        (out / step.output).write_bytes(done.stdout)
    if done.returncode == step.status:
        return ""
    told = (done.stderr or done.stdout).decode(errors="replace").strip()
    return f"status {done.returncode}, not {step.status}: {told}"


def chosen(out: Path) -> str:
    """Return the backend that `--backend auto` takes, as the doctor has said; "" for none."""
    try:
        return json.loads((out / "doctor.json").read_text(encoding="utf-8"))["chosen"] or ""
    except (OSError, ValueError, KeyError):
        return ""


def smoke(out: Path, size: str, takes: str = "") -> int:
    """Run all steps, and say of each how long it took; return the exit status.

    ``takes`` is the backend that `--backend auto` must take, if that matters.
    """
    out.mkdir(parents=True, exist_ok=True)
    (out / "winding.py").unlink(missing_ok=True)
    lines = []
    faults = 0
    for step in steps(out, size):
        begin = time.monotonic()
        fault = run(step, out)
        if step.name == "doctor" and not fault and takes not in ("", chosen(out)):
            fault = f"--backend auto takes {chosen(out) or 'none'}, not {takes}"
        faults += bool(fault)
        lines.append(f"{step.name:9} {time.monotonic() - begin:6.1f} s  {fault or 'ok'}")
        print(lines[-1], flush=True)
    (out / "smoke.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 1 if faults else 0


def compare(out: Path, other: Path) -> int:
    """Compare the stills of two folders; return the exit status."""
    faults = {name: fault for name in STILLS if (fault := differing(name, out, other))}
    for name, fault in faults.items():
        print(f"{name:9} {fault}")
    print(f"{len(STILLS) - len(faults)} of {len(STILLS)} stills agree with those in {other}")
    return 1 if faults else 0


def differing(name: str, out: Path, other: Path) -> str:
    """Return how a still differs from that in another folder, "" if not; show it in a picture."""
    # Imported here: the steps need no picture, and are to say what is wrong where this fails.
    import numpy as np
    from PIL import Image

    from landscape.gallery.compare import OTHER_RENDERER, agree, amplified, difference

    paths = [folder / "stills" / f"{name}.png" for folder in (other, out)]
    for path in paths:
        if not path.is_file():
            return f"{path} is missing"
    expected, actual = (np.asarray(Image.open(path).convert("RGB")) for path in paths)
    if agree(expected, actual, same_renderer=False, edges=name == "voxel"):
        return ""
    folder = out / "differ"
    folder.mkdir(exist_ok=True)
    shown = {"expected": expected, "actual": actual, "difference": amplified(expected, actual)}
    for kind, picture in shown.items():
        Image.fromarray(picture).save(folder / f"{name}-{kind}.png")
    if expected.shape != actual.shape:
        return f"{actual.shape[1]}x{actual.shape[0]}, not {expected.shape[1]}x{expected.shape[0]}"
    levels = difference(expected, actual)
    part = (levels > OTHER_RENDERER).mean()
    return f"{part:.2%} of the pixels differ by more than {OTHER_RENDERER} levels"


def main() -> int:
    """Run the command line and return the exit status."""
    parser = argparse.ArgumentParser(prog="smoke", description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=Path, required=True, metavar="DIR")
    parser.add_argument("--size", default="640x360", metavar="WxH", help="of the stills")
    parser.add_argument("--takes", default="", metavar="BACKEND", help="by `--backend auto`")
    parser.add_argument("--compare", type=Path, metavar="OTHER", help="a folder that --out made")
    options = parser.parse_args()
    if options.compare:
        return compare(options.out, options.compare)
    return smoke(options.out, options.size, options.takes)


if __name__ == "__main__":
    sys.exit(main())
