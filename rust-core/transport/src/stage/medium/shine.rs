//! Light that media send along the ways of paths.

use super::context::MediumContext;
use super::way::Way;
use crate::accumulate::deposit::{Contribution, Deposits, Source, code_of_found};
use crate::accumulate::expression_sums::with_state;
use crate::accumulate::guides::is_specular_path;
use crate::words::code;
use gonio_simd::{F, Lanes, Spectrum};

/// Optical depths below this are as good as none.
const THIN: f32 = 1e-3;

/// Adds it: the whole of a way, in closed form, whether its path scatters on it or not.
#[inline(always)]
pub(super) fn add<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>, deposits: &mut Deposits) {
    let (l, transport) = (way.pdf.lanes(), context.transport);
    let media = &context.tables.materials.media;
    let mut emission = Spectrum::zero(l);
    for row in way.core.media.rows().into_iter().flatten() {
        emission += media.emission(l, row);
    }
    let lit = way.alive & emission.is_lit();
    if !lit.any() {
        return;
    }
    let value = transport.limits.clamped(emission * seen_length(way) * way.core.throughput, way.bounces());
    let flags = way.core.flags;
    let light = Contribution {
        slot: way.core.slot,
        value,
        code: with_state(transport.passes.expressions.as_deref(), code_of_found(flags, code::EMISSION), flags),
        shares: None,
        specular: is_specular_path(flags, way.core.slot),
        source: Source::Several,
    };
    deposits.deposit(transport, &light, lit);
}

/// Metres of each way that are seen from its beginning: (1 − T) / σ.
#[inline(always)]
fn seen_length<L: Lanes>(way: &Way<L>) -> Spectrum<L> {
    let length = way.length;
    let [seen] = way.extinction.zip(
        way.transmittance(length),
        #[inline(always)]
        |extinction, left| [seen(extinction, left, length)],
    );
    seen
}

#[inline(always)]
fn seen<L: Lanes>(extinction: F<L>, left: F<L>, length: F<L>) -> F<L> {
    let depth = extinction * length;
    // The difference of nearly equal numbers would be rounded away.
    let thin = length * (1.0 - depth * 0.5);
    depth.lt(THIN).select(thin, (1.0 - left) / extinction.max(f32::MIN_POSITIVE))
}
