//! Formats the report as one JSON object.

use serde::Serialize;

use super::{Estimate, Metric, Report, Verdict, answer, table};
use crate::geometry;
use crate::trace::Counters;

/// Environment of the measurement.
#[derive(Debug, Clone, Serialize)]
pub struct Host {
    /// Operating system: `linux`.
    pub os: String,
    /// Architecture of the processor: `x86_64`.
    pub arch: String,
    /// Model of the processor.
    pub cpu: String,
    /// Number of its cores.
    pub cores: usize,
    /// Number of threads that traced.
    pub threads: usize,
    /// Version of lucarne.
    pub version: String,
}

#[derive(Serialize)]
struct Whole<'a> {
    file: &'a str,
    host: &'a Host,
    width: u32,
    height: u32,
    metric: &'a str,
    seed: u64,
    audited_pixels: usize,
    cut: Vec<String>,
    reference_samples: u32,
    noise_floor: Numbers,
    /// Minimum and maximum number of runs per row.
    runs: [usize; 2],
    /// Fraction of the threads' time that tracing had.
    share_of_time: f64,
    does_nothing: &'a [String],
    /// Recommendation, as sentences.
    answer: Vec<String>,
    knobs: Vec<KnobJson<'a>>,
    rows: Vec<RowJson<'a>>,
}

#[derive(Serialize)]
struct Numbers {
    rmse: f64,
    p99: f64,
    bad: f64,
}

#[derive(Serialize)]
struct KnobJson<'a> {
    name: &'a str,
    sentence: &'a str,
    /// Settings that change no audited pixel and were not timed.
    same_picture: &'a [String],
    left_out: &'a [String],
    settings: Vec<SettingJson<'a>>,
}

#[derive(Serialize)]
struct SettingJson<'a> {
    label: &'a str,
    flag: &'a str,
    own: bool,
    row: usize,
    #[serde(flatten)]
    verdict: VerdictJson,
}

#[derive(Serialize)]
struct RowJson<'a> {
    name: &'a str,
    cpu_s: &'a [f64],
    wall_s: &'a [f64],
    rays: Rays,
    work: Work,
    cost: f64,
    errors: Errors,
    #[serde(flatten)]
    verdict: VerdictJson,
}

/// `front`; `tied` with another row; `unproven` over a cheaper one; or `dominated` by one whose error is
/// `part_of_error` times this one's. This row takes `times_as_long` as the other.
#[derive(Serialize)]
struct VerdictJson {
    verdict: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    other: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    times_as_long: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    part_of_error: Option<f64>,
}

impl From<Verdict> for VerdictJson {
    fn from(verdict: Verdict) -> Self {
        let (verdict, other, times_as_long, part_of_error) = match verdict {
            Verdict::Front => ("front", None, None, None),
            Verdict::Tied { with } => ("tied", Some(with), None, None),
            Verdict::Unproven { over, times } => ("unproven", Some(over), Some(times), None),
            Verdict::Dominated { by, times, error } => ("dominated", Some(by), times, Some(error)),
        };
        Self { verdict, other, times_as_long, part_of_error }
    }
}

#[derive(Serialize)]
struct Rays {
    camera: u64,
    shadow: u64,
    reflection: u64,
    transmission: u64,
    total_reflection: u64,
}

#[derive(Serialize)]
struct Work {
    box_visits: u64,
    root_solves: u64,
    /// Cost of solving them, in equations of a sphere.
    solving: u64,
}

#[derive(Serialize)]
struct Errors {
    rmse: Bounds,
    p99: Bounds,
    bad: Bounds,
}

/// If not `resolved`, the error is less than `value`.
#[derive(Serialize)]
struct Bounds {
    value: f64,
    low: f64,
    high: f64,
    resolved: bool,
}

impl Bounds {
    fn of(report: &Report, row: usize, metric: Metric) -> Self {
        let Estimate { value, low, high } = report.shown(metric, row);
        Self { value, low, high, resolved: report.is_resolved(metric, row) }
    }
}

/// Report if none of the requested knobs has an effect.
#[derive(Serialize)]
struct Nothing<'a> {
    file: &'a str,
    does_nothing: &'a [String],
    knobs: [(); 0],
    rows: [(); 0],
}

/// Returns one line that reports that nothing was measured because no knob has an effect.
pub fn nothing(file: &str, idle: &[String]) -> String {
    let nothing = Nothing { file, does_nothing: idle, knobs: [], rows: [] };
    // Texts only: nothing here can fail to serialise.
    serde_json::to_string(&nothing).unwrap_or_default()
}

/// Returns the report on one line.
pub fn line(report: &Report, file: &str, host: &Host) -> String {
    let [rmse, p99, bad] = report.floors;
    let knobs = report.knobs.iter().map(|knob| KnobJson {
        name: knob.name,
        sentence: &knob.sentence,
        same_picture: &knob.vain,
        left_out: &knob.left_out,
        settings: knob
            .settings
            .iter()
            .map(|s| SettingJson {
                label: &s.label,
                flag: &s.flag,
                own: s.is_own,
                row: s.row,
                verdict: s.verdict.into(),
            })
            .collect(),
    });
    let rows = report.rows.iter().enumerate().map(|(place, row)| {
        let [rmse, p99, bad] = Metric::ALL.map(|metric| Bounds::of(report, place, metric));
        let Counters {
            camera,
            shadow,
            reflection,
            transmission,
            total_reflection,
            work,
            evaluations: _,
        } = row.counters;
        let geometry::Work { box_visits, root_solves, solving } = work;
        RowJson {
            name: &row.name,
            cpu_s: &row.times.cpu,
            wall_s: &row.times.wall,
            rays: Rays { camera, shadow, reflection, transmission, total_reflection },
            work: Work { box_visits, root_solves, solving },
            cost: report.cost(place),
            errors: Errors { rmse, p99, bad },
            verdict: row.verdict.into(),
        }
    });
    let whole = Whole {
        file,
        host,
        width: report.frame.region.width,
        height: report.frame.region.height,
        metric: Metric::name(report.metric),
        seed: report.seed,
        audited_pixels: report.audited,
        cut: table::cut(report),
        reference_samples: report.reference_samples,
        noise_floor: Numbers { rmse, p99, bad },
        runs: report.runs().into(),
        share_of_time: report.share_of_time(host.threads),
        does_nothing: &report.idle,
        answer: answer::of(report, &report.order()),
        knobs: knobs.collect(),
        rows: rows.collect(),
    };
    // Numbers and texts only: nothing here can fail to serialise.
    serde_json::to_string(&whole).unwrap_or_default()
}
