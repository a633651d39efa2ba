//! Materials, patterns and aliases.

use super::tokens::{Object, PATTERNS};
use super::xform::Placed;
use super::{Reader, Source};
use crate::builder::Paint;
use crate::measured;
use crate::modifier::{GLASS_INDEX, Modifier};
use crate::vector::Vec3;
use gonio_scene::Origin;
use std::path::{Path, PathBuf};

/// What a name stands for.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) what: What,
    pub(super) origin: Origin,
    /// Tells materials of one name apart.
    key: String,
    /// The pattern or texture that it should have.
    pub(super) pattern: Option<String>,
}

#[derive(Clone, Debug)]
pub(super) enum What {
    Material(Modifier),
    Pattern,
    /// Surfaces that have it are left out.
    Broken,
}

impl Reader {
    /// Takes a definition down.
    pub(super) fn define(&mut self, source: &Source<'_>, origin: &Origin, object: &Object<'_>, placed: &Placed) {
        let pattern = (object.modifier != "void").then(|| object.modifier.to_owned());
        let what = if PATTERNS.contains(&object.kind) {
            self.once(object.kind, origin, &format!("{} is not read; surfaces are shown without it", object.kind));
            self.mixed(object).unwrap_or(What::Pattern)
        } else {
            match self.material(source, origin, object, placed) {
                Ok(modifier) => What::Material(modifier),
                Err(problem) => {
                    self.builder.warn(origin, format!("{}: {problem}; surfaces that have it are left out", object.kind));
                    What::Broken
                }
            }
        };
        let turned = match &what {
            What::Material(Modifier::Dielectric { .. } | Modifier::Measured { .. }) => format!("{:?}", placed.transform.columns),
            _ => String::new(),
        };
        let key = format!("{origin}{turned}");
        self.entries.insert(object.name.to_owned(), Entry { what, origin: origin.clone(), key, pattern });
    }

    /// A mixture is its foreground.
    fn mixed(&self, object: &Object<'_>) -> Option<What> {
        let name = object.strings.first().filter(|_| object.kind.starts_with("mix"))?;
        if *name == "void" { Some(What::Material(Modifier::Void)) } else { self.entries.get(*name).map(|entry| entry.what.clone()) }
    }

    pub(super) fn alias(&mut self, origin: &Origin, object: &Object<'_>) {
        let of = object.strings.first().copied().unwrap_or("void");
        match self.entries.get(of).cloned() {
            Some(entry) => {
                self.entries.insert(object.name.to_owned(), entry);
            }
            None => self.builder.warn(origin, format!("alias: there is no modifier '{of}'; it is left out")),
        }
    }

    fn material(&mut self, source: &Source<'_>, origin: &Origin, object: &Object<'_>, placed: &Placed) -> Result<Modifier, String> {
        let numbers = Numbers { numbers: &object.numbers };
        let modifier = match object.kind {
            "plastic" | "metal" | "plastic2" | "metal2" => {
                let is_wide = object.kind.ends_with('2');
                let [specularity, roughness, other] = numbers.after_colour(if is_wide { 6 } else { 5 })?;
                let (colour, roughness) = (numbers.colour()?, if is_wide { (roughness * other).max(0.0).sqrt() } else { roughness });
                if is_wide {
                    self.once(object.kind, origin, &format!("{} is shown isotropic, with the mean of its two roughnesses", object.kind));
                }
                match object.kind.starts_with("metal") {
                    true => Modifier::Metal { colour, specularity, roughness },
                    false => Modifier::Plastic { colour, specularity, roughness },
                }
            }
            "trans" => self.trans(&numbers, origin, false)?,
            "trans2" => self.trans(&numbers, origin, true)?,
            "glass" => {
                let index = numbers.numbers.get(3).copied().unwrap_or(GLASS_INDEX);
                Modifier::Glass { transmissivity: numbers.colour()?, index }
            }
            "dielectric" => {
                Modifier::Dielectric { transmissivity: numbers.colour()?, index: numbers.after_colour::<1>(4)?[0], metres: placed.scale }
            }
            "mirror" => Modifier::Mirror { colour: numbers.colour()? },
            "light" => Modifier::Light { radiance: numbers.colour()? },
            "glow" => self.glow(&numbers, origin)?,
            "illum" => self.illum(object, origin)?,
            "spotlight" => {
                self.once("spotlight", origin, "spotlight shines as light does, without its cone");
                Modifier::Light { radiance: numbers.colour()? }
            }
            "BSDF" | "aBSDF" => measured_of(source, object, placed)?,
            other => return Err(format!("{other} is not read")),
        };
        modifier.problem().map_or(Ok(modifier), Err)
    }

    fn trans(&mut self, numbers: &Numbers<'_>, origin: &Origin, is_wide: bool) -> Result<Modifier, String> {
        let [specularity, u, v, transmitted, transmitted_specular] = if is_wide {
            self.once("trans2", origin, "trans2 is shown isotropic, with the mean of its two roughnesses");
            numbers.after_colour(8)?
        } else {
            let [specularity, roughness, transmitted, specular, _] = numbers.after_colour(7)?;
            [specularity, roughness, roughness, transmitted, specular]
        };
        let roughness = (u * v).max(0.0).sqrt();
        if roughness > 0.0 && transmitted * transmitted_specular > 0.0 {
            self.once("trans rough", origin, "what trans lets pass specularly goes straight on, whatever its roughness");
        }
        Ok(Modifier::Trans { colour: numbers.colour()?, specularity, roughness, transmitted, transmitted_specular })
    }

    fn glow(&mut self, numbers: &Numbers<'_>, origin: &Origin) -> Result<Modifier, String> {
        if numbers.numbers.get(3).is_some_and(|radius| *radius < 0.0) {
            self.once("glow", origin, "glow of a radius below 0 lights its surroundings, too");
        }
        Ok(Modifier::Light { radiance: numbers.colour()? })
    }

    /// An illum is what it stands before: its alternate, else nothing.
    fn illum(&mut self, object: &Object<'_>, origin: &Origin) -> Result<Modifier, String> {
        self.once("illum", origin, "illum is shown as its alternate material; the light behind it is found by itself");
        match object.strings.first().copied() {
            None | Some("void") => Ok(Modifier::Void),
            Some(name) => match self.entries.get(name).map(|entry| &entry.what) {
                Some(What::Material(modifier)) => Ok(modifier.clone()),
                _ => Err(format!("there is no material '{name}'")),
            },
        }
    }

    /// What a surface's modifier is; patterns before a material are left out.
    ///
    /// # Errors
    /// There is no such modifier, or it could not be read.
    pub(super) fn entry(&self, name: &str) -> Result<Entry, String> {
        let entry = self.entries.get(name).ok_or_else(|| format!("there is no modifier '{name}'"))?;
        match &entry.what {
            What::Material(_) => Ok(entry.clone()),
            What::Broken => Err(format!("its modifier '{name}' could not be read")),
            What::Pattern => Err(format!("its modifier '{name}' is no material")),
        }
    }

    pub(super) fn paint_of(&mut self, entry: &Entry) -> Option<Paint> {
        let What::Material(modifier) = &entry.what else { return None };
        self.builder.paint(&entry.key, &entry.origin, modifier)
    }
}

/// The numbers of a material.
struct Numbers<'a> {
    numbers: &'a [f64],
}

impl Numbers<'_> {
    fn colour(&self) -> Result<Vec3, String> {
        let found = self.numbers.get(..3).ok_or_else(|| format!("{} numbers were found, expected a colour first", self.numbers.len()))?;
        Ok([found[0], found[1], found[2]])
    }

    /// What follows the colour, 0 where it is not there but need not be.
    fn after_colour<const N: usize>(&self, count: usize) -> Result<[f64; N], String> {
        if self.numbers.len() < count {
            return Err(format!("{} numbers were found, expected {count}", self.numbers.len()));
        }
        Ok(std::array::from_fn(|i| self.numbers.get(3 + i).copied().unwrap_or(0.0)))
    }
}

/// A BSDF's file; its up vector turns with what it is placed in.
fn measured_of(source: &Source<'_>, object: &Object<'_>, placed: &Placed) -> Result<Modifier, String> {
    // BSDF has its thickness first.
    let skip = usize::from(object.kind == "BSDF");
    let strings = object.strings.get(skip..).unwrap_or_default();
    let [file, x, y, z, ..] = strings else { return Err("expected a file and an up vector among its strings".into()) };
    let part = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or(format!("'{text}' was found, expected a number"));
    let up = placed.transform.vector([part(x)?, part(y)?, part(z)?]);
    measured::of_file(&found_beside(source.folder, file), up)
}

/// A file that a scene names: beside the scene, else where the command runs.
pub(super) fn found_beside(folder: &Path, file: &str) -> PathBuf {
    let beside = folder.join(file);
    if beside.exists() { beside } else { PathBuf::from(file) }
}
