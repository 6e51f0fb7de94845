//! Solids a hundred thousand operations deep: from their text to their picture, on a small stack.

use std::time::Duration;

use lucarne::plan::{Antialias, Frame, PlanOptions, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;
use lucarne::trace::{TraceOptions, Unwatched, trace};

use super::trees::processor_time;

const LEVELS: usize = 100_000;
/// No more than this is on the call stack, whatever the depth.
const STACK: usize = 512 * 1024;

const HEAD: &str = "camera { location <0, 1, 4> look_at 0 }
    light_source { <3, 5, 4>, rgb 1 }
    background { rgb <0.2, 0.3, 0.5> }
    #default { pigment { rgb <1, 0.5, 0.2> } }
    ";
const CORE: &str = "sphere { 0, 1 }";
/// What may be put around a solid within 1 of the origin and changes nothing of it.
const AROUND: [(&str, &str); 5] = [
    ("difference {", "sphere { 9*x, 1 } }"),
    ("intersection {", "sphere { 0, 9 } }"),
    ("merge {", "sphere { 0, 0.1 } }"),
    ("union {", "sphere { 0, 0.1 } }"),
    ("object {", "inverse }"),
];

/// The picture of a text, and the time it took.
fn pictured(text: String) -> (Vec<[f64; 3]>, Duration) {
    let work = move || {
        let start = processor_time();
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let (world, origins) = road.compile("deep.scene", text.into_bytes());
        assert!(!road.diagnostics.has_errors(), "{:#?}", road.diagnostics.iter().next());
        let frame = Frame::whole(12, 9);
        let options = PlanOptions { antialias: Antialias::Off, ..PlanOptions::new(frame) };
        let plan = plan(&world, &origins, &options);
        let film = trace(&world, &plan, &TraceOptions::on_threads(1), &Unwatched).film;
        let colors = film.radiances().map(|color| color.components()).collect();
        drop((world, origins, road));
        (colors, processor_time() - start)
    };
    let small = std::thread::Builder::new().stack_size(STACK);
    small.spawn(work).expect("a thread").join().expect("as on a large stack")
}

/// The core inside of so many levels of what `around` says in turn.
fn nested(around: &[(&str, &str)], levels: usize) -> String {
    let of = |level: usize| around[level % around.len()];
    let before: String = (0..levels).rev().map(|level| of(level).0).collect();
    let behind: String = (0..levels).map(|level| of(level).1).collect();
    format!("{HEAD}{before}{CORE}{behind}")
}

/// The same, each level a declaration of its own.
fn declared(around: &[(&str, &str)], levels: usize) -> String {
    let turn: String = around
        .iter()
        .map(|(before, behind)| format!("#declare A = {before} object {{ A }} {behind}\n"))
        .collect();
    let turns = levels / around.len();
    format!("{HEAD}#declare A = {CORE}\n#for (I, 1, {turns}) {turn} #end object {{ A }}")
}

#[track_caller]
fn assert_deep(name: &str, text: impl Fn(usize) -> String) {
    let (core, _) = pictured(format!("{HEAD}{CORE}"));
    let (_, tenth) = pictured(text(LEVELS / 10));
    let (deep, time) = pictured(text(LEVELS));
    println!("{name}: {tenth:?} {time:?}");
    assert_eq!(deep, core, "{name}");
    // About ten times as long: nothing is gone through again at each level.
    let limit = tenth.max(Duration::from_millis(100)) * 25;
    assert!(time < limit, "{name}: {time:?} for {LEVELS} levels, {tenth:?} for a tenth");
}

#[test]
fn a_hundred_thousand_levels_of_any_operation_are_drawn_on_a_small_stack() {
    for around in AROUND {
        assert_deep(around.0, |levels| nested(&[around], levels));
    }
}

#[test]
fn a_hundred_thousand_levels_of_all_operations_in_turn_are_drawn_on_a_small_stack() {
    // Twice, so that each second turn undoes the inverse of the first.
    let twice = [AROUND.as_slice(), &AROUND].concat();
    let kept: Vec<_> = twice.into_iter().filter(|(word, _)| *word != "object {").collect();
    assert_deep("all in turn", |levels| nested(&kept, levels));
}

#[test]
fn a_hundred_thousand_declarations_around_one_another_are_drawn_on_a_small_stack() {
    assert_deep("declared", |levels| declared(&AROUND[..4], levels));
    assert_deep("declared, inside out", |levels| declared(&AROUND[4..], levels));
}
