//! The traversal: from prims to models, with what is inherited carried along.

mod kind;
mod pending;
mod prototype;
mod surface;

use crate::context::Context;
use crate::draw_mode::{self, DrawMode};
use crate::kept::{KeptPrim, Known, MeshParts};
use crate::model::{Element, Inherited, Kind, Model, Slots};
use crate::options::{Purpose, Standing};
use crate::prim::Prim;
use crate::pxr::Module;
use crate::xform::Xforms;
use crate::{daylight, haze, mesh, meter, nurbs_patch, primvar, tet_mesh, volume};
use gonio::Result;
use gonio::scene::{MeshId, Origin, Transform};
use kind::PrimKind;
use pending::Pending;
use pyo3::intern;
use pyo3::prelude::*;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use std::sync::Arc;

/// What a prim hands down.
#[derive(Clone, Debug)]
struct Branch {
    to_model: Transform,
    is_detached: bool,
    purpose: Option<Purpose>,
    primvars: Rc<[Inherited]>,
    is_bound: bool,
    draw_mode: DrawMode,
}

impl Branch {
    /// Of a model's root; `is_bound` where bindings may come from outside the model.
    fn root(is_bound: bool) -> Self {
        Self {
            to_model: Transform::IDENTITY,
            is_detached: false,
            purpose: None,
            primvars: Rc::from([]),
            is_bound,
            draw_mode: DrawMode::Default,
        }
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
    /// Paths of skinned instances for whose prims materials may be bound above.
    bound_above: HashSet<String>,
    quadrics: HashMap<String, MeshId>,
    pending: Pending,
    failed: HashSet<MeshId>,
    /// Prims whose materials are looked up at the end, and where to put them.
    to_bind: Vec<(Vec<Prim<'py>>, Slots)>,
    /// Meshes that are to be kept for other readings when they are built.
    to_keep: HashMap<MeshId, (Arc<Known>, MeshParts)>,
    /// Whether the stage has native instances; else no prim is asked whether it is one.
    has_instances: bool,
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
            bound_above: HashSet::new(),
            quadrics: HashMap::new(),
            pending: Pending::default(),
            failed: HashSet::new(),
            to_bind: Vec::new(),
            to_keep: HashMap::new(),
            has_instances: context.stage.call_method0(intern!(context.py, "GetPrototypes"))?.len()? > 0,
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
        let Some(root) = self.root() else { return Ok((Model::default(), self.failed)) };
        let branch = Rc::new(Branch::root(false));
        let displayed = self.displayed.clone();
        let roots = self.children(&root, &displayed, &branch);
        let model = self.walk("", roots, &displayed)?;
        self.bind();
        self.finish_meshes()?;
        self.context.waited_for_meshes = self.pending.waited;
        Ok((model, self.failed))
    }

    fn root(&mut self) -> Option<Prim<'py>> {
        if let Some(kept) = self.context.kept.root(self.context.py, "") {
            return Some(kept);
        }
        let root = self.context.stage.call_method0(intern!(self.context.py, "GetPseudoRoot"));
        let root = Prim::new(self.context.attempt(&Origin::new("/"), "the stage has no root", root)?);
        self.context.kept.keep_root("", &root);
        Some(root)
    }

    /// Visits prims and all below; the stack is ours, as stages may be deeper than the machine's.
    fn walk(&mut self, root: &str, mut stack: Stack<'py>, predicate: &Bound<'py, PyAny>) -> Result<Model> {
        let mut model = Model { root: root.to_owned(), elements: Vec::new() };
        while let Some((prim, branch)) = stack.pop() {
            self.context.check_cancel()?;
            self.visit(&prim, &branch, &mut model, &mut stack, predicate)?;
        }
        Ok(model)
    }

    fn children(&mut self, prim: &Prim<'py>, predicate: &Bound<'py, PyAny>, branch: &Rc<Branch>) -> Stack<'py> {
        let mut children: Stack<'py> = self.prims_below(prim, predicate).into_iter().map(|child| (child, branch.clone())).collect();
        children.reverse();
        children
    }

    /// The children, asked for once; those of skinned meshes' roots are written over for each reading.
    fn prims_below(&mut self, prim: &Prim<'py>, predicate: &Bound<'py, PyAny>) -> Vec<Prim<'py>> {
        let py = self.context.py;
        let cell = &prim.known().children[usize::from(!predicate.is(&self.displayed))];
        let is_skinned = self.context.kept.is_skinned(prim);
        if let (false, Some(kept)) = (is_skinned, cell.get()) {
            let known: Vec<Prim<'py>> = kept.iter().map(|child| child.prim(py)).collect();
            if known.iter().all(|child| self.context.kept.is_there(child)) {
                return known;
            }
        }
        let list = prim.object().call_method1(intern!(py, "GetFilteredChildren"), (predicate,));
        let list = list.and_then(|list| list.try_iter()?.map(|child| child.map(Prim::new)).collect::<PyResult<Vec<_>>>());
        let children = self.context.attempt_at(prim, "the children cannot be listed", list).unwrap_or_default();
        if !is_skinned {
            let _ = cell.set(children.iter().map(KeptPrim::of).collect());
        }
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
        // Prototypes stand elsewhere: what places them is what counts.
        let limited = model.root.is_empty() && self.context.options.subtree.is_some();
        let standing = if limited { self.context.options.standing(&prim.path()) } else { Standing::Within };
        if !self.has_instances {
            let _ = prim.known().is_instance.set(false);
        }
        let type_name = prim.type_name();
        let kind = self.kind(&type_name, prim);
        let is_pruned = model.root.is_empty() && !self.context.roles.are_plain() && self.context.roles.prunes(&prim.path());
        if kind == PrimKind::Leaf || standing == Standing::Beside || is_pruned {
            return Ok(());
        }
        *self.context.prim_counts.entry(type_name.clone()).or_default() += 1;
        let Some(branch) = self.branch(prim, above) else { return Ok(()) };
        let is_shown = branch.purpose.is_none_or(|purpose| self.context.options.shows(purpose));
        if standing == Standing::Above {
            let below = Rc::new(Branch { primvars: primvar::handed_down(self.context, prim, &branch.primvars), ..branch });
            let children = self.children(prim, predicate, &below);
            stack.extend(children);
            return Ok(());
        }
        let stands_in = branch.draw_mode != DrawMode::Default && !self.context.options.disable_draw_mode;
        if stands_in && draw_mode::applies(self.context, prim) {
            return if is_shown { self.stand_in(prim, &branch, model) } else { Ok(()) };
        }
        // Surfaces that are measured on need not be shown; whoever places them leaves the surface itself out.
        if is_shown || meter::is_measured(prim) {
            self.read(prim, &type_name, kind, &branch, model)?;
        }
        if let Some(shown) = self.skinned_as(prim) {
            return self.alike_instance(prim, &shown, &branch, model);
        }
        if prim.is_instance() {
            return self.native_instance(prim, &branch, model);
        }
        if kind == PrimKind::Instancer {
            return Ok(());
        }
        // Surfaces have no surfaces below them: their primvars need not be read again.
        let is_surface = kind.is_surface();
        let handed_down = if is_surface { branch.primvars.clone() } else { primvar::handed_down(self.context, prim, &branch.primvars) };
        let below = Rc::new(Branch { primvars: handed_down, ..branch });
        let children = self.children(prim, predicate, &below);
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
            draw_mode: draw_mode::stated(self.context, prim).unwrap_or(above.draw_mode),
        })
    }

    fn read(&mut self, prim: &Prim<'py>, type_name: &str, kind: PrimKind, branch: &Branch, model: &mut Model) -> Result<()> {
        match kind {
            PrimKind::Mesh => self.mesh(prim, mesh::read, branch, model)?,
            PrimKind::Patch => self.mesh(prim, nurbs_patch::read, branch, model)?,
            PrimKind::Tetrahedra => self.mesh(prim, tet_mesh::read, branch, model)?,
            PrimKind::Quadric => self.quadric(prim, type_name, branch, model)?,
            PrimKind::Curves => self.curves(prim, type_name, branch, model),
            PrimKind::Points => self.points(prim, branch, model),
            PrimKind::Volume => {
                if let Some(volume) = volume::read(self.context, &self.xforms, prim) {
                    let primvars = primvar::handed_down(self.context, prim, &branch.primvars);
                    push(model, prim, &Branch { primvars, ..branch.clone() }, Kind::Volume(Rc::new(volume)));
                }
            }
            PrimKind::Instancer => self.point_instancer(prim, branch, model)?,
            PrimKind::Light => push(model, prim, branch, Kind::Light),
            PrimKind::Camera => push(model, prim, branch, Kind::Camera),
            PrimKind::Container => {
                if daylight::is_daylight(prim) || haze::is_haze(prim) {
                    push(model, prim, branch, Kind::Light);
                }
                if meter::is_measured(prim) {
                    push(model, prim, branch, Kind::Measured(None));
                }
            }
            PrimKind::Leaf | PrimKind::Unsupported => {}
        }
        Ok(())
    }
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
