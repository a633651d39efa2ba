//! One of a product's variants, and its files.

use super::{FilePlace, Gldf, PRODUCT, Variant};
use crate::archive::{inside, some_of};
use crate::error::{FormatError, Result};
use crate::photometry::text::quote;
use crate::photometry::{Goniogram, read_single};
use crate::spectrum::{SpectralPower, read_text};
use crate::xml::text_of;

impl Gldf<'_> {
    /// The place of the variant that is meant: by its name in any language, order number, GTIN or identifier, else its number from 1; without a
    /// word the first.
    ///
    /// # Errors
    /// None of that name, several of it, or a product without variants.
    pub fn variant(&self, asked: Option<&str>) -> Result<usize> {
        let Some(asked) = asked.map(str::trim).filter(|asked| !asked.is_empty()) else {
            let none = || FormatError::whole("the product has no variant, and so no photometry that can be chosen");
            return if self.variants.is_empty() { Err(none()) } else { Ok(0) };
        };
        let is_meant =
            |variant: &Variant| variant.id == asked || variant.gtin == asked || variant.name.says(asked) || variant.number.says(asked);
        let mut meant = self.variants.iter().enumerate().filter(|(_, variant)| is_meant(variant));
        if let Some((index, _)) = meant.next() {
            return match meant.next() {
                None => Ok(index),
                Some((other, _)) => {
                    let problem = format!("variants {} and {} are both called {}: ask by number", index + 1, other + 1, quote(asked));
                    Err(FormatError::whole(problem))
                }
            };
        }
        let number = asked.parse::<usize>().ok().and_then(|number| number.checked_sub(1)).filter(|index| *index < self.variants.len());
        number.ok_or_else(|| {
            let names = some_of(self.variants.iter().map(|variant| variant.name.shown()));
            let count = self.variants.len();
            FormatError::whole(format!("no variant {} was found among {count}: {names}, or a number from 1", quote(asked)))
        })
    }

    /// The bytes of a file of the product.
    ///
    /// # Errors
    /// A file that is at an address, which is never fetched, or what is wrong with it in the archive.
    pub fn file(&self, index: usize) -> Result<Vec<u8>> {
        let file = self.files.get(index).ok_or_else(|| FormatError::whole(format!("the product has no file {}", index + 1)))?;
        match &file.place {
            FilePlace::Inside(path) => self.archive.read(path),
            FilePlace::Address(address) => {
                let problem = "is not in the archive but at that address, which is not fetched: get it from there, and use it by itself";
                Err(inside(address, &FormatError::whole(problem)))
            }
        }
    }

    /// A spectrum of a light source by its place in [`Self::spectra`], with its identifier as its name.
    ///
    /// # Errors
    /// As [`Self::file`], and what is no spectrum, with its line in the product or in the file inside the archive.
    pub fn spectrum(&self, index: usize) -> Result<SpectralPower> {
        let found = self.spectra.get(index).ok_or_else(|| FormatError::whole(format!("the product has no spectrum {}", index + 1)))?;
        let Some(file) = found.file else {
            return SpectralPower::new(&found.id, &found.values).map_err(|error| inside(PRODUCT, &error));
        };
        let bytes = self.file(file)?;
        let name = self.files[file].place.as_str();
        text_of(&bytes).and_then(|text| read_text(&text, &found.id)).map_err(|error| inside(name, &error))
    }

    /// The goniogram of a file of photometry, as that file has it.
    ///
    /// # Errors
    /// As [`Self::file`], and what the photometry's own reader says, with the name inside the archive.
    pub fn photometry(&self, index: usize) -> Result<Goniogram> {
        let bytes = self.file(index)?;
        let name = self.files[index].place.as_str();
        let folder = name.rsplit_once('/').map_or("", |(folder, _)| folder);
        let mut beside = |other: &str| self.archive.read(&format!("{folder}/{other}")).map_err(|error| error.to_string());
        let mut found = read_single(&bytes, name, &mut beside).map_err(|error| inside(name, &error))?;
        found.warnings.iter_mut().for_each(|warning| *warning = inside(name, warning));
        Ok(found)
    }

    /// The bytes of a variant's L3D model; `None` where it has none.
    ///
    /// # Errors
    /// As [`Self::file`].
    pub fn l3d(&self, variant: &Variant) -> Option<Result<Vec<u8>>> {
        let is_l3d = |index: &&usize| self.files.get(**index).is_some_and(|file| file.content_type == "geo/l3d");
        variant.models.iter().find(is_l3d).map(|index| self.file(*index))
    }
}
