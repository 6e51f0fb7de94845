//! Any bytes are a scene or a report: the examples, ours and those of POV-Ray where they are installed, with
//! bytes and words of them changed, taken out, put in and exchanged.
//!
//! `LUCARNE_LONG` set to a number tries as many times as many.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use lucarne::diagnostic::mend::apply;
use lucarne::diagnostic::{narrate, render};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;
use proptest::prelude::*;

/// POV-Ray's examples, as its packages put them.
const INSTALLED: &str = "/usr/share/doc/povray/examples";
/// Larger ones take their time, and say nothing more.
const LARGEST: u64 = 8_000;

static EXAMPLES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut paths = Vec::new();
    gather(&own, &mut paths);
    gather(Path::new(INSTALLED), &mut paths);
    paths.sort();
    let examples: Vec<_> = paths.iter().filter_map(|path| fs::read(path).ok()).collect();
    assert!(examples.len() > 100, "there are only {} examples", examples.len());
    examples
});

/// The scenes below a folder, none if there is no such folder.
fn gather(folder: &Path, paths: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            gather(&path, paths);
        } else if path.extension().is_some_and(|kind| kind == "scene" || kind == "pov")
            && entry.metadata().is_ok_and(|file| file.len() <= LARGEST)
        {
            paths.push(path);
        }
    }
}

/// A change of a text; places are taken modulo its length.
#[derive(Debug, Clone)]
enum Change {
    Byte(usize, u8),
    Insert(usize, u8),
    Remove(usize, usize),
    /// A piece of it is put in elsewhere.
    Copy(usize, usize, usize),
    /// A word of it stands for another.
    Exchange(usize, usize),
    /// A piece of another example is put in.
    Graft(usize, usize, usize, usize),
}

fn change() -> impl Strategy<Value = Change> {
    const BYTES: &[u8] = b"{}()[]<>#\"/*,;=.-+?:&|!ae019x \n\\@_\xE9\0";
    let at = || any::<usize>();
    let byte = || prop_oneof![4 => prop::sample::select(BYTES), 1 => any::<u8>()];
    prop_oneof![
        (at(), byte()).prop_map(|(at, byte)| Change::Byte(at, byte)),
        (at(), byte()).prop_map(|(at, byte)| Change::Insert(at, byte)),
        (at(), 1..40_usize).prop_map(|(at, length)| Change::Remove(at, length)),
        (at(), 1..60_usize, at()).prop_map(|(from, length, to)| Change::Copy(from, length, to)),
        (at(), at()).prop_map(|(one, other)| Change::Exchange(one, other)),
        (at(), at(), 1..120_usize, at())
            .prop_map(|(of, from, length, to)| Change::Graft(of, from, length, to)),
    ]
}

/// The letters around a place, or the one byte there.
fn word(text: &[u8], at: usize) -> std::ops::Range<usize> {
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let start = text[..at].iter().rposition(|byte| !is_part(byte)).map_or(0, |before| before + 1);
    let length = text[start..].iter().position(|byte| !is_part(byte)).unwrap_or(text.len() - start);
    start..(start + length).max(at + 1)
}

fn piece(text: &[u8], from: usize, length: usize) -> &[u8] {
    let from = from % text.len();
    &text[from..(from + length).min(text.len())]
}

fn changed(mut text: Vec<u8>, changes: &[Change]) -> Vec<u8> {
    for change in changes {
        if text.is_empty() {
            break;
        }
        let size = text.len();
        match *change {
            Change::Byte(at, byte) => text[at % size] = byte,
            Change::Insert(at, byte) => text.insert(at % size, byte),
            Change::Remove(at, length) => {
                let at = at % size;
                text.drain(at..(at + length).min(size));
            }
            Change::Copy(from, length, to) => {
                let copied = piece(&text, from, length).to_vec();
                text.splice(to % size..to % size, copied);
            }
            Change::Exchange(one, other) => {
                let given = text[word(&text, other % size)].to_vec();
                let place = word(&text, one % size);
                text.splice(place, given);
            }
            Change::Graft(of, from, length, to) => {
                let other = &EXAMPLES[of % EXAMPLES.len()];
                if !other.is_empty() {
                    text.splice(to % size..to % size, piece(other, from, length).iter().copied());
                }
            }
        }
    }
    text
}

/// Small limits: what only takes long says nothing.
fn options(dialect: Dialect) -> Options {
    let mut options = Options::new(dialect);
    let limits = &mut options.evaluate.limits;
    (limits.loop_turns, limits.objects) = (300, 300);
    (limits.memory, limits.string) = (64, 1);
    options
}

/// Compiles, says all that there is to say, and gives the text with each mistake mended that can be.
fn told(bytes: &[u8], dialect: Dialect) -> Option<String> {
    let mut road = Road::new(&NoFiles, options(dialect));
    road.compile("any.scene", bytes.to_vec());
    for told in road.diagnostics.iter() {
        assert!(!render::human(told, &road.sources, render::Style::PLAIN).is_empty());
        assert!(!narrate::narrated(told, &road.sources).is_empty());
    }
    let (mended, used) = apply(std::str::from_utf8(bytes).ok()?, road.diagnostics.iter());
    (!used.is_empty()).then_some(mended)
}

fn times() -> u32 {
    let longer = std::env::var("LUCARNE_LONG").ok().and_then(|times| times.parse().ok());
    500 * longer.unwrap_or(1_u32)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: times(), ..ProptestConfig::default() })]

    #[test]
    fn any_change_of_an_example_is_a_scene_or_a_report(
        example in any::<prop::sample::Index>(),
        changes in prop::collection::vec(change(), 1..8),
        is_pov in any::<bool>(),
    ) {
        let dialect = if is_pov { Dialect::Pov } else { Dialect::Scene };
        let text = changed(EXAMPLES[example.index(EXAMPLES.len())].clone(), &changes);
        if let Some(mended) = told(&text, dialect) {
            told(mended.as_bytes(), dialect);
        }
    }
}
