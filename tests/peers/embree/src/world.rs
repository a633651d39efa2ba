//! The benchmark's worlds: a room of one mesh (a rough floor and rough balls, huge wall quads and long slivers), and a field of instances.

use gonio::accel::Instance;

/// Points and triangles.
#[derive(Default)]
pub struct Mesh {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// A mesh in its place.
pub struct Placement {
    pub mesh: u32,
    pub object_to_world: [[f64; 4]; 3],
}

/// What rays are sent through.
pub struct World {
    pub meshes: Vec<Mesh>,
    pub placements: Vec<Placement>,
    /// Where the camera stands; it looks along y.
    pub eye: [f32; 3],
    /// The middle of the light, level and square, and half its width.
    pub light: ([f32; 3], f32),
}

impl World {
    /// The number of placed triangles' meshes, each counted once.
    pub fn triangles(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
    }
}

/// The room's half width and its height, in metres.
const ROOM: [f32; 2] = [5.0, 4.0];
/// Quads around a plant of the field, which is a rough ball of 10 thousand triangles.
const PLANT: u32 = 50;

/// A hash of a lattice point to [-1, 1].
fn lattice(x: i32, y: i32, z: i32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x8da6_b343) ^ (y as u32).wrapping_mul(0xd816_3841) ^ (z as u32).wrapping_mul(0xcb1a_b31f);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    (h ^ (h >> 15)) as f32 / u32::MAX as f32 * 2.0 - 1.0
}

/// Smooth noise of a point.
fn noise(p: [f32; 3]) -> f32 {
    let cell = p.map(|x| x.floor() as i32);
    let f = [0, 1, 2].map(|a| p[a] - cell[a] as f32).map(|x| x * x * (3.0 - 2.0 * x));
    let mut sum = 0.0;
    for corner in 0..8 {
        let bit = |a: usize| (corner >> a) & 1;
        let weight: f32 = (0..3).map(|a| if bit(a) == 1 { f[a] } else { 1.0 - f[a] }).product();
        sum += weight * lattice(cell[0] + bit(0), cell[1] + bit(1), cell[2] + bit(2));
    }
    sum
}

fn fractal(p: [f32; 3]) -> f32 {
    (0..4).map(|octave| noise(p.map(|x| x * f32::powi(2.0, octave))) * 0.5f32.powi(octave)).sum()
}

impl Mesh {
    /// A patch of `n` x `m` quads; `point` maps the unit square.
    fn patch(&mut self, n: u32, m: u32, point: impl Fn(f32, f32) -> [f32; 3]) {
        let first = self.positions.len() as u32;
        for j in 0..=m {
            for i in 0..=n {
                self.positions.push(point(i as f32 / n as f32, j as f32 / m as f32));
            }
        }
        for j in 0..m {
            for i in 0..n {
                let a = first + j * (n + 1) + i;
                self.triangles.extend([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
            }
        }
    }

    fn ball(&mut self, centre: [f32; 3], radius: f32, n: u32) {
        self.patch(2 * n, n, |u, v| {
            let (phi, theta) = (u * std::f32::consts::TAU, v * std::f32::consts::PI);
            let direction = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            let r = radius * (1.0 + 0.15 * fractal([0, 1, 2].map(|a| 3.0 * direction[a] + centre[a])));
            [0, 1, 2].map(|a| centre[a] + r * direction[a])
        });
    }
}

/// The room; `detail` 1 has about 280 thousand triangles, which grow with its square.
pub fn room(detail: f32) -> World {
    let placements = vec![Placement { mesh: 0, object_to_world: Instance::IDENTITY }];
    let [half, height] = ROOM;
    World { meshes: vec![room_mesh(detail)], placements, eye: [0.3, -0.95 * half, 2.2], light: ([0.0, 0.0, height - 0.05], 2.0) }
}

fn room_mesh(detail: f32) -> Mesh {
    let mut mesh = Mesh::default();
    let [half, height] = ROOM;
    let n = (254.0 * detail) as u32;
    mesh.patch(n, n, |u, v| {
        let (x, y) = (half * (2.0 * u - 1.0), half * (2.0 * v - 1.0));
        [x, y, 0.1 * fractal([x, y, 0.0])]
    });
    for k in 0..10 {
        let place = |seed| lattice(k, seed, 5);
        let radius = 0.5 + 0.25 * place(3);
        mesh.ball([0.85 * half * place(1), 0.85 * half * place(2), 0.6 + 0.5 * (1.0 + place(4))], radius, (60.5 * detail) as u32);
    }
    let (low, top) = (-0.5, height);
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    for k in 0..4 {
        let ([ax, ay], [bx, by]) = (corners[k], corners[(k + 1) % 4]);
        mesh.patch(1, 1, |u, v| [ax + u * (bx - ax), ay + u * (by - ay), low + v * (top - low)]);
    }
    mesh.patch(1, 1, |u, v| [half * (2.0 * u - 1.0), half * (2.0 * v - 1.0), top]);
    for k in 0..(4000.0 * detail * detail) as i32 {
        let place = |seed| lattice(k, seed, 9);
        let a = [half * place(1), half * place(2), 2.0 + place(3)];
        let b = [a[0] + 1.5 * place(4), a[1] + 1.5 * place(5), a[2] + 0.5 * place(6)];
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([a, b, [b[0] + 0.01, b[1], b[2] + 0.01]]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

/// A rough ground with plants on it, one a square metre, turned, and scaled between 0.5 and 1.5.
pub fn field(plants: u32) -> World {
    let half = (plants as f32).sqrt() * 0.5;
    let (mut ground, mut plant) = (Mesh::default(), Mesh::default());
    ground.patch(128, 128, |u, v| {
        let (x, y) = (2.0 * half * (2.0 * u - 1.0), 2.0 * half * (2.0 * v - 1.0));
        [x, y, 0.2 * fractal([x, y, 0.0])]
    });
    plant.ball([0.0; 3], 0.4, PLANT);
    let mut placements = vec![Placement { mesh: 0, object_to_world: Instance::IDENTITY }];
    placements.extend((0..plants as i32).map(|k| {
        let place = |seed| f64::from(lattice(k, seed, 7));
        let (sin, cos) = (place(1) * std::f64::consts::PI).sin_cos();
        let (size, width) = (1.0 + 0.5 * place(2), f64::from(half));
        let object_to_world =
            [[size * cos, -size * sin, 0.0, width * place(3)], [size * sin, size * cos, 0.0, width * place(4)], [0.0, 0.0, size, 0.3]];
        Placement { mesh: 1, object_to_world }
    }));
    World { meshes: vec![ground, plant], placements, eye: [0.0, -half - 3.0, 6.0], light: ([0.0, 0.0, 2.0 * half + 10.0], 1.0) }
}
