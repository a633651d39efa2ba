//! `xform`: how what a command reads is placed.

use gonio_scene::Transform;

/// Copies that one command makes at most.
const MOST_COPIES: usize = 100_000;

/// How objects are placed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placed {
    pub(super) transform: Transform,
    /// Of lengths.
    pub(super) scale: f64,
    pub(super) inverted: bool,
    /// What surfaces have in place of their own modifiers.
    pub(super) modifier: Option<String>,
    /// Files around this one.
    pub(super) depth: u32,
}

impl Default for Placed {
    fn default() -> Self {
        Self { transform: Transform::IDENTITY, scale: 1.0, inverted: false, modifier: None, depth: 0 }
    }
}

impl Placed {
    /// Whether outlines run the other way around.
    pub(super) fn is_turned_over(&self) -> bool {
        (self.transform.determinant() < 0.0) != self.inverted
    }

    /// What is placed so within this.
    pub(super) fn around(&self, inner: &Self) -> Self {
        Self {
            transform: self.transform.after(&inner.transform),
            scale: self.scale * inner.scale,
            inverted: self.inverted != inner.inverted,
            modifier: self.modifier.clone().or_else(|| inner.modifier.clone()),
            depth: self.depth + 1,
        }
    }
}

/// A part of a command line between `-a` and `-i`.
struct Part {
    /// How often, and whether each time makes a copy.
    count: usize,
    is_array: bool,
    transform: Transform,
    scale: f64,
}

/// The copies that an `xform` makes, and the files that it reads.
///
/// # Errors
/// An option that it does not have, or what is no number.
pub(super) fn parse(words: &[String]) -> Result<(Vec<Placed>, Vec<String>), String> {
    let part = |count, is_array| Part { count, is_array, transform: Transform::IDENTITY, scale: 1.0 };
    let (mut parts, mut base, mut at) = (vec![part(1, false)], Placed::default(), 0);
    while let Some(option) = words.get(at).filter(|word| word.starts_with('-') && word.len() > 1) {
        let number = |offset: usize| -> Result<f64, String> {
            let text = words.get(at + offset).ok_or_else(|| format!("xform {option}: the command ends, expected a number"))?;
            text.parse::<f64>()
                .ok()
                .filter(|x| x.is_finite())
                .ok_or_else(|| format!("xform {option}: '{text}' was found, expected a number"))
        };
        let last = parts.last_mut().ok_or("no part")?;
        let mut step = |transform: Transform, scale: f64| {
            last.transform = transform.after(&last.transform);
            last.scale *= scale;
        };
        at += match option.as_str() {
            "-t" => {
                step(Transform::translation([number(1)?, number(2)?, number(3)?]), 1.0);
                4
            }
            "-rx" | "-ry" | "-rz" => {
                step(turned(usize::from(option.as_bytes()[2] - b'x'), number(1)?), 1.0);
                2
            }
            "-s" => {
                let factor = number(1)?;
                if factor == 0.0 {
                    return Err("xform -s: a scale of 0".into());
                }
                step(Transform::scale(factor), factor.abs());
                2
            }
            "-mx" | "-my" | "-mz" => {
                let mut mirror = Transform::IDENTITY;
                let axis = usize::from(option.as_bytes()[2] - b'x');
                mirror.columns[axis][axis] = -1.0;
                step(mirror, 1.0);
                1
            }
            "-a" | "-i" => {
                let count = number(1)?;
                if !(count >= 0.0 && count <= MOST_COPIES as f64) {
                    return Err(format!("xform {option}: {count} was found, expected a number from 0 to {MOST_COPIES}"));
                }
                parts.push(part(count as usize, option == "-a"));
                2
            }
            "-m" => {
                base.modifier = Some(words.get(at + 1).ok_or("xform -m: the command ends, expected a modifier")?.clone());
                2
            }
            // A prefix to names changes no light.
            "-n" => 2,
            "-I" => {
                base.inverted = !base.inverted;
                1
            }
            "-e" | "-c" => 1,
            other => return Err(format!("xform has no option {other} here")),
        };
    }
    Ok((copies(&parts, &base)?, words.get(at..).unwrap_or_default().to_vec()))
}

fn turned(axis: usize, degrees: f64) -> Transform {
    let (s, c) = degrees.to_radians().sin_cos();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut transform = Transform::IDENTITY;
    transform.columns[u][u] = c;
    transform.columns[u][v] = s;
    transform.columns[v][u] = -s;
    transform.columns[v][v] = c;
    transform
}

fn copies(parts: &[Part], base: &Placed) -> Result<Vec<Placed>, String> {
    let mut copies = vec![base.clone()];
    for part in parts {
        let then =
            |copy: &Placed| Placed { transform: part.transform.after(&copy.transform), scale: copy.scale * part.scale, ..copy.clone() };
        if part.is_array {
            if copies.len().saturating_mul(part.count) > MOST_COPIES {
                return Err(format!("xform -a: more than {MOST_COPIES} copies"));
            }
            let mut row = copies;
            copies = Vec::with_capacity(row.len() * part.count);
            for _ in 0..part.count {
                copies.extend(row.iter().cloned());
                row = row.iter().map(then).collect();
            }
        } else {
            for _ in 0..part.count {
                copies = copies.iter().map(then).collect();
            }
        }
    }
    Ok(copies)
}
