//! What fills a volume: the coefficients of its material, and the grids of the fields that they follow.

use super::curves::{Curve, STEPS};
use super::grid::Grid;
use super::{Field, Volume};
use crate::context::Context;
use crate::material::VolumeShading;
use gonio::scene::{Field as SceneField, Input, Lattice, Medium, Origin, Transform};
use std::collections::BTreeSet;
use std::sync::Arc;

/// What a coefficient may be off a proportion, of its greatest.
const TOLERANCE: f32 = 1e-4;
/// How far, in voxels, the second of two boxes in one another reaches beyond the first: faces in one place would be taken for one.
const MARGIN: f32 = 0.01;

/// A box and what is in it.
#[derive(Clone, Debug)]
pub(crate) struct Filling {
    /// A metre, without its field.
    pub(crate) medium: Medium,
    /// The field, placed in the space of the volume prim.
    pub(crate) field: SceneField,
    /// Whether the medium is the same all over the box, and the field says no more than where that is.
    pub(crate) is_even: bool,
    /// The fields of the velocities by which it flows; none where it does not.
    pub(crate) velocity: Vec<Field>,
}

/// Constant primvars of the prim.
pub(crate) type Primvars<'a> = &'a dyn Fn(&str) -> Option<[f32; 4]>;

/// What fills a volume prim of a material; what is wrong is told with its path. Where several grids count that have not the same voxels, each has a
/// box of its own.
pub(crate) fn fill(
    context: &mut Context<'_, '_>,
    origin: &Origin,
    volume: &Volume,
    shading: &VolumeShading,
    primvars: Primvars<'_>,
) -> Vec<Filling> {
    let mut filler = Filler { context, origin, volume, shading, primvars };
    filler.tell_missing();
    let Some([absorption, scattering]) = filler.coefficients() else { return Vec::new() };
    let emission = filler.emission();
    let mut parts = vec![scattering];
    match &mut parts[0] {
        // One of them is nothing, or both follow the same.
        part if part.is_clear() => *part = absorption,
        part if absorption.is_clear() || part.follows == absorption.follows => part.absorb(absorption),
        _ => parts.push(absorption),
    }
    if let Some(emission) = emission.filter(|emission| !emission.is_clear()) {
        match parts.iter_mut().find(|part| part.can_send(&emission)) {
            Some(part) => part.send(emission),
            None => parts.push(emission),
        }
    }
    parts.retain(|part| !part.is_clear());
    let mut fillings: Vec<Filling> = parts.into_iter().filter_map(|part| filler.filling(part)).collect();
    for (number, filling) in fillings.iter_mut().enumerate().skip(1) {
        let margin = MARGIN * number as f32;
        let [low, high] = &mut filling.field.density.domain;
        low.iter_mut().for_each(|x| *x -= margin);
        high.iter_mut().for_each(|x| *x += margin);
    }
    fillings
}

/// A field with its grid.
#[derive(Clone, Debug)]
struct Found {
    name: String,
    grid: Arc<Grid>,
    to_volume: Transform,
}

impl PartialEq for Found {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Coefficients that follow one field, or none.
#[derive(Clone, Debug, Default)]
struct Part {
    medium: Medium,
    /// What absorption and scattering follow.
    follows: Option<Found>,
    /// What the emission follows.
    heat: Option<Found>,
    glow: Vec<[f32; 3]>,
    /// Absorption and scattering at each step of the field, where one follows it by a curve; else empty.
    steps: [Vec<[f32; 3]>; 2],
}

impl Part {
    /// Takes in the absorption of a part that follows the same.
    fn absorb(&mut self, other: Self) {
        self.medium.absorption = other.medium.absorption;
        let [absorption, _] = other.steps;
        self.steps[0] = absorption;
    }

    /// What absorption and scattering are by the field, where one of them follows it by a curve.
    fn curve(&self) -> Option<Curve> {
        let found = self.follows.as_ref().filter(|_| self.steps.iter().any(|steps| !steps.is_empty()))?;
        let most = most(&found.grid.lattice);
        let straight = |value: [f32; 3]| (0..STEPS).map(|step| value.map(|x| x * most * step as f32 / (STEPS - 1) as f32)).collect();
        let of = |steps: &Vec<[f32; 3]>, value: [f32; 3]| if steps.is_empty() { straight(value) } else { steps.clone() };
        let [absorption, scattering] = &self.steps;
        Some(Curve::new(&of(absorption, self.medium.absorption), &of(scattering, self.medium.scattering), most))
    }

    fn is_clear(&self) -> bool {
        self.medium.is_clear() && self.steps.iter().flatten().flatten().all(|x| *x == 0.0)
    }

    /// Whether an emission can be in the same box: by the same voxels, or both even.
    fn can_send(&self, emission: &Self) -> bool {
        match (&self.follows, &emission.heat) {
            (None, None) => true,
            (Some(density), Some(heat)) => density.to_volume == heat.to_volume && density.grid.to_file == heat.grid.to_file,
            // An even emission is in all of a field's box; an even medium knows no heat.
            (Some(_), None) => true,
            (None, Some(_)) => self.is_clear(),
        }
    }

    fn send(&mut self, emission: Self) {
        self.medium.emission = emission.medium.emission;
        (self.heat, self.glow) = (emission.heat, emission.glow);
    }
}

struct Filler<'f, 'a, 'py> {
    context: &'f mut Context<'a, 'py>,
    origin: &'f Origin,
    volume: &'f Volume,
    shading: &'f VolumeShading,
    primvars: Primvars<'f>,
}

/// A coefficient a metre, the field that it follows, and what it is at each step of it where that is no proportion.
type Coefficient = ([f32; 3], Option<Found>, Vec<[f32; 3]>);

impl Filler<'_, '_, '_> {
    /// Absorption and scattering; `None` where the volume is left out, which is told.
    fn coefficients(&mut self) -> Option<[Part; 2]> {
        let shading = self.shading;
        let absorption = self.coefficient(shading.absorption)?;
        let scattering = self.coefficient(shading.scattering)?;
        let (value, follows, steps) = scattering;
        let medium = Medium { scattering: value, ..Medium::default() };
        let mut scattering = Part { medium, follows, steps: [Vec::new(), steps], ..Part::default() };
        let (value, follows, steps) = absorption;
        let medium = Medium { absorption: value, ..Medium::default() };
        let absorption = Part { medium, follows, steps: [steps, Vec::new()], ..Part::default() };
        scattering.medium.anisotropy = shading.anisotropy;
        Some([absorption, scattering])
    }

    /// What a coefficient is; `None` where the volume is left out, which is told.
    fn coefficient(&mut self, input: Input) -> Option<Coefficient> {
        let fields = self.fields_of(input);
        let at = |filler: &Self, x: f32| filler.value(input, Some(x));
        let (value, found, steps) = match fields.as_slice() {
            [] => (at(self, 0.0), None, Vec::new()),
            [field] => {
                let found = self.found(field)?;
                let most = most(&found.grid.lattice);
                let value = at(self, most);
                let is_curved = value.is_some_and(|value| !self.is_proportional(input, value, most));
                let steps = if is_curved { self.steps(input, most).unwrap_or_default() } else { Vec::new() };
                let steps: Vec<[f32; 3]> = steps.into_iter().map(|value| self.a_metre(value)).collect();
                (value.map(|value| value.map(|x| x / most)), Some(found), steps)
            }
            _ => {
                let names = names(&fields);
                self.context.unsupported(&format!("a volume whose coefficients follow several fields at once ({names})"), self.origin);
                return None;
            }
        };
        match value {
            Some(value) => Some((self.a_metre(value), found, steps)),
            None => {
                self.context.unsupported("a volume that varies by more than its fields", self.origin);
                None
            }
        }
    }

    /// An input evenly from no value of its field to the greatest.
    fn steps(&self, input: Input, most: f32) -> Option<Vec<[f32; 3]>> {
        let step = most / (STEPS - 1) as f32;
        (0..STEPS).map(|place| self.value(input, Some(place as f32 * step))).collect()
    }

    /// What the volume sends; `None` where that is left out, which is told.
    fn emission(&mut self) -> Option<Part> {
        let input = self.shading.emission;
        let fields = self.fields_of(input);
        if fields.len() > 1 {
            let names = names(&fields);
            self.context.unsupported(&format!("an emission that follows several fields at once ({names})"), self.origin);
            return None;
        }
        let Some(field) = fields.first() else {
            let value = self.value(input, None);
            return self
                .or_told(value)
                .map(|emission| Part { medium: Medium { emission: self.a_metre(emission), ..Medium::default() }, ..Part::default() });
        };
        let found = self.found(field)?;
        let most = most(&found.grid.lattice);
        let value = self.value(input, Some(most));
        let value = self.or_told(value)?;
        let mut part = Part { heat: Some(found), ..Part::default() };
        if self.is_proportional(input, value, most) {
            part.medium.emission = self.a_metre(value.map(|x| x / most));
        } else {
            let values = self.steps(input, most);
            part.glow = self.or_told(values)?;
            part.medium.emission = self.a_metre([1.0; 3]);
        }
        Some(part)
    }

    fn or_told<T>(&mut self, value: Option<T>) -> Option<T> {
        if value.is_none() {
            self.context.unsupported("an emission that varies by more than the volume's fields", self.origin);
        }
        value
    }

    /// The fields of the volume that an input follows.
    fn fields_of(&self, input: Input) -> Vec<Field> {
        self.shading.names(input).into_iter().filter_map(|name| self.volume.field(name).cloned()).collect()
    }

    /// Says what the material asks for that is neither a field nor a primvar: its default counts.
    fn tell_missing(&mut self) {
        let VolumeShading { path, absorption, scattering, emission, .. } = self.shading;
        let names: BTreeSet<&str> = [absorption, scattering, emission].into_iter().flat_map(|input| self.shading.names(*input)).collect();
        for name in names.into_iter().filter(|name| self.volume.field(name).is_none() && (self.primvars)(name).is_none()) {
            let message = || format!("the material <{path}> asks for '{name}', which is no field of the volume; its default counts");
            self.context.once("no such field", &format!("{path} {name}"), self.origin, message);
        }
    }

    /// An input where its field has a value.
    fn value(&self, input: Input, at: Option<f32>) -> Option<[f32; 3]> {
        let given = |name: &str| match self.volume.field(name) {
            Some(_) => at.map(|x| [x; 4]),
            None => (self.primvars)(name),
        };
        // No medium absorbs, scatters or sends less than nothing.
        Some(self.shading.value(input, &given)?.map(|x| x.max(0.0)))
    }

    /// Whether an input goes straight from 0 to what it is at `most`.
    fn is_proportional(&self, input: Input, value: [f32; 3], most: f32) -> bool {
        let room = TOLERANCE * value.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
        [0.0, 0.1, 0.35, 0.7].iter().all(|share| {
            let found = self.value(input, Some(share * most));
            found.is_some_and(|found| found.iter().zip(value).all(|(found, value)| (found - share * value).abs() <= room))
        })
    }

    /// From one over the stage's units to one over metres.
    fn a_metre(&self, value: [f32; 3]) -> [f32; 3] {
        let metres = self.context.metres_per_unit as f32;
        value.map(|x| x / metres)
    }

    /// The grid of a field; `None` where it cannot be used, which is told once a field.
    fn found(&mut self, field: &Field) -> Option<Found> {
        let py = self.context.py;
        match self.context.grids.grid(py, field) {
            Ok(grid) => Some(Found { name: field.name.clone(), grid, to_volume: field.to_volume }),
            Err(problem) => {
                let message = || format!("its field '{}' cannot be used: {problem}; what follows it is left out", field.name);
                self.context.once("field", &field.path, self.origin, message);
                None
            }
        }
    }

    /// A part as a box with its field.
    fn filling(&mut self, part: Part) -> Option<Filling> {
        let curve = part.curve();
        let Part { mut medium, follows, heat, glow, .. } = part;
        let is_even = follows.is_none() && heat.is_none();
        let found = match follows.as_ref().or(heat.as_ref()) {
            Some(found) => found.clone(),
            None => self.any_grid()?,
        };
        let heat = heat.map(|heat| heat.grid.lattice.clone());
        let mut field = SceneField {
            origin: self.origin.clone(),
            to_world: found.to_volume.after(&found.grid.to_file),
            density: found.grid.lattice.clone(),
            hottest: heat.as_ref().map_or(0.0, Lattice::most),
            heat,
            glow,
            ..SceneField::default()
        };
        if let Some(curve) = curve {
            self.tell_beginning(&curve, follows.as_ref());
            let curved = curve.applied(&field.density, &medium);
            (medium, field.density, field.taken) = (curved.medium, curved.density, curved.taken);
        }
        if is_even {
            let message = || format!("the material <{}> follows no field; the box about the grid is filled evenly", self.shading.path);
            self.context.once("even volume", &self.shading.path, self.origin, message);
            // From the outer faces of the voxels, without what fields fade over.
            let [low, high] = &mut field.density.domain;
            low.iter_mut().for_each(|x| *x += 0.5);
            high.iter_mut().for_each(|x| *x -= 0.5);
        }
        let velocity = if is_even { Vec::new() } else { self.volume.velocity() };
        Some(Filling { medium, field, is_even, velocity })
    }

    /// Says where coefficients that are not 0 where their field is come to an end.
    fn tell_beginning(&mut self, curve: &Curve, follows: Option<&Found>) {
        let Some(found) = follows.filter(|_| curve.starts_above_nothing()) else { return };
        let message =
            || format!("its coefficients are above 0 where the field '{}' is 0; they end with the grid's blocks of voxels", found.name);
        self.context.once("volume curve", &format!("{} {}", self.shading.path, found.name), self.origin, message);
    }

    /// The grid that says where an even volume is.
    fn any_grid(&mut self) -> Option<Found> {
        self.found(self.volume.density())
    }
}

/// The greatest value of a lattice, 1 where none is above 0.
fn most(lattice: &Lattice) -> f32 {
    match lattice.most() {
        most if most > 0.0 => most,
        _ => 1.0,
    }
}

fn names(fields: &[Field]) -> String {
    fields.iter().map(|field| field.name.as_str()).collect::<Vec<_>>().join(", ")
}
