//! Eyes by what they belong to: points of their own, sensor grids of models, and grids.

use gonio::{
    Result,
    measure::GridPoints,
    scene::{Grid, Meter, Scene},
    view_out::View,
};

/// Where eyes are.
pub(super) struct Areas<'a> {
    meters: &'a [Meter],
    grids: Vec<(&'a Grid, GridPoints)>,
}

/// The same with what they see.
pub(super) struct Seen<'a> {
    /// Points one by one.
    pub(super) meters: Vec<(&'a Meter, &'a View)>,
    pub(super) grids: Vec<SeenGrid<'a>>,
}

pub(super) struct SeenGrid<'a> {
    pub(super) grid: &'a Grid,
    pub(super) points: GridPoints,
    /// Of the points that there are, in their order.
    pub(super) views: &'a [View],
}

impl<'a> Areas<'a> {
    /// Lays a scene's grids out.
    pub(super) fn laid_out(scene: &'a Scene) -> Result<Self> {
        let points = GridPoints::of_scene(scene)?;
        Ok(Self { meters: &scene.meters, grids: scene.grids.iter().zip(points).collect() })
    }

    /// All of them: points of their own first, then grid by grid.
    pub(super) fn eyes(&self) -> Vec<[f64; 3]> {
        let of_grids = self.grids.iter().flat_map(|(_, points)| points.known());
        self.meters.iter().map(|meter| meter.position).chain(of_grids).collect()
    }

    /// With the views of all eyes, in their order.
    pub(super) fn with(self, views: &'a [View]) -> Seen<'a> {
        let (of_meters, mut rest) = views.split_at(self.meters.len());
        let mut grids = Vec::with_capacity(self.grids.len());
        for (grid, points) in self.grids {
            let (views, after) = rest.split_at(points.known().count());
            rest = after;
            grids.push(SeenGrid { grid, points, views });
        }
        Seen { meters: self.meters.iter().zip(of_meters).collect(), grids }
    }
}

impl<'a> Seen<'a> {
    /// Sensor grids of models: sensors are called by their grid's name, a slash and their numbers; single ones are none.
    pub(super) fn sensor_grids(&self) -> Vec<(&'a str, Vec<View>)> {
        let mut found: Vec<(&str, Vec<View>)> = Vec::new();
        for (meter, view) in &self.meters {
            let Some(grid) = grid_of(meter) else { continue };
            match found.iter_mut().find(|(name, _)| *name == grid) {
                Some((_, views)) => views.push((*view).clone()),
                None => found.push((grid, vec![(*view).clone()])),
            }
        }
        found.retain(|(_, views)| views.len() > 1);
        found
    }

    /// Points that are of no sensor grid.
    pub(super) fn single_meters(&self) -> impl Iterator<Item = (&'a Meter, &'a View)> {
        let grids: Vec<&str> = self.sensor_grids().into_iter().map(|(name, _)| name).collect();
        self.meters.iter().copied().filter(move |(meter, _)| grid_of(meter).is_none_or(|grid| !grids.contains(&grid)))
    }
}

fn grid_of(meter: &Meter) -> Option<&str> {
    let (grid, number) = meter.origin.name.rsplit_once('/')?;
    (!grid.is_empty() && number.parse::<u32>().is_ok()).then_some(grid)
}
