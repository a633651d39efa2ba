//! Real files, which are no part of the project: `data/gdtf` in the folder of real data.

use gonio_formats::gdtf::Gdtf;
use std::path::{Path, PathBuf};

#[test]
fn real_fixtures_say_their_light_or_why_not() {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let folder = std::env::var_os("GONIO_SHARED").map_or_else(beside, PathBuf::from).join("data/gdtf");
    let entries: Vec<PathBuf> = std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    if entries.is_empty() {
        eprintln!("skipped: no GDTF files under {}", folder.display());
    }
    for path in entries.iter().filter(|path| path.extension().is_some_and(|ending| ending == "gdtf")) {
        eprintln!("{}", path.display());
        let fixture = match Gdtf::read(&std::fs::read(path).unwrap()) {
            Ok(fixture) => fixture,
            Err(problem) => {
                eprintln!("    {problem}");
                continue;
            }
        };
        fixture.warnings.iter().take(5).for_each(|warning| eprintln!("    {warning}"));
        for mode in &fixture.modes {
            match fixture.goniogram(mode) {
                Ok(light) => {
                    eprintln!("    {}: {:.0} lm, {:.0} cd", mode.name, light.flux(), light.peak());
                    assert!(light.flux() > 0.0);
                }
                Err(problem) => eprintln!("    {}: {problem}", mode.name),
            }
        }
    }
}
