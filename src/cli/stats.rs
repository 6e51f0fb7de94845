//! Statistics of a render: CPU seconds of each stage, memory, rays, intersection work and evaluations of
//! each effect.

use std::sync::OnceLock;
use std::time::Instant;

use lucarne::geometry;
use lucarne::trace::{self, Counters};
use serde::Serialize;

use super::arguments::StatsFormat;
use super::exit::Failure;
use super::messages;

/// Statistics of a render. CPU seconds are the total over all threads of the process.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Stats {
    pub parse_cpu_s: f64,
    pub evaluate_cpu_s: f64,
    pub lower_cpu_s: f64,
    /// Building the bounding volume hierarchy.
    pub build_cpu_s: f64,
    /// Tracing; with a promise, includes everything traced to keep it in addition to the picture.
    pub trace_cpu_s: f64,
    pub encode_cpu_s: f64,
    pub wall_s: f64,
    /// Zero if the system does not report it.
    pub peak_rss_bytes: u64,
    pub objects: usize,
    pub lights: usize,
    pub rays: Rays,
    pub work: Work,
    pub evaluations: Evaluations,
}

/// Number of rays by origin.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Rays {
    pub camera: u64,
    pub shadow: u64,
    pub reflection: u64,
    pub transmission: u64,
    /// Rays from transparent surfaces under total internal reflection.
    pub total_reflection: u64,
}

/// Intersection work: visits to nodes of the bounding volume hierarchy (four boxes each), and equations of
/// shapes solved.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Work {
    pub box_visits: u64,
    pub root_solves: u64,
}

/// Evaluations of each effect that sends no rays of its own; see [`trace::Evaluations`].
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Evaluations {
    pub diffuse: u64,
    pub highlights: u64,
    pub attenuation: u64,
    pub area_lights: u64,
    pub projections: u64,
    pub light_groups: u64,
    pub from_behind: u64,
    pub refraction: u64,
    pub absorption: u64,
    pub dispersion: u64,
    pub colored_shadows: u64,
    pub patterns: u64,
    pub hiding: u64,
    pub sky: u64,
    pub focal_blur: u64,
    pub camera_normal: u64,
    pub fog: u64,
    pub rainbows: u64,
}

impl From<trace::Evaluations> for Evaluations {
    fn from(counted: trace::Evaluations) -> Self {
        let trace::Evaluations {
            diffuse,
            highlights,
            attenuation,
            area_lights,
            projections,
            light_groups,
            from_behind,
            refraction,
            absorption,
            dispersion,
            colored_shadows,
            patterns,
            hiding,
            sky,
            focal_blur,
            camera_normal,
            fog,
            rainbows,
        } = counted;
        Self {
            diffuse,
            highlights,
            attenuation,
            area_lights,
            projections,
            light_groups,
            from_behind,
            refraction,
            absorption,
            dispersion,
            colored_shadows,
            patterns,
            hiding,
            sky,
            focal_blur,
            camera_normal,
            fog,
            rainbows,
        }
    }
}

impl Stats {
    pub fn count(&mut self, counters: &Counters) {
        let Counters {
            camera,
            shadow,
            reflection,
            transmission,
            total_reflection,
            work,
            evaluations,
        } = *counters;
        let geometry::Work { box_visits, root_solves, solving: _ } = work;
        self.rays = Rays { camera, shadow, reflection, transmission, total_reflection };
        self.work = Work { box_visits, root_solves };
        self.evaluations = evaluations.into();
    }

    /// Prints one line of JSON or a table (`CPU s`: total over all threads), on standard error if a picture
    /// uses standard output.
    pub fn print(&self, format: Option<StatsFormat>, to_stderr: bool) -> Result<(), Failure> {
        let text = match format {
            // Numbers only: nothing here can fail to serialise.
            Some(StatsFormat::Json) => serde_json::to_string(self).unwrap_or_default() + "\n",
            None => self.table(),
        };
        match to_stderr {
            true => messages::eprint(&text),
            false => messages::print(&text)?,
        }
        Ok(())
    }

    fn table(&self) -> String {
        let wall = |name: &str, s: f64| format!("{name:17}{s:14.3} s\n");
        let seconds = |name: &str, s: f64| format!("{name:17}{s:14.3} CPU s\n");
        let count = |name: &str, n: u64| format!("{name:17}{n:14}\n");
        [
            seconds("parse", self.parse_cpu_s),
            seconds("evaluate", self.evaluate_cpu_s),
            seconds("lower", self.lower_cpu_s),
            seconds("build", self.build_cpu_s),
            seconds("trace", self.trace_cpu_s),
            seconds("encode", self.encode_cpu_s),
            wall("wall clock", self.wall_s),
            format!("{:17}{:14.1} MiB\n", "peak memory", self.peak_rss_bytes as f64 / 1_048_576.0),
            count("objects", self.objects as u64),
            count("lights", self.lights as u64),
            count("camera rays", self.rays.camera),
            count("shadow rays", self.rays.shadow),
            count("mirrored", self.rays.reflection),
            count("let through", self.rays.transmission),
            count("mirrored whole", self.rays.total_reflection),
            count("box visits", self.work.box_visits),
            count("root solves", self.work.root_solves),
            count("lights scattered", self.evaluations.diffuse),
            count("highlights", self.evaluations.highlights),
            count("beams and fading", self.evaluations.attenuation),
            count("area lights", self.evaluations.area_lights),
            count("projected lights", self.evaluations.projections),
            count("light groups", self.evaluations.light_groups),
            count("light from behind", self.evaluations.from_behind),
            count("borders that bend", self.evaluations.refraction),
            count("ways dimmed", self.evaluations.absorption),
            count("rays split", self.evaluations.dispersion),
            count("coloured shadows", self.evaluations.colored_shadows),
            count("patterns", self.evaluations.patterns),
            count("hidden objects", self.evaluations.hiding),
            count("sky", self.evaluations.sky),
            count("through a lens", self.evaluations.focal_blur),
            count("camera normal", self.evaluations.camera_normal),
            count("fog", self.evaluations.fog),
            count("rainbows", self.evaluations.rainbows),
        ]
        .concat()
    }
}

/// Measures consecutive stages.
pub struct Stopwatch {
    start: Instant,
    last: f64,
}

impl Stopwatch {
    pub fn start() -> Self {
        Self { start: Instant::now(), last: cpu_seconds() }
    }

    /// Returns the CPU seconds since the last call, or since the start.
    pub fn lap(&mut self) -> f64 {
        let now = cpu_seconds();
        now - std::mem::replace(&mut self.last, now)
    }

    pub fn wall_seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }
}

/// Returns the CPU seconds of this process or, where unavailable, wall-clock seconds since the first call.
pub fn cpu_seconds() -> f64 {
    process_cpu_seconds().unwrap_or_else(|| {
        static FIRST: OnceLock<Instant> = OnceLock::new();
        FIRST.get_or_init(Instant::now).elapsed().as_secs_f64()
    })
}

#[cfg(unix)]
fn process_cpu_seconds() -> Option<f64> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike;
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    Some((usage.user_time() + usage.system_time()).num_microseconds() as f64 / 1e6)
}

#[cfg(not(unix))]
fn process_cpu_seconds() -> Option<f64> {
    None
}

/// Returns the peak memory use of this process in bytes.
#[cfg(unix)]
pub fn peak_rss_bytes() -> u64 {
    use nix::sys::resource::{UsageWho, getrusage};
    let Ok(usage) = getrusage(UsageWho::RUSAGE_SELF) else { return 0 };
    let unit = if cfg!(target_vendor = "apple") { 1 } else { 1024 };
    u64::try_from(usage.max_rss()).unwrap_or(0) * unit
}

#[cfg(not(unix))]
pub fn peak_rss_bytes() -> u64 {
    0
}
