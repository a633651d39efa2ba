#!/usr/bin/env bash
# The wheel for Windows in dist/wheels, tried in Wine by Python for Windows: `tests/cross/smoke.py` at every level that this machine has, and the
# office at each beside the picture of this machine's own level. `wine.sh python ARGUMENT ...` runs that Python alone.
# Wine is not Windows: the release workflow tries its wheel there. Needs Wine (`apt-get install wine64`), of 64 bits alone.
source "$(dirname "$0")/tools.sh"
# Python finds no standard streams in Wine where they are files.
exec </dev/null > >(cat) 2>&1
python_tools
windows=$tools/windows
python=${GONIO_PYTHON:-.venv/bin/python}
export WINEPREFIX=$tools/wine WINEDEBUG=${WINEDEBUG:--all} WINEDLLOVERRIDES=mscoree,mshtml=
wine=$(command -v wine64 || command -v wine || echo /usr/lib/wine/wine64)

# A library or a program of machine code that is at hand: `link OUTPUT DEFINITIONS OPTION ...`.
link() {
    "$tools/usr/bin/x86_64-w64-mingw32-ld" -o "$windows/$1" "${@:2}"
}

# What Python for Windows takes from a library of the system, for the linker: `imports NAME FUNCTION ...`.
imports() {
    printf 'LIBRARY %s.dll\nEXPORTS\n' "$1" >"$windows/$1.def"
    printf '%s\n' "${@:2}" >>"$windows/$1.def"
    "$tools/usr/bin/x86_64-w64-mingw32-dlltool" --as "$tools/usr/bin/x86_64-w64-mingw32-as" -d "$windows/$1.def" -l "$windows/$1.a"
}

# Python for Windows of the version that runs here. No registry of this recipe has it as a package of its own, but Panda3D brings it along for the
# programs that are made with it: Python's library with the foundation's signature, without the program and without python3.dll.
windows_python() {
    [ ! -e "$windows/ready" ] || return 0
    unpack binutils-mingw-w64-x86-64
    rm -rf "$windows" && mkdir -p "$windows/new"
    local version
    version=$("$tools/python/bin/python" -c 'import sys; print("{}.{}".format(*sys.version_info))')
    "$tools/python/bin/python" -m pip download --quiet --no-deps --only-binary :all: --platform win_amd64 --python-version "$version" \
        --dest "$windows/new" panda3d
    "$tools/python/bin/python" tests/cross/windows_python.py "$windows/new"/panda3d-*.whl "$windows"
    rm -r "$windows/new"

    imports "python${version/./}" Py_Main
    imports kernel32 GetCommandLineW ExitProcess
    imports shell32 CommandLineToArgvW
    "$tools/python/bin/python" -m ziglang cc -target x86_64-windows-gnu -O1 -c tests/cross/windows_python.c -o "$windows/python.o"
    link python.exe --subsystem console -e start "$windows/python.o" "$windows"/*.a
    # Both hand on what they are asked for: the stable interface to this version's library, random bytes, which Rust wants and Wine has since 8.13
    # alone, to where older systems have them.
    link python3.dll -shared -e 0 "$windows/python3.def"
    printf 'LIBRARY bcryptprimitives.dll\nEXPORTS\nProcessPrng = advapi32.SystemFunction036\n' >"$windows/bcryptprimitives.def"
    link bcryptprimitives.dll -shared -e 0 "$windows/bcryptprimitives.def"
    # The part of the standard library that is Python itself is the same on every system; what is installed beside it is this one's.
    mkdir "$windows/Lib"
    ln -s "$("$tools/python/bin/python" -c 'import sysconfig; print(sysconfig.get_path("stdlib"))')"/* "$windows/Lib"
    rm -f "$windows/Lib/site-packages"
    touch "$windows/ready"
}

# Wine's folder, of a Windows that Rust and Python still run on.
wine_folder() {
    if [ ! -e "$WINEPREFIX/ready" ]; then
        "$wine" wineboot --init
        "$wine" reg add 'HKCU\Software\Wine' /v Version /d win10 /f
        touch "$WINEPREFIX/ready"
    fi
}

windows_python
wine_folder
export PYTHONPATH=Z:$windows/site PYTHONDONTWRITEBYTECODE=1
if [ "${1:-}" = python ]; then
    "$wine" "$windows/python.exe" "${@:2}"
    exit
fi
rm -rf "$windows/site"
"$tools/python/bin/python" -m zipfile -e dist/wheels/*-win_amd64.whl "$windows/site"
levels=$("$wine" "$windows/python.exe" tests/cross/smoke.py | tee /dev/stderr | sed -n 's/^[0-9]* levels: //p' | tr -d ',\r')
# shellcheck disable=SC2086
env -u PYTHONPATH "$python" tests/cross/picture.py --levels $levels --output out/windows \
    --emulated "env PYTHONPATH=$PYTHONPATH $wine $windows/python.exe tests/cross/bundle_picture.py"
