//! Exact sampling of matrices: a patch in proportion to value × projected solid angle, and a direction uniform in it.

use super::super::direction::{Direction, through};
use super::super::hemispheres::Hemispheres;
use super::{Matrix, Patches, turned};

/// A matrix, the row of the direction that is given, and the row's sum.
struct Row<'a> {
    matrix: &'a Matrix,
    cumulative: &'a [f32],
    sum: f64,
}

impl Patches {
    /// Reflection and transmission to `wo`.
    fn rows(&self, wo: Direction) -> [Option<Row<'_>>; 2] {
        let pairs = if wo[2] > 0.0 {
            [Hemispheres::ReflectionFront, Hemispheres::TransmissionBack]
        } else {
            [Hemispheres::ReflectionBack, Hemispheres::TransmissionFront]
        };
        let up = if wo[2] < 0.0 { through(wo) } else { wo };
        pairs.map(|pair| {
            let matrix = self.main(pair)?;
            let patch = self.bases[matrix.outgoing].patch(turned(up, matrix.turned[1]));
            let stride = self.bases[matrix.incident].count() + 1;
            let cumulative = &matrix.cumulative[patch * stride..][..stride];
            Some(Row { matrix, cumulative, sum: cumulative[stride - 1].into() })
        })
    }

    /// A direction that light comes from, in proportion to what leaves to `wo`, from three uniform numbers; none if nothing does.
    pub(crate) fn sample(&self, wo: Direction, u: [f64; 3]) -> Option<(Direction, f64)> {
        let rows = self.rows(wo);
        let total: f64 = rows.iter().flatten().map(|row| row.sum).sum();
        let mut rest = u[0] * total;
        let mut chosen = None;
        for row in rows.iter().flatten().filter(|row| row.sum > 0.0) {
            chosen = Some(row);
            if rest < row.sum {
                break;
            }
            rest -= row.sum;
        }
        let row = chosen?;
        let last = row.cumulative.partition_point(|&c| f64::from(c) < row.sum);
        let patch = row.cumulative.partition_point(|&c| f64::from(c) <= rest).clamp(1, last) - 1;
        let basis = &self.bases[row.matrix.incident];
        let up = turned(basis.direction(patch, [u[1], u[2]]), row.matrix.turned[0]);
        let wi = if row.matrix.hemispheres.is_from_front() { up } else { through(up) };
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then_some((wi, pdf))
    }

    /// The probability density of [`Patches::sample`], per solid angle.
    pub(crate) fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let rows = self.rows(wo);
        let total: f64 = rows.iter().flatten().map(|row| row.sum).sum();
        let Some(pair) = Hemispheres::of(wi, wo) else { return 0.0 };
        let Some(row) = rows.iter().flatten().find(|row| row.matrix.hemispheres == pair) else { return 0.0 };
        if total <= 0.0 {
            return 0.0;
        }
        let basis = &self.bases[row.matrix.incident];
        let up = if wi[2] < 0.0 { through(wi) } else { wi };
        let patch = basis.patch(turned(up, row.matrix.turned[0]));
        let share = f64::from(row.cumulative[patch + 1]) - f64::from(row.cumulative[patch]);
        share / total / basis.projected_solid_angle(patch) * up[2]
    }
}
