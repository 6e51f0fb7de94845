//! What a name means, and where: tables that open and close.

use super::*;

fn number(scopes: &mut Scopes, symbol: Symbol) -> Option<f64> {
    scopes.read(symbol).and_then(Value::as_number)
}

#[test]
fn a_local_hides_the_global_until_its_table_closes() {
    let mut scopes = Scopes::default();
    let a = scopes.intern("a");
    scopes.assign(a, Value::Number(1.0));
    scopes.open();
    assert_eq!(number(&mut scopes, a), Some(1.0));
    scopes.assign_local(a, Value::Number(2.0));
    scopes.assign(a, Value::Number(3.0));
    assert_eq!(number(&mut scopes, a), Some(3.0));
    scopes.close();
    assert_eq!(number(&mut scopes, a), Some(1.0));
}

#[test]
fn declare_in_a_macro_makes_a_global() {
    let mut scopes = Scopes::default();
    let a = scopes.intern("a");
    scopes.open();
    scopes.assign(a, Value::Number(1.0));
    scopes.close();
    assert_eq!(number(&mut scopes, a), Some(1.0));
}

#[test]
fn a_reference_passes_the_value_out() {
    let mut scopes = Scopes::default();
    let (a, p) = (scopes.intern("a"), scopes.intern("p"));
    scopes.assign(a, Value::Number(1.0));
    let slot = scopes.slot(a).expect("declared");
    scopes.open();
    scopes.bind(p, slot, false);
    scopes.assign(p, Value::Number(9.0));
    scopes.close();
    assert_eq!(number(&mut scopes, a), Some(9.0));
    assert_eq!(number(&mut scopes, p), None);
}

#[test]
fn an_undefined_name_is_gone() {
    let mut scopes = Scopes::default();
    let a = scopes.intern("a");
    scopes.assign(a, Value::Number(1.0));
    assert!(scopes.undefine(a));
    assert!(!scopes.undefine(a));
    assert_eq!(number(&mut scopes, a), None);
    scopes.assign(a, Value::Number(2.0));
    assert_eq!(number(&mut scopes, a), Some(2.0));
}
