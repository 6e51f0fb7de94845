//! Worlds of all that the language can place, in a text whose lengths are all times `K`.

/// Cameras of both kinds, all lengths times `K`.
pub const CAMERAS: [&str; 2] = [
    "camera { location <1, 3, 9>*K look_at <0, 1, 0>*K angle 45 }",
    "camera { orthographic location <4, 5, 9>*K direction <-0.4, -0.5, -0.9>*K right <6, 0, -3>*K up <0, 5, -1>*K }",
];

/// All that the language can place, all lengths times `K`: every kind of light, a light that fades,
/// clear things, filled and tinted, touching and one in the other. An object is a line.
pub const THINGS: &str = "
    global_settings { max_trace_level 5 }
    background { rgb <0.1, 0.2, 0.3> }
    sky_sphere { pigment { gradient <0.3, 0.8, 0.5> color_map { [0 rgbt <0.1, 0.2, 0.4, 0.3>] [1 rgb <0.9, 0.7, 0.4>] } scale 0.3 } /* moved */ }
    light_source { <5, 8, 9>*K, rgb 0.4 }
    light_source { <-5, 8, 1>*K, rgb <0.2, 0.1, 0.1> parallel point_at <0, 1, 0>*K }
    light_source { direction <-2, 3, 1> color rgb <0.2, 0.2, 0.4> }
    light_source { <-4, 7, 5>*K, rgb <0.5, 0.4, 0.2> spotlight radius 8 falloff 20 tightness 3 point_at <-1.5, 1, 0>*K }
    light_source { <2, 6, 4>*K, rgb <0.3, 0.5, 0.4> spotlight radius 10 falloff 30 point_at <1, 0, 1>*K fade_distance 5*K fade_power 3 }
    light_source { <0.5, 7, 3>*K, rgb <0.4, 0.3, 0.5> cylinder radius 0.7*K falloff 1.9*K tightness 1 point_at <0.2, 0, 1>*K }
    light_source { <-3, 2, 4>*K, rgb <0.4, 0.4, 0.1> fade_distance 1.7*K fade_power 1.5 }
    light_source { <3, 4, -1>*K, rgb <0.1, 0.3, 0.2> parallel point_at <0, 0, 1>*K fade_distance 3*K fade_power 2 shadowless }
    plane { y, 0 pigment { checker rgb 0.9 rgb 0.3 scale K rotate 20*y translate 0.3*K } finish { reflection 0.3 } }
    plane { <0.1, 0.2, 1>, -5*K pigment { gradient <1, 2, 3> color_map { [0 rgb x] [0.4 rgb y] [1 rgb z] } scale 0.7*K } }
    sphere { <-1.5, 1, 0>*K, K pigment { rgb <0.9, 0.3, 0.2> } finish { phong 0.7 reflection 0.2 } }
    sphere { <0.1, 0, 0>, 1 pigment { checker rgb 1 rgb 0.2 scale 0.3 } scale <1, 0.5, 0.8> rotate 30*z scale K translate <0.2, 2.4, -1>*K }
    box { -0.8, 0.8 rotate <20, 30, 0> scale K translate <1.6, 1.2, 0.3>*K pigment { rgb <0.2, 0.4, 0.9> } finish { specular 0.5 metallic } }
    box { 0, K matrix <1, 0.2, 0, 0.3, 1, 0.1, 0, 0.4, 1, 0, 0, 0> translate <-1, 0, 3>*K pigment { rgb <0.4, 0.9, 0.2> } }
    box { <-3, 0.7, 2>*K, <-2, 0.7, 3>*K pigment { rgb <0.8, 0.7, 0.2> } finish { brilliance 2 } double_illuminate }
    union { #for (I, 1, 9) sphere { <0.5*I - 2.5, 0.2, 4>*K, 0.2*K } #end pigment { rgb 0.7 } finish { kd 0.6 ks 0.3 phong_exponent 20 } }
    sphere { <0.3, 0.9, 2.6>*K, 0.6*K pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { phong 0.5 reflection { 0, 0.9 fresnel } conserve_energy } interior { ior 1.5 } }
    sphere { <0.3, 0.9, 2.6>*K, 0.25*K pigment { rgbft <0.9, 0.5, 0.9, 0.5, 0.3> } interior { ior 1.2 } }
    sphere { 0, 1 scale <0.5, 0.3, 0.4> rotate 25*z scale K translate <1.7, 0.4, 3.2>*K pigment { checker rgbt <1, 0.3, 0.2, 0.7> rgb 0.4 scale 0.21*K } interior { ior 1.33 } hollow }
    box { <-1.9, 0.3, 2.1>*K, <-0.9, 1.3, 2.2>*K pigment { rgbf <0.4, 0.7, 1, 0.8> } interior { ior 1.1 } }
    box { <-1.9, 0.3, 2.2>*K, <-0.9, 1.3, 2.3>*K pigment { rgbf <1, 0.7, 0.4, 0.8> } interior { ior 2.4 } no_reflection }
    plane { y, 0.05*K pigment { rgbt <0.7, 0.9, 1, 0.8> } finish { diffuse 0.1 } interior { ior 1.33 } }
    plane { -y, -30*K inverse pigment { gradient x color_map { [0 rgbt 1] [1 rgbf <1, 0.8, 0.6, 0.9>] } scale 3*K } no_shadow }
";

/// Every kind of solid that is no sphere, plane or box, all lengths times `K`; some of them clear, in each other,
/// and put together. An object is a line.
pub const SHAPES: &str = "
    background { rgb <0.1, 0.2, 0.3> }
    light_source { <5, 8, 9>*K, rgb 0.7 }
    light_source { <-6, 5, 4>*K, rgb <0.2, 0.2, 0.3> }
    plane { y, -1.5*K pigment { checker rgb 0.9 rgb 0.3 scale K } finish { reflection 0.2 } }
    cylinder { <-3, 2, 0>*K, <-2.2, 3, 0.4>*K, 0.4*K pigment { rgb <0.8, 0.5, 0.3> } finish { phong 0.5 } }
    cylinder { <-0.9, 1.7, 1>*K, <-0.3, 1.9, 1.4>*K, 0.3*K open pigment { rgb <0.3, 0.5, 0.8> } }
    cone { <-1.8, 2.2, 0>*K, 0.5*K, <-1.2, 3.2, 0.4>*K, 0.1*K pigment { rgb <0.8, 0.3, 0.3> } }
    cone { <-1.6, 1.1, 1>*K, 0.4*K, <-1.6, 1.8, 1.2>*K, -0.1*K open pigment { rgb <0.4, 0.8, 0.3> } }
    disc { <0, 2.9, 0>*K, <0.2, 0.3, 0.5>, 0.6*K, 0.2*K pigment { rgb <0.9, 0.8, 0.3> } }
    torus { 0.4*K, 0.15*K rotate 60*x translate <1.4, 2.9, 0>*K pigment { checker rgb <0.8, 0.3, 0.8> rgb 0.2 scale 0.11*K } }
    torus { 0.2*K, 0.3*K rotate 30*z translate <2.7, 2.7, 0>*K pigment { rgb <0.3, 0.8, 0.8> } }
    quadric { <1, 2, 3>, <0.2, 0, 0.1>, 0, -0.2*K*K translate <-3, 0.9, 0>*K pigment { rgb <0.5, 0.8, 0.3> } }
    cubic { <1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,-0.1*K*K*K> clipped_by { box { -0.7*K, 0.7*K } } translate <-0.5, -0.7, 1>*K pigment { rgb <0.8, 0.6, 0.6> } }
    quartic { <1,0,0,0,2,0,0,2,0,-0.65*K*K,0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,0.35*K*K,0,0,0,0,1,0,-0.65*K*K,0,0.030625*K*K*K*K> rotate 40*y translate <-1.7, 0.2, 0.5>*K pigment { rgb <0.3, 0.4, 0.9> } }
    triangle { <-0.5, 0.6, 0>*K, <0.4, 0.7, 0.3>*K, <0, 1.5, 0>*K pigment { rgb <0.9, 0.4, 0.2> } }
    mesh { smooth_triangle { <0.6, 0.6, 0>*K, <-1, 0, 1>, <1.4, 0.6, 0.3>*K, <1, 0, 1>, <1, 1.5, 0>*K, <0, 1, 1> } triangle { <0.6, 0.6, 0>*K, <1.4, 0.6, 0.3>*K, <1, 0, 0.9>*K } pigment { rgb <0.2, 0.7, 0.5> } }
    mesh2 { vertex_vectors { 4, <1.8, 0.6, 0>*K, <2.6, 0.6, 0.3>*K, <2.2, 1.4, 0>*K, <2.2, 0.8, 0.7>*K } face_indices { 4, <0, 1, 2>, <0, 1, 3>, <1, 2, 3>, <0, 2, 3> } inside_vector y pigment { rgbf <0.9, 0.8, 0.6, 0.6> } interior { ior 1.3 } }
    blob { threshold 0.5 sphere { <2.8, 1, 0>*K, 0.6*K, 1 } cylinder { <3, 1.2, 0>*K, <3.3, 1.9, 0.2>*K, 0.4*K, 0.8 } sphere { <2.7, 1.2, 0.4>*K, 0.3*K, -0.5 } pigment { rgb <0.7, 0.3, 0.7> } }
    prism { linear_spline 0, 0.5*K, 6, <-0.5, 0>*K, <0, 0.5>*K, <0.5, 0>*K, <0.35, -0.5>*K, <0, -0.1>*K, <-0.5, 0>*K rotate 50*x translate <-3, -0.6, 0.8>*K pigment { rgb <0.8, 0.7, 0.2> } }
    prism { conic_sweep cubic_spline 0.2, 1, 7, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1>, <1, -1>, <1, 1> scale 0.5*K rotate 20*z translate <-2, -1.2, 1.4>*K pigment { rgb <0.6, 0.7, 0.9> } }
    lathe { quadratic_spline 5, <0.1, -0.25>*K, <0.4, 0>*K, <0.2, 0.25>*K, <0.45, 0.5>*K, <0.15, 0.6>*K rotate -30*x translate <0.4, -0.8, 1.5>*K pigment { rgb <0.9, 0.6, 0.3> } }
    sor { 5, <0.15, -0.4>*K, <0.4, -0.2>*K, <0.2, 0.15>*K, <0.35, 0.45>*K, <0.1, 0.6>*K rotate 20*z translate <1.3, -0.6, 1>*K pigment { rgb <0.4, 0.9, 0.6> } }
    ovus { 0.4*K, 0.25*K rotate 40*z translate <2.3, -0.4, 0.5>*K pigment { rgb <0.9, 0.9, 0.6> } finish { reflection 0.2 } }
    sphere_sweep { b_spline 5, <-2, 0, 0>*K, 0.1*K, <-1, 1, 0>*K, 0.15*K, <0, 0, 0.5>*K, 0.1*K, <1, 1, 0>*K, 0.2*K, <2, 0, 0>*K, 0.1*K scale 0.6 translate <1.4, 1.8, 0.5>*K pigment { rgb <0.3, 0.6, 0.4> } }
    sphere_sweep { linear_spline 3, <-0.5, 0, 0>*K, 0.1*K, <0, 0.5, 0>*K, 0.2*K, <0.5, 0, 0.2>*K, 0.05*K translate <3.1, -0.1, 0.6>*K pigment { rgb <0.8, 0.4, 0.5> } }
    superellipsoid { <0.4, 0.7> scale 0.4*K rotate 20*y translate <0, -0.5, 2.8>*K pigment { rgb <0.5, 0.5, 0.9> } }
    julia_fractal { <-0.1, 0.2, -0.7, -0.1> quaternion max_iteration 4 scale 0.25*K translate <-1.7, 1.7, 1.2>*K pigment { rgb <0.9, 0.7, 0.3> } }
    isosurface { function { x*x + y*y + z*z - 1 + 0.2*sin(6*x) } contained_by { box { -1.3, 1.3 } } max_gradient 4 scale 0.35*K translate <-1, -0.45, 2.6>*K pigment { rgb <0.9, 0.5, 0.5> } }
    parametric { function { cos(u)*cos(v) }, function { sin(v) }, function { sin(u)*cos(v) } <-pi, -1.5>, <pi, 1.5> contained_by { box { -1.1, 1.1 } } max_gradient 2 scale 0.35*K translate <2.2, -0.2, 2.5>*K pigment { rgb <0.5, 0.9, 0.9> } }
    polygon { 5, <-0.4, -0.3>*K, <0.4, -0.3>*K, <0.1, 0>*K, <0, 0.4>*K, <-0.4, -0.3>*K rotate 20*y translate <3.6, 2.2, 0>*K pigment { rgb <0.9, 0.7, 0.8> } }
    bicubic_patch { type 1 u_steps 4 v_steps 4 flatness 0 <-1, 0.6, -1>, <-0.3, -0.2, -1>, <0.3, -0.2, -1>, <1, 0.6, -1>, <-1, -0.4, -0.3>, <-0.3, -0.9, -0.3>, <0.3, 0.7, -0.3>, <1, -0.4, -0.3>, <-1, -0.4, 0.3>, <-0.3, 0.9, 0.3>, <0.3, -0.9, 0.3>, <1, -0.4, 0.3>, <-1, 0.6, 1>, <-0.3, -0.2, 1>, <0.3, -0.2, 1>, <1, 0.6, 1> scale 0.4*K rotate 40*x translate <-4.2, 2.4, 0>*K pigment { rgb <0.6, 0.8, 0.7> } }
    height_field { function 12, 12 { 1 - 2*max(abs(x - 0.5), abs(y - 0.5)) } water_level 0.01 translate -0.5 scale <1, 0.5, 1>*K rotate <30, 30, 0> translate <-4.2, 1.2, 0>*K pigment { rgb <0.7, 0.6, 0.4> } }
    text { \"ab\" 0.3, 0 scale 0.8*K translate <3.3, 3, 0>*K pigment { rgb <0.8, 0.8, 0.4> } }
    difference { box { -K, K } sphere { <0.5, 0.6, 0.7>*K, 0.9*K } cylinder { -2*z*K, 2*z*K, 0.4*K } scale 0.4 rotate <20, 30, 0> translate <1.1, -0.4, 2.7>*K pigment { rgb <0.7, 0.7, 0.4> } }
    merge { sphere { 0, 0.3*K } cylinder { 0, 0.6*y*K, 0.2*K } pigment { rgbf <0.7, 0.9, 0.7, 0.8> } interior { ior 1.4 } translate <0.5, 0.3, 2.9>*K }
    sphere { 0, 0.4*K clipped_by { plane { <1, 1, 0.2>, 0.1*K } } translate <-2.4, -0.1, 2>*K pigment { rgb <0.8, 0.8, 0.8> } }
";
