//! A program: the steps that its outputs need, with columns that are used again after their last reader.

use crate::{
    Code, Kernel, Operand,
    columns::{Io, MOST_OUTPUTS},
    table::run,
};
use gonio_simd::{Column, F, Lanes, PADDING};

/// Hits that run through a program together.
pub const CHUNK: usize = 256;
/// Programs with more columns than this run over shorter pieces, so that these stay in the first-level cache.
const COLUMNS_IN_CACHE: usize = 16;
/// The shortest piece.
const LEAST_PIECE: usize = 64;

/// Where a step reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A constant.
    Constant(f32),
    /// A column.
    Column(u16),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Slot {
    /// Number of the constant.
    Constant(u16),
    Column(u16),
}

/// A step with columns in the place of variables.
#[derive(Clone, Debug, PartialEq)]
struct PlacedStep<X> {
    kernel: Kernel<X>,
    inputs: Box<[Slot]>,
    outputs: Box<[u16]>,
}

/// Steps that can be run.
#[derive(Clone, Debug, PartialEq)]
pub struct Program<X> {
    steps: Vec<PlacedStep<X>>,
    constants: Vec<[f32; PADDING]>,
    columns: usize,
}

impl<X> Default for Program<X> {
    fn default() -> Self {
        Self { steps: Vec::new(), constants: Vec::new(), columns: 0 }
    }
}

/// Columns of programs for a piece of hits.
#[derive(Clone, Debug, Default)]
pub struct Registers {
    columns: Vec<Column>,
}

impl Registers {
    /// A source's value at an entry of the piece.
    #[inline(always)]
    pub fn read<L: Lanes>(&self, l: L, source: Source, at: usize) -> F<L> {
        match source {
            Source::Constant(value) => l.f(value),
            Source::Column(column) => l.load(&self.columns[usize::from(column)], at),
        }
    }
    /// A single entry's value.
    pub fn entry(&self, source: Source, at: usize) -> f32 {
        match source {
            Source::Constant(value) => value,
            Source::Column(column) => self.columns[usize::from(column)][at],
        }
    }
}

/// Which columns are free while steps are placed.
#[derive(Default)]
struct Columns {
    free: Vec<u16>,
    count: u16,
}

impl Columns {
    fn take(&mut self) -> u16 {
        self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        })
    }
}

impl<X: Clone> Program<X> {
    /// The steps of `code` that the wanted operands need, and where these are found.
    pub fn new(code: &Code<X>, wanted: &[Operand]) -> (Self, Vec<Source>) {
        // Number of the last step that reads a variable; what is wanted is read after all of them.
        let mut last_reader = vec![None; code.variables as usize];
        let mark = |operand: &Operand, reader: usize, last_reader: &mut Vec<Option<usize>>| {
            if let Operand::Variable(number) = operand {
                let last = &mut last_reader[*number as usize];
                *last = Some(last.map_or(reader, |known: usize| known.max(reader)));
            }
        };
        wanted.iter().for_each(|operand| mark(operand, usize::MAX, &mut last_reader));
        let mut is_needed = vec![false; code.steps.len()];
        for (number, step) in code.steps.iter().enumerate().rev() {
            let given = step.first as usize..step.first as usize + step.outputs;
            is_needed[number] = last_reader[given].iter().any(Option::is_some);
            if is_needed[number] {
                step.inputs.iter().for_each(|operand| mark(operand, number, &mut last_reader));
            }
        }
        let mut program = Self::default();
        let mut columns = Columns::default();
        let mut places = vec![0_u16; code.variables as usize];
        for (number, step) in code.steps.iter().enumerate().filter(|(number, _)| is_needed[*number]) {
            let inputs = step.inputs.iter().map(|operand| program.slot(*operand, &places)).collect();
            // A kernel never writes a column that it reads: its inputs are given back after its outputs were taken.
            let outputs: Box<[u16]> = (0..step.outputs).map(|_| columns.take()).collect();
            let mut read: Vec<u32> = step.inputs.iter().filter_map(|operand| variable(*operand)).collect();
            read.sort_unstable();
            read.dedup();
            let done = read.into_iter().filter(|variable| last_reader[*variable as usize] == Some(number));
            columns.free.extend(done.map(|variable| places[variable as usize]));
            for (offset, column) in outputs.iter().enumerate() {
                let variable = step.first as usize + offset;
                places[variable] = *column;
                if last_reader[variable].is_none() {
                    columns.free.push(*column);
                }
            }
            program.steps.push(PlacedStep { kernel: step.kernel.clone(), inputs, outputs });
        }
        program.columns = usize::from(columns.count);
        let found = wanted.iter().map(|operand| match *operand {
            Operand::Constant(value) => Source::Constant(value),
            Operand::Variable(number) => Source::Column(places[number as usize]),
        });
        (program, found.collect())
    }

    fn slot(&mut self, operand: Operand, places: &[u16]) -> Slot {
        match operand {
            Operand::Variable(number) => Slot::Column(places[number as usize]),
            Operand::Constant(value) => {
                let known = self.constants.iter().position(|constant| constant[0].to_bits() == value.to_bits());
                Slot::Constant(known.unwrap_or_else(|| {
                    self.constants.push([value; PADDING]);
                    self.constants.len() - 1
                }) as u16)
            }
        }
    }
}

fn variable(operand: Operand) -> Option<u32> {
    match operand {
        Operand::Constant(_) => None,
        Operand::Variable(number) => Some(number),
    }
}

impl<X> Program<X> {
    /// The kernels in order.
    pub fn kernels(&self) -> impl Iterator<Item = &Kernel<X>> {
        self.steps.iter().map(|step| &step.kernel)
    }

    /// How many hits run together: fewer where the program has many columns.
    pub fn piece(&self) -> usize {
        let times_too_many = self.columns.div_ceil(COLUMNS_IN_CACHE).max(1);
        (CHUNK / times_too_many.next_power_of_two()).max(LEAST_PIECE)
    }

    /// Runs all steps for `count` entries, at most [`CHUNK`]; `hit` computes those of the host.
    #[inline(always)]
    pub fn run<L: Lanes>(&self, l: L, count: usize, registers: &mut Registers, mut hit: impl FnMut(&X, &mut Io<'_>)) {
        while registers.columns.len() < self.columns {
            registers.columns.push(Column::new(CHUNK));
        }
        for step in &self.steps {
            let mut outputs: [Column; MOST_OUTPUTS] = Default::default();
            for (column, place) in outputs.iter_mut().zip(&step.outputs) {
                *column = std::mem::take(&mut registers.columns[usize::from(*place)]);
            }
            let mut io = Io::new(count, &mut outputs[..step.outputs.len()]);
            for slot in &step.inputs {
                match *slot {
                    Slot::Constant(number) => io.push_constant(&self.constants[usize::from(number)]),
                    Slot::Column(number) => io.push_column(&registers.columns[usize::from(number)]),
                }
            }
            match &step.kernel {
                Kernel::Operation(operation) => run(l, operation, &mut io),
                Kernel::Curve(curve) => curve.run(l, &mut io),
                Kernel::Hit(step) => hit(step, &mut io),
            }
            for (column, place) in outputs.iter_mut().zip(&step.outputs) {
                registers.columns[usize::from(*place)] = std::mem::take(column);
            }
        }
    }
}
