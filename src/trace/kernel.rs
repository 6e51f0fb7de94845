//! From a Plan's [`Kernel`](crate::plan::Kernel), which is data, to the code compiled for it.

/// Of a function that is compiled once for each kernel, the one for `$kernel`: `kernel!(kernel, counts, frame)`
/// is `frame::<SHADOWS, SECONDARY, KINDS, COUNTS>`. Those that count are for any kind of solid.
macro_rules! kernel {
    ($kernel:expr, $counts:expr, $($function:ident)::+) => {{
        use crate::geometry::{ANY, PLAIN};
        let crate::plan::Kernel { shadows, secondary, bodies } = $kernel;
        match (shadows, secondary, bodies, $counts) {
            (false, false, false, false) => $($function)::+::<false, false, PLAIN, false>,
            (false, true, false, false) => $($function)::+::<false, true, PLAIN, false>,
            (true, false, false, false) => $($function)::+::<true, false, PLAIN, false>,
            (true, true, false, false) => $($function)::+::<true, true, PLAIN, false>,
            (false, false, true, false) => $($function)::+::<false, false, ANY, false>,
            (false, true, true, false) => $($function)::+::<false, true, ANY, false>,
            (true, false, true, false) => $($function)::+::<true, false, ANY, false>,
            (true, true, true, false) => $($function)::+::<true, true, ANY, false>,
            (false, false, _, true) => $($function)::+::<false, false, ANY, true>,
            (false, true, _, true) => $($function)::+::<false, true, ANY, true>,
            (true, false, _, true) => $($function)::+::<true, false, ANY, true>,
            (true, true, _, true) => $($function)::+::<true, true, ANY, true>,
        }
    }};
}

pub(super) use kernel;
