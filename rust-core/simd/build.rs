//! Tells the library which SIMD level to build alone, where the feature `own-level` asks for that.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(only_level, values(none(), \"avx512\", \"avx2\", \"sse4.2\"))");
    // A machine can tell its own level alone.
    if env::var_os("CARGO_FEATURE_OWN_LEVEL").is_some() && env::var("TARGET") == env::var("HOST") {
        own_level();
    }
}

#[cfg(target_arch = "x86_64")]
fn own_level() {
    let level = match fearless_simd::Level::new() {
        fearless_simd::Level::Avx512(_) => "avx512",
        fearless_simd::Level::Avx2(_) => "avx2",
        fearless_simd::Level::Sse4_2(_) => "sse4.2",
        _ => return,
    };
    println!("cargo::rustc-cfg=only_level");
    println!("cargo::rustc-cfg=only_level=\"{level}\"");
}

#[cfg(not(target_arch = "x86_64"))]
fn own_level() {}
