#!/usr/bin/env bash
# Whether the workspace compiles for the systems that this one is not: `check.sh [SYSTEM ...]`, all three without.
source "$(dirname "$0")/tools.sh"
[ $# -gt 0 ] || set -- linux-arm64 macos-arm64 windows-x64
for system; do
    echo "$system"
    cross "$(target_of "$system")" cargo check --workspace
done
