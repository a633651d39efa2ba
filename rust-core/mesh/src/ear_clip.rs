//! Ear clipping of one simple polygon in the plane (Meisters 1975), with the reflex vertices sorted along x.

type Point = [f64; 2];

/// Containment tests after which the rest of a polygon is cut as a fan: per vertex for small polygons and at most, so that
/// hostile outlines take a fraction of a second and not quadratic time.
const TESTS_PER_VERTEX: usize = 4096;
const MAX_TESTS: usize = 1 << 24;

/// Appends `polygon.len() - 2` triangles of places in `polygon`, which runs counter-clockwise. Polygons that cross
/// themselves give triangles that cover all vertices, nothing better.
pub(crate) fn ear_clip(polygon: &[Point], triangles: &mut Vec<[u32; 3]>) {
    if polygon.len() < 3 {
        return;
    }
    let mut clipper = Clipper::new(polygon);
    let mut vertex = 0;
    let mut left = polygon.len();
    let mut without_ear = 0;
    while left > 3 && clipper.tests_left > 0 {
        let (previous, next) = (clipper.previous[vertex], clipper.next[vertex]);
        // A whole round without an ear means a degenerate or crossing outline: any vertex is as good.
        if without_ear > left || clipper.is_ear(vertex) {
            triangles.push([previous as u32, vertex as u32, next as u32]);
            clipper.remove(vertex);
            left -= 1;
            without_ear = 0;
            // Skipping one vertex halves the outline in each round and keeps the triangles from becoming a fan.
            vertex = clipper.next[next];
        } else {
            without_ear += 1;
            vertex = next;
        }
    }
    clipper.fan_rest(vertex, left, triangles);
}

/// Whether all turns of a counter-clockwise polygon are to the left.
pub(crate) fn is_convex(polygon: &[Point]) -> bool {
    let count = polygon.len();
    (0..count).all(|i| turn(polygon[(i + count - 1) % count], polygon[i], polygon[(i + 1) % count]) >= 0.0)
}

/// Twice the signed area of a triangle: positive for a turn to the left.
pub(crate) fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

struct Clipper<'a> {
    polygon: &'a [Point],
    previous: Vec<usize>,
    next: Vec<usize>,
    is_reflex: Vec<bool>,
    /// Reflex vertices by x; entries that stopped being reflex stay until the next rebuild.
    by_x: Vec<usize>,
    stale: usize,
    tests_left: usize,
}

impl<'a> Clipper<'a> {
    fn new(polygon: &'a [Point]) -> Self {
        let count = polygon.len();
        let previous: Vec<usize> = (0..count).map(|i| (i + count - 1) % count).collect();
        let next: Vec<usize> = (0..count).map(|i| (i + 1) % count).collect();
        let is_reflex: Vec<bool> = (0..count).map(|i| turn(polygon[previous[i]], polygon[i], polygon[next[i]]) <= 0.0).collect();
        let mut by_x: Vec<usize> = (0..count).filter(|&i| is_reflex[i]).collect();
        by_x.sort_unstable_by(|&a, &b| polygon[a][0].total_cmp(&polygon[b][0]).then(a.cmp(&b)));
        Self { polygon, previous, next, is_reflex, by_x, stale: 0, tests_left: count.saturating_mul(TESTS_PER_VERTEX).min(MAX_TESTS) }
    }

    fn is_ear(&mut self, vertex: usize) -> bool {
        // A visit costs as a test does, or outlines with few convex vertices would take quadratic time.
        self.tests_left = self.tests_left.saturating_sub(1);
        if self.is_reflex[vertex] {
            return false;
        }
        let (a, b, c) = (self.polygon[self.previous[vertex]], self.polygon[vertex], self.polygon[self.next[vertex]]);
        let low = a[0].min(b[0]).min(c[0]);
        let high = a[0].max(b[0]).max(c[0]);
        let start = self.by_x.partition_point(|&i| self.polygon[i][0] < low);
        let mut tests = 0;
        let mut blocked = false;
        for &i in &self.by_x[start..] {
            let point = self.polygon[i];
            if point[0] > high {
                break;
            }
            tests += 1;
            // Outlines that touch themselves repeat a corner of the ear; that is no obstacle.
            if self.is_reflex[i] && point != a && point != b && point != c && contains(a, b, c, point) {
                blocked = true;
                break;
            }
        }
        self.tests_left = self.tests_left.saturating_sub(tests);
        !blocked
    }

    fn remove(&mut self, vertex: usize) {
        let (previous, next) = (self.previous[vertex], self.next[vertex]);
        self.next[previous] = next;
        self.previous[next] = previous;
        self.retire(vertex);
        for neighbour in [previous, next] {
            let around = (self.polygon[self.previous[neighbour]], self.polygon[self.next[neighbour]]);
            if self.is_reflex[neighbour] && turn(around.0, self.polygon[neighbour], around.1) > 0.0 {
                self.retire(neighbour);
            }
        }
        if self.stale * 2 > self.by_x.len() {
            self.by_x.retain(|&i| self.is_reflex[i]);
            self.stale = 0;
        }
    }

    fn retire(&mut self, vertex: usize) {
        if std::mem::replace(&mut self.is_reflex[vertex], false) {
            self.stale += 1;
        }
    }

    fn fan_rest(&self, start: usize, left: usize, triangles: &mut Vec<[u32; 3]>) {
        let mut middle = self.next[start];
        for _ in 2..left {
            let end = self.next[middle];
            triangles.push([start as u32, middle as u32, end as u32]);
            middle = end;
        }
    }
}

fn contains(a: Point, b: Point, c: Point, point: Point) -> bool {
    turn(a, b, point) >= 0.0 && turn(b, c, point) >= 0.0 && turn(c, a, point) >= 0.0
}
