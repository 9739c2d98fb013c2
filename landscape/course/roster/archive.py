"""A zip made in memory: the same files give the same bytes."""

import io
import zipfile
from collections.abc import Mapping

DATE = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip can have
READABLE = 0o644 << 16  # the rights of a file, where the system has some


def zipped(files: Mapping[str, bytes]) -> bytes:
    """Return a zip of files by their names."""
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w") as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, DATE)
            entry.external_attr = READABLE
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return whole.getvalue()
