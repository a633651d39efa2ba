//! serde's reading of Python objects. Tuples are lists, integers are floats where floats are wanted; what has `tolist`, as numpy's arrays and
//! scalars have, is read as that list or number. Floats are finite.

use super::Problem;
use pyo3::{
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple},
};
use serde::de::{self, DeserializeSeed, IntoDeserializer, Unexpected, Visitor, value::StrDeserializer};
use std::marker::PhantomData;

/// Containers within containers that are read; what holds itself has no end.
const DEEPEST: usize = 128;

/// Reads one object, `depth` containers deep.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a, 'py> {
    object: &'a Bound<'py, PyAny>,
    depth: usize,
}

impl<'a, 'py> Reader<'a, 'py> {
    pub(super) fn new(object: &'a Bound<'py, PyAny>) -> Self {
        Self { object, depth: 0 }
    }

    /// The depth of what the object holds.
    fn inside(&self) -> Result<usize, Problem> {
        if self.depth < DEEPEST { Ok(self.depth + 1) } else { Err(de::Error::custom(format!("more than {DEEPEST} levels deep"))) }
    }

    fn integer<'de, V: Visitor<'de>>(&self, visitor: V) -> Result<V::Value, Problem> {
        if let Ok(value) = self.object.extract::<u64>() {
            visitor.visit_u64(value)
        } else if let Ok(value) = self.object.extract::<i64>() {
            visitor.visit_i64(value)
        } else {
            visitor.visit_f64(self.object.extract()?)
        }
    }

    fn sequence<'de, V: Visitor<'de>>(
        &self,
        items: impl ExactSizeIterator<Item = Bound<'py, PyAny>>,
        visitor: V,
    ) -> Result<V::Value, Problem> {
        let count = items.len();
        let mut items = Items { items: items.enumerate(), depth: self.inside()? };
        let value = visitor.visit_seq(&mut items)?;
        match items.items.len() {
            0 => Ok(value),
            left => Err(de::Error::custom(format!("{count} elements were found, expected {}", count - left))),
        }
    }

    /// An object of no type that descriptions have.
    fn other<'de, V: Visitor<'de>>(&self, visitor: V) -> Result<V::Value, Problem> {
        match self.object.getattr_opt("tolist")? {
            Some(to_list) => Reader { object: &to_list.call0()?, depth: self.inside()? }.read(visitor),
            None => self.unexpected(&visitor),
        }
    }

    fn unexpected<T>(&self, expected: &dyn de::Expected) -> Result<T, Problem> {
        let kind = format!("object of type '{}'", self.object.get_type().name()?);
        Err(de::Error::invalid_type(Unexpected::Other(&kind), expected))
    }

    fn read<'de, V: Visitor<'de>>(&self, visitor: V) -> Result<V::Value, Problem> {
        let object = self.object;
        if let Ok(value) = object.cast::<PyFloat>() {
            match value.value() {
                value if value.is_finite() => visitor.visit_f64(value),
                value => Err(de::Error::custom(format!("{value} was found, expected a finite number"))),
            }
        } else if let Ok(list) = object.cast::<PyList>() {
            self.sequence(list.iter(), visitor)
        } else if let Ok(dictionary) = object.cast::<PyDict>() {
            visitor.visit_map(Entries { entries: dictionary.iter(), value: None, depth: self.inside()? })
        } else if let Ok(text) = object.cast::<PyString>() {
            visitor.visit_str(text.to_str()?)
        } else if let Ok(value) = object.cast::<PyBool>() {
            visitor.visit_bool(value.is_true())
        } else if object.is_instance_of::<PyInt>() {
            self.integer(visitor)
        } else if object.is_none() {
            visitor.visit_unit()
        } else if let Ok(tuple) = object.cast::<PyTuple>() {
            self.sequence(tuple.iter(), visitor)
        } else {
            self.other(visitor)
        }
    }
}

impl<'de> de::Deserializer<'de> for Reader<'_, '_> {
    type Error = Problem;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Problem> {
        self.read(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Problem> {
        if self.object.is_none() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _name: &'static str, visitor: V) -> Result<V::Value, Problem> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Problem> {
        if let Ok(name) = self.object.cast::<PyString>() {
            let name: StrDeserializer<'_, Problem> = name.to_str()?.into_deserializer();
            return visitor.visit_enum(name);
        }
        let depth = self.inside()?;
        match self.object.cast::<PyDict>().ok().filter(|dictionary| dictionary.len() == 1).and_then(|dictionary| dictionary.iter().next()) {
            Some((name, content)) => visitor.visit_enum(Variant { name: key(&name)?, content: Reader { object: &content, depth } }),
            None => self.unexpected(&"a name, or a dictionary of one"),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Problem> {
        visitor.visit_unit()
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple tuple_struct map struct identifier
    }
}

/// The elements of a list.
struct Items<I> {
    items: std::iter::Enumerate<I>,
    depth: usize,
}

impl<'de, 'py, I: ExactSizeIterator<Item = Bound<'py, PyAny>>> de::SeqAccess<'de> for Items<I> {
    type Error = Problem;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Problem> {
        let Some((at, object)) = self.items.next() else { return Ok(None) };
        let read = seed.deserialize(Reader { object: &object, depth: self.depth });
        read.map(Some).map_err(|problem| problem.within(format!("[{at}]")))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

fn key(object: &Bound<'_, PyAny>) -> Result<String, Problem> {
    object.extract().map_err(|_| de::Error::custom(format!("the key {object} is no text")))
}

/// The entries of a dictionary.
struct Entries<'py, I> {
    entries: I,
    /// The entry whose key was read last.
    value: Option<(String, Bound<'py, PyAny>)>,
    depth: usize,
}

impl<'de, 'py, I: Iterator<Item = (Bound<'py, PyAny>, Bound<'py, PyAny>)>> de::MapAccess<'de> for Entries<'py, I> {
    type Error = Problem;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Problem> {
        let Some((name, value)) = self.entries.next() else { return Ok(None) };
        let (name, _) = self.value.insert((key(&name)?, value));
        let name: StrDeserializer<'_, Problem> = name.as_str().into_deserializer();
        seed.deserialize(name).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Problem> {
        let (name, object) = self.value.take().ok_or_else(|| <Problem as de::Error>::custom("a value was asked for before its key"))?;
        seed.deserialize(Reader { object: &object, depth: self.depth }).map_err(|problem| problem.within(format!(".{name}")))
    }
}

/// A variant with content.
struct Variant<'a, 'py> {
    name: String,
    content: Reader<'a, 'py>,
}

impl<'de> de::EnumAccess<'de> for Variant<'_, '_> {
    type Error = Problem;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Problem> {
        let name: StrDeserializer<'_, Problem> = self.name.as_str().into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> de::VariantAccess<'de> for Variant<'_, '_> {
    type Error = Problem;

    fn unit_variant(self) -> Result<(), Problem> {
        self.newtype_variant_seed(PhantomData)
    }
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Problem> {
        seed.deserialize(self.content).map_err(|problem| problem.within(format!(".{}", self.name)))
    }
    fn tuple_variant<V: Visitor<'de>>(self, _length: usize, visitor: V) -> Result<V::Value, Problem> {
        self.content.read(visitor).map_err(|problem| problem.within(format!(".{}", self.name)))
    }
    fn struct_variant<V: Visitor<'de>>(self, _fields: &'static [&'static str], visitor: V) -> Result<V::Value, Problem> {
        self.content.read(visitor).map_err(|problem| problem.within(format!(".{}", self.name)))
    }
}
