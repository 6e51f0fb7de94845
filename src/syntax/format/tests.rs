//! Layout, rule by rule.

use super::*;
use crate::vocabulary::Dialect;

fn formatted(text: &str) -> String {
    let source = Source::new("a.pov", text);
    let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
    let mut found = Diagnostics::new(true);
    let once = format(&source, FileId(0), &options, &mut found).expect("a text without errors");
    let again = Source::new("a.pov", once.as_str());
    let twice = format(&again, FileId(0), &options, &mut found).expect("still without errors");
    assert_eq!(once, twice, "formatting twice is formatting once");
    once
}

#[track_caller]
fn lays_out(text: &str, expected: &str) {
    assert_eq!(formatted(text), expected);
}

#[test]
fn a_block_in_one_line_stays_in_one() {
    lays_out(
        "sphere{<0,1,2>,3  pigment{rgb<1,0,0>}}",
        "sphere { <0, 1, 2>, 3 pigment { rgb <1, 0, 0> } }\n",
    );
    lays_out("texture { }", "texture {}\n");
}

#[test]
fn a_block_over_several_lines_has_its_braces_at_their_ends() {
    lays_out(
        "sphere\n{ 0, 1\n    pigment { rgb 1\n} }\n",
        "sphere {\n  0, 1\n  pigment {\n    rgb 1\n  }\n}\n",
    );
}

#[test]
fn a_block_that_is_too_long_has_a_line_for_each_item() {
    let text = "sphere { <0, 1, 2>, 3 pigment { rgb <1, 0.5, 0.25> } finish { phong 0.5 phong_size 60 } rotate 45*y }";
    lays_out(
        text,
        "sphere {\n  <0, 1, 2>, 3\n  pigment { rgb <1, 0.5, 0.25> }\n  finish { phong 0.5 phong_size 60 }\n  rotate 45*y\n}\n",
    );
}

#[test]
fn a_row_of_items_that_is_too_long_has_a_line_for_each() {
    let call = "Place(King, 7, 1, Ivory)";
    lays_out(&[call; 5].join("   "), &format!("{call}\n").repeat(5));
    lays_out(&[call; 3].join("  "), &format!("{call} {call} {call}\n"));
}

#[test]
fn sums_are_spaced_and_products_tight() {
    lays_out(
        "#declare A=(1+2 * 3-4/x.y)*-z.x;#declare B = -A- -A;",
        "#declare A = (1 + 2*3 - 4/x.y)*-z.x; #declare B = -A - -A;\n",
    );
    lays_out("#if((1<2)&!(A>=B)|A=B?1:0)#end", "#if ((1 < 2) & !(A >= B) | A = B ? 1 : 0) #end\n");
    lays_out("#if (<1,2>.x>A) #end", "#if (<1, 2>.x > A) #end\n");
}

#[test]
fn calls_indices_and_sizes_are_tight() {
    lays_out(
        "#declare A = array [2] [ 3 ] { { 1,2,3 },{4,5,6} } M ( A [1] [ 0 ] , max( 1,2 ) )",
        "#declare A = array[2][3] { { 1, 2, 3 }, { 4, 5, 6 } } M(A[1][0], max(1, 2))\n",
    );
}

#[test]
fn directives_indent_their_bodies() {
    lays_out(
        "#if(A)sphere{0,1}\n#else\nbox{-1,1}#end",
        "#if (A)\n  sphere { 0, 1 }\n#else\n  box { -1, 1 }\n#end\n",
    );
    lays_out(
        "#while(A<3) B() #declare A=A+1;#end",
        "#while (A < 3) B() #declare A = A + 1; #end\n",
    );
    lays_out("#  declare A=1;\n#  ifdef(A)\n#end", "#declare A = 1;\n#ifdef (A)\n#end\n");
}

#[test]
fn a_switch_holds_its_cases_and_each_break_ends_one() {
    lays_out(
        "#switch(A) #case(1) B() #break\n#range(2,3)\n#if (A) #break #end C()\n#break #else D() #end",
        "#switch (A)\n  #case (1)\n    B()\n  #break\n  #range (2, 3)\n    #if (A) #break #end C()\n  #break\n  #else\n    D()\n#end\n",
    );
}

#[test]
fn comments_stay_where_they_are() {
    lays_out(
        "// top\n\n\n\n\nsphere { // why\n0,1 /* r */ pigment{rgb 1}// end\n      // last\n}\n// tail",
        "// top\n\n\nsphere {  // why\n  0, 1 /* r */ pigment { rgb 1 }  // end\n  // last\n}\n// tail\n",
    );
    lays_out("2 */* two */ 3", "2* /* two */ 3\n");
}

#[test]
fn comments_below_each_other_stay_so() {
    lays_out(
        "#declare A=1;      // one\n#declare Long = 22; // two\n                    // more\n",
        "#declare A = 1;  // one\n#declare Long = 22;  // two\n                     // more\n",
    );
    lays_out(
        "#declare A = 1;     // one\n#declare Long = 22; // two\n",
        "#declare A = 1;      // one\n#declare Long = 22;  // two\n",
    );
}

#[test]
fn a_line_whose_comment_silences_a_warning_stays_whole() {
    let sphere = "sphere { <0, 1, 2>, 3 pigment { rgb <1, 0.5, 0.25> } finish { phong 0.5 } rotate 45*y scale 2 }";
    let text = format!("{sphere}  // lucarne: allow(no-pigment)\n");
    lays_out(&text, &text);
}

#[test]
fn the_lines_of_a_comment_move_with_its_first() {
    lays_out("#if (1)\n/* a\n   b */\n#end", "#if (1)\n  /* a\n     b */\n#end\n");
}

#[test]
fn strings_and_numbers_are_as_they_were_typed() {
    let text = "#debug concat(\"a  b\\\"\n\tc\", str(1.50e+3, 0, .5))\n";
    lays_out(text, text);
}

#[test]
fn the_lines_of_a_list_stand() {
    lays_out(
        "mesh2{vertex_vectors{3,\n<1,2,3>,<4,5,6>,\n  <7,8,9>}}",
        "mesh2 {\n  vertex_vectors {\n    3,\n    <1, 2, 3>, <4, 5, 6>,\n    <7, 8, 9>\n  }\n}\n",
    );
    lays_out("matrix <1,0,0,\n0,1,0>", "matrix <1, 0, 0,\n        0, 1, 0>\n");
    lays_out("M(\n1,\n2)", "M(\n  1,\n  2\n)\n");
    lays_out("M(1,\n2\n)", "M(1,\n  2)\n");
}

#[test]
fn a_run_of_numbers_ends_its_lines_after_commas() {
    let text = formatted(&format!("#declare A = array[60] {{ {}1 }}", "123,".repeat(59)));
    assert!(text.lines().count() > 2 && text.lines().all(|line| line.len() <= 100), "{text}");
    lays_out(
        "poly { 2, <1,2,3, // three\n4,5,6,7,8,9,10> }",
        "poly {\n  2, <1, 2, 3,  // three\n      4, 5, 6, 7, 8, 9, 10>\n}\n",
    );
}

#[test]
fn an_include_in_its_guard_is_not_indented() {
    lays_out(
        "// mine\n#ifndef(A_Inc)\n#declare A_Inc=1;\n#if(1)\nB()\n#end\n#end // guard",
        "// mine\n#ifndef (A_Inc)\n#declare A_Inc = 1;\n#if (1)\n  B()\n#end\n#end  // guard\n",
    );
}

#[test]
fn braces_that_pair_only_after_expansion_survive() {
    lays_out(
        "#macro M(A)#if(A)merge{#else\nunion{#end\nsphere{0,1}}#end",
        "#macro M(A)\n  #if (A)\n    merge {\n  #else\n    union {\n  #end\n  sphere { 0, 1 } }\n#end\n",
    );
    lays_out("#macro Open() union{ #end Open() }", "#macro Open() union { #end Open() }\n");
}

#[test]
fn lines_end_as_the_first_does() {
    lays_out("A()\r\nB()\nC()\n", "A()\r\nB()\r\nC()\r\n");
    lays_out("A()\nB()\r\nC()\n", "A()\nB()\nC()\n");
    lays_out("/* a\nb */ \"c\nd\" A()\r\n", "/* a\r\nb */ \"c\nd\" A()\r\n");
    lays_out("A()\rB()", "A()\nB()\n");
    lays_out("", "");
}

#[test]
fn a_text_with_errors_is_not_touched() {
    let source = Source::new("a.pov", "sphere { 0, 1");
    let mut found = Diagnostics::new(true);
    let options = ParseOptions::default();
    let result = format(&source, FileId(0), &options, &mut found);
    assert_eq!(result, Err(Unformatted::Broken));
    assert_eq!(found.len(), 1);
}

#[test]
fn the_comparison_sees_a_lost_comma_a_comment_and_the_order() {
    let same = |one, other| same_but_blanks(one, other, &ParseOptions::default());
    assert!(same("a(1,2)//x\n", "a( 1, 2 ) //x"));
    for other in ["a(1 2)//x", "a(1,2)", "a(1,2)//y", "a(2,1)//x", "//x\na(1,2)", "a(1,2,)//x"] {
        assert!(!same("a(1,2)//x\n", other), "{other}");
    }
}

/// The pieces that texts are made of here, and what may stand between them.
const PIECES: &[&str] = &[
    "sphere",
    "{",
    "}",
    "0",
    ",",
    "1",
    "<1,2,3>",
    "+",
    "-",
    "*",
    "/",
    "(",
    ")",
    "A",
    "A(",
    "[",
    "]",
    "#if(1)",
    "#else",
    "#end",
    "#declare A=",
    ";",
    "\"s\n\"",
    "// c\n",
    "/* d\ne */",
    "x",
    ".x",
    "<",
    ">",
    "=",
    "color",
    "rgb",
    "red",
    "#macro M()",
    "#switch(1)",
    "#case(2)",
    "#break",
    "array[2]",
    "?",
    ":",
    "&",
    "1,2,3,4,5,6,7,8,9,",
    "#",
    "scale",
    "function",
    "no_shadow",
];
const BLANKS: &[&str] = &[" ", " ", " ", "\n", "\n\n\n\n", "\t", "  ", "\r\n"];

#[test]
fn any_text_without_errors_keeps_its_tokens_and_is_laid_out_once() {
    let mut state = 1_u64;
    let mut draw = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
    let lay_out = |text: &str| {
        let source = Source::new("a.pov", text);
        format(&source, FileId(0), &options, &mut Diagnostics::new(false))
    };
    let mut laid_out = 0;
    for _ in 0..20_000 {
        let text: String = (0..2 + draw(14))
            .flat_map(|_| [PIECES[draw(PIECES.len())], BLANKS[draw(BLANKS.len())]])
            .collect();
        match lay_out(&text) {
            Err(Unformatted::Broken) => {}
            Err(Unformatted::Unsafe) => panic!("would change {text:?}"),
            Ok(once) => {
                assert_eq!(lay_out(&once).as_deref(), Ok(&*once), "of {text:?}");
                laid_out += 1;
            }
        }
    }
    assert!(laid_out > 500, "only {laid_out}");
}
