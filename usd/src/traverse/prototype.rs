//! Prototypes: of point instancers and of native instances, each walked once.

use super::{Branch, Walker, push};
use crate::instancer;
use crate::kept::KeptPrim;
use crate::model::{Group, Kind, Model};
use crate::prim::Prim;
use crate::primvar;
use gonio::Result;
use gonio::scene::Transform;
use std::rc::Rc;

/// How deep instancers may stand inside prototypes of others.
const MAX_NESTING: usize = 32;

impl<'py> Walker<'_, '_, 'py> {
    /// Adds what a point instancer places.
    pub(super) fn point_instancer(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
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
        let kept = self.context.kept.root(self.context.py, path);
        let Some(prim) = kept.or_else(|| self.context.prim_at(path)) else {
            self.context.warn(&origin, format!("the prototype {path} does not exist; its instances are left out"));
            return Ok(None);
        };
        self.context.kept.keep_root(path, &prim);
        self.open_prototypes.push(path.to_owned());
        let predicate = self.loaded.clone();
        let model = self.walk(path, vec![(prim, Rc::new(Branch::root(true)))], &predicate);
        self.open_prototypes.pop();
        let model = Rc::new(model?);
        self.prototypes.insert(path.to_owned(), model.clone());
        Ok(Some(model))
    }

    /// Adds a native instance.
    pub(super) fn native_instance(&mut self, prim: &Prim<'py>, branch: &Branch, model: &mut Model) -> Result<()> {
        let kept = prim.known().prototype.get().map(|kept| kept.prim(self.context.py));
        let kept = kept.filter(|prototype| self.context.kept.is_there(prototype));
        let Some(prototype) = kept.or_else(|| prim.prototype()) else { return Ok(()) };
        let _ = prim.known().prototype.set(KeptPrim::of(&prototype));
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
        self.push_instance(prim, branch, prototype, model);
        Ok(())
    }

    /// The path of the instance whose skinned points a prim shows, its own where that is the one.
    pub(super) fn skinned_as(&self, prim: &Prim<'py>) -> Option<String> {
        let alike = &self.context.alike;
        if alike.is_empty() { None } else { alike.get(&prim.path()).cloned() }
    }

    /// Adds one of several instances that are skinned alike: what stands below that which was taken apart is their prototype.
    pub(super) fn alike_instance(&mut self, prim: &Prim<'py>, shown: &str, branch: &Branch, model: &mut Model) -> Result<()> {
        let known = self.prototypes.get(shown).cloned();
        let prototype = match known {
            Some(known) => known,
            None => {
                let kept = self.context.kept.root(self.context.py, shown);
                let Some(root) = kept.or_else(|| self.context.prim_at(shown)) else { return Ok(()) };
                self.context.kept.keep_root(shown, &root);
                let predicate = self.displayed.clone();
                let below = self.children(&root, &predicate, &Rc::new(Branch::root(false)));
                let walked = Rc::new(self.walk(shown, below, &predicate)?);
                self.prototypes.insert(shown.to_owned(), walked.clone());
                if std::iter::successors(Some(root), Prim::parent).any(|above| above.has_authored_prefix("material:binding")) {
                    self.bound_above.insert(shown.to_owned());
                }
                walked
            }
        };
        // Materials were looked up below the one that is shown: what is bound above it must not count for the others.
        let is_bound = branch.is_bound || self.bound_above.contains(shown);
        self.push_instance(prim, &Branch { is_bound, ..branch.clone() }, prototype, model);
        Ok(())
    }

    fn push_instance(&mut self, prim: &Prim<'py>, branch: &Branch, prototype: Rc<Model>, model: &mut Model) {
        let own = primvar::handed_down(self.context, prim, &branch.primvars);
        let group = Group { model: prototype, transforms: vec![Transform::IDENTITY], primvars: Vec::new(), instance: Some(prim.path()) };
        push(model, prim, &Branch { primvars: own, ..branch.clone() }, Kind::Group(group));
    }
}
