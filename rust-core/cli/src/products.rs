//! The pictures of a frame: one where the command line names the files, else those that the stage's render products ask for.

use gonio::{Error, Result, colour::Gamut};
use gonio_usd::{Loaded, render_settings::RenderVariable};
use std::{collections::HashSet, path::PathBuf};

use super::{
    file_name,
    output::{check_deep_name, check_name},
};

/// A file, and what is in it; all passes of the picture where no variables are named.
#[derive(Debug)]
pub(super) struct File {
    pub(super) path: PathBuf,
    pub(super) variables: Vec<RenderVariable>,
}

/// Files that one render is for.
#[derive(Debug)]
pub(super) struct Picture {
    /// The first of the products that share it; `None` for all of them at once.
    pub(super) product: Option<usize>,
    pub(super) files: Vec<File>,
    /// Deep pictures.
    pub(super) deep: Vec<PathBuf>,
    /// The gamut of EXR files' colours.
    pub(super) gamut: Option<Gamut>,
}

impl Picture {
    /// One picture with the variables of all products in each of these files; the deep one has none.
    pub(super) fn of_all_products(loaded: &Loaded, paths: impl Iterator<Item = PathBuf>, deep: Option<PathBuf>) -> Self {
        let variables = loaded.settings.as_ref().map(|settings| settings.variables()).unwrap_or_default();
        let files = paths.map(|path| File { path, variables: variables.clone() }).collect();
        Self { product: None, files, deep: deep.into_iter().collect(), gamut: gamut_of(loaded) }
    }
}

/// The gamut that the render settings ask for; none for Rec.709, in which pictures are rendered.
pub(super) fn gamut_of(loaded: &Loaded) -> Option<Gamut> {
    loaded.settings.as_ref().map(|settings| settings.gamut).filter(|gamut| *gamut != Gamut::Rec709)
}

/// Names of the variables that files have in half floats.
pub(super) fn half_layers(variables: &[RenderVariable]) -> Vec<String> {
    variables.iter().filter(|variable| variable.half).map(|variable| variable.name.clone()).collect()
}

/// Files written so far, which no later frame may write again.
#[derive(Debug, Default)]
pub(super) struct Products {
    written: HashSet<PathBuf>,
}

impl Products {
    /// The pictures that the stage's products ask for, named for a frame: one for all products that are framed alike and show the same.
    pub(super) fn pictures(&mut self, loaded: &Loaded, frame: Option<f64>) -> Result<Vec<Picture>> {
        let products = loaded.settings.as_ref().map(|settings| settings.products.as_slice()).unwrap_or_default();
        if products.is_empty() {
            let problem = "no file was given and the stage has no render product; say -o picture.exr";
            return Err(Error::Setting { name: "output".into(), problem: problem.into() });
        }
        let mut pictures: Vec<Picture> = Vec::new();
        for (number, product) in products.iter().enumerate() {
            let path = PathBuf::from(&product.name);
            let path = file_name::filled_in(&path, frame).map_err(|error| Error::scene(&product.origin, error.to_string()))?;
            let checked = if product.deep { check_deep_name(&path) } else { check_name(&path).map(|_| ()) };
            checked.map_err(|error| Error::scene(&product.origin, error.to_string()))?;
            if !self.written.insert(path.clone()) {
                let problem = format!("{} is written twice; several frames need a place for the number, such as '####'", path.display());
                return Err(Error::scene(&product.origin, problem));
            }
            let is_like = |picture: &Picture| {
                let other = picture.product.and_then(|first| products.get(first));
                other.is_some_and(|other| other.framing == product.framing && other.variables == product.variables)
            };
            let at = pictures.iter().position(is_like).unwrap_or(pictures.len());
            if at == pictures.len() {
                pictures.push(Picture { product: Some(number), files: Vec::new(), deep: Vec::new(), gamut: gamut_of(loaded) });
            }
            let picture = &mut pictures[at];
            if product.deep {
                picture.deep.push(path);
            } else {
                picture.files.push(File { path, variables: product.variables.clone() });
            }
        }
        Ok(pictures)
    }
}
