//! Prims and attributes of a stage, with the names they have opinions for.

use crate::kept::{KeptPrim, Known};
use gonio::scene::Origin;
use pyo3::intern;
use pyo3::prelude::*;
use std::sync::Arc;

/// A prim.
#[derive(Clone, Debug)]
pub struct Prim<'py> {
    object: Bound<'py, PyAny>,
    known: Arc<Known>,
}

impl<'py> Prim<'py> {
    /// Around a `Usd.Prim`.
    pub fn new(object: Bound<'py, PyAny>) -> Self {
        Self { object, known: Arc::default() }
    }

    /// Around a `Usd.Prim` of which something is known.
    pub(crate) fn with(object: Bound<'py, PyAny>, known: Arc<Known>) -> Self {
        Self { object, known }
    }

    /// What is known of the prim.
    pub(crate) fn known(&self) -> &Arc<Known> {
        &self.known
    }

    /// The `Usd.Prim`.
    pub fn object(&self) -> &Bound<'py, PyAny> {
        &self.object
    }

    /// The interpreter that holds the prim.
    pub fn py(&self) -> Python<'py> {
        self.object.py()
    }

    /// Whether there is such a prim.
    pub fn is_valid(&self) -> bool {
        self.object.is_truthy().unwrap_or(false)
    }

    /// The path, `/World/Chair`.
    pub fn path(&self) -> String {
        let py = self.py();
        let path = || self.object.call_method0(intern!(py, "GetPath"))?.getattr(intern!(py, "pathString"))?.extract();
        self.known.path.get_or_init(|| path().unwrap_or_else(|_: PyErr| "<invalid prim>".to_owned())).clone()
    }

    /// The last part of the path.
    pub fn name(&self) -> String {
        self.text(intern!(self.py(), "GetName"))
    }

    /// The schema's name, `Mesh`; empty for untyped prims. Of a type that is unknown the one that the stage names in its place counts.
    pub fn type_name(&self) -> String {
        let py = self.py();
        let of_schema = || -> PyResult<String> {
            self.object.call_method0(intern!(py, "GetPrimTypeInfo"))?.call_method0(intern!(py, "GetSchemaTypeName"))?.extract()
        };
        let named = || self.text(intern!(py, "GetTypeName"));
        self.known.type_name.get_or_init(|| of_schema().ok().filter(|name| !name.is_empty()).unwrap_or_else(named)).clone()
    }

    /// The prim as a place in messages.
    pub fn origin(&self) -> Origin {
        Origin::new(self.path())
    }

    fn text(&self, method: &Bound<'py, pyo3::types::PyString>) -> String {
        self.object.call_method0(method).and_then(|text| text.extract()).unwrap_or_default()
    }

    fn flag(&self, method: &Bound<'py, pyo3::types::PyString>) -> bool {
        self.object.call_method0(method).and_then(|flag| flag.is_truthy()).unwrap_or(false)
    }

    /// Whether the prim is the root of a native instance.
    pub fn is_instance(&self) -> bool {
        *self.known.is_instance.get_or_init(|| self.flag(intern!(self.py(), "IsInstance")))
    }

    /// The kind in the model hierarchy, such as `component`; empty for none.
    pub fn kind(&self) -> String {
        let kind = self.object.call_method1(intern!(self.py(), "GetMetadata"), (intern!(self.py(), "kind"),));
        kind.and_then(|kind| kind.extract()).unwrap_or_default()
    }

    /// The prototype of a native instance.
    pub fn prototype(&self) -> Option<Self> {
        let prototype = Self::new(self.object.call_method0(intern!(self.py(), "GetPrototype")).ok()?);
        prototype.is_valid().then_some(prototype)
    }

    /// The children that are displayed, asked for once.
    pub(crate) fn displayed_children(&self) -> impl Iterator<Item = Self> {
        let py = self.py();
        let ask = || -> PyResult<Vec<KeptPrim>> {
            self.object.call_method0(intern!(py, "GetChildren"))?.try_iter()?.map(|child| Ok(KeptPrim::of(&Self::new(child?)))).collect()
        };
        self.known.children[0].get_or_init(|| ask().unwrap_or_default()).iter().map(move |child| child.prim(py))
    }

    /// The parent prim.
    pub fn parent(&self) -> Option<Self> {
        let parent = Self::new(self.object.call_method0(intern!(self.py(), "GetParent")).ok()?);
        parent.is_valid().then_some(parent)
    }

    /// Names of the properties that have opinions.
    pub fn authored_names(&self) -> &[String] {
        self.known.authored.get_or_init(|| {
            let names = self.object.call_method0(intern!(self.py(), "GetAuthoredPropertyNames"));
            names.and_then(|names| names.try_iter()?.map(|name| name?.extract()).collect()).unwrap_or_default()
        })
    }

    /// Whether the property has an opinion.
    pub fn has_authored(&self, name: &str) -> bool {
        self.authored_names().iter().any(|authored| authored == name)
    }

    /// Whether any authored property's name begins so.
    pub fn has_authored_prefix(&self, prefix: &str) -> bool {
        self.authored_names().iter().any(|authored| authored.starts_with(prefix))
    }

    /// Names of the applied API schemas.
    pub fn applied_schemas(&self) -> &[String] {
        self.known.schemas.get_or_init(|| {
            let names = self.object.call_method0(intern!(self.py(), "GetAppliedSchemas"));
            names.and_then(|names| names.try_iter()?.map(|name| name?.extract()).collect()).unwrap_or_default()
        })
    }

    /// The attribute, if the prim has it by schema or by authoring.
    pub fn attribute(&self, name: &str) -> Option<Attribute<'py>> {
        let object = self.object.call_method1(intern!(self.py(), "GetAttribute"), (name,)).ok()?;
        if self.known.authored.get().is_some_and(|names| names.iter().any(|authored| authored == name)) {
            return Some(Attribute { object });
        }
        object.is_truthy().unwrap_or(false).then_some(Attribute { object })
    }

    /// The paths that a relationship forwards to.
    pub fn targets(&self, relationship: &str) -> Vec<String> {
        let py = self.py();
        let read = || -> PyResult<Vec<String>> {
            let relationship = self.object.call_method1(intern!(py, "GetRelationship"), (relationship,))?;
            if !relationship.is_truthy()? {
                return Ok(Vec::new());
            }
            let targets = relationship.call_method0(intern!(py, "GetForwardedTargets"))?;
            targets.try_iter()?.map(|path| path?.getattr(intern!(py, "pathString"))?.extract()).collect()
        };
        read().unwrap_or_default()
    }

    /// Whether the prim is of this schema or one derived from it (a class of `pxr`, such as `UsdGeom.Gprim`, or its name).
    pub fn is_a(&self, class: &Bound<'py, PyAny>) -> bool {
        self.object.call_method1(intern!(self.py(), "IsA"), (class,)).and_then(|flag| flag.is_truthy()).unwrap_or(false)
    }
}

/// An attribute.
#[derive(Clone, Debug)]
pub struct Attribute<'py> {
    object: Bound<'py, PyAny>,
}

impl<'py> Attribute<'py> {
    /// Around a `Usd.Attribute`.
    pub fn new(object: Bound<'py, PyAny>) -> Self {
        Self { object }
    }

    /// The `Usd.Attribute`.
    pub fn object(&self) -> &Bound<'py, PyAny> {
        &self.object
    }

    /// The path, `/World/Chair.points`.
    pub fn path(&self) -> String {
        let py = self.object.py();
        let path = || self.object.call_method0(intern!(py, "GetPath"))?.getattr(intern!(py, "pathString"))?.extract();
        path().unwrap_or_else(|_: PyErr| "<invalid attribute>".to_owned())
    }

    /// The name of the value's type: `color3f[]`.
    pub fn type_name(&self) -> String {
        let name = self.object.call_method0(intern!(self.object.py(), "GetTypeName"));
        name.and_then(|name| name.str()?.extract()).unwrap_or_default()
    }

    /// A token of the attribute's metadata, such as `interpolation` or `colorSpace`.
    pub fn metadata(&self, key: &str) -> Option<Bound<'py, PyAny>> {
        self.object.call_method1(intern!(self.object.py(), "GetMetadata"), (key,)).ok().filter(|value| !value.is_none())
    }

    /// The value at a `Usd.TimeCode`, `None` where there is none.
    ///
    /// # Errors
    /// What `Get` raises: a corrupt file may show only here.
    pub fn get(&self, time: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let value = self.object.call_method1(intern!(self.object.py(), "Get"), (time,))?;
        Ok((!value.is_none()).then_some(value))
    }
}
