//! Loading: from paths or bytes to mip maps, many at a time.

use super::error::{TextureError, TextureErrorKind};
use super::format::decode;
use super::image::{Image, Texels};
use super::limits::MAX_BYTES;
use super::mip_map::MipMap;
use crate::colour::{ColourSpace, Stated};
use crate::memory::room_for;
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Where an image's bytes are.
#[derive(Clone, Debug)]
pub enum Source {
    /// A file.
    Path(PathBuf),
    /// Bytes at hand, such as a member of a `.usdz` archive.
    Bytes {
        /// What messages call it.
        name: Arc<str>,
        /// The file's contents.
        bytes: Arc<[u8]>,
    },
    /// Linear float RGBA, rows from the top.
    Pixels {
        /// What messages call it.
        name: Arc<str>,
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// RGBA.
        rgba: Arc<[f32]>,
    },
}

impl Source {
    /// What messages call it.
    pub fn name(&self) -> String {
        match self {
            Self::Path(path) => path.display().to_string(),
            Self::Bytes { name, .. } | Self::Pixels { name, .. } => name.to_string(),
        }
    }

    fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Path(a), Self::Path(b)) => a == b,
            (Self::Bytes { name: a, bytes: x }, Self::Bytes { name: b, bytes: y }) => a == b && (Arc::ptr_eq(x, y) || x == y),
            (Self::Pixels { width: a, rgba: x, .. }, Self::Pixels { width: b, rgba: y, .. }) => a == b && Arc::ptr_eq(x, y),
            _ => false,
        }
    }
}

/// A texture to load.
#[derive(Clone, Debug)]
pub struct TextureRequest {
    /// Where it is.
    pub source: Source,
    /// What its numbers mean.
    pub colour_space: ColourSpace,
}

impl TextureRequest {
    /// A file in a colour space.
    pub fn path(path: impl Into<PathBuf>, colour_space: ColourSpace) -> Self {
        Self { source: Source::Path(path.into()), colour_space }
    }

    /// Bytes in a colour space.
    pub fn bytes(name: &str, bytes: impl Into<Arc<[u8]>>, colour_space: ColourSpace) -> Self {
        Self { source: Source::Bytes { name: Arc::from(name), bytes: bytes.into() }, colour_space }
    }
}

/// Reads and decodes an image as its file stores it.
pub fn load_image(source: &Source) -> Result<Image, TextureError> {
    let image = match source {
        Source::Path(path) => read_file(path).and_then(|bytes| decode(&bytes)),
        Source::Bytes { bytes, .. } => decode(bytes),
        Source::Pixels { width, height, rgba, .. } => {
            let texels = Texels::Float(rgba.to_vec());
            Ok(Image { width: *width, height: *height, channels: 4, texels, stated: Stated::Nothing })
        }
    };
    image.map_err(|error| error.at(&source.name()))
}

/// Loads one texture; `cancel` is read between the steps and at each level of the pyramid.
pub fn load(request: &TextureRequest, cancel: &AtomicBool) -> Result<MipMap, TextureError> {
    let name = request.source.name();
    stop_if(cancel).map_err(|error| error.at(&name))?;
    let image = load_image(&request.source)?;
    let built = stop_if(cancel).and_then(|()| MipMap::build(&image, request.colour_space, cancel));
    built.map_err(|error| error.at(&name))
}

/// Loads many textures at once on rayon's threads, equal requests only once; the answers are in the requests' order.
pub fn load_set(requests: &[TextureRequest], cancel: &AtomicBool) -> Vec<Result<Arc<MipMap>, TextureError>> {
    let (unique, places) = deduplicate(requests);
    let loaded: Vec<_> = unique.par_iter().map(|request| load(request, cancel).map(Arc::new)).collect();
    places.into_iter().map(|place| loaded[place].clone()).collect()
}

/// The distinct requests, and each request's place among them.
pub(crate) fn deduplicate(requests: &[TextureRequest]) -> (Vec<&TextureRequest>, Vec<usize>) {
    let mut unique: Vec<&TextureRequest> = Vec::new();
    let mut known: HashMap<(String, ColourSpace), Vec<usize>> = HashMap::new();
    let places = requests.iter().map(|request| {
        let candidates = known.entry((request.source.name(), request.colour_space)).or_default();
        if let Some(place) = candidates.iter().find(|place| unique[**place].source.same(&request.source)) {
            return *place;
        }
        candidates.push(unique.len());
        unique.push(request);
        unique.len() - 1
    });
    let places = places.collect();
    (unique, places)
}

fn stop_if(cancel: &AtomicBool) -> Result<(), TextureError> {
    if cancel.load(Ordering::Relaxed) {
        return Err(TextureError::new(TextureErrorKind::Cancelled, "loading was cancelled"));
    }
    Ok(())
}

fn read_file(path: &Path) -> Result<Vec<u8>, TextureError> {
    let unreadable = |what: String| TextureError::new(TextureErrorKind::Unreadable, what);
    let file = std::fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => {
            unreadable("the file does not exist".to_owned()).hint("check the path, or pack the texture with the scene")
        }
        _ => unreadable(format!("the file cannot be read: {error}")),
    })?;
    if !file.is_file() {
        return Err(unreadable("the path is not a file".to_owned()));
    }
    if file.len() == 0 {
        // Some such files of the system never end.
        return Err(TextureError::malformed("the file is empty"));
    }
    if file.len() > MAX_BYTES {
        return Err(TextureError::new(
            TextureErrorKind::TooLarge,
            format!("the file has {} MiB, the limit is {} MiB", file.len() >> 20, MAX_BYTES >> 20),
        ));
    }
    room_for(file.len()).map_err(|shortage| TextureError::new(TextureErrorKind::TooLarge, shortage.to_string()))?;
    std::fs::read(path).map_err(|error| unreadable(format!("the file cannot be read: {error}")))
}
