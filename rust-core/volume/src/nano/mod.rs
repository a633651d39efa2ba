//! NanoVDB's files.

use crate::stream::Stream;
use crate::{Grid, GridInfo, Result, Transform};

#[derive(Clone, Debug)]
pub(crate) struct Listing {
    pub(crate) entries: Vec<Entry>,
    pub(crate) notes: Vec<String>,
}
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) info: GridInfo,
}
impl Listing {
    pub(crate) fn version(&self) -> String {
        String::new()
    }
}
pub(crate) fn is_magic(_: [u8; 8]) -> bool {
    false
}
pub(crate) fn list(stream: &mut Stream) -> Result<Listing> {
    Err(stream.error("todo"))
}
pub(crate) fn read(stream: &mut Stream, _: &Listing, _: usize, _: Transform) -> Result<Grid> {
    Err(stream.error("todo"))
}
