//! Arrays of a bundle: within [`collect`] and [`supply`] they go to and come from one run of bytes, and the description keeps their places.
//!
//! Elsewhere (dictionaries for Python, JSON by hand) arrays are written out as lists. serde hands no context to the parts of a structure, so
//! the bytes wait in the thread meanwhile.

use crate::digest::Digest;
use bytemuck::Pod;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
use std::{cell::RefCell, sync::Arc};

thread_local! {
    static BYTES: RefCell<Option<Bytes>> = const { RefCell::new(None) };
}

/// Where arrays go.
enum Bytes {
    /// Kept.
    Kept(Vec<u8>),
    /// Told apart, with how many there were.
    Digested(Digest, usize),
}

impl Bytes {
    fn len(&self) -> usize {
        match self {
            Self::Kept(bytes) => bytes.len(),
            Self::Digested(_, length) => *length,
        }
    }
    fn add(&mut self, more: &[u8]) {
        match self {
            Self::Kept(bytes) => bytes.extend_from_slice(more),
            Self::Digested(digest, length) => {
                digest.add(more);
                *length += more.len();
            }
        }
    }
}

/// Runs `write`, whose arrays go into the bytes that come back.
pub(super) fn collect<R>(write: impl FnOnce() -> R) -> (R, Vec<u8>) {
    BYTES.set(Some(Bytes::Kept(Vec::new())));
    let result = write();
    match BYTES.take() {
        Some(Bytes::Kept(bytes)) => (result, bytes),
        _ => (result, Vec::new()),
    }
}

/// Runs `write`, whose arrays are told apart by the digest that comes back.
pub(super) fn digest<R>(write: impl FnOnce() -> R) -> (R, Digest) {
    BYTES.set(Some(Bytes::Digested(Digest::default(), 0)));
    let result = write();
    match BYTES.take() {
        Some(Bytes::Digested(digest, _)) => (result, digest),
        _ => (result, Digest::default()),
    }
}

/// Runs `read`, whose arrays are taken from the bytes.
pub(super) fn supply<R>(bytes: Vec<u8>, read: impl FnOnce() -> R) -> R {
    BYTES.set(Some(Bytes::Kept(bytes)));
    let result = read();
    BYTES.set(None);
    result
}

/// An array as the description has it.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Array<T> {
    /// Place in the bytes: first byte and number of elements.
    Place { offset: usize, count: usize },
    /// Written out.
    List(Vec<T>),
}

impl<T: Pod> Array<T> {
    /// Puts the elements among the bytes, if they are being collected.
    fn placed(values: &[T]) -> Option<Self> {
        BYTES.with_borrow_mut(|bytes| {
            let bytes = bytes.as_mut()?;
            let offset = bytes.len();
            bytes.add(bytemuck::cast_slice(values));
            Some(Array::Place { offset, count: values.len() })
        })
    }
    /// The elements, from the bytes or the list.
    fn elements(self) -> Result<Arc<[T]>, String> {
        match self {
            Array::List(list) => Ok(list.into()),
            Array::Place { offset, count } => BYTES.with_borrow(|bytes| {
                let bytes = if let Some(Bytes::Kept(bytes)) = bytes { bytes.as_slice() } else { &[] };
                let end = count.checked_mul(size_of::<T>()).and_then(|length| offset.checked_add(length));
                let range = end.and_then(|end| bytes.get(offset..end));
                let range = range
                    .ok_or_else(|| format!("an array of {count} elements at byte {offset} lies outside of the {} bytes", bytes.len()))?;
                Ok(bytemuck::pod_collect_to_vec::<u8, T>(range).into())
            }),
        }
    }
}

/// `#[serde(with = "blob")]` for arrays.
pub(super) fn serialize<T: Pod + Serialize, S: Serializer>(values: &Arc<[T]>, serializer: S) -> Result<S::Ok, S::Error> {
    match Array::placed(values) {
        Some(place) => place.serialize(serializer),
        None => values.serialize(serializer),
    }
}

/// `#[serde(with = "blob")]` for arrays.
pub(super) fn deserialize<'de, T: Pod + Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<[T]>, D::Error> {
    Array::deserialize(deserializer)?.elements().map_err(D::Error::custom)
}

/// `#[serde(with = "blob::optional")]` for arrays that may be absent.
pub(super) mod optional {
    use super::{Arc, Array, Deserialize, Deserializer, Error, Pod, Serialize, Serializer};

    pub(in super::super) fn serialize<T: Pod + Serialize, S: Serializer>(
        values: &Option<Arc<[T]>>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match values.as_ref().map(|values| Array::placed(values)) {
            Some(Some(place)) => place.serialize(serializer),
            _ => values.serialize(serializer),
        }
    }

    pub(in super::super) fn deserialize<'de, T: Pod + Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<[T]>>, D::Error> {
        let array = Option::<Array<T>>::deserialize(deserializer)?;
        array.map(Array::elements).transpose().map_err(D::Error::custom)
    }
}
