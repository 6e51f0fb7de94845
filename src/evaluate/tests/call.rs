//! Calls of macros: what they may leave out, and what they must leave behind.

use super::printed;

#[test]
fn a_call_may_end_with_a_comma_behind_all_that_the_macro_takes() {
    let macro_ = "#macro A(B, C) P(B + C) #end ";
    assert_eq!(printed(&format!("{macro_} A(1, 2,)")), "3.000");
    for call in ["A(1,)", "#declare Y = A(1,);", "sphere { 0, A(1,) }", "#declare Y = 2*A(1,);"] {
        assert_eq!(printed(&format!("{macro_} {call}")), "`C` of macro `A` is left empty");
    }
}

#[test]
fn a_macro_that_leaves_no_value_is_named_where_one_is_wanted() {
    let macro_ = "#macro Foo(A, B) #local X = A + B; #end #macro Set() #declare Y = 2; #end ";
    for (scene, wanted) in [
        ("sphere { 0, Foo(3, 1) }", "a number for the radius"),
        ("sphere { Foo(3, 1), 1 }", "a vector for the centre"),
        ("sphere { 0, 1 translate Foo(3, 1) }", "a vector"),
        ("#declare Y = Foo(3, 1);", "a value"),
        ("#declare Y = 2*Foo(3, 1);", "a value"),
        ("object { Foo(3, 1) }", "a declared object"),
    ] {
        let told = format!("expected {wanted}, and macro `Foo` leaves none");
        assert_eq!(printed(&format!("{macro_} {scene}")), told, "{scene}");
    }
    // One that only sets what is read next may stand before any part.
    assert_eq!(printed(&format!("{macro_} sphere {{ Set() <1, 2, 3> Set(), Y }} P(Y)")), "2.000");
}

#[test]
fn a_macro_leaves_as_many_entries_of_a_list_as_it_has_values_between_commas() {
    let macros = "#macro Two() 1, 2 #end #macro Mix(A, B, C) A + 10*B + 100*C #end \
                  #declare F = function(x, y) { x + 100*y } ";
    for (call, answer) in [
        ("V(<Two(), 3>)", "<1.00,2.00,3.00>"),
        ("V(<0, Two()>)", "<0.00,1.00,2.00>"),
        ("P(max(Two()))", "2.000"),
        ("P(max(Two(), 7))", "7.000"),
        ("P(Mix(Two(), 3))", "321.000"),
        ("P(Mix(3, Two()))", "213.000"),
        ("P(F(Two()))", "201.000"),
        ("P(Mix(Two(), Two()))", "macro `Mix` takes 3 arguments, and is given 2"),
        ("P(sin(Two()))", "`sin` takes one argument, and is given 2"),
        ("P(F(Two(), 3))", "`F` takes 2 arguments, and is given 3"),
    ] {
        assert_eq!(printed(&format!("{macros} {call}")), answer, "{call}");
    }
}
