//! Triangles divided into equal parts: each into four, again and again, so that four cells in a row are the parts of a larger one.

/// The divisions of a mesh's triangles.
#[derive(Clone, Debug)]
pub struct CellChart {
    /// How many times each triangle is divided.
    levels: Vec<u8>,
    /// First cell of each triangle, and the number of all.
    first: Vec<u32>,
}

/// Most divisions of a triangle: a million cells.
pub(super) const MOST_LEVELS: u8 = 10;

/// Divisions after which a triangle's parts are no larger than wanted.
pub(super) fn levels_for(area: f64, wanted: f64) -> u8 {
    (0..MOST_LEVELS).find(|level| area <= wanted * f64::from(1u32 << (2 * level))).unwrap_or(MOST_LEVELS)
}

/// Cells of triangles of these areas, where none is to be larger than wanted.
pub(super) fn cells_for(areas: &[f64], wanted: f64) -> u64 {
    areas.iter().map(|area| 1u64 << (2 * levels_for(*area, wanted))).sum()
}

impl CellChart {
    /// Divides triangles until their parts are no larger than wanted; there are less than 2³² of them.
    pub(super) fn new(areas: &[f64], wanted: f64) -> Self {
        let levels: Vec<u8> = areas.iter().map(|area| levels_for(*area, wanted)).collect();
        let mut first = Vec::with_capacity(levels.len() + 1);
        let mut count = 0;
        for level in &levels {
            first.push(count);
            count += 1 << (2 * level);
        }
        first.push(count);
        Self { levels, first }
    }

    /// Cells of all triangles.
    pub fn len(&self) -> usize {
        self.first.last().map_or(0, |count| *count as usize)
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// How many times a triangle is divided.
    pub fn level(&self, triangle: usize) -> u8 {
        self.levels[triangle]
    }
    /// Cells of a triangle.
    pub fn cells(&self, triangle: usize) -> std::ops::Range<usize> {
        self.first[triangle] as usize..self.first[triangle + 1] as usize
    }
    /// The cell at barycentric coordinates of corners 1 and 2.
    pub fn cell(&self, triangle: u32, place: [f32; 2]) -> usize {
        let triangle = triangle as usize;
        self.first[triangle] as usize + divided(self.levels[triangle], place).0 as usize
    }
    /// The first cell of the part at a place, where cells were joined to these levels, and the place in that part.
    pub(super) fn part(&self, triangle: u32, place: [f32; 2], levels: &[u8]) -> (usize, [f32; 2]) {
        let level = levels[self.cell(triangle, place)];
        let (code, place) = divided(level, place);
        let triangle = triangle as usize;
        (self.first[triangle] as usize + ((code as usize) << (2 * (self.levels[triangle] - level))), place)
    }
    /// The parts of a triangle whose cells were joined to these levels: the first cell of each, and its corners.
    pub(super) fn parts<'a>(&'a self, triangle: usize, levels: &'a [u8]) -> impl Iterator<Item = (usize, [[f64; 2]; 3])> + 'a {
        let cells = self.cells(triangle);
        let mut cell = cells.start;
        std::iter::from_fn(move || {
            let first = (cell < cells.end).then_some(cell)?;
            let joined = 2 * (self.level(triangle) - levels[first]);
            cell += 1 << joined;
            Some((first, corners(levels[first], ((first - cells.start) >> joined) as u32)))
        })
    }
    /// Bytes of so many triangles'.
    pub(super) fn memory(triangles: u64) -> u64 {
        triangles * 5
    }
}

/// The part of a triangle that a place lies in: parts at corner 0, 1, 2 and the middle one, two bits a division; and the place in that part.
fn divided(level: u8, [mut u, mut v]: [f32; 2]) -> (u32, [f32; 2]) {
    let mut code = 0;
    for _ in 0..level {
        let part;
        (part, u, v) = if u >= 0.5 {
            (1, 2.0 * u - 1.0, 2.0 * v)
        } else if v >= 0.5 {
            (2, 2.0 * u, 2.0 * v - 1.0)
        } else if u + v <= 0.5 {
            (0, 2.0 * u, 2.0 * v)
        } else {
            (3, 1.0 - 2.0 * u, 1.0 - 2.0 * v)
        };
        code = 4 * code + part;
    }
    (code, [u, v])
}

/// Barycentric coordinates (of corners 1 and 2) of the corners of a part.
pub fn corners(level: u8, code: u32) -> [[f64; 2]; 3] {
    let mut corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    for step in (0..level).rev() {
        let [a, b, c] = corners;
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        corners = match code >> (2 * step) & 3 {
            0 => [a, ab, ca],
            1 => [ab, b, bc],
            2 => [ca, bc, c],
            _ => [bc, ca, ab],
        };
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_in_their_cells() {
        for level in 0..5 {
            for number in 0..1u32 << (2 * level) {
                let corners = corners(level, number);
                let middle = [0, 1].map(|k| (corners.iter().map(|corner| corner[k]).sum::<f64>() / 3.0) as f32);
                assert_eq!(divided(level, middle).0, number, "{level} {corners:?}");
                let [a, b, c] = corners;
                let double = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
                assert!((double * f64::from(1u32 << (2 * level)) - 1.0).abs() < 1e-12, "{level} {number}: {double}");
            }
        }
    }

    #[test]
    fn corners_of_corner_cells_come_in_order() {
        // The corner of a triangle belongs to the cell that begins with it.
        for (number, place) in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let cell = divided(3, place.map(|x: f64| x as f32)).0;
            assert_eq!(corners(3, cell)[number], place);
        }
    }

    #[test]
    fn triangles_are_divided_by_their_size() {
        let chart = CellChart::new(&[1.0, 0.0, 16.0, 17.0], 1.0);
        assert_eq!([0, 1, 2, 3].map(|triangle| chart.level(triangle)), [0, 0, 2, 3]);
        assert_eq!((chart.len(), chart.cells(3)), (82, 18..82));
        assert_eq!(cells_for(&[1.0, 0.0, 16.0, 17.0], 1.0), 82);
        assert_eq!(levels_for(1.0, 0.0), MOST_LEVELS);
    }
}
