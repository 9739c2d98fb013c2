"""`landscape exercise list`: the exercises, the easiest first."""

import argparse
import json
import os
import sys

from framelens.base.texts import choose, translator
from framelens.base.texts import marked as _
from framelens.commands.parser import language_option
from landscape.commands.shelves import exercises_option, shelf
from landscape.course.shelf import LEAD

EXAMPLE = "--json"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("--json", action="store_true", help=_("print JSON, with the tasks"))
    exercises_option(parser)
    language_option(parser, "language of the texts")


def run(options: argparse.Namespace) -> int:
    """Print the exercises in their order; return the exit status."""
    language = options.lang or choose(os.environ)
    lead = translator(language, "course")(LEAD)
    rows = []
    exercises = shelf(options.exercises)
    for name in exercises.names:
        found = exercises.exercise(name)
        own = found.translate.to(language)
        task = [own(text) for text in found.task]
        lessons = list(found.lessons)
        rows.append({"name": name, "title": own(found.title), "task": task, "lessons": lessons})
    if options.json:
        print(json_text(rows))
    else:
        for row in rows:
            print(f"{row['name']:20} {row['title']}")
            if row["lessons"]:
                print(" " * 20, lead.format(lessons=", ".join(row["lessons"])))
    return 0


def json_text(value: object) -> str:
    """Return a value as JSON, with letters as they are where the output has all of them."""
    encoding = (sys.stdout.encoding or "").lower()
    return json.dumps(value, indent=1, ensure_ascii=encoding != "utf-8")
