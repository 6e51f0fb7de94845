//! Hard cases: what other tracers get wrong by a last digit, held against exact arithmetic.

mod alike;
mod bodies;
mod clear;
mod coinciding;
mod deep;
mod every;
mod exact;
mod frames;
mod ground;
mod held;
mod kernels;
mod language;
mod level;
mod lights;
mod merged;
mod mirrors;
mod multiple;
mod other_words;
mod outlines;
mod page;
mod patterns;
mod poles;
mod round;
#[path = "benches/numerics/rows.rs"]
#[allow(dead_code, reason = "the benchmark tells the rows apart by name")]
mod rows;
mod scaled;
mod scene;
mod seams;
mod sizes;
mod solids;
mod specks;
mod steps;
#[path = "benches/numerics/sturm.rs"]
mod sturm;
mod thin;
mod things;
mod tips;
mod touching;
mod trees;
mod turns;
mod wholes;
mod wide;
