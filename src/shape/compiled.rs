//! Compiled: which kinds of shape this program has code for. All, but in a build for measurements.
//!
//! With `--cfg lucarne_only_shapes` a program has those alone that a `--cfg lucarne_shape="torus"` and the
//! like names each: what the others' code costs a scene that has none of them is the difference. `body`
//! stands for all that are placed, beside the name of each; `csg` for all solids made of others.

/// Nothing; in a build for measurements the end of the program, where it has no code for the kind: the
/// compiler then knows that what follows is not of that kind.
macro_rules! compiled {
    ($kind:literal) => {
        if cfg!(lucarne_only_shapes) && !cfg!(lucarne_shape = $kind) {
            panic!(concat!("this program has no ", $kind));
        }
    };
}

pub(crate) use compiled;
