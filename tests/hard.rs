//! Hard cases: what other tracers get wrong by a last digit, held against exact arithmetic.

#[path = "hard/exact.rs"]
mod exact;
#[path = "hard/ground.rs"]
mod ground;
#[path = "hard/held.rs"]
mod held;
#[path = "hard/lights.rs"]
mod lights;
#[path = "hard/mirrors.rs"]
mod mirrors;
#[path = "hard/scene.rs"]
mod scene;
#[path = "hard/sizes.rs"]
mod sizes;
#[path = "hard/turns.rs"]
mod turns;
#[path = "hard/wide.rs"]
mod wide;
