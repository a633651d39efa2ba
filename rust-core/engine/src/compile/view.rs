//! One view of a compiled scene: camera, filter, window and transport, which change without compiling anything.

use super::{compiled::CompiledScene, expressions, light_groups, motion, motion_vectors, samples, shader_passes};
use crate::{
    antialias::Rule,
    camera::{Aperture, CameraTable, Lens, Surroundings},
    error::{Error, Result},
    film::{ChannelLayout, Film, GROUP, PictureProjection, PictureView, Placement, tabulate},
    memory::room_for,
    scene::{Antialiasing, Aov, Background, Camera, Crop, Integrator, Projection, Settings},
    transport::{Distance, Estimator, FirstLight, Limits, Mist, Passes, PathFilter, Transport, surroundings_at},
};
use gonio_simd::Execution;

/// What a render needs beside the scene.
#[derive(Clone, Debug)]
pub struct View {
    /// Ray generation.
    pub camera: CameraTable,
    /// Where in the pixels samples lie.
    pub placement: Placement,
    /// What counts as a discontinuity, where samples follow them.
    pub rule: Option<Rule>,
    /// Light transport.
    pub transport: Transport,
    /// Factor on the colour pass.
    pub exposure: f32,
    /// The part of the image that is rendered.
    pub window: Crop,
}

/// The widest field of view, degrees.
const FULL_TURN: f64 = 360.0;
/// Largest image side.
const MOST_PIXELS: u32 = 65_536;

impl View {
    /// Checks the settings and lays the view out.
    pub fn new(scene: &CompiledScene, settings: &Settings, execution: Execution) -> Result<Self> {
        let window = window(settings)?;
        samples::check(settings)?;
        check_deep(scene, settings)?;
        expressions::passes(scene, settings)?;
        check_tiles(settings, window)?;
        check_memory(settings, window)?;
        let camera = scene.cameras.get(settings.camera as usize).ok_or_else(|| Error::Setting {
            name: "camera".into(),
            problem: format!("the scene has {} cameras, number {} was asked for", scene.cameras.len(), settings.camera),
        })?;
        if !camera.transform.is_finite() {
            return Err(Error::scene(&camera.origin, "the camera's transform is not finite"));
        }
        let table = camera_table(camera, settings, scene.tables.origin)?;
        let motion = motion::of_camera(camera, settings, scene.tables.origin);
        let surroundings = surroundings_at(&scene.tables, &[camera.transform.columns[3]])[0];
        let table = CameraTable { motion, surroundings, ..table };
        let shutter = motion::shutter(&scene.tables, table.motion.as_deref(), settings);
        let forward = table.axes[2].map(|x| -x);
        let mut transport = Transport {
            shutter,
            squared_index: surroundings.squared_index,
            ..transport(scene, settings, execution, table.position, forward)
        };
        transport.passes.motion = motion_vectors::cameras(camera, settings, |camera| camera_table(camera, settings, scene.tables.origin))?;
        let transport = Transport { passes: deep_of(&table, transport.passes.clone()), ..transport };
        let placement = match settings.antialiasing {
            Antialiasing::Grid(side) => Placement::Grid(side),
            _ => Placement::Filter(tabulate(settings.filter, settings.filter_width.clamp(0.0, 16.0))),
        };
        Ok(Self { camera: table, placement, rule: samples::rule(settings.antialiasing), transport, exposure: camera.exposure.0, window })
    }
}

/// Passes whose depths are what the lens wants: pictures all around have no axis.
fn deep_of(camera: &CameraTable, passes: Passes) -> Passes {
    let flat = matches!(camera.lens, Lens::Perspective | Lens::Orthographic);
    Passes { deep: passes.deep.map(|along| if flat { along } else { Distance::FromEye }), ..passes }
}

/// The light transport that settings ask for; `eye` and `forward` are the camera's, rebased world space.
pub(crate) fn transport(scene: &CompiledScene, settings: &Settings, execution: Execution, eye: [f32; 3], forward: [f32; 3]) -> Transport {
    let guides = [Aov::DenoisingAlbedo, Aov::DenoisingNormal, Aov::DenoisingLight].iter().any(|aov| settings.aovs.contains(aov));
    let estimator = match settings.integrator {
        Integrator::Whitted => Estimator::Trees(scene.tables.lights.fixed_samples(settings.light_samples).into()),
        _ => Estimator::Paths,
    };
    Transport {
        execution,
        limits: Limits {
            max_bounces: if settings.integrator == Integrator::Direct { 0 } else { settings.max_bounces },
            kind_bounces: settings.kind_bounces.map(|bounces| bounces.min(255)),
            volume_bounces: settings.volume_bounces.min(255),
            clamps: [settings.clamp_direct, settings.clamp_indirect],
            caustics: settings.caustic_paths,
            clear_roughness: match settings.background {
                Background::Transparent => settings.clear_roughness.unwrap_or(-1.0),
                _ => -1.0,
            },
        },
        shows_environment: settings.background != Background::Transparent,
        environment_covers: settings.background == Background::Covering,
        passes: Passes {
            shader: shader_passes::programs(&scene.tables.materials, settings),
            // What is wrong with them is told when the view is made.
            expressions: expressions::passes(scene, settings).unwrap_or_default(),
            openings: None,
            groups: light_groups::passes(&scene.tables.groups, settings),
            surface: [Aov::Depth, Aov::Normal, Aov::P, Aov::Albedo].iter().any(|aov| settings.aovs.contains(aov)),
            motion: None,
            uv: settings.aovs.contains(&Aov::Uv),
            mist: settings.aovs.contains(&Aov::Mist).then_some(Mist {
                start: settings.mist.start,
                depth: settings.mist.depth,
                falloff: settings.mist.falloff,
            }),
            guides,
            specular: guides && matches!(estimator, Estimator::Trees(_)),
            illuminance: settings.aovs.contains(&Aov::Illuminance),
            effort: settings.aovs.contains(&Aov::Cost),
            mattes: !settings.matte_kinds().is_empty(),
            deep: settings.aovs.contains(&Aov::Deep).then_some(Distance::AlongAxis),
            numbers: [Aov::PrimId, Aov::InstanceId, Aov::ElementId, Aov::ObjectIndex, Aov::MaterialIndex]
                .iter()
                .any(|aov| settings.aovs.contains(aov)),
        },
        eye,
        forward,
        squared_index: 1.0,
        seed: settings.seed,
        samples: settings.samples,
        light_cache: None,
        guiding: None,
        path_filter: PathFilter::All,
        estimator,
        light_paths: None,
        shutter: motion::shutter(&scene.tables, None, settings),
        photons: None,
        first_light: FirstLight::Splats,
    }
}

/// Refuses deep pictures of what has no depth.
fn check_deep(scene: &CompiledScene, settings: &Settings) -> Result<()> {
    let problem = if !settings.aovs.contains(&Aov::Deep) {
        return Ok(());
    } else if settings.antialiasing.is_adaptive() {
        "a deep picture wants samples drawn at random; leave out the antialiasing"
    } else if !scene.tables.geometry.set_catcher.is_empty() {
        "shadow catchers have no place in a deep picture; hide them"
    } else if !(settings.deep_tolerance > 0.0 && settings.deep_tolerance <= 1.0) {
        return Err(Error::setting("deep_tolerance", format!("{} was found, expected more than 0, up to 1", settings.deep_tolerance)));
    } else {
        return Ok(());
    };
    Err(Error::setting("deep", problem))
}

/// Refuses ranges of tiles that are empty or beyond the picture.
pub(crate) fn check_tiles(settings: &Settings, window: Crop) -> Result<()> {
    let count = Film::tiles_of(window) as u32;
    let range = settings.tiles(count);
    if range.start < range.end && range.end <= count {
        return Ok(());
    }
    Err(Error::setting("tiles", format!("the range {}:{} was found, expected a part of 0:{count}", range.start, range.end)))
}

/// Bytes of a pixel that is tone-mapped and encoded.
const SHOWN_BYTES: u64 = 16;

/// Refuses pictures for whose sums there is no memory.
fn check_memory(settings: &Settings, window: Crop) -> Result<()> {
    let channels = ChannelLayout::with_divisors(&settings.aovs).channels as u64;
    // Sums in double precision, another set from the second group of blocks on, and the picture of floats that is made of them.
    let sums = if settings.samples > GROUP { 16 } else { 8 };
    let pixels = |axis: usize| u64::from(window.max[axis] - window.min[axis]);
    let bytes = pixels(0) * pixels(1) * (channels * (sums + 4) + SHOWN_BYTES);
    room_for(bytes).map_err(|shortage| {
        let problem = format!("{} x {} pixels of {channels} channels: {shortage}", pixels(0), pixels(1));
        Error::setting("resolution", format!("{problem}; leave out passes, or render a part (crop)"))
    })
}

/// The part of the image that settings ask for.
pub(crate) fn window(settings: &Settings) -> Result<Crop> {
    let [width, height] = settings.resolution;
    if width == 0 || height == 0 || width > MOST_PIXELS || height > MOST_PIXELS {
        return Err(Error::Setting {
            name: "resolution".into(),
            problem: format!("{width} x {height} pixels, expected 1 to {MOST_PIXELS} each way"),
        });
    }
    let whole = Crop { min: [0, 0], max: settings.resolution };
    let Some(crop) = settings.crop else { return Ok(whole) };
    let crop = Crop { min: crop.min, max: [crop.max[0].min(width), crop.max[1].min(height)] };
    if crop.min[0] >= crop.max[0] || crop.min[1] >= crop.max[1] {
        return Err(Error::Setting { name: "crop".into(), problem: "the cropped window holds no pixel".into() });
    }
    Ok(crop)
}

/// The image plane in the lens's own coordinates: its size, the shift of its middle, and what the coordinates mean.
struct Plane {
    size: [f64; 2],
    middle: [f64; 2],
    lens: Lens,
}

impl Plane {
    fn new(camera: &Camera) -> Self {
        let offset = camera.aperture_offset;
        let flat = |scale: f64, lens| Self { size: camera.aperture.map(|a| a * scale), middle: offset.map(|a| a * scale), lens };
        // Panoramas are shifted in widths and heights of the picture.
        let around = |size: [f64; 2], middle: [f64; 2], lens| Self {
            size,
            middle: [middle[0] + offset[0] * size[0], middle[1] + offset[1] * size[1]],
            lens,
        };
        match camera.projection {
            Projection::Perspective { focal_length } => flat(1.0 / focal_length, Lens::Perspective),
            Projection::Orthographic => flat(1.0, Lens::Orthographic),
            Projection::Equirectangular { longitude: [left, right], latitude: [bottom, top] } => {
                around([right - left, top - bottom], [0.5 * (left + right), 0.5 * (bottom + top)], Lens::Equirectangular)
            }
            Projection::FisheyeEquidistant { fov_deg } => {
                let fov = fov_deg.min(FULL_TURN).to_radians();
                around([fov; 2], [0.0; 2], Lens::Equidistant { limit: (0.5 * fov) as f32 })
            }
            Projection::FisheyeEquisolid { focal_length, fov_deg, sensor } => {
                let limit = (0.25 * fov_deg.min(FULL_TURN).to_radians()).sin();
                around(sensor.map(|side| 0.5 * side / focal_length), [0.0; 2], Lens::Equisolid { limit: limit as f32 })
            }
        }
    }
    fn is_usable(&self) -> bool {
        let finite = self.size.iter().chain(&self.middle).all(|x| x.is_finite());
        // Longitudes and latitudes may run backwards: the picture is mirrored.
        let extended = match self.lens {
            Lens::Equirectangular => self.size.iter().all(|x| *x != 0.0),
            Lens::Perspective | Lens::Orthographic => self.size.iter().all(|x| *x > 0.0),
            Lens::Equidistant { limit } | Lens::Equisolid { limit } => self.size.iter().all(|x| *x > 0.0) && limit > 0.0,
        };
        finite && extended
    }
}

/// How a window of a camera's picture is seen; none where the camera is not usable.
pub(crate) fn picture_view(camera: &Camera, settings: &Settings, window: Crop) -> Option<PictureView> {
    let Plane { size, middle, lens } = Some(Plane::new(camera)).filter(Plane::is_usable)?;
    let projection = match lens {
        Lens::Perspective => PictureProjection::Perspective,
        Lens::Orthographic => PictureProjection::Orthographic,
        Lens::Equirectangular => PictureProjection::Equirectangular,
        Lens::Equidistant { limit } => PictureProjection::Equidistant { limit: f64::from(limit) },
        Lens::Equisolid { limit } => PictureProjection::Equisolid { limit: f64::from(limit) },
    };
    let share = |pixel: u32, axis: usize| f64::from(pixel) / f64::from(settings.resolution[axis]) - 0.5;
    let [left, right] = [window.min[0], window.max[0]].map(|x| middle[0] + size[0] * share(x, 0));
    let [top, bottom] = [window.min[1], window.max[1]].map(|y| middle[1] - size[1] * share(y, 1));
    let [_, up, back, position] = camera.transform.columns;
    let placed = [position, unit(back).map(|x| 0.0 - x), unit(up)];
    let placed = Some(placed).filter(|placed| placed.iter().flatten().all(|x| x.is_finite()));
    Some(PictureView { projection, window: [left, right, bottom, top], placed })
}

fn aperture(camera: &Camera) -> Aperture {
    Aperture {
        blades: if camera.blades == 0 { 0 } else { camera.blades.max(3) },
        rotation: if camera.blade_rotation_deg.is_finite() { camera.blade_rotation_deg.to_radians() as f32 } else { 0.0 },
        width: if camera.lens_ratio > 0.0 && camera.lens_ratio.is_finite() { camera.lens_ratio.recip() as f32 } else { 1.0 },
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

fn camera_table(camera: &Camera, settings: &Settings, origin: [f64; 3]) -> Result<CameraTable> {
    let columns = camera.transform.columns;
    let axes = [columns[0], columns[1], columns[2]].map(unit);
    let Plane { size, middle, lens } = Some(Plane::new(camera))
        .filter(|plane| plane.is_usable() && axes.iter().flatten().all(|x| x.is_finite()))
        .ok_or_else(|| Error::scene(&camera.origin, "the camera's aperture, lens or axes are not usable (zero or not finite)"))?;
    let [width, height] = settings.resolution.map(f64::from);
    let position: [f32; 3] = std::array::from_fn(|i| (columns[3][i] - origin[i]) as f32);
    Ok(CameraTable {
        axes: axes.map(|axis| axis.map(|x| x as f32)),
        position,
        corner: [(middle[0] - 0.5 * size[0]) as f32, (middle[1] + 0.5 * size[1]) as f32],
        pixel: [(size[0] / width) as f32, (size[1] / height) as f32],
        lens,
        lens_radius: if camera.lens_radius.is_finite() { camera.lens_radius.max(0.0) as f32 } else { 0.0 },
        aperture: aperture(camera),
        focus_distance: if camera.focus_distance > 0.0 { camera.focus_distance as f32 } else { 1.0 },
        planes: camera
            .clipping_planes
            .iter()
            .map(|plane| plane.map(|x| x as f32))
            .filter(|plane| plane.iter().all(|x| x.is_finite()))
            .collect(),
        clipping: [camera.clipping[0].max(0.0) as f32, camera.clipping[1].min(f64::from(f32::MAX)) as f32],
        motion: None,
        surroundings: Surroundings::OPEN,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Origin, Transform};

    fn table(camera: &Camera) -> Result<CameraTable> {
        camera_table(camera, &Settings { resolution: [8, 4], ..Settings::default() }, [0.0; 3])
    }

    fn plane(projection: Projection, offset: [f64; 2]) -> CameraTable {
        let camera = Camera { aperture_offset: offset, ..Camera::panorama(Origin::new("camera"), Transform::scale(3.0), projection) };
        table(&camera).expect("usable")
    }

    fn near(found: [f32; 2], expected: [f32; 2]) -> bool {
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn panoramas_span_the_picture() {
        let map = plane(Projection::Equirectangular { longitude: [-2.0, 1.5], latitude: [-0.7, 1.2] }, [0.0; 2]);
        assert!(near(map.corner, [-2.0, 1.2]) && near(map.pixel, [3.5 / 8.0, 1.9 / 4.0]), "{map:?}");
        assert_eq!(map.axes[0], [1.0, 0.0, 0.0]);
        let round = plane(Projection::FisheyeEquidistant { fov_deg: 180.0 }, [0.1, 0.05]);
        let pi = std::f32::consts::PI;
        assert!(near(round.corner, [-0.4 * pi, 0.55 * pi]) && near(round.pixel, [pi / 8.0, pi / 4.0]), "{round:?}");
        assert_eq!(round.lens, Lens::Equidistant { limit: pi / 2.0 });
        let lens = Projection::FisheyeEquisolid { focal_length: 10.5, fov_deg: 120.0, sensor: [30.0, 15.0] };
        let solid = plane(lens, [0.0; 2]);
        assert!(near(solid.corner, [-15.0 / 21.0, 7.5 / 21.0]), "{solid:?}");
        assert_eq!(solid.lens, Lens::Equisolid { limit: 0.5 });
    }

    #[test]
    fn openings_have_three_blades_or_none() {
        let opening = |blades| aperture(&Camera { blades, lens_ratio: 2.0, ..Camera::default() });
        assert_eq!([0, 1, 2, 3, 7].map(|blades| opening(blades).blades), [0, 3, 3, 3, 7]);
        assert_eq!(opening(5).width, 0.5);
    }

    #[test]
    fn lenses_without_extent_are_errors_that_name_the_camera() {
        let none = [
            Projection::Perspective { focal_length: 0.0 },
            Projection::Equirectangular { longitude: [1.0, 1.0], latitude: [-1.0, 1.0] },
            Projection::FisheyeEquidistant { fov_deg: 0.0 },
            Projection::FisheyeEquisolid { focal_length: f64::NAN, fov_deg: 100.0, sensor: [30.0; 2] },
        ];
        for projection in none {
            let error = table(&Camera::panorama(Origin::new("lookout"), Transform::IDENTITY, projection)).expect_err("no extent");
            assert!(error.to_string().contains("lookout"), "{error}");
        }
    }
}
