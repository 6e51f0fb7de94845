//! Messages as they are drawn.

use super::*;
use crate::diagnostic::{Code, TraceStep};
use crate::source::Source;

fn one_file(name: &str, text: &str) -> (Sources, FileId) {
    let mut sources = Sources::default();
    let file = sources.add(Source::new(name, text));
    (sources, file)
}

fn find(sources: &Sources, file: FileId, text: &str) -> Span {
    let start = sources.get(file).text.find(text).expect("in the text");
    Span::new(file, start, start + text.len())
}

#[test]
fn a_message_shows_its_line_its_hint_and_nothing_else() {
    let (sources, file) = one_file("a.scene", "a\nb\nc\nsphere {\n\tpigmnt { }\n}\nd\ne\n");
    let word = find(&sources, file, "pigmnt");
    let diagnostic = Diagnostic::new(Code::UnknownWord, "unknown word `pigmnt`")
        .at(word, "not known in a `sphere`")
        .also(find(&sources, file, "sphere"), "this block")
        .help("did you mean `pigment`?")
        .fix(word, "pigment");
    let text = human(&diagnostic, &sources, Style::PLAIN);
    insta::assert_snapshot!(text, @r#"
    unknown-word

      × unknown word `pigmnt`
       ╭─[a.scene:5:2]
     3 │ c
     4 │ sphere {
       · ───┬──
       ·    ╰── this block
     5 │     pigmnt { }
       ·     ───┬──
       ·        ╰── not known in a `sphere`
     6 │ }
       ╰────
      help: did you mean `pigment`?
    "#);
    assert_eq!(
        short(&diagnostic, &sources),
        "a.scene:5:2: error[unknown-word]: unknown word `pigmnt`"
    );
}

#[test]
fn a_message_crosses_files_and_shows_the_calls() {
    let mut sources = Sources::default();
    let main = sources.add(Source::new("a.scene", "#include \"lamp.inc\"\n\n\n\n\n\nLamp(0)\n"));
    let lamp = sources.add(Source::new("lamp.inc", "#macro Lamp(S)\n  sphere { 0, S }\n#end\n"));
    let mut diagnostic = Diagnostic::new(Code::ZeroSize, "the sphere has radius 0, and needs more")
        .at(find(&sources, lamp, "S }"), "this is 0");
    for (span, text) in [("Lamp(0)", "in this call of macro `Lamp`"), ("#incl", "included here")] {
        let step = TraceStep { span: find(&sources, main, span), text: text.into() };
        diagnostic.trace.push(step);
    }
    insta::assert_snapshot!(human(&diagnostic, &sources, Style::PLAIN), @r#"
    zero-size

      × the sphere has radius 0, and needs more
       ╭─[lamp.inc:2:15]
     1 │ #macro Lamp(S)
     2 │   sphere { 0, S }
       ·               ─┬─
       ·                ╰── this is 0
     3 │ #end
       ╰────
       ╭─[a.scene:1:1]
     1 │ #include "lamp.inc"
       · ──┬──
       ·   ╰── included here
       ╰────
       ╭─[a.scene:7:1]
     7 │ Lamp(0)
       · ───┬───
       ·    ╰── in this call of macro `Lamp`
       ╰────
    "#);
}

#[test]
fn a_deep_recursion_shows_its_ends() {
    let (sources, file) = one_file("a.scene", "#macro A() A() #end\nA()\n");
    let mut diagnostic = Diagnostic::new(Code::MacroLimit, "macros call each other too deep")
        .at(Span::new(file, 11, 14), "this call");
    for _ in 0..99 {
        let step = TraceStep { span: Span::new(file, 11, 14), text: "in this call of `A`".into() };
        diagnostic.trace.push(step);
    }
    let step = TraceStep { span: Span::new(file, 20, 23), text: "in this call of `A`".into() };
    diagnostic.trace.push(step);
    insta::assert_snapshot!(human(&diagnostic, &sources, Style::PLAIN), @r#"
    macro-limit

      × macros call each other too deep
       ╭─[a.scene:1:12]
     1 │ #macro A() A() #end
       ·            ─┬─
       ·             ╰── this call
     2 │ A()
       · ─┬─
       ·  ╰── in this call of `A`
       ╰────
    "#);
}

#[test]
fn a_message_about_the_whole_scene_names_it() {
    let (sources, _) = one_file("a.scene", "sphere { 0, 1 }\n");
    let diagnostic = Diagnostic::new(Code::NoLight, "nothing gives light").help("add one");
    insta::assert_snapshot!(human(&diagnostic, &sources, Style::PLAIN), @r#"
    no-light in a.scene

      ⚠ nothing gives light
      help: add one
    "#);
    assert_eq!(short(&diagnostic, &sources), "a.scene:1:1: warning[no-light]: nothing gives light");
}

#[test]
fn fixes_without_words_are_spelt_out() {
    let (sources, file) = one_file("a.scene", "union { sphere { 0, 1 }\n");
    let end = Span::new(file, 23, 23);
    let diagnostic = Diagnostic::new(Code::UnclosedBlock, "`{` is never closed")
        .at(Span::new(file, 6, 7), "opened here")
        .fix(end, " }")
        .fix(Span::new(file, 8, 14), "box")
        .fix(Span::new(file, 17, 18), "");
    let text = human(&diagnostic, &sources, Style::PLAIN);
    for line in ["insert ` }`", "replace `sphere` with `box`", "remove `0`"] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

#[test]
fn nothing_an_author_writes_reaches_the_terminal_raw() {
    let (sources, file) = one_file("a\u{1b}.scene", "pig\u{1b}[2J\u{202e}mnt\r\n");
    let diagnostic = Diagnostic::new(Code::AuthorError, "a\u{1b}[2J\nb\r")
        .at(Span::new(file, 0, 3), "c\u{7}")
        .help("d\u{9b}")
        .fix(Span::new(file, 3, 4), "e\u{1b}");
    for text in [human(&diagnostic, &sources, Style::PLAIN), short(&diagnostic, &sources)] {
        let raw = text.chars().find(|&c| c != '\n' && (c.is_control() || c == '\u{202e}'));
        assert_eq!(raw, None, "{text}");
    }
    assert_eq!(short(&diagnostic, &sources).lines().count(), 1);
}

#[test]
fn a_ten_megabyte_line_is_rendered_quickly() {
    let text = "sphere{0,1}".repeat(1_000_000);
    let (sources, file) = one_file("big.scene", &text);
    let diagnostic = Diagnostic::new(Code::UnknownWord, "unknown word")
        .at(Span::new(file, 5_500_000, 5_500_006), "here")
        .also(Span::new(file, 0, 11_000_000), "in this");
    let start = std::time::Instant::now();
    let text = human(&diagnostic, &sources, Style::PLAIN);
    assert!(start.elapsed().as_millis() < 1000, "{:?}", start.elapsed());
    assert!(text.contains("big.scene:1:5500001"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() < 200), "{text}");
}

#[test]
fn colour_comes_only_when_asked_for() {
    let (sources, file) = one_file("a.scene", "x\n");
    let diagnostic = Diagnostic::new(Code::UnknownWord, "m").at(Span::new(file, 0, 1), "t");
    let colored = human(&diagnostic, &sources, Style { width: 80, color: true });
    assert!(colored.contains("\u{1b}["));
    assert!(!human(&diagnostic, &sources, Style::PLAIN).contains('\u{1b}'));
}

#[test]
fn the_summary_counts_errors_and_warnings() {
    assert_eq!(summary(0, 0), None);
    assert_eq!(summary(0, 1).as_deref(), Some("1 warning"));
    assert_eq!(summary(2, 1).as_deref(), Some("2 errors, 1 warning"));
}

#[test]
fn the_mistake_is_drawn_before_what_stands_far_above_it() {
    let (sources, file) = one_file("a.scene", &format!("first\n{}last\n", "\n".repeat(20)));
    let diagnostic = Diagnostic::new(Code::WrongArity, "too many")
        .at(find(&sources, file, "last"), "here")
        .also(find(&sources, file, "first"), "declared here");
    let text = human(&diagnostic, &sources, Style::PLAIN);
    let at = |place: &str| text.find(place).unwrap_or_else(|| panic!("no {place} in {text}"));
    assert!(at("a.scene:22:1]") < at("a.scene:1:1]"), "{text}");
}

#[test]
fn a_narrow_window_breaks_the_labels_and_cuts_the_lines() {
    let text = "sphere { <0, 1, 0>, 2 pigment { rgb x } finish { phong 1 } }\n\
                sphere { <0, 1, 0>, 2 pigmnt { rgb <1, 0.5, 0> } }\n";
    let (sources, file) = one_file("a.scene", text);
    let diagnostic = Diagnostic::new(Code::UnknownWord, "unknown word `pigmnt`")
        .at(find(&sources, file, "pigmnt"), "not known in a `sphere`, nor anywhere else")
        .help("did you mean `pigment`, in which the colour of a thing stands?");
    let style = Style { width: 40, color: false };
    let text = human(&diagnostic, &sources, style);
    assert!(text.lines().all(|line| line.chars().count() <= 40), "{text}");
    insta::assert_snapshot!(text, @"
    unknown-word

      × unknown word `pigmnt`
       ╭─[a.scene:2:23]
     1 │ sphere { <0, 1, 0>, 2 pigment { …
     2 │ …<0, 1, 0>, 2 pigmnt { rgb <1, 0.…
       ·               ───┬──
       ·                  ╰─┤ not known in a
       ·                    │ `sphere`, nor
       ·                    │ anywhere else
       ╰────
      help: did you mean `pigment`, in
            which the colour of a thing
            stands?
    ");
    let wide = human(&diagnostic, &sources, Style { width: 120, color: false });
    assert!(!wide.contains('…') && wide.contains("not known in a `sphere`, nor anywhere else"));
}

#[test]
fn a_label_without_room_at_its_right_stands_left_of_its_bar() {
    let line = format!("sphere {{ <0, 1, 0>, 2 {}pigmnt {{ rgb 1 }} }}\n", " ".repeat(34));
    let (sources, file) = one_file("a.scene", &line);
    let diagnostic = Diagnostic::new(Code::UnknownWord, "unknown word `pigmnt`")
        .at(find(&sources, file, "pigmnt"), "not known in a `sphere`, nor anywhere else")
        .also(find(&sources, file, "sphere"), "this block");
    insta::assert_snapshot!(human(&diagnostic, &sources, Style::PLAIN), @"
    unknown-word

      × unknown word `pigmnt`
       ╭─[a.scene:1:57]
     1 │ sphere { <0, 1, 0>, 2                                   pigmnt { rgb 1 } }
       · ───┬──                                                  ───┬──
       ·    │          not known in a `sphere`, nor anywhere else ──╯
       ·    ╰── this block
       ╰────
    ");
}

#[test]
fn names_numbers_and_labels_over_lines_leave_the_window_its_width() {
    let text = "\n".repeat(99_999) + "union {\n球\n}" + &"球".repeat(99);
    let (sources, file) = one_file(&("folder/".repeat(30) + "a.scene"), &text);
    let diagnostic = Diagnostic::new(Code::UnknownWord, "m").at(
        find(&sources, file, "{\n球\n}"),
        "this block ends here, and what it holds is known to nobody at all, nor wanted",
    );
    let style = Style { width: 60, color: false };
    insta::assert_snapshot!(human(&diagnostic, &sources, style), @"
    unknown-word

      × m
            ╭─[…er/folder/folder/folder/folder/a.scene:100000:7]
     100000 │ ╭─▶ union {
     100001 │ │   球
     100002 │ ├─▶ }球球球球球球球球球球球球球球球球球球球球球…
            · ╰───┤ this block ends here, and what it holds
            ·     │ is known to nobody at all, nor wanted
            ╰────
    ");
}
