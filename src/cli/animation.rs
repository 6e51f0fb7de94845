//! Which frames an animation has, and what each one's number and clock are.
//!
//! **Source:** POV-Ray 3.7, measured.

use lucarne::evaluate::Animation;

/// Where a part of a picture, or of an animation, begins or ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// Counted from 1.
    Number(u32),
    /// A fraction of all.
    Fraction(f64),
}

impl Edge {
    /// Returns the number of the pixel, counted from 0, of the first row or column.
    pub fn first(self, all: u32) -> u32 {
        match self {
            Self::Number(number) => number.saturating_sub(1),
            Self::Fraction(part) => (part * f64::from(all)) as u32,
        }
    }

    /// Returns the number of the pixel behind the last row or column.
    pub fn end(self, all: u32) -> u32 {
        match self {
            Self::Number(number) => number,
            Self::Fraction(part) => (part * f64::from(all)) as u32,
        }
    }
}

/// The largest number of a frame.
pub const LAST: u32 = 999_999;

/// The frames of an animation, or a still if its last frame is its first.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameRange {
    pub frames: (u32, u32),
    pub clocks: (f64, f64),
    /// The last frame is as long before the first as any is before the next.
    pub is_cyclic: bool,
    /// The first and last frame that are rendered.
    pub subset: (Option<Edge>, Option<Edge>),
    pub step: u32,
}

impl Default for FrameRange {
    fn default() -> Self {
        Self { frames: (1, 1), clocks: (0.0, 1.0), is_cyclic: false, subset: (None, None), step: 1 }
    }
}

impl FrameRange {
    pub fn is_still(&self) -> bool {
        self.frames.0 == self.frames.1
    }

    /// Returns each frame that is rendered, and its clock.
    pub fn frames(&self) -> Vec<(Animation, f64)> {
        let (first, last) = self.frames;
        let of = |edge: Option<Edge>, default: u32| match edge {
            None => default,
            Some(Edge::Number(number)) => number,
            Some(Edge::Fraction(part)) => (part * f64::from(last)) as u32,
        };
        let (start, end) = (of(self.subset.0, first).max(first), of(self.subset.1, last).min(last));
        // A cyclic animation has one more frame, which is its first again.
        let all = last.saturating_add(u32::from(self.is_cyclic));
        let clock_delta =
            (self.clocks.1 - self.clocks.0) / f64::from(all.saturating_sub(first).max(1));
        let frame = |number: u32| {
            let clock = self.clocks.0 + clock_delta * f64::from(number - first);
            let frames = (first, all);
            let animation =
                Animation { frame_number: number, frames, clocks: self.clocks, clock_delta };
            (animation, clock)
        };
        let all = (first..=last).step_by(self.step as usize);
        all.skip_while(|number| *number < start)
            .take_while(|number| *number <= end)
            .map(frame)
            .collect()
    }

    /// Returns the name of a frame's picture: with as many digits as the last frame has.
    pub fn name(&self, stem: &str, frame_number: u32) -> String {
        let digits = self.frames.1.to_string().len();
        format!("{stem}{frame_number:0digits$}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clocks(range: &FrameRange) -> Vec<(u32, f64)> {
        range.frames().iter().map(|(frame, clock)| (frame.frame_number, *clock)).collect()
    }

    #[test]
    fn the_clock_runs_from_the_first_frame_to_the_last() {
        let range = FrameRange { frames: (2, 5), clocks: (1.0, 2.5), ..FrameRange::default() };
        assert_eq!(clocks(&range), [(2, 1.0), (3, 1.5), (4, 2.0), (5, 2.5)]);
        let range = FrameRange { frames: (1, 4), is_cyclic: true, ..FrameRange::default() };
        assert_eq!(clocks(&range), [(1, 0.0), (2, 0.25), (3, 0.5), (4, 0.75)]);
        assert_eq!(range.frames()[0].0.frames, (1, 5));
    }

    #[test]
    fn a_part_of_every_second_frame_has_those_of_the_whole() {
        let subset = (Some(Edge::Number(4)), Some(Edge::Number(8)));
        let range = FrameRange { frames: (1, 9), step: 2, subset, ..FrameRange::default() };
        assert_eq!(
            range.frames().iter().map(|(frame, _)| frame.frame_number).collect::<Vec<_>>(),
            [5, 7]
        );
    }

    #[test]
    fn a_part_of_the_frames_has_the_clocks_that_they_have_in_all() {
        let subset = (Some(Edge::Number(3)), Some(Edge::Fraction(0.5)));
        let range =
            FrameRange { frames: (1, 12), clocks: (0.0, 11.0), subset, ..FrameRange::default() };
        assert_eq!(clocks(&range), [(3, 2.0), (4, 3.0), (5, 4.0), (6, 5.0)]);
        assert_eq!(range.name("a", 3), "a03");
    }
}
