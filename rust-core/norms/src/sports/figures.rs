//! What the readings come to.

use super::{
    glare::{Rating, Source, worst},
    gradient::Gradient,
    plan::{EYES, Plan},
};
use crate::lit::{Lit, Reading, Spot};
use serde_json::{Value, json};

/// A field's light on its ground and towards cameras.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OfField {
    pub(crate) name: String,
    pub(crate) counts: [u32; 2],
    /// Metres from point to point.
    steps: [f64; 2],
    pub(crate) ground: Lit,
    /// By camera.
    pub(crate) filmed: Vec<(String, Lit)>,
    /// At its points, where it is asked for.
    pub(crate) glare: Vec<([f64; 3], Rating)>,
}

/// Everything that a plan asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    pub(crate) fields: Vec<OfField>,
    /// By name.
    pub(crate) observers: Vec<(String, Rating)>,
    pub(crate) factor: f64,
    /// What the figures leave out.
    pub(crate) notes: Vec<String>,
    pub(crate) reflectance: f64,
    pub(crate) gradient_over: f64,
}

/// U1 and U2 of EN 12193: the least over the greatest and over the mean; none without light.
pub(crate) fn uniformities(lit: &Lit) -> [Option<[f64; 2]>; 2] {
    let [to_mean, to_greatest] = lit.uniformities();
    [to_greatest, to_mean]
}

impl Figures {
    /// Of readings at a plan's spots with new lamps, in their order, and the light that comes straight to its eyes.
    pub fn new(plan: &Plan, up: [f64; 3], readings: &[Reading], sources: &[Vec<Source>]) -> Self {
        let spots = plan.spots(up);
        let mut first = 0;
        let mut take = |count: u32| {
            let range = first..first + count as usize;
            first = range.end;
            let kept: Vec<Reading> = readings[range.clone()].iter().map(|reading| reading.times(plan.maintenance_factor)).collect();
            Lit::new((&spots[range] as &[Spot], &kept))
        };
        let mut fields: Vec<OfField> = Vec::new();
        for field in &plan.fields {
            let counts = field.counts();
            let count = counts[0] * counts[1];
            let ground = take(count);
            let filmed =
                plan.cameras.iter().filter(|camera| camera.films(field)).map(|camera| (camera.name.clone(), take(count))).collect();
            let [along, across] = field.sides();
            let steps = [along / f64::from(counts[0]), across / f64::from(counts[1])];
            fields.push(OfField { name: field.name.clone(), counts, steps, ground, filmed, glare: Vec::new() });
        }
        let looks = plan.looks(up);
        let rate = |field: &OfField, sources: &[Source]| {
            // Glare is that of new lamps.
            let ground = field.ground.ends().map_or(Reading::default(), |[.., mean]| mean.times(plan.maintenance_factor.recip()));
            worst(sources, &looks, plan.reflectance, ground)
        };
        let mut eyes = sources.iter();
        let at = |observer: &super::Observer| plan.field(observer.field.as_ref());
        let observers =
            plan.observers.iter().zip(&mut eyes).map(|(observer, sources)| (observer.name.clone(), rate(&fields[at(observer)], sources)));
        let observers: Vec<(String, Rating)> = observers.collect();
        for (field, found) in plan.fields.iter().zip(&mut fields).filter(|(field, _)| field.glare) {
            let points = field.raster(EYES, up);
            let rated: Vec<_> = points.into_iter().zip(&mut eyes).map(|(point, sources)| (point, rate(found, sources))).collect();
            found.glare = rated;
        }
        let (factor, gradient_over) = (plan.maintenance_factor, plan.gradient_over);
        Self { fields, observers, factor, notes: Vec::new(), reflectance: plan.reflectance, gradient_over }
    }

    /// Whether a luminaire stood nearer to a line of sight than CIE 112's formula holds.
    pub fn has_nearer(&self) -> bool {
        self.ratings().any(|rating| rating.nearer)
    }

    /// Whether glare is rated anywhere.
    pub fn is_rated(&self) -> bool {
        self.ratings().next().is_some()
    }

    fn ratings(&self) -> impl Iterator<Item = &Rating> {
        let at_points = self.fields.iter().flat_map(|field| &field.glare).map(|(_, rating)| rating);
        self.observers.iter().map(|(_, rating)| rating).chain(at_points)
    }

    /// With what the figures leave out.
    pub fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// For machines; `docs/sports.md` lists the keys.
    pub fn json(&self) -> Value {
        let lit = |field: &OfField, lit: &Lit| {
            let [u1, u2] = uniformities(lit);
            let Gradient { ratio, percent } = field.gradient(lit, self.gradient_over);
            lit.json(&[("u1", u1), ("u2", u2), ("gradient_ratio", ratio), ("gradient_percent", percent)])
        };
        let field = |field: &OfField| {
            let camera = |(name, of): &(String, Lit)| {
                let mut found = lit(field, of);
                found.insert("name".into(), json!(name));
                Value::Object(found)
            };
            let mut found = json!({
                "name": field.name,
                "points": field.counts,
                "horizontal": lit(field, &field.ground),
                "cameras": field.filmed.iter().map(camera).collect::<Vec<_>>(),
            });
            if let Some((place, rating)) = field.worst() {
                let point = |(place, rating): &([f64; 3], Rating)| of_rating(rating, json!({ "position_m": place }));
                found["glare"] = of_rating(rating, json!({ "position_m": place }));
                found["glare"]["points"] = field.glare.iter().map(point).collect();
            }
            found
        };
        json!({
            "maintenance_factor": self.factor,
            "reflectance": self.reflectance,
            "gradient_over_m": self.gradient_over,
            "notes": self.notes,
            "fields": self.fields.iter().map(field).collect::<Vec<_>>(),
            "observers": self.observers.iter().map(|(name, rating)| of_rating(rating, json!({ "name": name }))).collect::<Vec<_>>(),
        })
    }
}

impl OfField {
    /// How fast the light of its points changes.
    pub(crate) fn gradient(&self, lit: &Lit, over: f64) -> Gradient {
        Gradient::new(lit, self.counts, self.steps, over)
    }

    /// Where glare is worst.
    pub(crate) fn worst(&self) -> Option<&([f64; 3], Rating)> {
        self.glare.iter().max_by(|a, b| a.1.order().total_cmp(&b.1.order()))
    }
}

fn of_rating(rating: &Rating, mut found: Value) -> Value {
    found["gr"] = json!(rating.gr);
    found["gr_error"] = json!(rating.gr.map(|_| rating.error));
    found["look_deg"] = json!(rating.gr.map(|_| rating.look_deg));
    found
}
