//! What the learned light cache learns from: which lights' shadow rays arrived where, and which were blocked.

use crate::state::workspace::Workspace;
use gonio_light::Arrival;
use gonio_simd::{Lanes, M, Vec3};

/// Notes the points at which the sampled light brings nothing even unblocked.
#[inline(always)]
pub(crate) fn note_lost<L: Lanes>(position: Vec3<L>, lost: M<L>, ws: &mut Workspace) {
    let Some(arrivals) = &mut ws.arrivals else { return };
    let columns = [position.x, position.y, position.z].map(gonio_simd::F::to_array);
    let bits = lost.bits();
    let lanes = (0..L::COUNT).filter(|lane| bits >> lane & 1 != 0);
    arrivals.extend(lanes.map(|lane| Arrival::nothing(columns.map(|column| column[lane]))));
}

/// Notes the contributions of shadow rays that arrived, and where others were blocked.
pub(crate) fn note_arrivals(ws: &mut Workspace) {
    let Some(arrivals) = &mut ws.arrivals else { return };
    let rays = &ws.shadows;
    arrivals.extend((0..rays.count).map(|ray| {
        let position = [0, 1, 2].map(|axis| rays.origin[axis][ray]);
        if ws.blocked[ray] != 0 {
            return Arrival::nothing(position);
        }
        let value = rays.contribution.iter().map(|channel| channel[ray]).sum();
        Arrival { position, distance: rays.t_max[ray], light: Some(rays.light[ray]), value }
    }));
}
