//! Vertex masks: how much of a vertex, its ring and its crease goes into its child or its limit position.

use super::split::reduced;
use super::topology::Level;

/// Weights of one vertex: `own` × itself + `ring` × the sum over its ring + `crease` × the sum of its crease's ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct VertexMask {
    pub(crate) own: f32,
    pub(crate) ring: f32,
    pub(crate) crease: f32,
    pub(crate) ends: [u32; 2],
}

/// (own, ring) weights of a smooth interior vertex of a valence.
pub(crate) type SmoothWeights = fn(u32) -> (f32, f32);

/// (own, crease) weights of a crease vertex: cubic B-spline subdivision, and its limit.
const CREASE_REFINED: (f32, f32) = (0.75, 0.125);
const CREASE_LIMIT: (f32, f32) = (2.0 / 3.0, 1.0 / 6.0);

#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
    Smooth,
    Crease,
    Corner,
}

/// Sharp edges around one vertex at one level.
#[derive(Clone, Copy, Default)]
struct Creasing {
    count: u32,
    ends: [u32; 2],
}

impl Creasing {
    fn push(&mut self, end: u32) {
        if let Some(slot) = self.ends.get_mut(self.count as usize) {
            *slot = end;
        }
        self.count += 1;
    }

    /// Smooth covers darts: one sharp edge does not hold a vertex.
    fn rule(&self, vertex_sharpness: f32) -> Rule {
        match self.count {
            _ if vertex_sharpness > 0.0 => Rule::Corner,
            0 | 1 => Rule::Smooth,
            2 => Rule::Crease,
            _ => Rule::Corner,
        }
    }
}

/// What is around one vertex.
#[derive(Clone, Copy, Default)]
struct Neighbourhood {
    edges: u32,
    faces: u32,
    here: Creasing,
    /// As the children of the edges will be.
    below: Creasing,
    /// Sum and number of the sharpnesses that end with this level.
    ending_sum: f32,
    ending_count: f32,
}

/// Masks from a level to the next. Where sharpness ends between two levels the masks of both are blended by the mean
/// of the ending sharpnesses (DeRose et al. 1998; the rule of OpenSubdiv's uniform creasing).
pub(crate) fn refinement_masks(level: &Level, smooth: SmoothWeights) -> Vec<VertexMask> {
    let around = neighbourhoods(level);
    let mask_of = |(around, &sharpness): (&Neighbourhood, &f32)| {
        let above = around.here.rule(sharpness);
        let below = around.below.rule(reduced(sharpness));
        let mask = rule_mask(above, around, &around.here, smooth, CREASE_REFINED);
        if above == Rule::Smooth || above == below {
            return mask;
        }
        let vertex_ends = sharpness > 0.0 && reduced(sharpness) == 0.0;
        let (sum, count) =
            if vertex_ends { (around.ending_sum + sharpness, around.ending_count + 1.0) } else { (around.ending_sum, around.ending_count) };
        let weight = if count > 0.0 { (sum / count).min(1.0) } else { 0.0 };
        blend(mask, weight, rule_mask(below, around, &around.below, smooth, CREASE_REFINED))
    };
    around.iter().zip(&level.vertex_sharpness).map(mask_of).collect()
}

/// Masks from a level to the limit surface, its sharp edges taken as sharp for ever.
pub(crate) fn limit_masks(level: &Level, smooth: SmoothWeights) -> Vec<VertexMask> {
    let around = neighbourhoods(level);
    let mask_of =
        |(around, &sharpness): (&Neighbourhood, &f32)| rule_mask(around.here.rule(sharpness), around, &around.here, smooth, CREASE_LIMIT);
    around.iter().zip(&level.vertex_sharpness).map(mask_of).collect()
}

fn neighbourhoods(level: &Level) -> Vec<Neighbourhood> {
    let mut around = vec![Neighbourhood::default(); level.vertex_count];
    for &vertex in &level.corner_vertex {
        around[vertex as usize].faces += 1;
    }
    for (&[a, b], &sharpness) in level.edge_vertices.iter().zip(&level.edge_sharpness) {
        for (vertex, end) in [(a, b), (b, a)] {
            let entry = &mut around[vertex as usize];
            entry.edges += 1;
            if sharpness > 0.0 {
                entry.here.push(end);
                if reduced(sharpness) > 0.0 {
                    entry.below.push(end);
                }
                if sharpness <= 1.0 {
                    entry.ending_sum += sharpness;
                    entry.ending_count += 1.0;
                }
            }
        }
    }
    around
}

fn rule_mask(rule: Rule, around: &Neighbourhood, creasing: &Creasing, smooth: SmoothWeights, crease: (f32, f32)) -> VertexMask {
    match rule {
        // A smooth vertex without a full ring is degenerate (or lone) and stays where it is.
        Rule::Smooth if around.edges == around.faces && around.faces >= 2 => {
            let (own, ring) = smooth(around.faces);
            VertexMask { own, ring, ..VertexMask::default() }
        }
        Rule::Crease => VertexMask { own: crease.0, ring: 0.0, crease: crease.1, ends: creasing.ends },
        Rule::Smooth | Rule::Corner => VertexMask { own: 1.0, ..VertexMask::default() },
    }
}

fn blend(above: VertexMask, weight: f32, below: VertexMask) -> VertexMask {
    let rest = 1.0 - weight;
    VertexMask {
        own: weight * above.own + rest * below.own,
        ring: weight * above.ring + rest * below.ring,
        crease: weight * above.crease + rest * below.crease,
        // At most one of the two has a crease.
        ends: if above.crease > 0.0 { above.ends } else { below.ends },
    }
}

/// Applies masks to elements, `ring` being the sum over each vertex's ring.
pub(crate) fn apply<const N: usize>(masks: &[VertexMask], values: &[[f32; N]], ring: &[[f32; N]], out: &mut Vec<[f32; N]>) {
    for ((mask, value), sum) in masks.iter().zip(values).zip(ring) {
        let mut result = *value;
        if mask.own != 1.0 {
            for k in 0..N {
                result[k] = mask.own * value[k] + mask.ring * sum[k];
            }
            if mask.crease > 0.0 {
                let [a, b] = mask.ends.map(|end| values[end as usize]);
                for k in 0..N {
                    result[k] += mask.crease * (a[k] + b[k]);
                }
            }
        }
        out.push(result);
    }
}
