//! What the learned light cache learns from: which lights' shadow rays arrived where, and which were blocked.

use crate::accumulate::deposit::Deposits;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::vertex::Interaction;
use gonio_light::{Arrival, LightSample};
use gonio_simd::{Lanes, M, Spectrum};

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

    /// Notes the contributions of lights that nothing blocks, to which no shadow rays are sent: what is unknown of them would hardly be sampled.
    #[inline(always)]
    pub(crate) fn note_arrived<L: Lanes>(&mut self, at: &Interaction<L>, sample: &LightSample<L>, value: Spectrum<L>, arrived: M<L>) {
        let Some(arrivals) = &mut self.arrivals else { return };
        let p = at.position;
        let [x, y, z, distance, value] = [p.x, p.y, p.z, sample.distance, value.abs().mean() * 3.0].map(gonio_simd::F::to_array);
        let (receivers, lights, bits) = (at.receiver.to_array(), sample.light.to_array(), arrived.bits());
        let lanes = (0..L::COUNT).filter(|lane| bits >> lane & 1 != 0);
        arrivals.extend(lanes.map(|lane| Arrival {
            position: [x[lane], y[lane], z[lane]],
            distance: distance[lane],
            light: Some(lights[lane]),
            value: value[lane],
            receiver: receivers[lane],
        }));
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
