//! Texts that stand in themselves deeper than any stack end at a limit; what a `#declare` waits for ends with it.

use super::*;
use crate::diagnostic::Code;

/// The last code said of a text.
fn last_code(text: &str) -> Option<Code> {
    let mut road = Road::new(&Shadowing, Options::new(Dialect::Scene));
    road.compile("a.scene", text.as_bytes().to_vec());
    road.diagnostics.iter().last().map(|message| message.code)
}

#[test]
fn declares_that_wait_for_each_other_end_at_the_limit() {
    let declares = |count: usize| format!("{}1;", "#declare A = ".repeat(count));
    assert_eq!(last_code(&declares(20_000)), Some(Code::NestingLimit));
    assert_eq!(last_code(&declares(1_001)), Some(Code::NestingLimit));
    assert_ne!(last_code(&declares(1_000)), Some(Code::NestingLimit));
    let others = [
        "#local A = ".repeat(60_000) + "1;",
        "#declare A = #debug ".repeat(20_000),
        "light_source { ".to_owned() + &"#local A = ".repeat(20_000),
        "#declare A = 1;\n#declare A\n".repeat(20_000),
    ];
    for text in others {
        assert_eq!(last_code(&text), Some(Code::NestingLimit), "{}", &text[..40]);
    }
    // Those that stand behind each other do not wait.
    assert_eq!(printed(&format!("{} P(A)", "#declare A = 1; ".repeat(5_000))), "1.000");
}

#[test]
fn a_macro_that_calls_itself_inside_of_many_brackets_ends_at_the_limit() {
    for (open, close) in [("union { ", "}"), ("(", ")"), ("<", ">")] {
        let (open, close) = (open.repeat(300), close.repeat(300));
        let body = format!("#macro F() {open} F() {close} #end F()");
        assert_eq!(last_code(&body), Some(Code::MacroLimit), "{}", &body[..30]);
    }
}

/// Each holds the one before: freed by a call each, they would need a stack.
#[test]
fn arrays_within_arrays_are_as_deep_as_a_loop_makes_them() {
    let work = || {
        let grow =
            "#declare A = array[1] {1}; #for (I, 1, 200000) #declare A = array[1] { A }; #end";
        assert_eq!(printed(&format!("{grow} P(dimension_size(A, 1))")), "1.000");
    };
    let small = std::thread::Builder::new().stack_size(1 << 20);
    small.spawn(work).expect("a thread").join().expect("as on a large stack");
}

#[test]
fn a_recursion_may_be_as_deep_as_macros_may() {
    let fall = "#macro F(N) #if (N > 0) #local A = F(N - 1); #end N #end #declare B = F(998); P(B)";
    assert_eq!(printed(fall), "998.000");
}

facts! {
    the_semicolon_behind_a_call_ends_its_declaration:
        "#macro F() 1 #end #macro G() #local A = F(); A #end #declare B = G(); P(B)" => "1.000";
    a_declaration_by_a_call_may_stand_between_parts:
        "#macro F() 2 #end #declare S = sphere { 0, #local A = F(); A } P(max_extent(S).x)" => "2.000";
}
