"""The catalogues of translated texts, locale/LANGUAGE/DOMAIN.po of each package.

    python scripts/catalogues update    # adds empty entries for new texts, removes stale ones
    python scripts/catalogues check     # lists what is untranslated, stale, fuzzy or damaged

`update` also writes README.LANGUAGE.md, from README.md and its catalogue. Where the texts of each
domain come from is in domains.py. The exit status of `check` is 1 if it finds a fault. A text that
has changed is a new one: `update` prints the translation of the old. A new text that other
catalogues have is translated as there.
"""

import argparse
import os
import signal
import sys
from pathlib import Path

import readme
from catalogue import faults, known, update
from domains import DOMAINS, IN_FRAMELENS

import landscape
from framelens.base.packages import FRAMELENS
from framelens.base.texts import LANGUAGES

LOCALE = Path(landscape.__file__).parent / "locale"


def main() -> int:
    """Run the command line and return the exit status."""
    parser = argparse.ArgumentParser(prog="catalogues", description=__doc__.split("\n")[0])
    parser.add_argument("command", choices=("update", "check"))
    parser.add_argument(
        "--locale", type=Path, help="a folder with copies of all catalogues; default: theirs"
    )
    options = parser.parse_args()
    found = []
    for language in LANGUAGES[1:]:
        wanted = {
            _home(domain, options.locale) / language / f"{domain}.po": list(texts())
            for domain, texts in DOMAINS.items()
        }
        if options.command == "update":
            try:
                elsewhere = known(wanted)
                for path, messages in wanted.items():
                    found += update(path, language, messages, elsewhere)
            except ValueError as error:
                sys.exit(f"catalogues: {error}")
        for path, messages in wanted.items():
            found += faults(path, messages)
        if options.locale is None:
            if options.command == "update":
                readme.write(language)
            found += readme.stale(language)
        folders = {_home(domain, options.locale) / language for domain in DOMAINS}
        present = {path for folder in folders for path in folder.rglob("*.po")}
        strangers = sorted(present - wanted.keys())
        found += [f"{path}: stale: no texts belong to it" for path in strangers]

    here = f"{Path.cwd()}{os.sep}"
    print("\n".join(line.removeprefix(here) for line in found) or "every text is translated")
    return 1 if found and options.command == "check" else 0


def _home(domain: str, copies: Path | None) -> Path:
    """Return the folder of a domain's catalogues, without the language."""
    if copies is not None:
        return copies
    return (
        FRAMELENS.locale if domain in IN_FRAMELENS else Path(landscape.__file__).parent / "locale"
    )


if __name__ == "__main__":
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly when `| head` has enough
    sys.exit(main())
