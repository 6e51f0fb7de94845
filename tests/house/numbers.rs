//! No epsilon and no far limit: every very small or very large number in the source is declared
//! here, with the reason why it is none.

use std::collections::BTreeSet;

use super::{assert_none, files};

/// Numbers that look like an epsilon or a far limit, by file and by what stands on their line, and
/// why each is neither: none is compared with a length of a scene. A reason is for one line.
const NUMBERS: &[(&str, &str, &str)] = &[
    ("accuracy/knob.rs", "4096.0, 1e-6", "a weight at which reflections are no longer followed"),
    ("accuracy/knob.rs", "1e-2, 1e-4, 1e-6", "shares of a solid's own size, for comparison"),
    ("accuracy/statistics.rs", "BAD", "of a colour's full scale"),
    ("accuracy/statistics.rs", "MOST_DRAWS", "draws"),
    ("accuracy/afford.rs", "MOST_RAYS", "rays of a sample"),
    ("accuracy/promise.rs", "MOST_RAYS", "rays of samples"),
    ("accuracy/reference.rs", "ROUNDING", "of a colour's full scale"),
    ("accuracy/svg/label.rs", "'@' => 1015.0", "the width of a letter"),
    ("accuracy/svg/label.rs", "_ => 1015.0", "the width of a letter"),
    ("accuracy/table.rs", "0.000_1", "how a number is written"),
    ("color.rs", "0.003_130_8", "of a colour: where the display's curve begins to bend"),
    ("evaluate/block/finish.rs", "f64::MAX", "a roughness of 0 has no edge: as if without bound"),
    ("evaluate/block/settings.rs", "1_000_000.0", "levels of reflection"),
    ("evaluate/builtin/float.rs", "BORDER", "roundings of a sine or cosine, which is at most 1"),
    ("evaluate/builtin/mod.rs", "1e-5..1e16", "how a number is written in a message"),
    ("evaluate/array.rs", "1e-10", "an index, which is a whole number"),
    (
        "evaluate/builtin/vector.rs",
        "1e-280..1e300",
        "squares that are exact; others are scaled first",
    ),
    ("evaluate/probe.rs", "UNBOUNDED", "what POV-Ray's max_extent answers for a plane"),
    ("shape/multiple.rs", "const TOLD", "roundings of a value and of a gradient"),
    ("shape/multiple.rs", "const MOVED", "relative: of how far off a point is, or of a container"),
    (
        "shape/multiple.rs",
        "const NEAREST",
        "relative: of how far off a point is, or of a container",
    ),
    ("shape/isosurface/mod.rs", "let [near, far]", "of a container's size"),
    ("shape/algebraic/closed.rs", "MOST_STRETCHED", "a length over a length, squared"),
    ("shape/algebraic/net.rs", "const NARROWEST", "relative: of the first box's half width"),
    ("shape/algebraic/net.rs", "let slack", "roundings of a value, relative, and what underflows"),
    ("shape/tree.rs", "STEEPEST", "stands for 1/0"),
    ("evaluate/turn.rs", "1e-9 * step", "relative: of a loop's step"),
    (
        "evaluate/comparison.rs",
        "const LEFT_OVER: f64 = 1e-10;",
        "of numbers that a `.pov` file compares, as POV-Ray has it; relative in a `.scene`",
    ),
    ("evaluate/lint/angle.rs", "TYPED", "radians: what a typed angle may be off by, for a hint"),
    ("evaluate/lint/unit.rs", "TYPED_PI", "radians: what a typed π may be off by, for a hint"),
    ("plan/print.rs", "..0.005", "rays of a pixel, as they are written"),
    ("plan/numerics.rs", "SINGLE", "a length over a length, for the plan to tell"),
    ("plan/numerics.rs", "f64::MAX", "the greatest number there is, where it is more"),
    ("plan/numerics.rs", "THIN", "a length over a length, for the plan to tell"),
    ("color.rs", "f32::MAX", "of a colour: single precision holds no more"),
    ("film.rs", "let above", "all numbers in their order, halved"),
    ("film.rs", "from_bits(high)", "all numbers in their order, halved"),
    ("function/build.rs", "Kind::Constant(bits)", "a function's own constant"),
    ("function/build/layout.rs", "constants.push", "a function's own constant"),
    ("function/closed.rs", "let off", "roundings of a value, relative"),
    ("pattern/gradient.rs", "let far", "roundings of a sum, relative"),
    ("spline.rs", "let room", "roundings of a value, relative"),
    ("geometry/balls.rs", "f64::MAX / 1e20", "squares that may overflow: every object is tried"),
    ("geometry/balls.rs", "radius_squared * (", "relative, and what underflows"),
    ("geometry/balls.rs", "SLACK", "roundings of a square, relative"),
    ("geometry/beside.rs", "const BESIDE", "relative: of a solid's own size"),
    ("geometry/polyhedron.rs", "const U", "the roundoff itself"),
    ("geometry/polyhedron.rs", "NO_SHARE", "of unit vectors: how much of one is in another"),
    ("geometry/span.rs", "STEEPEST", "stands for 1/0"),
    ("geometry/span.rs", "const BLUR", "roundings of a box test, relative"),
    ("geometry/span.rs", "const ERRORS", "errors of a crossing"),
    ("geometry/span.rs", "const BESIDE", "relative: of how far off a span is"),
    ("geometry/tree.rs", "far * self.scale", "from so many tree sizes no ray is moved"),
    ("geometry/tree.rs", "FAR", "beyond so many tree sizes every object is tried"),
    ("geometry/tree.rs", "STEEPEST", "stands for 1/0 among slopes"),
    ("geometry/tree.rs", "OUTWARD", "roundings of a box test, relative"),
    ("geometry/tree.rs", "let padding", "roundings of the ray's start, relative"),
    ("geometry/tree.rs", "let least", "relative: of the tree's size"),
    ("lower/camera.rs", "PARALLEL", "relative: between directions"),
    ("lower/empty/gap.rs", "THIN", "relative: of a part's size"),
    ("geometry/reach.rs", "ONE_DIRECTION", "roundings of a direction, whose length is 1"),
    ("geometry/doubled.rs", "GRAIN", "relative: of a solid's size, and only looked up by"),
    ("geometry/doubled.rs", "ROUNDED", "roundings of a plane's numbers, relative"),
    ("lower/view.rs", "CLEARLY", "relative: to the place of a corner"),
    ("lower/view.rs", "SHOWS", "of a half width"),
    ("lower/view.rs", "SEEN", "of a picture's width"),
    ("lower/view.rs", "let rounding", "of a half width"),
    ("lower/quadric.rs", "MOST_STRETCHED", "a length over a length, squared"),
    ("lower/quadric.rs", "let is_tip", "roundings of a sum, relative"),
    ("lower/lint.rs", "let near", "relative: of a picture's proportions, for a warning"),
    ("lower/lint.rs", "ROUNDING", "relative: what a warning overlooks in a sum near 1"),
    ("lower/transform.rs", "NEAR_SINGULAR", "a condition number: a length over a length"),
    ("lower/transform.rs", "STEP_ROUNDING", "relative: of a map's numbers"),
    ("math/double.rs", "low: 2.9486522708701687e-19", "digits of π/180"),
    ("math/double.rs", "exponent.clamp(2,", "a power of two by its exponent"),
    ("math/double.rs", "exponent.clamp(-1022,", "a power of two by its exponent"),
    ("math/interval.rs", "const FAR", "radians: intervals that wide hold every angle"),
    ("math/interval.rs", "const NARROW", "radians: of a wave"),
    ("math/interval.rs", "let step =", "roundings of a power, relative"),
    ("math/interval.rs", "const TURN", "relative: of an angle"),
    ("math/interval.rs", "const WHOLE", "whole numbers that are exact"),
    ("math/roots/bracket.rs", "const U", "the roundoff itself"),
    ("math/roots/bracket.rs", "step = 2.0", "a step that grows from the smallest number there is"),
    ("math/roots/polynomial.rs", "const U", "the roundoff itself"),
    ("math/roots/polynomial.rs", "let most", "relative: of a bracket's width"),
    (
        "math/roots/polynomial.rs",
        "let start",
        "a step that grows from the smallest number there is",
    ),
    ("math/random.rs", "(1u64 << 53)", "the numbers of 53 bits between 0 and 1"),
    ("math/singular.rs", "cosine.abs()", "a cosine: columns that are at right angles"),
    ("math/vector.rs", "4_097.0", "splits a number in two halves of bits"),
    ("math/vector.rs", "134_217_729.0", "splits a number in two halves of bits"),
    (
        "math/vector.rs",
        "f32::from_bits(57",
        "squares that do not overflow; others are scaled first",
    ),
    (
        "math/vector.rs",
        "f64::from_bits(123",
        "squares that do not overflow; others are scaled first",
    ),
    ("math/vector.rs", "1023 - exponent", "a power of two by its exponent"),
    ("math/vector.rs", "UNIT_ROUNDOFF", "the roundoff itself"),
    ("math/vector.rs", "debug_assert", "of a length that is 1"),
    ("math/placement.rs", "let centre", "roundings of a map's centre, relative"),
    ("math/placement.rs", "let difference", "roundings of a difference, relative"),
    ("pattern/checker.rs", "WHOLE", "large enough that its neighbours are whole numbers"),
    ("pattern/gradient.rs", "let error", "roundings of a sum, relative"),
    ("pattern/mod.rs", "const NEAR", "of a pattern's cell"),
    (
        "noise/range.rs",
        "const FAR",
        "noise repeats itself long before; bounds are then of all of it",
    ),
    ("noise/range.rs", "Plateaus =>", "roundings of noise, which is at most 1"),
    ("noise/range.rs", "(0.5 + 0.552_42", "roundings of noise, which is at most 1"),
    ("noise/range.rs", "Perlin =>", "its coordinates come in steps, of cells of the side 1"),
    ("noise/range.rs", "low: (slope.low", "roundings of noise, whose cells have the side 1"),
    ("noise/range.rs", "high: (slope.high", "roundings of noise, whose cells have the side 1"),
    ("noise/perlin.rs", "stream.below(4096)", "whole numbers drawn for a table"),
    ("noise/perlin.rs", "2048.0 * 2048.0", "whole numbers drawn for a table"),
    ("noise/perlin.rs", "ORIGIN", "where POV-Ray's noise has its origin"),
    ("noise/table.rs", "-0.00779736", "a table of POV-Ray's noise"),
    ("noise/turbulence.rs", "greatest", "numbers pass through `f32` there, as in POV-Ray"),
    ("plan/print.rs", "1e-3..1e6", "how a number is written"),
    ("scene.rs", "adc_bailout", "a weight of light"),
    ("evaluate/block/sheet.rs", "FLAT_ENOUGH", "relative: of a polygon's size"),
    ("picture/heights.rs", "(share *", "numbers of 16 bits"),
    ("scene/polygon.rs", "let narrow", "relative: of a polygon's size"),
    ("shape/bicubic_patch/foot.rs", "if normal.length()", "relative: of a patch's size"),
    ("shape/bicubic_patch/foot.rs", "inward * 100.0", "of u and v, which are 0 to 1"),
    ("shape/height_field/mod.rs", "const STRETCHED", "heights of 16 bits, of which one is a step"),
    ("shape/bicubic_patch/net.rs", "let enough", "relative: how tight a patch's bounds are"),
    ("evaluate/block/isosurface.rs", "0.001", "the manual's default, which the author sets"),
    ("function/slope.rs", "whole.fract()", "whole numbers up to it are exact"),
    ("function/slope.rs", "first.abs() <", "whole numbers up to it are exact"),
    ("shape/isosurface/cells.rs", "MARGIN", "relative: of the box's size"),
    ("shape/isosurface/mod.rs", "let steps", "of a container's size: differences for a normal"),
    ("shape/isosurface/mod.rs", "STEEPEST", "relative: a slope over the container's size"),
    ("shape/isosurface/mod.rs", "let across", "of a container's size: differences for a slope"),
    ("shape/isosurface/mod.rs", "let is_known", "relative: of a slope"),
    ("shape/isosurface/mod.rs", "1e-9 * steepness", "relative: of the container's size, at a jump"),
    ("shape/julia_fractal/mod.rs", "const FINEST", "relative: of the ball's radius"),
    ("shape/parametric/mod.rs", "EPSILON.sqrt()", "of a part of the rectangle of u and v"),
    ("shape/parametric/search.rs", "let size", "keeps 0/0 from the origin of u and v"),
    ("shape/julia_fractal/mod.rs", "const ANYTHING", "stands for no bound"),
    ("math/roots/bracket.rs", "let finest", "the next number but one"),
    ("scene/blob.rs", "let apart", "roundings of a distance, relative"),
    ("scene/outline.rs", "const ROUNDED", "relative: of the points' largest coordinate"),
    ("scene/outline.rs", "let off = 8.0", "relative: of the points' size"),
    ("shape/curve/mod.rs", "const NEAR", "relative: of a piece's size, and of u, which is 0 to 1"),
    ("shape/curve/mod.rs", "let length", "keeps 0/0 from a piece without length"),
    ("shape/lathe/line.rs", "more / (", "keeps 0/0 from the axis"),
    ("shape/lathe.rs", "const GRAZING", "a slope, and costs time only"),
    ("shape/lathe/level.rs", "const NARROWEST", "a count of roundings, and costs time only"),
    ("shape/prism.rs", "const GRAZING", "a slope; what it bounds is of the rounding's size"),
    ("shape/prism.rs", "STEEP", "a slope, and costs time only"),
    ("shape/prism/ends.rs", "2.0 * end.error", "so that a bound of 0 grows"),
    ("shape/box_.rs", "let blur", "relative: of the distance"),
    ("shape/box_/slabs.rs", "STEEP", "a slope"),
    ("shape/plane.rs", "NEARLY_ALONG", "a slope"),
    ("shape/box_/slabs.rs", "LEVEL", "a slope"),
    ("shape/mod.rs", "const U", "the roundoff itself"),
    ("shape/mesh/pierce.rs", "i32::from(turn > off", "relative, and what underflows"),
    ("shape/ovus.rs", "let away", "keeps 0/0 from the axis, where nothing is across"),
    ("shape/plane.rs", "let steep", "a slope"),
    ("shape/plane.rs", "size < t * 16_384.0", "relative: a distance to a distance"),
    ("shape/plane.rs", "error: t / 67_108_864.0", "relative: of the distance"),
    ("shape/sphere.rs", "let is_larger", "relative: of the radius to the place"),
    ("shape/sphere.rs", "let clear", "relative: of the distance and the radius"),
    ("shape/sphere.rs", "let close", "relative: of the height to the radius, squared"),
    ("shape/sphere.rs", "size / 1_048_576.0", "relative: of the distance and the radius"),
    ("shape/superellipsoid.rs", "const MOST", "a gauge so large is as good as any larger"),
    ("shape/sphere_sweep/mod.rs", "const STRETCHES", "stretches of a segment, counted"),
    ("shape/torus.rs", "let slope", "keeps 0/0 from the middle, where the slope is not asked"),
    ("trace/refraction.rs", "CRITICAL", "relative: of a sine, which is at most 1"),
    ("trace/sharpness.rs", "let is_sharp", "roundings of a direction, whose length is 1"),
    ("trace/sharpness.rs", "const ROUNDED", "roundings of a direction, whose length is 1"),
    ("trace/sharpness.rs", "* centres", "roundings of a map's centres, relative"),
    ("world.rs", "adc_bailout", "a weight of light"),
    ("color.rs", "const LARGE", "what POV-Ray shows for infinite light, a colour"),
    ("evaluate/block/blob.rs", "const SMALLEST", "a threshold of a field, as good as 0"),
    ("evaluate/block/finish/reflection.rs", "const NEARLY_NOTHING", "an exponent, as good as 0"),
    (
        "evaluate/block/matrix.rs",
        "const NO_LENGTH",
        "what POV-Ray takes for 0 in a matrix (measured)",
    ),
    ("evaluate/block/outline.rs", "let (radius, hole)", "an empty minimum"),
    (
        "evaluate/block/solid.rs",
        "const SHARPEST",
        "what POV-Ray takes for an exponent of 0 (measured)",
    ),
    ("evaluate/builtin/rendered.rs", "let is_half", "numbers of characters"),
    (
        "lower/camera.rs",
        "const NEARLY_ZERO",
        "of a default vector's length, where a camera has none",
    ),
];

/// A file's code without its tests, its comments and what stands in quotes: strings, raw ones too,
/// and the quote as a character.
fn unquoted(text: &str) -> String {
    let mut left = String::new();
    let mut rest = text.split("#[cfg(test)]\nmod tests").next().unwrap_or(text);
    while let Some(at) = rest.find('"') {
        let before = &rest[..at];
        if let Some(comment) = before.find("//") {
            left += &before[..comment];
            rest = &rest[comment..];
            rest = &rest[rest.find('\n').unwrap_or(rest.len())..];
            continue;
        }
        if before.ends_with('\'') || before.ends_with("'\\") {
            left += before;
            rest = &rest[at + 1..];
            continue;
        }
        let hashes = before.len() - before.trim_end_matches('#').len();
        let is_raw = before[..before.len() - hashes].ends_with('r');
        left += before;
        rest = &rest[at + 1..];
        let end = if is_raw {
            rest.find(&format!("\"{}", "#".repeat(hashes))).map(|end| end + 1 + hashes)
        } else {
            let mut escaped = false;
            let ends = |(_, c): &(usize, char)| {
                let end = *c == '"' && !escaped;
                escaped = *c == '\\' && !escaped;
                end
            };
            rest.char_indices().find(ends).map(|(end, _)| end + 1)
        };
        rest = &rest[end.unwrap_or(rest.len())..];
    }
    let last = rest.lines().map(|line| line.split("//").next().unwrap_or(line));
    left + &last.collect::<Vec<_>>().join("\n")
}

/// The numbers with a point or an exponent that a line has, and the quotients of two that stand side
/// by side.
fn written_numbers(line: &str) -> Vec<f64> {
    let part_of_number = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let spaced = line.replace("e-", "e\u{2212}").replace("E-", "e\u{2212}");
    let read = |token: &str| {
        let token = token.trim_end_matches("_f64").trim_end_matches("_f32");
        let is_real = token.starts_with(|c: char| c.is_ascii_digit())
            && token.contains(['.', 'e', 'E'])
            && !token.starts_with("0x");
        let plain = token.replace('_', "").replace('\u{2212}', "-");
        if is_real { plain.parse::<f64>().ok() } else { None }
    };
    let tokens = |text: &str| -> Vec<f64> {
        text.split(|c: char| !part_of_number(c) && c != '\u{2212}')
            .flat_map(|token| token.split(".."))
            .filter_map(read)
            .collect()
    };
    let mut numbers = tokens(&spaced);
    let sides: Vec<&str> = spaced.split(" / ").collect();
    for pair in sides.windows(2) {
        let above = pair[0].rsplit(|c: char| !part_of_number(c)).next().and_then(read);
        let below = pair[1].split(|c: char| !part_of_number(c)).next().and_then(read);
        numbers.extend(above.zip(below).map(|(above, below)| above / below));
    }
    numbers
}

/// Whether a line has a number so small or so large that it may be an epsilon or a far limit.
fn has_extreme_number(line: &str) -> bool {
    const WORDS: &[&str] =
        &["EPSILON", "MIN_POSITIVE", "f64::MAX", "f32::MAX", "(1u64 <<", "(1u128 <<", "from_bits("];
    let plain = |number: &f64| *number == 0.0 || (0.01..=1000.0).contains(number);
    !written_numbers(line).iter().all(plain) || WORDS.iter().any(|word| line.contains(word))
}

#[test]
fn no_length_is_compared_with_an_epsilon_or_a_far_limit() {
    let mut faults = Vec::new();
    let mut used = BTreeSet::new();
    for (file, text) in files("src", &["rs"]) {
        if file.starts_with("cli/") {
            continue;
        }
        let code = unquoted(&text);
        for line in code.lines().filter(|line| has_extreme_number(line)) {
            let reason =
                NUMBERS.iter().position(|(place, part, _)| file == *place && line.contains(part));
            // A reason is for one line.
            if reason.is_none_or(|index| !used.insert(index)) {
                faults.push(format!("{file}: `{}`", line.trim()));
            }
        }
    }
    let unused = (0..NUMBERS.len()).filter(|index| !used.contains(index));
    faults.extend(unused.map(|index| format!("excused, and not there: {:?}", NUMBERS[index])));
    assert_none(faults);
}

#[test]
fn the_reader_of_numbers_finds_the_extreme_ones() {
    for line in [
        "if t > 1e-6 {",
        "t < 1E7",
        "x + 0.000_1",
        "1.0e10 > t",
        "a < f64::EPSILON",
        "t > 20_000.0",
        "1e-5..1e16",
        "t > 1e-3",
        "t > 0.009",
        "t > 0.001_f64",
        "t > 1001.0",
        "a / 4096.0",
        "t > 1.0 / 128.0",
        "t > size / 10.0 * 1.0 / 255.0",
        "f64::from_bits(1 << 52)",
    ] {
        assert!(has_extreme_number(line), "{line}");
    }
    for line in [
        "t > 0.0",
        "0.5 * x",
        "2.0 * b",
        "1..10",
        "x.e1",
        "1_000_000",
        "0.01",
        "1.0 / 8.0",
        "a / 64.0",
        "t.0 / 128.0",
        "0xe5",
        "[1.0, 255.0]",
    ] {
        assert!(!has_extreme_number(line), "{line}");
    }
    for (code, left) in [
        ("a(\"1e-6\", b)", "a(, b)"),
        ("a(\"x\\\"1e-6\\\\\", b)", "a(, b)"),
        ("a(r#\"1\"e-6\"#, '\"', \"b\", 1e9)", "a(r#, '', , 1e9)"),
        ("\"//\" 1e9 // \"\n1e8 // \" 1e7", " 1e9 \n1e8 "),
        ("a(b'\\\"', 1e9, \"c\")", "a(b'\\', 1e9, )"),
    ] {
        assert_eq!(unquoted(code), left);
    }
}

/// What may round otherwise on another processor. A fused operation that is written out rounds alike
/// on all, but is slow on some: only numbers of twice the digits are made so.
const FUSED: &[&str] = &[
    "mul_add",
    "fma(",
    "fmaf(",
    "algebraic_",
    "fadd_fast",
    "fmul_fast",
    "target_feature",
    "target_arch",
    "::arch::",
];

#[test]
fn row_72_nothing_is_fused_nor_left_to_a_processor() {
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        let code = unquoted(&text);
        let allowed = |word: &str| file == "math/double.rs" && word == "mul_add";
        let fused = FUSED.iter().filter(|word| code.contains(*word) && !allowed(word));
        faults.extend(fused.map(|word| format!("{file}: `{word}`")));
    }
    assert_none(faults);
    assert!(unquoted("let a = b.mul_add(c, d);").contains(FUSED[0]));
}
