//! The page that lucarne starts from, against lucarne: a literal, slow reading of it agrees with
//! the tracer on every pixel of every scene in `scenes/seed`.

#[path = "seed/agreement.rs"]
mod agreement;
#[path = "seed/chance.rs"]
mod chance;
#[path = "seed/closed_forms.rs"]
mod closed_forms;
#[allow(dead_code, reason = "more is drawn by the hard cases")]
mod dice;
#[path = "seed/forms.rs"]
mod forms;
#[path = "seed/page.rs"]
mod page;
#[path = "seed/sketch.rs"]
mod sketch;
#[path = "seed/spent.rs"]
mod spent;
