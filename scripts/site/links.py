"""The links of a built site, followed in its files."""

from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Links(HTMLParser):
    """Notes where a page leads to, and the names of its places."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.targets: set[str] = set()
        self.names: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value is not None:
                self.targets.add(value)
            elif name in ("id", "name") and value:
                self.names.add(value)


def dead_links(site: Path) -> Iterator[str]:
    """Yield a line for each link to a file, or a place in one, that is not there."""
    read = {path: _Links(path) for path in sorted(site.rglob("*.html"))}
    for path, links in read.items():
        for target in sorted(links.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc or target.startswith("#top"):
                continue
            file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if file.is_dir():
                file /= "index.html"
            known = read[file].names if file in read else {unquote(parts.fragment)}
            if not file.exists() or (parts.fragment and unquote(parts.fragment) not in known):
                yield f"{path.relative_to(site)}: leads to {target}, which is not there"
