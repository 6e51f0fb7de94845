//! Prisms whose outlines are met where they hardly tell: along a wall, where pieces join, beside their points.

use crate::held::rendered;

const PIXELS: (u32, u32) = (41, 31);

/// The camera is at `from`, looks along `way`, and sees from −2 to 2 across.
fn seen(from: &str, way: &str, things: &str) -> Vec<[i32; 3]> {
    let text = format!(
        "#declare From = {from}; #declare Way = {way};
        #declare Up = vnormalize(vcross(vcross(Way, y + 0.001*z), Way));
        camera {{ orthographic location From direction Way right vcross(Up, Way)*4.1 up Up*3.1 }}
        background {{ rgb <0, 0, 0.3> }} light_source {{ <3000, 5000, 8000>, rgb 1 parallel point_at 0 shadowless }}
        #default {{ pigment {{ rgb <1, 1, 0.2> }} finish {{ ambient 0.3 diffuse 0.7 }} }} {things}"
    );
    look(&text)
}

fn look(text: &str) -> Vec<[i32; 3]> {
    let film = rendered(text, PIXELS);
    let thousandths = |c: f64| (c * 1e3).round() as i32;
    film.radiance.iter().map(|c| [c.red, c.green, c.blue].map(thousandths)).collect()
}

/// How many pixels of two pictures are not the same.
fn differing(one: &[[i32; 3]], other: &[[i32; 3]]) -> usize {
    let differ = |(a, b): &(&[i32; 3], &[i32; 3])| (0..3).any(|i| (a[i] - b[i]).abs() > 2);
    one.iter().zip(other).filter(differ).count()
}

/// What is behind has no red.
fn lit(picture: &[[i32; 3]]) -> Vec<bool> {
    picture.iter().map(|[red, ..]| *red > 0).collect()
}

#[test]
fn rays_along_a_wall_of_what_narrows_see_the_pyramid_that_its_planes_make() {
    let prism = "prism { linear_spline conic_sweep 0, 1, 5,
        <-1, -0.3>, <0.5, -0.3>, <0.5, 0.3>, <-1, 0.3>, <-1, -0.3>";
    let planes = "intersection { plane { <-1, -1, 0>, 0 } plane { <1, -0.5, 0>, 0 }
        plane { <0, -0.3, 1>, 0 } plane { <0, -0.3, -1>, 0 } plane { y, 1 }";
    for turn in [0, 30, 77] {
        for operation in ["difference", "intersection", "merge"] {
            let of = |solid: &str| {
                let from = format!("vrotate(<4.01, -3.99, 0.013>, {turn}*z)");
                let way = format!("vrotate(<-1, 1, 0>, {turn}*z)");
                let whole = format!("box {{ -0.9, 0.9 }} {solid} }} rotate {turn}*z");
                seen(&from, &way, &format!("{operation} {{ {whole} }}"))
            };
            let (one, other) = (of(prism), of(planes));
            assert!(lit(&other).contains(&true), "{operation}");
            assert_eq!(differing(&one, &other), 0, "{operation} {turn}");
        }
    }
}

/// Those along the axis are so to the wall's line through 0, where the outline passes.
#[test]
fn a_wall_that_narrows_is_lit_alike_from_near_and_far() {
    let prism =
        "prism { quadratic_spline conic_sweep 0.25, 1, 7, <-0.7, 0.3>, <-0.3, -0.5>, <0, 0>,
        <-1, -0.7>, <-0.7, 0>, <-0.7, 0.3>, <-0.3, -0.5> rotate 90*z }";
    let [near, far] = [4, 1000].map(|far| {
        let camera = format!("camera {{ orthographic location {far}*x direction -x right -4.1*z up 3.1*y }}");
        look(&format!(
            "{camera} light_source {{ <3000, 5000, 8000>, rgb 1 parallel point_at 0 shadowless }} {prism}"
        ))
    });
    assert_eq!(differing(&near, &far), 0);
}

/// The outline turns along an axis just at a joint, where the rays of one column pass.
#[test]
fn what_a_ray_meets_at_a_joint_is_there_alone_and_in_a_whole() {
    let cubic = "prism { cubic_spline linear_sweep -0.7, 1, 9, <-0.5, 0>, <0.5, -0.7>, <0.3, 0>,
        <-0.5, 1>, <0.25, 0.7>, <-0.7, -0.5>, <-0.5, 0>, <0.5, -0.7>, <0.3, 0>";
    let camera = "camera { orthographic location <0, 4, 4> direction <0, -0.7071067811865475, -0.7071067811865475>
        right 4.1*x up <0, 2.192031021678297, -2.192031021678297> } #default { finish { emission 1 } }";
    let quadratic = "prism { quadratic_spline linear_sweep -0.5, 0.25, 5,
        <-0.35000000000000030, -0.6062177826491069>, <1, 0>, <-0.34999999999999980, 0.6062177826491071>,
        <-0.35000000000000030, -0.6062177826491069>, <1, 0>";
    let near = "camera { location 4*z direction -z right 1.025*x up 0.775*y } #default { finish { emission 1 } }";
    for (camera, prism, lost) in [(camera, cubic, (25, 5..15)), (near, quadratic, (30, 13..18))] {
        let red = "pigment { rgb x }";
        let alone = lit(&look(&format!("{camera} {prism} {red} }}")));
        let far = "sphere { <50, 60, 70>, 1 }";
        let whole = look(&format!("{camera} difference {{ {prism} }} {far} {red} }}"));
        assert_eq!(alone, lit(&whole), "{prism}");
        assert!(lost.1.into_iter().all(|y: usize| alone[y * 41 + lost.0]), "{prism}");
    }
}

#[test]
fn walls_that_two_share_are_whole_whatever_words_make_them_straight() {
    // From 0 to −1/2 and to 1/2 along z, from −1 to 1 along x.
    let corners = |side: f64| [(-1.0, 0.0), (1.0, 0.0), (1.0, side), (-1.0, side)];
    let written = |side: f64, shares: [f64; 2]| {
        let corners = corners(side);
        let mut text = String::new();
        for i in 0..4 {
            let ((a, b), (c, d)) = (corners[i], corners[(i + 1) % 4]);
            for share in [0.0, shares[0], shares[1], 1.0] {
                text += &format!(", <{}, {}>", a + share * (c - a), b + share * (d - b));
            }
        }
        format!("prism {{ bezier_spline -1, 1, 16 {text} }}")
    };
    for shares in [[1.0 / 3.0, 2.0 / 3.0], [0.0, 1.0], [0.25, 0.5], [0.0, 0.0]] {
        for turn in [0, 33] {
            let both = format!(
                "union {{ {} {} rotate {turn}*<1, 2, 3> }}",
                written(-0.5, shares),
                written(0.5, shares)
            );
            let whole = format!("box {{ <-1, -1, -0.5>, <1, 1, 0.5> rotate {turn}*<1, 2, 3> }}");
            let [both, whole] = [both, whole].map(|things| {
                let turned = |way: &str| format!("vrotate({way}, {turn}*<1, 2, 3>)");
                lit(&seen(&turned("-4*x"), &turned("x"), &things))
            });
            assert_eq!(both, whole, "{shares:?} {turn}");
        }
    }
}

/// Its first piece rises all the way, but its second point lies above its end.
#[test]
fn a_prism_is_whole_beside_control_points_that_lie_beyond_the_ends_of_a_piece() {
    let all = [(-1.0, -0.5), (-0.3, 0.5), (0.3, 0.0), (1.0, 0.3)];
    let at = |u: f64| {
        let shares =
            [(1.0 - u).powi(3), 3.0 * u * (1.0 - u).powi(2), 3.0 * u * u * (1.0 - u), u.powi(3)];
        let sum = |part: fn(&(f64, f64)) -> f64| {
            all.iter().zip(shares).map(|(p, s)| s * part(p)).sum::<f64>()
        };
        (sum(|p| p.0), sum(|p| p.1))
    };
    let written = |points: &[(f64, f64)]| {
        points.iter().map(|(x, z)| format!(", <{x}, {z}>")).collect::<String>()
    };
    let corners = [(1.0, 0.3), (1.0, 0.9), (-1.0, 0.9), (-1.0, -0.5)];
    let walls: Vec<_> =
        corners.windows(2).flat_map(|pair| [pair[0], pair[0], pair[1], pair[1]]).collect();
    let curved = format!("bezier_spline S 0.3, 1, 16 {} {}", written(&all), written(&walls));
    let steps: Vec<_> = (0..=256)
        .map(|i| at(f64::from(i) / 256.0))
        .chain([corners[1], corners[2], at(0.0)])
        .collect();
    let straight = format!("linear_spline S 0.3, 1, {} {}", steps.len(), written(&steps));
    for (sweep, camera) in [
        // From the tip each ray sees but one place of the outline.
        ("conic_sweep", "location 0 direction y"),
        ("linear_sweep", "orthographic location 4*y direction -y"),
    ] {
        let [curved, straight] = [&curved, &straight].map(|words| {
            let words = words.replace('S', sweep);
            lit(&look(&format!(
                "camera {{ {camera} right 2.03*x up -1.57*z }}
                prism {{ {words} pigment {{ rgb x }} finish {{ emission 1 }} }}"
            )))
        });
        assert!(straight.iter().filter(|lit| **lit).count() > 500);
        assert_eq!(curved, straight, "{sweep}");
    }
}

/// What is not there to be seen faces no way.
#[test]
fn an_open_end_that_is_grazed_in_a_whole_is_nothing() {
    let prism =
        "prism { linear_spline conic_sweep -1, 1, 4, <0.5, -1>, <-0.5, 0>, <0.5, 0>, <0.5, -1> open
        matrix <1, 0, 0, 0.5, 1, 0, 0, 0, 1, 0, 0, 0> }";
    let camera = "camera { orthographic location -8*y direction y right 4.1*x up 3.1*z }";
    let picture = look(&format!(
        "{camera} intersection {{ {prism} box {{ -3, 3 }} pigment {{ rgb x }} finish {{ emission 1 }} }}"
    ));
    assert!(lit(&picture).contains(&true));
}
