//! Operations on what is known while a graph is made, as the engine computes them.

use gonio::colour::luminance_of_pixel;
use gonio::scene::Operation;

/// The value of an operation on constants; `None` for operations that need a hit or a table.
pub(in crate::material) fn fold(operation: &Operation, [a, b, c, d]: &[[f32; 4]; 4]) -> Option<[f32; 4]> {
    let dot = |a: &[f32; 4], b: &[f32; 4]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    Some(match operation {
        Operation::Combine => [a[0], b[0], c[0], d[0]],
        Operation::Dot => [dot(a, b); 4],
        Operation::Luminance => [luminance_of_pixel([a[0], a[1], a[2]]); 4],
        Operation::Cross => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0],
        Operation::Normalize => {
            let length = dot(a, a).sqrt();
            let scale = if length > 0.0 { length.recip() } else { 0.0 };
            [a[0] * scale, a[1] * scale, a[2] * scale, 0.0]
        }
        Operation::RgbToHsv => to_hsv(*a),
        Operation::HsvToRgb => to_rgb(*a),
        _ => {
            let one = fold_component(operation)?;
            std::array::from_fn(|i| one(a[i], b[i], c[i]))
        }
    })
}

/// Hue in turns, saturation and value.
fn to_hsv([r, g, b, alpha]: [f32; 4]) -> [f32; 4] {
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let spread = most - least;
    if spread == 0.0 {
        return [0.0, 0.0, most, alpha];
    }
    let sixths = match most {
        most if most == r => (g - b) / spread,
        most if most == g => (b - r) / spread + 2.0,
        _ => (r - g) / spread + 4.0,
    };
    let hue = sixths / 6.0;
    [hue - hue.floor(), if most == 0.0 { 0.0 } else { spread / most }, most, alpha]
}

/// The inverse of [`to_hsv`].
fn to_rgb([hue, saturation, value, alpha]: [f32; 4]) -> [f32; 4] {
    let part = |offset: f32| {
        let turned = hue + offset;
        let pure = (((turned - turned.floor()) * 6.0 - 3.0).abs() - 1.0).clamp(0.0, 1.0);
        ((pure - 1.0) * saturation + 1.0) * value
    };
    [part(0.0), part(2.0 / 3.0), part(1.0 / 3.0), alpha]
}

/// One component of an operation that treats each alike.
fn fold_component(operation: &Operation) -> Option<fn(f32, f32, f32) -> f32> {
    Some(match operation {
        Operation::Add => |a, b, _| a + b,
        Operation::Subtract => |a, b, _| a - b,
        Operation::Multiply => |a, b, _| a * b,
        Operation::Divide => |a, b, _| if b == 0.0 { 0.0 } else { a / b },
        Operation::Mix => |a, b, t| a * (1.0 - t) + b * t,
        Operation::Power => |a, b, _| match a {
            a if a > 0.0 => a.powf(b),
            a if a == 0.0 && b == 0.0 => 1.0,
            _ => 0.0,
        },
        Operation::Invert => |a, amount, _| amount - a,
        Operation::Clamp => |a, low, high| a.max(low).min(high),
        Operation::Minimum => |a, b, _| a.min(b),
        Operation::Maximum => |a, b, _| a.max(b),
        Operation::Absolute => |a, _, _| a.abs(),
        Operation::Sign => |a, _, _| if a == 0.0 { 0.0 } else { a.signum() },
        Operation::Floor => |a, _, _| a.floor(),
        Operation::SquareRoot => |a, _, _| a.max(0.0).sqrt(),
        Operation::Exponential => |a, _, _| a.min(88.0).exp(),
        Operation::Logarithm => |a, _, _| if a > 0.0 { a.ln() } else { 0.0 },
        Operation::Sine => |a, _, _| a.sin(),
        Operation::Cosine => |a, _, _| a.cos(),
        Operation::ArcSine => |a, _, _| a.clamp(-1.0, 1.0).asin(),
        Operation::ArcCosine => |a, _, _| a.clamp(-1.0, 1.0).acos(),
        Operation::ArcTangent2 => |a, b, _| a.atan2(b),
        Operation::Less => |a, b, _| f32::from(u8::from(a < b)),
        _ => return None,
    })
}
