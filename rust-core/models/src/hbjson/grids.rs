//! Sensor grids and views.

use super::Reader;
use super::node::Node;
use crate::vector::{Vec3, across, unit};
use crate::view::View;
use gonio_scene::{Meter, Origin};

impl<'a> Reader<'a> {
    /// A luxmeter a sensor, named by the grid and the sensor's number.
    pub(super) fn sensor_grid(&mut self, grid: &Node<'a>) {
        self.builder.count("SensorGrid");
        let mut wrong = 0;
        let mut first = None;
        for (number, sensor) in grid.list("sensors").iter().enumerate() {
            match self.sensor(grid, sensor, number) {
                Ok(meter) => self.builder.model.scene.meters.push(meter),
                Err(problem) => {
                    wrong += 1;
                    first.get_or_insert_with(|| (sensor.clone(), problem));
                }
            }
        }
        if let Some((sensor, problem)) = first {
            let more = if wrong > 1 { format!(", and {} more of the grid", wrong - 1) } else { String::new() };
            self.warn(&sensor, &format!("{problem}; it is left out{more}"));
        }
    }

    fn sensor(&self, grid: &Node<'a>, sensor: &Node<'a>, number: usize) -> Result<Meter, String> {
        let position = sensor.triple("pos")?.map(|x| x * self.metres);
        let normal: Vec3 = unit(sensor.triple("dir")?).ok_or("the sensor's direction is no direction")?;
        let name = format!("{}/{number}", grid.identifier());
        let origin = Origin { name: name.as_str().into(), file: self.file.as_str().into() };
        Ok(Meter { origin, position, normal, facing: across(normal), ..Meter::default() })
    }

    pub(super) fn view(&mut self, node: &Node<'a>) {
        self.builder.count("View");
        let origin = self.origin(node);
        match self.read_view(node).and_then(|view| view.camera(origin.clone())) {
            Ok((camera, told)) => {
                self.builder.model.scene.cameras.push(camera);
                if let Some(told) = told {
                    self.builder.warn(&origin, told);
                }
            }
            Err(problem) => self.tell(node, Err(problem)),
        }
    }

    fn read_view(&self, node: &Node<'a>) -> Result<View, String> {
        let kind = node.text("view_type").and_then(|text| text.chars().next()).unwrap_or('v');
        let metres = if kind == 'l' { self.metres } else { 1.0 };
        Ok(View {
            kind,
            position: node.triple("position")?.map(|x| x * self.metres),
            direction: node.triple("direction")?,
            up: node.triple("up_vector")?,
            size: [node.number("h_size", 60.0)? * metres, node.number("v_size", 60.0)? * metres],
            shift: [node.number("shift", 0.0)?, node.number("lift", 0.0)?],
            clip: [node.number("fore_clip", 0.0)? * self.metres, node.number("aft_clip", 0.0)? * self.metres],
        })
    }
}
