//! Compiled materials: closures, mixes of closures, and the shading programs that compute their parameters.

use crate::graph::{OutputColumns, Program};
use crate::tables::media::MediumTable;
use crate::tables::shader_passes::ShaderOutputs;
use crate::words::counts;
use gonio_bsdf::Surface;
use gonio_bsdf::{ParameterValues, parameter::COUNT};
use gonio_simd::{F, Lanes, Rgb, Spectrum, WavelengthColumn, Wavelengths};

/// One compiled closure: a BSDF whose parameters are constants or outputs of a shading program.
#[derive(Clone, Debug)]
pub struct SurfaceMaterial {
    /// Constants, model and lobes.
    pub surface: Surface,
    /// What computes the parameters that are not constant.
    pub program: Program,
    /// What bends the normal where subsurface walks come out, if anything does.
    pub exit: Option<Box<Program>>,
    /// Opacity below this is 0, else 1; 0 leaves it as it is.
    pub opacity_threshold: f32,
    /// Whether it may let paths go straight on.
    pub transparent: bool,
    /// Whether shadow rays may pass it, too.
    pub lets_light_pass: bool,
    /// Whether it may emit.
    pub emissive: bool,
    /// What it emits for light sampling, if that is the same everywhere.
    pub even_emission: Option<[f32; 3]>,
    /// What computes the parameters of its emission for light sampling, if that differs.
    pub textured_emission: Option<Box<Program>>,
    /// Whether it is one closure of several and does nothing but emit: its light is added at each hit, whichever closure paths go on with.
    pub emits_apart: bool,
    /// What fills the closed mesh, a row of [`MaterialTable::media`], if anything does.
    pub interior: Option<u32>,
    /// What the solid under it is, a row of the same table, where that scatters; else it absorbs as the parameters say.
    pub solid_medium: Option<u32>,
    /// Whether the shading frame's tangent matters.
    pub anisotropic: bool,
    /// Whether it does nothing but bound what fills the mesh.
    pub bounds_alone: bool,
    /// Whether it cuts a hole into the coverage.
    pub holdout: bool,
    /// What the material index pass shows.
    pub pass_index: u32,
    /// Value of its name in cryptomattes.
    pub matte_id: u32,
}

impl SurfaceMaterial {
    /// What a way straight through it counts.
    pub(crate) fn way_straight(&self) -> u32 {
        if self.bounds_alone { 0 } else { counts::STRAIGHT }
    }
    /// What it emits for light sampling where that is the same everywhere, in every lane.
    #[inline(always)]
    pub(crate) fn even_radiance<L: Lanes>(&self, l: L, wavelengths: Wavelengths<'_, L>) -> Spectrum<L> {
        let [r, g, b] = self.even_emission.unwrap_or_default().map(|x| l.f(x));
        wavelengths.lamp(l.u(self.surface.spectrum), Rgb::new(r, g, b))
    }
}

/// A material that is a weighted sum of closures: each hit takes one of them at random, by its weight; trees of rays shade all.
#[derive(Clone, Debug)]
pub struct Mix {
    /// Number of the first closure among the surfaces.
    pub first: u32,
    /// Closures.
    pub count: usize,
    /// What computes the weights: output `i` is the weight of closure `i`, a colour.
    pub program: Program,
    /// Whether shadow rays may pass any closure.
    pub lets_light_pass: bool,
    /// Whether any closure may emit.
    pub emissive: bool,
    /// What all closures emit together for light sampling, where that is the same everywhere.
    pub even_emission: Option<[f32; 3]>,
    /// Whether any closure emits apart.
    pub emits_apart: bool,
    /// What computes the weights for light sampling, as `program` does, if what is emitted differs.
    pub textured_emission: Option<Box<Program>>,
}

/// What a material number of the geometry stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// A surface by its number.
    Surface(u32),
    /// A mix by its number.
    Mix(u32),
}

/// All materials.
#[derive(Clone, Debug, Default)]
pub struct MaterialTable {
    /// Closures of all materials.
    pub surfaces: Vec<SurfaceMaterial>,
    /// Sums of closures.
    pub mixes: Vec<Mix>,
    /// The scene's materials in their order, then the default one.
    pub numbers: Vec<Shading>,
    /// Of the materials that have any, what they show in passes of their own.
    pub shader_outputs: Vec<ShaderOutputs>,
    /// What fills meshes.
    pub media: MediumTable,
    /// Whether any surface has an exit program.
    pub any_exit: bool,
}

impl MaterialTable {
    /// Whether no light comes through a material, by the geometry's number.
    pub fn is_opaque(&self, number: u32) -> bool {
        let passes = |material: &SurfaceMaterial| {
            let lobes = &material.surface.lobes;
            material.transparent || lobes.transmission || lobes.portal
        };
        !self.closures(number).iter().any(passes)
    }

    /// The number that the geometry keeps for a material: mixes stand behind the surfaces.
    pub fn number(&self, material: usize) -> u32 {
        match self.numbers[material] {
            Shading::Surface(surface) => surface,
            Shading::Mix(mix) => self.surfaces.len() as u32 + mix,
        }
    }
    /// What a number of the geometry stands for.
    #[inline]
    pub fn shading(&self, number: u32) -> Shading {
        match number.checked_sub(self.surfaces.len() as u32) {
            None => Shading::Surface(number),
            Some(mix) => Shading::Mix(mix),
        }
    }
    /// What fills meshes of a material of the geometry, a row of [`Self::media`].
    pub fn interior(&self, number: u32) -> Option<u32> {
        let surface = match self.shading(number) {
            Shading::Surface(surface) => surface,
            Shading::Mix(mix) => self.mixes[mix as usize].first,
        };
        self.surfaces.get(surface as usize)?.interior
    }
    /// The closures of a material of the geometry.
    fn closures(&self, number: u32) -> &[SurfaceMaterial] {
        match self.shading(number) {
            Shading::Surface(surface) => &self.surfaces[surface as usize..=surface as usize],
            Shading::Mix(mix) => {
                let Mix { first, count, .. } = self.mixes[mix as usize];
                &self.surfaces[first as usize..first as usize + count]
            }
        }
    }
    /// The rows of the media that a material of the geometry fills meshes with.
    pub fn media_of(&self, number: u32) -> impl Iterator<Item = u32> {
        self.closures(number).iter().flat_map(|closure| [closure.interior, closure.solid_medium]).flatten()
    }
    /// Whether what a material of the geometry covers is a solid, whose surface bends what goes in.
    pub fn is_solid(&self, number: u32) -> bool {
        self.closures(number).iter().any(|closure| closure.surface.is_solid())
    }
    /// Whether what a material of the geometry covers is a solid that is looked through: its surface is smooth, and it does not scatter.
    pub fn is_clear_solid(&self, number: u32) -> bool {
        let is_clear =
            |closure: &SurfaceMaterial| closure.surface.is_solid() && closure.surface.lobes.smooth && closure.solid_medium.is_none();
        self.closures(number).iter().any(is_clear)
    }
    /// The number of the spectrum of what a material of the geometry sends, counted from 1; 0 is none. Its closures have one.
    pub fn spectrum(&self, number: u32) -> u32 {
        self.closures(number).first().map_or(0, |closure| closure.surface.spectrum)
    }
    /// The row of the solid that a material of the geometry covers, 0 where it does not scatter; of a mix that of its first closure with one.
    pub fn solid_medium(&self, number: u32) -> u32 {
        self.closures(number).iter().find_map(|closure| closure.solid_medium).unwrap_or(0)
    }
    /// What bends the normal where walks come out of a material of the geometry; of a mix that of its first closure with one.
    pub fn exit(&self, number: u32) -> Option<&Program> {
        self.closures(number).iter().find_map(|surface| surface.exit.as_deref())
    }
    /// Whether shadow rays may pass a material of the geometry.
    pub fn lets_light_pass(&self, number: u32) -> bool {
        match self.shading(number) {
            Shading::Surface(surface) => self.surfaces[surface as usize].lets_light_pass,
            Shading::Mix(mix) => self.mixes[mix as usize].lets_light_pass,
        }
    }
    /// Whether light comes through a material of the geometry, bent or scattered.
    pub fn lets_light_through(&self, number: u32) -> bool {
        self.closures(number).iter().any(|closure| closure.surface.lets_light_through())
    }
    /// Whether a material of the geometry does nothing but bound what fills its mesh.
    pub(crate) fn bounds_alone(&self, number: u32) -> bool {
        matches!(self.shading(number), Shading::Surface(surface) if self.surfaces[surface as usize].bounds_alone)
    }
    /// Whether light sampling runs programs to know what a material of the geometry emits.
    pub fn emits_by_program(&self, number: u32) -> bool {
        match self.shading(number) {
            Shading::Surface(surface) => self.surfaces[surface as usize].textured_emission.is_some(),
            Shading::Mix(mix) => self.mixes[mix as usize].textured_emission.is_some(),
        }
    }
    /// Whether light sampling knows of what a material of the geometry emits.
    pub fn is_sampled(&self, number: u32) -> bool {
        self.emits_by_program(number) || self.even_emission(number).is_some()
    }
    /// Whether a material emits, and light sampling does not know what.
    pub fn emits_unknown(&self, material: usize) -> bool {
        let number = self.number(material);
        let (emissive, even) = self.emission(number);
        emissive && even.is_none() && !self.emits_by_program(number)
    }
    /// Whether a material of the geometry may emit.
    pub fn emits(&self, number: u32) -> bool {
        self.emission(number).0
    }
    /// What a material of the geometry emits everywhere alike, if it does so at all.
    pub fn even_emission(&self, number: u32) -> Option<[f32; 3]> {
        let (emissive, even) = self.emission(number);
        even.filter(|emission| emissive && emission.iter().any(|x| *x != 0.0))
    }
    /// Whether a material of the geometry may emit, and what for light sampling, where that is the same everywhere.
    fn emission(&self, number: u32) -> (bool, Option<[f32; 3]>) {
        match self.shading(number) {
            Shading::Surface(surface) => {
                let material = &self.surfaces[surface as usize];
                (material.emissive, material.even_emission)
            }
            Shading::Mix(mix) => {
                let mix = &self.mixes[mix as usize];
                (mix.emissive, mix.even_emission)
            }
        }
    }
}

/// What a chunk's program computed, and the wavelengths of its hits.
pub(crate) type ChunkOutputs<'a> = (&'a OutputColumns, WavelengthColumn<'a>);

/// The parameters of a chunk: constants, and the columns its program computed.
pub(crate) fn parameter_values<'a>(material: &'a SurfaceMaterial, columns: ChunkOutputs<'a>) -> ParameterValues<'a> {
    values_by(&material.surface, &material.program, columns)
}

/// The same by another program of the surface.
pub(crate) fn values_by<'a>(surface: &'a Surface, program: &Program, (outputs, wavelengths): ChunkOutputs<'a>) -> ParameterValues<'a> {
    let mut values = ParameterValues { wavelengths, ..ParameterValues::constant(&surface.constants) };
    fill_columns(program, outputs, &mut values.columns);
    values
}

fn fill_columns<'a>(program: &Program, outputs: &'a OutputColumns, columns: &mut [Option<&'a [f32]>; COUNT]) {
    let mut place = 0;
    for output in &program.outputs {
        for i in 0..output.sources.len() {
            columns[output.offset + i] = Some(outputs.column(place));
            place += 1;
        }
    }
}

/// Opacity after the cut-out threshold.
#[inline(always)]
pub(crate) fn threshold<L: Lanes>(opacity: F<L>, threshold: f32) -> F<L> {
    let l = opacity.lanes();
    if threshold > 0.0 { opacity.ge(threshold).select(l.f(1.0), l.f(0.0)) } else { opacity }
}
