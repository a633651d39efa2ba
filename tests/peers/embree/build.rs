//! Compiles the C shim against the system's Embree 3 (Debian: `libembree-dev`).

use std::process::Command;

const FLAGS: [&str; 3] = ["-O3", "-march=native", "-std=gnu11"];

fn main() {
    println!("cargo::rerun-if-changed=shim.c");
    let mut build = cc::Build::new();
    build.file("shim.c").opt_level(3).flag("-march=native").flag("-std=gnu11").warnings(true);
    let compiler = build.get_compiler();
    let version = Command::new(compiler.path()).arg("--version").output().ok();
    let version = version.map(|out| String::from_utf8_lossy(&out.stdout).lines().next().unwrap_or_default().to_owned());
    println!("cargo::rustc-env=SHIM_COMPILER={} {}", version.unwrap_or_default(), FLAGS.join(" "));
    let rustc = Command::new(std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into())).arg("--version").output().ok();
    let rustc = rustc.map(|out| String::from_utf8_lossy(&out.stdout).trim().to_owned());
    println!("cargo::rustc-env=RUSTC_VERSION={}", rustc.unwrap_or_default());
    build.compile("shim");
    println!("cargo::rustc-link-lib=embree3");
}
