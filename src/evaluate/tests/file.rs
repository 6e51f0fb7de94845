//! Files as POV-Ray 3.7 reads and writes them: every answer here is what it printed, but where a comment
//! says otherwise.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::super::*;
use crate::diagnostic::Severity;
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::source::{FileError, Found, WriteError};

/// Files in memory, all of which may be written.
#[derive(Default)]
struct Memory(RefCell<BTreeMap<String, Vec<u8>>>);

impl Memory {
    fn with(name: &str, text: &str) -> Self {
        Self(RefCell::new(BTreeMap::from([(name.to_owned(), text.as_bytes().to_vec())])))
    }

    fn text(&self, name: &str) -> String {
        String::from_utf8(self.0.borrow()[name].clone()).expect("UTF-8")
    }
}

impl Files for Memory {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        let found = self.0.borrow().get(name).cloned();
        let bytes =
            found.ok_or(FileError::NotFound { searched: Vec::new(), similar: Vec::new() })?;
        Ok(Found { name: name.to_owned(), bytes })
    }

    fn start(&self, name: &str, append: bool) -> Result<String, WriteError> {
        let mut files = self.0.borrow_mut();
        let file = files.entry(name.to_owned()).or_default();
        if !append {
            file.clear();
        }
        Ok(name.to_owned())
    }

    fn add(&self, name: &str, bytes: &[u8]) {
        if let Some(file) = self.0.borrow_mut().get_mut(name) {
            file.extend(bytes);
        }
    }
}

/// What a scene prints, and what is wrong with it.
fn told(files: &Memory, text: &str) -> String {
    let mut road = Road::new(files, Options::new(Dialect::Pov));
    let file = road.read("a.pov", text.as_bytes().to_vec());
    let ast = road.parse(file);
    road.evaluate(ast);
    let told = road.diagnostics.iter().filter(|one| one.severity != Severity::Warning);
    told.map(|one| one.message.as_str()).collect()
}

/// What is printed by reading values into `A` until the file ends.
fn numbers_of(text: &str) -> String {
    let scene = "#fopen F \"in.txt\" read #while (defined(F)) #read (F, A)
        #debug concat(\"[\", str(A, 0, 1), \"]\", str(defined(F), 0, 0)) #end";
    told(&Memory::with("in.txt", text), scene)
}

fn read_from(text: &str, scene: &str) -> String {
    told(&Memory::with("in.txt", text), &format!("#fopen F \"in.txt\" read {scene}"))
}

fn written_by(scene: &str) -> String {
    let files = Memory::default();
    let faults = told(&files, &format!("#fopen F \"out.txt\" write {scene} #fclose F"));
    assert_eq!(faults, "");
    files.text("out.txt")
}

#[test]
fn a_file_is_defined_until_its_last_value_is_read() {
    assert_eq!(numbers_of("1,2,3"), "[1.0]1[2.0]1[3.0]0");
    assert_eq!(numbers_of("1,2,3\n"), "[1.0]1[2.0]1[3.0]0");
    assert_eq!(numbers_of("1, -2e3, .5, 1.,+6"), "[1.0]1[-2000.0]1[0.5]1[1.0]1[6.0]0");
    assert_eq!(numbers_of("1, // c\n 2 /* d */, 3"), "[1.0]1[2.0]1[3.0]0");
    // After a comma there may be more; then nothing is set.
    assert_eq!(numbers_of("1,2,3,"), "[1.0]1[2.0]1[3.0]1[3.0]0");
    // POV-Ray reads 1 and 3 here.
    assert_eq!(numbers_of("1 2 3"), "[1.0]1[2.0]1[3.0]0");
}

#[test]
fn past_the_end_nothing_is_set() {
    let both = "#while (defined(F)) #read (F, A, B) #debug concat(str(A, 0, 0), \",\",
        #ifdef (B) str(B, 0, 0) #else \"-\" #end, \" \") #end";
    assert_eq!(read_from("1,2,3,4", both), "1,2 3,4 ");
    assert_eq!(read_from("1,2,3", both), "1,2 3,2 ");
    assert_eq!(read_from("1", both), "1,- ");
}

#[test]
fn a_name_takes_the_kind_that_is_read() {
    let vector = "#read (F, A) #debug vstr(3, A, \",\", 0, 1)";
    assert_eq!(read_from("<1,2,3>", &format!("#declare A = 1; {vector}")), "1.0,2.0,3.0");
    assert_eq!(read_from("<-1, - 2,+3>", vector), "-1.0,-2.0,3.0");
    assert_eq!(read_from("<1 2 3>", vector), "1.0,2.0,3.0");
    assert_eq!(read_from("1", "#declare A = \"s\"; #read (F, A) #debug str(A, 0, 1)"), "1.0");
    assert_eq!(read_from("\"a\"", "#declare A = x; #read (F, A) #debug A"), "a");
    let strings = "#read (F, A) #debug A #read (F, A) #debug A";
    assert_eq!(read_from("\"a\\n\\\"b\", \"c\"", strings), "a\n\"bc");
    let five = "#while (defined(F)) #read (F, A) #debug vstr(5, A, \",\", 0, 0) #debug \" \" #end";
    assert_eq!(read_from("<1,2,3>, <4,5>", five), "1,2,3,0,0 4,5,0,0,0 ");
}

#[test]
fn values_are_read_into_elements_parameters_and_locals() {
    let elements =
        "#declare R = array[2] {1, 2} #read (F, R[0], R[1]) #debug str(R[0] + R[1], 0, 0)";
    assert_eq!(read_from("7,8", elements), "15");
    let parameter = "#macro M(P) #read (F, P) #end #declare Q = 0; M(Q) #debug str(Q, 0, 0)";
    assert_eq!(read_from("7,8", parameter), "7");
    let local = "#macro M() #local Q = 0; #read (F, Q) #debug str(Q, 0, 0) #end M()
        #ifdef (Q) #debug \"global\" #end";
    assert_eq!(read_from("7,8", local), "7");
    let global = "#macro M() #read (F, Q) #end M() #ifdef (Q) #debug \"global\" #end";
    assert_eq!(read_from("7,8", global), "global");
}

#[test]
fn what_is_not_open_may_be_closed_and_may_be_opened_again() {
    assert_eq!(read_from("1", "#read (F, A) #fclose F #fclose F #debug \"ok\""), "ok");
    let again = "#fclose F #debug str(defined(F), 0, 0) #fopen F \"in.txt\" read #read (F, A)
        #debug str(A, 0, 0)";
    assert_eq!(read_from("5,6", again), "05");
}

#[test]
fn numbers_vectors_and_strings_are_written_as_pov_ray_writes_them() {
    let plain =
        "#write (F, 1, \" \", 1/3, \" \", 123456789.123, \"\\n\", <1, 2>, x, 2*x + 1, true)";
    assert_eq!(written_by(plain), "1 0.333333 1.23457e+08\n<1,2> <1,0,0> <3,1,1> 1");
    assert_eq!(
        written_by("#write (F, \"a\\tb\\\"c\\\\d\", concat(\"x\", \"y\"), str(1, 5, 2))"),
        "a\tb\"c\\dxy 1.00"
    );
    assert_eq!(written_by("#write (F, \"a\" 5 \"b\" 6 7)"), "a5b67");
    let branches = "#write (F, #if (0) \"a\", #else \"b\", #end 5, \"\\n\")";
    assert_eq!(written_by(branches), "b5\n");
    assert_eq!(written_by("#write (F, uint8 72 105, uint8 <33, 10>, 4)"), "Hi!\n4");
}

#[test]
fn what_is_written_is_read_and_included_as_it_is_then() {
    let files = Memory::default();
    let scene = "#macro Save(Text) #fopen F \"a.inc\" write #write (F, Text) #fclose F #end
        Save(\"#debug \\\"one \\\"\") #include \"a.inc\"
        Save(\"#debug \\\"two \\\"\") #include \"a.inc\" #include \"a.inc\"
        #fopen F \"a.inc\" append #write (F, \"#debug \\\"three \\\"\") #fclose F #include \"a.inc\"
        #debug str(file_exists(\"a.inc\"), 0, 0) #debug str(file_exists(\"b.inc\"), 0, 0)";
    assert_eq!(told(&files, scene), "one two two two three 10");
    let scene = "#fopen F \"c.inc\" write #write (F, \"#debug \\\"one \\\"\") #include \"c.inc\"
        #write (F, \"#debug \\\"two \\\"\") #include \"c.inc\"";
    assert_eq!(told(&files, scene), "one one two ");
    let scene =
        "#fopen F \"n.txt\" write #write (F, 3) #fclose F #fopen F \"n.txt\" read #read (F, N)
        #fopen F \"n.txt\" append #write (F, \",\", N + 1) #fclose F
        #fopen F \"n.txt\" read #read (F, N, N) #debug str(N, 0, 0)";
    assert_eq!(told(&files, scene), "4");
}

#[test]
fn a_scene_does_not_write_itself() {
    let files = Memory::with("a.pov", "");
    assert_eq!(
        told(&files, "#fopen F \"a.pov\" write #write (F, 1)"),
        "`a.pov` is this scene itself"
    );
}

#[test]
fn a_string_and_a_signed_number_behind_it_are_two_values() {
    let files = Memory::default();
    let text = "#fopen F \"a\" write #write (F, \"a\" -1, \"b\" - 2*3) #fclose F";
    assert_eq!(told(&files, text), "");
    assert_eq!(files.text("a"), "a-1b-6");
}
