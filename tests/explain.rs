//! Every page of `docs/diagnostics/` keeps its word: its first example is told exactly what the page
//! is about, and the example after "Instead" is told nothing.

use std::fs;
use std::process::Command;

use lucarne::diagnostic::Code;

/// A fenced example: the kind of file, the flags it is checked with, its text.
struct Example {
    extension: String,
    flags: Vec<String>,
    text: String,
}

/// The examples of a page before and after "Instead".
fn examples(page: &str) -> (Example, Example) {
    let (before, after) = page.split_once("\n## Instead\n").expect("an `Instead`");
    (example(before), example(after))
}

fn example(part: &str) -> Example {
    let mut pieces = part.split("```");
    let block = pieces.nth(1).expect("a fenced example");
    assert_eq!(pieces.count(), 1, "one example before and one after `Instead`");
    let (info, text) = block.split_once('\n').expect("a text");
    let mut words = info.split(' ').map(str::to_owned);
    let extension = words.next().expect("a kind of file");
    Example { extension, flags: words.collect(), text: text.to_owned() }
}

/// The codes that `lucarne check` reports for an example, each once.
fn codes(example: &Example) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let inside = folder.path().join("scene");
    fs::create_dir_all(inside.join("folder.inc")).expect("a folder");
    // What the pages on files speak of.
    fs::write(inside.join("deep.inc"), "#include \"deeper.inc\"\n").expect("written");
    fs::write(inside.join("deeper.inc"), "#include \"deepest.inc\"\n").expect("written");
    fs::write(inside.join("deepest.inc"), "\n").expect("written");
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    fs::write(inside.join("broken.obj"), format!("{corners}f 1 2 4\n")).expect("written");
    let plain = format!("mtllib plain.mtl\n{corners}f 1 2 3\n");
    fs::write(inside.join("plain.obj"), plain).expect("written");
    fs::write(folder.path().join("elsewhere.inc"), "\n").expect("written");
    let name = format!("example.{}", example.extension);
    let mut bytes = Vec::new();
    let mut parts = example.text.split("\\x");
    bytes.extend(parts.next().unwrap_or_default().as_bytes());
    for part in parts {
        let (byte, rest) = part.split_at(2);
        bytes.push(u8::from_str_radix(byte, 16).expect("two digits"));
        bytes.extend(rest.as_bytes());
    }
    fs::write(inside.join(&name), bytes).expect("written");
    let output = Command::new(env!("CARGO_BIN_EXE_lucarne"))
        .args(["check", "--message-format", "json", &name])
        .args(&example.flags)
        .current_dir(&inside)
        .output()
        .expect("runs");
    let messages = String::from_utf8(output.stdout).expect("UTF-8");
    let mut codes: Vec<String> = messages
        .lines()
        .map(|line| {
            let message: serde_json::Value = serde_json::from_str(line).expect("JSON");
            message["code"].as_str().expect("a code").to_owned()
        })
        .collect();
    if codes.is_empty() && !output.status.success() {
        codes.push(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    codes.dedup();
    codes
}

#[test]
fn each_page_is_about_its_code() {
    for code in Code::ALL {
        assert!(code.page().starts_with(&format!("# {}\n", code.name())), "{}", code.name());
    }
    let pages = fs::read_dir("docs/diagnostics").expect("pages").count();
    assert_eq!(pages, Code::ALL.len(), "a page without a code");
}

#[test]
fn each_first_example_is_told_its_code_and_nothing_else() {
    let mut wrong = String::new();
    for code in Code::ALL {
        let found = codes(&examples(code.page()).0);
        if found != [code.name()] {
            wrong += &format!("{}: {found:?}\n", code.name());
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn each_mended_example_is_told_nothing() {
    let mut wrong = String::new();
    for code in Code::ALL {
        let found = codes(&examples(code.page()).1);
        if !found.is_empty() {
            wrong += &format!("{}: {found:?}\n", code.name());
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}
