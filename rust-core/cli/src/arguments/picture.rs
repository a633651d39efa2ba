//! What the commands take that work on rendered pictures: `gonio compare` and `gonio relight`.

use super::number::finite;
use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct CompareOptions {
    /// The image to judge.
    pub(crate) image: PathBuf,
    /// The reference.
    pub(crate) reference: PathBuf,
    /// Fail with status 1 if the 95th percentile of any channel's block differences is above this (0.03 is 3 %).
    #[arg(long, value_name = "DIFFERENCE", value_parser = finite::<f64>)]
    pub(crate) max: Option<f64>,
    /// Write a picture: red where the image is brighter, blue where it is darker, full at 10 %.
    #[arg(long, value_name = "FILE")]
    pub(crate) difference: Option<PathBuf>,
    /// Compare only these channels, separated by commas.
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',')]
    pub(crate) channels: Vec<String>,
}

#[derive(Args, Debug)]
pub(crate) struct RelightOptions {
    /// An EXR file that was rendered with --light-groups, by wavelength (--by-wavelength) or not.
    pub(crate) image: PathBuf,
    /// A group's factor, and the colour temperature in K that tints it: 'Kitchen=0.3' or 'Kitchen=0.3,2700'; may be given several times.
    #[arg(long, value_name = "NAME=FACTOR[,KELVIN]")]
    pub(crate) group: Vec<String>,
    /// Lamps of another spectrum for a group of a picture by wavelength (gonio render --by-wavelength FILE --light-groups), of as many lumens: a file or a name as gonio spectrum has them, 'Kitchen=LED-B3'; may be given several times.
    #[arg(long, value_name = "NAME=LAMP")]
    pub(crate) spectrum: Vec<String>,
    /// The EXR file to write: colour, luminance if the picture has it, and the groups.
    #[arg(long, short = 'o', value_name = "FILE.exr")]
    pub(crate) output: PathBuf,
}
