"""A process that gives up all that somebody else's program does not need, by the system's means.

On Linux that is Landlock for files and a filter of system calls (seccomp) for the rest, both of
which need no right and hold for root, too, who also gives up most capabilities. Elsewhere there is
nothing of the kind that a process could do to itself.
"""

import errno
import sys
from collections.abc import Iterable

if sys.platform == "linux":
    from framelens.system import capabilities, landlock, seccomp

# Where programs and libraries are, and what they need of the system. Of /usr and /opt not all: what
# else lies there is somebody's.
SYSTEM = (
    *("/lib", "/lib32", "/lib64", "/bin", "/sbin", "/nix/store", "/gnu/store"),
    *(f"/usr/{each}" for each in ("bin", "sbin", "lib", "lib32", "lib64", "libexec", "share")),
    *(f"/usr/local/{each}" for each in ("bin", "sbin", "lib", "lib32", "lib64", "share")),
    *("/opt/amdgpu", "/opt/amdgpu-pro", "/opt/VirtualGL"),
    *("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d", "/etc/alternatives"),
    *("/etc/localtime", "/etc/fonts", "/etc/drirc", "/etc/glvnd", "/etc/OpenCL", "/etc/vulkan"),
    *("/proc/cpuinfo", "/proc/meminfo", "/proc/stat", "/proc/filesystems"),
    *("/proc/version", "/proc/driver", "/proc/sys/kernel/random", "/proc/sys/vm"),
    *("/sys/devices/system", "/sys/class/drm", "/sys/dev/char", "/sys/bus/pci", "/sys/devices/pci"),
)
DEVICES = (
    *("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom", "/dev/dri"),
    *("/dev/nvidiactl", "/dev/nvidia-modeset", "/dev/nvidia-uvm"),
    *(f"/dev/nvidia{number}" for number in range(8)),
)


def possible() -> bool:
    """Return whether :func:`confine` may work here."""
    if sys.platform == "linux":
        return landlock.version() > 0 and seccomp.known_machine()
    return False


def confine(readable: Iterable[str], listed: Iterable[str], writable: Iterable[str]) -> None:
    """Leave this process the files that are named, itself, and nothing else.

    SYSTEM names what programs need in any case. Of folders that are ``listed`` only the names are
    to be seen; each of the others stands for all that is in it. From then on there is no other
    process, no network, no right to change, and none of this can be taken back. OSError if the
    system cannot do it; then some of it may hold.
    """
    if sys.platform == "linux":
        rules = [(path, landlock.READING) for path in ("/proc/self", *readable)]
        rules += [(path, landlock.LISTING) for path in listed]
        rules += [(path, landlock.WRITING) for path in writable]
        rules += [(path, landlock.DEVICE) for path in DEVICES]
        landlock.restrict(rules)
        capabilities.drop()
        seccomp.restrict(truncates=landlock.version() >= landlock.SEES_TRUNCATE)
    else:
        raise OSError(errno.ENOSYS, "this system has nothing of the kind")
