//! Any bytes at all: from the text to the World, a scene or a report, and never a panic.
//!
//! ```sh
//! cargo +nightly fuzz run --fuzz-dir tests/fuzz compile -- -max_len=4096 -timeout=10
//! ```
//!
//! The first byte chooses the dialect. A fix, applied, has to leave a text that is read as well.

#![no_main]

use libfuzzer_sys::fuzz_target;
use lucarne::diagnostic::mend::apply;
use lucarne::diagnostic::{narrate, render};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;

/// Small, so that what only takes long is no find.
fn options(dialect: Dialect) -> Options {
    let mut options = Options::new(dialect);
    let limits = &mut options.evaluate.limits;
    (limits.loop_turns, limits.objects) = (2_000, 2_000);
    (limits.memory, limits.string) = (64, 1);
    options
}

fn compile(bytes: &[u8], dialect: Dialect) -> Option<String> {
    let mut road = Road::new(&NoFiles, options(dialect));
    road.compile("a.scene", bytes.to_vec());
    for told in road.diagnostics.iter() {
        render::human(told, &road.sources, render::Style::PLAIN);
        narrate::narrated(told, &road.sources);
    }
    let text = std::str::from_utf8(bytes).ok()?;
    let (mended, used) = apply(text, road.diagnostics.iter());
    (!used.is_empty()).then_some(mended)
}

fuzz_target!(|bytes: &[u8]| {
    let Some((first, rest)) = bytes.split_first() else { return };
    let dialect = if first & 1 == 0 { Dialect::Scene } else { Dialect::Pov };
    if let Some(mended) = compile(rest, dialect) {
        compile(mended.as_bytes(), dialect);
    }
});
