"""A filter of system calls, by which a process of Linux gives up what an exercise never needs.

Landlock (landlock.py) guards the files. This stops what it knows nothing of: other processes,
sockets, rights of files, memory that no limit counts. The process keeps its threads and may end
itself. The filter holds for good, for all threads that are started later and for root, too.

What root may do beyond others counts, too: a program that is checked may run as root.

A call that is refused fails with EPERM; those that the table does not know, because they are newer
than it, with ENOSYS, and libraries do without them. The kernel's own description is
Documentation/userspace-api/seccomp_filter.rst.
"""

import ctypes
import errno
import os
import platform
import struct
import sys

assert sys.platform == "linux"

# Of prctl(2).
NO_NEW_PRIVILEGES = 38
SET_SECCOMP = 22
FILTER = 2

# By the machine: the kernel's number for it, and the column of the tables below.
MACHINES = {"x86_64": (0xC000003E, 0), "aarch64": (0xC00000B7, 1)}
NEWEST = 449  # the last number that the tables know: of futex_waitv
X32 = 0x40000000  # added to the numbers of a second set of calls, which would pass unseen

# What is refused whatever its arguments, by reasons: (x86_64, arm64); None where it does not exist.
Numbers = dict[str, tuple[int | None, int | None]]
REFUSED: dict[str, Numbers] = {
    "starts or becomes another process": {
        "fork": (57, None),
        "vfork": (58, None),
        "execve": (59, 221),
        "execveat": (322, 281),
        "unshare": (272, 97),
        "setns": (308, 268),
        "setsid": (112, 157),
        "setpgid": (109, 154),
        "chroot": (161, 51),
        "pivot_root": (155, 41),
        "personality": (135, 92),
        "setuid": (105, 146),
        "setgid": (106, 144),
        "setreuid": (113, 145),
        "setregid": (114, 143),
        "setresuid": (117, 147),
        "setresgid": (119, 149),
        "setfsuid": (122, 151),
        "setfsgid": (123, 152),
        "setgroups": (116, 159),
        "capset": (126, 91),
    },
    "looks into other processes, or changes them": {
        "ptrace": (101, 117),
        "process_vm_readv": (310, 270),
        "process_vm_writev": (311, 271),
        "process_madvise": (440, 440),
        "kcmp": (312, 272),
        "pidfd_open": (434, 434),
        "pidfd_getfd": (438, 438),
        "pidfd_send_signal": (424, 424),
        "tkill": (200, 130),
        "rt_sigqueueinfo": (129, 138),
        "rt_tgsigqueueinfo": (297, 240),
        "setpriority": (141, 140),
        "ioprio_set": (251, 30),
        "sched_setaffinity": (203, 122),
        "sched_setscheduler": (144, 119),
        "sched_setparam": (142, 118),
        "sched_setattr": (314, 274),
        "migrate_pages": (256, 238),
        "move_pages": (279, 239),
    },
    "reaches a network, or whoever waits behind a socket": {
        "socket": (41, 198),
        "connect": (42, 203),
        "bind": (49, 200),
        "socketpair": (53, 199),  # files on their way through one are seen by nobody
    },
    "learns the names of files in folders that it must not read": {
        "inotify_init": (253, None),
        "inotify_init1": (294, 26),
        "inotify_add_watch": (254, 27),
    },
    "does what other calls do, unseen by this filter": {
        "io_uring_setup": (425, 425),
        "io_uring_enter": (426, 426),
        "io_uring_register": (427, 427),
    },
    "changes what is mounted": {
        "mount": (165, 40),
        "umount2": (166, 39),
        "open_tree": (428, 428),
        "move_mount": (429, 429),
        "fsopen": (430, 430),
        "fsconfig": (431, 431),
        "fsmount": (432, 432),
        "fspick": (433, 433),
        "mount_setattr": (442, 442),
        "quotactl": (179, 60),
        "quotactl_fd": (443, 443),
        "swapon": (167, 224),
        "swapoff": (168, 225),
    },
    "changes rights, owners, times and attributes of files": {
        "chmod": (90, None),
        "fchmod": (91, 52),
        "fchmodat": (268, 53),
        "chown": (92, None),
        "fchown": (93, 55),
        "lchown": (94, None),
        "fchownat": (260, 54),
        "utime": (132, None),
        "utimes": (235, None),
        "futimesat": (261, None),
        "utimensat": (280, 88),
        "setxattr": (188, 5),
        "lsetxattr": (189, 6),
        "fsetxattr": (190, 7),
        "removexattr": (197, 14),
        "lremovexattr": (198, 15),
        "fremovexattr": (199, 16),
        "mknod": (133, None),
        "mknodat": (259, 33),
        "name_to_handle_at": (303, 264),
        "open_by_handle_at": (304, 265),
        "fanotify_init": (300, 262),
    },
    "keeps memory that outlives the process, or that no limit counts": {
        "shmget": (29, 194),
        "shmat": (30, 196),
        "shmctl": (31, 195),
        "shmdt": (67, 197),
        "msgget": (68, 186),
        "msgsnd": (69, 189),
        "msgrcv": (70, 188),
        "msgctl": (71, 187),
        "semget": (64, 190),
        "semop": (65, 193),
        "semtimedop": (220, 192),
        "semctl": (66, 191),
        "mq_open": (240, 180),
        "mq_unlink": (241, 181),
        "memfd_create": (319, 279),
        "memfd_secret": (447, 447),
        "io_setup": (206, 0),  # of which the whole machine has few
        "landlock_create_ruleset": (444, 444),
        "landlock_add_rule": (445, 445),
        "landlock_restrict_self": (446, 446),
    },
    "lifts a limit, or concerns the whole machine": {
        "setrlimit": (160, 164),
        "bpf": (321, 280),
        "perf_event_open": (298, 241),
        "userfaultfd": (323, 282),
        "add_key": (248, 217),
        "request_key": (249, 218),
        "keyctl": (250, 219),
        "init_module": (175, 105),
        "finit_module": (313, 273),
        "delete_module": (176, 106),
        "kexec_load": (246, 104),
        "kexec_file_load": (320, 294),
        "reboot": (169, 142),
        "settimeofday": (164, 170),
        "clock_settime": (227, 112),
        "adjtimex": (159, 171),
        "clock_adjtime": (305, 266),
        "sethostname": (170, 161),
        "setdomainname": (171, 162),
        "acct": (163, 89),
        "syslog": (103, 116),
        "iopl": (172, None),
        "ioperm": (173, None),
        "vhangup": (153, 58),
        "sync": (162, 81),
        "syncfs": (306, 267),
        "modify_ldt": (154, None),
    },
}
NOT_THERE: Numbers = {
    "clone3": (435, 435)
}  # its arguments cannot be seen; libraries then use clone
# A thread shares all with the process. With a table of open files of its own (not CLONE_FILES) it
# would hold files that nobody counts; 2 is close_range's flag for the same.
CLONE, THREAD = (56, 220), 0x10000
SHARED = (0x100, 0x200, 0x400, 0x800, THREAD)  # CLONE_VM, _FS, _FILES, _SIGHAND, _THREAD
NAMESPACES = 0x7E020080  # CLONE_NEWTIME to CLONE_NEWNET
CLOSE_RANGE, UNSHARE = (436, 436), 2
# Landlock before its third version does not see this one; Python has it as os.truncate().
TRUNCATE: Numbers = {"truncate": (76, 45)}
# Signals are for the process itself: the first argument is its number.
SIGNALS: Numbers = {"kill": (62, 129), "tgkill": (234, 131)}
# Harmless calls that some values of an argument make harmful: (numbers, which argument, values).
VALUES: dict[str, tuple[tuple[int, int], int, tuple[int, ...]]] = {
    # Live on without the parent, adopt its orphans, be looked into or no more; change its own
    # memory's map.
    "prctl": ((157, 167), 0, (1, 36, 0x59616D61, 4, 35)),
    # F_SETOWN, F_SETSIG, F_SETOWN_EX, F_NOTIFY: a signal to another process when a file is ready.
    # F_SETLEASE: others wait who open a file. F_SETPIPE_SZ: root's pipes have no limit.
    "fcntl": ((72, 25), 1, (8, 10, 15, 1026, 1024, 1031)),
    # MADV_HWPOISON, MADV_SOFT_OFFLINE: take memory from the machine, that of others among it.
    "madvise": ((28, 233), 2, (100, 101)),
}
# What ioctl(2) may be asked for. The others set a file's attributes, type into a terminal, or
# freeze, resize and shut down the file system of a file. The second byte of a request names whose
# it is: of Direct Rendering, NVIDIA (0 and F), AMD, buffers and fences that drivers share.
IOCTL = (16, 29)
DRIVERS = tuple(ord(letter) << 8 for letter in "\0FKbd>")
# TCGETS, TIOCGPGRP, TIOCGWINSZ, FIONREAD, FIONBIO, FIONCLEX, FIOCLEX.
HARMLESS = (0x5401, 0x540F, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)
PRLIMIT = (302, 261)  # may ask for limits, but set none: its third argument is 0

# Instructions of BPF.
LOAD = 0x20
EQUAL = 0x15
ANY_BIT = 0x45
AT_LEAST = 0x35
RETURN = 0x06
MASK = 0x54

# What a filter returns.
ALLOW = 0x7FFF0000
FAIL = 0x00050000
KILL = 0x80000000

# Where a filter finds them.
NUMBER = 0
MACHINE = 4
ARGUMENTS = 16


def known_machine() -> bool:
    """Return whether the tables have this machine's numbers."""
    return platform.machine() in MACHINES and sys.maxsize > 2**32 and sys.byteorder == "little"


def restrict(truncates: bool = True) -> None:
    """Refuse this process the calls of the tables, for good; OSError if the kernel refuses.

    Unless it ``truncates``, truncate(2) is refused, too.
    """
    code = _program(os.getpid(), truncates)
    libc = ctypes.CDLL(None, use_errno=True)
    buffer = ctypes.create_string_buffer(code, len(code))
    program = struct.pack("HxxxxxxP", len(code) // 8, ctypes.addressof(buffer))
    for words in ((NO_NEW_PRIVILEGES, 1, 0, 0, 0), (SET_SECCOMP, FILTER, program, 0, 0)):
        if libc.prctl(*words):
            number = ctypes.get_errno()
            raise OSError(number, os.strerror(number))


def _program(process: int, truncates: bool) -> bytes:
    """Return the filter for a process, as instructions of 8 bytes."""
    machine, column = MACHINES[platform.machine()]
    refused, missing = FAIL | errno.EPERM, FAIL | errno.ENOSYS
    code = _load(MACHINE) + _unless(EQUAL, machine, KILL) + _load(NUMBER)
    code += _when(AT_LEAST, X32, refused) + _when(AT_LEAST, NEWEST + 1, missing)
    for number in _column(NOT_THERE, column):
        code += _when(EQUAL, number, missing)
    for calls in (*REFUSED.values(), *(() if truncates else (TRUNCATE,))):
        for number in _column(calls, column):
            code += _when(EQUAL, number, refused)

    code += _by_arguments(column, process, refused)
    return code + _instruction(RETURN, ALLOW)


def _by_arguments(column: int, process: int, refused: int) -> bytes:
    """Return the part of the filter that lets a call pass, or not, by its arguments."""
    code = b""
    for number in _column(SIGNALS, column):
        code += _call(number, _load(_argument(0)) + _unless(EQUAL, process, refused))

    flags = [_unless(ANY_BIT, flag, refused) for flag in SHARED]
    flags.append(_when(ANY_BIT, NAMESPACES, refused))
    code += _call(CLONE[column], _load(_argument(0)) + b"".join(flags))
    unshares = _load(_argument(2)) + _when(ANY_BIT, UNSHARE, refused)
    code += _call(CLOSE_RANGE[column], unshares)
    for numbers, argument, values in VALUES.values():
        looks = [_when(EQUAL, value, refused) for value in values]
        code += _call(numbers[column], _load(_argument(argument)) + b"".join(looks))
    code += _call(IOCTL[column], _of_devices(refused))
    halves = (_load(_argument(2) + half) + _unless(EQUAL, 0, refused) for half in (0, 4))
    return code + _call(PRLIMIT[column], b"".join(halves))


def _of_devices(refused: int) -> bytes:
    """Return the part of the filter that says what may be asked of devices, by ioctl."""
    asked = [_when(EQUAL, value, ALLOW) for value in HARMLESS]
    asked.append(_instruction(MASK, 0xFF00))
    asked += [_when(EQUAL, value, ALLOW) for value in DRIVERS]
    asked.append(_instruction(RETURN, refused))
    return _load(_argument(1)) + b"".join(asked)


def _column(calls: Numbers, column: int) -> list[int]:
    return [number for both in calls.values() if (number := both[column]) is not None]


def _argument(number: int) -> int:
    return ARGUMENTS + 8 * number


def _instruction(kind: int, value: int, then: int = 0, otherwise: int = 0) -> bytes:
    return struct.pack("=HBBI", kind, then, otherwise, value)


def _load(place: int) -> bytes:
    return _instruction(LOAD, place)


def _when(test: int, value: int, answer: int) -> bytes:
    """Answer if a test of the loaded word is true."""
    return _instruction(test, value, 0, 1) + _instruction(RETURN, answer)


def _unless(test: int, value: int, answer: int) -> bytes:
    """Answer if a test of the loaded word is false."""
    return _instruction(test, value, 1, 0) + _instruction(RETURN, answer)


def _call(number: int, body: bytes) -> bytes:
    """Do what looks at the arguments of a call, and allow it where that does not answer."""
    body += _instruction(RETURN, ALLOW)
    return _instruction(EQUAL, number, 0, len(body) // 8) + body
