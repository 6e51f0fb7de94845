//! Any bytes at all as the file of a mesh: a model or a fault, and never a panic.
//!
//! ```sh
//! cargo +nightly fuzz run --fuzz-dir tests/fuzz mesh_file -- -max_len=4096 -timeout=10
//! ```
//!
//! The first byte chooses the format. A file that names another gets the same bytes again.

#![no_main]

use libfuzzer_sys::fuzz_target;
use lucarne::mesh_file::read;

fuzz_target!(|bytes: &[u8]| {
    let Some((first, rest)) = bytes.split_first() else { return };
    let name = ["a.ply", "a.obj", "a.stl", "a.gltf", "a.glb"][usize::from(*first) % 5];
    let _ = read(name, rest, &mut |_| Ok(rest.to_vec()), 1 << 24);
});
