//! Tensor trees and their XML.

use core::f64::consts::PI;

use super::super::direction::{spherical, through};
use super::super::{Band, Component, Hemispheres, Measured, TensorTree, Tree, disk_to_square, read, square_to_disk, xml};
use super::Random;

/// A tree whose root has leaves of a grid each, but one branch of constant leaves.
fn tree(rank: u32, random: &mut Random) -> Tree {
    let children = 1_u32 << rank;
    let mut tree = Tree { rank, first: vec![1], log2: vec![-1], values: Vec::new() };
    let leaf = |tree: &mut Tree, log2: u32, random: &mut Random| {
        tree.first.push(tree.values.len() as u32);
        tree.log2.push(log2 as i8);
        tree.values.extend((0..1 << (log2 * rank)).map(|_| (0.3 * random.next()) as f32));
    };
    tree.first.push(1 + children);
    tree.log2.push(-1);
    (1..children).for_each(|_| leaf(&mut tree, 2, random));
    (0..children).for_each(|_| leaf(&mut tree, 0, random));
    tree
}

/// Reflection on our front, and transmission from it.
pub(super) fn material(rank: u32) -> TensorTree {
    let mut random = Random(37);
    let pairs = [Hemispheres::ReflectionFront, Hemispheres::TransmissionFront];
    TensorTree::new(pairs.map(|hemispheres| Component { hemispheres, band: Band::Visible, tree: tree(rank, &mut random) }).to_vec())
        .unwrap()
}

#[test]
fn the_square_and_the_disk_are_inverse_with_equal_areas() {
    let mut random = Random(41);
    for _ in 0..1000 {
        let s = [random.next(), random.next()];
        let d = square_to_disk(s);
        let back = disk_to_square(d);
        assert!((s[0] - back[0]).abs() < 1e-9 && (s[1] - back[1]).abs() < 1e-9, "{s:?} {back:?}");
        let step = 1e-5;
        let [x, y] = [square_to_disk([s[0] + step, s[1]]), square_to_disk([s[0], s[1] + step])];
        let area = ((x[0] - d[0]) * (y[1] - d[1]) - (x[1] - d[1]) * (y[0] - d[0])) / (step * step);
        // Areas change sides of a diagonal within one step in some of the cases.
        assert!((area / PI - 1.0).abs() < 1e-3 || (s[0] - s[1]).abs() < 1e-4 || (s[0] + s[1] - 1.0).abs() < 1e-4, "{area}");
    }
}

#[test]
fn files_come_back() {
    for rank in [3, 4] {
        let tree = material(rank);
        let Ok(Measured::Tree(found)) = read(xml::write_tree(&tree, "").as_bytes(), "") else { panic!("expected a tree") };
        let (a, b) = (Measured::Tree(tree), Measured::Tree(found));
        let mut random = Random(43);
        for _ in 0..1000 {
            let (wi, wo) = (random.any_direction(), random.any_direction());
            assert_eq!(a.eval_luminance(wi, wo), b.eval_luminance(wi, wo));
        }
    }
}

#[test]
fn the_albedo_is_the_mean_over_the_square() {
    for rank in [3, 4] {
        let material = Measured::Tree(material(rank));
        let wi = spherical(0.9, 2.0);
        let n = 64;
        let place = |i: usize| (i as f64 + 0.5) / f64::from(n);
        let mut sum = 0.0;
        for i in 0..(n * n) as usize {
            let [x, y] = square_to_disk([place(i % n as usize), place(i / n as usize)]);
            sum += material.eval_luminance(wi, [x, y, (1.0 - x * x - y * y).max(1e-12).sqrt()]) / wi[2];
        }
        let mean = PI * sum / f64::from(n * n);
        let found = material.albedo(wi);
        assert!((found.reflected[0] / mean - 1.0).abs() < 5e-3, "{} and {mean}", found.reflected[0]);
        assert!(found.transmitted[0] > 0.0);
    }
}

#[test]
fn transmission_is_reciprocal_and_sides_are_kept() {
    let material = Measured::Tree(material(4));
    let mut random = Random(47);
    for _ in 0..500 {
        let (up, down) = (random.direction(), through(random.direction()));
        let (there, back) = (material.eval_luminance(up, down) / up[2], material.eval_luminance(down, up) / down[2].abs());
        assert!((there - back).abs() < 1e-12);
        assert_eq!(material.eval_luminance(down, through(up)), 0.0);
    }
}

#[test]
fn an_isotropic_tree_does_not_see_a_turn() {
    let material = Measured::Tree(material(3));
    let at = |turn: f64| material.eval_luminance(spherical(0.7, 1.0 + turn), spherical(0.4, 2.5 + turn));
    assert!([0.5, 2.0, 4.0].iter().all(|&turn| (at(turn) - at(0.0)).abs() < 1e-12));
}
