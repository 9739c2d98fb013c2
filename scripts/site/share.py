"""Pictures that are the same in two languages: the site has them once."""

import re
from pathlib import Path

IMAGES = "_images"


def pictures(site: Path, built: Path) -> None:
    """Remove the pictures of a language that the site's top has, too; its pages lead to those.

    ``built`` is the folder of the language, inside ``site``.
    """
    shared = set()
    for path in sorted((built / IMAGES).iterdir()):
        same = site / IMAGES / path.name
        if same.is_file() and same.read_bytes() == path.read_bytes():
            shared.add(path.name)
            path.unlink()

    up = "../" * len(built.relative_to(site).parts)
    image = re.compile(rf'(["(])((?:\.\./)*)({IMAGES}/([^")?#]+))')

    def moved(match: re.Match[str]) -> str:
        return f"{match[1]}{match[2]}{up}{match[3]}" if match[4] in shared else match[0]

    for page in built.rglob("*.html"):
        page.write_text(image.sub(moved, page.read_text(encoding="utf-8")), encoding="utf-8")
