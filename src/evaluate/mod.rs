use crate::{
    diagnostic::Diagnostics,
    scene::{Dialect, Scene},
    source::*,
    syntax::ast::Ast,
};
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    pub loop_turns: u64,
    pub macro_depth: u32,
    pub include_depth: u32,
    pub objects: u64,
}
impl Default for Limits {
    fn default() -> Self {
        Self { loop_turns: 1, macro_depth: 1, include_depth: 1, objects: 1 }
    }
}
#[derive(Debug, Clone)]
pub struct EvaluateOptions {
    pub dialect: Dialect,
    pub width: u32,
    pub height: u32,
    pub declares: Vec<(String, f64)>,
    pub clock: f64,
    pub frame_number: f64,
    pub limits: Limits,
}
pub fn evaluate(
    _: &Ast,
    _: &mut Sources,
    _: &dyn Files,
    _: &EvaluateOptions,
    _: &mut Diagnostics,
) -> Scene {
    Scene::default()
}
