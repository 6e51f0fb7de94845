//! The built-in functions against what POV-Ray 3.7 prints for them, at points drawn at random.

use std::fmt::Write;

use super::printed;

const TABLE: &str = include_str!("internal.txt");

fn rows() -> impl Iterator<Item = (u32, &'static str, f64)> {
    TABLE.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let (call, value) = line.split_once(" = ").expect("a value");
        let (number, arguments) = call.split_once('(').expect("arguments");
        let arguments = arguments.strip_suffix(')').expect("a parenthesis");
        (number.parse().expect("a number"), arguments, value.parse().expect("a value"))
    })
}

#[test]
fn all_of_them_agree_to_twelve_digits() {
    let mut scene = String::new();
    for number in (0..79).filter(|number| *number != 77) {
        assert!(rows().any(|row| row.0 == number), "{number} was not measured");
        let _ = write!(scene, "#declare F_{number} = function {{ internal({number}) }}");
    }
    for (number, arguments, _) in rows() {
        let _ = write!(scene, "#debug concat(str(F_{number}({arguments}), 0, 30), \" \")");
    }
    let printed = printed(&scene);
    let values: Vec<f64> = printed
        .split(' ')
        .map(|value| value.parse().unwrap_or_else(|_| panic!("{value}")))
        .collect();
    assert_eq!(values.len(), rows().count());
    for ((number, arguments, wanted), value) in rows().zip(values) {
        let off = (value - wanted).abs();
        assert!(off <= 1e-12 * wanted.abs(), "internal({number})({arguments}): {value} {wanted}");
    }
}

facts! {
    a_number_is_cut_off:
        "#declare F = function { internal(57.9) } P(F(3, 4, 0))" => "5.000";
    a_number_without_a_function_is_0:
        "#declare F = function { internal(77) } P(F(1, 2, 3))" => "0.000";
    it_is_a_whole_function:
        "#declare F = function { internal(57) + 1 }"
        => "`internal(n)` is a whole function, and no number";
    it_takes_as_many_arguments_as_it_has:
        "#declare F = function { internal(61) } P(F(1, 2, 3))"
        => "`F` takes 4 arguments, and is given 3";
    it_may_be_called_in_other_functions:
        "#declare R = function { internal(57) } #declare F = function { R(x, y, 0) - z } P(F(3, 4, 1))"
        => "4.000";
    the_last_noise_generator_counts_for_all:
        "global_settings { noise_generator 1 } #declare F = function { internal(76) }
         global_settings { noise_generator 3 } P(F(.3, .4, .5))" => "0.678";
    there_are_three_noise_generators:
        "global_settings { noise_generator 4 }" => "`noise_generator` is 4, and must be 1, 2 or 3";

    a_pattern_is_a_function:
        "#declare F = function { pattern { checker rotate 45*y scale 2 } } P(F(.5, .1, .2)) P(F(2.5, .1, .2))
         #declare G = function { pattern { gradient <1, 1, 0> } } P(G(.3, .1, .2)) P(G(-.3, 0, 0))"
        => "0.000 0.000 0.283 0.788";
    a_pattern_may_be_part_of_a_formula:
        "#declare F = function { pattern { checker } } #declare G = function { F(x, y, z) + 1 } P(G(1.3, .1, .2))"
        => "2.000";
    a_pattern_without_one_is_told:
        "#declare F = function { pattern { scale 2 } }" => "this `pattern` names none";
    a_pigment_is_a_function_to_a_colour:
        "#declare F = function { pigment { gradient x
            color_map { [0 rgbft <.1, .2, .3, .4, .5>] [1 rgb <1, .5, .25>] } scale 2 } }
         Components(F(.5, 0, 0)) P(F(.5, 0, 0).red) P(F(.5, 0, 0).transmit) P(F(.5, 0, 0).t) P(F(.5, 0, 0).gray)
         #declare G = function { F(x, y, z).gray - F(x, y, z).u } P(G(.5, 0, 0))"
        => "(0.32,0.28,0.29,0.30,0.38) 0.325 0.375 0.300 0.291 -0.034";
    a_declared_pigment_goes_on_there:
        "#declare D = pigment { checker rgb .1, rgb .7 } #declare F = function { pigment { D scale 2 } }
         Components(F(2.3, .1, .1))" => "(0.70,0.70,0.70,0.00,0.00)";
    a_transform_is_a_function_to_a_point:
        "#declare F = function { transform { rotate 90*z translate <1, 2, 3> } } V(F(1, 0, 0)) P(F(1, 0, 0).y)
         #declare G = function { F(x, y, z).z + F(x, y, z).x } P(G(1, 0, 0))"
        => "<1.00,3.00,3.00> 3.000 4.000";
    a_colour_is_no_number:
        "#declare F = function { pigment { rgb 1 } } #declare G = function { F(x, y, z) + 1 }"
        => "this function gives a colour, and a number is wanted";
    a_component_that_a_value_has_not_is_told:
        "#declare F = function { transform { scale 2 } } #declare G = function { F(x, y, z).t }"
        => "`F(x, y, z).t`: this function's value has no such component";
    a_transform_that_cannot_be_undone_is_told:
        "#declare F = function { pigment { checker matrix <1,1,0, 1,1,0, 0,0,1, 0,0,0> } }"
        => "this transform flattens space";

    the_normal_of_an_inverse_object_points_into_the_shape:
        "#declare N = 0; #declare S = sphere { 0, 1 inverse } V(trace(S, -10*z, z, N)) V(N)
         #declare B = box { -1, 1 inverse } V(trace(B, 10*x, -x, N)) V(N)
         #declare U = union { sphere { 0, 1 } inverse } V(trace(U, 10*x, -x, N)) V(N)
         #declare O = object { S inverse } V(trace(O, -10*z, z, N)) V(N)"
        => "<0.00,0.00,-1.00> <0.00,0.00,1.00> <1.00,0.00,0.00> <-1.00,0.00,0.00> <1.00,0.00,0.00> <-1.00,0.00,0.00> <0.00,0.00,-1.00> <0.00,0.00,-1.00>";
    the_normal_of_a_mesh_is_as_its_corners_turn_also_where_it_has_an_inside:
        "#declare N = 0; #declare A = <0.25,0.25,0>; #declare F = mesh { triangle { 0, x, y } }
         #declare M = mesh { triangle { 0, x, y } triangle { 0, x, z } triangle { 0, y, z }
                             triangle { x, y, z } inside_vector <1, 2, 3> }
         V(trace(M, A-5*z, z, N)) V(N) V(trace(M, A+5*z, -z, N)) V(N) V(trace(F, A+5*z, -z, N)) V(N)
         V(trace(object { F scale <1, 1, -1> }, A-5*z, z, N)) V(N)"
        => "<0.25,0.25,0.00> <0.00,0.00,-1.00> <0.25,0.25,0.50> <-0.58,-0.58,-0.58> <0.25,0.25,0.00> <0.00,0.00,-1.00> <0.25,0.25,0.00> <0.00,0.00,1.00>";
}
