//! Surfaces.

use super::Reader;
use super::materials::{Entry, What};
use super::round::{disc, lathe, sphere};
use super::tokens::Object;
use super::xform::Placed;
use crate::builder::Triangles;
use crate::default_sky::add_dome;
use crate::modifier::{Modifier, luminous};
use crate::outline::cut;
use crate::vector::{Vec3, across, cross, length, sub, unit};
use gonio_scene::{LightShape, Origin, Transform};

/// Sources wider than this in degrees are domes.
const WIDEST_SUN: f64 = 90.0;

impl Reader {
    /// Adds a surface.
    ///
    /// # Errors
    /// What makes it none.
    pub(super) fn surface(&mut self, origin: &Origin, object: &Object<'_>, placed: &Placed) -> Result<(), String> {
        if matches!(object.kind, "instance" | "mesh") {
            return Err("octrees and compiled meshes are not read".into());
        }
        let name = placed.modifier.as_deref().unwrap_or(object.modifier);
        if name == "void" {
            return Ok(());
        }
        let entry = self.entry(name)?;
        let radiance = match &entry.what {
            What::Material(Modifier::Light { radiance }) => Some(luminous(*radiance)),
            _ => None,
        };
        let numbers = Arguments { numbers: &object.numbers, placed };
        if object.kind == "source" {
            return self.far(origin, &numbers, &entry, radiance);
        }
        if let (Some(radiance), "sphere") = (radiance, object.kind) {
            numbers.expect(4)?;
            let transform = Transform::translation(numbers.point(0));
            self.builder.add_lamp(origin, LightShape::Sphere { radius: numbers.radius(3)? }, transform, radiance);
            return Ok(());
        }
        let shape = if object.kind == "polygon" { self.polygon(origin, &numbers)? } else { round(object.kind, &numbers)? };
        if let Some(paint) = self.paint_of(&entry) {
            self.builder.add(origin, shape, &paint);
        }
        Ok(())
    }

    fn polygon(&mut self, origin: &Origin, numbers: &Arguments<'_>) -> Result<Triangles, String> {
        let count = numbers.numbers.len();
        if count < 9 || !count.is_multiple_of(3) {
            return Err(format!("{count} numbers were found, expected three for each of three corners or more"));
        }
        let mut corners: Vec<Vec3> = (0..count / 3).map(|corner| numbers.point(3 * corner)).collect();
        if numbers.placed.is_turned_over() {
            corners.reverse();
        }
        let cut = cut(&corners, &[])?;
        if let Some(doubt) = cut.doubt {
            self.builder.warn(origin, format!("polygon: {doubt}"));
        }
        Ok(Triangles::of_cut(&cut, 1.0))
    }

    /// Adds a source at infinity.
    fn far(&mut self, origin: &Origin, numbers: &Arguments<'_>, entry: &Entry, radiance: Option<[f32; 3]>) -> Result<(), String> {
        numbers.expect(4)?;
        let Some(radiance) = radiance else { return Err("its material does not shine".into()) };
        if let Some(pattern) = &entry.pattern {
            // Without it the light would be another by any factor.
            return Err(format!("its pattern '{pattern}' is not read; --sun gives sun and sky"));
        }
        let z = unit(numbers.placed.transform.vector([numbers.numbers[0], numbers.numbers[1], numbers.numbers[2]]));
        let z = z.ok_or("its direction is no direction")?;
        let angle = numbers.numbers[3];
        if !(angle > 0.0 && angle <= 360.0) {
            return Err(format!("its angle is {angle}, expected a number above 0 and at most 360"));
        }
        if angle > WIDEST_SUN {
            let edge = (0.5 * angle).to_radians().cos();
            add_dome(&mut self.builder.model.scene, origin, z, |sine| if sine >= edge { radiance } else { [0.0; 3] });
        } else {
            let x = across(z);
            let transform = Transform { columns: [x, cross(z, x), z, [0.0; 3]] };
            self.builder.add_lamp(origin, LightShape::Distant { angle_deg: angle }, transform, radiance);
        }
        Ok(())
    }
}

/// Spheres, cones and rings as meshes.
fn round(kind: &str, numbers: &Arguments<'_>) -> Result<Triangles, String> {
    let inwards = matches!(kind, "bubble" | "tube" | "cup") != numbers.placed.inverted;
    let shape = match kind {
        "sphere" | "bubble" => {
            numbers.expect(4)?;
            sphere(numbers.point(0), numbers.radius(3)?)
        }
        "ring" => {
            numbers.expect(8)?;
            let axis = unit(numbers.placed.transform.vector([numbers.numbers[3], numbers.numbers[4], numbers.numbers[5]]));
            let axis = axis.ok_or("its direction is no direction")?;
            let radii = [numbers.radius_or_none(6)?, numbers.radius_or_none(7)?];
            disc(numbers.point(0), axis, [radii[0].min(radii[1]), radii[0].max(radii[1])])?
        }
        _ => {
            let count = if matches!(kind, "cone" | "cup") { 8 } else { 7 };
            numbers.expect(count)?;
            let [bottom, top] = [numbers.point(0), numbers.point(3)];
            let axis = sub(top, bottom);
            let direction = unit(axis).ok_or("its ends are at one place")?;
            lathe(bottom, direction, length(axis), [numbers.radius_or_none(6)?, numbers.radius_or_none(count - 1)?])?
        }
    };
    Ok(if inwards { shape.inside_out() } else { shape })
}

/// The numbers of a surface, as they are placed.
struct Arguments<'a> {
    numbers: &'a [f64],
    placed: &'a Placed,
}

impl Arguments<'_> {
    fn expect(&self, count: usize) -> Result<(), String> {
        let found = self.numbers.len();
        if found == count { Ok(()) } else { Err(format!("{found} numbers were found, expected {count}")) }
    }

    fn point(&self, at: usize) -> Vec3 {
        self.placed.transform.point([self.numbers[at], self.numbers[at + 1], self.numbers[at + 2]])
    }

    fn radius_or_none(&self, at: usize) -> Result<f64, String> {
        let radius = self.numbers[at];
        if radius >= 0.0 {
            Ok(radius * self.placed.scale)
        } else {
            Err(format!("radius {radius} was found, expected a number of 0 or more"))
        }
    }

    fn radius(&self, at: usize) -> Result<f64, String> {
        let radius = self.radius_or_none(at)?;
        if radius > 0.0 { Ok(radius) } else { Err("radius 0 was found, expected a number above 0".into()) }
    }
}
