//! Light under way: the same arithmetic as stored colour, choice of a component, and what waits in columns.

use gonio_simd::{Execution, F, Lanes, Rgb, Select, Spectrum, SpectrumColumns, SpectrumItems, Wavelengths, dispatch};

/// Colours with zeros, large, small and negative components, one in each lane.
#[inline(always)]
fn colour<L: Lanes>(l: L, seed: f32) -> Rgb<L> {
    let lane = l.iota().to_float() + seed;
    let wild = (lane * 7.3).sin_cos_turns().0;
    Rgb::new((lane * 1.7 - 3.0) * seed, wild.max(0.0), (wild * 20.0).exp())
}

#[inline(always)]
fn same<L: Lanes>(what: &str, light: Spectrum<L>, stored: Rgb<L>) {
    let light = light.to_rgb();
    for (light, stored) in [(light.r, stored.r), (light.g, stored.g), (light.b, stored.b)] {
        assert_eq!(bits(light), bits(stored), "{what}");
    }
}

#[inline(always)]
fn bits<L: Lanes>(x: F<L>) -> Vec<u32> {
    x.to_array()[..L::COUNT].iter().map(|x| x.to_bits()).collect()
}

#[inline(always)]
fn check_arithmetic<L: Lanes>(l: L) {
    let (a, b, s) = (colour(l, 0.37), colour(l, 2.9), l.iota().to_float() * 0.3 - 1.1);
    let (x, y, mask) = (Wavelengths::rgb(l).reflectance(a), Wavelengths::rgb(l).reflectance(b), s.gt(0.0));
    same("sum", x + y, Rgb::new(a.r + b.r, a.g + b.g, a.b + b.b));
    same("difference", x - y, Rgb::new(a.r - b.r, a.g - b.g, a.b - b.b));
    same("product", x * y, Rgb::new(a.r * b.r, a.g * b.g, a.b * b.b));
    same("quotient", x / y, Rgb::new(a.r / b.r, a.g / b.g, a.b / b.b));
    same("multiple", x * s, a * s);
    same("multiple by a number", x * 0.7, Rgb::new(a.r * 0.7, a.g * 0.7, a.b * 0.7));
    same("mul_add", x.mul_add(s, y), a.mul_add(s, b));
    same("lerp", x.lerp(y, s), a.lerp(b, s));
    same("select", Spectrum::select(mask, x, y), Rgb::select(mask, a, b));
    same("keep_if", x.keep_if(mask), a.keep_if(mask));
    same("clamp", x.clamp(-0.5, 0.25), Rgb::new(a.r.clamp(-0.5, 0.25), a.g.clamp(-0.5, 0.25), a.b.clamp(-0.5, 0.25)));
    same("pow", y.pow(s), Rgb::new(b.r.pow(s), b.g.pow(s), b.b.pow(s)));
    same("exp", x.exp(), Rgb::new(a.r.exp(), a.g.exp(), a.b.exp()));
    same("ln", x.max(1e-6).ln(), Rgb::new(a.r.max(1e-6).ln(), a.g.max(1e-6).ln(), a.b.max(1e-6).ln()));
    same("safe_sqrt", x.safe_sqrt(), Rgb::new(a.r.safe_sqrt(), a.g.safe_sqrt(), a.b.safe_sqrt()));
    let turned = x.map(
        #[inline(always)]
        |x| -x,
    );
    same("map", turned, Rgb::new(-a.r, -a.g, -a.b));
    let [sum, least] = x.zip(
        y,
        #[inline(always)]
        |x, y| [x + y, x.min(y)],
    );
    same("zip", sum, Rgb::new(a.r + b.r, a.g + b.g, a.b + b.b));
    same("second of zip", least, Rgb::new(a.r.min(b.r), a.g.min(b.g), a.b.min(b.b)));
    assert_eq!(bits(x.luminance()), bits(a.luminance()));
    assert_eq!(bits(x.mean()), bits((a.r + a.g + a.b) * (1.0 / 3.0)));
    assert_eq!(bits(x.max_component()), bits(a.r.max(a.g).max(a.b)));
    assert_eq!(bits(x.min_component()), bits(a.r.min(a.g).min(a.b)));
    assert_eq!(bits(x.dot(y)), bits(a.r.mul_add(b.r, a.g.mul_add(b.g, a.b * b.b))));
}

#[test]
fn light_is_computed_as_colour_is() {
    for execution in Execution::all() {
        dispatch!(execution, l => check_arithmetic(l));
    }
}

#[inline(always)]
fn check_choice<L: Lanes>(l: L) {
    let values = Wavelengths::rgb(l).reflectance(Rgb::splat(l, [10.0, 20.0, 30.0]));
    let chosen =
        |weights: [f32; 3], u: f32| Wavelengths::rgb(l).reflectance(Rgb::splat(l, weights)).shares().choose(l.f(u), values).to_array()[0];
    assert_eq!([0.0, 0.24, 0.26, 0.74, 0.76, 0.999].map(|u| chosen([1.0, 2.0, 1.0], u)), [10.0, 10.0, 20.0, 20.0, 30.0, 30.0]);
    // Beyond the rounded sum stands the last component that has any probability.
    assert_eq!([[2.0, 0.0, 0.0], [1.0, 3.0, 0.0], [0.0, 0.0, 5.0]].map(|weights| chosen(weights, 1.0)), [10.0, 20.0, 30.0]);
    // No light at all: all components alike.
    assert_eq!([0.1, 0.5, 0.9].map(|u| chosen([0.0; 3], u)), [10.0, 20.0, 30.0]);
    assert_eq!(bits(Spectrum::constant(l.f(0.3)).constant_value()), bits(l.f(0.3)));
    assert!(!Spectrum::zero(l).is_lit().any() && Spectrum::one(l).is_lit().all());
    // What takes light away is light too, and its parts have its sign.
    let spectrum = |x: [f32; 3]| Wavelengths::rgb(l).reflectance(Rgb::splat(l, x));
    let taken = spectrum([0.0, -2.0, -1.0]);
    assert!(taken.is_lit().all() && bits(taken.abs().max_component()) == bits(l.f(2.0)));
    assert_eq!(bits((taken - spectrum([0.5, -0.5, -3.0])).part_of(taken).sum()), bits(l.f(-1.5)));
    assert_eq!(bits(spectrum([-1e-6, -1.0, 2.0]).left_of(spectrum([1.0, 1.0, 0.0])).sum()), bits(l.f(1.0)));
    assert_eq!(bits((spectrum([1.0, 2.0, 3.0]) - spectrum([2.0, 0.5, 0.0])).part_of(Spectrum::one(l)).sum()), bits(l.f(4.5)));
}

#[test]
fn a_component_is_chosen_by_its_share() {
    for execution in Execution::all() {
        dispatch!(execution, l => check_choice(l));
    }
}

#[inline(always)]
fn check_columns<L: Lanes>(l: L) {
    let (mut columns, mut items) = (SpectrumColumns::new(64), SpectrumItems::new(64));
    let (colour, number) = (colour(l, 0.6), l.iota().to_float() + 0.5);
    let light = Wavelengths::rgb(l).reflectance(colour);
    columns.store(light, 16);
    items.store(light, number, 16);
    same("columns", columns.load(l, 16), colour);
    let index = l.iota() + 16;
    same("gathered from columns", columns.gather(l, index), colour);
    let (found, with) = items.gather(l, index);
    same("items", found, colour);
    assert_eq!(bits(with), bits(number));
    // Every other lane, behind the first 3.
    let odd = (l.iota() & 1).eq(0);
    columns.append(light, odd, 3);
    items.append(light, number, odd, 3);
    for lane in (0..L::COUNT).step_by(2) {
        let place = l.u(3 + lane as u32 / 2);
        let expected = [colour.r, colour.g, colour.b].map(|x| x.to_array()[lane]);
        same("appended to columns", columns.gather(l, place), Rgb::splat(l, expected));
        same("appended to items", items.gather(l, place).0, Rgb::splat(l, expected));
        assert_eq!(items.gather(l, place).1.to_array()[0], number.to_array()[lane]);
    }
    columns.multiply(3, &columns.clone(), 3);
    let squared = colour.r.to_array()[0] * colour.r.to_array()[0];
    assert_eq!(columns.columns()[0][3], squared);
    columns.copy(3, 40);
    items.copy(3, 40);
    assert_eq!(columns.columns()[0][40], squared);
    let [r, g, b] = [0, 1, 2].map(|c| columns.columns()[c][40]);
    assert_eq!(columns.magnitude_of(40), r.abs() + g.abs() + b.abs());
    assert_eq!(items.gather(l, l.u(40)).1.to_array()[0], 0.5);
    // One lane alone, to a place of its own: its spectrum is multiplied, its number is not.
    items.scatter(light, number, &[50]);
    items.multiply(light, &[50]);
    let (twice, once) = items.gather(l, l.u(50));
    assert_eq!((twice.to_rgb().r.to_array()[0], once.to_array()[0]), (squared, number.to_array()[0]));
    columns.clear();
    assert!(!columns.load(l, 40 / L::COUNT * L::COUNT).is_lit().any());
}

#[test]
fn light_waits_in_columns_and_items() {
    for execution in Execution::all() {
        dispatch!(execution, l => check_columns(l));
    }
}
