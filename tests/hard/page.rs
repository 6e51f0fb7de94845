//! `docs/numerics.md` says what is there: its prices are the benchmark's rows, its cases are those of
//! tests that exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lucarne::shape::Body;

use super::rows::{HEADER, ROWS};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn page() -> String {
    fs::read_to_string(root().join("docs/numerics.md")).expect("the page")
}

/// The cells of each row of the table under `header`.
fn table(page: &str, header: &str) -> Vec<Vec<String>> {
    let mut lines = page.lines().skip_while(|line| *line != header);
    assert!(lines.next().is_some(), "no table under `{header}`");
    let rows = lines.skip(1).take_while(|line| line.starts_with('|'));
    let cells = |row: &str| {
        let row = row.replace("\\|", "¦");
        row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    rows.map(cells).collect()
}

#[test]
fn the_pages_prices_are_the_benchmarks_rows() {
    let page = page();
    let expected = ROWS.iter().flat_map(|(name, distances)| {
        distances.iter().map(|far| vec![(*name).to_owned(), format!("{far:.0e}")])
    });
    let rows = table(&page, HEADER);
    let columns = HEADER.trim_matches('|').split('|').count();
    assert!(rows.iter().all(|row| row.len() == columns), "each row has {columns} cells");
    let found: Vec<_> = rows.iter().map(|row| row[..2].to_vec()).collect();
    assert_eq!(found, expected.collect::<Vec<_>>());
    assert!(page.contains("`cargo bench --bench numerics` on 20"), "no command, or no date");
    let times: Vec<f64> = rows.iter().map(|row| row[13].parse().expect("a number")).collect();
    let least = times.iter().copied().fold(f64::INFINITY, f64::min);
    let most = times.iter().copied().fold(0.0, f64::max);
    let said = format!("costs between {least} and {most} times a textbook's `f64`");
    assert!(page.contains(&said), "{said}");
    // No bound is exceeded, and no crossing of ours is wrong.
    for row in rows {
        let share: f64 = row[11].parse().expect("a number");
        assert!(row[8] == "0" && share <= 1.0, "{row:?}");
    }
}

#[test]
fn every_kind_of_body_has_its_row_among_the_prices() {
    let has_row = |word: &&str| ROWS.iter().any(|(name, _)| name == word);
    let missing: Vec<_> = Body::WORDS.iter().filter(|word| !has_row(word)).collect();
    assert!(missing.is_empty(), "no row: {missing:?}");
}

/// The names of all functions in the Rust files of a folder.
fn functions(folder: &Path, names: &mut BTreeSet<String>) {
    let entries = fs::read_dir(folder).expect("a folder");
    let paths: Vec<PathBuf> = entries.map(|entry| entry.expect("readable").path()).collect();
    for path in paths {
        if path.is_dir() {
            functions(&path, names);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).expect("readable");
            let lines: Vec<&str> = text.lines().map(str::trim).collect();
            let tests = lines.windows(2).filter(|pair| pair[0] == "#[test]");
            names.extend(tests.filter_map(|pair| {
                Some(pair[1].strip_prefix("fn ")?.split('(').next()?.to_owned())
            }));
        }
    }
}

/// `18–21` and `25, 26` are all of them.
fn numbers(text: &str) -> Vec<u32> {
    let one = |text: &str| text.trim().parse::<u32>().ok();
    let range = |part: &str| match part.split_once('–') {
        Some((first, last)) => one(first).zip(one(last)).map(|(first, last)| first..last + 1),
        None => one(part).map(|n| n..n + 1),
    };
    text.split(',').filter_map(range).flatten().collect()
}

#[test]
fn each_case_of_the_page_names_tests_that_exist_and_every_case_is_there() {
    let page = page();
    let mut tests = BTreeSet::new();
    functions(&root().join("tests"), &mut tests);
    functions(&root().join("src"), &mut tests);
    let mut named = BTreeSet::new();
    let mut cases = BTreeSet::new();
    for row in table(&page, "| row | case | tests | bar |") {
        let names: Vec<&str> = row[2].split('`').skip(1).step_by(2).collect();
        assert!(!names.is_empty(), "no test: {row:?}");
        named.extend(names.iter().map(|name| (*name).to_owned()));
        cases.extend(numbers(&row[0]));
    }
    let missing: Vec<_> = named.difference(&tests).collect();
    assert!(missing.is_empty(), "no such test: {missing:?}");
    // Whatever is named after a case stands there.
    let of_cases =
        tests.iter().filter(|name| name.starts_with("row_") || name.starts_with("rows_"));
    let unnamed: Vec<_> = of_cases.filter(|name| !named.contains(*name)).collect();
    assert!(unnamed.is_empty(), "not on the page: {unnamed:?}");
    // The page lists all 78 cases but 71, which is gone, and says which have no test.
    let rest = page.split("Not built yet").nth(1).and_then(|rest| rest.split('.').next());
    let brackets = rest.expect("what is not built").split('(').skip(1);
    let untested: Vec<u32> =
        brackets.filter_map(|part| part.split(')').next()).flat_map(numbers).collect();
    for case in (1..=78).filter(|case| *case != 71) {
        let told = cases.contains(&case) as u32 + untested.contains(&case) as u32;
        assert_eq!(told, 1, "case {case} is told of {told} times");
    }
}

#[test]
fn the_reader_of_tables_finds_their_cells() {
    let page = "text\n| a | b |\n|---|---|\n| 1 \\| 2 | x |\n| 3 | y |\n\n| 4 | z |";
    assert_eq!(table(page, "| a | b |"), [["1 ¦ 2", "x"], ["3", "y"]]);
    assert_eq!(numbers("1, 3–5"), [1, 3, 4, 5]);
}
