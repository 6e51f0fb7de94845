//! Calculations that go on behind directives.

use super::{VERSION, world};

/// What a text says first.
fn debugged(text: &str) -> String {
    world(&format!("{VERSION} {text}")).1
}

#[test]
fn a_calculation_goes_on_behind_a_directive_in_brackets() {
    let said = |expression: &str| {
        let text =
            format!("#declare N = 3; #declare A = {expression}; #debug concat(str(A, 0, 2), \"\")");
        debugged(&text)
    };
    // What POV-Ray 3.7 prints.
    assert_eq!(said("(0 #for (I, 1, 3) + I*I #end)"), "14.00");
    assert_eq!(said("(1 #if (1) - N #end)"), "-2.00");
    assert_eq!(said("(2 #if (1) * N #end)"), "6.00");
    assert_eq!(said("(2 #for (I, 1, 3) * I #end - 1)"), "11.00");
    assert_eq!(said("max(1 #if (1) + N #end, 2)"), "4.00");
    assert_eq!(said("vlength(<3 #if (1) + 1 #end, 3, 0>)"), "5.00");
    let function = |body: &str| {
        let text =
            format!("#declare F = function(x) {{ {body} }} #debug concat(str(F(2), 0, 2), \"\")");
        debugged(&text)
    };
    assert_eq!(function("x #for (I, 1, 3) + I*x #end"), "14.00");
    assert_eq!(function("x #for (I, 1, 3) * (I + x) #end"), "120.00");
    assert_eq!(function("sin(x #if (0) + 1 #else - x #end) + (x #if (1) * 2 - 1 #end)"), "3.00");
    // Operators bind as they do without the directive.
    assert_eq!(said("(1 + 2 #if (1) * N #end)"), "7.00");
    assert_eq!(said("(1 + 2 #if (1) * 3 - 1 #end * 2)"), "5.00");
    assert_eq!(said("(2 - 1 #if (1) - N*2 #end)"), "-5.00");
    assert_eq!(said("(2 * #if (1) N #else 4 #end)"), "6.00");
    assert_eq!(said("(2 + #if (1) N #else 4 #end * 2)"), "8.00");
    assert_eq!(said("(2 * #if (1) N + 4 #end)"), "10.00");
    assert_eq!(said("vlength(<2 * #if (1) 2 #end, 3, 0>)"), "5.00");
    assert_eq!(function("1 + x #if (1) * x - 1 #end * 2"), "3.00");
    assert_eq!(function("x * #if (0) 3 #else x + 4 #end"), "8.00");
}

#[test]
fn an_operator_whose_operand_no_directive_leaves_is_told() {
    let said = |expression: &str| debugged(&format!("#declare A = {expression};"));
    assert_eq!(said("(2 * #if (0) 3 #end)"), "expected a value after `*`");
    assert_eq!(said("(#if (1) * 3 #end)"), "expected a value before `*`");
    let said = |parts: &str| debugged(&format!("sphere {{ {parts} }}"));
    assert_eq!(said("0, 2 * #if (0) 3 #end pigment { rgb 1 }"), "expected a value after `*`");
    assert_eq!(
        said("0, 2 translate 2 * #if (1) pigment { rgb 1 } #end"),
        "expected a value after `*`"
    );
    assert_eq!(said("0, 2 pigment { rgb 1 } #if (1) * 2 #end"), "expected a value before `*`");
    // At the top level a statement follows, not an operand.
    assert_eq!(
        debugged("#declare A = 2 * #if (1) sphere { 0, 1 } #end"),
        "expected a value after `*`"
    );
}

#[test]
fn a_calculation_goes_on_behind_a_directive_in_blocks_and_macros() {
    let extent = |parts: &str| {
        debugged(&format!(
            "#declare N = 3; #declare A = sphere {{ {parts} }} \
             #debug vstr(3, max_extent(A), \" \", 0, 1)"
        ))
    };
    // What POV-Ray 3.7 prints.
    assert_eq!(extent("0, 2 * #if (1) N #end"), "6.0 6.0 6.0");
    assert_eq!(extent("0, 2 #if (1) * N + 1 #end"), "7.0 7.0 7.0");
    assert_eq!(extent("0, #if (1) 2 #else 3 #end * 4 - 1"), "7.0 7.0 7.0");
    assert_eq!(extent("0, 1 + 2 #if (1) * 4 #end #if (N) - 1 #end"), "8.0 8.0 8.0");
    assert_eq!(
        extent("#if (1) x #else y #end * 2 + z, 1 scale 3 #if (0) * 8 #else / 2 #end"),
        "4.5 1.5 3.0"
    );
    assert_eq!(
        extent("0, 1 translate x * #switch (N) #case (1) 2 #break #case (3) 5 #end"),
        "6.0 1.0 1.0"
    );
    let left = |body: &str| debugged(&format!("#macro M(N) {body} #end #debug str(M(4), 0, 1)"));
    assert_eq!(left("1 #for (I, 1, N) * I #end"), "24.0");
    assert_eq!(left("#if (N) 1 #else 2 #end * 3"), "3.0");
    assert_eq!(left("2 * #if (N) 3 #end"), "6.0");
}
