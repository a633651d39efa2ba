#!/usr/bin/env bash
# Whether the workspace compiles for 64-bit ARM, where rustup has no standard library for it: with the compiler and the sources of the standard
# library that Debian ships for its browsers. Packages are unpacked beside the build, none is installed.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=aarch64-unknown-linux-gnu
if rustc --print target-libdir --target "$target" 2>/dev/null | xargs -r test -d; then
    exec cargo check --workspace --exclude gonio-python --target "$target"
fi
tools=$PWD/target/cross-tools
if [ ! -x "$tools/usr/bin/rustc" ]; then
    mkdir -p "$tools/packages"
    # The newest version that has the sources of its standard library beside it.
    version=$(apt-cache madison rust-web-src | awk 'NR == 1 { print $3 }')
    library=libstd-rust-web-$(echo "$version" | grep -o '^[0-9]*[.][0-9]*')
    llvm=$(apt-cache show "$library=$version" | grep -o -m 1 'libllvm[0-9]*')
    (cd "$tools/packages" && apt-get download -q "rustc-web=$version" "libstd-rust-web-dev=$version" "rust-web-src=$version" "$library=$version" "$llvm")
    for package in "$tools"/packages/*.deb; do dpkg -x "$package" "$tools"; done
fi
libraries=$(dirname "$(find "$tools/usr/lib" -name 'librustc_driver*' | head -n 1)")
LD_LIBRARY_PATH=$libraries RUSTC=$tools/usr/bin/rustc RUSTC_BOOTSTRAP=1 \
    cargo check --workspace --exclude gonio-python -Zbuild-std=std,panic_abort --target "$target" --target-dir target/cross
