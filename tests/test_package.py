"""What the package says of itself: its README as an index shows it, extras, versions, archives."""

import re
import tomllib
from pathlib import Path

from landscape import __version__
from landscape.studio.build import NEEDED

ROOT = Path(__file__).parents[1]
BUILD = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = BUILD["project"]
README = (ROOT / PROJECT["readme"]).read_text(encoding="utf-8")
LINK = re.compile(r"\]\(([^)\s]+)|^\[[^]]+\]:\s*(\S+)|(?:src|href)=[\"']([^\"']+)", re.MULTILINE)
ABSOLUTE = re.compile(r"https://|#")


def targets(text: str) -> list[str]:
    """Return where the links and pictures of a Markdown text lead."""
    return [next(filter(None, match.groups())) for match in LINK.finditer(text)]


def test_the_readme_of_the_package_refers_to_no_file_beside_it() -> None:
    assert [target for target in targets(README) if not ABSOLUTE.match(target)] == []
    assert [
        each
        for each in targets((ROOT / "README.md").read_text(encoding="utf-8"))
        if not ABSOLUTE.match(each)
    ]


def test_the_readme_of_the_package_names_extras_that_exist() -> None:
    named = set(re.findall(r"landscape-gl\[(\w+)\]", README))
    assert named and named <= set(PROJECT["optional-dependencies"])


def test_the_studio_names_the_packages_of_its_extra() -> None:
    studio = PROJECT["optional-dependencies"]["studio"]
    assert [re.split("[>=]", each)[0] for each in studio] == list(NEEDED)


def test_extras_refer_to_the_distribution_by_its_name() -> None:
    requirements = [each for extra in PROJECT["optional-dependencies"].values() for each in extra]
    own = [each for each in requirements if each.startswith("landscape")]
    assert own and all(each.startswith(f"{PROJECT['name']}[") for each in own)


def test_no_text_tells_users_to_install_the_strangers_distribution() -> None:
    told = re.compile(r"(?: install|--from|--spec|uvx|pipx run) [\"']?landscape(?![-/\w])")
    texts = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    texts += [*(ROOT / "landscape").rglob("*.py"), *(ROOT / "landscape").rglob("*.po")]
    for path in texts:
        assert not told.search(path.read_text(encoding="utf-8")), path


def test_the_citation_has_the_version_of_the_package() -> None:
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {__version__}\n" in citation
