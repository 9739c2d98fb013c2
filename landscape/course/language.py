"""The language of the course's texts: that of the environment, as gettext finds it."""

import os

from framelens.base.texts import choose, translator


def translated(text: str) -> str:
    """Return an English text of the course or of a lesson in the user's language."""
    return translator(choose(os.environ), "course", "lessons")(text)
