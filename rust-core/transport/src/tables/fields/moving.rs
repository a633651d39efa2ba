//! Fields that move while the shutter is open: where their lattices lie, by time.

use gonio_simd::motion::{Motion, Rows};
use gonio_simd::{F, Lanes, PADDING, U};

/// A field that moves with what holds it.
#[derive(Clone, Debug)]
struct MovingField {
    /// From the space of what holds it to the rebased world.
    motion: Motion,
    /// From there to the lattice.
    to_lattice: Rows,
}

/// Fields that move, by their rows.
#[derive(Clone, Debug, Default)]
pub struct MovingFields(Vec<Option<Box<MovingField>>>);

/// A map to a lattice, of each lane: a row an axis, three factors and what is added.
type Maps<L> = [[F<L>; 4]; 3];

impl MovingFields {
    /// Whether none moves.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds the field of a row: the motion of what holds it, in the rebased world, and the map from there to the lattice.
    pub fn add(&mut self, row: u32, motion: Motion, to_lattice: Rows) {
        let row = row as usize;
        self.0.resize_with(self.0.len().max(row + 1), || None);
        self.0[row] = Some(Box::new(MovingField { motion, to_lattice }));
    }

    /// Puts the maps of those that move in place of others, by their rows and times.
    #[inline(always)]
    pub(crate) fn place<L: Lanes>(&self, field: U<L>, time: F<L>, maps: Maps<L>) -> Maps<L> {
        let l = time.lanes();
        let (mut fields, mut times, mut placed) = ([0; PADDING], [0.0; PADDING], [[[0.0; PADDING]; 4]; 3]);
        field.store(&mut fields, 0);
        time.store(&mut times, 0);
        for (map, out) in maps.as_flattened().iter().zip(placed.as_flattened_mut()) {
            map.store(out, 0);
        }
        for lane in 0..L::COUNT {
            let Some(Some(moving)) = self.0.get(fields[lane] as usize) else { continue };
            for (out, value) in placed.as_flattened_mut().iter_mut().zip(moving.at(times[lane]).as_flattened()) {
                out[lane] = *value;
            }
        }
        placed.each_ref().map(
            #[inline(always)]
            |row| {
                row.each_ref().map(
                    #[inline(always)]
                    |values| l.load(values, 0),
                )
            },
        )
    }
}

impl MovingField {
    /// From the rebased world to the lattice at a time.
    fn at(&self, time: f32) -> [[f32; 4]; 3] {
        // Flat for a moment: nothing is there.
        let Some(inverse) = self.motion.inverse_at(time) else { return [[0.0, 0.0, 0.0, -1.0]; 3] };
        self.to_lattice.map(|[a, b, c, added]| {
            let column = |k: usize| a * inverse[0][k] + b * inverse[1][k] + c * inverse[2][k];
            [column(0), column(1), column(2), column(3) + added].map(|x| x as f32)
        })
    }
}
