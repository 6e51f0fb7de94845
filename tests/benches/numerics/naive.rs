//! Crossings as textbooks have them: the quadratic formula with the origin where it is, planes and
//! slabs without bounds; the same code in `f32` and in `f64`.

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

            /// `rows` map a point to the unit sphere's space: three factors and an offset each.
            pub fn ellipsoid(
                s: $vector,
                d: $vector,
                rows: &[[$real; 4]; 3],
            ) -> Option<($real, $real)> {
                let local = |v: $vector, w: $real| {
                    let map = |r: &[$real; 4]| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3] * w;
                    [map(&rows[0]), map(&rows[1]), map(&rows[2])]
                };
                let (f, d) = (local(s, 1.0), local(d, 0.0));
                quadratic(dot(d, d), 2.0 * dot(f, d), dot(f, f) - 1.0)
            }
        }
    };
}

naive!(single, f32, super::V32);
naive!(double, f64, super::V64);
