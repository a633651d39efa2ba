//! Bytes of sRGB multiplied by their alpha, before they are filtered.

use super::image::{Image, Texels};
use crate::colour::{Product, Transfer};
use rayon::prelude::*;

/// An image of bytes whose colours are multiplied by alpha; others, and those without alpha, as they are.
pub(crate) fn times_alpha(image: &Image, product: Product) -> Image {
    let (channels, mut image) = (image.channels as usize, image.clone());
    if let (2 | 4, Texels::Byte(values)) = (channels, &mut image.texels) {
        let table = table(product);
        values.par_chunks_exact_mut(channels).for_each(|texel| {
            if let [colour @ .., alpha] = texel {
                colour.iter_mut().for_each(|code| *code = table[usize::from(*alpha) << 8 | usize::from(*code)]);
            }
        });
    }
    image
}

/// The product of every alpha with every code.
fn table(product: Product) -> Vec<u8> {
    let light = Transfer::Srgb.table();
    let entry = |alpha: usize, code: usize| match product {
        Product::Codes => (alpha * code / 255) as u8,
        Product::Light => (Transfer::Srgb.encode(f64::from(light[code]) * alpha as f64 / 255.0) * 255.0).round() as u8,
    };
    (0..1 << 16).map(|at| entry(at >> 8, at & 255)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::Stated;

    #[test]
    fn colours_are_multiplied_and_alpha_stays() {
        let bytes = vec![200, 100, 0, 255, 200, 100, 7, 128, 200, 100, 50, 0];
        let image = Image { width: 3, height: 1, channels: 4, texels: Texels::Byte(bytes), stated: Stated::Nothing };
        for (product, half) in [(Product::Codes, [100, 50, 3]), (Product::Light, [147, 72, 4])] {
            let Texels::Byte(found) = times_alpha(&image, product).texels else { panic!("other texels") };
            assert_eq!(found, [&[200, 100, 0, 255][..], &half, &[128, 0, 0, 0, 0]].concat());
        }
    }
}
