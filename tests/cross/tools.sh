# Sourced by the scripts beside it: compilers for other systems, with what the usual package registries have. Packages are unpacked beside the
# build, in target/cross-tools; none is installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tools=$PWD/target/cross-tools
# rustup's programs that link and strip for macOS, which Debian's compiler does not bring.
PATH=$PATH:$(dirname "$(rustc --print target-libdir)")/bin

# Unpacks Debian packages that are not there yet: `unpack NAME=VERSION ...`; the first one's name marks them.
unpack() {
    local mark=$tools/packages/${1%%=*}.unpacked package
    if [ ! -e "$mark" ]; then
        mkdir -p "$tools/packages/new"
        (cd "$tools/packages/new" && apt-get download -q "$@")
        for package in "$tools"/packages/new/*.deb; do dpkg -x "$package" "$tools"; done
        rm -r "$tools/packages/new"
        touch "$mark"
    fi
}

# The module's stable interface is the same everywhere, so no Python of the other system is asked.
export PYO3_NO_PYTHON=1
unset PYO3_PYTHON

# Rust's name of a system that Blender runs on, by Blender's.
target_of() {
    case $1 in
        linux-x64) echo x86_64-unknown-linux-gnu ;;
        linux-arm64) echo aarch64-unknown-linux-gnu ;;
        macos-arm64) echo aarch64-apple-darwin ;;
        macos-x64) echo x86_64-apple-darwin ;;
        windows-x64) echo x86_64-pc-windows-gnu ;;
        *) echo "no recipe for $1" >&2 && return 1 ;;
    esac
}

# Whether rustup has the standard library of a target.
has_library() {
    rustc --print target-libdir --target "$1" 2>/dev/null | xargs -r test -d
}

# `cross TARGET PROGRAM COMMAND ...`: cargo, or what hands its options on to cargo, for a target. Where rustup has no standard library for it, the library
# is built from its sources, by the compiler that Debian ships for its browsers.
cross() {
    local target=$1 program=$2 command=$3
    shift 3
    if has_library "$target"; then
        "$program" "$command" --target "$target" --target-dir target/cross "$@"
        return
    fi
    if [ ! -e "$tools/packages/rustc-web.unpacked" ]; then
        # The newest version that has the sources of its standard library beside it.
        local version library llvm
        version=$(apt-cache madison rust-web-src | awk 'NR == 1 { print $3 }')
        library=libstd-rust-web-$(echo "$version" | grep -o '^[0-9]*[.][0-9]*')
        llvm=$(apt-cache show "$library=$version" | grep -o -m 1 'libllvm[0-9]*')
        unpack "rustc-web=$version" "libstd-rust-web-dev=$version" "rust-web-src=$version" "$library=$version" "$llvm"
    fi
    # The standard library of Windows names what it takes from the system by itself, for which the compiler calls this tool.
    case $target in
        *-windows-gnu) unpack binutils-mingw-w64-x86-64 && PATH=$PATH:$tools/usr/bin ;;
    esac
    local libraries
    libraries=$(dirname "$(find "$tools/usr/lib" -name 'librustc_driver*' | head -n 1)")
    LD_LIBRARY_PATH=$libraries RUSTC=$tools/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_PROFILE_RELEASE_STRIP=none \
        "$program" "$command" -Zbuild-std=std,panic_abort --target "$target" --target-dir target/cross "$@"
}

# zig, a linker for every system, what hands it to cargo, and what looks into the modules that come out.
python_tools() {
    if [ ! -e "$tools/python/ready" ]; then
        "${PYTHON:-python3}" -m venv "$tools/python"
        "$tools/python/bin/python" -m pip install --quiet ziglang cargo-zigbuild 'maturin>=1.9,<2' lief==1.0.0 abi3info==2026.9.25
        touch "$tools/python/ready"
    fi
    export PATH=$tools/python/bin:$PATH
}
