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
        let own = primvar::handed_down(self.context, prim, &branch.primvars);
        let group = Group { model: prototype, transforms: vec![Transform::IDENTITY], primvars: Vec::new(), instance: Some(prim.path()) };
        push(model, prim, &Branch { primvars: own, ..branch.clone() }, Kind::Group(group));
        Ok(())
    }
}
