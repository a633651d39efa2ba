//! Embree through the C shim.

use crate::world::{Mesh, World};
use gonio::accel::RayBatch;
use std::ffi::{CStr, CString, c_char, c_int, c_void};

#[repr(C)]
struct Columns {
    origin: [*const f32; 3],
    direction: [*const f32; 3],
    t_min: *const f32,
    t_max: *const f32,
}

impl Columns {
    fn new(rays: &RayBatch) -> Self {
        Columns {
            origin: rays.origin.map(<[f32]>::as_ptr),
            direction: rays.direction.map(<[f32]>::as_ptr),
            t_min: rays.t_min.as_ptr(),
            t_max: rays.t_max.as_ptr(),
        }
    }
}

#[repr(C)]
struct Peer {
    device: *mut c_void,
    scene: *mut c_void,
}

#[repr(C)]
struct PeerMesh {
    positions: *const [f32; 3],
    points: usize,
    triangles: *const [u32; 3],
    count: usize,
}

impl PeerMesh {
    fn new(mesh: &Mesh) -> Self {
        PeerMesh {
            positions: mesh.positions.as_ptr(),
            points: mesh.positions.len(),
            triangles: mesh.triangles.as_ptr(),
            count: mesh.triangles.len(),
        }
    }
}

#[repr(C)]
struct PeerPlacement {
    mesh: u32,
    rows: [[f32; 4]; 3],
}

unsafe extern "C" {
    fn peer_flush_denormals();
    fn peer_thread_seconds() -> f64;
    fn peer_new(
        peer: *mut Peer,
        meshes: *const PeerMesh,
        mesh_count: usize,
        placements: *const PeerPlacement,
        placed: usize,
        robust: c_int,
        config: *const c_char,
    ) -> f64;
    fn peer_new_curves(
        peer: *mut Peer,
        points: *const [f32; 4],
        count: usize,
        pieces: *const u32,
        flags: *const u8,
        piece_count: usize,
        robust: c_int,
    ) -> f64;
    fn peer_free(peer: *mut Peer);
    fn peer_version(out: *mut c_char, size: usize);
    fn peer_first_hit(peer: *const Peer, rays: *const Columns, n: usize, coherent: c_int, t: *mut f32, primitive: *mut u32);
    fn peer_first_hit16(peer: *const Peer, rays: *const Columns, n: usize, coherent: c_int, t: *mut f32, primitive: *mut u32);
    fn peer_occluded(peer: *const Peer, rays: *const Columns, n: usize, out: *mut u8);
    fn peer_occluded16(peer: *const Peer, rays: *const Columns, n: usize, out: *mut u8);
}

/// Denormal numbers count as zero in this thread from now on, as Embree advises.
pub fn flush_denormals() {
    // SAFETY: sets two bits of the thread's floating-point control register.
    unsafe { peer_flush_denormals() }
}

/// The processor time of this thread in seconds, which other processes do not lengthen.
pub fn thread_seconds() -> f64 {
    // SAFETY: reads a clock.
    unsafe { peer_thread_seconds() }
}

/// Embree's version.
pub fn version() -> String {
    let mut text = [0 as c_char; 32];
    // SAFETY: the shim writes a terminated string of at most the given size.
    unsafe {
        peer_version(text.as_mut_ptr(), text.len());
        CStr::from_ptr(text.as_ptr()).to_string_lossy().into_owned()
    }
}

/// A world in Embree, medium quality; one placed mesh alone needs no instance there.
pub struct EmbreeScene {
    peer: Peer,
    /// Seconds of the build by the clock.
    pub build_seconds: f64,
    /// Processor seconds of the calling thread during the build.
    pub build_processor_seconds: f64,
}

impl EmbreeScene {
    pub fn new(world: &World, robust: bool, threads: usize) -> Self {
        let mut peer = Peer { device: std::ptr::null_mut(), scene: std::ptr::null_mut() };
        let config = CString::new(format!("threads={threads}")).expect("no zero byte");
        let meshes: Vec<PeerMesh> = world.meshes.iter().map(PeerMesh::new).collect();
        let placements = if world.placements.len() == 1 { &[][..] } else { &world.placements };
        let placements: Vec<PeerPlacement> =
            placements.iter().map(|p| PeerPlacement { mesh: p.mesh, rows: p.object_to_world.map(|row| row.map(|x| x as f32)) }).collect();
        let processor = thread_seconds();
        // SAFETY: the shim copies the arrays, whose lengths it is told; worlds have fewer meshes than it has places for.
        let build_seconds = unsafe {
            peer_new(&mut peer, meshes.as_ptr(), meshes.len(), placements.as_ptr(), placements.len(), robust.into(), config.as_ptr())
        };
        EmbreeScene { peer, build_seconds, build_processor_seconds: thread_seconds() - processor }
    }

    /// Round linear curves by points with radii, and each piece's first point. Pieces join where one begins at the other's end.
    pub fn of_curves(points: &[[f32; 4]], pieces: &[u32], robust: bool) -> Self {
        let mut peer = Peer { device: std::ptr::null_mut(), scene: std::ptr::null_mut() };
        let neighbours = |i: usize| [i > 0 && pieces[i - 1] + 1 == pieces[i], i + 1 < pieces.len() && pieces[i] + 1 == pieces[i + 1]];
        let flags: Vec<u8> = (0..pieces.len()).map(neighbours).map(|[left, right]| u8::from(left) | u8::from(right) << 1).collect();
        let processor = thread_seconds();
        // SAFETY: the shim copies the arrays, whose lengths it is told; each piece's two points are among them.
        let build_seconds = unsafe {
            peer_new_curves(&mut peer, points.as_ptr(), points.len(), pieces.as_ptr(), flags.as_ptr(), pieces.len(), robust.into())
        };
        EmbreeScene { peer, build_seconds, build_processor_seconds: thread_seconds() - processor }
    }

    /// Nearest hits; `packets` uses `rtcIntersect16`.
    pub fn first_hit(&self, rays: &RayBatch, packets: bool, coherent: bool, t: &mut [f32], primitive: &mut [u32]) {
        assert!(rays.len().is_multiple_of(16) && t.len() == rays.len() && primitive.len() == rays.len());
        let columns = Columns::new(rays);
        let run = if packets { peer_first_hit16 } else { peer_first_hit };
        // SAFETY: all columns have the length of the batch, a multiple of 16.
        unsafe { run(&self.peer, &columns, rays.len(), coherent.into(), t.as_mut_ptr(), primitive.as_mut_ptr()) }
    }

    /// Any hits; `packets` uses `rtcOccluded16`.
    pub fn occluded(&self, rays: &RayBatch, packets: bool, out: &mut [u8]) {
        assert!(rays.len().is_multiple_of(16) && out.len() == rays.len());
        let columns = Columns::new(rays);
        let run = if packets { peer_occluded16 } else { peer_occluded };
        // SAFETY: all columns have the length of the batch, a multiple of 16.
        unsafe { run(&self.peer, &columns, rays.len(), out.as_mut_ptr()) }
    }
}

impl Drop for EmbreeScene {
    fn drop(&mut self) {
        // SAFETY: both handles are alive until here.
        unsafe { peer_free(&mut self.peer) }
    }
}
