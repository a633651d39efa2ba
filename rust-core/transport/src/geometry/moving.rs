//! Where instances are at the times of hits.

use super::{GeometryTable, HitLanes, NONE};
use gonio_simd::{Lanes, PADDING, Vec3};

impl GeometryTable {
    /// [`GeometryTable::instance_columns`] where some instances move.
    #[inline(always)]
    pub(super) fn moved_columns<L: Lanes>(&self, l: L, hit: &HitLanes<L>) -> ([Vec3<L>; 3], Vec3<L>) {
        let (instances, times) = (hit.instance.to_array(), hit.time.to_array());
        let mut numbers = [[0.0; PADDING]; 12];
        for (lane, (instance, time)) in instances.iter().zip(times).enumerate().take(L::COUNT) {
            for (column, value) in numbers.iter_mut().zip(self.placed(*instance, time)) {
                column[lane] = value;
            }
        }
        let vector = |at: usize| Vec3::new(l.load(&numbers[at], 0), l.load(&numbers[at + 1], 0), l.load(&numbers[at + 2], 0));
        ([vector(0), vector(3), vector(6)], vector(9))
    }

    /// Images of x, y, z and the origin at a time.
    fn placed(&self, instance: u32, time: f32) -> [f32; 12] {
        let at = 12 * instance as usize;
        let mut numbers = [0.0; 12];
        match self.motion_of.get(instance as usize).filter(|motion| **motion != NONE) {
            Some(motion) => {
                let rows = self.motion[*motion as usize].at(time);
                for (place, number) in numbers.iter_mut().enumerate() {
                    *number = rows[place % 3][place / 3] as f32;
                }
            }
            // Lanes beyond the last hit have any number.
            None => numbers.iter_mut().zip(self.instance_transform.get(at..at + 12).unwrap_or_default()).for_each(|(to, from)| *to = *from),
        }
        numbers
    }
}
