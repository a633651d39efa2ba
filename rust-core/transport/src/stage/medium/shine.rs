//! Light that media send along the ways of paths (pbrt's `Le`).

use super::context::MediumContext;
use super::flight::left_where_flights_pass;
use super::way::Way;
use crate::accumulate::deposit::{Contribution, Deposits, Source, code_of_found};
use crate::accumulate::expression_sums::with_state;
use crate::accumulate::guides::is_specular_path;
use crate::media::track::Track;
use crate::words::{code, flag};
use gonio_simd::{F, Lanes, M, Spectrum, U};

/// Optical depths below this are as good as none.
const THIN: f32 = 1e-3;

/// Adds it: the whole of a way through even media, in closed form, whether its path scatters on it or not.
#[inline(always)]
pub(super) fn add<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>, chosen: M<L>, deposits: &mut Deposits) {
    let l = way.pdf.lanes();
    let media = context.media(l, way.core.slot);
    let rows = way.core.media.rows();
    let mut parts = [Spectrum::zero(l); 4];
    for (part, row) in parts.iter_mut().zip(rows) {
        let Some(row) = row else { continue };
        *part = media.emission(l, row).keep_if(ends(context, way, row));
    }
    let lit = chosen & parts.iter().fold(l.m(false), |lit, part| lit | part.is_lit());
    if lit.any() {
        let seen = seen_length(way) * way.core.throughput;
        deposit(context, (way, middle(way)), parts.map(|part| part * seen), lit, deposits);
    }
}

/// Ways on which a medium ends, and those through what fills all of space: where a path has lost its way out of a mesh, nothing shines without end.
#[inline(always)]
fn ends<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>, row: U<L>) -> M<L> {
    way.met | row.eq(context.tables.materials.media.everywhere)
}

/// What a metre of each medium sends at a place of ways through some that vary, dimmed by the even ones before it, where a flight through these comes
/// there.
#[inline(always)]
pub(super) fn sent<L: Lanes>(context: &MediumContext<'_>, way: &Way<L>, track: &Track<'_, L>, place: F<L>) -> [Spectrum<L>; 4] {
    let l = place.lanes();
    let media = context.media(l, way.core.slot);
    let mut parts = track.emission(place);
    for (part, row) in parts.iter_mut().zip(way.core.media.rows()) {
        let Some(row) = row else { continue };
        *part += media.emission(l, row).keep_if(media.table.field(l, row).eq(0) & ends(context, way, row));
    }
    let left = left_where_flights_pass(way, (place - way.from).max(0.0));
    parts.map(|part| part * left)
}

/// Adds light of each medium that comes along ways, in the mean from so many metres of them: together, or apart where light groups or expressions ask.
#[inline(always)]
pub(super) fn deposit<L: Lanes>(
    context: &MediumContext<'_>,
    (way, middle): (&Way<L>, F<L>),
    parts: [Spectrum<L>; 4],
    chosen: M<L>,
    deposits: &mut Deposits,
) {
    let (l, transport) = (way.pdf.lanes(), context.transport);
    if !transport.passes.groups.wanted() && transport.passes.expressions.is_none() {
        let [a, b, c, d] = parts;
        deposit_part(context, (way, middle), (a + b + c + d, Source::Several), chosen, deposits);
        return;
    }
    for (part, row) in parts.into_iter().zip(way.core.media.rows()) {
        let Some(row) = row else { continue };
        let source = Source::Set(context.tables.materials.media.set(l, row));
        deposit_part(context, (way, middle), (part, source), chosen & part.is_lit(), deposits);
    }
}

#[inline(always)]
fn deposit_part<L: Lanes>(
    context: &MediumContext<'_>,
    (way, middle): (&Way<L>, F<L>),
    (light, source): (Spectrum<L>, Source<L>),
    chosen: M<L>,
    deposits: &mut Deposits,
) {
    let transport = context.transport;
    let value = transport.limits.clamped(light, way.bounces());
    let flags = way.core.flags;
    let light = Contribution {
        slot: way.core.slot,
        value,
        code: with_state(&transport.passes, code_of_found(flags, code::EMISSION), flags),
        shares: None,
        specular: is_specular_path(flags, way.core.slot),
        source,
    };
    let lit = chosen & value.is_lit();
    deposits.deposit(transport, &light, lit);
    if let Some(distance) = transport.passes.deep {
        let depth = transport.deep_depth(distance, way.place(middle.clamp(0.0, way.length)));
        let film = deposits.to_film(way.core.slot, value);
        deposits.sums.deep.add_light(way.core.slot, depth, film, lit & (flags & flag::CAMERA).ne(0));
    }
}

/// Metres of each way from which what an even medium sends along it comes in the mean: 1/σ − d T / (1 − T).
#[inline(always)]
fn middle<L: Lanes>(way: &Way<L>) -> F<L> {
    let (length, extinction) = (way.length, way.extinction.mean());
    let left = (-(extinction * length)).exp();
    let thick = extinction.max(f32::MIN_POSITIVE).recip() - length * left / (1.0 - left).max(f32::MIN_POSITIVE);
    (extinction * length).lt(THIN).select(length * 0.5, thick)
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
