//! How numbers, vectors and colours meet, and what colours keep: what POV-Ray 3.7 prints.

use super::printed;

/// Prints a number to the last digit of its single precision.
const S: &str = "#macro S(A) #debug concat(str(A, 0, 20), \" \") #end ";

#[test]
fn what_a_name_keeps_as_a_colour_is_read_back_in_single_precision() {
    for (scene, answer) in [
        ("#declare C = rgb .1; S(C.red)", "0.10000000149011611938"),
        ("#declare C = rgb .1; #declare D = C * 3; S(D.red)", "0.30000001192092895508"),
        ("#declare C = rgb .1; S(C.red * 3)", "0.30000000447034835815"),
        ("#declare C = rgb .1; S((C * 3).red)", "0.30000000447034835815"),
        ("#declare W = <.1, .2, .3, .4, .5>; S(W.red)", "0.10000000149011611938"),
        ("#declare C = color <.1, .2, .3>; S(C.x)", "0.10000000149011611938"),
        ("#declare C = rgb 1e-46; S(C.red)", "0.00000000000000000000"),
        ("#declare A = array[1] { rgb .1 } S(A[0].red)", "0.10000000149011611938"),
        ("#declare C = rgb .1; #declare D = C; S(D.red)", "0.10000000149011611938"),
        ("#declare C = rgb .1; #declare W = C + <.1, .1, .1>; S(W.x)", "0.20000000298023223877"),
        ("#declare C = rgb .1; #declare W = <C.red, 1, 1>; S(W.x)", "0.10000000149011611938"),
        ("#declare C = rgb .1; #declare N = -C; S(N.red)", "-0.10000000149011611938"),
        ("#declare C = rgb .1; S((C.red = 0.1))", "0.00000000000000000000"),
        (
            "#declare F = function { pigment { rgb .1 } } S(F(0, 0, 0).red)",
            "0.10000000149011611938",
        ),
    ] {
        assert_eq!(printed(&format!("{S}{scene}")), answer, "{scene}");
    }
}

#[test]
fn what_reaches_the_scene_keeps_all_its_digits() {
    use crate::road::{Options, Road};
    use crate::scene::{Dialect, PigmentKind};
    let mut road = Road::new(&super::Shadowing, Options::new(Dialect::Pov));
    let text = "#declare C = rgb .1; sphere { 0, 1 pigment { C } }";
    let file = road.read("a.pov", text.as_bytes().to_vec());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    let PigmentKind::Color(color) = scene.pigments.last().expect("one").kind else {
        panic!("a colour")
    };
    assert_eq!(color.rgb.red, 0.1);
}

/// What an operation prints, all of its components.
#[test]
fn the_shorter_operand_is_filled_up_by_zeros_and_a_number_by_itself() {
    for (expression, count, answer) in [
        ("<1, 2> * <3, 4, 5>", 3, "3.000,8.000,0.000"),
        ("<1, 2> + <3, 4, 5, 6>", 4, "4.000,6.000,5.000,6.000"),
        ("5 + <3, 4, 5, 6, 7>", 5, "8.000,9.000,10.000,11.000,12.000"),
        ("rgb <1, 1, 1> / 2", 5, "0.500,0.500,0.500,0.000,0.000"),
        ("-<1, 2>", 2, "-1.000,-2.000"),
        ("!<1, 0, 3>", 3, "0.000,1.000,0.000"),
        ("(<1, 2, 3> < <2, 2, 2>)", 3, "1.000,0.000,0.000"),
        ("(<1, 2> & <1, 0, 5>)", 3, "1.000,0.000,0.000"),
        ("(<1, 2, 3> != <1, 2>)", 3, "0.000,0.000,1.000"),
        ("<W.x, W.y> + 1", 2, "2.000,3.000"),
        ("C * <1, 2, 3>", 5, "0.100,0.400,0.900,0.000,0.000"),
        ("<1, 2, 3> * C", 5, "0.100,0.400,0.900,0.000,0.000"),
        ("color <1, 2, 3> * .1", 5, "0.100,0.200,0.300,0.000,0.000"),
    ] {
        let scene = format!(
            "#declare W = <1, 2, 3>; #declare C = rgb <.1, .2, .3>; #declare R = {expression};
             #debug vstr({count}, R, \",\", 0, 3)"
        );
        assert_eq!(printed(&scene), answer, "{expression}");
    }
}

#[test]
fn what_a_calculation_leaves_over_is_nothing_in_a_pov_file() {
    for (scene, answer) in [
        ("#declare I = 1; #while (I) #declare I = I - 0.1; #end P(I)", "0.000"),
        ("P((cos(pi/2) = 0)) P((sin(pi) ? 1 : 2)) P(!1e-11)", "1.000 2.000 1.000"),
        ("P((1e10 = 1e10 + 1)) P((0.1 + 0.2 - 0.3 <= 0))", "0.000 1.000"),
    ] {
        assert_eq!(printed(scene), answer, "{scene}");
    }
}

#[test]
fn a_number_has_a_first_component_and_an_element_is_defined_once_it_is_set() {
    for (scene, answer) in [
        ("#declare A = 3; #declare B = A.x; P(B) P(A.red) P(A.gray)", "3.000 3.000 0.891"),
        (
            "#declare Q = array[2]; #declare Q[0] = 1; P(defined(Q[0])) P(defined(Q[1]))",
            "1.000 0.000",
        ),
        ("#declare A = array[2][1][2] { {{1, 2}}, {{3, 4}} } P(A[1][0][1])", "4.000"),
    ] {
        assert_eq!(printed(scene), answer, "{scene}");
    }
}

#[test]
fn declarations_stand_in_parentheses() {
    assert_eq!(printed("#declare E = (#local B = 3; B*2); P(E)"), "6.000");
}
