//! Tells linkers that the module exports what Python calls, and nothing else. Rust's own list also has what the crates inside export to C, which a
//! program that loads the module may have in another version.

use std::{env, fs, io, path::Path};

/// Windows: maturin brings a list whose symbol `PyInit_gonio._gonio` no module has, and without a list zig's linker exports every symbol, of which a
/// library may have 65535.
const WINDOWS: &str = "EXPORTS\nPyInit__gonio\n";
const LINUX: &str = "{ global: PyInit__gonio; local: *; };\n";

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let target = env::var("TARGET").unwrap_or_default();
    let linker = env::var("RUSTC_LINKER").unwrap_or_default();
    // To zig the last list counts, and a build script's comes last. It knows no `--exclude-libs`, and others know but one list.
    let argument = if target.ends_with("-windows-gnu") {
        list("exports.def", WINDOWS)?
    } else if target.contains("-linux-") && linker.contains("zigcc") {
        format!("-Wl,--version-script={}", list("exports.map", LINUX)?)
    } else if target.contains("-linux-") {
        "-Wl,--exclude-libs,ALL".to_owned()
    } else {
        return Ok(());
    };
    println!("cargo::rustc-link-arg-cdylib={argument}");
    Ok(())
}

/// Where a list for the linker stands.
fn list(name: &str, content: &str) -> io::Result<String> {
    let path = Path::new(&env::var("OUT_DIR").unwrap_or_default()).join(name);
    fs::write(&path, content)?;
    Ok(path.display().to_string())
}
