//! Outlines on a plane: corners in their order, the last joined to the first.

/// Whether a point lies within an outline, by the even-odd rule.
pub(crate) fn is_inside(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for (a, b) in edges(outline) {
        if (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
            inside = !inside;
        }
    }
    inside
}

/// The distance to the nearest edge.
pub(crate) fn edge_distance(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let to_edge = |(a, b): ([f64; 2], [f64; 2])| {
        let way = [b[0] - a[0], b[1] - a[1]];
        let length = way[0] * way[0] + way[1] * way[1];
        let t = if length > 0.0 { (((x - a[0]) * way[0] + (y - a[1]) * way[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
        (x - a[0] - t * way[0]).hypot(y - a[1] - t * way[1])
    };
    edges(outline).map(to_edge).fold(f64::MAX, f64::min)
}

/// From each corner to the next.
pub(crate) fn edges(outline: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
}

/// The least and the greatest of each coordinate.
pub(crate) fn extent(outline: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let empty = [[f64::MAX; 2], [f64::MIN; 2]];
    outline.iter().fold(empty, |[low, high], at| [[0, 1].map(|k| low[k].min(at[k])), [0, 1].map(|k| high[k].max(at[k]))])
}
