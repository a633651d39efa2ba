//! How the light of lamps falls with distance where that is not nature's way (Blender's Light Falloff): a factor on what arrives from so far.

use super::record::Falloff;
use super::table::LightTable;
use gonio_simd::{Lanes, Rgb, U, Vec3};

impl LightTable {
    /// Whether a light falls with distance otherwise than by nature.
    pub fn has_falloff(&self, light: u32) -> bool {
        self.falloffs.get(2 * light as usize..2 * light as usize + 2).is_some_and(|words| words != Falloff::NATURAL.words())
    }

    /// What arrives of lights at points, by the way from there in metres.
    #[inline(always)]
    pub(crate) fn fallen<L: Lanes>(&self, l: L, light: U<L>, way: Vec3<L>, sent: Rgb<L>) -> Rgb<L> {
        if self.falloffs.is_empty() {
            return sent;
        }
        let distance = way.length();
        let (power, smooth) = (l.gather(&self.falloffs, light << 1), l.gather(&self.falloffs, (light << 1) + 1));
        let squared = distance * distance;
        let factor = power.gt(1.5).select(squared, power.gt(0.5).select(distance, l.f(1.0)));
        sent * (factor * smooth.gt(0.0).select(squared / (squared + smooth), l.f(1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LightKind, LightRecord, LightSampleContext, LightTexture};
    use gonio_simd::One;

    /// What a point light of 1 cd with a falloff sends to facing surfaces at a distance, lx.
    fn sent(falloff: Falloff, distance: f32) -> f32 {
        let records = [LightRecord { falloff, ..LightRecord::new(LightKind::Point) }];
        let table = LightTable::build(&records, &[] as &[LightTexture], &[]);
        let [position, normal] = [[0.0, 0.0, -distance], [0.0, 0.0, 1.0]].map(|v| Vec3::splat(One, v));
        let from = LightSampleContext { position, normal, receiver: U(0) };
        let sample = table.sample_li(One, None, &from, One.f(0.5), &[One.f(0.5); 2]);
        sample.radiance.mean().0 / sample.pdf.0
    }

    #[test]
    fn light_falls_by_the_power_of_the_distance() {
        for distance in [0.5, 2.0, 7.0] {
            let near = |found: f32, right: f32| assert!((found / right - 1.0).abs() < 1e-5, "{distance}: {found} {right}");
            near(sent(Falloff::NATURAL, distance), distance.powi(-2));
            near(sent(Falloff { power: 1, smooth: 0.0 }, distance), 1.0 / distance);
            near(sent(Falloff { power: 2, smooth: 0.0 }, distance), 1.0);
            near(sent(Falloff { power: 0, smooth: 3.0 }, distance), 1.0 / (distance * distance + 3.0));
        }
    }
}
