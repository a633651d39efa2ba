#!/usr/bin/env bash
# LLVM's linker for macOS, which rustup brings along, for what speaks to it as to a compiler: maturin's `-Wl,OPTION,VALUE` becomes `OPTION VALUE`.
for argument; do
    case $argument in
        -Wl,*) IFS=, read -ra words <<<"${argument#-Wl,}" ;;
        *) words=("$argument") ;;
    esac
    arguments+=("${words[@]}")
done
exec rust-lld "${arguments[@]}"
