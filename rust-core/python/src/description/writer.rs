//! serde's writing of Python objects.

use super::Problem;
use pyo3::{
    IntoPyObjectExt,
    prelude::*,
    types::{PyDict, PyList},
};
use serde::{Serialize, ser};

/// Makes objects.
#[derive(Clone, Copy)]
pub(super) struct Writer<'py> {
    pub(super) py: Python<'py>,
}

pub(super) type Written<'py> = Result<Bound<'py, PyAny>, Problem>;

impl<'py> Writer<'py> {
    fn list(self, variant: Option<&'static str>) -> Result<List<'py>, Problem> {
        Ok(List { writer: self, list: PyList::empty(self.py), variant })
    }

    fn dictionary(self, variant: Option<&'static str>) -> Result<Dictionary<'py>, Problem> {
        Ok(Dictionary { writer: self, dictionary: PyDict::new(self.py), variant })
    }

    /// Content alone, or as that of a variant.
    fn of_variant(self, variant: Option<&'static str>, content: Bound<'py, PyAny>) -> Written<'py> {
        let Some(name) = variant else { return Ok(content) };
        let outer = PyDict::new(self.py);
        outer.set_item(name, content)?;
        Ok(outer.into_any())
    }
}

macro_rules! as_python_has_them {
    ($($method:ident $kind:ty),*) => {
        $(fn $method(self, value: $kind) -> Written<'py> {
            Ok(value.into_bound_py_any(self.py)?)
        })*
    };
}

impl<'py> ser::Serializer for Writer<'py> {
    type Ok = Bound<'py, PyAny>;
    type Error = Problem;
    type SerializeSeq = List<'py>;
    type SerializeTuple = List<'py>;
    type SerializeTupleStruct = List<'py>;
    type SerializeTupleVariant = List<'py>;
    type SerializeMap = Map<'py>;
    type SerializeStruct = Dictionary<'py>;
    type SerializeStructVariant = Dictionary<'py>;

    as_python_has_them! {
        serialize_bool bool, serialize_i8 i8, serialize_i16 i16, serialize_i32 i32, serialize_i64 i64, serialize_u8 u8, serialize_u16 u16,
        serialize_u32 u32, serialize_u64 u64, serialize_f64 f64, serialize_char char, serialize_str &str
    }

    /// The number of fewest digits that is read as the same: 0.1 stays 0.1.
    fn serialize_f32(self, value: f32) -> Written<'py> {
        self.serialize_f64(format!("{value:e}").parse().unwrap_or(f64::from(value)))
    }
    fn serialize_bytes(self, bytes: &[u8]) -> Written<'py> {
        self.collect_seq(bytes)
    }
    fn serialize_none(self) -> Written<'py> {
        self.serialize_unit()
    }
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Written<'py> {
        value.serialize(self)
    }
    fn serialize_unit(self) -> Written<'py> {
        Ok(self.py.None().into_bound(self.py))
    }
    fn serialize_unit_struct(self, _name: &'static str) -> Written<'py> {
        self.serialize_unit()
    }
    fn serialize_unit_variant(self, _name: &'static str, _number: u32, variant: &'static str) -> Written<'py> {
        self.serialize_str(variant)
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _name: &'static str, value: &T) -> Written<'py> {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        _number: u32,
        variant: &'static str,
        value: &T,
    ) -> Written<'py> {
        self.of_variant(Some(variant), value.serialize(self)?)
    }
    fn serialize_seq(self, _length: Option<usize>) -> Result<List<'py>, Problem> {
        self.list(None)
    }
    fn serialize_tuple(self, _length: usize) -> Result<List<'py>, Problem> {
        self.list(None)
    }
    fn serialize_tuple_struct(self, _name: &'static str, _length: usize) -> Result<List<'py>, Problem> {
        self.list(None)
    }
    fn serialize_tuple_variant(
        self,
        _name: &'static str,
        _number: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<List<'py>, Problem> {
        self.list(Some(variant))
    }
    fn serialize_map(self, _length: Option<usize>) -> Result<Map<'py>, Problem> {
        Ok(Map { writer: self, dictionary: PyDict::new(self.py), key: None })
    }
    fn serialize_struct(self, _name: &'static str, _length: usize) -> Result<Dictionary<'py>, Problem> {
        self.dictionary(None)
    }
    fn serialize_struct_variant(
        self,
        _name: &'static str,
        _number: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Dictionary<'py>, Problem> {
        self.dictionary(Some(variant))
    }
}

/// A list that grows, perhaps the content of a variant.
pub(super) struct List<'py> {
    writer: Writer<'py>,
    list: Bound<'py, PyList>,
    variant: Option<&'static str>,
}

/// A dictionary that grows, perhaps the content of a variant.
pub(super) struct Dictionary<'py> {
    writer: Writer<'py>,
    dictionary: Bound<'py, PyDict>,
    variant: Option<&'static str>,
}

macro_rules! grows {
    ($kind:ident, $content:ident: $($part:ident $method:ident $($name:ident)?),*) => {
        $(impl<'py> ser::$part for $kind<'py> {
            type Ok = Bound<'py, PyAny>;
            type Error = Problem;
            fn $method<T: Serialize + ?Sized>(&mut self, $($name: &'static str,)? value: &T) -> Result<(), Problem> {
                let value = value.serialize(self.writer)?;
                Ok(grows!(@add self.$content, $($name,)? value)?)
            }
            fn end(self) -> Written<'py> {
                self.writer.of_variant(self.variant, self.$content.into_any())
            }
        })*
    };
    (@add $content:expr, $value:ident) => { $content.append($value) };
    (@add $content:expr, $name:ident, $value:ident) => { $content.set_item($name, $value) };
}

grows! { List, list: SerializeSeq serialize_element, SerializeTuple serialize_element, SerializeTupleStruct serialize_field,
SerializeTupleVariant serialize_field }
grows! { Dictionary, dictionary: SerializeStruct serialize_field name, SerializeStructVariant serialize_field name }

/// A dictionary whose keys are values.
pub(super) struct Map<'py> {
    writer: Writer<'py>,
    dictionary: Bound<'py, PyDict>,
    /// Of the value that follows.
    key: Option<Bound<'py, PyAny>>,
}

impl<'py> ser::SerializeMap for Map<'py> {
    type Ok = Bound<'py, PyAny>;
    type Error = Problem;
    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Problem> {
        self.key = Some(key.serialize(self.writer)?);
        Ok(())
    }
    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Problem> {
        Ok(self.dictionary.set_item(self.key.take(), value.serialize(self.writer)?)?)
    }
    fn end(self) -> Written<'py> {
        Ok(self.dictionary.into_any())
    }
}
