//! What is said of a broken scene, word for word, and of a right one: nothing.
//!
//! `diagnostics/*.scene` hold broken scenes by topic, in the form of `corpus/mod.rs`. In a title, `(pov)` reads
//! the scene as a `.pov` file.

use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::mend::{apply, mend};
use lucarne::diagnostic::render::{Style, human};
use lucarne::diagnostic::{Code, Diagnostic, Level, Levels, Severity};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::{FileError, Files, Found, Sources, Span};

use crate::corpus::{Case, Expected, Includes, assert_none, said, shown};

/// Runs a scene as `lucarne check` does, with lints.
fn messages(name: &str, bytes: Vec<u8>, files: &Includes) -> (Vec<Diagnostic>, Sources) {
    let dialect = lucarne::road::dialect(name);
    let mut options = Options::new(dialect);
    // A loop that would turn for minutes tells nothing more than a shorter one.
    options.evaluate.limits.loop_turns = 1_000_000;
    options.levels = Levels::new(true);
    options.levels.set(Code::CoincidingFaces, Level::Warn);
    let mut road = Road::new(files, options);
    road.compile(name, bytes);
    (road.diagnostics.iter().cloned().collect(), road.sources)
}

fn corpus() -> Vec<Case> {
    crate::corpus::corpus("diagnostics")
}

fn name(case: &Case) -> &'static str {
    if case.title.contains("(pov)") { "main.pov" } else { "main.scene" }
}

/// Why a case fails; empty when it does not.
fn failures(case: &Case) -> String {
    let (found, sources) = messages(name(case), case.bytes(&case.scene), &case.files());
    // The cases leave pigments out where they are not about them.
    let about_pigments = case.expected.iter().any(|wanted| wanted.code == Code::NoPigment.name());
    let found = found.iter().filter(|one| one.code != Code::NoPigment || about_pigments);
    let found: Vec<Expected> = found.map(|one| said(one, &sources)).collect();
    case.report(&case.mismatches(found))
}

#[test]
fn every_broken_scene_is_told_what_is_wrong_with_it_and_nothing_else() {
    let corpus = corpus();
    assert!(corpus.len() >= 80, "{} cases", corpus.len());
    assert_none(corpus.iter().map(failures));
}

/// What is wrong with the fix of each message of a case.
fn bad_fixes(case: &Case) -> String {
    let Ok(text) = String::from_utf8(case.bytes(&case.scene)) else { return String::new() };
    let text = text.trim_start_matches('\u{feff}');
    let files = case.files();
    let run = |text: &str| messages(name(case), text.as_bytes().to_vec(), &files).0;
    let weight = |found: &[Diagnostic]| {
        let errors = found.iter().filter(|one| one.severity == Severity::Error).count();
        // Where an error goes, lints of the whole scene may come.
        (errors, found.len())
    };
    let before = run(text);
    let mut wrong = String::new();
    for one in &before {
        let (fixed, used) = apply(text, std::iter::once(one));
        if used.is_empty() {
            continue;
        }
        let after = run(&fixed);
        let said_before = |other: &&Diagnostic| {
            other.severity == Severity::Error
                && before.iter().all(|old| (old.code, &old.message) != (other.code, &other.message))
        };
        let new: Vec<&str> =
            after.iter().filter(said_before).map(|other| other.message.as_str()).collect();
        // A missing closer may hide other mistakes, and they are told once it stands.
        // So may a name in other quotes: whether there is such a file.
        // A misspelt directive hides what it does.
        let hides = one.code.shifts_what_follows()
            || one.code == Code::UnknownDirective
            // Of a scene it might have declared any name.
            || one.code == Code::ForeignFile
            || after.iter().any(|other| other.code == Code::MissingInclude);
        // And the block of a misspelt word.
        let end = one.fixes.iter().map(|fix| fix.span.end as usize).max().unwrap_or(0);
        let opens = text[end..].trim_start().starts_with('{');
        let hides = hides || (opens && matches!(one.code, Code::UnknownWord | Code::ForeignWord));
        let fewer = weight(&after) < weight(&before);
        if !hides && (!fewer || !new.is_empty()) {
            let message = &one.message;
            wrong += &format!("  ! the fix of `{message}` gives {new:?}:\n{fixed}\n");
        }
    }
    if let Some((mended, _)) = mend(text, run)
        && let Some((again, _)) = mend(&mended, run)
    {
        wrong += &format!("  ! mending twice goes on: {again}\n");
    }
    case.report(&wrong)
}

#[test]
fn a_fix_leaves_fewer_messages_and_none_new_and_mending_again_changes_nothing() {
    assert_none(corpus().iter().map(bad_fixes));
}

/// What stands on a screen: a report without the codes that colour it.
fn uncoloured(text: &str) -> String {
    let mut parts = text.split('\u{1b}');
    let first = parts.next().unwrap_or("").to_owned();
    parts.fold(first, |seen, part| seen + part.split_once('m').map_or(part, |(_, rest)| rest))
}

/// The columns of a screen that a line fills, each with its character.
fn screen(line: &str) -> Vec<char> {
    let columns = |c: char| unicode_width::UnicodeWidthChar::width(c).unwrap_or(8);
    line.chars().flat_map(|c| std::iter::repeat_n(c, columns(c))).collect()
}

/// Whether one of the lines drawn shows the place of a label over what is drawn below it.
fn is_underlined(span: Span, sources: &Sources, lines: &[&str]) -> bool {
    let source = sources.get(span.file);
    let number = source.position(span.start as usize).line.to_string();
    let marked = sources.text(span).replace(['\t', ' '], "");
    let marked = marked.replace('\u{200d}', "‹U+200D›").replace('\u{fe0f}', "‹U+FE0F›");
    lines.windows(2).any(|pair| {
        let row = pair[0].split_once(" │").filter(|(left, _)| left.trim() == number);
        let (Some(_), true) = (row, pair[1].contains(['─', '┬', '▲'])) else { return false };
        let (text, below) = (screen(pair[0]), screen(pair[1]));
        let over: Vec<String> = below
            .iter()
            .enumerate()
            .skip_while(|(_, c)| **c != '·')
            .skip(1)
            .map(|(at, c)| (text.get(at).copied().unwrap_or(' '), matches!(c, '─' | '┬' | '▲')))
            .collect::<Vec<_>>()
            .split(|(_, marks)| !marks)
            .filter(|run| !run.is_empty())
            .map(|run| run.iter().map(|(c, _)| *c).filter(|c| *c != ' ').collect())
            .collect();
        let whole: String = screen(&marked).into_iter().collect();
        over.iter().any(|over| {
            let begun = over.trim_end_matches('…');
            over.contains(&whole)
                || (pair[0].contains('…') && !begun.is_empty() && whole.contains(begun))
        })
    })
}

/// What is wrong with how a message is drawn, in windows of two widths, with and without colour.
fn bad_drawing(one: &Diagnostic, sources: &Sources) -> String {
    let mut wrong = String::new();
    for width in [80, 60] {
        let plain = human(one, sources, Style { width, color: false });
        let coloured = uncoloured(&human(one, sources, Style { width, color: true }));
        for line in plain.lines().filter(|line| screen(line).len() > width) {
            wrong += &format!("  ! {} of {width} columns: {line}\n", screen(line).len());
        }
        if plain != coloured {
            wrong += &format!("  ! colour moves what it colours:\n{plain}{coloured}");
        }
        let lines: Vec<&str> = plain.lines().collect();
        for label in &one.labels {
            let text = sources.text(label.span);
            let seen = text.chars().all(|c| !c.is_control() || c == '\t');
            if seen && !is_underlined(label.span, sources, &lines) {
                wrong += &format!("  ! `{text}` is not underlined:\n{plain}");
            }
        }
    }
    wrong
}

/// Scenes whose lines, words and names do not fit into a window, each with a mistake.
fn wide_cases() -> Vec<(String, String)> {
    let named = |name: &str, scene: String| (name.to_owned(), scene);
    let folder = "a folder with a long name/and another one in it/".repeat(3);
    let row = "sphere { <0, 1, 0>, 2 } ".repeat(9);
    let word = "Pigment".repeat(30);
    let blocks: String = (0..40).map(|i| format!("union {{ // {i}\n")).collect();
    vec![
        named("a.scene", format!("{row}shpere {{ 0, 1 }} {row}")),
        named("a.scene", format!("{}\n{row}\nshpere {{ 0, 1 }}\n{row}", "\n".repeat(123_455))),
        named("a.scene", format!("{row}sphere {{ 0, 1 pigment {{ rgb 1 }} pigmnt {{ rgb 1 }} }}")),
        named("a.scene", format!("sphere {{ 0, 1 {word} {{ rgb 1 }} }}")),
        named("a.scene", format!("#declare {word} = 1; sphere {{ 0, {word}s }}")),
        named("a.scene", format!("{}shpere {{ 0, 1 }}", "\t".repeat(30))),
        named("a.scene", "\tsphere\t{\t0,\t1\t}\tshpere\t{ 0, 1 }".to_owned()),
        named(
            "a.scene",
            format!("/* {} */ shpere {{ 0, 1 }} // {}", "球".repeat(40), "球".repeat(40)),
        ),
        named(
            "a.scene",
            format!("/* {} */ shpere {{ 0, 1 }}", "é👩\u{200d}🚀❤\u{fe0f}e\u{301}".repeat(20)),
        ),
        named("a.scene", format!("#error \"{}\"", "球と円柱と".repeat(30))),
        named("a.scene", format!("#error \"{}\"", "a\tb\tlong ".repeat(30))),
        named("a.scene", format!("#warning \"{}\"", "x".repeat(300))),
        named("a.scene", format!("#include \"{folder}b.inc\"")),
        named(&format!("{folder}c.scene"), "shpere { 0, 1 }".to_owned()),
        named(&format!("{folder}d.scene"), "sphere { 0, 1 pigment { rgb 1 } }".to_owned()),
        named(&format!("{}.scene", "球".repeat(60)), "shpere { 0, 1 }".to_owned()),
        named("a.scene", blocks),
        named(
            "a.scene",
            format!(
                "{}#macro A(B) sphere {{ 0, B }} #end {}A(1, 2)",
                " ".repeat(30),
                " ".repeat(20)
            ),
        ),
        named("a.scene", format!("sphere {{ 0, 1{}", " ".repeat(90))),
    ]
}

#[test]
fn no_message_is_wider_than_its_window_and_each_label_is_under_its_text() {
    let mut wrong = Vec::new();
    let mut look = |title: String, (found, sources): (Vec<Diagnostic>, Sources)| {
        let bad: String = found.iter().map(|one| bad_drawing(one, &sources)).collect();
        if !bad.is_empty() {
            wrong.push(format!("{title}\n{bad}"));
        }
    };
    for case in corpus() {
        let title = format!("{}:{} {}", case.file, case.line, case.title);
        look(title, messages(name(&case), case.bytes(&case.scene), &case.files()));
    }
    for (at, (name, scene)) in wide_cases().into_iter().enumerate() {
        look(format!("wide case {at}"), messages(&name, scene.into_bytes(), &Includes::default()));
    }
    assert!(wrong.is_empty(), "{} cases\n{}", wrong.len(), wrong.concat());
}

fn scenes_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            scenes_below(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "scene") {
            found.push(path);
        }
    }
}

/// The files beside a scene, and those that are built in.
struct Beside(PathBuf);

impl Files for Beside {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        match (fs::read(self.0.join(name)), lucarne::standard::include(name)) {
            (Ok(bytes), _) => Ok(Found { name: name.to_owned(), bytes }),
            (_, Some((name, text))) => Ok(Found { name, bytes: text.as_bytes().to_vec() }),
            (Err(error), _) => Err(FileError::Unreadable(error.to_string())),
        }
    }
}

#[test]
fn a_right_scene_gets_no_message() {
    let mut paths = Vec::new();
    scenes_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes"), &mut paths);
    paths.sort();
    assert!(paths.len() > 50);
    for path in paths {
        let files = Beside(path.parent().expect("a folder").to_owned());
        let mut road = Road::new(&files, Options::new(Dialect::Scene));
        road.compile("a.scene", fs::read(&path).expect("readable"));
        // What the author prints is the author's.
        let found: Vec<String> = road
            .diagnostics
            .iter()
            .filter(|one| !one.code.name().starts_with("author"))
            .map(|one| shown(&said(one, &road.sources)))
            .collect();
        assert!(found.is_empty(), "{}: {found:#?}", path.display());
    }
}

/// Scenes to break: much of the language in few lines.
const WHOLE: [&str; 3] = [
    "#declare A = 2; #macro Ball(P, R) sphere { P, R texture { Paint } } #end
     #declare Paint = texture { pigment { checker rgb <1, 0, 0>, color rgb 1 } finish { phong .5 } }
     camera { location <0, 1, 5> look_at 0 angle 40 } light_source { <4, 8, 6>, rgb 1 }
     #for (I, 1, A) Ball(<I, 0, 0>, .5 + I/4) #end
     union { box { -1, 1 rotate <0, 45, 0> } object { Ball(0, 1) scale <-1, 1, 1> } no_shadow }",
    "#local T = transform { rotate 30*y translate <1, 2, 3> inverse } #switch (3) #case (1) #break
     #range (2, 4) plane { y, -1 pigment { gradient x color_map { [0 rgb 0] [1 rgb <1, .5, 0>] } } }
     #else #error \"no\" #end #while (0) #end
     sphere { 0, (1 > 0 ? 1 : 2) transform { T } finish { kd .5 ks .5 phong_exponent 5 } }",
    "global_settings { ambient_light rgb 1 max_trace_level 5 } background { color rgb <.1, .2, .3> }
     #ifndef (X) #declare X = concat(\"a\", str(3, 0, 2)); #end #debug X
     sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb <0, 0, 1>] } } }
     #declare V = <1, 2, 3> * 2 - y; sphere { V, vlength(V)/4 matrix <1,0,0,0,1,0,0,0,1,0,0,0> }",
];

/// Words, numbers and signs, with the blanks between them.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    for c in text.chars() {
        let joins = |last: &String| {
            let before = last.chars().next_back();
            let word = |c: char| c.is_alphanumeric() || c == '_';
            before.is_some_and(|before| word(before) == word(c) && (word(c) || c.is_whitespace()))
        };
        match tokens.last_mut().filter(|last| joins(last)) {
            Some(last) => last.push(c),
            None => tokens.push(c.to_string()),
        }
    }
    tokens
}

/// Compiles a text and looks at every place that is spoken of.
fn survives(text: &str) {
    let (found, sources) = messages("a.scene", text.as_bytes().to_vec(), &Includes::default());
    for one in &found {
        let spans = one.labels.iter().map(|label| label.span);
        let spans = spans.chain(one.fixes.iter().map(|fix| fix.span));
        for span in spans.chain(one.trace.iter().map(|step| step.span)) {
            let whole = &sources.get(span.file).text;
            assert!(span.start <= span.end, "{one:?} in {text}");
            assert!(whole.get(span.range()).is_some(), "{one:?} in {text}");
        }
    }
}

#[test]
fn every_beginning_of_a_scene_is_read_without_a_panic() {
    for text in WHOLE {
        (0..text.len())
            .filter(|&end| text.is_char_boundary(end))
            .for_each(|end| survives(&text[..end]));
    }
}

#[test]
fn scenes_with_parts_left_out_doubled_or_swapped_are_read_without_a_panic() {
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for text in WHOLE {
        for _ in 0..400 {
            let mut tokens = tokens(text);
            for _ in 0..=random(3) {
                let (one, other) = (random(tokens.len()), random(tokens.len()));
                match random(3) {
                    0 => drop(tokens.remove(one)),
                    1 => tokens.insert(other, tokens[one].clone()),
                    _ => tokens.swap(one, other),
                }
            }
            survives(&tokens.concat());
        }
    }
}

/// What is said of a text, as places and codes.
fn told(text: &str) -> Vec<String> {
    let (found, sources) = messages("a.scene", text.as_bytes().to_vec(), &Includes::default());
    found
        .iter()
        .map(|one| said(one, &sources))
        .map(|one| format!("{} {}", one.place, one.code))
        .collect()
}

#[test]
fn one_huge_line_is_told_its_column() {
    let line = "sphere { 0, 1 } ".repeat(20_000);
    assert_eq!(told(&format!("{line}shpere {{ 0, 1 }}")), ["1:320001 unknown-word"]);
}

#[test]
fn brackets_beyond_the_limit_are_one_mistake() {
    for open in ["{", "[", "(", "<", "union {", "#if (1) ", "{[(<"] {
        let found = told(&open.repeat(200_001));
        assert_eq!(found.len(), 1, "{open}: {found:?}");
        assert!(found[0].ends_with(" nesting-limit"), "{open}: {found:?}");
    }
}

/// Scenes that would never end, or not in this machine's memory.
const ENDLESS: [&str; 10] = [
    "#while (1) sphere { 0, 1 } #end",
    "#while (1) #end",
    "#declare I = 0; #while (I < 1) sphere { I, 1 } #end",
    "#declare I = 0; #while (I < 1) #declare J = I; #end",
    "#for (I, 0, 1e12) sphere { I, 1 pigment { rgb 1 } translate x } #end",
    "#for (I, 1, 1000000) #for (J, 1, 1000000) #end #end",
    "#macro F(N) sphere { 0, 1 } F(N) #end F(1)",
    "#macro F(N) G(N) #end #macro G(N) F(N) #end F(1)",
    "#macro F(N) (1 + F(N)) #end sphere { 0, F(1) }",
    "#include \"endless.scene\"",
];

#[test]
fn what_would_never_end_is_stopped_soon_with_one_message_and_code_four() {
    for text in ENDLESS {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("endless.scene"), text).expect("written");
        let start = std::time::Instant::now();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_lucarne"))
            .args(["check", "--message-format", "short", "--limit", "loop-turns=1000000"])
            .arg("endless.scene")
            .current_dir(folder.path())
            .output()
            .expect("runs");
        let messages = String::from_utf8_lossy(&output.stderr).into_owned();
        let circular = text.contains("#include");
        assert_eq!(output.status.code(), Some(if circular { 1 } else { 4 }), "{text}: {messages}");
        assert_eq!(messages.lines().count(), 1, "{text}: {messages}");
        // Far more than it takes, for a machine that does other things too.
        assert!(start.elapsed().as_secs() < 20, "{text}: {:?}", start.elapsed());
    }
}
