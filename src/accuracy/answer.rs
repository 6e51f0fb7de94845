//! Derives the recommendation of a report: which settings to use instead of the scene's own, if any.

use super::table::{NO_LONGER, error, faster, more};
use super::{Order, Report, Verdict};

/// Returns a line with the recommendation, then one for readers who want less error, and one for those with
/// less time.
pub fn of(report: &Report, order: &Order) -> Vec<String> {
    let flag = |row: usize| report.flag(row).unwrap_or("the scene's own settings").to_owned();
    let is_alone = report.rows.len() == 1;
    let left_out = report.knobs.iter().any(|knob| !knob.left_out.is_empty());
    let (best, named, first) = match report.rows.first().map(|own| own.verdict) {
        None => return Vec::new(),
        Some(_) if is_alone && left_out => (
            0,
            None,
            "nothing but the scene's own settings was tried: `--budget` is too short".to_owned(),
        ),
        Some(_) if is_alone => {
            (0, None, "keep the scene's own settings: no knob changes an audited pixel".to_owned())
        }
        Some(Verdict::Dominated { by, times, .. }) => {
            // Neither more expensive nor cheaper: the same work.
            let times =
                times.map_or_else(|| "as fast as".to_owned(), |times| faster(times) + " than");
            (
                by,
                None,
                format!(
                    "use {}: {times} the scene's own settings, for {}",
                    flag(by),
                    instead(report, by, 0)
                ),
            )
        }
        Some(Verdict::Unproven { over, times }) => {
            let (row, times) = perhaps(report, order).unwrap_or((over, times));
            match is_outdone(report, order, row) {
                true => (0, None, nothing_else()),
                false => (
                    0,
                    Some(row),
                    format!(
                        "keep the scene's own settings, or perhaps {}: {}, and not proven to be worse ({})",
                        flag(row),
                        faster(times),
                        instead(report, row, 0)
                    ),
                ),
            }
        }
        Some(Verdict::Front) => {
            (0, None, "keep the scene's own settings: whatever is faster is worse".to_owned())
        }
        Some(Verdict::Tied { .. }) => (0, None, nothing_else()),
    };
    let rows: Vec<usize> = (0..report.rows.len()).collect();
    let sorted = order.by_cost(&rows);
    let front = || sorted.iter().copied().filter(|&row| report.rows[row].verdict == Verdict::Front);
    let finer = front().find(|&row| order.gains(row, best));
    // Does not repeat a setting that was already named.
    let quicker = front().rev().find(|&row| order.is_cheaper(row, best) && Some(row) != named);
    let mut lines = vec![first];
    if let Some(row) = finer {
        let instead = instead(report, row, best);
        // Without proof that it takes longer, it may not.
        let times = order.times(best, row).map_or_else(|| NO_LONGER.to_owned(), more);
        lines.push(format!("for less error {}: {instead}, for {times}", flag(row)));
    }
    if let Some((row, times)) = quicker.and_then(|row| Some((row, order.times(row, best)?))) {
        let instead = instead(report, row, best);
        lines.push(format!("in less time {}: {}, for {instead}", flag(row), faster(times)));
    }
    lines
}

fn nothing_else() -> String {
    "keep the scene's own settings: nothing is clearly faster and as good".to_owned()
}

/// Whether another row is faster and has no larger error as shown in the table. A row that is so outdone
/// would be a puzzling recommendation.
fn is_outdone(report: &Report, order: &Order, row: usize) -> bool {
    let error = |row: usize| report.error(row).value;
    (1..report.rows.len()).any(|other| order.is_cheaper(other, row) && error(other) <= error(row))
}

/// Returns the row with the least error among those faster than the scene's own settings and not proven to
/// be worse.
fn perhaps(report: &Report, order: &Order) -> Option<(usize, f64)> {
    let rows = (1..report.rows.len()).filter(|&row| !order.gains(0, row));
    let faster = rows.filter_map(|row| Some((row, order.times(row, 0)?)));
    let error = |row: usize| report.error(row).value;
    faster.min_by(|a, b| error(a.0).total_cmp(&error(b.0)))
}

fn instead(report: &Report, row: usize, of: usize) -> String {
    match (error(report, row), error(report, of)) {
        // Errors below the same bound cannot be distinguished.
        (less, than) if less == than && less.starts_with('<') => {
            format!("an error of {less} in both")
        }
        (less, than) => format!("an error of {less} instead of {than}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::svg::tests::report;

    fn lines(rows: &[(f64, f64, f64)]) -> Vec<String> {
        let mut report = report(rows, &["knob"], 1e-6);
        for setting in &mut report.knobs[0].settings {
            setting.flag = format!("--knob {}", setting.row);
        }
        of(&report, &report.order())
    }

    #[test]
    fn what_is_better_is_named_and_what_it_costs_to_go_on() {
        let (own, coarse, fine) = ((4.0, 0.02, 0.0), (1.0, 0.1, 0.0), (9.0, 0.005, 0.0));
        assert_eq!(
            lines(&[own, coarse, (2.0, 0.02, 0.0), fine]),
            [
                "use --knob 2: 2.0× faster than the scene's own settings, for an error of 0.0200 instead of 0.0200",
                "for less error --knob 3: an error of 0.00500 instead of 0.0200, for 4.5× the time",
                "in less time --knob 1: 2.0× faster, for an error of 0.100 instead of 0.0200",
            ]
        );
        let tied = lines(&[own, (4.05, 0.01, 0.0)]);
        assert_eq!(
            tied[1],
            "for less error --knob 1: an error of 0.0100 instead of 0.0200, for no clearly longer time"
        );
        let kept = lines(&[own, coarse]);
        assert_eq!(kept[0], "keep the scene's own settings: whatever is faster is worse");
        assert_eq!(kept.len(), 2);
        assert_eq!(
            lines(&[(4.0, 0.02, 0.019), (2.0, 0.021, 0.0)])[0],
            "keep the scene's own settings, or perhaps --knob 1: 2.0× faster, and not proven to be worse (an error of 0.0210 instead of 0.0200)"
        );
        // The second is not proven to be worse, and the third is; but that is faster, and has less error.
        assert_eq!(
            lines(&[(4.0, 0.02, 0.019), (2.0, 0.022, 0.011), (1.0, 0.0215, 0.02)])[0],
            "keep the scene's own settings: nothing is clearly faster and as good"
        );
        assert_eq!(
            lines(&[own]),
            ["keep the scene's own settings: no knob changes an audited pixel"]
        );
    }
}
