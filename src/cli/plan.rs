//! `lucarne plan`: what will be simulated, and why.

use super::arguments::{PlanArguments, Stage};
use super::exit::Outcome;
use super::show::show;

pub fn run(arguments: &PlanArguments) -> Outcome {
    show(&arguments.file, Stage::Plan, &arguments.picture, &arguments.scene)
}
