//! Hard cases: what other tracers get wrong by a last digit, held against exact arithmetic.

#[path = "hard/alike.rs"]
mod alike;
#[path = "hard/bodies.rs"]
mod bodies;
#[path = "hard/clear.rs"]
mod clear;
#[path = "hard/coinciding.rs"]
mod coinciding;
#[path = "hard/deep.rs"]
mod deep;
mod dice;
#[path = "hard/every.rs"]
mod every;
#[path = "hard/exact.rs"]
mod exact;
#[path = "hard/frames.rs"]
mod frames;
#[path = "hard/ground.rs"]
mod ground;
#[path = "hard/held.rs"]
mod held;
#[path = "hard/kernels.rs"]
mod kernels;
#[path = "hard/language.rs"]
mod language;
#[path = "hard/level.rs"]
mod level;
#[path = "hard/lights.rs"]
mod lights;
#[path = "hard/merged.rs"]
mod merged;
#[path = "hard/mirrors.rs"]
mod mirrors;
#[path = "hard/multiple.rs"]
mod multiple;
#[path = "hard/other_words.rs"]
mod other_words;
#[path = "hard/outlines.rs"]
mod outlines;
#[path = "hard/page.rs"]
mod page;
#[path = "hard/poles.rs"]
mod poles;
#[path = "hard/round.rs"]
mod round;
#[path = "benches/numerics/rows.rs"]
#[allow(dead_code, reason = "the benchmark tells the rows apart by name")]
mod rows;
#[path = "hard/scaled.rs"]
mod scaled;
#[path = "hard/scene.rs"]
mod scene;
#[path = "hard/seams.rs"]
mod seams;
#[path = "hard/sizes.rs"]
mod sizes;
#[path = "hard/solids.rs"]
mod solids;
#[path = "hard/specks.rs"]
mod specks;
#[path = "hard/steps.rs"]
mod steps;
#[path = "benches/numerics/sturm.rs"]
mod sturm;
#[path = "hard/thin.rs"]
mod thin;
#[path = "hard/things.rs"]
mod things;
#[path = "hard/tips.rs"]
mod tips;
#[path = "hard/touching.rs"]
mod touching;
#[path = "hard/trees.rs"]
mod trees;
#[path = "hard/turns.rs"]
mod turns;
#[path = "hard/wholes.rs"]
mod wholes;
#[path = "hard/wide.rs"]
mod wide;
