//! The light of a beam that is known by two angles.

use std::f64::consts::LN_2;

/// The least ratio of field to beam angle: hard edges are that wide.
const HARD: f64 = 1.02;

/// Even steps from the axis to half the beam angle.
const STEPS: usize = 64;

/// Powers of the fall by which the curve is cut into angles: the share exp(−ln 2 · 2^(k / PER_POWER)).
const PER_POWER: i32 = 24;

/// The last of them: a share of 2⁻²⁰ of the peak, behind which there is no light.
const LAST: f64 = 20.0;

/// The super-Gaussian that has half its peak at half the beam angle and a tenth at half the field angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    /// Half the beam angle, degrees.
    half: f64,
    exponent: f64,
}

impl Shape {
    /// Full angles in degrees, positive. A field angle that is not beyond the beam angle makes a hard edge.
    pub(super) fn new(beam: f64, field: f64) -> Self {
        let ratio = (field / beam).max(HARD);
        Self { half: 0.5 * beam, exponent: (10f64.ln() / LN_2).ln() / ratio.ln() }
    }

    /// Whether these angles make a hard edge.
    pub(super) fn is_hard(beam: f64, field: f64) -> bool {
        field / beam < HARD
    }

    /// The share of the peak at an angle from the axis in degrees: exp(−ln 2 · (θ / half)^p).
    pub(super) fn at(&self, theta: f64) -> f64 {
        (-LN_2 * (theta / self.half).powf(self.exponent)).exp()
    }

    /// Angles in degrees from the axis, and the shares there: on the curve, half and a tenth among them, and 0 at its end.
    pub(super) fn table(&self) -> (Vec<f64>, Vec<f64>) {
        let even = (0..STEPS).map(|step| self.half * step as f64 / STEPS as f64);
        let least = -4 * PER_POWER;
        let most = (LAST.log2() * f64::from(PER_POWER)).ceil() as i32;
        let tenth = (10f64.ln() / LN_2).powf(1.0 / self.exponent);
        let falls = (least..=most).map(|step| (f64::from(step) / f64::from(PER_POWER)).exp2().powf(1.0 / self.exponent));
        let mut angles: Vec<f64> =
            even.chain(falls.chain([tenth]).map(|factor| self.half * factor)).filter(|angle| *angle < 180.0).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup_by(|a, b| *a - *b < 1e-6);
        let mut shares: Vec<f64> = angles.iter().map(|angle| self.at(*angle)).collect();
        let end = self.half * (LAST * 1.05).powf(1.0 / self.exponent);
        if end < 180.0 {
            angles.push(end);
            shares.push(0.0);
        } else {
            angles.push(180.0);
            shares.push(self.at(180.0));
        }
        (angles, shares)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_angles_are_on_the_curve() {
        for (beam, field) in [(20.0, 40.0), (20.0, 22.0), (5.0, 60.0), (120.0, 170.0)] {
            let shape = Shape::new(beam, field);
            assert!((shape.at(0.5 * beam) - 0.5).abs() < 1e-12 && (shape.at(0.5 * field) - 0.1).abs() < 1e-12, "{beam} {field}");
            let (angles, shares) = shape.table();
            assert!(angles.windows(2).all(|pair| pair[1] - pair[0] > 1e-7) && shares.windows(2).all(|pair| pair[1] <= pair[0]));
            for (angle, share) in [(0.5 * beam, 0.5), (0.5 * field, 0.1)] {
                let place = angles.iter().position(|found| (found - angle).abs() < 1e-6).expect("an angle of the table");
                assert!((shares[place] - share).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_gaussian_is_one_of_them() {
        let shape = Shape::new(10.0, 10.0 * (10f64.ln() / LN_2).sqrt());
        assert!((shape.exponent - 2.0).abs() < 1e-12);
    }

    #[test]
    fn fields_no_wider_than_beams_have_hard_edges() {
        let shape = Shape::new(25.0, 25.0);
        assert!(Shape::is_hard(25.0, 25.0) && !Shape::is_hard(25.0, 26.0));
        assert!((shape.at(12.5) - 0.5).abs() < 1e-12 && shape.at(11.5) > 0.99 && shape.at(13.2) < 0.001);
    }
}
