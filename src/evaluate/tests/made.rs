//! Arrays, splines and functions of the author's: what POV-Ray 3.7 prints, and what is told.

use super::printed;

facts! {
    the_heights_of_a_pigment_are_its_brightness:
        "#declare Norm = <0,0,0>; #declare H = height_field { function 8, 8 { pigment { rgb <0.2,0.5,0.9> } } }
         P(trace(H, <0.5,5,0.5>, -y, Norm).y)"
        => "0.456";
    an_array_is_copied_when_it_is_assigned:
        "#declare A = array[3] {1,2,3} #declare B = A; #declare B[0] = 9; P(A[0]) P(B[0])"
        => "1.000 9.000";
    a_parameter_refers_to_its_callers_array:
        "#macro N(p) #declare p[2]=7; #end #declare A = array[3] {1,2,3} N(A) P(A[2])" => "7.000";
    an_element_is_passed_by_reference:
        "#macro M(p) #declare p=5; #end #declare A = array[3] {1,2,3} M(A[1]) P(A[1])" => "5.000";
    an_element_and_the_parameter_that_refers_to_it_are_one:
        "#macro M(p) #declare A[1]=7; P(p) #end #declare A = array[3] {1,2,3} M(A[1]) P(A[1])"
        => "7.000 7.000";
    an_element_of_a_parameter_is_passed_on:
        "#macro M(p) #declare p=p+5; #end #macro N(q) M(q[1]) #end #declare A = array[2] {1,2} N(A) P(A[1])
         #declare B = array[2] {A, A} #macro O(r) M(r[1]) #end O(B[0]) P(B[0][1]) P(B[1][1])"
        => "7.000 12.000 7.000";
    arrays_have_up_to_five_dimensions:
        "#declare C = array[2][3] {{1,2,3},{4,5,6}} P(C[1][2]) P(dimensions(C)) P(dimension_size(C,2))
         #declare D = array[2][2][2][2][2] #declare D[1][1][1][1][1] = 4; P(D[1][1][1][1][1])"
        => "6.000 2.000 3.000 4.000";
    arrays_hold_arrays:
        "#declare C = array[2][3] {{1,2,3},{4,5,6}} #declare D = array[2] {C, C} P(D[1][1][2])
         #declare D[0][0][0] = 8; P(D[0][0][0]) P(D[1][0][0]) P(C[0][0])"
        => "6.000 8.000 1.000 1.000";
    elements_may_be_unset_and_forgotten:
        "#declare E = array[2] #declare E[0] = \"a\"; #ifdef (E[0]) P(1) #end #ifdef (E[1]) P(2) #end
         #undef E[0] #ifdef (E[0]) P(3) #end"
        => "1.000";
    an_index_is_cut_off_to_a_whole_number:
        "#declare A = array[2]{7,8}; P(A[1.9]) P(A[0.99999999999])" => "8.000 8.000";
    a_size_is_cut_off_too:
        "#declare A = array[2.7] {1,2} P(dimension_size(A,1))" => "2.000";
    commas_between_values_may_be_left_out_and_left_over:
        "#declare A = array[2] {1 2} P(A[1]) #declare B = array[2] {1,2,} P(B[1])" => "2.000 2.000";
    a_macro_may_make_an_array:
        "#macro M() array[2]{1,2} #end #declare A=M() P(A[1])" => "2.000";
    objects_and_textures_are_elements_too:
        "#declare R = array[2] {sphere{0,1}, box{-1,<2,3,4>}} V(max_extent(R[1])) object { R[0] }"
        => "<2.00,3.00,4.00>";

    an_index_outside_of_its_array_is_told:
        "#declare A = array[2] {1,2} P(A[2])"
        => "the array has no element 2: its indices go from 0 to 1";
    a_negative_index_is_told:
        "#declare A = array[2] {1,2} #declare A[-1] = 4;"
        => "the array has no element -1: its indices go from 0 to 1";
    an_element_that_was_never_set_is_told:
        "#declare A = array[2] #declare B = A[0];" => "this element of the array was never set";
    a_row_is_no_value:
        "#declare C = array[2][3] {{1,2,3},{4,5,6}} #declare Z = C[0];"
        => "`C` needs 2 indices, and is given 1";
    an_array_holds_values_of_one_kind:
        "#declare F = array[2] { <1,2,3>, 5 }"
        => "an array holds values of one kind: so far a vector, here a number";
    too_many_values_are_told:
        "#declare E = array[2] {1,2,3}" => "the array has 2 values here, and is given 3 values";
    six_dimensions_are_told:
        "#declare A = array[2][2][2][2][2][2]" => "this array has 6 dimensions";
    an_array_without_elements_is_told:
        "#declare A = array[0]" => "an array cannot have 0 elements";

    splines_of_every_kind_go_through_their_values:
        "#declare S = spline { natural_spline 2,<1,2,3>, 0,<5,5,5>, 1,<9,9,9> } V(S(0.5)) V(S(7))"
        => "<8.12,8.03,7.94> <1.00,2.00,3.00>";
    a_splines_kind_may_be_chosen_when_it_is_asked:
        "#declare S = spline { 0,<0,0,0>, 1,<4,0,0>, 2,<0,0,0> } V(S(0.5)) V(S(0.5, quadratic_spline))"
        => "<2.00,0.00,0.00> <3.00,0.00,0.00>";
    a_spline_may_go_on_from_another:
        "#declare A = spline { natural_spline 2,<1,2,3>, 0,<5,5,5> }
         #declare S = spline { A linear_spline 4, <5,5,5> } V(S(3))"
        => "<3.00,3.50,4.00>";
    values_of_a_spline_meet_as_in_sums:
        "#declare S = spline { 0,<1,2>, 1,<3,4,5> } V(S(0.5))" => "<2.00,3.00,2.50>";
    a_spline_without_values_is_told:
        "#declare S = spline { }" => "this spline has no values";

    a_function_has_x_y_and_z_by_itself:
        "#declare F = function { x + 2*y + 3*z } P(F(1,2,3))" => "14.000";
    u_is_x_and_v_is_y:
        "#declare G = function(a,b) { a-b } #declare F = function(x,y,z) { G(u,v) } P(F(5,3,1))"
        => "2.000";
    comparisons_in_a_function_are_exact:
        "#declare F = function(a,b) { a=b } P(F(1,1+1e-9)) P(F(1,1)) #declare G = function(a,b) { a<b }
         P(G(1,1+1e-12))"
        => "0.000 1.000 1.000";
    and_binds_more_than_or_in_a_function_and_as_much_elsewhere:
        "#declare F = function(a) { 1|0&a } P(F(0)) #declare G = function(a,b) { a & b | 0 } P(G(2,3))
         #declare H = function(a,b,c) { a|b|c&0 } P(H(1,0,0)) #declare I = function(a,b) { (a|b)&0 } P(I(1,0))
         #declare J = function(a,b,c) { a>0|b>0&c>0&a<0 } P(J(1,-1,-1)) P((1|0&0))"
        => "1.000 1.000 1.000 0.000 1.000 0.000";
    select_takes_three_or_four:
        "#declare F = function(a) { select(a,1,2,3) } #declare G = function(a) { select(a,1,2) }
         P(F(-1)) P(F(0)) P(F(1)) P(G(0)) P(G(-0.1))"
        => "1.000 2.000 3.000 2.000 1.000";
    whole_parts_and_remainders:
        "#declare F = function(a,b) { int(a)+div(a,b)*100+mod(a,b)*10000 } P(F(-7.5,2))"
        => "-15307.000";
    angles_and_extremes:
        "#declare F = function(a,b) { atan2(a,b)+min(a,b,3)+max(a,b,4) } P(F(-7.5,2))" => "-4.810";
    sums_and_products_count:
        "#declare F = function(a,b) { sum(i,1,a,i*b) + prod(j,1,b,j) } P(F(4,3))" => "36.000";
    what_is_declared_is_taken_as_it_is_then:
        "#declare K = 3; #declare F = function(a) { a*K } #declare K = 5; P(F(2))" => "6.000";
    signs_and_powers:
        "#declare F = function(a) { -a*-2 + pow(a,-2) } P(F(4)) #declare G = function(a) { pi*a + clock }
         P(G(4))"
        => "8.062 12.566";
    a_spline_may_be_a_function:
        "#declare S = function { spline { 0,<0,1,2>, 1,<4,5,6> } } V(S(0.5))
         #declare F = function(s) { S(s).y * 10 } P(F(0.5))"
        => "<2.00,3.00,4.00> 30.000";
    a_function_is_passed_to_a_macro:
        "#macro Twice(F, A) P(F(F(A))) #end #declare G = function(n) { n+2 } Twice(G, 1)" => "5.000";
    components_of_what_is_declared_may_be_used:
        "#declare V3 = <1,2,3>; #declare F = function(a) { a + V3.y } P(F(1))" => "3.000";
    a_choice_in_a_function_is_told_and_made:
        "#declare F = function(a,b) { (a>0 ? b : -b) } P(F(-2,3))"
        => "a function has no `?` and `:` in POV-Ray-3.000";

    a_name_that_is_not_declared_is_told_where_the_function_is_defined:
        "#declare F = function(a) { a + Foo }" => "`Foo` is not declared";
    an_axis_that_is_no_parameter_is_told:
        "#declare F = function(a) { a + x }" => "`x` is no parameter of this function";
    a_parameter_has_no_value_for_a_vector:
        "#declare F = function(a) { vlength(<a,1,2>) }"
        => "a function works on numbers, and `vlength` on a vector";
    a_wrong_number_of_arguments_is_told:
        "#declare F = function(a,b) { a+b } P(F(1))" => "`F` takes 2 arguments, and is given 1";
    what_has_no_value_is_not_a_number:
        "#declare F = function(a) { sqrt(-a) } P(F(1))" => "nan";
    a_parameter_named_by_a_word_is_told:
        "#declare F = function(t) { t + 1 }" => "`t` is a word of the language, and no name of a parameter";
    of_two_parameters_of_one_name_the_first_counts:
        "#declare F = function(A,A) { A } P(F(2, 3))" => "2.000";
    x_and_u_are_one_parameter_and_the_last_counts:
        "#declare F = function(x,u) { x+u } P(F(2, 3))" => "6.000";
}
