//! The page that lucarne starts from, against lucarne: a literal, slow reading of it agrees with
//! the tracer on every pixel of every scene in `scenes/seed`.

mod agreement;
mod chance;
mod closed_forms;
#[allow(dead_code, reason = "more is drawn by the hard cases")]
mod forms;
mod page;
mod sketch;
mod spent;
