//! Point instancers: which prototype stands where, with which values.

use crate::context::Context;
use crate::model::Inherited;
use crate::prim::Prim;
use crate::primvar;
use crate::pxr::Module;
use crate::vt::FromValue;
use gonio::mesh::FacePrimvar;
use gonio::scene::Transform;
use pyo3::intern;
use pyo3::prelude::*;

/// The placements of one prototype.
#[derive(Debug)]
pub struct Placed {
    /// Path of the prototype's root prim.
    pub prototype: String,
    /// From the prototype's parent space to the instancer's.
    pub transforms: Vec<Transform>,
    /// Values of the instancer, one for all or one a placement.
    pub primvars: Vec<Inherited>,
}

/// Reads an instancer: an entry for each prototype that is placed at least once. What cannot be used is reported.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Vec<Placed> {
    let origin = prim.origin();
    let prototypes = prim.targets("prototypes");
    let Some(chosen) = context.get_authored::<Vec<i32>>(prim, "protoIndices") else {
        context.once("instancer", "protoIndices", &origin, || "the point instancer has no protoIndices".into());
        return Vec::new();
    };
    if let Some(problem) = length_problem(context, prim, chosen.len()) {
        context.warn(&origin, format!("{problem}; the point instancer is left out"));
        return Vec::new();
    }
    let result = transforms_and_mask(context, prim);
    let Some((matrices, mask)) = context.attempt(&origin, "the instances' transformations cannot be had", result) else {
        return Vec::new();
    };
    if matrices.len() != chosen.len() {
        context
            .warn(&origin, format!("{} transformations for {} instances; the point instancer is left out", matrices.len(), chosen.len()));
        return Vec::new();
    }
    let members = members(context, prim, &chosen, &mask, &matrices, prototypes.len());
    let values = primvar::authored(context, prim);
    let entries = prototypes.into_iter().zip(members).filter(|(_, members)| !members.is_empty());
    entries
        .map(|(prototype, members)| Placed {
            prototype,
            transforms: members.iter().map(|&member| Transform::from_row_vector_matrix(&matrices[member as usize])).collect(),
            primvars: values.iter().filter_map(|primvar| selected(primvar, &members, chosen.len())).collect(),
        })
        .collect()
}

/// What is wrong with the lengths of the instancer's arrays; `pxr` would only answer with nothing.
fn length_problem<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, count: usize) -> Option<String> {
    let mut length = |name: &str| -> Option<usize> {
        let attribute = if prim.has_authored(name) { prim.attribute(name)? } else { return None };
        context.get_value(&attribute)?.len().ok()
    };
    match length("positions") {
        None => return Some("there are no positions".into()),
        Some(found) if found != count => return Some(format!("{found} positions for {count} protoIndices")),
        Some(_) => {}
    }
    ["orientations", "orientationsf", "scales", "ids"].iter().find_map(|name| {
        // Empty arrays count as not authored.
        let found = length(name).filter(|&found| found != 0 && found != count)?;
        Some(format!("{found} {name} for {count} protoIndices"))
    })
}

type Matrix = [[f64; 4]; 4];

/// The matrices of all instances, hidden ones too so that they agree with protoIndices, and which are shown (empty: all).
fn transforms_and_mask<'py>(context: &Context<'_, 'py>, prim: &Prim<'py>) -> PyResult<(Vec<Matrix>, Vec<bool>)> {
    let (py, time) = (context.py, &context.time);
    let class = Module::UsdGeom.item(py, "PointInstancer")?;
    let instancer = class.call1((prim.object(),))?;
    let without_prototype = class.getattr(intern!(py, "ExcludeProtoXform"))?;
    let unmasked = class.getattr(intern!(py, "IgnoreMask"))?;
    let matrices = instancer.call_method1(intern!(py, "ComputeInstanceTransformsAtTime"), (time, time, without_prototype, unmasked))?;
    let matrices = if matrices.len()? == 0 { Vec::new() } else { Vec::<Matrix>::from_value(&matrices).unwrap_or_default() };
    let mask = instancer.call_method1(intern!(py, "ComputeMaskAtTime"), (time,))?;
    let mask = mask.try_iter()?.map(|flag| flag?.extract()).collect::<PyResult<Vec<bool>>>()?;
    Ok((matrices, mask))
}

/// The shown instances of each prototype.
fn members(
    context: &mut Context<'_, '_>,
    prim: &Prim<'_>,
    chosen: &[i32],
    mask: &[bool],
    matrices: &[Matrix],
    prototype_count: usize,
) -> Vec<Vec<u32>> {
    let mut members = vec![Vec::new(); prototype_count];
    let (mut outside, mut broken) = (0usize, 0usize);
    for (instance, &prototype) in chosen.iter().enumerate() {
        if !mask.get(instance).copied().unwrap_or(true) {
            continue;
        }
        let Some(list) = usize::try_from(prototype).ok().and_then(|prototype| members.get_mut(prototype)) else {
            outside += 1;
            continue;
        };
        if matrices[instance].iter().flatten().all(|x| x.is_finite()) {
            list.push(instance as u32);
        } else {
            broken += 1;
        }
    }
    let origin = prim.origin();
    if outside > 0 {
        context
            .warn(&origin, format!("{outside} protoIndices name no prototype, there are {prototype_count}; these instances are left out"));
    }
    if broken > 0 {
        context.warn(&origin, format!("{broken} instances have transformations that are not finite; they are left out"));
    }
    members
}

/// The values of the instances in `members`; `None` where there is neither one value nor one an instance.
fn selected(primvar: &FacePrimvar, members: &[u32], instance_count: usize) -> Option<Inherited> {
    if let Some(constant) = primvar::constant(primvar) {
        return Some(constant);
    }
    if primvar.place_count() != instance_count {
        return None;
    }
    let mut values = Vec::with_capacity(members.len() * primvar.components);
    for &member in members {
        values.extend_from_slice(primvar.at(member as usize)?);
    }
    Some(Inherited { name: primvar.name.clone(), components: primvar.components, values: values.into(), is_varying: true })
}
