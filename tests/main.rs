//! All tests that use lucarne from outside, with one module per kind, linked into one program.

#[cfg(unix)]
mod clients;
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
mod library;
mod plan;
mod povray;
mod programs;
mod readme;
mod seed;
mod snapshots;
mod standard;
mod unrounded;
