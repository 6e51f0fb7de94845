//! Recognises files of other programs: web pages, meshes, scripts, pictures.
//!
//! **In:** a text. **Out:** its actual format, and where it begins. **Invariant:** a text with a line that
//! begins like a scene's is a scene, whatever else it contains; otherwise one diagnostic covers the whole
//! text.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Span};
use crate::vocabulary::{Role, Word};

/// The most lines that are searched.
const LINES: usize = 200;

/// A recognised format, and the advice for it.
struct Kind {
    name: &'static str,
    help: &'static str,
}

const MESH: &str = "a `.scene` file reads it with `mesh { file \"…\" }`: `#include` is for scenes";
const PROGRAM: &str = "run it with its own program, and give what it writes";

/// Returns a diagnostic for a text that is not a scene; `None` if it may be one.
pub(super) fn foreign(text: &str, file: FileId) -> Option<Diagnostic> {
    let start = text.len() - text.trim_start().len();
    let body = &text[start..];
    let Kind { name, help } =
        by_its_mark(text).or_else(|| by_its_start(body)).or_else(|| by_its_lines(body))?;
    let first = body.find(char::is_whitespace).unwrap_or(body.len());
    let span = Span::new(file, start, start + first);
    let message = format!("this is {name}, not a scene");
    Some(Diagnostic::new(Code::ForeignFile, message).at(span, "the file begins so").help(help))
}

/// Recognises binary formats. Bytes that are not UTF-8 were read as Latin-1.
fn by_its_mark(text: &str) -> Option<Kind> {
    const PICTURE: &str = "a picture belongs into a pigment, or a height field";
    const MARKS: [(&str, &str, &str); 14] = [
        ("\u{89}PNG", "a picture in PNG", PICTURE),
        ("\u{ff}\u{d8}\u{ff}", "a picture in JPEG", PICTURE),
        ("GIF8", "a picture in GIF", PICTURE),
        ("II*\0", "a picture in TIFF", PICTURE),
        ("MM\0*", "a picture in TIFF", PICTURE),
        ("RIFF", "a picture, a sound or a film (RIFF)", PICTURE),
        ("%PDF-", "a PDF document", "copy the scene's text out of it"),
        ("PK\u{3}\u{4}", "an archive (ZIP)", "unpack it first"),
        ("\u{1f}\u{8b}", "a compressed file (gzip)", "unpack it first"),
        ("\u{7f}ELF", "a program for the machine", PROGRAM),
        ("glTF\u{2}\0", "a mesh in glTF", MESH),
        ("BLENDER", "a scene of Blender's", "export it first"),
        ("\u{ff}\u{fe}", "a text in UTF-16", "save it as UTF-8"),
        ("\u{fe}\u{ff}", "a text in UTF-16", "save it as UTF-8"),
    ];
    let marked = MARKS.iter().find(|(mark, ..)| text.starts_with(mark));
    if let Some(&(_, name, help)) = marked {
        return Some(Kind { name, help });
    }
    // No text has several zeros near its start.
    let zeros = text.bytes().take(4096).filter(|byte| *byte == 0).count();
    (zeros > 2).then_some(Kind { name: "no text", help: "a scene is a text file" })
}

/// Recognises formats by their first characters.
fn by_its_start(text: &str) -> Option<Kind> {
    let lower: String = text.chars().take(200).collect::<String>().to_ascii_lowercase();
    let kind = |name, help| Some(Kind { name, help });
    if lower.starts_with("<!doctype html") || lower.starts_with("<html") {
        return kind("a page of the web (HTML)", "the scene itself is perhaps behind a link on it");
    }
    if lower.starts_with("<?xml") || is_tagged(&lower) {
        return kind("an XML file", "a scene has words and braces, and no tags");
    }
    if is_json(text) && text.contains("\"asset\"") && text.contains("\"meshes\"") {
        return kind("a mesh in glTF", MESH);
    }
    if is_json(text) {
        return kind("a JSON file", "a scene has words before its braces: `sphere { 0, 1 }`");
    }
    if lower.starts_with("#!") {
        return kind("a program", PROGRAM);
    }
    if lower.starts_with("#vrml") || lower.starts_with("#x3d") {
        return kind("a VRML file", "a scene's own words for it: `sphere { 0, 1 }`");
    }
    if lower.starts_with("\\documentclass") || lower.starts_with("\\begin{") {
        return kind("a document for LaTeX", "a scene has words and braces: `sphere { 0, 1 }`");
    }
    if lower.starts_with("{\\rtf") {
        return kind("a document of a word processor (RTF)", "save the scene as plain text");
    }
    if lower.starts_with("##renderman") {
        return kind("a scene for RenderMan", "a scene has words and braces: `sphere { 0, 1 }`");
    }
    if lower.starts_with("--- a/") || lower.starts_with("diff --git") {
        return kind("a list of changes (diff)", "apply it to the scene that it is about");
    }
    if lower.starts_with("newmtl") {
        const OF_MESH: &str =
            "they come with their mesh: `mesh { file \"….obj\" }` in a `.scene` file";
        return kind("materials of a mesh in Wavefront's OBJ", OF_MESH);
    }
    if lower.starts_with("solid") && lower.contains("facet normal") {
        return kind("a mesh in STL", MESH);
    }
    if lower.starts_with("ply\n") || lower.starts_with("ply\r\n") {
        return kind("a mesh in PLY", MESH);
    }
    None
}

/// Returns whether the text begins with a tag such as `<svg …>` or `<scene version="2.0.0">`, after a comment
/// or not.
fn is_tagged(lower: &str) -> bool {
    let behind = match lower.strip_prefix("<!--") {
        Some(rest) => rest.split_once("-->").map_or("", |(_, after)| after.trim_start()),
        None => lower,
    };
    let Some(tag) = behind.strip_prefix('<').filter(|tag| tag.starts_with(char::is_alphabetic))
    else {
        return false;
    };
    let Some((inside, _)) = tag.split_once('>') else { return false };
    !inside.contains(',') && (inside.contains("=\"") || inside.chars().all(char::is_alphanumeric))
}

/// Returns whether the text begins like JSON: `{ "key":`, `[ {`, or empty braces.
fn is_json(text: &str) -> bool {
    let Some(rest) = text.strip_prefix(['{', '[']) else { return false };
    let rest = rest.trim_start();
    let Some(quoted) = rest.strip_prefix('"') else {
        return text.starts_with('[') && rest.starts_with('{') && is_json(rest);
    };
    let key = quoted.split_once('"').map(|(_, after)| after.trim_start());
    text.starts_with('{') && key.is_some_and(|after| after.starts_with(':'))
}

/// Recognises languages by several of their lines.
fn by_its_lines(text: &str) -> Option<Kind> {
    type Test = fn(&str) -> bool;
    // An unmistakable line counts for more.
    const LANGUAGES: [(Test, usize, &str, &str); 9] = [
        (is_pbrt, 2, "a scene for PBRT", "a scene has words and braces: `sphere { 0, 1 }`"),
        (is_obj, 3, "a mesh in Wavefront's OBJ", MESH),
        (imports_from, 1, "a program in Python", PROGRAM),
        (is_python, 2, "a program in Python", PROGRAM),
        (is_openscad, 3, "a model for OpenSCAD", "a scene's own words for it: `difference`, `box`"),
        (is_c, 2, "a program in C, or for a graphics card", PROGRAM),
        (is_yaml, 4, "a YAML file", "a scene has words and braces: `sphere { 0, 1 }`"),
        (is_script, 2, "a program in JavaScript", PROGRAM),
        (
            is_ini,
            2,
            "a file of options (INI)",
            "`lucarne FILE.ini` renders the scene that it names",
        ),
    ];
    let mut counts = [0; LANGUAGES.len()];
    for line in text.lines().map(str::trim_end).take(LINES) {
        if begins_as_a_scene(line.trim_start()) {
            return None;
        }
        for (count, (is_its, ..)) in counts.iter_mut().zip(LANGUAGES) {
            *count += usize::from(is_its(line));
        }
    }
    let found = counts.iter().zip(LANGUAGES).find(|(count, (_, least, ..))| *count >= least)?;
    let (_, (_, _, name, help)) = found;
    Some(Kind { name, help })
}

/// `#declare`, `camera {`: lines of no other language.
fn begins_as_a_scene(line: &str) -> bool {
    const DIRECTIVES: [&str; 6] =
        ["#declare", "#local", "#macro", "#version 3.", "#default", "#include \""];
    if DIRECTIVES.iter().any(|directive| line.starts_with(directive)) {
        return true;
    }
    let end = line.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(line.len());
    let opens = line[end..].trim_start().starts_with('{');
    let words = ["if", "else", "for", "while", "switch", "do"];
    opens
        && !words.contains(&&line[..end])
        && Word::from_name(&line[..end]).is_some_and(|word| word.role() == Role::Statement)
}

/// `v 1.0 2.0 3.0`, `f 1//1 2//1 3//1`.
fn is_obj(line: &str) -> bool {
    let mut words = line.split_ascii_whitespace();
    let Some("v" | "vn" | "vt" | "f") = words.next() else { return false };
    let mut count = 0;
    let number = |word: &str| word.chars().all(|c| c.is_ascii_digit() || "+-./eE".contains(c));
    words.inspect(|_| count += 1).all(number) && (2..=8).contains(&count)
}

/// `WorldBegin`, `Shape "sphere" "float radius" 1`.
fn is_pbrt(line: &str) -> bool {
    const ALONE: [&str; 4] = ["WorldBegin", "WorldEnd", "AttributeBegin", "AttributeEnd"];
    const WITH_KIND: [&str; 7] =
        ["Camera", "Film", "Integrator", "LightSource", "Material", "Sampler", "Shape"];
    let (word, rest) = line.trim().split_once(' ').unwrap_or((line.trim(), ""));
    ALONE.contains(&word) && rest.is_empty()
        || WITH_KIND.contains(&word) && rest.trim_start().starts_with('"')
}

/// `from math import sin`: only in Python.
fn imports_from(line: &str) -> bool {
    let mut words = line.split_ascii_whitespace();
    let (from, import) = (words.next(), words.nth(1));
    from == Some("from") && import == Some("import") && !line.ends_with(';')
}

/// `import math`, `def f(x):`, `for i in range(3):`.
fn is_python(line: &str) -> bool {
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    match words.as_slice() {
        ["import", module] => {
            module.bytes().all(|b| b.is_ascii_alphanumeric() || b"._".contains(&b))
        }
        ["import", _, "as", _] => !line.ends_with(';'),
        ["def" | "class" | "for" | "while" | "if" | "elif" | "with", _, ..] => line.ends_with(':'),
        _ => false,
    }
}

/// `$fn = 64;`, `module leg() {`, `translate([0, 0, 1]) …`.
fn is_openscad(line: &str) -> bool {
    let line = line.trim_start();
    let calls = [
        "translate([",
        "rotate([",
        "scale([",
        "mirror([",
        "color([",
        "color(\"",
        "cube(",
        "sphere(",
        "cylinder(",
        "square(",
        "circle(",
        "polygon(",
        "linear_extrude(",
        "rotate_extrude(",
    ];
    let blocks = ["difference()", "union()", "intersection()", "hull()", "minkowski()", "module "];
    let special = ["$fn", "$fa", "$fs"]
        .iter()
        .any(|name| line.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('=')));
    let files =
        (line.starts_with("use <") || line.starts_with("include <")) && line.contains(".scad>");
    let starts = |list: &[&str]| list.iter().any(|start| line.starts_with(start));
    special || files || starts(&calls) || starts(&blocks)
}

/// `#include <stdio.h>`, `int main() {`, `uniform mat4 view;`.
fn is_c(line: &str) -> bool {
    let starts = |list: &[&str]| list.iter().any(|start| line.starts_with(start));
    starts(&["#include <", "uniform ", "layout(", "#version 330", "#version 4", "using namespace "])
        || (starts(&["int ", "void ", "float ", "static "]) && line.contains('('))
        || (starts(&["in ", "out ", "varying "]) && line.contains(" vec"))
}

/// `camera:`, `  location: [0, 1, 5]`, `- sphere: 1`.
fn is_yaml(line: &str) -> bool {
    let line = line.trim_start().trim_start_matches("- ");
    let name = line.split(':').next().unwrap_or("");
    let rest = &line[name.len()..];
    !name.is_empty()
        && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
        && (rest == ":" || rest.starts_with(": "))
        && !rest.contains(['<', '{', '?'])
        && !rest.ends_with([',', ';'])
}

/// `const scene = new THREE.Scene();`, `import * as THREE from 'three';`.
fn is_script(line: &str) -> bool {
    let line = line.trim_start();
    let declares = ["const ", "let ", "var "].iter().any(|start| line.starts_with(start));
    let imports = line.starts_with("import ") && line.contains(" from ");
    let calls = line.contains("document.") || line.contains("THREE.") || line.contains("=> {");
    imports
        || (line.starts_with("function ") && line.contains(") {"))
        || calls
        || (declares && line.contains("= new "))
        || line.starts_with("export ")
}

/// `Width=640`, `Input_File_Name="a.pov"`.
fn is_ini(line: &str) -> bool {
    const NAMES: [&str; 10] = [
        "width",
        "height",
        "antialias",
        "antialias_threshold",
        "input_file_name",
        "output_file_name",
        "initial_frame",
        "final_frame",
        "quality",
        "display",
    ];
    let Some((name, value)) = line.split_once('=') else { return false };
    !value.trim().is_empty()
        && !value.contains(['{', ';', '<'])
        && NAMES.contains(&name.trim().to_ascii_lowercase().as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> Option<String> {
        foreign(text, FileId(0)).map(|told| told.message)
    }

    #[test]
    fn what_is_no_scene_is_told_by_name() {
        let files = [
            ("\n<!DOCTYPE html>\n<p>404</p>", "HTML"),
            ("<?xml version=\"1.0\"?>\n<COLLADA/>", "XML"),
            ("{\n \"asset\": { \"version\": \"2.0\" } }", "JSON"),
            ("{ \"asset\": { \"version\": \"2.0\" }, \"meshes\": [] }", "glTF"),
            ("[ { \"radius\": 1 } ]", "JSON"),
            ("solid cube\nfacet normal 0 0 1\n", "STL"),
            ("ply\nformat ascii 1.0\n", "PLY"),
            ("# cube\no Cube\nv 1 1 1\nv 1 -1 1\nf 1//1 2//1 3//1\n", "OBJ"),
            ("import math\n\nfor i in range(3):\n    print(i)\n", "Python"),
            ("$fn = 64;\nmodule leg() {\n  cube([1, 2, 3]);\n}\n", "OpenSCAD"),
            ("import * as THREE from 'three';\nconst s = new THREE.Scene();\n", "JavaScript"),
            ("#version 330 core\nuniform mat4 view;\nvoid main() { }\n", "graphics card"),
            ("#include <stdio.h>\nint main(void) {\n}\n", "in C"),
            ("from vapory import *\nlight = LightSource([2, 4, 3])\n", "Python"),
            ("camera:\n  location: [0, 1, 5]\nobjects:\n  - sphere: 1\n", "YAML"),
            ("LookAt 3 4 1  0 0 0  0 0 1\nWorldBegin\n  Shape \"sphere\"\nWorldEnd\n", "PBRT"),
            ("\u{89}PNG\r\n\u{1a}\n", "PNG"),
            ("\u{ff}\u{d8}\u{ff}\u{e0}", "JPEG"),
            ("sphere\0\0\0{", "no text"),
            ("--- a/a.pov\n+++ b/a.pov\n@@ -1 +1 @@\n", "diff"),
            ("; options\nWidth=640\nHeight=480\n", "INI"),
        ];
        for (text, name) in files {
            assert!(told(text).is_some_and(|message| message.contains(name)), "{text}");
        }
    }

    #[test]
    fn what_may_be_a_scene_is_read_as_one_however_broken() {
        let scenes = [
            "",
            "<0, 1, 2>",
            "{ sphere { 0, 1 } }",
            "import \"colors.inc\"\nsphere { 0, 1 }\n",
            "difference() {\n  cube([1, 2, 3]);\n}\ncamera { location 5 }\ncube(1);\ncube(2);\n",
            "import math\nimport random\n#declare A = 1;\n",
            "v 1 2 3\n",
            "const a = 1;\nlet b = 2;\nlet c = 3;\n",
            "width = 3\n",
            "a = f(1)\nb = f(2)\n",
            "camera: { location: 1 }\nsphere: <0, 1, 2>\n",
        ];
        for text in scenes {
            assert_eq!(told(text), None, "{text}");
        }
    }
}
