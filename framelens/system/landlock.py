"""Landlock, by which a process of Linux gives up files, for itself and for its later children.

What is not named can be neither opened nor changed from then on, whoever the user is, root too. It
stays possible to ask for a file's size and rights, and to change the rights: see seccomp.py. The
kernel's own description is Documentation/userspace-api/landlock.rst.
"""

import ctypes
import errno
import os
import struct
import sys
from collections.abc import Iterable

assert sys.platform == "linux"

# The same numbers on every processor.
CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
ASK_VERSION = 1
PATH_BENEATH = 1
NO_NEW_PRIVILEGES = 38  # PR_SET_NO_NEW_PRIVS of prctl(2)

EXECUTE = 1 << 0
WRITE_FILE = 1 << 1
READ_FILE = 1 << 2
READ_FOLDER = 1 << 3
REMOVE_FOLDER = 1 << 4
REMOVE_FILE = 1 << 5
MAKE_FOLDER = 1 << 7
MAKE_FILE = 1 << 8
REFER = 1 << 13
TRUNCATE = 1 << 14
DEVICE_CONTROL = 1 << 15

OF_A_FILE = EXECUTE | WRITE_FILE | READ_FILE | TRUNCATE | DEVICE_CONTROL
READING = EXECUTE | READ_FILE | READ_FOLDER
LISTING = READ_FOLDER
# No links, pipes, sockets or devices.
MAKING = REMOVE_FOLDER | REMOVE_FILE | MAKE_FOLDER | MAKE_FILE | REFER
WRITING = READING | WRITE_FILE | TRUNCATE | MAKING
DEVICE = READ_FILE | WRITE_FILE | DEVICE_CONTROL

# The rights that the kernel knows: in its first version 13, then one more in the versions 2, 3, 5.
RIGHTS = {1: 13, 2: 14, 3: 15, 5: 16}
SEES_TRUNCATE = 3  # the version that knows truncate(2)
NETWORK = 3  # TCP: bind and connect, from version 4 on
SCOPES = 3  # abstract sockets and signals of processes outside, from version 6 on

_libc = ctypes.CDLL(None, use_errno=True)


def version() -> int:
    """Return the version of Landlock that the kernel has; 0 for none."""
    found = _libc.syscall(CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint(ASK_VERSION))
    return max(int(found), 0)


def restrict(rules: Iterable[tuple[str, int]]) -> None:
    """Leave this process only the named files: (path, rights), folders with all that is in them.

    Paths that are not there are left out. OSError if the kernel refuses.
    """
    known = version()
    if known == 0:
        raise OSError(errno.ENOSYS, "the kernel has no Landlock")
    handled = (1 << RIGHTS[max(each for each in RIGHTS if each <= known)]) - 1
    fields = [handled]
    if known >= 4:
        fields.append(NETWORK)
    if known >= 6:
        fields.append(SCOPES)
    attributes = struct.pack(f"={len(fields)}Q", *fields)
    ruleset = _checked(CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), 0)
    try:
        for path, rights in rules:
            _allow(ruleset, path, rights & handled)
        if _libc.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0):
            raise OSError(ctypes.get_errno(), "no_new_privs")
        _checked(RESTRICT_SELF, ruleset, 0)
    finally:
        os.close(ruleset)


def _allow(ruleset: int, path: str, rights: int) -> None:
    try:
        file = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not os.path.isdir(path):
            rights &= OF_A_FILE
        _checked(ADD_RULE, ruleset, PATH_BENEATH, struct.pack("=Qi", rights, file), 0)
    finally:
        os.close(file)


def _checked(number: int, *arguments: object) -> int:
    result = int(_libc.syscall(number, *arguments))
    if result < 0:
        code = ctypes.get_errno()
        raise OSError(code, os.strerror(code))
    return result
