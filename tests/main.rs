//! All tests that see the program from outside, a module a kind; one program, so that they are linked once.

mod command_line;
mod conformance;
mod corpus;
mod diagnostics;
mod dice;
mod effects;
mod explain;
mod flip;
mod hard;
mod house;
mod language_page;
mod laws;
mod layout;
mod plan;
mod povray;
mod programs;
mod readme;
mod seed;
mod snapshots;
mod standard;
