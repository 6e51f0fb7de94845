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
    assert_eq!(said("(2 * #if (0) 3 #end)"), "expected a value, found nothing");
    assert_eq!(said("(#if (1) * 3 #end)"), "expected a value before `*`");
}
