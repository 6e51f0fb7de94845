//! What a scene's own `#debug` says: every answer here is what POV-Ray 3.7 printed for the same text.

use super::*;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::source::{FileError, Found};

/// The one file there is to include.
struct Shadowing;

impl Files for Shadowing {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        if name != "shadow.inc" {
            return Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() });
        }
        let text = "#declare IncG = 11; #local IncL = 12; #local Shad = 1; #declare Shad = 2;";
        Ok(Found { name: name.to_owned(), bytes: text.as_bytes().to_vec() })
    }
}

/// What the scene prints: `P` prints a number, `V` a vector, `C` a colour's five components.
fn printed_with(text: &str, declares: &[(&str, f64)]) -> String {
    let head = r#"
        #macro P(A) #debug concat(str(A, 0, 3), " ") #end
        #macro V(A) #debug concat("<", vstr(3, A, ",", 0, 2), "> ") #end
        #macro Components(A) #local Q = A; #debug concat("(", str(Q.red, 0, 2), ",", str(Q.green, 0, 2), ",",
            str(Q.blue, 0, 2), ",", str(Q.filter, 0, 2), ",", str(Q.transmit, 0, 2), ") ") #end
    "#;
    let mut options = Options::new(Dialect::Pov);
    options.evaluate.declares = declares.iter().map(|(name, n)| (name.to_string(), *n)).collect();
    let mut road = Road::new(&Shadowing, options);
    let file = road.read("a.pov", format!("{head}{text}").into_bytes());
    let ast = road.parse(file);
    road.evaluate(ast);
    let told =
        road.diagnostics.iter().filter(|one| one.severity != crate::diagnostic::Severity::Warning);
    told.map(|one| one.message.as_str()).collect::<String>().trim_end().to_owned()
}

fn printed(text: &str) -> String {
    printed_with(text, &[])
}

/// One test a row: its name is the fact, then the scene, then what it prints.
macro_rules! facts {
    ($($name:ident: $scene:literal => $answer:literal;)*) => {
        $(#[test]
        fn $name() {
            assert_eq!(printed($scene), $answer);
        })*
    };
}

mod call;
mod continuation;
mod deep;
mod extent;
mod file;
mod fog;
mod inherited;
mod internal;
mod made;
mod promotion;
mod rainbow;
mod repetition;

facts! {
    an_element_of_an_array_is_an_operand_like_any_other:
        "#declare R = array[2] {3, 4} P(1 + R[1]) P(R[0] * 2 + R[1]) P(R[0] * R[1] - -R[0])"
        => "5.000 10.000 15.000";
    a_lone_name_is_passed_by_reference:
        "#macro Inc(A) #declare A = A + 1; #end #declare N = 1; Inc(N) P(N)" => "2.000";
    a_local_that_has_a_parameters_name_is_the_parameter:
        "#macro Inc(A) #local A = A + 1; #end #declare N = 1; Inc(N) P(N)" => "2.000";
    a_name_in_parentheses_is_passed_by_value:
        "#macro Inc(A) #declare A = A + 1; #end #declare N = 1; Inc((N)) P(N)" => "1.000";
    two_parameters_may_be_one_variable:
        "#macro Two(A, B) #declare A = 5; #declare B = A + 1; #end #declare N = 1; Two(N, N) P(N)" => "6.000";
    declare_sets_the_local_of_a_caller:
        "#macro Inner() #declare L = 7; #end #macro Outer() #local L = 1; Inner() P(L) #end
         Outer() P(defined(L))" => "7.000 0.000";
    declare_sets_the_local_of_a_caller_and_not_the_global_of_that_name:
        "#declare L = 0; #macro Inner() #declare L = 7; #end
         #macro Outer() #local L = 1; Inner() P(L) #end Outer() P(L)" => "7.000 0.000";
    declare_reaches_the_variable_behind_a_callers_parameter:
        "#macro Inner() #declare A = 8; #end #macro Outer(A) Inner() P(A) #end
         #declare N = 1; Outer(N) P(N) P(defined(A))" => "8.000 8.000 0.000";
    a_local_of_the_main_file_is_seen_in_macros:
        "#local G = 3; #macro Read() P(G) #end Read()" => "3.000";
    a_macro_sees_the_locals_of_its_caller:
        "#macro See() P(Hid) #end #macro Call() #local Hid = 4; See() #end Call() P(defined(Hid))"
        => "4.000 0.000";
    a_local_hides_the_global_and_takes_its_declares:
        "#declare S = 1; #macro M() #local S = 2; #declare S = 3; P(S) #end M() P(S)" => "3.000 1.000";
    a_local_of_an_include_ends_with_it:
        "#declare Shad = 9; #include \"shadow.inc\" P(IncG) P(defined(IncL)) P(Shad)"
        => "11.000 0.000 9.000";
    a_condition_may_choose_a_right_hand_side:
        "#declare A = #if (1) 10; #else 20; #end P(A)" => "10.000";
    a_case_falls_through_until_a_break:
        "#macro S(A) #switch (A) #case (1) P(1) #case (2) P(2) #break #range (3, 5) P(3) #break #else P(9) #end #end
         S(1) S(2) S(4) S(7)" => "1.000 2.000 2.000 3.000 9.000";
    a_break_in_a_loop_in_a_switch_leaves_the_loop:
        "#switch (2) #case (1) P(1) #break #case (2) #for (K, 1, 5) #if (K = 2) #break #end P(K) #end P(7) #break #else P(0) #end"
        => "1.000 7.000";
    a_loop_counts_down: "#for (I, 3, 1, -1) P(I) #end" => "3.000 2.000 1.000";
    a_loop_counts_down_in_fractions:
        "#for (I, 0.5, -0.5, -0.25) P(I) #end P(I)" => "0.500 0.250 0.000 -0.250 -0.500 -0.750";
    a_loop_from_0_to_1_by_tenths_has_eleven_turns:
        "#declare N = 0; #for (I, 0, 1, 0.1) #declare N = N + 1; #end P(N) P(I)" => "11.000 1.100";
    a_loop_whose_end_lies_before_its_start_does_not_turn:
        "#for (I, 5, 1) P(I) #end P(I)" => "5.000";
    a_body_may_set_the_counter:
        "#for (I, 1, 3) P(I) #declare I = I + 1; #end" => "1.000 3.000";
    a_counter_ends_with_its_macro:
        "#macro M() #for (Q, 1, 2) #end P(Q) #end M() P(defined(Q))" => "3.000 0.000";
    loops_nest: "#for (I, 1, 2) #for (J, 1, 2) P(I*10 + J) #end #end" => "11.000 12.000 21.000 22.000";
    a_break_leaves_the_innermost_loop:
        "#declare N = 0; #declare I = 0;
         #while (1) #declare I = I + 1; #declare J = 0;
           #while (1) #declare J = J + 1; #declare N = N + 1; #if (J >= I) #break #end #end
           #if (I = 4) #break #end #end P(N)" => "10.000";
    an_undone_name_is_not_defined: "#declare D = 1; #undef D P(defined(D))" => "0.000";
    undef_of_a_local_uncovers_the_global:
        "#declare Q = 5; #macro M() #local Q = 1; #undef Q P(defined(Q)) #end M() P(Q)" => "1.000 5.000";
    a_parameter_is_defined:
        "#macro M(A) #ifdef (A) P(1) #else P(0) #end #end M(3)" => "1.000";
    a_macro_may_define_a_macro:
        "#macro Nest(A) #macro In(B) P(A + B) #end In(A*2) #end Nest(3)" => "9.000";
    a_macro_leaves_a_value: "#macro F(A, B) (A * B) #end P(1 + F(2, 3))" => "7.000";
    a_macros_value_is_whole: "#macro Sq(A) A*A #end P(2*Sq(3))" => "18.000";
    a_macro_leaves_a_vector: "#macro F(A) <A, A + 1, A + 2> #end V(F(1) * 2)" => "<2.00,4.00,6.00>";
    a_macro_behind_a_declared_object_sees_it:
        "#declare B = sphere { 0, 1 } V(max_extent(B))" => "<1.00,1.00,1.00>";
    the_arm_not_taken_may_divide_by_zero:
        "#declare N = 0; P((N = 0 ? 5 : 1/N)) P((1 ? 2 : 0 ? 3 : 4))" => "5.000 2.000";
    operators_bind_as_usual:
        "P(2 + 3*4 - 6/2) P(-2*-3) P(!0) P((1 & 0)) P((1 | 0)) P((1 | 0 & 0)) P((0.1 + 0.2 = 0.3))"
        => "11.000 6.000 1.000 0.000 1.000 0.000 1.000";
    a_number_fills_what_the_colour_word_names:
        "#declare A = rgb 1; #declare B = color 1; #declare D = rgbf 1; Components(A) Components(B) Components(D)"
        => "(1.00,1.00,1.00,0.00,0.00) (1.00,1.00,1.00,1.00,1.00) (1.00,1.00,1.00,1.00,0.00)";
    a_colour_keeps_what_its_word_does_not_take_but_rgbt_ends_with_the_fourth:
        "#declare C = rgbft <1,.5,0,.25,.5>; #declare A = rgb <1,0,0,.5>; #declare B = rgbt <1,0,0,.5,.3>;
         #declare D = rgbt C; #declare E = rgbf C; Components(A) Components(B) Components(D) Components(E)"
        => "(1.00,0.00,0.00,0.50,0.00) (1.00,0.00,0.00,0.00,0.50) (1.00,0.50,0.00,0.00,0.25) (1.00,0.50,0.00,0.25,0.50)";
    a_colours_components_are_set_by_name:
        "#declare R = rgb <1,0,0>; #declare A = color R filter .5; #declare B = color red 1 green .5; Components(A) Components(B)"
        => "(1.00,0.00,0.00,0.50,0.00) (1.00,0.50,0.00,0.00,0.00)";
    the_fourth_number_is_filter_or_transmit:
        "#declare A = rgbf <1,.5,.25,.1>; #declare B = rgbt <1,.5,.25,.1>; #declare D = rgbft <1,2,3,4,5>; Components(A) Components(B) Components(D)"
        => "(1.00,0.50,0.25,0.10,0.00) (1.00,0.50,0.25,0.00,0.10) (1.00,2.00,3.00,4.00,5.00)";
    display_values_are_converted_as_povray_prints_them:
        "#declare A = srgb <1,.5,.02>; #declare B = srgbft <-0.5,.3,2,.5,.6>; #declare D = srgbt .5; Components(A) Components(B) Components(D)"
        => "(1.00,0.21,0.00,0.00,0.00) (-0.04,0.07,4.95,0.50,0.60) (0.21,0.21,0.21,0.00,0.50)";
    what_follows_a_display_value_is_as_it_is:
        "#declare R = rgbf <.5,.5,.5,.25>; #declare A = srgb <.5,.6,.7> filter .3; #declare B = srgb <.5,.6,.7> red .3;
         #declare D = srgb R; #declare E = srgb <.25,.25,.5>*2; Components(A) Components(B) Components(D) Components(E)"
        => "(0.21,0.32,0.45,0.30,0.00) (0.30,0.32,0.45,0.00,0.00) (0.21,0.21,0.21,0.25,0.00) (0.21,0.21,1.00,0.00,0.00)";
    colours_are_calculated_with:
        "#declare R = rgb <1,0,0>; #declare A = <.1,.2,.3> + R; #declare B = rgb R*2; #declare D = rgb <1,2,3>*.5; Components(A) Components(B) Components(D)"
        => "(1.10,0.20,0.30,0.00,0.00) (2.00,0.00,0.00,0.00,0.00) (0.50,1.00,1.50,0.00,0.00)";
    the_gray_of_a_colour: "#declare A = rgbf <1,.5,.25,.1>; P(A.gray)" => "0.620";
    a_string_keeps_its_escapes: "P(strlen(\"a\\tb\\\\c\"))" => "5.000";
    what_is_inside_a_scaled_sphere:
        "#declare B = sphere { <1,2,3>, 1 scale 2 } P(inside(B, <2,4,6>)) P(inside(B, 0)) V(max_extent(B))"
        => "1.000 0.000 <4.00,6.00,8.00>";
    a_trace_gives_point_and_normal:
        "#declare B = sphere { <1,2,3>, 1 scale 2 } #declare N = x; V(trace(B, <2,4,-10>, z, N)) V(N)"
        => "<2.00,4.00,4.00> <0.00,0.00,-1.00>";
    a_trace_that_misses_gives_zero:
        "#declare B = sphere { 0, 1 } #declare N = x; V(trace(B, <20,4,-10>, z, N)) V(N)"
        => "<0.00,0.00,0.00> <0.00,0.00,0.00>";
    inverse_turns_a_transform_round:
        "#declare T = transform { scale 4 translate x inverse } #declare B = sphere { 0, 1 transform { T } }
         V(max_extent(B) + 1)" => "<1.00,1.25,1.25>";
    a_transform_goes_by_name:
        "#declare T = transform { scale 2 translate x } #declare A = sphere { 0, 1 transform T }
         #declare B = sphere { 0, 1 transform { T inverse } } #declare D = sphere { 0, 1 transform { translate x T } }
         V(max_extent(A)) V(max_extent(B)) V(max_extent(D))"
        => "<3.00,2.00,2.00> <0.00,0.50,0.50> <5.00,2.00,2.00>";
    a_matrix_moves_and_stretches:
        "#declare B = box { 0, 1 matrix <1,0,0, 0,2,0, 0,0,1, 5,6,7> } V(max_extent(B))"
        => "<6.00,8.00,8.00>";
    what_one_macro_opens_another_closes:
        "#macro Open() union { #end #macro Close() } #end
         #declare N = 0; #declare A = Open() #for (I, 1, 3) #declare N = N + 1; sphere { I*x, 1 } #end Close()
         P(N) V(max_extent(A))" => "3.000 <4.00,1.00,1.00>";
    what_a_macro_opens_a_literal_brace_closes:
        "#macro Ball() sphere { 0, 1 #end #declare A = Ball() translate x } #declare B = Ball() scale 3 }
         V(max_extent(A)) V(max_extent(B))" => "<2.00,1.00,1.00> <3.00,3.00,3.00>";
    what_is_open_a_macro_closes:
        "#macro Close() } #end #declare A = union { sphere { 0, 1 Close() sphere { x, 1 } } V(max_extent(A))"
        => "<2.00,1.00,1.00>";
    a_literal_brace_closes_what_was_opened_last:
        "#macro Open() union { #end #macro Close() } #end
         #declare A = union { Open() sphere { 0, 1 } } translate x Close() V(max_extent(A))"
        => "<2.00,1.00,1.00>";
    a_macro_may_open_twice:
        "#macro Open() union { #end #macro Two() Open() Open() #end #macro Close() } #end
         #declare A = Two() sphere { 0, 1 } Close() translate x Close() V(max_extent(A))"
        => "<2.00,1.00,1.00>";
    loops_open_and_close:
        "#macro Open() union { #end #macro Close() } #end #declare N = 0;
         #for (I, 1, 30) Open() #end sphere { 0, 1 } #for (I, 1, 30) Close() #declare N = N + 1; #end P(N)"
        => "30.000";
    a_branch_chooses_which_block_opens:
        "#macro S(U) #if (U) union { #else object { #end sphere { 0, 1 } translate 2*x } #end
         #declare A = S(0) #declare B = object { S(1) translate x } V(max_extent(A)) V(max_extent(B))"
        => "<3.00,1.00,1.00> <4.00,1.00,1.00>";
    a_branch_chooses_whether_a_block_opens:
        "#macro Maybe(U) #if (U) object { #end sphere { 0, 1 } #if (U) translate x } #end #end
         #declare A = Maybe(1) #declare B = Maybe(0) V(max_extent(A)) V(max_extent(B))"
        => "<2.00,1.00,1.00> <1.00,1.00,1.00>";
    what_a_macro_has_closed_is_closed_before_its_rest:
        "#macro E() #local Q = 5; } P(Q) #end union { sphere { 0, 1 } E() P(2)" => "5.000 2.000";
    a_declared_name_may_be_a_parameter_of_its_value:
        "#macro F(A) A + 1 #end #declare A = F(1); P(A)
         #macro G(B) sphere { 0, 1 } #declare B = 7; #end #declare B = G(1) V(max_extent(B))"
        => "2.000 <1.00,1.00,1.00>";
    of_two_parameters_of_one_name_the_last_is_seen:
        "#macro A(Q, Q) #declare Q = 5; #end #declare N = 1; #declare M = 2; A(N, M) P(N) P(M)"
        => "1.000 5.000";
    objects_are_made_of_declared_ones:
        "#declare B = sphere { 0, 1 } #declare U = union { sphere { 0, 1 } box { 0, 3 } }
         #declare A = object { U translate 2*x } #declare D = sphere { B translate x }
         V(max_extent(A)) V(max_extent(D))" => "<5.00,3.00,3.00> <2.00,1.00,1.00>";
    a_macro_leaves_modifiers:
        "#macro M() translate 3*x scale 2 #end #declare B = sphere { 0, 1 M() } V(max_extent(B))"
        => "<8.00,2.00,2.00>";
    a_macro_leaves_half_of_a_list:
        "#macro M() <1, 2, 3>, #end #declare B = sphere { M() 2 } V(max_extent(B))" => "<3.00,4.00,5.00>";
    a_block_is_an_argument:
        "#macro M(O) object { O translate y } #end #declare B = M(sphere { 0, 1 }) V(max_extent(B))"
        => "<1.00,2.00,1.00>";
    loops_and_conditions_stand_inside_blocks:
        "#declare U = union { sphere { 0, 1 } #for (I, 1, 3) sphere { I*x, 1 } #end #if (0) box { -9, 9 } #end }
         #declare S = sphere { #if (1) <0, 0, 0>, #else <9, 9, 9>, #end #if (0) 5 #else 1 #end }
         V(max_extent(U)) V(max_extent(S))" => "<4.00,1.00,1.00> <1.00,1.00,1.00>";
    version_is_what_was_said: "#version 3.6; P(version)" => "3.600";
}

#[test]
fn a_name_from_the_command_line_is_declared() {
    assert_eq!(printed_with("P(Size) P(defined(Size))", &[("Size", 2.5)]), "2.500 1.000");
}

/// What the finish of the scene's one object is.
fn finish(text: &str) -> Finish {
    let mut road = Road::new(&Shadowing, Options::new(Dialect::Scene));
    let file = road.read("a.scene", text.as_bytes().to_vec());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    assert!(road.diagnostics.is_empty(), "{:?}", road.diagnostics.iter().collect::<Vec<_>>());
    scene.finishes.last().cloned().unwrap_or_else(|| panic!("no finish"))
}

#[test]
fn the_seeds_words_are_known_in_macros_that_a_finish_calls() {
    let called =
        "#macro F(A) kd A ks 1 - A phong_exponent 10*A #end sphere { 0, 1 finish { F(.5) } }";
    let written = "sphere { 0, 1 finish { kd .5 ks .5 phong_exponent 5 } }";
    assert_eq!(finish(called), finish(written));
}

/// `optional` is a word of POV-Ray 3.8; what it prints is not measured.
#[test]
fn an_optional_parameter_may_be_left_out() {
    let macro_ = "#declare C = 99;
        #macro A(B, optional C, optional D) P(B) #ifdef (C) P(C) #else #local C = 5; P(-C) #end P(defined(D)) #end ";
    assert_eq!(printed(&format!("{macro_} A(1)")), "1.000 -5.000 0.000");
    assert_eq!(printed(&format!("{macro_} A(1, 2)")), "1.000 2.000 0.000");
    assert_eq!(printed(&format!("{macro_} A(1, , 3) P(C)")), "1.000 -5.000 1.000 99.000");
    assert_eq!(
        printed(&format!("{macro_} #macro M(optional C) A(1, C) #end M()")),
        "1.000 -5.000 0.000"
    );
    // What the body says of itself follows: it is read for its own mistakes.
    let told = printed(&format!("{macro_} A()"));
    assert!(told.starts_with("macro `A` takes 1 to 3 arguments, and is given 0"), "{told}");
    let told = printed(&format!("{macro_} A(, 1)"));
    assert!(told.starts_with("`B` of macro `A` is left empty"), "{told}");
}

#[test]
fn a_seeds_word_before_a_parenthesis_is_the_word() {
    let called = "#macro F(A) kd (A) ks (1 - A)*2/2 phong_exponent (5)*(A + .5)*2 #end
        sphere { 0, 1 finish { F(.5) } }";
    let written = "sphere { 0, 1 finish { kd .5 ks .5 phong_exponent 10 } }";
    assert_eq!(finish(called), finish(written));
    let own = "#macro ks(A) ambient A #end #macro F(A) ks(A) #end sphere { 0, 1 finish { F(.5) } }";
    assert_eq!(finish(own), finish("sphere { 0, 1 finish { ambient .5 } }"));
}

#[test]
fn a_name_that_is_a_seeds_word_elsewhere_is_free() {
    let free = "#declare kd = .5; #declare F = finish { kd kd ks kd phong_exponent 5 } sphere { 0, kd finish { F } }";
    let written = "sphere { 0, .5 finish { kd .5 ks .5 phong_exponent 5 } }";
    assert_eq!(finish(free), finish(written));
}

#[test]
fn a_long_sum_needs_no_deep_stack() {
    let sum = vec!["1"; 100_000].join(" + ");
    assert_eq!(printed(&format!("P({sum})")), "100000.000");
    let chain = "#if (0) #else".repeat(400) + " P(7) " + &"#end ".repeat(400);
    assert_eq!(printed(&chain), "7.000");
    let chain = format!("#if (0) {} #else P(8) #end", "#elseif (0) ".repeat(5_000));
    assert_eq!(printed(&chain), "8.000");
}

/// The World of a `.pov` text, and what was said of it.
fn world(text: &str) -> (crate::world::World, String) {
    let mut road = Road::new(&Shadowing, Options::new(Dialect::Pov));
    let (world, _) = road.compile("a.pov", text.as_bytes().to_vec());
    let messages: Vec<&str> = road.diagnostics.iter().map(|d| d.message.as_str()).collect();
    (world, messages.join("; "))
}

const VERSION: &str = "#version 3.7; global_settings { assumed_gamma 1 } ";

/// Two texts without a mistake that come to the same World.
fn assert_alike(a: &str, b: &str) {
    let [a, b] = [a, b].map(|text| world(&format!("{VERSION} {text}")));
    assert_eq!(a.1, "");
    assert_eq!(a, b);
}

#[test]
fn inert_words_are_read_and_leave_no_trace() {
    assert_alike(
        "global_settings { max_intersections 9 number_of_waves 3 noise_generator 2 hf_gray_16
           irid_wavelength rgb <.7, .5, .4> mm_per_unit 10 charset utf8 }
         camera { location -5*z focal_point 0 blur_samples 4, 9 confidence .9 variance 1/99 }
         light_source { 9, rgb 1 }
         union { sphere { 0, 1 sturm hierarchy off no_radiosity bounded_by { box { -1, 1 } } }
           box { 1, 2 pigment { rgb 1 quick_color rgb x } } split_union off
           bounded_by { clipped_by } interior { dispersion_samples 7 } }",
        "camera { location -5*z } light_source { 9, rgb 1 }
         union { sphere { 0, 1 } box { 1, 2 pigment { rgb 1 } } }",
    );
}

#[test]
fn what_bounds_an_object_may_be_of_a_kind_that_is_not_built() {
    assert_alike("sphere { 0, 1 bounded_by { cylinder { -y, y, 1 } } }", "sphere { 0, 1 }");
    let said = |text: &str| world(&format!("{VERSION} {text}")).1;
    assert_eq!(
        said("sphere { 0, 1 bounded_by { pigment { rgb 1 } } }"),
        "`pigment` cannot stand in `bounded_by`"
    );
    assert_eq!(
        said("sphere { 0, 1 bounded_by { sphere { 0, \"1\" } } }"),
        "expected a number for the radius, found a string"
    );
}

#[test]
fn what_belongs_to_an_inert_word_is_of_its_kind() {
    let said = |text: &str| world(&format!("{VERSION} global_settings {{ {text} }}")).1;
    assert_eq!(said("max_intersections \"64\""), "expected a number, found a string");
    assert_eq!(said("charset latin"), "expected `ascii`, `utf8` or `sys`, found `latin`");
}

#[test]
fn a_lights_words_may_stand_in_any_order() {
    let light = |words: &str| format!("light_source {{ <0, 5, 0>, rgb 1 {words} }}");
    assert_alike(
        &light(
            "spotlight point_at 0 radius 10 falloff 20 tightness 2 fade_distance 3 fade_power 2",
        ),
        &light(
            "fade_power 2 tightness 2 falloff 20 fade_distance -3 radius 10 point_at 0 spotlight",
        ),
    );
    assert_alike(
        &light("spotlight point_at 0"),
        &light("spotlight radius 30 falloff 45 point_at 0"),
    );
    assert_alike(
        &light("spotlight radius 30 falloff 5 point_at 0"),
        &light("spotlight radius 30 falloff 30 point_at 0"),
    );
    assert_alike(&light("spotlight parallel point_at 0"), &light("parallel spotlight point_at 0"));
    assert_alike(
        &light("cylinder parallel point_at 0"),
        &light("cylinder radius 0.75 falloff 1 point_at 0"),
    );
    assert_alike(&light("parallel"), &light("parallel point_at z"));
    assert_alike(&light("fade_power 2"), &light("fade_distance 2"));
    assert_alike(
        "#declare Lamp = light_source { 5*y, rgb 1 spotlight radius 9 point_at 0 }
         light_source { Lamp falloff 60 translate x }",
        "light_source { <1, 5, 0>, rgb 1 spotlight radius 9 falloff 60 point_at x }",
    );
    assert_alike(&light("cylinder falloff 0 point_at 0"), "");
}

#[test]
fn a_declared_sky_is_the_sky_where_it_is_used() {
    assert_alike(
        "#declare Sky = sky_sphere { pigment { gradient y } rotate 90*x } sky_sphere { Sky scale 2 }",
        "sky_sphere { pigment { gradient y } rotate 90*x scale 2 }",
    );
}

#[test]
fn default_needs_no_sign_in_a_pov_file() {
    assert_alike(
        "#if (1) default { finish { ambient 1 } } #end sphere { 0, 1 }",
        "#default { finish { ambient 1 } } sphere { 0, 1 }",
    );
}
