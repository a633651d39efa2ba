//! What every built tree must be, whatever it is built over and by how many threads.

use super::{Mesh, Random};
use crate::build::collapse::{LeafMaker, LeafRule};
use crate::build::division::{PART, Source, divide_all};
use crate::build::effort::Effort;
use crate::build::wide_tree::{WideTree, build, wide_nodes};
use crate::ray::NONE;
use crate::tree::node::{Bounds, ChildRef, Kind, MAX_DEPTH, WIDTH};
use crate::{Blas, Cancelled, Care};
use obvhs::aabb::Aabb;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Leaves that name their primitives.
struct Names;

impl LeafMaker for Names {
    type Leaf = [u32; WIDTH];
    const RULE: LeafRule = LeafRule { capacity: 8, cost: 1.2 };
    const KIND: Kind = Kind::Triangles;

    fn leaf(&self, primitives: &[u32]) -> [u32; WIDTH] {
        std::array::from_fn(|lane| primitives.get(lane).copied().unwrap_or(NONE))
    }
}

fn built(boxes: &Vec<Bounds>, effort: Effort) -> WideTree<[u32; WIDTH]> {
    build(boxes, &Names, effort, &AtomicBool::new(false)).expect("not cancelled")
}

/// Asserts that every box is in one leaf, that boxes hold what is below them, and that no way down is too long.
fn check(boxes: &[Bounds], tree: &WideTree<[u32; WIDTH]>) {
    let within = |inner: &Bounds, outer: &Bounds| inner.union(outer) == *outer;
    let mut seen = vec![false; boxes.len()];
    let (mut nodes, mut leaves) = (0, 0);
    let mut open = vec![(ChildRef::ROOT, tree.bounds, 1)];
    while let Some((child, bounds, depth)) = open.pop() {
        assert!(depth <= MAX_DEPTH);
        nodes += 1;
        let node = &tree.nodes[child.index()];
        for slot in 0..WIDTH {
            let (inner, child) = (node.bounds_of(slot), node.children[slot]);
            if inner.is_empty() {
                assert_eq!(child, ChildRef::ROOT);
                continue;
            }
            assert!(within(&inner, &bounds));
            if child.is_inner() {
                open.push((child, inner, depth + 1));
                continue;
            }
            leaves += 1;
            let primitives = tree.leaves[child.index()];
            assert!(primitives.is_sorted() && primitives[0] != NONE);
            for &primitive in primitives.iter().filter(|&&primitive| primitive != NONE) {
                assert!(within(&boxes[primitive as usize], &inner));
                assert!(!std::mem::replace(&mut seen[primitive as usize], true), "{primitive} is in two leaves");
            }
        }
    }
    assert!(seen.iter().all(|&seen| seen));
    assert_eq!((nodes, leaves, tree.primitives), (tree.nodes.len(), tree.leaves.len(), boxes.len()));
}

fn cube(centre: [f32; 3], size: f32) -> Bounds {
    Bounds { min: centre.map(|x| x - size), max: centre.map(|x| x + size) }
}

/// Boxes of many parts: scattered ones, rows, grids of quads, all at one place, all but some at one place, halving sizes, huge coordinates.
fn worlds() -> Vec<Vec<Bounds>> {
    let mut random = Random(71);
    let n = 3 * PART as u32;
    let scattered: Vec<Bounds> = (0..n).map(|_| cube(random.point(), 0.01 * random.unit())).collect();
    let far = [cube([1e9, 0.0, 0.0], 1.0), cube([0.0, -1e12, 0.0], 1e3), cube([0.0; 3], 1e12)];
    vec![
        (0..n).map(|i| cube([i as f32, 0.0, 0.0], 1.0)).collect(),
        (0..2 * n).map(|i| cube([(i / 2 % 256) as f32, (i / 512) as f32, 0.0], 0.5)).collect(),
        vec![cube([0.25; 3], 1.0); n as usize],
        scattered.iter().copied().chain(far).collect(),
        (0..n).map(|i| cube([0.5f32.powi((i / 512) as i32); 3], 0.5f32.powi((i / 512) as i32))).collect(),
        scattered.iter().map(|b| Bounds { min: b.min.map(|x| x * 1e12), max: b.max.map(|x| x * 1e12) }).collect(),
        scattered,
    ]
}

#[test]
fn every_box_is_in_one_leaf() {
    for boxes in worlds() {
        for effort in [Effort::QUICK, Effort::THOROUGH] {
            check(&boxes, &built(&boxes, effort));
            let few = boxes[..100].to_vec();
            check(&few, &built(&few, effort));
        }
    }
    check(&[cube([1.0; 3], 1.0)], &built(&vec![cube([1.0; 3], 1.0)], Effort::QUICK));
    assert!(built(&Vec::new(), Effort::QUICK).leaves.is_empty());
}

#[test]
fn balanced_trees_are_shallow() {
    for boxes in worlds() {
        let cancel = AtomicBool::new(false);
        let lists = divide_all(&boxes, true, &cancel).expect("not cancelled");
        let wide = wide_nodes(&boxes, &lists, Names::RULE, Kind::Triangles, None, &cancel).expect("not cancelled");
        assert!(wide.depth <= MAX_DEPTH / 2);
    }
}

#[test]
fn threads_change_no_bit() {
    let mesh = Mesh::soup(&mut Random(72), 2 * PART, 1.0, 0.05);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| Blas::build(&mesh.positions, &mesh.triangles, Care::Thorough, &AtomicBool::new(false)).expect("not cancelled"))
    };
    let (one, others) = (on(1), [on(2), on(3)]);
    for other in others {
        assert_eq!(bytemuck::cast_slice::<_, u32>(&one.nodes), bytemuck::cast_slice::<_, u32>(&other.nodes));
        assert_eq!(bytemuck::cast_slice::<_, u32>(&one.blocks), bytemuck::cast_slice::<_, u32>(&other.blocks));
    }
}

/// Boxes of which one sets the flag when it is asked for.
struct Cancelling<'a> {
    boxes: &'a Vec<Bounds>,
    asked: AtomicUsize,
    at: usize,
    flag: &'a AtomicBool,
}

impl Source for Cancelling<'_> {
    fn len(&self) -> usize {
        self.boxes.len()
    }

    fn bounds(&self, number: u32) -> Option<Aabb> {
        if self.asked.fetch_add(1, Ordering::Relaxed) == self.at {
            self.flag.store(true, Ordering::Relaxed);
        }
        self.boxes.bounds(number)
    }

    fn extent(&self) -> Aabb {
        self.boxes.extent()
    }
}

#[test]
fn builds_end_when_they_are_cancelled_on_the_way() {
    let boxes = worlds().pop().expect("worlds");
    for at in [0, PART, boxes.len() + 1, 2 * boxes.len() - 1] {
        let flag = AtomicBool::new(false);
        let source = Cancelling { boxes: &boxes, asked: AtomicUsize::new(0), at, flag: &flag };
        assert_eq!(build(&source, &Names, Effort::QUICK, &flag).err(), Some(Cancelled));
    }
}
