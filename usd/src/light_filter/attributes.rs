//! Values of a light filter's attributes, whose names differ between RenderMan and the schemas of before.

use crate::context::Context;
use crate::material::{stated_colour_space, to_linear_rec709};
use crate::prim::{Attribute, Prim};
use crate::vt::FromValue;

/// An attribute that has other names elsewhere: RenderMan's own, and those of the schemas before.
pub(super) fn attribute<'py>(filter: &Prim<'py>, names: &[&str]) -> Option<Attribute<'py>> {
    let spelled = |name: &&str| [format!("inputs:ri:lightFilter:{name}"), format!("inputs:{name}"), (*name).to_owned()];
    names.iter().flat_map(spelled).find(|name| filter.has_authored(name)).and_then(|name| filter.attribute(&name))
}

/// The value of an attribute; none where nothing is authored.
pub(super) fn value<'py, T: FromValue>(context: &mut Context<'_, 'py>, filter: &Prim<'py>, names: &[&str]) -> Option<T> {
    context.get_attribute(&attribute(filter, names)?)
}

/// A finite number.
pub(super) fn number<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>, names: &[&str], default: f64) -> f64 {
    let found: f64 = value(context, filter, names).unwrap_or(default);
    if found.is_finite() {
        return found;
    }
    context.warn(&filter.origin(), format!("{} is {found}, expected a finite number; {default} is used", names[0]));
    default
}

/// A choice that is a number with RenderMan and a word in the schemas before.
pub(super) fn choice<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>, names: &[&str], words: &[&str]) -> usize {
    let Some(attribute) = attribute(filter, names) else { return 0 };
    let Some(found) = context.get_value(&attribute) else { return 0 };
    let chosen = match String::from_value(&found) {
        Some(word) => words.iter().position(|known| *known == word),
        None => i32::from_value(&found).and_then(|number| usize::try_from(number).ok()).filter(|number| *number < words.len()),
    };
    chosen.unwrap_or_else(|| {
        let expected = words.join(", ");
        context.warn(&filter.origin(), format!("{} is none of {expected} or their numbers; {} is used", names[0], words[0]));
        0
    })
}

/// A colour in linear Rec.709.
pub(super) fn colour<'py>(context: &mut Context<'_, 'py>, filter: &Prim<'py>, names: &[&str], default: [f32; 3]) -> [f32; 3] {
    let found = value::<[f32; 3]>(context, filter, names).filter(|colour| colour.iter().all(|x| x.is_finite()));
    let Some([r, g, b]) = found else { return default };
    let space = attribute(filter, names).map(|attribute| stated_colour_space(&attribute)).unwrap_or_default();
    to_linear_rec709([r, g, b, 1.0], &space).map_or([r, g, b], |[r, g, b, _]| [r, g, b])
}
