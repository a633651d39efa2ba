//! What a ray looks for: the callbacks that take its hits, and the queries that say where the results go.

use crate::ray::{Hit, Hits, NONE, Passed, TransparentHit, are_near};

/// Takes the hits of one ray as they are found.
pub(crate) trait HitCallback {
    /// True when near hits shorten the search.
    const ORDERED: bool;
    /// Hits beyond this distance are not wanted.
    fn t_max(&self) -> f32;
    /// Takes a hit within the interval; true ends the search.
    fn add(&mut self, hit: Hit, transparent: bool) -> bool;
    /// [`HitCallback::add`] for a hit on curves or points; `leaves` tells the distance where the ray leaves what it has hit.
    #[inline(always)]
    fn add_smooth(&mut self, hit: Hit, _leaves: impl FnOnce() -> f32, transparent: bool) -> bool {
        self.add(hit, transparent)
    }
}

/// What the rays of a batch look for.
pub(crate) trait RayQuery {
    /// Collects for one ray, and for the next one after that.
    type Callback: HitCallback;
    /// A callback without a ray.
    fn callback(&self) -> Self::Callback;
    /// Has a callback begin with ray `i`.
    fn begin(&self, callback: &mut Self::Callback, i: usize, t_max: f32);
    /// Takes what was found for ray `i`; `ended` when the callback ended the search.
    fn end(&mut self, i: usize, callback: &Self::Callback, ended: bool);
}

/// Keeps the nearest hit.
pub(crate) struct Nearest(pub(crate) Hit);

impl HitCallback for Nearest {
    const ORDERED: bool = true;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.0.t
    }

    #[inline(always)]
    fn add(&mut self, hit: Hit, _transparent: bool) -> bool {
        // Equal distances go to the lower instance and its higher primitive, so that the order of traversal does not show: of faces that lie on each
        // other in a mesh the last is seen, as in Cycles.
        if hit.t < self.0.t || (hit.t == self.0.t && (hit.instance, !hit.primitive) < (self.0.instance, !self.0.primitive)) {
            self.0 = hit;
        }
        false
    }
}

/// The nearest hit of every ray.
pub(crate) struct NearestHits<'a>(&'a mut Hits);

impl<'a> NearestHits<'a> {
    /// Of `n` rays.
    pub(crate) fn new(hits: &'a mut Hits, n: usize) -> Self {
        hits.resize(n);
        NearestHits(hits)
    }
}

impl RayQuery for NearestHits<'_> {
    type Callback = Nearest;

    fn callback(&self) -> Nearest {
        Nearest(Hit::miss(0.0))
    }

    #[inline(always)]
    fn begin(&self, nearest: &mut Nearest, _i: usize, t_max: f32) {
        nearest.0 = Hit::miss(t_max);
    }

    #[inline(always)]
    fn end(&mut self, i: usize, nearest: &Nearest, _ended: bool) {
        self.0.set(i, &nearest.0);
    }
}

/// Keeps the nearest hit beyond what the ray has passed.
pub(crate) struct Beyond {
    nearest: Nearest,
    passed: Passed,
}

impl Beyond {
    /// Of a ray that has passed something and has a hit.
    #[inline(always)]
    pub(crate) fn new(hit: Hit, passed: Passed) -> Self {
        Self { nearest: Nearest(hit), passed }
    }

    /// The nearest hit so far.
    #[inline(always)]
    pub(crate) fn nearest(&self) -> Hit {
        self.nearest.0
    }
}

impl HitCallback for Beyond {
    const ORDERED: bool = true;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.nearest.t_max()
    }

    #[inline(always)]
    fn add(&mut self, hit: Hit, transparent: bool) -> bool {
        !self.passed.covers(&hit) && self.nearest.add(hit, transparent)
    }
}

/// The nearest hit of every ray beyond what it has passed.
pub(crate) struct HitsBeyond<'a> {
    passed: &'a [Passed],
    hits: NearestHits<'a>,
}

impl<'a> HitsBeyond<'a> {
    /// Of as many rays as have an entry.
    pub(crate) fn new(passed: &'a [Passed], hits: &'a mut Hits) -> Self {
        HitsBeyond { passed, hits: NearestHits::new(hits, passed.len()) }
    }
}

impl RayQuery for HitsBeyond<'_> {
    type Callback = Beyond;

    fn callback(&self) -> Beyond {
        Beyond { nearest: self.hits.callback(), passed: Passed::NOTHING }
    }

    #[inline(always)]
    fn begin(&self, beyond: &mut Beyond, i: usize, t_max: f32) {
        self.hits.begin(&mut beyond.nearest, i, t_max);
        beyond.passed = self.passed[i];
    }

    #[inline(always)]
    fn end(&mut self, i: usize, beyond: &Beyond, ended: bool) {
        self.hits.end(i, &beyond.nearest, ended);
    }
}

/// Ends at the first hit.
pub(crate) struct Any {
    pub(crate) t_max: f32,
}

impl HitCallback for Any {
    const ORDERED: bool = false;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn add(&mut self, _hit: Hit, _transparent: bool) -> bool {
        true
    }
}

/// 1 for every ray that hits anything, else 0.
pub(crate) struct Occluded<'a>(pub(crate) &'a mut [u8]);

impl RayQuery for Occluded<'_> {
    type Callback = Any;

    fn callback(&self) -> Any {
        Any { t_max: 0.0 }
    }

    #[inline(always)]
    fn begin(&self, any: &mut Any, _i: usize, t_max: f32) {
        any.t_max = t_max;
    }

    #[inline(always)]
    fn end(&mut self, i: usize, _any: &Any, ended: bool) {
        self.0[i] = u8::from(ended);
    }
}

/// Ends at the first opaque hit and keeps the transparent ones.
pub(crate) struct UntilOpaque {
    t_max: f32,
    ray: u32,
    hits: Vec<TransparentHit>,
    /// Those on curves and points, with the distances where the ray leaves what it has hit.
    smooth: Vec<(TransparentHit, f32)>,
}

impl HitCallback for UntilOpaque {
    const ORDERED: bool = false;

    #[inline(always)]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn add(&mut self, hit: Hit, transparent: bool) -> bool {
        if transparent {
            let Hit { t, u, v, primitive, instance } = hit;
            let hit = TransparentHit { ray: self.ray, instance, primitive, u, v, t };
            if self.hits.iter().any(|known| (known.primitive, known.instance) == (primitive, instance)) {
                // Long triangles lie in several leaves.
                return false;
            }
            match hit.is_on_edge().then(|| self.twin(&hit)).flatten() {
                // The lower number, so that the order of traversal does not show.
                Some(twin) if hit.primitive < self.hits[twin].primitive => self.hits[twin] = hit,
                Some(_) => {}
                None => self.hits.push(hit),
            }
        }
        !transparent
    }

    #[inline(always)]
    fn add_smooth(&mut self, hit: Hit, leaves: impl FnOnce() -> f32, transparent: bool) -> bool {
        if transparent {
            let Hit { t, u, v, primitive, instance } = hit;
            self.smooth.push((TransparentHit { ray: self.ray, instance, primitive, u, v, t }, leaves()));
        }
        !transparent
    }
}

/// Pieces whose numbers are as near as this are thought to be of one strand.
const NEAR_PIECES: u32 = 32;

impl UntilOpaque {
    /// Whether a hit lies within a neighbouring piece that the ray has entered before: pieces of a strand overlap where it bends.
    fn is_within(&self, hit: &TransparentHit) -> bool {
        self.smooth.iter().any(|(other, leaves)| {
            let before = other.t < hit.t || (other.t == hit.t && other.primitive < hit.primitive);
            before && *leaves >= hit.t && other.instance == hit.instance && other.primitive.abs_diff(hit.primitive) <= NEAR_PIECES
        })
    }

    /// The place of a hit on the same edge, which two triangles share: the surface is passed once.
    fn twin(&self, hit: &TransparentHit) -> Option<usize> {
        let is_twin = |known: &TransparentHit| known.instance == hit.instance && known.is_on_edge() && are_near(hit.t, known.t);
        self.hits.iter().position(is_twin)
    }
}

/// [`Occluded`] by opaque instances alone, and the hits of all other rays on transparent ones.
pub(crate) struct AnyHitTransparent<'a> {
    pub(crate) occluded: &'a mut [u8],
    pub(crate) transparent: &'a mut Vec<TransparentHit>,
}

impl RayQuery for AnyHitTransparent<'_> {
    type Callback = UntilOpaque;

    fn callback(&self) -> UntilOpaque {
        UntilOpaque { t_max: 0.0, ray: NONE, hits: Vec::new(), smooth: Vec::new() }
    }

    #[inline(always)]
    fn begin(&self, until_opaque: &mut UntilOpaque, i: usize, t_max: f32) {
        (until_opaque.t_max, until_opaque.ray) = (t_max, i as u32);
        until_opaque.hits.clear();
        until_opaque.smooth.clear();
    }

    #[inline(always)]
    fn end(&mut self, i: usize, until_opaque: &UntilOpaque, ended: bool) {
        self.occluded[i] = u8::from(ended);
        if !ended {
            self.transparent.extend_from_slice(&until_opaque.hits);
            if !until_opaque.smooth.is_empty() {
                let seen = until_opaque.smooth.iter().filter(|(hit, _)| !until_opaque.is_within(hit));
                self.transparent.extend(seen.map(|(hit, _)| *hit));
            }
        }
    }
}
