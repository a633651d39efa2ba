//! Shader passes: of the outputs that materials have, the programs of those that a view shows.

use crate::{
    film::ChannelLayout,
    graph::{Program, Wanted, WantedOutput},
    scene::{Aov, Settings, ShaderValue},
    transport::{MaterialTable, ShaderPasses},
};

/// A program for each surface whose material has an output that a pass shows; the places of its outputs are the columns of the sums.
pub(super) fn programs(materials: &MaterialTable, settings: &Settings) -> ShaderPasses {
    let layout = ChannelLayout::new(&settings.aovs);
    let columns = layout.shader_columns();
    if columns == 0 {
        return ShaderPasses::default();
    }
    let mut programs = vec![None; materials.surfaces.len()];
    for material in &materials.shader_outputs {
        let mut outputs = Vec::new();
        for aov in &layout.aovs {
            let Aov::Shader(kind, number) = *aov else { continue };
            let Some(name) = settings.shader_passes.get(usize::from(number)) else { continue };
            let offset = layout.shader_column(*aov);
            outputs.extend(material.outputs.iter().filter(|output| output.name == *name).map(|output| match kind {
                ShaderValue::Color => WantedOutput { offset, width: 3, value: output.color, range: None },
                ShaderValue::Number => WantedOutput { offset, width: 1, value: output.value, range: None },
            }));
        }
        if !outputs.is_empty() {
            let wanted = Wanted { outputs, uv: material.uv, ..Wanted::default() };
            let program = Program::new(&material.code, &wanted);
            material.surfaces.clone().for_each(|surface| programs[surface] = Some(program.clone()));
        }
    }
    ShaderPasses { programs: programs.into(), columns }
}
