//! What a line quotes is what has to go for the effect to be gone: with all of it taken out the effect is
//! gone and the scene whole, and with any less of it, down to the token, the effect is there or the scene
//! is broken. Patterns and clear colours are quoted by the words that call for them: a pattern's word with its
//! values, and the first colour of a pigment that lets light through.

use std::collections::{HashMap, HashSet};

use lucarne::pattern::Kind;
use lucarne::vocabulary::{Family, Word};

use super::*;

/// What is left of a scene without some pieces: the effects that are on; `None` where it is broken.
struct Remains<'a> {
    name: &'a str,
    text: Option<&'a str>,
    sources: Sources,
    quotes: Vec<(Effect, Vec<Span>)>,
    known: HashMap<Vec<Span>, Option<Vec<Effect>>>,
}

impl<'a> Remains<'a> {
    /// Of a scene on disk, or of a text under that name.
    fn of(name: &'a str, text: Option<&'a str>) -> Self {
        let seen = match text {
            Some(text) => see_text(text),
            None => see(name, &Changed::default()),
        };
        assert_eq!(seen.errors, "", "{name}");
        let called = seen.plan.effects.iter().filter(|c| c.effect != Effect::Antialiasing);
        let quotes = called.map(|c| (c.effect, c.by.iter().map(|site| site.span).collect()));
        let quotes = quotes.collect();
        Self { name, text, sources: seen.sources, quotes, known: HashMap::new() }
    }

    fn without(&mut self, mut spans: Vec<Span>) -> Option<Vec<Effect>> {
        spans.sort();
        if spans.is_empty() {
            return Some(self.quotes.iter().map(|(effect, _)| *effect).collect());
        }
        if let Some(known) = self.known.get(&spans) {
            return known.clone();
        }
        let rest = see(self.name, &without(&spans, &self.sources));
        let effects = rest.plan.effects.iter().map(|called| called.effect).collect();
        let remains = rest.errors.is_empty().then_some(effects);
        self.known.insert(spans, remains.clone());
        remains
    }

    fn texts(&self, spans: &[Span]) -> Vec<String> {
        spans.iter().map(|span| self.sources.text(*span).to_owned()).collect()
    }
}

/// The tokens of a piece of text, a value being one: what is taken out of it is no item.
fn tokens(text: &str) -> Vec<std::ops::Range<usize>> {
    let bytes = text.as_bytes();
    let mut tokens: Vec<std::ops::Range<usize>> = Vec::new();
    let (mut at, mut joins) = (0, false);
    while at < bytes.len() {
        let rest = &text[at..];
        let first = bytes[at];
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let to_end_of_group = |open: u8, close: u8| {
            let mut depth = 0;
            rest.bytes().position(|byte| {
                depth += i32::from(byte == open) - i32::from(byte == close);
                depth == 0
            })
        };
        let end = match first {
            byte if byte.is_ascii_whitespace() => {
                at += 1;
                continue;
            }
            b'/' if rest.starts_with("//") => {
                at += rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            b'/' if rest.starts_with("/*") => {
                at += rest.find("*/").map_or(rest.len(), |end| end + 2);
                continue;
            }
            b'"' => at + 2 + rest[1..].find('"').expect("closed"),
            b'(' => at + 1 + to_end_of_group(b'(', b')').expect("closed"),
            b'<' => at + 1 + to_end_of_group(b'<', b'>').expect("closed"),
            b'#' => at + 1 + rest[1..].find(|c| !is_word(c)).unwrap_or(rest.len() - 1),
            _ if is_word(first as char) => {
                let mut end = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
                let exponent = first.is_ascii_digit() && rest[..end].ends_with('e');
                if exponent && rest[end..].starts_with('-') {
                    end +=
                        1 + rest[end + 1..].find(|c| !is_word(c)).unwrap_or(rest.len() - end - 1);
                }
                at + end
            }
            _ => at + 1,
        };
        let called = first == b'('
            && tokens.last().is_some_and(|token| {
                let word = &text[token.clone()];
                token.end == at && word.starts_with(|c: char| c.is_ascii_alphabetic())
            });
        let operator = b"*/+-".contains(&first);
        let of_value = |token: &std::ops::Range<usize>| !b"{}[],;".contains(&bytes[token.end - 1]);
        match tokens.last_mut().filter(|last| of_value(last)) {
            Some(last) if joins || called || operator => last.end = end,
            _ => tokens.push(at..end),
        }
        (at, joins) = (end, operator);
    }
    tokens
}

/// Words that are values.
const VALUES: [&str; 11] =
    ["x", "y", "z", "pi", "clock", "on", "off", "yes", "no", "true", "false"];

fn is_value(token: &str) -> bool {
    !token.starts_with(|c: char| c.is_ascii_lowercase() || "{}[],;#".contains(c))
        || VALUES.contains(&token)
}

/// Every run of tokens that is less than all of the text. Brackets stay paired:
/// else all is broken. A word goes with the value after it: else that is given to another word.
fn runs(text: &str) -> Vec<std::ops::Range<usize>> {
    let tokens = tokens(text);
    let mut runs = Vec::new();
    for first in 0..tokens.len() {
        let mut depth = 0;
        for last in first..tokens.len() {
            match &text[tokens[last].clone()] {
                "{" | "[" => depth += 1,
                "}" | "]" => depth -= 1,
                _ => {}
            }
            if depth < 0 {
                break;
            }
            let parted = !is_value(&text[tokens[last].clone()])
                && tokens[last].len() > 1
                && tokens.get(last + 1).is_some_and(|next| is_value(&text[next.clone()]));
            if depth == 0 && !parted && (first, last) != (0, tokens.len() - 1) {
                runs.push(tokens[first].start..tokens[last].end);
            }
        }
    }
    runs
}

/// What is said of a light, a mirror and so on, whatever its numbers.
fn form(text: &str) -> String {
    let word = |token: std::ops::Range<usize>| {
        let number = |c: char| c.is_ascii_digit() || "<(-".contains(c);
        if text[token.clone()].starts_with(number) { "0" } else { &text[token] }
    };
    tokens(text).into_iter().map(word).collect::<Vec<_>>().join(" ")
}

/// The seed's words come together, and a lone `ks` changes them: only all of that can be taken out.
fn together(text: &str) -> bool {
    ["kd", "ks", "phong_exponent"].iter().any(|word| text.starts_with(word))
}

/// Whether an effect is quoted by words that call for it, which need not be all that has to go.
fn is_named(effect: Effect) -> bool {
    matches!(effect, Effect::Patterns | Effect::Transparency | Effect::ColoredShadows)
}

/// Whether a text calls for such an effect: it begins with a pattern's word, or is a colour that may let light
/// through, alone or in the entry of a map.
fn names(effect: Effect, text: &str) -> bool {
    let mut words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    if effect == Effect::Patterns {
        let first = words.next().unwrap_or_default();
        return ["function", "object"].contains(&first)
            || Kind::of_word(first).is_some()
            || Word::from_name(first).is_some_and(|word| word.family() == Family::Pattern);
    }
    words.any(|word| {
        let is_name = word.starts_with(|c: char| c.is_ascii_uppercase());
        let model = word.strip_prefix('s').unwrap_or(word);
        is_name
            || ["rgbf", "rgbt", "rgbft"].contains(&model)
            || ["filter", "transmit", "image_map"].contains(&word)
    })
}

/// What the quotes of a scene break of their promise, and how many ways were tried. Quotes of `forms`
/// that were looked into are not again.
fn broken(remains: &mut Remains, forms: &mut HashSet<(Effect, String)>) -> (Vec<String>, usize) {
    let (mut broken, mut tried) = (Vec::new(), 0);
    for (effect, spans) in remains.quotes.clone() {
        let name = format!("{}{}, {effect:?}", remains.name, remains.text.unwrap_or(""));
        let texts = remains.texts(&spans);
        if spans.is_empty() {
            broken.push(format!("{name}: nobody called for it"));
        }
        if is_named(effect) {
            let others = texts.iter().filter(|text| !names(effect, text));
            broken.extend(others.map(|text| format!("{name}: {text:?} does not call for it")));
            continue;
        }
        match remains.without(spans.clone()) {
            _ if spans.is_empty() => {}
            None => broken.push(format!("{name}: broken without {texts:#?}")),
            Some(on) if on.contains(&effect) => {
                broken.push(format!("{name}: on without {texts:#?}"));
            }
            Some(_) => {}
        }
        for (i, (span, text)) in spans.iter().zip(&texts).enumerate() {
            if remains.without(vec![*span]).is_none() && !together(text) {
                broken.push(format!("{name}: broken without {text:?} alone"));
            }
            let mut others = spans.clone();
            others.remove(i);
            let all = forms.insert((effect, form(text)));
            let runs = if all { runs(text) } else { Vec::new() };
            for run in std::iter::once(0..0).chain(runs) {
                let mut less = others.clone();
                if !run.is_empty() {
                    let (start, end) = (span.start + run.start as u32, span.start + run.end as u32);
                    less.push(Span { start, end, ..*span });
                }
                tried += 1;
                let is_on = remains.without(less).is_none_or(|on| on.contains(&effect));
                if !is_on {
                    broken.push(format!("{name}: of {text:?} enough is {:?}", &text[run]));
                }
            }
        }
    }
    (broken, tried)
}

#[test]
fn no_less_than_what_a_line_quotes_ends_its_effect_in_any_scene() {
    let (mut quoted, mut tried, mut all) = (0, 0, Vec::new());
    let mut called_for = BTreeSet::from([Effect::Antialiasing]);
    // By default each way to say it once; all of them, if asked.
    let thorough = std::env::var_os("LUCARNE_LONG").is_some();
    let mut forms = HashSet::new();
    for name in scenes() {
        let mut remains = Remains::of(&name, None);
        for (effect, spans) in &remains.quotes {
            called_for.insert(*effect);
            quoted += spans.len();
        }
        let (broken, ways) = broken(&mut remains, &mut forms);
        tried += ways;
        all.extend(broken);
        if thorough {
            forms.clear();
        }
    }
    assert!(all.is_empty(), "{} are not smallest\n{}", all.len(), all.join("\n"));
    assert!(quoted > 250 && tried > 800, "{quoted} places, {tried} runs");
    assert_eq!(called_for, BTreeSet::from(Effect::ALL), "each effect in some scene");
}

/// What an effect's line quotes in a scene whose lines all hold what they promise.
fn quotes(text: &str, effect: Effect) -> Vec<String> {
    let mut remains = Remains::of("a.scene", Some(text));
    let (broken, _) = broken(&mut remains, &mut HashSet::new());
    assert!(broken.is_empty(), "{text}\n{}", broken.join("\n"));
    let called = remains.quotes.iter().find(|(called, _)| *called == effect);
    called.map_or(Vec::new(), |(_, spans)| remains.texts(spans))
}

/// As [`quotes`], beside a light, a sphere and a camera.
fn lit(text: &str, effect: Effect) -> Vec<String> {
    quotes(&format!("{LIT}{text}"), effect)
}

#[test]
fn of_the_clear_colours_of_a_pigment_the_first_is_quoted() {
    let clear = |pigment: &str| {
        let text = format!("sphere {{ x, 1 pigment {{ {pigment} }} }}");
        let quoted = lit(&text, Effect::Transparency);
        assert_eq!(lit(&text, Effect::ColoredShadows), quoted, "{pigment}");
        quoted
    };
    for color in [
        "rgb 1 transmit 0.5",
        "rgb <1, 1, 0> filter 0.97",
        "color rgb 1 filter 0.5",
        "red 1 transmit 0.5",
        "rgb 1 transmit 1/2 green 0.5",
        "color transmit 0 transmit 0.5",
        "rgbft <1, 1, 1, 0.5, 0.1>",
        "rgbf 1 red 0 filter 0.5",
        "rgb 1 filter 0.5 transmit 0.2",
        "rgb 1 transmit #if (1) 0.5 #else 0 #end red 0",
    ] {
        assert_eq!(clear(color), [color]);
    }
    for (pigment, quote) in [
        ("gradient y color_map { [0 rgbt 1] [1 rgb 1] }", "[0 rgbt 1]"),
        ("gradient y color_map { [0 rgb 1] [1 rgb 0 transmit 0.3] }", "[1 rgb 0 transmit 0.3]"),
        (
            "gradient y color_map { [0, 0.5 color rgb 1 color rgbt 1] [1 rgb 1] }",
            "[0, 0.5 color rgb 1 color rgbt 1]",
        ),
        ("gradient y color_map { [0 rgbt 1] [0.5 rgb 1 transmit 0.5] [1 rgbf 0.5] }", "[0 rgbt 1]"),
        ("gradient y color_map { #for (I, 0.1, 1, 0.3) [I rgbt I] #end }", "[I rgbt I]"),
        ("checker rgb 1, rgbt <1, 0, 0, 1>", "rgbt <1, 0, 0, 1>"),
        ("checker rgb 1 color rgb 0 filter 0.5", "color rgb 0 filter 0.5"),
        ("checker rgb 0.5 pigment { rgb 1 transmit 0.5 }", "rgb 1 transmit 0.5"),
        ("checker rgbt 1, rgb 1 transmit 1", "rgbt 1"),
    ] {
        assert_eq!(clear(pigment), [quote], "{pigment}");
    }
    let replaced = "#declare P = pigment { rgbt 1 };
        sphere { x, 1 pigment { P gradient y color_map { [0 rgbt 1] } } }";
    assert_eq!(lit(replaced, Effect::Transparency), ["[0 rgbt 1]"]);
}

#[test]
fn of_a_declared_colour_its_use_is_quoted_and_of_other_names_what_they_hold() {
    let clear = |text: &str| lit(text, Effect::Transparency);
    let ball = |pigment: &str| format!("sphere {{ x, 1 {pigment} }}");
    let glass = "#declare Glass = rgbt <1, 1, 1, 0.5>; ";
    let of_glass = |pigment: &str| clear(&format!("{glass}{}", ball(pigment)));
    assert_eq!(of_glass("pigment { Glass }"), ["Glass"]);
    assert_eq!(of_glass("pigment { color Glass red 0 }"), ["color Glass red 0"]);
    assert_eq!(of_glass("pigment { rgb Glass*0.5 }"), ["rgb Glass*0.5"]);
    assert_eq!(of_glass("pigment { checker Glass, rgb 1 }"), ["Glass"]);
    let red = "#declare Red = rgb <1, 0, 0>; ";
    let filtered = clear(&format!("{red}{}", ball("pigment { Red filter 0.3 }")));
    assert_eq!(filtered, ["Red filter 0.3"]);
    let filtered = clear(&format!("{red}{}", ball("pigment { color Red transmit .5 }")));
    assert_eq!(filtered, ["color Red transmit .5"]);
    let named = "#declare P = pigment { rgb 1 transmit 0.5 } ";
    assert_eq!(clear(&format!("{named}{}", ball("pigment { P }"))), ["rgb 1 transmit 0.5"]);
    let again = format!("{named}{}", ball("pigment { P rgbt 0.3 }"));
    assert_eq!(clear(&again), ["rgbt 0.3"]);
    let tints = "#declare Tints = color_map { [0 rgb 1 transmit 0.4] [1 rgbt 0.5] } ";
    let tinted = |map: &str| ball(&format!("pigment {{ gradient y color_map {{ {map} }} }}"));
    let entry = ["[0 rgb 1 transmit 0.4]"];
    assert_eq!(clear(&format!("{tints}{}", tinted("Tints"))), entry);
    assert_eq!(clear(&format!("{tints}{}", tinted("[-1 rgb 0] Tints"))), entry);
    // In a macro, where it is defined.
    let tint = "#macro Tint(T) rgb 1 transmit T #end ";
    let calls = format!("{tint}{}", ball("pigment { Tint(0.3) }"));
    assert_eq!(clear(&calls), ["rgb 1 transmit T"]);
    let part = format!("#macro Part() transmit 0.3 #end {}", ball("pigment { rgb 1 Part() }"));
    assert_eq!(clear(&part), ["rgb 1 Part()"]);
    let entry = format!(
        "#macro E(V) #if (V < 1) [V rgbt 1-V] #end #end {}",
        tinted("[-1 rgb 1] E(0) E(0.5)")
    );
    assert_eq!(clear(&entry), ["[V rgbt 1-V]"]);
    // Of equal textures only those whose objects cast shadows colour them.
    let two = "sphere { x, 1 pigment { rgbt 0.5 } no_shadow } sphere { y, 1 pigment { rgbt 1/2 } }";
    assert_eq!(lit(two, Effect::Transparency), ["rgbt 0.5", "rgbt 1/2"]);
    assert_eq!(lit(two, Effect::ColoredShadows), ["rgbt 1/2"]);
}

#[test]
fn of_a_pattern_its_word_is_quoted_with_its_values() {
    let patterned =
        |pigment: &str| lit(&format!("plane {{ y, 0 pigment {{ {pigment} }} }}"), Effect::Patterns);
    for (pigment, quote) in [
        ("checker", "checker"),
        ("checker rgb 1, rgb 0", "checker"),
        ("checker <1, 0, 0>, <1, 0, 0> blue 1", "checker"),
        ("checker rgb 1, pigment { rgb 0.5 }", "checker"),
        ("gradient y scale 3", "gradient y"),
        ("gradient <0, 1, 1> color_map { [0 rgb 0] [1 rgb 1] }", "gradient <0, 1, 1>"),
        ("color_map { [0 rgb 0] [1 rgb 0 blue 1] } gradient y", "gradient y"),
    ] {
        assert_eq!(patterned(pigment), [quote], "{pigment}");
    }
    let dawn = "#declare Dawn = color_map { [0 rgb 0] [1 rgb 1] }
        plane { y, 0 pigment { gradient y color_map { Dawn } } }";
    assert_eq!(lit(dawn, Effect::Patterns), ["gradient y"]);
    let based = "#declare P = pigment { gradient x };
        plane { y, 0 pigment { P scale 2 } } plane { y, -1 pigment { P gradient y } }";
    assert_eq!(lit(based, Effect::Patterns), ["gradient x", "gradient y"]);
    let inside = "#macro Along(D) gradient D #end plane { y, 0 pigment { Along(y) } }";
    assert_eq!(lit(inside, Effect::Patterns), ["gradient D"]);
}

#[test]
fn of_a_light_its_beam_and_one_word_of_its_fading_are_quoted() {
    let faded = |text: &str| lit(text, Effect::Attenuation);
    let beam = "light_source { 9, rgb 1 spotlight radius 9 falloff 20 point_at 0
fade_distance 3 fade_power 2 }";
    assert_eq!(faded(beam), ["spotlight", "fade_distance 3"]);
    let again = "#declare L = light_source { 9, rgb 1 spotlight }; light_source { L cylinder }";
    assert_eq!(faded(again), ["spotlight", "cylinder"]);
    let light = |words: &str| faded(&format!("light_source {{ 9, rgb 1 point_at 0 {words} }}"));
    assert_eq!(light("fade_power 2 fade_distance 3"), ["fade_distance 3"]);
    assert_eq!(
        light("fade_distance 3 fade_distance 0 fade_power 2 fade_distance 5"),
        ["fade_distance 5"]
    );
    assert_eq!(light("spotlight parallel cylinder"), ["cylinder"]);
    assert_eq!(light("spotlight cylinder"), ["spotlight", "cylinder"]);
    let shared = "#declare L = light_source { 9, rgb 1 fade_power 2 fade_distance 3 }
light_source { L } light_source { L fade_distance 5 } light_source { L fade_power 1 }";
    assert_eq!(faded(shared), ["fade_distance 3"]);
    let both = "#declare L = light_source { 9, rgb 1 fade_power 2 fade_distance 3 }
light_source { L fade_distance 5 fade_power 1 }";
    assert_eq!(faded(both), ["fade_distance 3", "fade_distance 5"]);
}

#[test]
fn of_a_filling_each_index_that_would_bend_is_quoted() {
    let bent = |text: &str| lit(text, Effect::Refraction);
    let glass = "#declare Glass = interior { ior 1.3 };
sphere { x, 1 pigment { rgbt 1 } interior { Glass ior 1.5 } } sphere { x, 1 interior { ior 1 } }";
    assert_eq!(bent(glass), ["ior 1.3", "ior 1.5"]);
    let ball = |words: &str| bent(&format!("sphere {{ x, 1 pigment {{ rgbt 1 }} {words} }}"));
    assert_eq!(ball("finish { ior 1.5 }"), ["ior 1.5"]);
    assert_eq!(ball("interior { ior 1.5 ior 1 ior 1.2 }"), ["ior 1.2"]);
    assert_eq!(ball("finish { ior 1.5 ior 1 ior 1.2 }"), ["ior 1.2"]);
    assert_eq!(ball("interior { ior 1.3 } finish { ior 1.5 }"), ["ior 1.3", "ior 1.5"]);
    assert_eq!(ball("material { interior { ior 1.3 } }"), ["ior 1.3"]);
    // Of what no light goes into none is quoted, even where it is filled alike, or otherwise.
    for other in ["1.5", "1.3"] {
        let opaque = format!(
            "sphere {{ x, 1 pigment {{ rgbt 1 }} interior {{ ior 1.50 }} }}
sphere {{ y, 1 interior {{ ior {other} }} }}"
        );
        assert_eq!(bent(&opaque), ["ior 1.50"]);
    }
}

#[test]
fn of_a_finish_what_reflects_or_shines_is_quoted() {
    let mirrored =
        |finish: &str| lit(&format!("sphere {{ x, 1 finish {{ {finish} }} }}"), Effect::Reflection);
    for (finish, quote) in [
        ("reflection 0.3", "reflection 0.3"),
        ("reflection { 0.1, 1 falloff 2 }", "reflection { 0.1, 1 falloff 2 }"),
        ("reflection { 0, 0.8 fresnel }", "0.8"),
        ("reflection { 0 rgb <1, 0, 0> }", "rgb <1, 0, 0>"),
        ("reflection { 0.5, 0 }", "0.5"),
        ("reflection { 0.8 fresnel on }", "reflection { 0.8 fresnel on }"),
        ("reflection rgb 0 red 0.5", "red 0.5"),
        ("reflection 0.3 reflection 0 reflection 0.5", "reflection 0.5"),
        ("reflection 0.3 reflection { 0, 1 }", "1"),
    ] {
        assert_eq!(mirrored(finish), [quote], "{finish}");
    }
    let shining =
        |finish: &str| lit(&format!("sphere {{ x, 1 finish {{ {finish} }} }}"), Effect::Highlights);
    assert_eq!(shining("phong 1 phong_size 9 specular 0"), ["phong 1"]);
    assert_eq!(shining("phong 1 specular 0.5 phong 0 roughness 0.1"), ["specular 0.5"]);
    assert_eq!(shining("phong albedo 0.4 phong 0.5"), ["phong albedo 0.4", "phong 0.5"]);
    assert_eq!(shining("phong 1 phong 0 phong 0.5"), ["phong 0.5"]);
}

#[test]
fn of_a_sky_its_pigments_are_quoted() {
    let skies = "sky_sphere { pigment { rgb 1 } pigment { gradient y } rotate x }";
    assert_eq!(quotes(skies, Effect::Sky), ["pigment { rgb 1 }", "pigment { gradient y }"]);
    assert_eq!(quotes(skies, Effect::Patterns), ["gradient y"]);
    let folded = "sky_sphere { pigment { checker rgb 1 rgb 1 } pigment { gradient y } }";
    assert_eq!(quotes(folded, Effect::Patterns), ["gradient y"]);
    let skies = "sky_sphere { pigment { rgb 1 } } sky_sphere { pigment { rgb 0.5 } }";
    assert_eq!(quotes(skies, Effect::Sky), ["pigment { rgb 0.5 }"], "the last sky counts");
}

#[test]
fn a_light_is_quoted_as_what_could_be_taken_out() {
    let shadows = |text: &str| quotes(&format!("sphere {{ 0, 1 }} {text}"), Effect::Shadows);
    let lamp = "light_source { 9, rgb 1 }";
    assert_eq!(shadows(lamp), [lamp]);
    assert_eq!(shadows(&format!("#declare L = {lamp} object {{ L }}")), ["object { L }"]);
    let moved = "light_source { L translate x }";
    assert_eq!(shadows(&format!("#declare L = {lamp} {moved}")), [moved]);
    let red = |color: &str| shadows(&format!("light_source {{ 9, color {color} }}"));
    assert_eq!(red("red 1 green 0"), ["red 1"]);
    assert_eq!(red("rgb 1 green 0"), ["rgb 1"]);
    assert_eq!(red("red 1 green 1"), ["light_source { 9, color red 1 green 1 }"]);
    let shared = format!("#declare U = union {{ {lamp} }} object {{ U }} object {{ U scale 2 }}");
    assert_eq!(shadows(&shared), [lamp]);
    let inner = format!("object {{ {lamp} translate y }}");
    assert_eq!(shadows(&inner), [inner.as_str()]);
    assert_eq!(shadows(&format!("#macro M() {lamp} #end M() M()")), [lamp]);
    let value = format!("#macro M() {lamp} #end object {{ M() }}");
    assert_eq!(shadows(&value), ["object { M() }"]);
    assert_eq!(shadows(&format!("#for (I, 1, 3) {lamp} #end")), [lamp]);
    assert_eq!(shadows(&format!("{lamp} light_source {{ 5, rgb 0 }}")), [lamp]);
    let opened = "#macro Open() light_source { #end #macro Close() } #end Open() 9, rgb 1 Close()";
    assert_eq!(shadows(opened), ["Open() 9, rgb 1 Close()"]);
    let switched = "light_source { 9, #if (1) rgb 1 #else rgb 2 #end }";
    assert_eq!(shadows(switched), [switched]);
}

#[test]
fn what_hides_an_object_is_quoted_where_it_holds_for_one() {
    let hidden = |text: &str| quotes(&format!("{LIT}{text}"), Effect::Hiding);
    let both = "sphere { x, 1 no_image no_reflection }";
    assert_eq!(hidden(both), ["no_image", "no_reflection"]);
    let twice = "#declare S = sphere { x, 1 no_image }; object { S no_image off no_image on }";
    assert_eq!(hidden(twice), ["no_image on"], "what was undone stays so");
    let again = "#declare S = sphere { x, 1 no_image }; object { S no_image }";
    assert_eq!(hidden(again), ["no_image", "no_image"]);
    let nested = "union { union { sphere { x, 1 no_image } } no_image }";
    assert_eq!(hidden(nested), ["no_image", "no_image"]);
    for nothing in [
        "union { light_source { 9, rgb 1 } no_image }",
        "union { no_image }",
        "#declare S = sphere { x, 1 no_image }; object { S no_image off }",
        "sphere { x, 1 no_image no_image off }",
    ] {
        let seen = see_text(&format!("{LIT}{nothing}"));
        assert_eq!(seen.errors, "", "{nothing}");
        assert!(!seen.plan.simulates(Effect::Hiding), "{nothing}");
    }
}

#[test]
fn what_would_show_again_is_quoted_too() {
    let mirrored = |text: &str| quotes(&format!("{LIT}{text}"), Effect::Reflection);
    let over = "#declare F = finish { reflection 0.3 }
sphere { x, 1 finish { F reflection 0.5 } }";
    assert_eq!(mirrored(over), ["reflection 0.3", "reflection 0.5"]);
    let default = "#default { finish { reflection 0.1 } } sphere { 0, 1 finish { phong 1 } }";
    assert_eq!(mirrored(default), ["reflection 0.1"]);
    let erased = "#declare F = finish { reflection 0.3 }
sphere { x, 1 finish { F reflection 0 } } sphere { y, 1 finish { reflection 0.7 } }";
    assert_eq!(mirrored(erased), ["reflection 0.7"]);
    // Equal finishes are one material, and are quoted wherever they stand.
    let twice =
        "sphere { x, 1 finish { reflection 0.5 } } sphere { y, 1 finish { reflection 1/2 } }";
    assert_eq!(mirrored(twice), ["reflection 0.5", "reflection 1/2"]);
}

#[test]
fn the_seeds_words_are_quoted_together_or_where_one_is_changed() {
    let mirrored = |text: &str| quotes(&format!("{LIT}{text}"), Effect::Reflection);
    let three = "kd 0.5 ks 0.6 phong_exponent 60";
    assert_eq!(mirrored(&format!("sphere {{ x, 1 finish {{ {three} }} }}")), [three]);
    let changed =
        format!("#declare F = finish {{ {three} }} sphere {{ x, 1 finish {{ F ks 0.2 }} }}");
    // A lone `ks` needs the other two, so only both pieces can be taken out.
    assert_eq!(mirrored(&changed), [three, "ks 0.2"]);
    let dull = "#declare F = finish { kd 0.5 ks 0 phong_exponent 60 } sphere { x, 1 finish { F ";
    assert_eq!(mirrored(&format!("{dull} kd 1 ks 0.2 phong_exponent 9 }} }}")), ["ks 0.2"]);
    let twice = "} } #declare G = finish { F ks 0.3 } sphere { x, 1 finish { G kd 1 ks 0.2 } }";
    assert_eq!(mirrored(&format!("{dull}{twice}")), ["ks 0.3", "ks 0.2"]);
}

#[test]
fn a_directive_amid_an_item_is_quoted_with_it() {
    let mirrored = |text: &str| quotes(&format!("{LIT}{text}"), Effect::Reflection);
    let amid = "sphere { x, 1 finish { reflection #if (1) 0.3 #else 0.5 #end } }";
    assert_eq!(mirrored(amid), ["reflection #if (1) 0.3 #else 0.5 #end"]);
    let among =
        "sphere { x, 1 finish { phong 1 #if (1) reflection #if (1) 0.3 #end diffuse 1 #end } }";
    assert_eq!(mirrored(among), ["reflection #if (1) 0.3 #end"]);
    let within =
        "#macro M() phong 1 reflection #if (1) 0.3 #end #end sphere { x, 1 finish { M() } }";
    assert_eq!(mirrored(within), ["reflection #if (1) 0.3 #end"]);
    let around = "sphere { x, 1 finish { #if (1) reflection 0.3 #else reflection 0.5 #end } }";
    assert_eq!(mirrored(around), ["reflection 0.3"]);
    let macros = "#macro Word() reflection #end #macro Weight() 0.25 #end
sphere { x, 1 finish { Word() Weight()*2 } } sphere { y, 1 finish { reflection Weight() } }";
    assert_eq!(mirrored(macros), ["Word() Weight()*2", "reflection Weight()"]);
}
