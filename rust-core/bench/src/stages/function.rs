//! Elementary functions on lanes, beside those of the standard library; gathers and compaction.

use crate::{
    kernel::{Case, Kernel, Outcome},
    numbers::{BATCH, STEPS, column},
};
use gonio::error::Result;
use gonio_simd::{Column, Execution, F, Lanes, PADDING, dispatch};
use std::{f32::consts::TAU, hint::black_box, marker::PhantomData};

/// A function of two values (the second may be ignored), written once for all lanes, and in the standard library's terms.
trait Function: 'static {
    fn lanes<L: Lanes>(x: F<L>, y: F<L>) -> F<L>;
    fn standard(x: f32, y: f32) -> f32;
}

macro_rules! function {
    ($name:ident, $x:ident, $y:pat => $lanes:expr, $standard:expr) => {
        struct $name;
        impl Function for $name {
            #[inline(always)]
            fn lanes<L: Lanes>($x: F<L>, $y: F<L>) -> F<L> {
                $lanes
            }
            #[inline(always)]
            fn standard($x: f32, $y: f32) -> f32 {
                $standard
            }
        }
    };
}

function!(Sin, x, _ => x.sin(), x.sin());
function!(SinCosTurns, x, _ => { let (sin, cos) = x.sin_cos_turns(); sin + cos }, { let (sin, cos) = (x * TAU).sin_cos(); sin + cos });
function!(Tan, x, _ => x.tan(), x.tan());
function!(Exp, x, _ => x.exp(), x.exp());
function!(Exp2, x, _ => x.exp2(), x.exp2());
function!(Log2, x, _ => x.log2(), x.log2());
function!(Ln, x, _ => x.ln(), x.ln());
function!(Pow, x, y => x.pow(y), x.powf(y));
function!(Asin, x, _ => x.asin(), x.asin());
function!(Acos, x, _ => x.acos(), x.acos());
function!(Atan2, y, x => y.atan2(x - 0.5), y.atan2(x - 0.5));

/// A function over columns.
struct Map<K> {
    x: Column,
    y: Column,
    out: Column,
    function: PhantomData<K>,
}

pub(super) fn cases() -> Vec<Case> {
    vec![
        map::<Sin>("sin", [-TAU, TAU]),
        map::<SinCosTurns>("sin and cos of turns", [0.0, 1.0]),
        map::<Tan>("tan", [-1.5, 1.5]),
        map::<Exp2>("exp2", [-20.0, 20.0]),
        map::<Exp>("exp", [-20.0, 20.0]),
        map::<Log2>("log2", [0.01, 10.0]),
        map::<Ln>("ln", [0.01, 10.0]),
        map::<Pow>("pow", [0.0, 10.0]),
        map::<Asin>("asin", [-1.0, 1.0]),
        map::<Acos>("acos", [-1.0, 1.0]),
        map::<Atan2>("atan2", [-1.0, 1.0]),
        gather("gather", Access::Gather),
        gather("gather of pairs", Access::Pairs),
        gather("compaction", Access::Compact),
    ]
}

fn map<K: Function>(name: &str, [low, high]: [f32; 2]) -> Case {
    let mut x = column(STEPS[0]);
    x.iter_mut().for_each(|x| *x = low + (high - low) * *x);
    let kernel = Map::<K> { x, y: column(STEPS[1]), out: Column::new(BATCH), function: PhantomData };
    Case::new(name, "value", BATCH, kernel)
}

#[inline(always)]
fn map_batch<L: Lanes, K: Function>(l: L, x: &[f32], y: &[f32], out: &mut [f32]) {
    for at in (0..out.len()).step_by(L::COUNT) {
        K::lanes(l.load(x, at), l.load(y, at)).store(out, at);
    }
}

impl<K: Function> Kernel for Map<K> {
    fn run(&mut self, execution: Execution) -> Result<()> {
        let Self { x, y, out, .. } = self;
        dispatch!(execution, l => map_batch::<_, K>(l, x, y, out));
        Ok(())
    }
    fn has_standard(&self) -> bool {
        true
    }
    fn run_standard(&mut self) {
        // An opaque index keeps the loop scalar, as a renderer that follows one path at a time has it.
        (0..BATCH).map(black_box).for_each(|i| self.out[i] = K::standard(self.x[i], self.y[i]));
    }
    fn outcome(&self) -> Outcome {
        Outcome::of([&self.out[..]])
    }
}

/// How memory is reached.
#[derive(Clone, Copy)]
enum Access {
    Gather,
    Pairs,
    Compact,
}

/// Entries of the table gathered from: 256 kB, inside the second-level cache.
const TABLE: usize = 1 << 16;

struct Memory {
    access: Access,
    table: Vec<f32>,
    index: Column<u32>,
    values: Column,
    out: Column,
    kept: usize,
}

fn gather(name: &str, access: Access) -> Case {
    let values = column(STEPS[0]);
    let mut index = Column::new(BATCH);
    index.iter_mut().zip(values.iter()).for_each(|(index, x)| *index = (x * (TABLE - 1) as f32) as u32);
    let table = (0..TABLE).map(|i| i as f32).collect();
    Case::new(name, "value", BATCH, Memory { access, table, index, values, out: Column::new(BATCH + PADDING), kept: 0 })
}

#[inline(always)]
fn reach<L: Lanes>(l: L, job: &mut Memory) {
    let Memory { access, table, index, values, out, kept } = job;
    *kept = 0;
    match access {
        Access::Gather => {
            for at in (0..BATCH).step_by(L::COUNT) {
                l.gather(table, l.load_integers(index, at)).store(out, at);
            }
        }
        Access::Pairs => {
            for at in (0..BATCH).step_by(L::COUNT) {
                let [low, high] = l.gather_pairs(table, l.load_integers(index, at));
                (low + high).store(out, at);
            }
        }
        Access::Compact => {
            for at in (0..BATCH).step_by(L::COUNT) {
                let x = l.load(values, at);
                let chosen = x.lt(0.5);
                x.append(chosen, out, *kept);
                *kept += chosen.count();
            }
        }
    }
}

impl Kernel for Memory {
    fn run(&mut self, execution: Execution) -> Result<()> {
        dispatch!(execution, l => reach(l, self));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        Outcome::of([&self.out[..if self.kept > 0 { self.kept } else { BATCH }]])
    }
}
