#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word(pub u16);
