use super::*;
use crate::math::random::{Random, tries};

/// Returns the warp of a line of the table; numbers of a vector are joined by commas there.
fn read(line: &str) -> Warp {
    let line = line.replace(", ", " ").replace(">,", " ").replace(['<', '>'], " ");
    let mut words = line.split_whitespace().peekable();
    let mut warp = Warp::of_word(words.next().expect("a word")).expect("a warp");
    let mut after = 0;
    while let Some(word) = words.next() {
        let parameters = warp.parameters();
        let named = parameters.iter().position(|parameter| parameter.word == Some(word));
        let value = match named {
            Some(place) if parameters[place].default == Argument::Switch(false) => {
                warp.set(place, Argument::Switch(true));
                continue;
            }
            Some(_) => words.next().expect("a value"),
            None => word,
        };
        let place = named.unwrap_or(after);
        after += usize::from(named.is_none());
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let axis = [("x", Vector::X), ("y", Vector::Y), ("z", Vector::Z)];
        let argument = match parameters[place].default {
            Argument::Number(_) => Argument::Number(number(value)),
            _ => Argument::Vector(match axis.iter().find(|(word, _)| value.ends_with(word)) {
                Some((word, axis)) => match value.trim_end_matches(word).strip_suffix('*') {
                    Some(factor) => *axis * number(factor),
                    None => *axis,
                },
                None => {
                    let numbers: Vec<f64> = value.split(',').map(number).collect();
                    Vector::from_array(numbers.try_into().expect("three numbers"))
                }
            }),
        };
        warp.set(place, argument);
    }
    warp.canonical()
}

#[test]
fn points_move_as_in_pov_ray() {
    let mut warp = None;
    let mut rows = 0;
    for line in include_str!("../measured/warp.txt").lines().skip(2) {
        if let Some(written) = line.strip_prefix("# ") {
            warp = Some(read(written));
            continue;
        }
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().expect("a number")).collect();
        let (point, measured) =
            (Vector::from_slice(&numbers[..3]), Vector::from_slice(&numbers[3..]));
        let warp = warp.expect("a warp before its rows");
        let moved = warp.point(point);
        assert!((moved - measured).abs().max_element() < 1e-13, "{warp:?} {line}: {moved}");
        rows += 1;
    }
    assert!(rows > 400, "{rows}");
}

fn wild(random: &mut Random) -> f64 {
    let size = [0.0, 1.0, 3.0, 1e-300, 1e300, 1e9][random.below(6)];
    [random.number(-1.0, 1.0) * size, size, -size][random.below(3)]
}

fn any(random: &mut Random, number: impl Fn(&mut Random) -> f64) -> Warp {
    let all = Warp::all();
    let mut warp = all[random.below(all.len())];
    for (place, parameter) in warp.parameters().iter().enumerate() {
        if random.below(3) == 0 {
            continue;
        }
        let argument = match parameter.default {
            Argument::Number(_) => Argument::Number(number(random)),
            Argument::Vector(_) => {
                Argument::Vector(Vector::from_array([(); 3].map(|()| number(random))))
            }
            Argument::Switch(_) => Argument::Switch(random.below(2) == 1),
            Argument::Numbers(_) => unreachable!("no warp has two numbers in one"),
        };
        warp.set(place, argument);
    }
    warp.canonical()
}

#[test]
fn points_stay_finite_for_all_warps() {
    let mut random = Random(21);
    for _ in 0..tries() {
        let warp = any(&mut random, wild);
        let point = Vector::from_array([(); 3].map(|()| wild(&mut random)));
        let error = Vector::splat([0.0, 1e-9, 1.0][random.below(3)]);
        let (moved, error) = warp.moved(point, error);
        assert!(moved.is_finite() && error.is_finite(), "{warp:?} {point}: {moved} {error}");
        assert!(error.min_element() >= 0.0, "{warp:?} {point}: {error}");
    }
}

#[test]
fn canonical_parameters_stay_as_they_are() {
    let mut random = Random(22);
    for _ in 0..tries() {
        let warp = any(&mut random, |random| random.number(-3.0, 3.0));
        let again = warp.canonical();
        for place in 0..warp.parameters().len() {
            let near = match (warp.get(place), again.get(place)) {
                (Some(Argument::Vector(one)), Some(Argument::Vector(two))) => {
                    (one - two).abs().max_element() < 1e-15
                }
                (one, two) => one == two,
            };
            assert!(near, "{warp:?} {again:?}");
        }
    }
}

#[test]
fn an_error_covers_what_it_may_do_to_the_moved_point() {
    let mut random = Random(23);
    let mut told = 0;
    for _ in 0..tries() {
        let warp = any(&mut random, |random| random.number(-3.0, 3.0));
        let point = random.point(3.0);
        let error = Vector::splat(1e-9);
        let (moved, moved_error) = warp.moved(point, error);
        let (other, _) = warp.moved(point + random.point(1e-9), error);
        let apart = (moved - other).abs();
        told += usize::from(moved_error != Vector::ZERO);
        // Unless they are on two sides of a seam.
        let is_far = apart.max_element() > 1e-3;
        let is_covered = (apart - moved_error * 2.0).max_element() < 1e-13;
        assert!(
            is_covered || is_far || moved_error == Vector::ZERO,
            "{warp:?} {point}: {apart} {moved_error}"
        );
    }
    assert!(told > tries() / 2, "{told}");
}

#[test]
fn a_point_that_may_be_on_a_seam_starts_a_new_copy() {
    let repeat = read("repeat 2*x flip <0,1,0>");
    let error = Vector::splat(1e-12);
    for off in [-1e-13, 0.0, 1e-13] {
        let (moved, _) = repeat.moved(Vector::new(2.0 + off, 0.5, 0.0), error);
        assert!(moved.x.abs() < 1e-12 && moved.y == -0.5, "{moved}");
        let cylindrical = read("cylindrical").moved(Vector::new(2.0, 0.5, off), error);
        assert_eq!(cylindrical.0.x, 0.0, "{off}");
        let toroidal = read("toroidal").moved(Vector::new(0.5, off, 0.0), error);
        assert!(toroidal.0.y.abs() < 1e-12, "{toroidal:?}");
    }
    let (moved, _) = repeat.moved(Vector::new(2.0 - 1e-11, 0.5, 0.0), error);
    assert!(moved.x > 1.9 && moved.y == 0.5);
}
