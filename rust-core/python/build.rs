//! Tells zig's linker what the module exports on Windows: without a list it exports every symbol, of which a library may have 65535.

use std::{env, fs, io, path::Path};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let target = env::var("TARGET").unwrap_or_default();
    // maturin brings a list of its own, whose symbol `PyInit_gonio._gonio` no module has. The last list counts, and a build script's comes last.
    if let (true, Some(folder)) = (target.ends_with("-windows-gnu"), env::var_os("OUT_DIR")) {
        let exports = Path::new(&folder).join("exports.def");
        fs::write(&exports, "EXPORTS\nPyInit__gonio\n")?;
        println!("cargo::rustc-link-arg-cdylib={}", exports.display());
    }
    Ok(())
}
