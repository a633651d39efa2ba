//! How far numbers of a field come as it flows: bounds of its bricks, for all times of the shutter.

use super::{ROW, places};

/// Cells along a brick's edge.
const EDGE: f32 = 8.0;
/// More bricks than these are not looked at for the bound of one: that of all of them serves.
const MOST_LOOKED_AT: usize = 4096;

/// The flow of a field, by its first bricks along x, y and z.
pub(super) struct Spread {
    pub(super) bricks: [usize; 3],
    pub(super) flow: [u32; 3],
    /// From the time at which its numbers hold to the shutter's opening and closing.
    pub(super) times: [f32; 2],
}

/// A box of bricks, least and greatest along each axis, both within.
type Region = [[usize; 2]; 3];

impl Spread {
    /// Raises the greatest values of the bricks from `first` on to those of all numbers that may come there.
    pub(super) fn apply(&self, first: u32, bounds: &mut [f32]) {
        let most_of = |brick: usize| bounds[(first as usize + brick) * ROW + 2];
        let count: usize = self.bricks.iter().product();
        let most_of_all = (0..count).map(most_of).fold(0.0, f32::max);
        let raised = places(self.bricks).map(|place| {
            // Where numbers come from is looked up by the flow where they come from: twice, as lookups do.
            let here = place.map(|n| [n, n]);
            let region = self.back(place, here, bounds).and_then(|first| self.back(place, first, bounds));
            region.map_or(most_of_all, |region| self.each(region).map(most_of).fold(0.0, f32::max))
        });
        let raised: Vec<f32> = raised.collect();
        for (brick, most) in raised.into_iter().enumerate() {
            bounds[(first as usize + brick) * ROW + 2] = most;
        }
    }

    /// Where numbers of a brick come from by the flows within a region; `None` where that are too many bricks.
    fn back(&self, place: [usize; 3], region: Region, bounds: &[f32]) -> Option<Region> {
        let along = |axis: usize| {
            let row = |brick: usize| &bounds[(self.flow[axis] as usize + brick) * ROW..][..ROW];
            let range = self.each(region).map(row).fold([f32::MAX, f32::MIN], |[low, high], row| [low.min(row[0]), high.max(row[2])]);
            let ways = self.times.map(|time| range.map(|speed| -speed * time));
            let [low, high] = ways.as_flattened().iter().fold([0.0f32; 2], |[low, high], way| [low.min(*way), high.max(*way)]);
            let (start, last) = (place[axis] as f32 * EDGE, (self.bricks[axis] - 1) as f32);
            [(start + low) / EDGE, (start + EDGE + high) / EDGE].map(|brick| brick.floor().clamp(0.0, last) as usize)
        };
        let found = [0, 1, 2].map(along);
        let count: usize = found.iter().map(|[low, high]| high - low + 1).product();
        (count <= MOST_LOOKED_AT).then_some(found)
    }

    /// The numbers of the bricks of a region.
    fn each(&self, [x, y, z]: Region) -> impl Iterator<Item = usize> {
        let [_, ny, nz] = self.bricks;
        (x[0]..=x[1]).flat_map(move |x| (y[0]..=y[1]).flat_map(move |y| (z[0]..=z[1]).map(move |z| (x * ny + y) * nz + z)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_what_comes_from_bricks_beside_them() {
        // Four bricks along x, of which the first is dense; all flows by 12 cells along x from the time of the numbers on.
        let (bricks, mut bounds) = ([4, 1, 1], vec![0.0; 16 * ROW]);
        bounds[2] = 5.0;
        (4..8).for_each(|brick| (bounds[brick * ROW], bounds[brick * ROW + 2]) = (12.0, 12.0));
        Spread { bricks, flow: [4, 8, 8], times: [0.0, 1.0] }.apply(0, &mut bounds);
        let most: Vec<f32> = (0..4).map(|brick| bounds[brick * ROW + 2]).collect();
        assert_eq!(most, [5.0, 5.0, 5.0, 0.0]);
    }
}
