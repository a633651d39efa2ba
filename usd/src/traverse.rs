//! The traversal: from prims to models, with what is inherited carried along.

use crate::build::{self, BuildError, BuiltMesh, MeshSource};
use crate::context::Context;
use crate::model::{Element, Group, Inherited, Kind, Model, Shape, Slot};
use crate::options::Purpose;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::xform::Xforms;
use crate::{daylight, instancer, light, material, mesh, mesh_light, meter, primvar, quadrics, skeleton};
use gonio::mesh::Interpolation;
use gonio::scene::{Mesh, MeshId, Origin, Transform};
use gonio::{Error, Result};
use pyo3::intern;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use std::sync::atomic::AtomicBool;

/// Floats of meshes that wait to be built; more are built at once, to bound memory.
const PENDING_LIMIT: usize = 1 << 25;
/// How deep instancers may stand inside prototypes of others.
const MAX_NESTING: usize = 32;

/// What a prim type means to the traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PrimKind {
    Container,
    /// A container whose meshes are skinned.
    SkelRoot,
    Mesh,
    Quadric,
    Instancer,
    Light,
    Camera,
    /// Neither it nor what is below it can be seen.
    Leaf,
    /// A surface that gonio does not have.
    Unsupported,
}

/// What a prim hands down.
#[derive(Clone, Debug)]
struct Branch {
    to_model: Transform,
    is_detached: bool,
    purpose: Option<Purpose>,
    primvars: Rc<[Inherited]>,
    is_bound: bool,
}

impl Branch {
    /// Of a model's root; `is_bound` where bindings may come from outside the model.
    fn root(is_bound: bool) -> Self {
        Self { to_model: Transform::IDENTITY, is_detached: false, purpose: None, primvars: Rc::from([]), is_bound }
    }
}

/// Prims that are still to be visited.
type Stack<'py> = Vec<(Prim<'py>, Rc<Branch>)>;

/// Walks a stage.
#[derive(Debug)]
pub struct Walker<'w, 'a, 'py> {
    context: &'w mut Context<'a, 'py>,
    xforms: Xforms<'py>,
    kinds: HashMap<String, PrimKind>,
    prototypes: HashMap<String, Rc<Model>>,
    open_prototypes: Vec<String>,
    quadrics: HashMap<String, MeshId>,
    pending: Vec<(MeshId, MeshSource)>,
    pending_floats: usize,
    failed: HashSet<MeshId>,
    displayed: Bound<'py, PyAny>,
    loaded: Bound<'py, PyAny>,
}

impl<'w, 'a, 'py> Walker<'w, 'a, 'py> {
    /// For the context's stage and time.
    ///
    /// # Errors
    /// What `pxr` raises.
    pub fn new(context: &'w mut Context<'a, 'py>) -> PyResult<Self> {
        let usd = Module::Usd.import(context.py)?;
        let active_and_loaded = usd.getattr("PrimIsActive")?.bitand(usd.getattr("PrimIsLoaded")?)?;
        Ok(Self {
            xforms: Xforms::new(context)?,
            kinds: HashMap::new(),
            prototypes: HashMap::new(),
            open_prototypes: Vec::new(),
            quadrics: HashMap::new(),
            pending: Vec::new(),
            pending_floats: 0,
            failed: HashSet::new(),
            displayed: usd.getattr("PrimDefaultPredicate")?,
            // Prototypes of point instancers may stand below `over` and `class`, to be hidden from others.
            loaded: active_and_loaded,
            context,
        })
    }

    /// The model of the whole stage, in stage units; its meshes are in the scene, those that could not be built are in the second value.
    ///
    /// # Errors
    /// Cancellation.
    pub fn world(mut self) -> Result<(Model, HashSet<MeshId>)> {
        let root = self.context.stage.call_method0(intern!(self.context.py, "GetPseudoRoot"));
        let origin = Origin::new("/");
        let Some(root) = self.context.attempt(&origin, "the stage has no root", root) else { return Ok((Model::default(), self.failed)) };
        let branch = Rc::new(Branch::root(false));
        let displayed = self.displayed.clone();
        let roots = self.children(&Prim::new(root), &displayed, &branch);
        let model = self.walk("", roots, &displayed)?;
        self.build_pending()?;
        Ok((model, self.failed))
    }

    /// Visits prims and all below; the stack is ours, as stages may be deeper than the machine's.
    fn walk(&mut self, root: &str, mut stack: Stack<'py>, predicate: &Bound<'py, PyAny>) -> Result<Model> {
        let mut model = Model { root: root.to_owned(), elements: Vec::new() };
        while let Some((prim, branch)) = stack.pop() {
            self.context.check_cancel()?;
            self.visit(&prim, &branch, &mut model, &mut stack, predicate)?;
        }
        self.bind(&mut model);
        Ok(model)
    }

    fn children(&mut self, prim: &Prim<'py>, predicate: &Bound<'py, PyAny>, branch: &Rc<Branch>) -> Stack<'py> {
        let list = prim.object().call_method1(intern!(self.context.py, "GetFilteredChildren"), (predicate,));
        let list = list.and_then(|list| list.try_iter()?.map(|child| child.map(|child| (Prim::new(child), branch.clone()))).collect());
        let mut children: Stack<'py> = self.context.attempt_at(prim, "the children cannot be listed", list).unwrap_or_default();
        children.reverse();
        children
    }

    fn visit(
        &mut self,
        prim: &Prim<'py>,
        above: &Rc<Branch>,
        model: &mut Model,
        stack: &mut Stack<'py>,
        predicate: &Bound<'py, PyAny>,
    ) -> Result<()> {
        let type_name = prim.type_name();
        let kind = self.kind(&type_name, prim);
        if kind == PrimKind::Leaf {
            return Ok(());
        }
        *self.context.prim_counts.entry(type_name.clone()).or_default() += 1;
        let Some(branch) = self.branch(prim, above) else { return Ok(()) };
        let is_shown = branch.purpose.is_none_or(|purpose| self.context.options.shows(purpose));
        if is_shown {
            self.read(prim, &type_name, kind, &branch, model)?;
        }
        if prim.is_instance() {
            return self.native_instance(prim, &branch, model);
        }
        if kind == PrimKind::Instancer {
            return Ok(());
        }
        // Surfaces have no surfaces below them: their primvars need not be read again.
        let is_surface = matches!(kind, PrimKind::Mesh | PrimKind::Quadric | PrimKind::Unsupported);
        let handed_down = if is_surface { branch.primvars.clone() } else { primvar::handed_down(self.context, prim, &branch.primvars) };
        let below = Rc::new(Branch { primvars: handed_down, ..branch });
        // Baking may have composed the prim anew.
        let baked = if kind == PrimKind::SkelRoot { self.context.prim_at(&prim.path()) } else { None };
        let children = self.children(baked.as_ref().unwrap_or(prim), predicate, &below);
        stack.extend(children);
        Ok(())
    }

    /// What the prim's own opinions make of what it inherits; `None` where the prim is invisible or cannot be placed.
    fn branch(&mut self, prim: &Prim<'py>, above: &Branch) -> Option<Branch> {
        if self.context.get_authored::<String>(prim, "visibility").is_some_and(|visibility| visibility == "invisible") {
            return None;
        }
        let purpose = self.context.get_authored::<String>(prim, "purpose").and_then(|token| Purpose::from_token(&token));
        let local = self.xforms.local(self.context, prim)?;
        let to_model = if local.resets { local.transform } else { above.to_model.after(&local.transform) };
        Some(Branch {
            to_model,
            is_detached: above.is_detached || local.resets,
            purpose: purpose.or(above.purpose),
            primvars: above.primvars.clone(),
            is_bound: above.is_bound || prim.has_authored_prefix("material:binding"),
        })
    }

    fn kind(&mut self, type_name: &str, prim: &Prim<'py>) -> PrimKind {
        if let Some(kind) = self.kinds.get(type_name) {
            let kind = *kind;
            if kind == PrimKind::Unsupported {
                self.context.unsupported(type_name, &prim.origin());
            }
            return kind;
        }
        let kind = self.classify(type_name, prim);
        self.kinds.insert(type_name.to_owned(), kind);
        kind
    }

    fn classify(&mut self, type_name: &str, prim: &Prim<'py>) -> PrimKind {
        match type_name {
            "" | "Xform" | "Scope" => PrimKind::Container,
            "SkelRoot" => PrimKind::SkelRoot,
            "Mesh" => PrimKind::Mesh,
            "PointInstancer" => PrimKind::Instancer,
            "Camera" => PrimKind::Camera,
            "Material" | "Shader" | "NodeGraph" | "GeomSubset" | "Skeleton" | "SkelAnimation" | "BlendShape" | "RenderSettings"
            | "RenderProduct" | "RenderVar" | "RenderPass" => PrimKind::Leaf,
            quadric if quadrics::is_quadric(quadric) => PrimKind::Quadric,
            light if light::is_light(light) => PrimKind::Light,
            other => self.classify_by_schema(other, prim),
        }
    }

    fn classify_by_schema(&mut self, type_name: &str, prim: &Prim<'py>) -> PrimKind {
        let py = self.context.py;
        let is_gprim = Module::UsdGeom.item(py, "Gprim").is_ok_and(|class| prim.is_a(&class));
        let is_particle_field = type_name.starts_with("ParticleField");
        if is_gprim || is_particle_field {
            self.context.unsupported(type_name, &prim.origin());
            return PrimKind::Unsupported;
        }
        let is_known = || Module::Usd.item(py, "SchemaRegistry")?.call0()?.call_method1("IsConcrete", (type_name,))?.is_truthy();
        if !is_known().unwrap_or(true) {
            let message = || format!("the prim type '{type_name}' is unknown; only the prims below it are read");
            self.context.once("type", type_name, &prim.origin(), message);
        }
        PrimKind::Container
    }

    fn read(&mut self, prim: &Prim<'py>, type_name: &str, kind: PrimKind, branch: &Branch, model: &mut Model) -> Result<()> {
        match kind {
            PrimKind::Mesh => self.mesh(prim, branch, model)?,
            PrimKind::Quadric => self.quadric(prim, type_name, branch, model)?,
            PrimKind::Instancer => self.point_instancer(prim, branch, model)?,
            PrimKind::Light => push(model, prim, branch, Kind::Light),
            PrimKind::Camera => push(model, prim, branch, Kind::Camera),
            PrimKind::Container => {
                if daylight::is_daylight(prim) {
                    push(model, prim, branch, Kind::Light);
                }
                if meter::is_measured(prim) {
                    push(model, prim, branch, Kind::Measured(None));
                }
                self.report_draw_mode(prim);
            }
            PrimKind::SkelRoot => skeleton::bake(self.context, prim),
            PrimKind::Leaf | PrimKind::Unsupported => {}
        }
        Ok(())
    }

    fn report_draw_mode(&mut self, prim: &Prim<'py>) {
        let mode = self.context.get_authored::<String>(prim, "model:drawMode");
        if let Some(mode) = mode.filter(|mode| mode != "default" && mode != "inherited") {
            let message = || format!("model:drawMode '{mode}' is not supported, the full geometry is shown");
            self.context.once("drawMode", &mode, &prim.origin(), message);
        }
    }

    fn mesh(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(mesh::ReadMesh { source, slot_prims }) = mesh::read(self.context, prim) else { return Ok(()) };
        let has_opacity = source.polygons.primvars.iter().any(|primvar| primvar.name == "displayOpacity");
        let is_light = mesh_light::is_geometry_light(prim);
        let shape = Shape { mesh: self.submit(source)?, slots: vec![Slot::Unbound; slot_prims.len()], slot_prims, has_opacity, is_light };
        if meter::is_measured(prim) {
            push(model, prim, branch, Kind::Measured(Some(shape.mesh)));
        }
        // A binding may stand on a subset alone.
        let is_bound = branch.is_bound || shape.slot_prims.len() > 1;
        push(model, prim, &Branch { is_bound, ..branch.clone() }, Kind::Shape(shape));
        Ok(())
    }

    fn quadric(&mut self, prim: &Prim<'py>, type_name: &str, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(quadric) = quadrics::read(self.context, prim, type_name) else { return Ok(()) };
        let mesh = match self.quadrics.get(&quadric.key()) {
            Some(mesh) => *mesh,
            None => {
                let mesh = self.submit(quadric.source(prim.origin(), self.context.options.complexity))?;
                self.quadrics.insert(quadric.key(), mesh);
                mesh
            }
        };
        let own = primvar::authored(self.context, prim);
        for uneven in own.iter().filter(|primvar| primvar.interpolation != Interpolation::Constant && primvar.place_count() != 1) {
            self.context.unsupported(&format!("primvar '{}' that varies over a {type_name}", uneven.name), &prim.origin());
        }
        let own: Vec<Inherited> = own.iter().filter(|primvar| primvar.place_count() == 1).filter_map(single).collect();
        let has_opacity = own.iter().any(|inherited| inherited.name == "displayOpacity");
        if meter::is_measured(prim) {
            push(model, prim, branch, Kind::Measured(Some(mesh)));
        }
        let is_light = mesh_light::is_geometry_light(prim);
        let shape = Shape { mesh, slots: vec![Slot::Unbound], slot_prims: vec![prim.path()], has_opacity, is_light };
        let branch = Branch { primvars: primvar::merged(&own, &branch.primvars), ..branch.clone() };
        push(model, prim, &branch, Kind::Shape(shape));
        Ok(())
    }

    fn point_instancer(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        for placed in instancer::read(self.context, prim) {
            let Some(prototype) = self.point_prototype(prim, &placed.prototype)? else { continue };
            let group = Group { model: prototype, transforms: placed.transforms, primvars: placed.primvars, instance: None };
            push(model, prim, branch, Kind::Group(group));
        }
        Ok(())
    }

    /// The model of a point instancer's prototype.
    fn point_prototype(&mut self, instancer: &Prim<'py>, path: &str) -> Result<Option<Rc<Model>>> {
        if let Some(model) = self.prototypes.get(path) {
            return Ok(Some(model.clone()));
        }
        let origin = instancer.origin();
        if self.open_prototypes.iter().any(|open| open == path) || self.open_prototypes.len() >= MAX_NESTING {
            self.context.warn(
                &origin,
                format!("the prototype {path} holds itself, or prototypes are nested deeper than {MAX_NESTING}; it is left out"),
            );
            return Ok(None);
        }
        let Some(prim) = self.context.prim_at(path) else {
            self.context.warn(&origin, format!("the prototype {path} does not exist; its instances are left out"));
            return Ok(None);
        };
        self.open_prototypes.push(path.to_owned());
        let predicate = self.loaded.clone();
        let model = self.walk(path, vec![(prim, Rc::new(Branch::root(true)))], &predicate);
        self.open_prototypes.pop();
        let model = Rc::new(model?);
        self.prototypes.insert(path.to_owned(), model.clone());
        Ok(Some(model))
    }

    fn native_instance(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let Some(prototype) = prim.prototype() else { return Ok(()) };
        let path = prototype.path();
        let known = self.prototypes.get(&path).cloned();
        let prototype = match known {
            Some(known) => known,
            None => {
                let predicate = self.displayed.clone();
                let roots = self.children(&prototype, &predicate, &Rc::new(Branch::root(false)));
                let walked = Rc::new(self.walk(&path, roots, &predicate)?);
                self.prototypes.insert(path, walked.clone());
                walked
            }
        };
        let own = primvar::handed_down(self.context, prim, &branch.primvars);
        let group = Group { model: prototype, transforms: vec![Transform::IDENTITY], primvars: Vec::new(), instance: Some(prim.path()) };
        push(model, prim, &Branch { primvars: own, ..branch.clone() }, Kind::Group(group));
        Ok(())
    }

    /// Looks up the materials of the model's shapes, all in one call.
    fn bind(&mut self, model: &mut Model) {
        let mut prims = Vec::new();
        let mut places = Vec::new();
        for (index, element) in model.elements.iter().enumerate() {
            let Kind::Shape(shape) = &element.kind else { continue };
            if !element.is_bound {
                continue;
            }
            for (slot, path) in shape.slot_prims.iter().enumerate() {
                if let Some(prim) = self.context.prim_at(path) {
                    prims.push(prim);
                    places.push((index, slot));
                }
            }
        }
        if prims.is_empty() {
            return;
        }
        let materials = material::bound_all(self.context, &prims);
        for ((index, slot), material) in places.into_iter().zip(materials) {
            if let Kind::Shape(shape) = &mut model.elements[index].kind {
                shape.slots[slot] = Slot::Bound(material);
            }
        }
    }

    /// Reserves the scene's place for a mesh that is built later.
    fn submit(&mut self, source: MeshSource) -> Result<MeshId> {
        let id = self.context.scene.add_mesh(Mesh { origin: source.origin.clone(), ..Mesh::default() });
        let primvar_floats: usize = source.polygons.primvars.iter().map(|primvar| primvar.values.len()).sum();
        self.pending_floats += source.polygons.points.len() * 3 + source.polygons.corners.len() + primvar_floats;
        self.pending.push((id, source));
        if self.pending_floats > PENDING_LIMIT {
            self.build_pending()?;
        }
        Ok(id)
    }

    /// Builds the waiting meshes on all cores, without the interpreter.
    fn build_pending(&mut self) -> Result<()> {
        let pending = std::mem::take(&mut self.pending);
        self.pending_floats = 0;
        let cancel = self.context.cancel_flag();
        let built: Vec<_> = self.context.py.detach(|| pending.into_par_iter().map(|(id, source)| built(id, source, cancel)).collect());
        for (id, origin, result) in built {
            match result {
                Ok(BuiltMesh { mesh, problems }) => {
                    self.context.scene.meshes[id.index()] = mesh;
                    problems.into_iter().for_each(|problem| self.context.warn(&origin, problem));
                }
                Err(BuildError::Cancelled) => return Err(Error::Cancelled),
                Err(BuildError::Problem(problem)) => {
                    self.context.warn(&origin, format!("{problem}; the mesh is left out"));
                    self.failed.insert(id);
                }
            }
        }
        Ok(())
    }
}

fn built(id: MeshId, source: MeshSource, cancel: &AtomicBool) -> (MeshId, Origin, Result<BuiltMesh, BuildError>) {
    let origin = source.origin.clone();
    // A defect in one mesh must not take the stage with it.
    let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| build::build(source, cancel)));
    (id, origin, result.unwrap_or_else(|_| Err(BuildError::Problem("internal error while the mesh was cut into triangles".into()))))
}

fn push(model: &mut Model, prim: &Prim<'_>, branch: &Branch, kind: Kind) {
    model.elements.push(Element {
        path: prim.path(),
        kind,
        to_model: branch.to_model,
        is_detached: branch.is_detached,
        purpose: branch.purpose,
        primvars: branch.primvars.clone(),
        is_bound: branch.is_bound,
    });
}

/// A primvar with one value, whatever its interpolation says.
fn single(primvar: &gonio::mesh::FacePrimvar) -> Option<Inherited> {
    Some(Inherited { name: primvar.name.clone(), components: primvar.components, values: primvar.at(0)?.into(), is_varying: false })
}
