//! Three columns side by side: vectors and colours.

use gonio_simd::{Column, Lanes, M, U, Vec3};

pub(crate) type Columns3 = [Column; 3];

pub(crate) fn columns3(len: usize) -> Columns3 {
    [Column::new(len), Column::new(len), Column::new(len)]
}

#[inline(always)]
pub(crate) fn load3<L: Lanes>(l: L, columns: &Columns3, at: usize) -> Vec3<L> {
    Vec3::load(l, [&columns[0], &columns[1], &columns[2]], at)
}

#[inline(always)]
pub(crate) fn gather3<L: Lanes>(l: L, columns: &Columns3, index: U<L>) -> Vec3<L> {
    Vec3::new(l.gather(&columns[0], index), l.gather(&columns[1], index), l.gather(&columns[2], index))
}

#[inline(always)]
pub(crate) fn append3<L: Lanes>(v: Vec3<L>, mask: M<L>, columns: &mut Columns3, len: usize) {
    let [x, y, z] = columns;
    v.x.append(mask, x, len);
    v.y.append(mask, y, len);
    v.z.append(mask, z, len);
}

/// Adds to each column another one's values times a factor.
pub(crate) fn add_scaled(to: &mut Columns3, from: &Columns3, factor: f32) {
    for (to, from) in to.iter_mut().zip(from) {
        to.iter_mut().zip(from.iter()).for_each(|(to, from)| *to += from * factor);
    }
}
