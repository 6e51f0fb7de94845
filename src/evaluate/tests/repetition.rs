//! What is told once is worked out once, however often a loop comes to it.

use std::cell::Cell;

use crate::diagnostic::suggest::SEARCHES;
use crate::diagnostic::{Code, Diagnostics, Levels, Severity};
use crate::road::{Options, Road};
use crate::source::{FileError, Files, Found};
use crate::vocabulary::Dialect;

/// No file is there; counts how often one was looked for.
#[derive(Default)]
struct Nowhere(Cell<u32>);

impl Files for Nowhere {
    fn read(&self, _: &str, _: &str) -> Result<Found, FileError> {
        self.0.set(self.0.get() + 1);
        Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() })
    }
}

fn told(files: &Nowhere, dialect: Dialect, text: &str) -> Diagnostics {
    let mut options = Options::new(dialect);
    options.levels = Levels::new(true);
    let mut road = Road::new(files, options);
    let file = road.read("a.scene", text.as_bytes().to_vec());
    let ast = road.parse(file);
    road.evaluate(ast);
    std::mem::take(&mut road.diagnostics)
}

/// How often a closest word was looked for, and how many messages were kept.
fn work(text: &str) -> (u64, usize) {
    let before = SEARCHES.get();
    let told = told(&Nowhere::default(), Dialect::Scene, text);
    (SEARCHES.get() - before, told.len())
}

#[test]
fn a_loop_looks_once_for_what_each_mistake_in_it_was_meant_to_be() {
    let bodies = [
        "sphere { 0, 1 pigmnt { rgb 1 } wibble 3 }",
        "wobble { sphere { 0, 1 } }",
        "wobble 3 translat(3)",
        "rotat(I) sphere { 0, I + Wobble }",
        "sphere { 0, 1 pigment { colr rgb 1 } }",
        "#declare C = camra { location 0 };",
        "#undef Gone sphere { Gone, 1 }",
        "#macro M(A, optional B) sphere { 0, B } #end M(1)",
        "import \"shapes\"",
        "cube { 0, 1 } sphere { 0, 1 shininess 3 }",
        "#include \"colrs.inc\"",
        "#include concat(\"col\", \"rs.inc\")",
    ];
    for body in bodies {
        let turns = |n: u32| work(&format!("#for (I, 1, {n}) {body} #end"));
        let (searches, messages) = turns(1);
        assert!(messages > 0 && searches > 0, "{body}");
        assert_eq!(turns(300), (searches, messages), "{body}");
    }
}

#[test]
fn a_file_that_is_not_there_is_looked_for_once_in_a_loop() {
    for body in ["#include \"tree.inc\"", "#fopen F \"tree.txt\" read"] {
        let files = Nowhere::default();
        let told = told(&files, Dialect::Pov, &format!("#for (I, 1, 300) {body} #end"));
        assert_eq!(files.0.get(), 1, "{body}");
        assert_eq!(told.iter().filter(|one| one.code == Code::MissingInclude).count(), 1, "{body}");
    }
}

#[test]
fn a_loop_with_very_many_mistakes_tells_each_once() {
    let words: String = (0..400).map(|n| format!("sphere {{ 0, 1 wibble{n} }}\n")).collect();
    assert_eq!(work(&format!("#for (I, 1, 5) {words} #end")).1, 400);
}

#[test]
fn what_differs_only_in_its_numbers_from_turn_to_turn_is_told_once() {
    assert_eq!(work("#for (I, 1, 5000) sphere { 0, -I } #end").1, 1);
    // Calls from two places are two.
    let ball = "#macro Ball(R) sphere { 0, R } #end";
    assert_eq!(work(&format!("{ball} #for (I, 1, 9) Ball(-I) #end Ball(-99)")).1, 2);
    // The author's own are all wanted.
    assert_eq!(work("#for (I, 1, 500) #warning str(I, 0, 0) #end").1, 500);
}

#[test]
fn what_is_only_a_warning_ends_no_loop() {
    let text = "#declare N = 0;
        #for (I, 1, 1500) #declare N = N + 1; #declare S = sphere { 0, -I } #end
        #while (N < 3000) #declare N = N + 1; #declare S = sphere { 0, -N } #end
        #if (N != 3000) #error \"it ended early\" #end";
    for dialect in [Dialect::Scene, Dialect::Pov] {
        let told = told(&Nowhere::default(), dialect, text);
        assert!(told.iter().all(|one| one.severity != Severity::Error), "{told:?}");
    }
}

#[test]
fn a_break_leaves_a_macro_and_no_loop_around_it() {
    let text = "#macro Sign(V) #if (V < 0) -1 #break #end 1 #end
        #macro Count() #if (N = 3) #break #end #declare N = N + 1; #end
        #declare N = 0;
        #for (I, 1, 9) Count() #end
        #if (Sign(-5) != -1 | Sign(5) != 1 | N != 3) #error \"no\" #end";
    let told = told(&Nowhere::default(), Dialect::Pov, text);
    assert!(told.iter().all(|one| one.severity != Severity::Error), "{told:?}");
}

#[test]
fn what_was_taken_back_is_told_where_it_counts() {
    let text = "#macro Half(A) 1/A #end #declare B = (0 ? Half(0) : 1); #declare C = Half(0);";
    let told = told(&Nowhere::default(), Dialect::Scene, text);
    assert_eq!(told.iter().filter(|one| one.code == Code::DivisionByZero).count(), 1);
}

#[test]
fn an_error_before_long_loops_says_that_not_all_of_them_was_run() {
    let helps = |turns: u32| {
        let text = format!("sphere {{ 0, Gone }} #for (I, 1, {turns}) #end");
        let told = told(&Nowhere::default(), Dialect::Pov, &text);
        let error = told.iter().find(|one| one.is_error()).expect("`Gone` is not declared");
        error.help.iter().filter(|help| help.contains("there may be more errors")).count()
    };
    assert_eq!((helps(1_000), helps(1_000_000)), (0, 1));
}
