#!/usr/bin/env bash
# The NEON level on this machine, in an emulator of 64-bit ARM: the tests of gonio-simd, and a picture beside the one of this machine's own level.
# `arm.sh tests` runs the tests alone. Nothing here is measured: an emulator's speed tells nothing of a processor's.
source "$(dirname "$0")/tools.sh"
target=aarch64-unknown-linux-gnu
python_tools
unpack qemu-user-static libc6-arm64-cross
emulator="$tools/usr/bin/qemu-aarch64-static -L $tools/usr/aarch64-linux-gnu"
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER=$emulator

# What builds trees uses no lanes, and takes minutes there.
cross $target cargo-zigbuild test --profile quick --quiet -p gonio-simd -p gonio-accel --lib --tests -- --skip tests::building
[ "${1:-}" != tests ] || exit 0

cross $target cargo-zigbuild zigbuild --profile quick --quiet -p gonio --example bundle_picture
program=target/cross/$target/quick/examples/bundle_picture
"${GONIO_PYTHON:-.venv/bin/python}" tests/cross/picture.py --emulated "$emulator $program" --output out/arm
