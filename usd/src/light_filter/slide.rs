//! What a light filter lets through at the places of its plane: the opening of barn doors, or a picture.

use gonio::scene;
use gonio::texture::{Image, LatLong, Texels};

/// Factors on red, green and blue.
pub(super) type Passed = [f32; 3];

/// What a filter lets through by the place on its plane z = 0, in the filter's own units.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Slide {
    /// The same everywhere: no plane at all.
    Even,
    /// An opening in an endless black card.
    Window(Window),
    /// A picture, x to its right and y up.
    Picture(Picture),
}

/// The opening between barn doors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Window {
    /// Left and bottom.
    pub(super) low: [f64; 2],
    /// Right and top.
    pub(super) high: [f64; 2],
    /// Of its corners.
    pub(super) radius: f64,
    /// Width of the border outside, in which light fades linearly.
    pub(super) edge: f64,
    /// Whether light passes that goes away from the card.
    pub(super) passes_behind: bool,
}

/// How a picture goes on beyond its borders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Tiling {
    /// With the fill colour.
    #[default]
    Fill,
    /// With the texels of its border.
    Clamp,
    /// Again and again.
    Repeat,
}

/// A picture in a frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Picture {
    /// Width and height of the frame.
    pub(super) size: [f64; 2],
    /// Texels, linear.
    pub(super) image: LatLong,
    /// Coverage of the texels.
    pub(super) alpha: Vec<f32>,
    /// What lies beyond the borders, and under what the texels do not cover.
    pub(super) fill: Passed,
    /// Beyond the borders.
    pub(super) tiling: Tiling,
    /// Left to right and top to bottom.
    pub(super) mirrored: [bool; 2],
    /// Repetitions in the frame.
    pub(super) scale: [f64; 2],
    /// Of the texture coordinates.
    pub(super) offset: [f64; 2],
}

impl Slide {
    /// What passes at a place.
    pub(super) fn at(&self, place: [f64; 2]) -> Passed {
        match self {
            Self::Even => [1.0; 3],
            Self::Window(window) => [window.at(place); 3],
            Self::Picture(picture) => picture.at(place),
        }
    }

    /// What passes of light that never comes to the plane.
    pub(super) fn behind(&self) -> Passed {
        match self {
            Self::Even => [1.0; 3],
            Self::Window(window) => [if window.passes_behind { 1.0 } else { 0.0 }; 3],
            Self::Picture(picture) if picture.tiling == Tiling::Fill => picture.fill,
            Self::Picture(_) => [0.0; 3],
        }
    }

    /// As the scene describes it.
    pub(super) fn described(&self) -> scene::Slide {
        match self {
            // What is the same everywhere is a factor, and does not come here.
            Self::Even => scene::Slide::Opening { low: [-1e18; 2], high: [1e18; 2], radius: 0.0, edge: 0.0 },
            Self::Window(window) => scene::Slide::Opening {
                low: window.low.map(|x| x as f32),
                high: window.high.map(|x| x as f32),
                radius: window.radius as f32,
                edge: window.edge as f32,
            },
            Self::Picture(picture) => picture.described(),
        }
    }
}

impl Window {
    fn at(&self, place: [f64; 2]) -> f32 {
        let [half_x, half_y] = [0, 1].map(|k| 0.5 * (self.high[k] - self.low[k]));
        if half_x <= 0.0 || half_y <= 0.0 {
            return 0.0;
        }
        let radius = self.radius.clamp(0.0, half_x.min(half_y));
        let [x, y] = [0, 1].map(|k| (place[k] - 0.5 * (self.low[k] + self.high[k])).abs());
        let (x, y) = (x - (half_x - radius), y - (half_y - radius));
        let outside = x.max(0.0).hypot(y.max(0.0)) + x.max(y).min(0.0) - radius;
        if outside <= 0.0 {
            return 1.0;
        }
        if self.edge > 0.0 { (1.0 - outside / self.edge).max(0.0) as f32 } else { 0.0 }
    }
}

impl Picture {
    /// A decoded image in a frame.
    pub(super) fn new(image: &Image, linear: LatLong, size: [f64; 2]) -> Self {
        let mut picture = Self {
            size,
            alpha: (0..image.len()).map(|texel| image.rgba(texel)[3].clamp(0.0, 1.0)).collect(),
            image: linear,
            fill: [0.0; 3],
            tiling: Tiling::Fill,
            mirrored: [false; 2],
            scale: [1.0; 2],
            offset: [0.0; 2],
        };
        // Files of integers have colours that are not yet multiplied by their coverage.
        if matches!(image.texels, Texels::Byte(_) | Texels::Short(_)) {
            for (rgb, alpha) in picture.image.rgb.iter_mut().zip(&picture.alpha) {
                *rgb = rgb.map(|x| x * alpha);
            }
        }
        picture
    }

    /// As the scene describes it: what texels do not cover is filled.
    fn described(&self) -> scene::Slide {
        let filled = |(rgb, alpha): (&[f32; 3], &f32)| -> [f32; 3] { std::array::from_fn(|k| rgb[k] + (1.0 - alpha) * self.fill[k]) };
        let rgb: Vec<f32> = self.image.rgb.iter().zip(&self.alpha).flat_map(filled).collect();
        let ([x, y], [u, v]) = (self.scale, self.offset);
        let across = if self.mirrored[0] { [-x, 1.0 - u] } else { [x, u] };
        // The scene counts from the top.
        let down = if self.mirrored[1] { [-y, y + v] } else { [y, 1.0 - y - v] };
        scene::Slide::Picture {
            width: self.image.width as u32,
            height: self.image.height as u32,
            rgb: rgb.into(),
            size: self.size.map(|x| x as f32),
            fill: (self.tiling == Tiling::Fill).then_some(self.fill),
            repeats: self.tiling == Tiling::Repeat,
            to_texture: [across, down].map(|map| map.map(|x| x as f32)),
        }
    }

    fn at(&self, place: [f64; 2]) -> Passed {
        let mut uv = [0.0; 2];
        for k in 0..2 {
            let within = place[k] / self.size[k] + 0.5;
            if self.tiling == Tiling::Fill && !(0.0..=1.0).contains(&within) {
                return self.fill;
            }
            let along = within * self.scale[k] + self.offset[k];
            let along = if self.mirrored[k] { 1.0 - along } else { along };
            uv[k] = match self.tiling {
                Tiling::Fill if !(0.0..=1.0).contains(&along) => return self.fill,
                Tiling::Repeat => along.rem_euclid(1.0),
                _ => along.clamp(0.0, 1.0),
            };
        }
        self.texel(uv)
    }

    /// Bilinear; the first coordinate grows to the right, the second up.
    fn texel(&self, [u, v]: [f64; 2]) -> Passed {
        let (columns, rows) = (self.image.width, self.image.height);
        let place = |along: f64, count: usize| {
            let at = along * count as f64 - 0.5;
            let low = at.floor();
            let index = |x: f64| match self.tiling {
                Tiling::Repeat => x.rem_euclid(count as f64) as usize,
                _ => x.clamp(0.0, count as f64 - 1.0) as usize,
            };
            ([index(low), index(low + 1.0)], (at - low) as f32)
        };
        let ((across, x), (down, y)) = (place(u, columns), place(1.0 - v, rows));
        let mut sum = [0.0; 3];
        for (row, share_y) in down.into_iter().zip([1.0 - y, y]) {
            for (column, share_x) in across.into_iter().zip([1.0 - x, x]) {
                let at = row * columns + column;
                let (rgb, alpha) = (self.image.rgb[at], self.alpha[at]);
                for k in 0..3 {
                    sum[k] += share_x * share_y * (rgb[k] + (1.0 - alpha) * self.fill[k]);
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window() -> Window {
        Window { low: [-1.0, -2.0], high: [3.0, 2.0], radius: 0.0, edge: 0.0, passes_behind: false }
    }

    #[test]
    fn windows_end_at_their_edges() {
        let plain = window();
        assert_eq!([[2.9, 1.9], [3.1, 0.0], [0.0, -2.1]].map(|place| plain.at(place)), [1.0, 0.0, 0.0]);
        let soft = Window { edge: 0.5, ..window() };
        assert!((soft.at([3.25, 0.0]) - 0.5).abs() < 1e-6);
        let round = Window { radius: 2.0, ..window() };
        assert_eq!([[2.9, 0.0], [2.9, 1.9], [1.0, 0.0]].map(|place| round.at(place)), [1.0, 0.0, 1.0]);
    }

    fn picture(tiling: Tiling) -> Picture {
        let image = LatLong { width: 2, height: 2, rgb: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3]] };
        let alpha = vec![1.0; 4];
        Picture { size: [2.0; 2], image, alpha, fill: [0.5; 3], tiling, mirrored: [false; 2], scale: [1.0; 2], offset: [0.0; 2] }
    }

    #[test]
    fn pictures_stand_upright() {
        let filled = picture(Tiling::Fill);
        assert_eq!(filled.at([-0.5, 0.5]), [1.0, 0.0, 0.0]);
        assert_eq!(filled.at([0.5, 0.5]), [0.0, 1.0, 0.0]);
        assert_eq!(filled.at([-0.5, -0.5]), [0.0, 0.0, 1.0]);
        assert_eq!(filled.at([1.5, 0.0]), [0.5; 3]);
        assert_eq!(picture(Tiling::Clamp).at([9.0, 9.0]), [0.0, 1.0, 0.0]);
        assert_eq!(picture(Tiling::Repeat).at([1.5, 0.5]), [1.0, 0.0, 0.0]);
        let mirrored = Picture { mirrored: [true, false], ..filled };
        assert_eq!(mirrored.at([-0.5, 0.5]), [0.0, 1.0, 0.0]);
    }

    /// What the scene's slide lets through by its own rules, at texel middles.
    fn thrown(slide: &scene::Slide, place: [f64; 2]) -> Passed {
        let scene::Slide::Picture { width, height, rgb, size, fill, repeats, to_texture } = slide else { panic!("a picture") };
        let within = [place[0] / f64::from(size[0]) + 0.5, 0.5 - place[1] / f64::from(size[1])];
        let mut uv = [0, 1].map(|k| within[k] * f64::from(to_texture[k][0]) + f64::from(to_texture[k][1]));
        if let Some(fill) = fill
            && within.iter().chain(&uv).any(|x| !(0.0..=1.0).contains(x))
        {
            return *fill;
        }
        if *repeats {
            uv = uv.map(|x| x - x.floor());
        }
        let [column, row] = [0, 1].map(|k| ((uv[k] * f64::from([*width, *height][k])) as usize).min([*width, *height][k] as usize - 1));
        let at = 3 * (row * *width as usize + column);
        [rgb[at], rgb[at + 1], rgb[at + 2]]
    }

    #[test]
    fn the_scene_is_told_the_same_picture() {
        for tiling in [Tiling::Fill, Tiling::Clamp, Tiling::Repeat] {
            for mirrored in [[false, false], [true, false], [false, true], [true, true]] {
                let plain = Picture { mirrored, ..picture(tiling) };
                let slide = Slide::Picture(plain.clone()).described();
                for place in [[-0.5, 0.5], [0.5, 0.5], [-0.5, -0.5], [0.5, -0.5], [2.5, 0.5], [-1.5, -2.5]] {
                    // Beyond the border, where it goes on, the two differ by what is mixed there.
                    if tiling == Tiling::Fill || f64::abs(place[0]) < 1.0 || tiling == Tiling::Repeat {
                        assert_eq!(thrown(&slide, place), plain.at(place), "{tiling:?} {mirrored:?} {place:?}");
                    }
                }
            }
        }
        // Half of the frame shows a shifted part of the picture.
        let shifted = Picture { scale: [0.5, 0.5], offset: [0.25, 0.5], mirrored: [false, true], ..picture(Tiling::Fill) };
        let slide = Slide::Picture(shifted.clone()).described();
        for place in [[-1.0, 0.0], [1.0, 0.0]] {
            assert_eq!(thrown(&slide, place), shifted.at(place), "{place:?}");
        }
    }

    #[test]
    fn what_texels_do_not_cover_is_filled() {
        let half = Picture { alpha: vec![0.5; 4], ..picture(Tiling::Fill) };
        assert_eq!(half.at([-0.5, 0.5]), [1.25, 0.25, 0.25]);
    }
}
