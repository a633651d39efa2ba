#!/usr/bin/env bash
# LLVM's linker for macOS, which rustup brings along, for what speaks to it as to a compiler: maturin's `-Wl,OPTION,VALUE` becomes `OPTION VALUE`.
# What Python calls is exported alone: Rust's list also has what the crates inside export to C.
while [ $# -gt 0 ]; do
    case $1 in
        -Wl,*) IFS=, read -ra words <<<"${1#-Wl,}" && arguments+=("${words[@]}") ;;
        -exported_symbols_list) shift ;;
        *) arguments+=("$1") ;;
    esac
    shift
done
exec rust-lld "${arguments[@]}" -exported_symbol _PyInit__gonio
