"""The catalogues of translated texts, landscape/locale/LANGUAGE/DOMAIN.po.

    python scripts/catalogues update    # adds empty entries for new texts, removes stale ones
    python scripts/catalogues check     # lists what is untranslated, stale, fuzzy or damaged

`update` also writes README.LANGUAGE.md, from README.md and its catalogue. Where the texts of each
domain come from is in domains.py. The exit status of `check` is 1 if it finds a fault. A text that
has changed is a new one: `update` prints the translation of the old.
"""

import argparse
import os
import signal
import sys
from pathlib import Path

import readme
from catalogue import faults, update
from domains import DOMAINS

from landscape.languages import LANGUAGES, LOCALE


def main() -> int:
    """Run the command line and return the exit status."""
    parser = argparse.ArgumentParser(prog="catalogues", description=__doc__.split("\n")[0])
    parser.add_argument("command", choices=("update", "check"))
    parser.add_argument("--locale", type=Path, default=LOCALE, help="folder of the catalogues")
    options = parser.parse_args()
    found = []
    for language in LANGUAGES[1:]:
        folder = options.locale / language
        wanted = {folder / f"{domain}.po": list(texts()) for domain, texts in DOMAINS.items()}
        if options.command == "update":
            for path, messages in wanted.items():
                try:
                    found += update(path, language, messages)
                except ValueError as error:
                    sys.exit(f"catalogues: {error}")
        for path, messages in wanted.items():
            found += faults(path, messages)
        if options.locale == LOCALE:
            if options.command == "update":
                readme.write(language)
            found += readme.stale(language)
        strangers = sorted(set(folder.rglob("*.po")) - wanted.keys())
        found += [f"{path}: stale: no texts belong to it" for path in strangers]

    here = f"{Path.cwd()}{os.sep}"
    print("\n".join(line.removeprefix(here) for line in found) or "every text is translated")
    return 1 if found and options.command == "check" else 0


if __name__ == "__main__":
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly when `| head` has enough
    sys.exit(main())
