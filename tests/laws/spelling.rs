//! Two spellings of one thing lower to one World, and a third that is not the same does not.

use lucarne::world::World;

use super::text::compiled;

const FRAME: &str =
    "camera { location <0, 2, 8> look_at 0 angle 45 } light_source { <5, 8, 9>, rgb 1 }\n";

fn world(text: &str) -> World {
    let includes = [
        ("ball.inc", "#declare Ball = sphere { 0, 1 } #declare Far = 3;"),
        ("place.inc", "object { Ball translate Far*x }"),
        ("nested.inc", "#include \"ball.inc\" #include \"place.inc\""),
    ];
    compiled(&format!("{FRAME}{text}"), &includes).0
}

/// Says `law`; `one` and `other` are one World, `faulty` is another.
#[track_caller]
fn law(says: &str, one: &str, other: &str, faulty: &str) {
    let (a, b, c) = (world(one), world(other), world(faulty));
    assert_eq!(a, b, "{says}:\n  {one}\n  {other}");
    assert_ne!(a, c, "a fault is not caught: {says}:\n  {one}\n  {faulty}");
}

#[test]
fn further_parts_of_a_texture() {
    let map = "color_map { [0 rgb 1] [1 rgb 0] }";
    law(
        "a pigment after another stands where that one stands",
        &format!(
            "sphere {{ 0, 1 pigment {{ wood scale 2 }} translate x pigment {{ marble {map} rotate 30*z }} }}"
        ),
        &format!(
            "sphere {{ 0, 1 translate x pigment {{ marble {map} scale 2 translate x rotate 30*z }} }}"
        ),
        &format!(
            "sphere {{ 0, 1 translate x pigment {{ marble {map} scale 2 rotate 30*z translate x }} }}"
        ),
    );
    law(
        "a normal after that of a texture changes it where the texture has it",
        "sphere { 0, 1 texture { normal { bumps 0.5 } scale 2 normal { bump_size 0.3 scale 3 } } }",
        "sphere { 0, 1 texture { normal { bumps 0.3 scale 3 } scale 2 } }",
        "sphere { 0, 1 texture { normal { bumps 0.5 scale 3 } scale 2 } }",
    );
}

#[test]
fn spheres() {
    law(
        "a sphere spends its scale and its move",
        "sphere { 0, 1 scale 2 translate x }",
        "sphere { x, 2 }",
        "sphere { 0, 1 translate x scale 2 }",
    );
    law(
        "a sphere at the origin does not turn",
        "sphere { 0, 1 rotate <10, 20, 30> }",
        "sphere { 0, 1 }",
        "sphere { 1e-9*x, 1 rotate <10, 20, 30> }",
    );
    law(
        "a quarter turn is exact",
        "sphere { 3*x, 1 rotate 90*z }",
        "sphere { 3*y, 1 }",
        "sphere { 3*x, 1 rotate -90*z }",
    );
    law(
        "a negative scale mirrors the centre and keeps the size",
        "sphere { <1, 2, 3>, 1 scale -2 }",
        "sphere { <-2, -4, -6>, 2 }",
        "sphere { <1, 2, 3>, 1 scale 2 }",
    );
    law(
        "two flattenings that make it round again make a sphere",
        "sphere { 0, 1 scale <2, 1, 4> scale <2, 4, 1> translate y }",
        "sphere { y, 4 }",
        "sphere { 0, 1 scale <2, 1, 4> scale <2, 4, 2> translate y }",
    );
    law(
        "an ellipsoid has one spelling too",
        "sphere { x, 1 scale <1, 2, 1> }",
        "sphere { 0, 1 scale <1, 2, 1> translate x }",
        "sphere { x, 1 scale <1, 1, 2> }",
    );
}

#[test]
fn planes_and_boxes() {
    law(
        "a plane's move is a distance along its normal",
        "plane { y, 1 translate <5, 2, 7> }",
        "plane { y, 3 }",
        "plane { y, 1 translate <5, -2, 7> }",
    );
    law("a normal has no length", "plane { 4*y, 1 }", "plane { y, 1 }", "plane { -4*y, 1 }");
    law(
        "a plane scales its distance",
        "plane { x, 1 scale <2, 7, 9> }",
        "plane { x, 2 }",
        "plane { x, 1 scale <7, 2, 9> }",
    );
    law(
        "inverse twice is none",
        "plane { y, 0 inverse inverse }",
        "plane { y, 0 }",
        "plane { y, 0 inverse }",
    );
    law(
        "any two opposite corners make the box",
        "box { <1, -2, 3>, <-1, 2, -3> }",
        "box { <-1, -2, -3>, <1, 2, 3> }",
        "box { <-1, -2, -3>, <1, 2, 4> }",
    );
    law(
        "a quarter turn swaps the widths of a box",
        "box { <-1, -2, -3>, <1, 2, 3> rotate 90*y }",
        "box { <-3, -2, -1>, <3, 2, 1> }",
        "box { <-1, -2, -3>, <1, 2, 3> rotate 90*z }",
    );
    law(
        "a box spends any scale along its edges",
        "box { 0, 1 scale <2, 4, 8> translate -x }",
        "box { -x, <1, 4, 8> }",
        "box { 0, 1 translate -x scale <2, 4, 8> }",
    );
}

#[test]
fn transforms() {
    law(
        "a transform is its steps",
        "#declare T = transform { scale 2 translate y } sphere { x, 1 transform { T } }",
        "sphere { x, 1 scale 2 translate y }",
        "sphere { x, 1 translate y scale 2 }",
    );
    law(
        "a matrix is what its rows do to x, y, z and the origin",
        "sphere { x, 1 matrix <0, 2, 0, -2, 0, 0, 0, 0, 2, 5, 6, 7> }",
        "sphere { x, 1 rotate 90*z scale 2 translate <5, 6, 7> }",
        "sphere { x, 1 matrix <0, -2, 0, 2, 0, 0, 0, 0, 2, 5, 6, 7> }",
    );
    law(
        "an inverse undoes",
        "#declare T = transform { scale 4 translate <1, 2, 3> }
         box { 0, 1 transform { T } transform { T inverse } }",
        "box { 0, 1 }",
        "#declare T = transform { scale 4 translate <1, 2, 3> }
         box { 0, 1 transform { T inverse } transform { T inverse } }",
    );
    law(
        "steps that do nothing are nothing",
        "box { 0, 1 scale 1 rotate 0 rotate 360*y translate 0 }",
        "box { 0, 1 }",
        "box { 0, 1 scale 1 rotate 0 rotate 180*y translate 0 }",
    );
    law(
        "one rotate is three",
        "box { 0, 1 rotate <90, 180, 90> }",
        "box { 0, 1 rotate 90*x rotate 180*y rotate 90*z }",
        "box { 0, 1 rotate 90*z rotate 180*y rotate 90*x }",
    );
}

#[test]
fn unions_and_uses() {
    law(
        "a union hands its transform down",
        "union { sphere { x, 1 } box { 0, 1 translate y } scale 2 translate z }",
        "sphere { <2, 0, 1>, 2 } box { <0, 2, 1>, <2, 4, 3> }",
        "union { sphere { x, 1 } box { 0, 1 translate y } translate z scale 2 }",
    );
    law(
        "unions in unions flatten",
        "union { union { sphere { 0, 1 } translate x } sphere { 0, 1 } translate y }",
        "sphere { <1, 1, 0>, 1 } sphere { y, 1 }",
        "union { union { sphere { 0, 1 } } sphere { 0, 1 } translate y }",
    );
    law(
        "a union's texture is for what has none",
        "union { sphere { 0, 1 } sphere { x, 1 pigment { rgb z } } pigment { rgb x } }",
        "sphere { 0, 1 pigment { rgb x } } sphere { x, 1 pigment { rgb z } }",
        "union { sphere { 0, 1 } sphere { x, 1 } pigment { rgb x } }",
    );
    law(
        "an object is what it was declared as, and more",
        "#declare A = sphere { 0, 1 pigment { rgb x } }
         #declare B = object { A scale 2 }
         object { B translate y } object { A }",
        "sphere { y, 2 pigment { rgb x } } sphere { 0, 1 pigment { rgb x } }",
        "#declare A = sphere { 0, 1 pigment { rgb x } }
         #declare B = object { A scale 2 }
         object { B translate y } object { B }",
    );
}

#[test]
fn directives() {
    let spelled = "sphere { 0, 1 } sphere { 2*x, 1 } sphere { 4*x, 1 }";
    law(
        "#for spelled out",
        "#for (I, 0, 2) sphere { 2*I*x, 1 } #end",
        spelled,
        "#for (I, 0, 3) sphere { 2*I*x, 1 } #end",
    );
    law(
        "#while spelled out",
        "#declare I = 0; #while (I < 3) sphere { 2*I*x, 1 } #declare I = I + 1; #end",
        spelled,
        "#declare I = 1; #while (I < 4) sphere { 2*I*x, 1 } #declare I = I + 1; #end",
    );
    law(
        "a macro spelled out",
        "#macro Ball(Where) sphere { Where, 1 } #end Ball(0) Ball(2*x) Ball(4*x)",
        spelled,
        "#macro Ball(Where) sphere { Where, 1 } #end Ball(0) Ball(4*x) Ball(2*x)",
    );
    law(
        "a macro that calls itself spelled out",
        "#macro Row(N) #if (N > 0) Row(N - 1) #end sphere { 2*N*x, 1 } #end Row(2)",
        spelled,
        "#macro Row(N) sphere { 2*N*x, 1 } #if (N > 0) Row(N - 1) #end #end Row(2)",
    );
    law(
        "includes spelled out",
        "#include \"nested.inc\"",
        "sphere { 3*x, 1 }",
        "#include \"ball.inc\" object { Ball }",
    );
    let choices = "#for (I, 0, 2) #switch (I) #case (0) sphere { 0, 1 } #break
                   #range (1, 1) sphere { 2*x, 1 } #break #else sphere { 4*x, 1 } #end #end";
    law(
        "choices spelled out",
        choices,
        spelled,
        &choices.replace("#range (1, 1)", "#range (2, 3)"),
    );
    let conditions =
        "#for (I, 0, 2) sphere { #if (I = 0) 0 #elseif (I = 1) 2*x #else 4*x #end, 1 } #end";
    law("conditions spelled out", conditions, spelled, &conditions.replace("I = 1", "I > 2"));
    law(
        "names, declared or not",
        "#ifdef (A) sphere { 0, 9 } #else #declare A = 1; #end
         #ifndef (A) sphere { 0, 8 } #end sphere { 0, A }",
        "sphere { 0, 1 }",
        "#ifdef (A) sphere { 0, 9 } #else #declare B = 1; #end
         #ifndef (A) sphere { 0, 8 } #end sphere { 0, B }",
    );
    law(
        "#local hides and goes",
        "#declare R = 2; #macro M() #local R = 1; sphere { 0, R } #end M() sphere { x, R }",
        "sphere { 0, 1 } sphere { x, 2 }",
        "#declare R = 2; #macro M() #declare R = 1; sphere { 0, R } #end M() sphere { x, R }",
    );
    law(
        "arithmetic spelled out",
        "sphere { <1 + 1, sqrt(16), pow(2, 3)>/2 - vcross(x, y), (3 > 2)*8/4 }",
        "sphere { <1, 2, 3>, 2 }",
        "sphere { <1 + 1, sqrt(16), pow(2, 3)>/2 - vcross(y, x), (3 > 2)*8/4 }",
    );
}

#[test]
fn textures_and_finishes() {
    law(
        "a texture is its pigment and its finish",
        "sphere { 0, 1 texture { pigment { rgb x } finish { phong 1 } } }",
        "sphere { 0, 1 pigment { rgb x } finish { phong 1 } }",
        "sphere { 0, 1 texture { pigment { rgb x } finish { phong 0.5 } } }",
    );
    law(
        "colours, spelled in every way",
        "#declare C = rgb <0.5, 0.25, 1>;
         sphere { 0, 1 pigment { C } } sphere { x, 1 pigment { color red 0.5 green 0.25 blue 1 } }",
        "sphere { 0, 1 pigment { rgb <0.5, 0.25, 1> } } sphere { x, 1 pigment { color rgb <2, 1, 4>/4 } }",
        "sphere { 0, 1 pigment { rgb <0.5, 0.25, 1> } } sphere { x, 1 pigment { color rgb <2, 1, 4>/8 } }",
    );
    law(
        "equal textures merge",
        "#declare T = texture { pigment { rgb y } } sphere { 0, 1 texture { T } } sphere { x, 1 texture { T } }",
        "sphere { 0, 1 pigment { rgb y } } sphere { x, 1 pigment { rgb y } }",
        "sphere { 0, 1 pigment { rgb y } } sphere { x, 1 pigment { rgb 0.99*y } }",
    );
    law(
        "#default is for what has none",
        "#default { pigment { rgb x } finish { ambient 0.5 } } sphere { 0, 1 } sphere { x, 1 pigment { rgb y } }",
        "sphere { 0, 1 pigment { rgb x } finish { ambient 0.5 } }
         sphere { x, 1 pigment { rgb y } finish { ambient 0.5 } }",
        "sphere { 0, 1 pigment { rgb x } finish { ambient 0.5 } } sphere { x, 1 pigment { rgb y } }",
    );
    law(
        "what weighs nothing is not there",
        "sphere { 0, 1 finish { phong 0 specular 0 reflection 0 } }",
        "sphere { 0, 1 }",
        "sphere { 0, 1 finish { phong 0 specular 0.01 reflection 0 } }",
    );
    law(
        "a gradient's direction has no length",
        "box { 0, 1 pigment { gradient 4*y } }",
        "box { 0, 1 pigment { gradient y } }",
        "box { 0, 1 pigment { gradient -y } }",
    );
    law(
        "a second finish goes on from the first",
        "#declare A = sphere { 0, 1 finish { phong 1 } finish { specular 0.5 } }
         object { A finish { reflection 0.2 } }",
        "sphere { 0, 1 finish { phong 1 specular 0.5 reflection 0.2 } }",
        "sphere { 0, 1 finish { reflection 0.2 } }",
    );
    law(
        "an albedo is spent where its finish ends",
        "#declare F = finish { diffuse albedo 0.25 brilliance 3 }
         sphere { 0, 1 finish { F brilliance 5 } }",
        "sphere { 0, 1 finish { diffuse 0.5 brilliance 5 } }",
        "sphere { 0, 1 finish { diffuse 0.25 brilliance 5 } }",
    );
    law(
        "a finish keeps what is not said again",
        "#declare F = finish { phong 1 reflection { 0.1, 0.5 falloff 2 metallic } }
         sphere { 0, 1 finish { F reflection 0.7 } }",
        "sphere { 0, 1 finish { phong 1 reflection { 0.7 falloff 2 metallic } } }",
        "sphere { 0, 1 finish { phong 1 reflection 0.7 } }",
    );
    law(
        "a pigment alone leaves a declared object its finish",
        "#declare A = sphere { 0, 1 finish { phong 1 } } object { A pigment { rgb x } }",
        "sphere { 0, 1 pigment { rgb x } finish { phong 1 } }",
        "#declare A = sphere { 0, 1 } object { A pigment { rgb x } }",
    );
    law(
        "a pattern moves with what it is on",
        "plane { y, 0 pigment { checker rgb 0 rgb 1 } translate <1, 0, 2> }",
        "plane { y, 0 pigment { checker rgb 0 rgb 1 translate <1, 0, 2> } }",
        "plane { y, 0 translate <1, 0, 2> pigment { checker rgb 0 rgb 1 } }",
    );
}

#[test]
fn lights() {
    law(
        "a direction has no length",
        "light_source { direction <0, 4, 0> color rgb 1 } sphere { 0, 1 }",
        "light_source { direction y color rgb 1 } sphere { 0, 1 }",
        "light_source { direction -y color rgb 1 } sphere { 0, 1 }",
    );
    law(
        "a light moves like any object",
        "light_source { x, rgb 1 rotate 90*z translate y } sphere { 0, 1 }",
        "light_source { 2*y, rgb 1 } sphere { 0, 1 }",
        "light_source { x, rgb 1 translate y rotate 90*z } sphere { 0, 1 }",
    );
    law(
        "a black light is none",
        "light_source { <1, 2, 3>, rgb 0 } sphere { 0, 1 }",
        "sphere { 0, 1 }",
        "light_source { <1, 2, 3>, rgb 0.001 } sphere { 0, 1 }",
    );
}
