//! Limits against fireflies on what light paths bring: a pixel has at most as much of it as one contribution of a camera path may bring, straight
//! from lights and otherwise. Single splats are limited as they come; this is their sum.

/// Splats of a pixel, as means over the samples: all of them, and those that come straight from lights.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelSplats {
    pub(super) all: [f64; 3],
    pub(super) direct: [f64; 3],
}

/// Which of them a pass shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shows {
    Direct,
    Indirect,
    /// Some of both.
    Both,
}

impl Shows {
    /// By classes of light, of which the lower four are direct.
    pub(super) fn of(classes: u16) -> Self {
        match (classes & 0b1111, classes >> 4) {
            (_, 0) => Self::Direct,
            (0, _) => Self::Indirect,
            _ => Self::Both,
        }
    }
}

impl PixelSplats {
    /// What a pass's part of them is multiplied by; limits of 0 are none.
    pub(super) fn factor(&self, limits: [f32; 2], shows: Shows) -> f64 {
        let mean = |light: [f64; 3]| light.iter().sum::<f64>() / 3.0;
        let (direct, all) = (mean(self.direct), mean(self.all));
        let kept =
            |light: f64, limit: f32| if limit > 0.0 && light.abs() > f64::from(limit) { f64::from(limit) / light.abs() } else { 1.0 };
        let [of_direct, of_indirect] = [kept(direct, limits[0]), kept(all - direct, limits[1])];
        match shows {
            Shows::Direct => of_direct,
            Shows::Indirect => of_indirect,
            Shows::Both if all != 0.0 => (of_direct * direct + of_indirect * (all - direct)) / all,
            Shows::Both => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_limited_by_the_mean_of_their_channels() {
        let splats = PixelSplats { all: [9.0, 3.0, 0.0], direct: [3.0, 0.0, 0.0] };
        for (limits, shows, expected) in [
            ([0.0, 0.0], Shows::Both, 1.0),
            ([0.5, 0.0], Shows::Direct, 0.5),
            ([0.5, 0.0], Shows::Indirect, 1.0),
            ([0.0, 0.6], Shows::Indirect, 0.2),
            ([0.5, 0.6], Shows::Both, (0.5 + 0.6) / 4.0),
            ([2.0, 9.0], Shows::Both, 1.0),
        ] {
            let negative = PixelSplats { all: splats.all.map(|x| -x), direct: splats.direct.map(|x| -x) };
            for found in [splats, negative].map(|splats| splats.factor(limits, shows)) {
                assert!((found - expected).abs() < 1e-7, "{limits:?} {shows:?}: {found}");
            }
        }
        assert_eq!([0b0000_0010, 0b0010_0000, 0b0001_0001].map(Shows::of), [Shows::Direct, Shows::Indirect, Shows::Both]);
        assert_eq!(PixelSplats { all: [0.0; 3], direct: [0.0; 3] }.factor([1.0; 2], Shows::Both), 1.0);
    }
}
