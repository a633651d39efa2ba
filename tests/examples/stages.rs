//! Renders a scene bundle at every SIMD level on one thread and prints the times, for profiling: `stages BUNDLE [WIDTH] [SAMPLES] [LEVEL]`.

use gonio::{
    compile::compile,
    render::Render,
    scene::{Settings, load_bundle},
};
use gonio_simd::Execution;
use std::{
    path::Path,
    sync::{Arc, atomic::AtomicBool},
    time::Instant,
};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |i: usize, default: u32| arguments.get(i).and_then(|text| text.parse().ok()).unwrap_or(default);
    let scene = load_bundle(Path::new(&arguments[1])).expect("a scene bundle");
    let width = number(2, 256);
    let settings = Settings { resolution: [width, width], samples: number(3, 8), threads: 1, ..scene.settings.clone() };
    let compiled = Arc::new(compile(&scene, None, &AtomicBool::new(false)).expect("compiles"));
    for execution in Execution::all() {
        if arguments.get(4).is_some_and(|name| name != execution.name()) {
            continue;
        }
        let start = Instant::now();
        let mut render = Render::start(compiled.clone(), &settings, execution).expect("starts");
        render.finish().expect("ends well");
        let rays = render.progress().rays as f64 * 1e-6;
        let seconds = start.elapsed().as_secs_f64();
        let statistics = render.statistics();
        let share = |(name, ns): (&&str, &u64)| format!("{name} {:.3}", *ns as f64 * 1e-9);
        let stages: Vec<String> = gonio::integrator::STAGES.iter().zip(&statistics.time_ns).map(share).collect();
        let alive = statistics.lanes_alive as f64 / statistics.lanes.max(1) as f64;
        let line = format!(
            "{:8} {seconds:7.3} s {:7.3} Mrays/s, lanes alive {alive:.2}, {}\n",
            execution.name(),
            rays / seconds,
            stages.join(", ")
        );
        std::io::Write::write_all(&mut std::io::stdout(), line.as_bytes()).expect("standard output");
    }
}
