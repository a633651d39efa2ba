//! Nodes run on points at any level, and tables of points from Cycles.

#![allow(dead_code, reason = "each test takes what it needs")]

use gonio_simd::{Execution, F, Lanes, dispatch};

/// A node with `N` inputs and `M` outputs.
pub(crate) trait Node<const N: usize, const M: usize> {
    fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; N]) -> [F<L>; M];
}

/// Implements [`Node`] by the type's own method.
#[macro_export]
macro_rules! node {
    ($type:ty, $inputs:literal, $outputs:literal) => {
        impl $crate::common::Node<$inputs, $outputs> for $type {
            #[inline(always)]
            fn evaluate<L: gonio_simd::Lanes>(&self, l: L, inputs: &[gonio_simd::F<L>; $inputs]) -> [gonio_simd::F<L>; $outputs] {
                <$type>::evaluate(self, l, inputs)
            }
        }
    };
}

#[inline(always)]
fn run_on_lanes<L: Lanes, K: Node<N, M>, const N: usize, const M: usize>(l: L, node: &K, points: &[[f32; N]]) -> Vec<[f32; M]> {
    let mut results = Vec::new();
    for points in points.chunks(L::COUNT) {
        let mut inputs = [l.f(0.0); N];
        for (i, input) in inputs.iter_mut().enumerate() {
            let mut values = [0.0; 16];
            for (at, value) in values.iter_mut().enumerate() {
                *value = points[at.min(points.len() - 1)][i];
            }
            *input = l.load(&values, 0);
        }
        let outputs = node.evaluate(l, &inputs);
        for at in 0..points.len() {
            let mut result = [0.0; M];
            for (o, output) in outputs.iter().enumerate() {
                result[o] = output.to_array()[at];
            }
            results.push(result);
        }
    }
    results
}

/// The node's outputs at points.
pub(crate) fn run<K: Node<N, M>, const N: usize, const M: usize>(execution: Execution, node: &K, points: &[[f32; N]]) -> Vec<[f32; M]> {
    dispatch!(execution, l => run_on_lanes(l, node, points))
}

/// Points of one setting: its words, and inputs and outputs.
pub(crate) struct Group {
    pub(crate) words: Vec<String>,
    pub(crate) points: Vec<(Vec<f32>, Vec<f32>)>,
}

/// Reads lines `words | inputs | outputs`; a line without words continues the setting.
pub(crate) fn table(text: &str) -> Vec<Group> {
    let numbers = |text: &str| text.split_whitespace().map(|word| word.parse().expect("a number")).collect();
    let mut groups: Vec<Group> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let parts: Vec<&str> = line.split('|').collect();
        let words: Vec<String> = parts[0].split_whitespace().map(str::to_owned).collect();
        if !words.is_empty() && groups.last().is_none_or(|group| group.words != words) {
            groups.push(Group { words, points: Vec::new() });
        }
        groups.last_mut().expect("a setting first").points.push((numbers(parts[1]), numbers(parts[2])));
    }
    groups
}

/// Rows as arrays.
pub(crate) fn inputs<const N: usize>(group: &Group) -> Vec<[f32; N]> {
    group.points.iter().map(|(inputs, _)| inputs.as_slice().try_into().expect("as many inputs")).collect()
}

/// Numbers in [0, 1), the same each time.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1 << 24) as f32
    }
}

/// Every combination of awkward values would be many: each input in turn takes each, the others at random among them.
pub(crate) fn hostile<const N: usize>(count: usize) -> Vec<[f32; N]> {
    let values = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        1e-30,
        -1e-30,
        1e-45,
        16.0,
        1e6,
        -3e9,
        1e20,
        -1e38,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    let mut numbers = Numbers(5);
    let mut points = Vec::new();
    for _ in 0..count {
        let mut point = [0.0; N];
        for value in &mut point {
            *value = values[(numbers.next() * values.len() as f32) as usize];
        }
        points.push(point);
    }
    points
}
