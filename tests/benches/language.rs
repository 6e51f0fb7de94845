//! How fast the language runs, beside POV-Ray 3.7 where it is installed.
//!
//! `cargo bench --bench language`. **In:** loops and macros written here, one text for both programs.
//! **Out:** a row each: CPU seconds of our `--stats json` from the text to the World, those of
//! POV-Ray's own "Parse Time", runs alternating, and the ratio of the least. Ratios of one run can be
//! compared, seconds of two cannot: the machine may have been busy.

use std::fs;
use std::path::Path;
use std::process::Command;

const PAIRS: usize = 7;

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let with_povray = Command::new("povray").arg("--version").output().is_ok();
    if !with_povray {
        println!("POV-Ray is not installed (`povray`): nothing to compare with");
    }
    println!("CPU seconds, the least of {PAIRS}      lucarne  POV-Ray    ratio");
    let row = |what: &str, scene: &str, promised: &str| {
        let source = folder.path().join("scene.pov");
        let head = "#version 3.7; global_settings { assumed_gamma 1 } camera { location -9*z }\n";
        fs::write(&source, format!("{head}{scene}")).expect("a scene written");
        let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..PAIRS {
            ours = ours.min(lucarne(&source));
            if with_povray {
                theirs = theirs.min(povray(&source));
            }
        }
        print!("{what:33} {ours:8.3}");
        if with_povray {
            print!(" {theirs:8.3} {:8.2}{promised}", theirs / ours);
        }
        println!();
    };
    let ball = "#macro Ball(P, R) sphere { P, R } #end\n";
    let promised = "   promised: 5";
    row("a macro's object, placed", &turns(ball, "Ball(<I, 0, 9>, 0.5)"), promised);
    row("a macro's object, declared", &turns(ball, "#declare S = Ball(<I, 0, 9>, 0.5)"), promised);
    let painted = "#macro Ball(P, R, C) sphere { P, R pigment { rgb C } } #end\n";
    let call = "Ball(<I, 0, 9>, 0.5, <I/200000, 0.5, 1>)";
    row("a macro's object, painted", &turns(painted, call), "");
    let moved = "#macro Ball(P, R, C) sphere { 0, R pigment { rgb C } finish { phong 1 } \
                 rotate I*y translate P } #end\n";
    row("the same, shiny, turned and moved", &turns(moved, call), "");
    row("an object in a loop", &turns("", "sphere { <I, 0, 9>, 0.5 }"), "");
    let nested = "#macro Add(A, B) #declare A = A + B; #end\n\
                  #macro Twice(X) #local Y = 2; Add(X, Y) Add(X, 1) #end\n";
    row("macros in macros, by reference", &turns(nested, "#declare V = I; Twice(V)"), "");
    let store = "#declare A = array[200000];\n#for (I, 0, 199999) #declare A[I] = 2*I; #end\n";
    row("elements of an array set", store, "");
    row("strings put together", &turns("", "#declare S = concat(\"a\", str(I, 0, 0), \"b\");"), "");
    let function = "#declare F = function(x, y) { x*x + y*sin(x) };\n";
    row("a function called", &turns(function, "#declare Y = F(I, 2);"), "");
    let inline: String = (0..100_000).map(|i| format!("sphere {{ <{i}, 0, 9>, 0.5 }}\n")).collect();
    row("100,000 objects as text", &inline, "");
    row("5 MB of mesh2 text", &surface(), "   promised: 1");
}

/// About 5 MB of a `mesh2`: a wavy sheet of 210 × 210 vertices, as a program writes it, with more digits than are needed.
fn surface() -> String {
    const SIDE: usize = 210;
    let corners = (0..SIDE * SIDE).map(|i| ((i % SIDE) as f64, (i / SIDE) as f64));
    let vertex = |(x, y): (f64, f64)| {
        format!("<{:.12}, {:.12}, {:.12}>", x / 7.0, y / 7.0, (x * y / 99.0).sin())
    };
    let normal = |(x, y): (f64, f64)| format!("<0, {:.6}, -1>", (x * y / 99.0).cos());
    let faces = (0..SIDE * SIDE).filter(|i| i % SIDE + 1 < SIDE && i / SIDE + 1 < SIDE);
    let faces = faces.flat_map(|i| [[i, i + 1, i + SIDE], [i + 1, i + SIDE + 1, i + SIDE]]);
    let block = |word: &str, items: Vec<String>| {
        format!("{word} {{ {},\n{}\n}}\n", items.len(), items.join(",\n"))
    };
    let vertices = block("vertex_vectors", corners.clone().map(vertex).collect());
    let normals = block("normal_vectors", corners.map(normal).collect());
    let faces = block("face_indices", faces.map(|[a, b, c]| format!("<{a}, {b}, {c}>")).collect());
    format!("mesh2 {{\n{vertices}{normals}{faces}}}\n")
}

/// What comes before, then 200,000 turns of a `#while`.
fn turns(before: &str, body: &str) -> String {
    format!("{before}#declare I = 0;\n#while (I < 200000)\n{body}\n#declare I = I + 1;\n#end\n")
}

fn lucarne(source: &Path) -> f64 {
    let output = Command::new(env!("CARGO_BIN_EXE_lucarne"))
        .args(["render", "--threads", "1", "--stats=json", "--size=8x8", "-o"])
        .args([&source.with_extension("ours.png"), source])
        .output()
        .expect("lucarne starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let stats: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let seconds = |key: &str| stats[key].as_f64().expect("seconds");
    seconds("parse_cpu_s") + seconds("evaluate_cpu_s") + seconds("lower_cpu_s")
}

fn povray(source: &Path) -> f64 {
    let output = Command::new("povray")
        .args(["+WT1", "+W8", "+H8", "-A", "-D", "-V"])
        .arg(format!("+I{}", source.display()))
        .arg(format!("+O{}", source.with_extension("theirs.png").display()))
        .output()
        .expect("povray starts");
    let report = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{report}");
    let part = report.split("Parse Time:").nth(1).expect("a time");
    let number = part.split("with ").nth(1).and_then(|rest| rest.split(' ').next());
    number.and_then(|number| number.parse().ok()).expect("CPU seconds")
}
