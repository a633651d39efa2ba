//! Shadow linking: shadow rays to lights that some instances alone block.
//!
//! One kind of such lights goes by a visibility bit, as all other shadow rays. Rays to others pass at the hit what does not block them.

use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::queue::shadow_trace::{LinkedTrace, ShadowTrace};
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::ray_mask;

/// Finds which rays are blocked by what blocks their light, and what the others pass.
pub(crate) fn occlude(tables: &Tables, transport: &Transport, coherent: bool, shadows: &ShadowRays, trace: &mut ShadowTrace) {
    let ShadowTrace { blocked, passed, linked, .. } = trace;
    for which in [false, true] {
        let LinkedTrace { plain, filtered, rows, rays, blocked: own } = &mut *linked;
        let chosen = if which { &*filtered } else { &*plain };
        rays.select(&shadows.rays, chosen);
        let (batch, own, first) = (rays.batch(0..chosen.len()), &mut own[..chosen.len()], passed.len());
        if which {
            tables.bvh.any_hit_linked(transport.execution, &batch, (&tables.links.blockers, rows), own, passed);
        } else if tables.any_transparent {
            tables.bvh.any_hit_transparent(transport.execution, &batch, own, passed);
        } else {
            let packets = coherent && tables.bvh.has_shadow_packets(transport.execution);
            tables.bvh.occluded(transport.execution, &batch, packets, own);
        }
        passed[first..].iter_mut().for_each(|hit| hit.ray = chosen[hit.ray as usize]);
        chosen.iter().zip(&*own).for_each(|(ray, is_blocked)| blocked[*ray as usize] = *is_blocked);
    }
}

/// Sets visibility bits, and tells the rays apart that hits are filtered for; false if there is none.
pub(crate) fn part(tables: &Tables, shadows: &mut ShadowRays, linked: &mut LinkedTrace) -> bool {
    let links = &tables.links;
    linked.plain.clear();
    linked.filtered.clear();
    linked.rows.clear();
    for ray in 0..shadows.count {
        let row = links.shadows.get(shadows.light[ray] as usize).copied().unwrap_or(0);
        if links.by_mask != 0 {
            shadows.rays.mask[ray] = if row == links.by_mask { ray_mask::LINKED_SHADOW } else { ray_mask::SHADOW };
        }
        if row == 0 || row == links.by_mask {
            linked.plain.push(ray as u32);
        } else {
            linked.filtered.push(ray as u32);
            linked.rows.push(row);
        }
    }
    !linked.filtered.is_empty()
}
