"""How large the site may be, by sort of file."""

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

# Chosen, in MB of a million bytes: each sort has room to grow, and all together have less.
LIMITS = {
    "pages": 23.0,
    "animations": 14.0,
    "strips": 11.0,
    "pictures": 13.0,
    "search and theme": 2.5,
}
TOTAL = 60.0
PICTURES = (".avif", ".gif", ".jpg", ".png", ".svg", ".webp")


def sort(path: Path) -> str:
    """Return the sort of a file of the site, a key of ``LIMITS``."""
    if path.suffix == ".html":
        return "pages"
    if path.suffix not in PICTURES:
        return "search and theme"
    if path.stem.endswith("-loop"):
        return "animations"
    return "strips" if path.stem.endswith("-strip") else "pictures"


def sizes(site: Path) -> dict[str, float]:
    """Return the MB that each sort of file takes."""
    count = Counter(dict.fromkeys(LIMITS, 0))
    for path in site.rglob("*"):
        if path.is_file():
            count[sort(path)] += path.stat().st_size
    return {name: size / 1e6 for name, size in count.items()}


def too_large(site: Path) -> Iterator[str]:
    """Yield a line for each sort of file that takes more than its limit, and for their sum."""
    found = sizes(site)
    for name, size in found.items():
        if size > LIMITS[name]:
            yield f"{name}: {size:.1f} MB, more than {LIMITS[name]:g} MB"
    total = sum(found.values())
    if total > TOTAL:
        each = ", ".join(f"{name} {size:.1f}" for name, size in found.items())
        yield f"the site: {total:.1f} MB, more than {TOTAL:g} MB: {each}"
