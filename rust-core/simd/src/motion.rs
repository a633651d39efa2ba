//! Affine maps that change over the shutter: keys at evenly spaced times, and the map at a time between two of them.
//!
//! Scalar and in double precision on purpose. Every traversal, ray generation and surface points ask the same function, so all of them see a
//! moving thing at the same place to the last bit, at every level.

/// Rows of an affine map, the last column the translation.
pub type Rows = [[f64; 4]; 3];

/// Columns of an affine map, the last one the translation, each with a zero behind it.
pub type Columns = [[f64; 4]; 4];

type Matrix = [[f64; 3]; 3];
type Quaternion = [f64; 4];

/// What happens between keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Rotations turn evenly; translations and stretches go straight. After a polar decomposition, as in Cycles.
    Decomposed,
    /// All numbers of the map go straight, as in most USD renderers.
    Linear,
}

/// The map at any time of the shutter, from 0 to 1.
#[derive(Clone, Debug)]
pub struct Motion {
    segments: Vec<Segment>,
}

/// From one key to the next.
#[derive(Clone, Copy, Debug)]
struct Segment {
    /// Where it is moved to at the first key, and the change.
    translation: [[f64; 3]; 2],
    /// Half of the radians that it turns by.
    half_angle: f64,
    linear: LinearPart,
}

/// The part of a segment's map that is not translation.
#[expect(clippy::large_enum_variant, reason = "most of what moves turns, and a box would cost each ray a load")]
#[derive(Clone, Copy, Debug)]
enum LinearPart {
    /// What turns and keeps its stretch, which has an inverse: the map and its inverse.
    Turning([Wave; 2]),
    /// `rotation · stretch`, both of which may change.
    Other {
        /// Unit quaternion (w, x, y, z) of the first key, and the one a quarter turn of the great circle further on.
        rotation: [Quaternion; 2],
        /// A start and a change.
        stretch: [Matrix; 2],
    },
}

/// A matrix that changes with an angle: a constant, and what the cosine and the sine of the angle are multiplied by. Each is kept by columns with a zero
/// behind them, which registers hold as they are.
#[derive(Clone, Copy, Debug)]
struct Wave([[[f64; 4]; 3]; 3]);

/// Between which of evenly spaced keys a time of the shutter lies: the segment's number, and the share of the way along it.
#[inline(always)]
pub fn segment_of(time: f32, segments: usize) -> (usize, f32) {
    let place = time.clamp(0.0, 1.0) * segments as f32;
    let number = (place as usize).min(segments - 1);
    (number, place - number as f32)
}

impl Motion {
    /// The motion through keys; `None` where nothing moves: fewer than two keys, all of them the same, or numbers that are not finite.
    pub fn new(keys: &[Rows], interpolation: Interpolation) -> Option<Self> {
        let finite = keys.iter().flatten().flatten().all(|x| x.is_finite());
        if keys.len() < 2 || !finite || keys.iter().all(|key| *key == keys[0]) {
            return None;
        }
        let parts = match interpolation {
            Interpolation::Decomposed => keys.iter().map(decomposed).collect::<Option<Vec<_>>>(),
            Interpolation::Linear => None,
        };
        // What has no rotation, as it is flat, goes straight.
        let mut parts = parts.unwrap_or_else(|| keys.iter().map(|key| ([1.0, 0.0, 0.0, 0.0], linear_part(key))).collect());
        for i in 1..parts.len() {
            // Both signs are the same rotation: the shorter way.
            if quaternion_dot(&parts[i - 1].0, &parts[i].0) < 0.0 {
                parts[i].0 = parts[i].0.map(|x| -x);
            }
        }
        let translation = |key: &Rows| [key[0][3], key[1][3], key[2][3]];
        let segment = |i: usize| {
            let ((q, s), (q1, s1)) = (&parts[i], &parts[i + 1]);
            let (rotation, half_angle) = great_circle(q, q1);
            let (from, to) = (translation(&keys[i]), translation(&keys[i + 1]));
            let change = change_of_stretch(s, s1);
            let back = if change == [[0.0; 3]; 3] { inverse(s) } else { None };
            let linear = match back {
                Some(back) => LinearPart::Turning(waves(&rotation, s, &back)),
                None => LinearPart::Other { rotation, stretch: [*s, change] },
            };
            Segment { translation: [from, std::array::from_fn(|k| to[k] - from[k])], half_angle, linear }
        };
        Some(Self { segments: (0..keys.len() - 1).map(segment).collect() })
    }

    /// Intervals between keys.
    pub fn segments(&self) -> usize {
        self.segments.len()
    }

    /// The map at a time; what lies before or behind the shutter counts as its ends.
    pub fn at(&self, time: f32) -> Rows {
        let (segment, t) = self.segment_at(time);
        segment.at(t)
    }

    /// The inverse of the map at a time; `None` where it is flat then.
    pub fn inverse_at(&self, time: f32) -> Option<Rows> {
        let columns = self.inverse_columns_at(time)?;
        Some(std::array::from_fn(|row| columns.map(|column| column[row])))
    }

    /// The same by columns.
    #[inline]
    pub fn inverse_columns_at(&self, time: f32) -> Option<Columns> {
        let (segment, t) = self.segment_at(time);
        segment.inverse_at(t)
    }

    /// The segment of a time, and the share of the way along it.
    #[inline]
    fn segment_at(&self, time: f32) -> (&Segment, f64) {
        let place = f64::from(time.clamp(0.0, 1.0)) * self.segments.len() as f64;
        let number = (place as usize).min(self.segments.len() - 1);
        (&self.segments[number], place - number as f64)
    }

    /// Radians that the thing turns by in a segment.
    pub fn turn(&self, segment: usize) -> f64 {
        2.0 * self.segments[segment].half_angle
    }

    /// How far any of some points may lie off the straight way between its places at the ends of a segment, in the units of the image.
    ///
    /// A way's distance from its chord is at most an eighth of the greatest second derivative. That of R S p is at most φ² |S p| + 2 φ |ΔS p| for
    /// a turn by φ. Over the n-th part of a segment it is n² times smaller.
    pub fn bow(&self, segment: usize, points: &[[f64; 3]]) -> f64 {
        let Segment { half_angle, linear, .. } = &self.segments[segment];
        let turn = 2.0 * half_angle;
        let [first, change] = match linear {
            // As long as without its turn.
            LinearPart::Turning([wave, _]) => [wave.at(&(0.0, 1.0)), [[0.0; 3]; 3]],
            LinearPart::Other { stretch, .. } => *stretch,
        };
        let of_point = |p: &[f64; 3]| {
            let (start, moved) = (product(&first, p), product(&change, p));
            let end = std::array::from_fn(|k| start[k] + moved[k]);
            turn * turn * length(&start).max(length(&end)) + 2.0 * turn * length(&moved)
        };
        points.iter().map(of_point).fold(0.0, f64::max) / 8.0
    }
}

impl Segment {
    fn at(&self, t: f64) -> Rows {
        let linear = match &self.linear {
            LinearPart::Turning([wave, _]) => wave.at(&self.sin_cos_at(t)),
            LinearPart::Other { rotation, stretch } => self.other_at(rotation, stretch, t),
        };
        with_translation(&linear, &self.translation_at(t))
    }

    #[inline]
    fn inverse_at(&self, t: f64) -> Option<Columns> {
        let [x, y, z] = match &self.linear {
            LinearPart::Turning([_, wave]) => wave.columns_at(&self.sin_cos_at(t)),
            LinearPart::Other { rotation, stretch } => columns(&inverse(&self.other_at(rotation, stretch, t))?),
        };
        let from = self.translation_at(t);
        let mut moved = [0.0; 4];
        for k in 0..4 {
            moved[k] = -(x[k] * from[0] + y[k] * from[1] + z[k] * from[2]);
        }
        Some([x, y, z, moved])
    }

    /// Sine and cosine of the angle that the thing has turned by.
    #[inline]
    fn sin_cos_at(&self, t: f64) -> (f64, f64) {
        if self.half_angle == 0.0 {
            return (0.0, 1.0);
        }
        let (sin, cos) = sin_cos(self.half_angle * t);
        (2.0 * sin * cos, 1.0 - 2.0 * sin * sin)
    }

    fn other_at(&self, rotation: &[Quaternion; 2], stretch: &[Matrix; 2], t: f64) -> Matrix {
        let stretch: Matrix = std::array::from_fn(|i| std::array::from_fn(|k| stretch[0][i][k] + t * stretch[1][i][k]));
        if self.half_angle == 0.0 && rotation[0][0] == 1.0 {
            return stretch;
        }
        let (sin, cos) = sin_cos(self.half_angle * t);
        let turned = rotation_matrix(&std::array::from_fn(|k| rotation[0][k] * cos + rotation[1][k] * sin));
        matrix_product(&turned, &stretch)
    }

    #[inline]
    fn translation_at(&self, t: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.translation[0][i] + t * self.translation[1][i])
    }
}

impl Wave {
    #[inline(always)]
    fn at(&self, angle: &(f64, f64)) -> Matrix {
        let columns = self.columns_at(angle);
        std::array::from_fn(|i| std::array::from_fn(|k| columns[k][i]))
    }

    #[inline(always)]
    fn columns_at(&self, (sin, cos): &(f64, f64)) -> [[f64; 4]; 3] {
        let [still, by_cos, by_sin] = &self.0;
        let mut out = [[0.0; 4]; 3];
        for k in 0..3 {
            for i in 0..4 {
                out[k][i] = still[k][i] + (by_cos[k][i] * cos + by_sin[k][i] * sin);
            }
        }
        out
    }
}

/// What turns along a great circle of quaternions after a stretch, and the inverse of that, by the angle.
///
/// A rotation's matrix is 1 + B(q, q) with a form B of two quaternions. On the great circle q is a cos φ/2 + b sin φ/2, so that its products are
/// sums of 1, cos φ and sin φ.
fn waves([a, b]: &[Quaternion; 2], stretch: &Matrix, back: &Matrix) -> [Wave; 2] {
    let form = |q: &Quaternion| {
        let mut matrix = rotation_matrix(q);
        (0..3).for_each(|k| matrix[k][k] -= 1.0);
        matrix
    };
    let (of_a, of_b, of_both) = (form(a), form(b), form(&std::array::from_fn(|k| a[k] + b[k])));
    let part = |of: &dyn Fn(usize, usize) -> f64| -> Matrix { std::array::from_fn(|i| std::array::from_fn(|k| of(i, k))) };
    let turn = [
        part(&|i, k| f64::from(u8::from(i == k)) + 0.5 * (of_a[i][k] + of_b[i][k])),
        part(&|i, k| 0.5 * (of_a[i][k] - of_b[i][k])),
        part(&|i, k| 0.5 * (of_both[i][k] - of_a[i][k] - of_b[i][k])),
    ];
    let forth = turn.map(|matrix| columns(&matrix_product(&matrix, stretch)));
    [Wave(forth), Wave(turn.map(|matrix| columns(&matrix_product(back, &transposed(&matrix)))))]
}

fn with_translation(linear: &Matrix, [x, y, z]: &[f64; 3]) -> Rows {
    let row = |[a, b, c]: [f64; 3], moved: f64| [a, b, c, moved];
    [row(linear[0], *x), row(linear[1], *y), row(linear[2], *z)]
}

/// Columns with a zero behind each.
#[inline]
fn columns(m: &Matrix) -> [[f64; 4]; 3] {
    std::array::from_fn(|k| [m[0][k], m[1][k], m[2][k], 0.0])
}

fn transposed(m: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|k| m[k][i]))
}

/// What a stretch changes by; keys in single precision differ by their rounding, which is no change.
fn change_of_stretch(from: &Matrix, to: &Matrix) -> Matrix {
    let change: Matrix = std::array::from_fn(|row| std::array::from_fn(|column| to[row][column] - from[row][column]));
    let most = |m: &Matrix| m.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    if most(&change) <= ROUNDING * most(from) { [[0.0; 3]; 3] } else { change }
}

/// A few roundings of single precision.
const ROUNDING: f64 = 5e-7;

/// Sine and cosine of an angle from 0 to π/2 by their series about the middle; the platform's own differ from one to the other.
#[inline]
fn sin_cos(angle: f64) -> (f64, f64) {
    let x = angle - std::f64::consts::FRAC_PI_4;
    let y = x * x;
    let sin = x * (1.0 + y * (-1.0 / 6.0 + y * (1.0 / 120.0 + y * (-1.0 / 5040.0 + y * (1.0 / 362_880.0 + y * (-1.0 / 39_916_800.0))))));
    let cos =
        1.0 + y * (-0.5 + y * (1.0 / 24.0 + y * (-1.0 / 720.0 + y * (1.0 / 40_320.0 + y * (-1.0 / 3_628_800.0 + y / 479_001_600.0)))));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    ((sin + cos) * half, (cos - sin) * half)
}

/// A first quaternion, the one perpendicular to it on the way to another, and the angle between both.
fn great_circle(from: &Quaternion, to: &Quaternion) -> ([Quaternion; 2], f64) {
    let cos = quaternion_dot(from, to).clamp(-1.0, 1.0);
    let aside: Quaternion = std::array::from_fn(|k| to[k] - from[k] * cos);
    let sin = quaternion_dot(&aside, &aside).sqrt();
    if sin < 1e-12 {
        return ([*from, [0.0; 4]], 0.0);
    }
    ([*from, aside.map(|x| x / sin)], sin.atan2(cos))
}

fn quaternion_dot(a: &Quaternion, b: &Quaternion) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn rotation_matrix(q: &Quaternion) -> Matrix {
    let [w, x, y, z] = *q;
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// The unit quaternion of a rotation, by the largest of its components (Shepperd 1978).
fn quaternion(m: &Matrix) -> Quaternion {
    let trace = m[0][0] + m[1][1] + m[2][2];
    let squares = [trace, m[0][0], m[1][1], m[2][2]];
    let largest = (0..4).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    let [xy, xz, yz] = [m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]];
    let [wx, wy, wz] = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
    let q = match largest {
        0 => [1.0 + trace, wx, wy, wz],
        1 => [wx, 1.0 + 2.0 * m[0][0] - trace, xy, xz],
        2 => [wy, xy, 1.0 + 2.0 * m[1][1] - trace, yz],
        _ => [wz, xz, yz, 1.0 + 2.0 * m[2][2] - trace],
    };
    let length = quaternion_dot(&q, &q).sqrt();
    q.map(|x| x / length)
}

fn linear_part(key: &Rows) -> Matrix {
    key.map(|[x, y, z, _]| [x, y, z])
}

/// Rotation and stretch of a map, by the iteration to its polar decomposition (Higham 1986); a mirror stays in the stretch. `None` for flat maps.
fn decomposed(key: &Rows) -> Option<(Quaternion, Matrix)> {
    let linear = linear_part(key);
    let mut rotation = linear;
    for _ in 0..100 {
        let inverse = inverse(&rotation)?;
        let next: Matrix = std::array::from_fn(|i| std::array::from_fn(|k| 0.5 * (rotation[i][k] + inverse[k][i])));
        let change = (0..9).map(|at| (next[at / 3][at % 3] - rotation[at / 3][at % 3]).abs()).fold(0.0, f64::max);
        rotation = next;
        if change < 1e-14 {
            break;
        }
    }
    if determinant(&rotation) < 0.0 {
        rotation = rotation.map(|row| row.map(|x| -x));
    }
    let stretch = matrix_product(&transposed(&rotation), &linear);
    let q = quaternion(&rotation);
    q.iter().chain(stretch.iter().flatten()).all(|x| x.is_finite()).then_some((q, stretch))
}

fn cofactor(m: &Matrix, row: usize, column: usize) -> f64 {
    let (r1, r2, c1, c2) = ((row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3);
    m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
}

fn determinant(m: &Matrix) -> f64 {
    (0..3).map(|column| m[0][column] * cofactor(m, 0, column)).sum()
}

fn inverse(m: &Matrix) -> Option<Matrix> {
    let over = 1.0 / determinant(m);
    over.is_finite().then(|| std::array::from_fn(|i| std::array::from_fn(|k| cofactor(m, k, i) * over)))
}

fn matrix_product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|k| a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k]))
}

fn product(m: &Matrix, p: &[f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2])
}

fn length(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn about an axis by radians, stretched and moved.
    fn placed(axis: usize, angle: f64, scale: [f64; 3], at: [f64; 3]) -> Rows {
        let (sin, cos) = angle.sin_cos();
        let (i, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut turn = [[0.0; 3]; 3];
        turn[axis][axis] = 1.0;
        (turn[i][i], turn[i][k], turn[k][i], turn[k][k]) = (cos, -sin, sin, cos);
        std::array::from_fn(|row| [turn[row][0] * scale[0], turn[row][1] * scale[1], turn[row][2] * scale[2], at[row]])
    }

    fn far(a: &Rows, b: &Rows) -> f64 {
        a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn keys_are_met_and_turns_are_even() {
        for axis in 0..3 {
            for scale in [[1.0; 3], [2.0, 0.5, 3.0], [-1.0, 1.0, 2.0]] {
                let key = |share: f64| placed(axis, 0.3 + 1.5 * share, scale, [1.0 + share, -2.0, 3.0 * share]);
                let keys: Vec<Rows> = [0.0, 0.5, 1.0].map(key).to_vec();
                let motion = Motion::new(&keys, Interpolation::Decomposed).expect("it moves");
                for share in [0.0, 0.2, 0.5, 0.77, 1.0] {
                    let found = motion.at(share as f32);
                    assert!(far(&found, &key(f64::from(share as f32))) < 1e-9, "{axis} {scale:?} {share}: {found:?}");
                }
            }
        }
    }

    #[test]
    fn inverses_lead_back() {
        let rounded = |rows: Rows| rows.map(|row| row.map(|x| f64::from(x as f32)));
        for (first, last) in [([2.0, 0.5, 3.0], [2.0, 0.5, 3.0]), ([1.0; 3], [2.0, 0.5, -3.0]), ([-1.0, 1.0, 2.0], [-1.0, 1.0, 2.0])] {
            for angle in [0.0, 0.3, 2.0] {
                let keys = [placed(1, 0.3, first, [1.0, 2.0, 3.0]), placed(1, 0.3 + angle, last, [-1.0, 2.0, 3.5])].map(rounded);
                let motion = Motion::new(&keys, Interpolation::Decomposed).expect("it moves");
                for time in [0.0, 0.3, 0.9, 1.0] {
                    let (to, back) = (motion.at(time), motion.inverse_at(time).expect("it has a volume"));
                    let p = [0.3, -2.0, 5.0];
                    let image = |m: &Rows, p: &[f64; 3]| m.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
                    let found = image(&back, &image(&to, &p));
                    assert!((0..3).all(|k| (found[k] - p[k]).abs() < 1e-9), "{found:?}");
                }
            }
        }
        let flat = [[[0.0; 4]; 3], placed(0, 0.0, [1.0; 3], [1.0; 3])];
        assert!(Motion::new(&flat, Interpolation::Decomposed).expect("it grows").inverse_at(0.0).is_none());
    }

    #[test]
    fn straight_ways_go_through_the_middle_of_all_numbers() {
        let keys = [placed(2, 0.0, [1.0; 3], [0.0; 3]), placed(2, 1.0, [1.0; 3], [2.0, 0.0, 0.0])];
        let motion = Motion::new(&keys, Interpolation::Linear).expect("it moves");
        let middle: Rows = std::array::from_fn(|i| std::array::from_fn(|k| 0.5 * (keys[0][i][k] + keys[1][i][k])));
        assert!(far(&motion.at(0.5), &middle) < 1e-12);
        let flat = [[[0.0; 4]; 3], placed(0, 0.0, [1.0; 3], [1.0; 3])];
        assert!((Motion::new(&flat, Interpolation::Decomposed).expect("it grows").at(0.25)[1][1] - 0.25).abs() < 1e-12);
    }

    #[test]
    fn what_does_not_move_is_no_motion() {
        let key = placed(1, 0.4, [1.0; 3], [0.0; 3]);
        for keys in [vec![], vec![key], vec![key, key, key], vec![key, [[f64::NAN; 4]; 3]]] {
            assert!(Motion::new(&keys, Interpolation::Decomposed).is_none());
        }
    }

    #[test]
    fn ways_stay_within_their_bow() {
        let points = [[1.0, 2.0, -0.5], [-3.0, 0.0, 0.25]];
        let keys = [placed(0, 0.0, [1.0; 3], [0.0; 3]), placed(1, 3.0, [1.0, 2.0, 0.5], [5.0, 1.0, 0.0])];
        let motion = Motion::new(&keys, Interpolation::Decomposed).expect("it moves");
        let bow = motion.bow(0, &points);
        let image = |m: &Rows, p: &[f64; 3]| m.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        for p in &points {
            let (start, end) = (image(&motion.at(0.0), p), image(&motion.at(1.0), p));
            for step in 0..=20 {
                let t = f64::from(step) / 20.0;
                let found = image(&motion.at(t as f32), p);
                let off: [f64; 3] = std::array::from_fn(|k| found[k] - (start[k] + t * (end[k] - start[k])));
                assert!(length(&off) <= bow, "{off:?} beyond {bow}");
            }
        }
    }
}
