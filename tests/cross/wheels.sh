#!/usr/bin/env bash
# Wheels and Blender extensions for every system, built on this one, and what is in them: `wheels.sh [SYSTEM ...]`, all four without. PROFILE=quick
# is a trial that takes less time. Where GONIO_BPY names a Python that has Blender, Blender's own tool validates and packs the extensions.
#
# What is built for macOS cannot be run here, and for Windows in Wine alone (wine.sh): the release workflow builds each on its own system, and tries it
# there.
source "$(dirname "$0")/tools.sh"
[ $# -gt 0 ] || set -- linux-x64 linux-arm64 macos-arm64 windows-x64
python_tools
export MACOSX_DEPLOYMENT_TARGET=11.0
mkdir -p dist/wheels

# What LLVM's linker asks for macOS' libraries: zig's list of what they hold, for processors that it has names for. Rust names libiconv too, and takes
# nothing from it.
apple_libraries() {
    local folder=$tools/apple/usr/lib
    mkdir -p "$folder"
    sed 's/arm64e[.]x1/arm64/g' "$tools"/python/lib/python3*/site-packages/ziglang/lib/libc/darwin/libSystem.tbd >"$folder/libSystem.tbd"
    for library in libc libm; do ln -sf libSystem.tbd "$folder/$library.tbd"; done
    cp tests/cross/libiconv.tbd "$folder"
    export SDKROOT=$tools/apple
}

# Debian's compiler asks for two libraries that guard C's stacks, which zig lacks and nothing here uses.
empty_libraries() {
    mkdir -p "$tools/empty"
    for library in ssp ssp_nonshared; do printf '!<arch>\n' >"$tools/empty/lib$library.a"; done
}

for system; do
    echo "$system"
    target=$(target_of "$system")
    new=$(mktemp -d)
    options=(build --profile "${PROFILE:-release}" --quiet --out "$new")
    case $system in
        linux-*) options+=(--zig --compatibility manylinux_2_28) ;;
        macos-*)
            # zig's linker would export every symbol: it reads no list of exports there.
            apple_libraries
            options+=(--compatibility pypi -- -C linker-flavor=ld64.lld -C "linker=$PWD/tests/cross/ld64.sh" -C link-arg=-dead_strip_dylibs)
            ;;
        windows-*)
            empty_libraries
            options+=(--zig --compatibility pypi -- -C "link-arg=-L$tools/empty")
            ;;
    esac
    cross "$target" maturin "${options[@]}"
    "${GONIO_BPY:-$tools/python/bin/python}" blender-addon/build.py "$new"/*.whl --output-dir dist
    mv "$new"/*.whl dist/wheels
    rmdir "$new"
done
"$tools/python/bin/python" tests/cross/contents.py dist/wheels/*.whl dist/*.zip
