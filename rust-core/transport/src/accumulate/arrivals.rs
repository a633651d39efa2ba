//! What the learned light cache learns from: which lights' shadow rays arrived where, and which were blocked.

use crate::accumulate::deposit::Deposits;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::vertex::Interaction;
use gonio_light::Arrival;
use gonio_simd::{Lanes, M};

impl Deposits {
    /// Notes the points at which the sampled light brings nothing even unblocked.
    #[inline(always)]
    pub(crate) fn note_lost<L: Lanes>(&mut self, at: &Interaction<L>, lost: M<L>) {
        let Some(arrivals) = &mut self.arrivals else { return };
        let (position, receivers) = (at.position, at.receiver.to_array());
        let columns = [position.x, position.y, position.z].map(gonio_simd::F::to_array);
        let bits = lost.bits();
        let lanes = (0..L::COUNT).filter(|lane| bits >> lane & 1 != 0);
        arrivals.extend(lanes.map(|lane| Arrival::nothing(columns.map(|column| column[lane]), receivers[lane])));
    }

    /// Notes the contributions of shadow rays that arrived, and where others were blocked.
    pub(crate) fn note_arrivals(&mut self, shadows: &ShadowRays, blocked: &[u8]) {
        let Some(arrivals) = &mut self.arrivals else { return };
        arrivals.extend((0..shadows.count).map(|ray| {
            let position = [0, 1, 2].map(|axis| shadows.rays.origin[axis][ray]);
            let receiver = shadows.receiver[ray];
            if blocked[ray] != 0 {
                return Arrival::nothing(position, receiver);
            }
            let value = shadows.contribution.magnitude_of(ray);
            Arrival { position, distance: shadows.rays.t_max[ray], light: Some(shadows.light[ray]), value, receiver }
        }));
    }
}
