//! The `pxr` package: modules imported when first used, and messages of its exceptions that are always safe to read.

use pyo3::intern;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyModule, PyTuple};

/// What to do when `pxr` cannot be imported.
pub const INSTALL_HINT: &str = "reading USD needs the package usd-core: pip install usd-core";

/// A module of `pxr`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Module {
    /// Asset resolution.
    Ar,
    /// Linear algebra.
    Gf,
    /// Plug-ins.
    Plug,
    /// Scene description.
    Sdf,
    /// Diagnostics.
    Tf,
    /// Stages.
    Usd,
    /// Geometry.
    UsdGeom,
    /// Lights.
    UsdLux,
    /// Render settings.
    UsdRender,
    /// Materials.
    UsdShade,
    /// Skinning.
    UsdSkel,
    /// Utilities.
    UsdUtils,
    /// Arrays.
    Vt,
}

const MODULE_COUNT: usize = Module::Vt as usize + 1;

impl Module {
    fn full_name(self) -> &'static str {
        match self {
            Self::Ar => "pxr.Ar",
            Self::Gf => "pxr.Gf",
            Self::Plug => "pxr.Plug",
            Self::Sdf => "pxr.Sdf",
            Self::Tf => "pxr.Tf",
            Self::Usd => "pxr.Usd",
            Self::UsdGeom => "pxr.UsdGeom",
            Self::UsdLux => "pxr.UsdLux",
            Self::UsdRender => "pxr.UsdRender",
            Self::UsdShade => "pxr.UsdShade",
            Self::UsdSkel => "pxr.UsdSkel",
            Self::UsdUtils => "pxr.UsdUtils",
            Self::Vt => "pxr.Vt",
        }
    }

    /// The module, imported once.
    ///
    /// # Errors
    /// `ImportError` where the package or the module is missing.
    pub fn import(self, py: Python<'_>) -> PyResult<&Bound<'_, PyModule>> {
        static MODULES: [PyOnceLock<Py<PyModule>>; MODULE_COUNT] = [const { PyOnceLock::new() }; MODULE_COUNT];
        let module = MODULES[self as usize].get_or_try_init(py, || py.import(self.full_name()).map(Bound::unbind))?;
        Ok(module.bind(py))
    }

    /// A class or function of the module.
    ///
    /// # Errors
    /// `ImportError`, or `AttributeError` where this version of the package does not have it.
    pub fn item<'py>(self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.import(py)?.getattr(name)
    }

    /// The schema class `name` around a prim (or any object its constructor takes).
    ///
    /// # Errors
    /// As [`Module::item`], and what the constructor raises.
    pub fn wrap<'py>(self, name: &str, object: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.item(object.py(), name)?.call1((object,))
    }
}

/// Says whether `pxr` is there.
///
/// # Errors
/// A message with the way to install it.
pub fn ensure(py: Python<'_>) -> gonio::Result<()> {
    Module::Usd.import(py).map_err(|error| gonio::Error::Setting {
        name: "pxr".into(),
        problem: format!("{INSTALL_HINT} (import failed: {})", message_of(py, &error)),
    })?;
    register_schemas(py);
    Ok(())
}

/// Makes our schemas known, which lie in the package's `schema` folder. Without them the prims that they describe have no default values.
fn register_schemas(py: Python<'_>) {
    static DONE: PyOnceLock<()> = PyOnceLock::new();
    DONE.get_or_init(py, || {
        let register = || -> PyResult<()> {
            let folder: String = py.import("gonio")?.getattr("__path__")?.get_item(0)?.extract()?;
            let registry = Module::Plug.item(py, "Registry")?.call0()?;
            registry.call_method1("RegisterPlugins", (format!("{folder}/schema"),)).map(|_| ())
        };
        // Nothing is lost where they are registered already, or this is not the installed package.
        let _ = register();
    });
}

/// The text of an exception: on one line, without C++ source places, and never raising itself. `str()` of a `Tf.ErrorException` fails when
/// its text quotes bytes of a file that are not UTF-8, therefore each of its errors is asked apart and those are left out.
pub fn message_of(py: Python<'_>, error: &PyErr) -> String {
    let commentaries = commentaries(py, error);
    if !commentaries.is_empty() {
        return one_line(&most_specific(commentaries));
    }
    let value = error.value(py);
    match value.str().and_then(|text| text.extract::<String>()) {
        Ok(text) if !text.trim().is_empty() => one_line(&text),
        _ => {
            format!("{} without a readable message", error.get_type(py).name().map_or_else(|_| "exception".into(), |name| name.to_string()))
        }
    }
}

/// The readable texts of a `Tf.ErrorException`'s errors.
fn commentaries(py: Python<'_>, error: &PyErr) -> Vec<String> {
    let Ok(args) = error.value(py).getattr(intern!(py, "args")) else { return Vec::new() };
    let Ok(args) = args.cast_into::<PyTuple>() else { return Vec::new() };
    args.iter()
        .filter_map(|item| match item.getattr(intern!(py, "commentary")) {
            Ok(text) => text.extract::<String>().ok(),
            // The text is there, but is not UTF-8.
            Err(problem) if problem.is_instance_of::<pyo3::exceptions::PyUnicodeDecodeError>(py) => {
                Some("the file has bytes that are not UTF-8 text".to_owned())
            }
            Err(_) => None,
        })
        .collect()
}

/// The error that says most: one with a place in a file, else the first, because later ones only say that the layer did not open.
fn most_specific(commentaries: Vec<String>) -> String {
    let place = commentaries.iter().position(|text| place_in(text).is_some()).unwrap_or(0);
    commentaries.into_iter().nth(place).unwrap_or_default()
}

/// A message longer than this many characters is cut: a corrupt file may have hundreds of things wrong with it.
const LONGEST_MESSAGE: usize = 400;

/// One line that can be read, without the C++ namespaces that carry the library's version and the names of anonymous layers.
pub fn one_line(text: &str) -> String {
    let mut line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    while let Some(start) = line.find("pxrInternal_") {
        let end = line[start..].find("__::").map_or(line.len(), |offset| start + offset + 4);
        line.replace_range(start..end, "");
    }
    while let Some(start) = line.find(",@anon:") {
        let end = line[start + 2..].find('@').map_or(line.len(), |offset| start + 2 + offset + 1);
        line.replace_range(start..end, "");
    }
    if let Some((end, _)) = line.char_indices().nth(LONGEST_MESSAGE) {
        line.replace_range(end.., "…");
    }
    line
}

/// A place in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: String,
    /// Line, counted from one.
    pub line: u64,
    /// Column, counted from one.
    pub column: u64,
    /// The text behind the place.
    pub problem: String,
}

/// The place that a message of the text format's parser begins with: `file:line:column: problem`.
pub fn place_in(text: &str) -> Option<Place> {
    let text = text.trim();
    let end = text.match_indices(": ").map(|(at, _)| at).find(|&at| split_place(&text[..at]).is_some())?;
    let (file, line, column) = split_place(&text[..end])?;
    Some(Place { file: file.to_owned(), line, column, problem: one_line(&text[end + 2..]) })
}

fn split_place(text: &str) -> Option<(&str, u64, u64)> {
    let (rest, column) = text.rsplit_once(':')?;
    let (file, line) = rest.rsplit_once(':')?;
    Some((file, line.parse().ok()?, column.parse().ok()?))
}

/// Collects what `pxr` warns about in place of letting it reach standard error; does nothing in versions without `Tf.DiagnosticTrap`.
#[derive(Debug)]
pub struct Trap<'py>(Option<OpenTrap<'py>>);

/// A trap, and what entering it gave: the one ends it, the other has the messages.
#[derive(Debug)]
struct OpenTrap<'py> {
    manager: Bound<'py, PyAny>,
    messages: Bound<'py, PyAny>,
}

impl<'py> Trap<'py> {
    /// Starts to collect.
    pub fn set(py: Python<'py>) -> Self {
        let enter = || -> PyResult<OpenTrap<'py>> {
            let manager = Module::Tf.item(py, "DiagnosticTrap")?.call0()?;
            let messages = manager.call_method0(intern!(py, "__enter__"))?;
            Ok(OpenTrap { manager, messages })
        };
        Self(enter().ok())
    }

    /// Stops, and returns the warnings.
    pub fn release(mut self) -> Vec<String> {
        let Some(trap) = self.0.take() else { return Vec::new() };
        let warnings = trap.warnings().unwrap_or_default();
        trap.leave();
        warnings
    }
}

impl OpenTrap<'_> {
    fn warnings(&self) -> PyResult<Vec<String>> {
        let list = self.messages.call_method0("GetWarnings")?;
        Ok(list
            .try_iter()?
            .filter_map(|warning| warning.ok()?.getattr("commentary").ok()?.extract::<String>().ok())
            .map(|text| one_line(&text))
            .collect())
    }

    /// Warnings are cleared first, because what is left in a trap is passed on when it ends; errors are not, so that none is lost.
    fn leave(&self) {
        let none = self.manager.py().None();
        let _ = self.messages.call_method0("ClearWarnings");
        let _ = self.manager.call_method1("__exit__", (&none, &none, &none));
    }
}

impl Drop for Trap<'_> {
    fn drop(&mut self) {
        if let Some(trap) = self.0.take() {
            trap.leave();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_in_parser_messages() {
        let place = place_in("C:/a b.usda:3:18: parse error at ',3]' in </x.a>\n").expect("a place");
        assert_eq!((place.file.as_str(), place.line, place.column), ("C:/a b.usda", 3, 18));
        assert_eq!(place.problem, "parse error at ',3]' in </x.a>");
        assert_eq!(place_in("Failed to open layer @x@"), None);
    }

    #[test]
    fn versioned_namespaces_are_removed() {
        assert_eq!(one_line("@a.usda@,@anon:0x55:session.usda@</a> CANNOT"), "@a.usda@</a> CANNOT");
        assert_eq!(one_line("in pxrInternal_v0_26_11__pxrReserved__::Sdf_Parser\n at 'x'"), "in Sdf_Parser at 'x'");
    }
}
