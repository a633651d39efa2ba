//! Primvars: of meshes, with all interpolations and indices, and those that the namespace hands down.

use crate::context::Context;
use crate::model::Inherited;
use crate::prim::{Attribute, Prim};
use crate::vt::{FloatArray, FromValue, float_array_or_scalar};
use gonio::mesh::{FacePrimvar, Interpolation};
use std::rc::Rc;

const PREFIX: &str = "primvars:";
const INDICES: &str = ":indices";

/// The prim's authored primvars with values of 1 to 4 floats; `normals` is not among them. Those of other types are left out in silence.
pub fn authored<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Vec<FacePrimvar> {
    let names: Vec<String> = names(prim).map(str::to_owned).collect();
    names.iter().filter(|name| *name != "normals").filter_map(|name| read(context, prim, name)).collect()
}

fn names<'a>(prim: &'a Prim<'_>) -> impl Iterator<Item = &'a str> {
    let names = prim.authored_names().iter().filter_map(|name| name.strip_prefix(PREFIX));
    // Skinning is baked, its weights are of no use to a surface.
    names.filter(|name| !name.ends_with(INDICES) && !name.starts_with("skel:"))
}

/// The prim's primvar called `name`, `None` where it has no value or is not of floats.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str) -> Option<FacePrimvar> {
    let attribute = prim.attribute(&format!("{PREFIX}{name}"))?;
    let interpolation = interpolation(context, prim, &attribute, Interpolation::Constant);
    let mut primvar = from_attribute(context, &attribute, name, interpolation)?;
    let indices_name = format!("{PREFIX}{name}{INDICES}");
    if prim.has_authored(&indices_name)
        && let Some(indices) = context.get::<Vec<i32>>(prim, &indices_name)
    {
        // A negative index becomes one that is out of range, which the mesh's check reports.
        primvar.indices = Some(indices.into_iter().map(|index| u32::try_from(index).unwrap_or(u32::MAX)).collect());
    }
    Some(primvar)
}

/// The diameters of curves and points: `primvars:widths` goes before `widths`.
pub fn widths<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<FacePrimvar> {
    of_either_name(context, prim, "widths")
}

/// A value that may stand among the primvars or by itself, there of points unless it says otherwise.
fn of_either_name<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, name: &str) -> Option<FacePrimvar> {
    let found = if prim.has_authored(&format!("{PREFIX}{name}")) { read(context, prim, name) } else { None };
    found.or_else(|| {
        let attribute = if prim.has_authored(name) { prim.attribute(name)? } else { return None };
        let interpolation = interpolation(context, prim, &attribute, Interpolation::Vertex);
        from_attribute(context, &attribute, name, interpolation)
    })
}

/// The normals: `primvars:normals` goes before `normals`.
pub fn normals<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<FacePrimvar> {
    let found = of_either_name(context, prim, "normals")?;
    if found.components == 3 {
        return Some(found);
    }
    context.warn(&prim.origin(), format!("normals have {} components, expected 3; they are ignored", found.components));
    None
}

fn interpolation(context: &mut Context<'_, '_>, prim: &Prim<'_>, attribute: &Attribute<'_>, otherwise: Interpolation) -> Interpolation {
    let Some(token) = attribute.metadata("interpolation").and_then(|token| String::from_value(&token)) else { return otherwise };
    match token.as_str() {
        "constant" => Interpolation::Constant,
        "uniform" => Interpolation::Uniform,
        "varying" => Interpolation::Varying,
        "vertex" => Interpolation::Vertex,
        "faceVarying" => Interpolation::FaceVarying,
        // One value an instance: a point instancer has many, any other prim stands for one.
        "instance" if prim.type_name() == "PointInstancer" => Interpolation::Varying,
        "instance" => Interpolation::Constant,
        other => {
            let origin = gonio::scene::Origin::new(attribute.path());
            context.warn(&origin, format!("interpolation is '{other}', expected constant, uniform, varying, vertex or faceVarying"));
            otherwise
        }
    }
}

fn from_attribute<'py>(
    context: &mut Context<'_, 'py>,
    attribute: &Attribute<'py>,
    name: &str,
    interpolation: Interpolation,
) -> Option<FacePrimvar> {
    let value = context.get_value(attribute)?;
    let FloatArray { components, values } = float_array_or_scalar(&value)?;
    let element_size = attribute.metadata("elementSize").and_then(|size| i32::from_value(&size)).unwrap_or(1).max(1) as usize;
    let tuple = components.max(1);
    let components = tuple.checked_mul(element_size)?;
    // Some exporters write the number of values there: of texture coordinates it cannot mean tuples of tuples.
    let components = if tuple > 1 && components > 4 { tuple } else { components };
    // An array behind a constant primvar is one value only where its length says so.
    let is_usable = (1..=4).contains(&components) && !values.is_empty();
    is_usable.then(|| FacePrimvar { name: name.to_owned(), interpolation, components, values, indices: None })
}

/// What the prim hands down to those below: `above` with its own constant primvars before them.
pub fn handed_down<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, above: &Rc<[Inherited]>) -> Rc<[Inherited]> {
    if !prim.has_authored_prefix(PREFIX) {
        return above.clone();
    }
    let own: Vec<Inherited> = authored(context, prim).iter().filter_map(constant).collect();
    merged(&own, above)
}

/// The nearer values and those of the farther whose names are not among them.
pub fn merged(near: &[Inherited], far: &[Inherited]) -> Rc<[Inherited]> {
    let is_hidden = |name: &str| near.iter().any(|own| own.name == name);
    near.iter().chain(far.iter().filter(|inherited| !is_hidden(&inherited.name))).cloned().collect()
}

/// A constant primvar as a value for placements; `None` for other interpolations.
pub fn constant(primvar: &FacePrimvar) -> Option<Inherited> {
    if primvar.interpolation != Interpolation::Constant {
        return None;
    }
    Some(Inherited { name: primvar.name.clone(), components: primvar.components, values: primvar.at(0)?.into(), is_varying: false })
}
