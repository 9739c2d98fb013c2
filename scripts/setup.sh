#!/usr/bin/env bash
# Installs what a make target needs. Prints nothing if there is nothing to do.
#
#   scripts/setup.sh demo     .venv with the package, and an OpenGL library
#   scripts/setup.sh studio   the same, and the dependencies of the asset generator
#   scripts/setup.sh test     all of these, and a virtual display for the window tests
#   scripts/setup.sh lint     .venv-lint with the linters
#   scripts/setup.sh docs     the package, an OpenGL library, and what builds the site
#   scripts/setup.sh docs-check   the same, and a browser
#   scripts/setup.sh screen   installs nothing: status 0 if a window can be opened, 1 if not
#
# PYTHON selects the interpreter. System packages are installed only with apt-get, as root or with
# sudo if it needs no password. Status 3 means that OpenGL is missing, as in the program itself.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf 'setup: %s\n' "$*" >&2; }
die() {
    local status=$1
    shift
    say "$@"
    exit "$status"
}

# Run a command without output; if it fails, show the end of its output.
quietly() {
    local log
    log=$(mktemp)
    if ! "$@" >"$log" 2>&1 </dev/null; then
        tail -n 25 "$log" >&2
        rm -f "$log"
        return 1
    fi
    rm -f "$log"
}

# --- system packages ---------------------------------------------------------------------------

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo -n "$@"; fi; }

may_install() {
    command -v apt-get >/dev/null || return 1
    [ "$(id -u)" -eq 0 ] || { command -v sudo >/dev/null && sudo -n true 2>/dev/null; }
}

listed_packages() { sed -e 's/#.*//' -e '/:/d' system-packages.txt | xargs; }
packages_for() { sed -n -e "s/^$1: *//p" system-packages.txt | xargs; }

# Print instructions for installing the packages by hand.
how_to_install() {
    local package known=()
    if ! command -v apt-get >/dev/null; then
        echo "Install the equivalents of these Debian packages: $(listed_packages)"
        return
    fi
    for package in $(listed_packages); do
        apt_knows "$package" && known+=("$package")
    done
    echo "Run: sudo apt-get install ${known[*]:-$(listed_packages)}"
}

# A package that only others refer to is shown, but cannot be installed.
# The answer is read whole: after `grep -q` has ended, apt-cache can no longer write, and with pipefail
# its failure would count: each package that is listed twice would be unknown.
apt_knows() { [[ $(LC_ALL=C apt-cache policy "$1" 2>/dev/null) =~ Candidate:\ [^\(] ]]; }

# Install the given packages, except those that apt does not know on this system.
apt_install() {
    local package known=() unknown=()
    quietly as_root apt-get update -q || say "apt-get update failed; trying with the existing package lists"
    for package in "$@"; do
        if apt_knows "$package"; then
            known+=("$package")
        else
            unknown+=("$package")
        fi
    done
    [ ${#unknown[@]} -eq 0 ] || say "skipping packages unknown to apt: ${unknown[*]}"
    [ ${#known[@]} -gt 0 ] || return 1
    say "installing ${known[*]} (apt-get)"
    apt_get_install "${known[@]}" && return
    # One that cannot be installed, as a former package of a newer Mesa, must not stop the others.
    say "installing them one by one"
    local missing=0
    for package in "${known[@]}"; do
        apt_get_install "$package" || missing=1
    done
    return $missing
}

apt_get_install() {
    quietly as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -q -y --no-install-recommends "$@"
}

# --- Python ------------------------------------------------------------------------------------

new_enough() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; }

# Print the first Python 3.11 or newer, if there is one.
first_python() {
    local candidate
    for candidate in python3 python3.14 python3.13 python3.12 python3.11; do
        if new_enough "$candidate"; then
            printf '%s\n' "$candidate"
            return
        fi
    done
    return 1
}

# Print a Python 3.11 or newer, installed if there is none. If PYTHON is set, no other is tried.
find_python() {
    if [ -n "${PYTHON:-}" ]; then
        new_enough "$PYTHON" || die 1 "PYTHON=$PYTHON is not Python 3.11 or newer"
        printf '%s\n' "$PYTHON"
        return
    fi
    first_python && return
    if may_install; then apt_install python3 python3-venv || true; fi
    first_python || die 1 "Python 3.11 or newer is required; python3 is" \
        "$(python3 --version 2>/dev/null || echo "not installed")." \
        "Install it (Debian 12, Ubuntu 24.04 and newer: apt-get install python3 python3-venv;" \
        "others: https://www.python.org/downloads/), or set make PYTHON=/path/to/python3"
}

can_make_venv() { "$1" -c 'import ensurepip, venv' 2>/dev/null; }

have_venv() {
    [ "$(cat "$1/.folder" 2>/dev/null)" = "$PWD" ] && "$1/bin/python" -m pip -V >/dev/null 2>&1
}

# Make a virtual environment in a folder, and note where that is: after its checkout was moved it
# does not work.
make_venv() {
    local folder=$1 python version
    python=$(find_python)
    if ! can_make_venv "$python"; then
        version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
        if may_install; then apt_install python3-venv "python$version-venv" || true; fi
        can_make_venv "$python" || die 1 "$python cannot create a virtual environment:" \
            "the module venv or ensurepip is missing." \
            "On Debian and Ubuntu: sudo apt-get install python$version-venv"
    fi
    say "creating $folder with $("$python" --version)"
    quietly "$python" -m venv --clear "$folder" || die 1 "$python -m venv failed"
    printf '%s\n' "$PWD" >"$folder/.folder"
}

# Install the package with the given extras; repeat only when pyproject.toml changes.
install_package() {
    local extras=$1 stamp=.venv/.installed now
    now="$PWD $(cat pyproject.toml framelens/pyproject.toml | cksum)"
    if [ -x .venv/bin/landscape ] && [ -x .venv/bin/framelens ] && [ "$(head -n 1 "$stamp" 2>/dev/null)" = "$now" ]; then
        case " $(tail -n 1 "$stamp") " in *" $extras "*) return ;; esac
    fi
    have_venv .venv || make_venv .venv
    local target=.
    [ "$extras" = package ] || target=".[$extras]"
    say "installing $target into .venv (pip; the first time takes a minute or two)"
    # The distribution's name until version 0.1.
    quietly .venv/bin/python -m pip uninstall -q -y landscape
    # Python compiles a module when it is first imported: most of these never are.
    quietly .venv/bin/python -m pip install -q --no-compile --disable-pip-version-check \
        -e ./framelens -e "$target" ||
        die 1 "pip could not install $target; is the network available?"
    # Record the extras that are included in this one.
    case $extras in
        dev) extras="package studio dev" ;;
        studio | site) extras="package $extras" ;;
    esac
    [ "$(head -n 1 "$stamp" 2>/dev/null)" != "$now" ] || extras+=" $(tail -n 1 "$stamp")"
    printf '%s\n%s\n' "$now" "$extras" >"$stamp"
}

# Install the linters, which read the types of no other versions than those listed: another version
# may report what these did not.
install_linters() {
    local stamp=.venv-lint/.installed now
    now="$PWD $(cksum <requirements-lint.txt)"
    [ "$(cat "$stamp" 2>/dev/null)" != "$now" ] || return 0
    make_venv .venv-lint
    say "installing the linters into .venv-lint"
    quietly .venv-lint/bin/python -m pip install -q --disable-pip-version-check --no-deps \
        -r requirements-lint.txt || die 1 "pip could not install the linters; is the network available?"
    printf '%s\n' "$now" >"$stamp"
}

# --- OpenGL ------------------------------------------------------------------------------------

# Succeed if this machine can render without a display, through OSMesa or surfaceless EGL.
have_opengl() {
    .venv/bin/python - 2>/dev/null <<'PYTHON'
import ctypes, sys

def load(*names):
    for name in names:
        try:
            return ctypes.CDLL(name)
        except OSError:
            pass

def surfaceless():
    egl = load("libEGL.so.1")
    if not egl or not load("libGL.so.1", "libOpenGL.so.0"):
        return False
    egl.eglGetPlatformDisplay.restype = ctypes.c_void_p
    egl.eglGetPlatformDisplay.argtypes = [ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p]
    egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
    EGL_PLATFORM_SURFACELESS_MESA = 0x31DD
    display = egl.eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, None, None)
    return bool(display) and egl.eglInitialize(display, None, None) == 1

sys.exit(not (load("libOSMesa.so.8", "libOSMesa.so.6") or surfaceless()))
PYTHON
}

have_window_library() {
    .venv/bin/python -c 'import ctypes; ctypes.CDLL("libGL.so.1")' 2>/dev/null
}

has_library() {
    .venv/bin/python -c 'import sys; from framelens.gl.libraries import load; load(sys.argv[1])' "$1" \
        2>/dev/null
}

# Install missing system packages. OpenGL is required. The library for windows and Xvfb are optional:
# one attempt is made to install them, and if that is not possible, one line says so.
check_system() {
    local purpose=$1 optional=() tried
    [ "$(uname -s)" = Linux ] || return 0
    tried=.venv/.system-$purpose-$(cksum <system-packages.txt | cut -d ' ' -f 1)
    if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || [ "$purpose" = test ]; then
        have_window_library || optional+=(libGL.so.1)
    fi
    if [ "$purpose" = test ]; then
        command -v Xvfb >/dev/null || optional+=(Xvfb)
        has_library glut || optional+=(freeglut)
    fi
    if have_opengl && { [ ${#optional[@]} -eq 0 ] || [ -e "$tried" ]; }; then
        return
    fi
    # shellcheck disable=SC2046  # word splitting is intended: one word per package
    if may_install; then
        apt_install $(listed_packages) || say "apt-get failed"
    fi
    have_opengl || die 3 "found no OpenGL library for offscreen rendering (OSMesa or EGL)." \
        "$(how_to_install)"
    if may_install; then
        : >"$tried"
    elif [ ${#optional[@]} -gt 0 ]; then
        say "missing: ${optional[*]}; features that need it are disabled. $(how_to_install)"
    fi
}

# --- screen ------------------------------------------------------------------------------------

can_open_window() {
    [ -z "${CI:-}" ] || return 1
    # Only on Linux does a variable name the display.
    [ "$(uname -s)" != Linux ] || [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || return 1
    .venv/bin/python - >/dev/null 2>&1 <<'PYTHON'
import signal, sys

signal.alarm(20)  # do not wait for a display that does not answer
import glfw

glfw.ERROR_REPORTING = False
if not glfw.init():
    sys.exit(1)
glfw.window_hint(glfw.VISIBLE, False)
window = glfw.create_window(64, 64, "landscape", None, None)
glfw.terminate()
sys.exit(not window)
PYTHON
}

case ${1:-} in
    demo)
        install_package package
        check_system demo
        ;;
    studio)
        install_package studio
        check_system demo
        ;;
    test)
        install_package dev
        check_system test
        ;;
    lint) install_linters ;;
    docs)
        install_package site
        check_system demo
        ;;
    docs-check)
        install_package site
        command -v chromium >/dev/null || may_install || die 1 "missing: chromium"
        # shellcheck disable=SC2046  # one word per package
        command -v chromium >/dev/null || apt_install $(packages_for docs-check)
        ;;
    screen) can_open_window ;;
    *) die 2 "usage: scripts/setup.sh demo|studio|test|lint|docs|docs-check|screen" ;;
esac
