//! How far objects extend: what POV-Ray 3.7 prints of those that planes cut, and to the last digit.

use super::printed;

facts! {
    what_is_turned_is_as_wide_as_it_is:
        "#declare T = torus { 1, 0.25 rotate 45*z } V(max_extent(T))
         #declare B = box { -1, 1 rotate 45*y } V(max_extent(B))
         #declare C = cylinder { -y, y, 0.5 rotate 30*z } V(max_extent(C))
         #declare D = sphere { 0, 1 scale <1, 2, 3> rotate 45*x } V(max_extent(D))"
        => "<0.96,0.96,1.25> <1.41,1.00,1.41> <0.93,1.12,0.50> <1.00,2.55,2.55>";
    planes_alone_may_make_a_box:
        "#declare A = intersection { plane { x, 1 } plane { -x, 1 } plane { y, 2 } plane { -y, -0.5 }
           plane { z, 1 } plane { -z, 1 } } V(min_extent(A)) V(max_extent(A))"
        => "<-1.00,0.50,-1.00> <1.00,2.00,1.00>";
    a_plane_cuts_a_box:
        "#declare A = difference { box { -1, 1 } plane { y, 0.5 } } V(min_extent(A)) V(max_extent(A))"
        => "<-1.00,0.50,-1.00> <1.00,1.00,1.00>";
    planes_cut_a_long_bar:
        "#declare A = intersection { cylinder { -9*y, 9*y, 1 } plane { y, 2 } plane { -y, 1 } }
         V(min_extent(A)) V(max_extent(A))"
        => "<-1.00,-1.00,-1.00> <1.00,2.00,1.00>";
    a_plane_cuts_a_sphere_that_is_moved:
        "#declare A = difference { sphere { 0, 1 } plane { y, 0.5 } translate 2*x }
         V(min_extent(A)) V(max_extent(A))"
        => "<1.00,0.50,-1.00> <3.00,1.00,1.00>";
    what_planes_cut_is_turned_and_scaled:
        "#declare A = difference { box { -1, 1 } plane { y, 0.5 } scale 3 rotate 90*z translate x }
         #declare B = difference { box { -1, 1 } plane { y, 0.5 } scale <1, -2, 3> rotate <-90, 180, 0> }
         V(min_extent(A)) V(max_extent(A)) V(min_extent(B)) V(max_extent(B))"
        => "<-2.00,-3.00,-3.00> <-0.50,3.00,3.00> <-1.00,-3.00,-2.00> <1.00,3.00,-1.00>";
    what_planes_cut_is_cut_again:
        "#declare A = difference { difference { box { -1, 1 } plane { y, 0.5 } } plane { x, 0.25 } }
         #declare B = intersection { box { -2, 2 } merge { object { A } sphere { 3*y, 2 } } plane { y, 1.5 } }
         V(min_extent(A)) V(max_extent(A)) V(min_extent(B)) V(max_extent(B))"
        => "<0.25,0.50,-1.00> <1.00,1.00,1.00> <-2.00,0.50,-2.00> <2.00,1.50,2.00>";
    planes_cut_a_quadric:
        "#declare A = intersection { quadric { <1, 0, 1>, 0, 0, -1 } plane { y, 2 } plane { -y, 1 } }
         P(min_extent(A).y) P(max_extent(A).y)"
        => "-1.000 2.000";
    what_has_no_end_on_one_side_has_none_on_any:
        "#declare A = intersection { plane { x, 1 } plane { -x, 1 } plane { y, 2 } }
         #declare B = union { sphere { 0, 1 } plane { y, -3 } }
         P(max_extent(A).x) P(min_extent(A).y) P(max_extent(B).y)"
        => "10000000000.000 -10000000000.000 10000000000.000";
    a_plane_askew_cuts_nothing_off_a_box:
        "#declare A = difference { box { -1, 1 } plane { x + y, 0 } } V(min_extent(A)) V(max_extent(A))"
        => "<-1.00,-1.00,-1.00> <1.00,1.00,1.00>";
    what_begins_at_0_begins_at_0:
        "#macro Below(O) P((min_extent(O).y < 0)) #end
         #declare S = sphere { y, 1 } Below(S)
         #declare S = sphere { y, 1 scale <3, 0.5, 1> } Below(S)
         #declare S = box { 0, <3, 5, 7> rotate 90*y } Below(S)
         #declare S = cylinder { 0, 3*y, 1 } Below(S)
         #declare S = cone { 0, 1, y, 0.5 } Below(S)
         #declare S = torus { 2, 0.5 translate 0.5*y } Below(S)
         #declare S = prism { linear_sweep linear_spline 0, 1, 5, <0,0>, <1,0>, <1,1>, <0,1>, <0,0> } Below(S)
         #declare S = lathe { linear_spline 4, <1,0>, <2,0>, <2,3>, <1,0> } Below(S)
         #declare S = quadric { <1, 1, 1>, 0, <0, -2, 0>, 0 } Below(S)
         #declare S = bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3
           <0,0,0>, <1,0,0>, <2,0,0>, <3,0,0>, <0,0,1>, <1,0,1>, <2,0,1>, <3,0,1>,
           <0,0,2>, <1,0,2>, <2,0,2>, <3,0,2>, <0,0,3>, <1,0,3>, <2,0,3>, <3,0,3> } Below(S)"
        => "0.000 0.000 0.000 0.000 0.000 0.000 0.000 0.000 0.000 0.000";
}

/// POV-Ray 3.7 gives a disc and a polygon a thousandth on both sides, a triangle less, and what is nowhere no
/// end.
#[test]
fn what_is_flat_has_no_height_and_what_is_nowhere_no_extent() {
    let flat = "#declare A = disc { 0, y, 1 } #declare B = polygon { 5, 0, x, x + z, z, 0 }
        #declare C = triangle { 0, x, z }
        P((min_extent(A).y < 0)) P((max_extent(B).y > 0)) P((min_extent(C).y < 0))";
    assert_eq!(printed(flat), "0.000 0.000 0.000");
    let nowhere = "#declare A = difference { box { -1, 1 } plane { y, 5 } }
        #declare B = union { sphere { 0, 0.5 } object { A } } V(max_extent(A)) V(max_extent(B))";
    assert_eq!(printed(nowhere), "<0.00,0.00,0.00> <0.50,0.50,0.50>");
}

/// POV-Ray 3.7 ignores what an object with an end is clipped by.
#[test]
fn what_is_clipped_ends_where_it_is_cut() {
    let clipped = "#declare A = sphere { 0, 1 clipped_by { plane { y, 0.5 } } } V(max_extent(A))";
    assert_eq!(printed(clipped), "<1.00,0.50,1.00>");
}
