//! Shadow catchers: what is behind them, dimmed by how much less light they send than they would without the objects.

use super::develop::{Developing, Part};
use crate::{camera::sampler::BATCH, colour::luminance, scene::Aov, transport::TileSums};

/// Copies what a worker gathered to a block's channels.
pub(super) fn fill(channels: &mut [f32], gathered: &TileSums) {
    let Some((coverage, behind)) = gathered.catchers.sums() else { return };
    let halves = (2..4).flat_map(|half| gathered.radiance.iter().map(move |column| &column[half * BATCH..(half + 1) * BATCH]));
    let rest = behind.iter().chain([coverage]).map(|column| &column[..BATCH]);
    channels.chunks_exact_mut(BATCH).zip(halves.chain(rest)).for_each(|(out, values)| out.copy_from_slice(values));
}

/// Adds to the pixels of a tile what catchers show there; `first` is the first of their channels.
pub(super) fn show(aov: Aov, tile: &Developing<'_>, first: usize, exposure: f32, part: &mut Part<'_>) {
    if aov == Aov::ShadowCatcher {
        return show_shadow(tile, first, part);
    }
    if !matches!(aov, Aov::Color | Aov::Alpha | Aov::Luminance) {
        return;
    }
    part.for_each(|code, values| {
        let scale = tile.scale(code);
        let sum = |channel: usize| tile.sums[(first + channel) * BATCH + code];
        let three = |channel: usize| [0, 1, 2].map(|c| sum(channel + c));
        let lit = lit_share(three(0), three(3));
        let behind = three(6).map(|x| x * scale * lit);
        let alpha = sum(9) * scale * (1.0 - lit);
        match aov {
            Aov::Color => {
                let shown = behind.map(|x| x * f64::from(exposure)).into_iter().chain([alpha]);
                values.iter_mut().zip(shown).for_each(|(value, shown)| *value += shown as f32);
            }
            Aov::Alpha => values[0] += alpha as f32,
            _ => values[0] += luminance(behind) as f32,
        }
    });
}

/// Shows what of the light the objects leave, channel by channel.
fn show_shadow(tile: &Developing<'_>, first: usize, part: &mut Part<'_>) {
    part.for_each(|code, values| {
        for (channel, value) in values.iter_mut().enumerate() {
            let [with, without] = [0, 3].map(|half| tile.sums[(first + half + channel) * BATCH + code]);
            *value = if without > 0.0 { (with / without) as f32 } else { 1.0 };
        }
    });
}

/// How much of the light that a catcher would send is there in spite of the objects, 0 to 1: the mean over the channels that have any, as
/// Cycles takes it; 0 where there is no light at all.
fn lit_share(with: [f64; 3], without: [f64; 3]) -> f64 {
    let shares = with.iter().zip(without).filter(|(_, all)| *all > 0.0).map(|(part, all)| part / all);
    let (sum, channels) = shares.fold((0.0, 0_u8), |(sum, channels), share| (sum + share, channels + 1));
    (sum / f64::from(channels.max(1))).min(1.0)
}
