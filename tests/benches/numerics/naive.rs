//! Crossings as textbooks have them: the quadratic formula and Ferrari's with the origin where it is, planes
//! and slabs without bounds; the same code in `f32` and in `f64`.

pub type V32 = [f32; 3];
pub type V64 = [f64; 3];

macro_rules! naive {
    ($name:ident, $real:ident, $vector:ty) => {
        pub mod $name {
            pub fn dot(a: $vector, b: $vector) -> $real {
                a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
            }

            fn minus(a: $vector, b: $vector) -> $vector {
                [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
            }

            pub fn quadratic(a: $real, b: $real, c: $real) -> Option<($real, $real)> {
                let discriminant = b * b - 4.0 * a * c;
                if discriminant <= 0.0 {
                    return None;
                }
                let root = discriminant.sqrt();
                Some(((-b - root) / (2.0 * a), (-b + root) / (2.0 * a)))
            }

            pub fn sphere(s: $vector, d: $vector, c: $vector, r: $real) -> Option<($real, $real)> {
                let f = minus(s, c);
                quadratic(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)
            }

            pub fn plane(s: $vector, d: $vector, n: $vector, distance: $real) -> Option<$real> {
                let speed = dot(n, d);
                if speed == 0.0 { None } else { Some((distance - dot(n, s)) / speed) }
            }

            pub fn slabs(
                s: $vector,
                d: $vector,
                c: $vector,
                normals: &[$vector; 3],
                half: $vector,
            ) -> Option<($real, $real)> {
                let (mut enter, mut leave) = ($real::NEG_INFINITY, $real::INFINITY);
                let f = minus(s, c);
                for (normal, half) in normals.iter().zip(half) {
                    let over = 1.0 / dot(*normal, d);
                    let place = dot(*normal, f);
                    let (one, other) = ((-half - place) * over, (half - place) * over);
                    enter = enter.max(one.min(other));
                    leave = leave.min(one.max(other));
                }
                if enter <= leave { Some((enter, leave)) } else { None }
            }

            /// `rows` map a point to the local space: three factors and an offset each.
            pub fn local(s: $vector, d: $vector, rows: &[[$real; 4]; 3]) -> ($vector, $vector) {
                let local = |v: $vector, w: $real| {
                    let map = |r: &[$real; 4]| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3] * w;
                    [map(&rows[0]), map(&rows[1]), map(&rows[2])]
                };
                (local(s, 1.0), local(d, 0.0))
            }

            pub fn ellipsoid(f: $vector, d: $vector) -> Option<($real, $real)> {
                quadratic(dot(d, d), 2.0 * dot(f, d), dot(f, f) - 1.0)
            }

            /// x² + y² ≤ 1, |z| ≤ 1.
            pub fn cylinder(f: $vector, d: $vector) -> Option<$real> {
                let flat = |v: $vector| [v[0], v[1], 0.0];
                let (e, g) = (flat(d), flat(f));
                let (enter, leave) = quadratic(dot(e, e), 2.0 * dot(g, e), dot(g, g) - 1.0)?;
                let (one, other) = ((-1.0 - f[2]) / d[2], (1.0 - f[2]) / d[2]);
                let (enter, leave) = (enter.max(one.min(other)), leave.min(one.max(other)));
                if enter <= leave { Some(enter) } else { None }
            }

            /// x² + y² ≤ (`cap` + (1 − `cap`)·(1 − z)/2)², |z| ≤ 1.
            pub fn cone(f: $vector, d: $vector, cap: $real) -> Option<$real> {
                let slope = 0.5 * (1.0 - cap);
                let (width, growth) = (cap + slope * (1.0 - f[2]), -slope * d[2]);
                let a = d[0] * d[0] + d[1] * d[1] - growth * growth;
                let b = 2.0 * (f[0] * d[0] + f[1] * d[1] - width * growth);
                let c = f[0] * f[0] + f[1] * f[1] - width * width;
                let mut first: Option<$real> = None;
                let mut see = |t: $real| first = Some(first.map_or(t, |first| first.min(t)));
                if let Some((one, other)) = quadratic(a, b, c) {
                    let is_on = |t: &$real| (f[2] + t * d[2]).abs() <= 1.0;
                    [one, other].into_iter().filter(is_on).for_each(&mut see);
                }
                for (z, radius) in [(-1.0, 1.0), (1.0, cap)] {
                    let t = (z - f[2]) / d[2];
                    let (x, y) = (f[0] + t * d[0], f[1] + t * d[1]);
                    if x * x + y * y <= radius * radius {
                        see(t);
                    }
                }
                first
            }

            /// The greatest real root of m³ + a·m² + b·m + c.
            fn cubic(a: $real, b: $real, c: $real) -> $real {
                let (p, q) = (b - a * a / 3.0, 2.0 * a * a * a / 27.0 - a * b / 3.0 + c);
                let discriminant = q * q / 4.0 + p * p * p / 27.0;
                let m = if discriminant >= 0.0 {
                    let root = discriminant.sqrt();
                    (root - q / 2.0).cbrt() + (-root - q / 2.0).cbrt()
                } else {
                    let angle = (1.5 * q / p * (-3.0 / p).sqrt()).clamp(-1.0, 1.0).acos();
                    2.0 * (-p / 3.0).sqrt() * (angle / 3.0).cos()
                };
                m - a / 3.0
            }

            /// The least real root, by Ferrari's resolvent; the coefficient of t⁴ comes first.
            pub fn quartic([e, a, b, c, d]: [$real; 5]) -> Option<$real> {
                let (a, b, c, d) = (a / e, b / e, c / e, d / e);
                let p = b - 3.0 * a * a / 8.0;
                let q = c - a * b / 2.0 + a * a * a / 8.0;
                let r = d - a * c / 4.0 + a * a * b / 16.0 - 3.0 * a * a * a * a / 256.0;
                let m = cubic(p, p * p / 4.0 - r, -q * q / 8.0);
                let s = (2.0 * m.max(0.0)).sqrt();
                let part = if s > 0.0 { q / (2.0 * s) } else { 0.0 };
                let one = quadratic(1.0, s, p / 2.0 + m - part);
                let other = quadratic(1.0, -s, p / 2.0 + m + part);
                let least = one.into_iter().chain(other).map(|(y, _)| y).reduce($real::min)?;
                Some(least - a / 4.0)
            }

            /// (√(x² + y²) − `major`)² + z² = `minor`².
            pub fn torus(f: $vector, d: $vector, major: $real, minor: $real) -> Option<$real> {
                let (dd, fd, ff) = (dot(d, d), dot(f, d), dot(f, f));
                let k = ff + major * major - minor * minor;
                let m = 4.0 * major * major;
                quartic([
                    dd * dd,
                    4.0 * dd * fd,
                    2.0 * dd * k + 4.0 * fd * fd - m * (d[0] * d[0] + d[1] * d[1]),
                    4.0 * k * fd - 2.0 * m * (f[0] * d[0] + f[1] * d[1]),
                    k * k - m * (f[0] * f[0] + f[1] * f[1]),
                ])
            }

            /// Σ `terms` of x², xy, xz, x, y², yz, y, z², z, 1.
            pub fn quadric(f: $vector, d: $vector, terms: &[f64; 10]) -> Option<($real, $real)> {
                let [xx, xy, xz, x, yy, yz, y, zz, z, one] = terms.map(|term| term as $real);
                let form = |a: $vector, b: $vector| {
                    xx * a[0] * b[0]
                        + yy * a[1] * b[1]
                        + zz * a[2] * b[2]
                        + 0.5 * xy * (a[0] * b[1] + a[1] * b[0])
                        + 0.5 * xz * (a[0] * b[2] + a[2] * b[0])
                        + 0.5 * yz * (a[1] * b[2] + a[2] * b[1])
                };
                let line = [x, y, z];
                quadratic(
                    form(d, d),
                    2.0 * form(f, d) + dot(line, d),
                    form(f, f) + dot(line, f) + one,
                )
            }

            fn cross(a: $vector, b: $vector) -> $vector {
                let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
                [part(1, 2), part(2, 0), part(0, 1)]
            }

            /// **Source:** T. Möller, B. Trumbore, "Fast, minimum storage ray-triangle intersection"
            /// (1997).
            pub fn triangle(f: $vector, d: $vector, corners: &[[f64; 3]; 3]) -> Option<$real> {
                let [a, b, c] = corners.map(|corner| corner.map(|x| x as $real));
                let (one, other) = (minus(b, a), minus(c, a));
                let across = cross(d, other);
                let over = 1.0 / dot(one, across);
                let start = minus(f, a);
                let u = dot(start, across) * over;
                let up = cross(start, one);
                let v = dot(d, up) * over;
                let is_in = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
                if is_in { Some(dot(other, up) * over) } else { None }
            }

            fn least(found: impl Iterator<Item = $real>) -> Option<$real> {
                found.filter(|t| t.is_finite()).reduce($real::min)
            }

            /// A flat figure in the plane z = 0.
            pub fn polygon(f: $vector, d: $vector, corners: &[[f64; 2]]) -> Option<$real> {
                let t = -f[2] / d[2];
                let (x, y) = (f[0] + t * d[0], f[1] + t * d[1]);
                let mut odd = false;
                for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                    let [ax, ay, bx, by] = [from[0], from[1], to[0], to[1]].map(|x| x as $real);
                    odd ^= (ay > y) != (by > y) && x < ax + (y - ay) * (bx - ax) / (by - ay);
                }
                if odd { Some(t) } else { None }
            }

            pub fn triangles(f: $vector, d: $vector, all: &[[[f64; 3]; 3]]) -> Option<$real> {
                least(all.iter().filter_map(|corners| triangle(f, d, corners)))
            }

            /// Between z = −1 and 1, curves of degree 2 around it.
            pub fn letter(f: $vector, d: $vector, pieces: &[[[f64; 2]; 3]]) -> Option<$real> {
                let powers = |points: &[[f64; 2]; 3], axis: usize| {
                    let [a, b, c] = points.map(|point| point[axis] as $real);
                    [a, 2.0 * (b - a), a - 2.0 * b + c]
                };
                let roots = |[c, b, a]: [$real; 3]| -> [Option<$real>; 2] {
                    let found = match quadratic(a, b, c) {
                        _ if a == 0.0 => [Some(-c / b), None],
                        Some((one, other)) => [Some(one), Some(other)],
                        None => [None, None],
                    };
                    found.map(|root| root.filter(|t| (0.0..1.0).contains(t)))
                };
                let at = |[c, b, a]: [$real; 3], t: $real| (a * t + b) * t + c;
                let mut found = Vec::new();
                for points in pieces {
                    let (x, y) = (powers(points, 0), powers(points, 1));
                    let side = [0, 1, 2].map(|i| {
                        let off = if i == 0 { (x[0] - f[0], y[0] - f[1]) } else { (x[i], y[i]) };
                        off.0 * d[1] - off.1 * d[0]
                    });
                    for t in roots(side).into_iter().flatten() {
                        let along = (at(x, t) - f[0]) * d[0] + (at(y, t) - f[1]) * d[1];
                        let s = along / (d[0] * d[0] + d[1] * d[1]);
                        if (f[2] + s * d[2]).abs() <= 1.0 {
                            found.push(s);
                        }
                    }
                }
                for end in [-1.0, 1.0] {
                    let s = (end - f[2]) / d[2];
                    let (px, py) = (f[0] + s * d[0], f[1] + s * d[1]);
                    let mut odd = false;
                    for points in pieces {
                        let (x, mut y) = (powers(points, 0), powers(points, 1));
                        y[0] -= py;
                        for t in roots(y).into_iter().flatten() {
                            odd ^= at(x, t) > px;
                        }
                    }
                    if odd {
                        found.push(s);
                    }
                }
                least(found.into_iter())
            }

            /// Newton's steps in u and v from nine places of a surface of degree 3.
            pub fn patch(f: $vector, d: $vector, net: &[[f64; 3]; 16]) -> Option<$real> {
                let away = if d[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
                let aside = cross(d, away);
                let across = cross(d, aside);
                let weights = |t: $real| {
                    let r = 1.0 - t;
                    let values = [r * r * r, 3.0 * r * r * t, 3.0 * r * t * t, t * t * t];
                    let slopes = [
                        -3.0 * r * r,
                        3.0 * r * (r - 2.0 * t),
                        3.0 * t * (2.0 * r - t),
                        3.0 * t * t,
                    ];
                    (values, slopes)
                };
                let mut found = Vec::new();
                for start in 0..9 {
                    let [mut u, mut v] = [start % 3, start / 3].map(|i| 0.25 * (1 + i) as $real);
                    let (mut step, mut point) = (1.0, f);
                    for _ in 0..8 {
                        let ((one, rise), (other, climb)) = (weights(u), weights(v));
                        let mut ways = [[0.0; 3]; 3];
                        for (i, corner) in net.iter().enumerate() {
                            let (a, b) = (i % 4, i / 4);
                            let shares = [one[a] * other[b], rise[a] * other[b], one[a] * climb[b]];
                            for (way, share) in ways.iter_mut().zip(shares) {
                                (0..3).for_each(|axis| way[axis] += share * corner[axis] as $real);
                            }
                        }
                        point = ways[0];
                        let off = minus(point, f);
                        let (p, q) = (dot(off, aside), dot(off, across));
                        let [a, b] = [dot(ways[1], aside), dot(ways[2], aside)];
                        let [c, e] = [dot(ways[1], across), dot(ways[2], across)];
                        let over = 1.0 / (a * e - b * c);
                        let (du, dv) = ((p * e - q * b) * over, (q * a - p * c) * over);
                        (u, v) = (u - du, v - dv);
                        step = du.abs().max(dv.abs());
                    }
                    let within = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
                    if step < 1e-3 && within {
                        found.push(dot(minus(point, f), d) / dot(d, d));
                    }
                }
                least(found.into_iter())
            }

            /// z = 0, between `hole` and 1 from its middle.
            pub fn disc(f: $vector, d: $vector, hole: $real) -> Option<$real> {
                let t = -f[2] / d[2];
                let (x, y) = (f[0] + t * d[0], f[1] + t * d[1]);
                let square = x * x + y * y;
                if hole * hole <= square && square <= 1.0 { Some(t) } else { None }
            }

            /// Inside of an outline of straight pieces, and between two heights.
            pub fn prism(
                f: $vector,
                d: $vector,
                corners: &[[f64; 2]],
                heights: [f64; 2],
            ) -> Option<$real> {
                let [low, high] = heights.map(|height| height as $real);
                let pieces = || {
                    (0..corners.len()).map(|i| {
                        let ends = [corners[i], corners[(i + 1) % corners.len()]];
                        ends.map(|end| end.map(|x| x as $real))
                    })
                };
                let mut first: Option<$real> = None;
                let mut see = |t: $real| first = Some(first.map_or(t, |first| first.min(t)));
                for [a, b] in pieces() {
                    let (e, g) = ([b[0] - a[0], b[1] - a[1]], [f[0] - a[0], f[1] - a[1]]);
                    let over = 1.0 / (d[0] * e[1] - d[1] * e[0]);
                    let t = (e[0] * g[1] - e[1] * g[0]) * over;
                    let u = (d[0] * g[1] - d[1] * g[0]) * over;
                    let z = f[2] + t * d[2];
                    if (0.0..=1.0).contains(&u) && low <= z && z <= high {
                        see(t);
                    }
                }
                for height in [low, high] {
                    let t = (height - f[2]) / d[2];
                    let (x, y) = (f[0] + t * d[0], f[1] + t * d[1]);
                    let left = |&[a, b]: &[[$real; 2]; 2]| {
                        (a[1] > y) != (b[1] > y)
                            && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
                    };
                    if pieces().filter(left).count() % 2 == 1 {
                        see(t);
                    }
                }
                first
            }

            /// A ball of longitudes and latitudes: Newton's method for u, v and t from places of a grid.
            pub fn longitudes(f: $vector, d: $vector) -> Option<$real> {
                const STARTS: usize = 4;
                let mut first: Option<$real> = None;
                for i in 0..STARTS * STARTS {
                    let pi = std::f64::consts::PI as $real;
                    let share = |i: usize| (i as $real + 0.5) / STARTS as $real;
                    let (mut u, mut v) = (2.0 * pi * share(i % STARTS), pi * share(i / STARTS));
                    let mut t = -dot(f, d) / dot(d, d);
                    let mut size = $real::INFINITY;
                    for _ in 0..10 {
                        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
                        let off = minus([sv * cu, sv * su, cv], [0, 1, 2].map(|i| f[i] + t * d[i]));
                        let (du, dv) = ([-sv * su, sv * cu, 0.0], [cv * cu, cv * su, -sv]);
                        let (across, along) = (cross(du, dv), cross(dv, d));
                        let over = 1.0 / dot(du, along);
                        u -= dot(off, along) * over;
                        v -= dot(off, cross(d, du)) * over;
                        t += dot(off, across) * over;
                        size = dot(off, off);
                    }
                    if size < 1e-8 && (0.0..=pi).contains(&v) {
                        first = Some(first.map_or(t, |first| first.min(t)));
                    }
                }
                first
            }

            /// A ball without a box.
            pub fn difference(
                s: $vector,
                d: $vector,
                (centre, radius): ($vector, $real),
                (middle, half): ($vector, $vector),
            ) -> Option<$real> {
                let (enter, leave) = sphere(s, d, centre, radius)?;
                let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                match slabs(s, d, middle, &axes, half) {
                    Some((low, high)) if low <= enter && enter <= high => {
                        if high < leave {
                            Some(high)
                        } else {
                            None
                        }
                    }
                    _ => Some(enter),
                }
            }
        }
    };
}

naive!(single, f32, super::V32);
naive!(double, f64, super::V64);
