"""The C library's complex functions for numpy on Wine, which has none of them.

numpy's imports of the C library's mathematics are pointed to a library with a name of the same
length. It computes the complex functions by MinGW's library, and forwards all others to Wine's.
"""

import re
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

OLD, NEW = b"api-ms-win-crt-math-l1-1-0.dll", b"app-my-win-crt-math-l1-1-0.dll"
COMPILER, LISTER = "x86_64-w64-mingw32-gcc", "x86_64-w64-mingw32-objdump"

# Real results, then complex ones of one argument.
REAL = ("creal", "cimag", "cabs", "carg")
COMPLEX = (
    *("cacos", "casin", "catan", "ccosh", "csinh", "ctanh", "cexp", "clog", "csqrt"),
    *("csin", "ccos", "ctan", "cacosh", "casinh", "catanh"),
)

# Windows passes a complex number as a structure of two numbers.
HEAD = """
#include <complex.h>

#define TYPES(TYPE, NAME) \\
    typedef struct { TYPE real, imaginary; } NAME; \\
    static TYPE complex from_##NAME(NAME given) \\
    { \\
        TYPE complex result; \\
        __real__ result = given.real; \\
        __imag__ result = given.imaginary; \\
        return result; \\
    } \\
    static NAME to_##NAME(TYPE complex given) \\
    { \\
        NAME result = {__real__ given, __imag__ given}; \\
        return result; \\
    }
TYPES(double, Double)
TYPES(float, Float)

#define REAL(FUNCTION) \\
    double my_##FUNCTION(Double z) { return FUNCTION(from_Double(z)); } \\
    double my_##FUNCTION##l(Double z) { return FUNCTION(from_Double(z)); } \\
    float my_##FUNCTION##f(Float z) { return FUNCTION##f(from_Float(z)); }
#define COMPLEX(FUNCTION) \\
    Double my_##FUNCTION(Double z) { return to_Double(FUNCTION(from_Double(z))); } \\
    Double my_##FUNCTION##l(Double z) { return to_Double(FUNCTION(from_Double(z))); } \\
    Float my_##FUNCTION##f(Float z) { return to_Float(FUNCTION##f(from_Float(z))); }

Double my_cpow(Double a, Double b) { return to_Double(cpow(from_Double(a), from_Double(b))); }
Double my_cpowl(Double a, Double b) { return my_cpow(a, b); }
Float my_cpowf(Float a, Float b) { return to_Float(cpowf(from_Float(a), from_Float(b))); }
"""


def add(python: Path) -> None:
    """Give numpy in a Windows Python the functions; ``python`` is its folder."""
    needed: set[str] = set()
    for path in sorted(python.rglob("numpy*/**/*.pyd")) + sorted(python.rglob("numpy.libs/*.dll")):
        data = path.read_bytes()
        if OLD in data:
            path.write_bytes(data.replace(OLD, NEW))
        if OLD in data or NEW in data:
            needed.update(_imported(path))
    ours = [f"{name}{kind}" for name in (*REAL, *COMPLEX, "cpow") for kind in ("", "l", "f")]
    lines = [f"  {name} = my_{name}" for name in ours]
    lines += [f"  {name} = ucrtbase.{name}" for name in sorted(needed.difference(ours))]
    code = HEAD + "\n".join(
        [*(f"REAL({name})" for name in REAL), *(f"COMPLEX({name})" for name in COMPLEX), ""]
    )
    library(python / NEW.decode(), lines, code)


def library(path: Path, exports: list[str], code: str = "int unused;\n") -> None:
    """Compile C code into a Windows library; each export is a line of its definition file."""
    with tempfile.TemporaryDirectory() as folder:
        source, definition = Path(folder, "code.c"), Path(folder, "code.def")
        source.write_text(code)
        definition.write_text("\n".join([f"LIBRARY {path.name}", "EXPORTS", *exports, ""]))
        command = [COMPILER, "-shared", "-O1", "-w", "-static-libgcc", source, definition]
        subprocess.run([*map(str, command), "-o", str(path)], check=True)


def _imported(path: Path) -> Iterator[str]:
    """Yield the functions that a library takes from NEW."""
    within = False
    for line in listing(path).splitlines():
        if "DLL Name:" in line:
            within = NEW.decode() in line
        elif within and (row := re.match(r"\s+[0-9a-f]+\s.*?([A-Za-z_]\w*)\s*$", line)):
            yield row[1]


def listing(path: Path) -> str:
    """Return what objdump says of a Windows library's imports and exports."""
    done = subprocess.run([LISTER, "-p", str(path)], capture_output=True, text=True, check=True)
    return done.stdout
