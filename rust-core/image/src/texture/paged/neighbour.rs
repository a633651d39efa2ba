//! Texels told from their neighbours: what is left is near zero where a picture is smooth.

/// What a texel of a channel is told from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Neighbour {
    /// Nothing: all are the same.
    Constant = 0,
    /// The texel above.
    Above = 1,
    /// The texel to the left.
    Left = 2,
    /// The sum of these two less the texel between them.
    Both = 3,
}

/// Those that are tried where a channel varies.
pub(super) const TRIED: [Neighbour; 3] = [Neighbour::Above, Neighbour::Both, Neighbour::Left];

/// What texels of `bits` bits differ from their neighbours by, near zero on either side as small numbers. The first row knows the left
/// only, the first column the texel above only.
pub(super) fn differences(plane: &[u32], width: usize, neighbour: Neighbour, bits: u32) -> Vec<u32> {
    let spare = u32::BITS - bits;
    let tell = |value: u32, from: u32| {
        let difference = (value.wrapping_sub(from) << spare) as i32 >> spare;
        (difference << 1 ^ difference >> 31) as u32 & (u32::MAX >> spare)
    };
    let mut told = vec![0; plane.len()];
    let (first, rest) = told.split_at_mut(width);
    first[0] = tell(plane[0], 0);
    let lefts = first[1..].iter_mut().zip(&plane[1..width]).zip(plane);
    lefts.for_each(|((told, value), left)| *told = tell(*value, *left));
    let rows = plane.chunks_exact(width);
    for ((told, row), above) in rest.chunks_exact_mut(width).zip(rows.clone().skip(1)).zip(rows) {
        told[0] = tell(row[0], above[0]);
        let texels = told[1..].iter_mut().zip(&row[1..]);
        match neighbour {
            Neighbour::Left => texels.zip(row).for_each(|((told, value), left)| *told = tell(*value, *left)),
            Neighbour::Both => {
                let around = texels.zip(row).zip(above[1..].iter().zip(above));
                around.for_each(|(((told, value), left), (above, between))| {
                    *told = tell(*value, left.wrapping_add(*above).wrapping_sub(*between));
                });
            }
            Neighbour::Constant | Neighbour::Above => {
                texels.zip(&above[1..]).for_each(|((told, value), above)| *told = tell(*value, *above))
            }
        }
    }
    told
}

/// The texels of [`differences`]; bits above those of the channel may be anything.
pub(super) fn restore(plane: &mut [u32], width: usize, neighbour: Neighbour) {
    plane.iter_mut().for_each(|told| *told = *told >> 1 ^ (*told & 1).wrapping_neg());
    let (mut above, rest) = plane.split_at_mut(width.min(plane.len()));
    sum_up(above);
    for row in rest.chunks_mut(width) {
        match neighbour {
            Neighbour::Left => {
                row[0] = row[0].wrapping_add(above[0]);
                sum_up(row);
            }
            Neighbour::Both => {
                sum_up(row);
                add(row, above);
            }
            Neighbour::Constant | Neighbour::Above => add(row, above),
        }
        above = row;
    }
}

/// Adds the numbers of another row.
pub(super) fn add(row: &mut [u32], other: &[u32]) {
    row.iter_mut().zip(other).for_each(|(value, other)| *value = value.wrapping_add(*other));
}

fn sum_up(row: &mut [u32]) {
    let mut sum = 0_u32;
    for value in row {
        sum = sum.wrapping_add(*value);
        *value = sum;
    }
}
