//! Lights beside the tree, against the same shapes in it.

use super::agreement::random_placement;
use super::*;
use crate::{NONE, RayMask, Shape};
use gonio_simd::Execution;

const SHAPES: [Shape; 4] = [Shape::Rectangle, Shape::Disk, Shape::Sphere, Shape::Cylinder];

/// Triangles, and some shapes of every kind; rays of two kinds, one of which does not see some shapes.
struct Lit {
    mesh: Arc<Blas>,
    instances: Vec<Instance>,
    rays: OwnedRays,
}

impl Lit {
    fn new(seed: u64, shapes: usize) -> Self {
        let mut random = Random(seed);
        let mesh = Mesh::soup(&mut random, 100, 1.0, 0.2).blas();
        let mut instances = vec![instance(Geometry::Mesh(0), Instance::IDENTITY)];
        for number in 0..shapes {
            let map = random_placement(&mut random).map(|[x, y, z, moved]| [5.0 * x, 5.0 * y, 5.0 * z, moved]);
            let placed = instance(Geometry::Shape(SHAPES[number % SHAPES.len()]), map);
            instances.push(Instance { mask: 2 + (number % 3 == 0) as RayMask, ..placed });
        }
        let mut rays = OwnedRays::random(&mut random, 2003, 1.0, true);
        rays.mask.iter_mut().enumerate().for_each(|(i, mask)| *mask = if i % 4 == 0 { 1 } else { 3 });
        Lit { mesh, instances, rays }
    }

    /// With the shapes beside the tree, in the tree, and without them.
    fn scenes(&self) -> [Tlas; 3] {
        let meshes = || vec![self.mesh.clone()];
        let loose = Tlas::build_with_lights(meshes(), &self.instances, 1, &AtomicBool::new(false)).expect("not cancelled");
        loose.tuners.settle(true);
        [loose, scene(meshes(), &self.instances), scene(meshes(), &self.instances[..1])]
    }
}

/// Hits by all kinds of traversal.
fn all_hits(scene: &Tlas, rays: &RayBatch) -> Vec<Hits> {
    let mut alone = Hits::default();
    scene.first_hit(Execution::Scalar, rays, false, &mut alone);
    let mut all = vec![alone];
    for level in levels() {
        for packets in [false, true] {
            let mut hits = Hits::default();
            if packets {
                scene.first_hit(Execution::Vector(level), rays, true, &mut hits)
            } else {
                scene.first_hit(Execution::Vector(level), rays, false, &mut hits)
            }
            all.push(hits);
        }
    }
    all
}

/// Without what is behind.
fn visible(hits: &Hits) -> Hits {
    Hits { covered: Vec::new(), ..hits.clone() }
}

#[test]
fn loose_lights_are_hit_as_in_the_tree() {
    for seed in 40..48 {
        let lit = Lit::new(seed, 8);
        let [loose, inside, without] = lit.scenes();
        assert!(loose.has_loose_lights() && !inside.has_loose_lights());
        let rays = lit.rays.batch();
        let behind = all_hits(&without, &rays);
        for ((loose, inside), behind) in all_hits(&loose, &rays).iter().zip(all_hits(&inside, &rays)).zip(behind) {
            assert_eq!(visible(loose), inside);
            let lit: Vec<usize> = (0..rays.len()).filter(|i| (1..NONE).contains(&loose.instance[*i])).collect();
            assert!(lit.len() > 50, "{} rays hit a shape", lit.len());
            assert_eq!(loose.covered.iter().map(|covered| covered.ray as usize).collect::<Vec<_>>(), lit);
            assert!(loose.covered.iter().all(|covered| covered.hit == behind.get(covered.ray as usize)));
        }
    }
}

#[test]
fn shapes_smaller_than_a_millimetre_and_a_kilometre_away_are_hit_as_in_the_tree() {
    let mut random = Random(49);
    let mut lit = Lit::new(49, 8);
    let mut middles = Vec::new();
    for placed in &mut lit.instances[1..] {
        let middle = [1000.0, 700.0, -300.0].map(|away| away + 0.01 * f64::from(random.signed()));
        let [x, y, z] = middle;
        placed.object_to_world = [[2e-4, 0.0, 0.0, x], [0.0, 2e-4, 0.0, y], [0.0, 0.0, 2e-4, z]];
        middles.push(middle.map(|x| x as f32));
    }
    lit.rays = OwnedRays::default();
    for i in 0..4000 {
        let (middle, near, aim) = (middles[i % middles.len()], random.point(), random.point());
        let origin = if i % 3 == 0 { near } else { [0, 1, 2].map(|axis| middle[axis] + near[axis]) };
        lit.rays.push(origin, [0, 1, 2].map(|axis| middle[axis] + 3e-4 * aim[axis] - origin[axis]), f32::INFINITY);
        lit.rays.mask[i] = 3;
    }
    let [loose, inside, _] = lit.scenes();
    for (loose, inside) in all_hits(&loose, &lit.rays.batch()).iter().zip(all_hits(&inside, &lit.rays.batch())) {
        assert_eq!(visible(loose), inside);
        let lit = loose.instance.iter().filter(|instance| (1..NONE).contains(*instance)).count();
        assert!(lit > 200, "{lit} rays hit a shape");
    }
}

#[test]
fn rays_go_on_behind_loose_lights_as_in_the_tree() {
    let lit = Lit::new(50, 8);
    let [loose, inside, _] = lit.scenes();
    for execution in Execution::all() {
        let (mut hits, mut again) = (Hits::default(), Hits::default());
        loose.first_hit(Execution::Scalar, &lit.rays.batch(), false, &mut hits);
        let mut beyond = OwnedRays::default();
        for covered in &hits.covered {
            let i = covered.ray as usize;
            beyond.push(
                [0, 1, 2].map(|axis| lit.rays.origin[axis][i]),
                [0, 1, 2].map(|axis| lit.rays.direction[axis][i]),
                lit.rays.t_max[i],
            );
            *beyond.t_min.last_mut().expect("pushed") = hits.t[i].next_up();
            *beyond.mask.last_mut().expect("pushed") = lit.rays.mask[i];
        }
        loose.first_hit_before(execution, &beyond.batch(), &hits.covered, &mut again);
        let mut traced = Hits::default();
        inside.first_hit(Execution::Scalar, &beyond.batch(), false, &mut traced);
        assert_eq!(visible(&again), traced, "{}", execution.name());
        assert!(again.covered.len() > 5, "{} rays hit a second shape", again.covered.len());
    }
}

#[test]
fn many_shapes_stand_in_the_tree() {
    let lit = Lit::new(51, 9);
    let [loose, ..] = lit.scenes();
    assert!(!loose.has_loose_lights());
    assert!(all_hits(&loose, &lit.rays.batch())[0].instance.iter().any(|instance| (1..NONE).contains(instance)));
}
