#!/usr/bin/env bash
# The NEON level on this machine, in an emulator of 64-bit ARM: the tests of gonio-simd, and a picture beside the one of this machine's own level.
# `arm.sh tests` runs the tests alone; `arm.sh wheel` instead tries the wheel in dist/wheels, by Debian's Python for ARM.
# Nothing here is measured: an emulator's speed tells nothing of a processor's.
source "$(dirname "$0")/tools.sh"
target=aarch64-unknown-linux-gnu
python_tools
unpack qemu-user-static libc6-arm64-cross
emulator="$tools/usr/bin/qemu-aarch64-static -L $tools/usr/aarch64-linux-gnu"
python=${GONIO_PYTHON:-.venv/bin/python}

# Debian's Python for ARM, as packages that are unpacked, not installed, by lists of packages of its own.
arm_python() {
    local root=$tools/arm options
    [ ! -e "$root/ready" ] || return 0
    mkdir -p "$root/lists/partial" "$root/cache/archives/partial" "$root/new"
    options=(-q -o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o "Dir::State::lists=$root/lists" -o "Dir::Cache=$root/cache"
        -o Dir::State::status=/dev/null)
    apt-get "${options[@]}" update
    (cd "$root/new" && apt-get "${options[@]}" download python3.11-minimal libpython3.11-minimal libpython3.11-stdlib libc6 libgcc-s1 \
        zlib1g libexpat1 libssl3 libffi8 libbz2-1.0 liblzma5 libcrypt1)
    for package in "$root"/new/*.deb; do dpkg -x "$package" "$root"; done
    rm -r "$root/new"
    touch "$root/ready"
}

if [ "${1:-}" = wheel ]; then
    arm_python
    rm -rf "$tools/arm/site"
    "$python" -m zipfile -e dist/wheels/*_aarch64.whl "$tools/arm/site"
    library=$tools/arm/usr/lib/python3.11
    run="$tools/usr/bin/qemu-aarch64-static -L $tools/arm -E PYTHONPATH=$tools/arm/site:$library:$library/lib-dynload"
    for level in neon scalar; do
        $run -E GONIO_SIMD=$level -E GONIO_SMOKE=1 "$tools/arm/usr/bin/python3.11" -S tests/cross/smoke.py
    done
    "$python" tests/cross/picture.py --emulated "$run $tools/arm/usr/bin/python3.11 -S tests/cross/bundle_picture.py" --output out/arm
    exit
fi
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER=$emulator

# What builds trees uses no lanes, and takes minutes there.
cross $target cargo-zigbuild test --profile quick --quiet -p gonio-simd -p gonio-accel --lib --tests -- --skip tests::building
[ "${1:-}" != tests ] || exit 0

cross $target cargo-zigbuild zigbuild --profile quick --quiet -p gonio --example bundle_picture
program=target/cross/$target/quick/examples/bundle_picture
"$python" tests/cross/picture.py --emulated "$emulator $program" --output out/arm
