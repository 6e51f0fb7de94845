//! The arguments about long renders, and renders by several processes.

use std::time::Duration;

use clap::Args;
use lucarne::plan::Region;

use crate::cli::exit::Failure;
use crate::cli::values::{bytes, seconds};

/// How a render is saved, resumed and divided.
#[derive(Debug, Args)]
pub struct WorkArguments {
    /// Go on from OUT.checkpoint, which a render that takes longer than a minute saves every 30 seconds and
    /// when it is interrupted; the picture has the same bytes. Without a checkpoint, start anew
    #[arg(long, conflicts_with_all = ["max_error", "time_budget", "frames"])]
    pub resume: bool,
    /// Time between two checkpoints; the first is saved after twice that
    #[arg(long, value_name = "T", value_parser = seconds, default_value = "30s")]
    checkpoint: f64,
    /// Render the Kth of N parts of the picture, to OUT.K-of-N.part (for example `--shard 2/8`), for `lucarne
    /// merge`; or of an animation every Nth frame, beginning with the Kth
    #[arg(long, value_name = "K/N", value_parser = shard, conflicts_with_all = ["max_error", "time_budget"])]
    pub shard: Option<Shard>,
    /// Stop after time T (500ms, 60s, 5m; a plain number is in seconds), reading included, as Ctrl-C does. The render
    /// keeps a checkpoint from its start on; exits with 75 if `--resume` goes on from it, otherwise with 4
    #[arg(long, value_name = "T", value_parser = seconds)]
    pub time: Option<f64>,
    /// Stop if the program takes more than this much memory (such as 500M or 2G), and exit with 4; a checkpoint is kept
    #[arg(long, value_name = "SIZE", value_parser = bytes)]
    pub memory: Option<u64>,
}

impl WorkArguments {
    /// Whether a limit may stop the run.
    pub fn is_limited(&self) -> bool {
        self.time.is_some() || self.memory.is_some()
    }

    pub fn checkpoint(&self) -> Duration {
        Duration::from_secs_f64(self.checkpoint)
    }
}

/// One of several parts, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    pub number: u32,
    pub all: u32,
}

impl Shard {
    /// Returns this part of a region: some of its rows.
    pub fn of(self, region: Region) -> Result<Region, Failure> {
        let Region { y, height, .. } = region;
        if height < self.all {
            let sentence = format!("{height} rows cannot be divided into {} parts", self.all);
            return Err(Failure::usage(sentence));
        }
        let row = |part: u32| (u64::from(height) * u64::from(part) / u64::from(self.all)) as u32;
        let (first, end) = (row(self.number - 1), row(self.number));
        Ok(Region { y: y + first, height: end - first, ..region })
    }
}

fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(number, all)| {
        Some(Shard { number: number.parse().ok()?, all: all.parse().ok()? })
    });
    let is_one = |shard: &Shard| (1..=shard.all).contains(&shard.number);
    numbers
        .filter(is_one)
        .ok_or_else(|| "expected a part such as `2/8`: the second of eight".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_all_of_it_and_none_is_empty() {
        let region = Region { x: 3, y: 10, width: 5, height: 23 };
        for all in 1..=23 {
            let mut next = region.y;
            for number in 1..=all {
                let part = Shard { number, all }.of(region).expect("enough rows");
                assert!(part.y == next && part.height > 0 && part.width == 5);
                next += part.height;
            }
            assert_eq!(next, region.y + region.height);
        }
        assert!(Shard { number: 1, all: 24 }.of(region).is_err());
        assert_eq!(shard("2/8"), Ok(Shard { number: 2, all: 8 }));
        for wrong in ["0/8", "9/8", "2", "2/", "a/b", ""] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
    }
}
