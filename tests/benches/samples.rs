//! Soft shadows, blurred pictures and fog beside POV-Ray 3.7.
//!
//! `cargo bench --bench samples` prints the tables of `docs/performance.md` and the curves of `docs/accuracy.md`; words
//! behind `--` choose tables. **In:** scenes generated here, one text for both programs. **Out:** CPU seconds of tracing,
//! runs alternating, and errors. An error is that from a picture of many samples: of soft shadows ours, of blur that of
//! the same program, since POV-Ray's samples of a blurred pixel are all at its middle.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const FULL: (u32, u32) = (960, 540);
const SMALL: (u32, u32) = (320, 180);
const TINY: (u32, u32) = (160, 90);
const PAIRS: usize = 2;

fn main() -> ExitCode {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let bench = Bench { folder: folder.path().to_owned() };
    let words: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_chosen = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word));
    if is_chosen("speed") {
        bench.speed();
    }
    if is_chosen("shadow") {
        bench.shadow();
    }
    if is_chosen("blur") {
        bench.blur();
    }
    ExitCode::SUCCESS
}

/// A setting of one of the programs: what is added to the scene's camera and light, or a flag.
struct Setting {
    name: String,
    camera: String,
    light: String,
    flag: Option<String>,
}

impl Setting {
    fn light(name: &str) -> Self {
        let light = format!("area_light <3, 0, 0>, <0, 0, 3>, {name}");
        Self { name: name.to_owned(), camera: String::new(), light, flag: None }
    }

    fn lens(name: &str) -> Self {
        let camera = format!("aperture 0.4 focal_point <0, 0.6, 0> {name}");
        Self { name: name.to_owned(), camera, light: String::new(), flag: None }
    }

    fn with_flag(self, flag: &str) -> Self {
        Self { name: flag.to_owned(), flag: Some(format!("--{flag}")), ..self }
    }
}

/// A setting, its CPU seconds, and its error.
struct Point {
    name: String,
    seconds: f64,
    error: f64,
}

struct Bench {
    folder: PathBuf,
}

impl Bench {
    fn speed(&self) {
        println!(
            "{}×{}, blur {}×{}, one ray a pixel, one thread, least of {PAIRS} pairs\n",
            FULL.0, FULL.1, SMALL.0, SMALL.1
        );
        println!("| scene | POV-Ray s | here s | ratio |\n|---|---:|---:|---:|");
        let lights = ["8, 8", "8, 8 jitter", "8, 8 adaptive 1", "8, 8 adaptive 1 jitter"];
        let lenses = [
            "blur_samples 200 variance 0",
            "blur_samples 200",
            "blur_samples 200 confidence 0.99 variance 1/100000",
        ];
        let fogs = [
            "",
            "fog { distance 30 rgb 0.6 }",
            "fog { fog_type 2 distance 30 fog_offset 0.5 fog_alt 1 rgb 0.6 }",
        ];
        let lights = lights
            .iter()
            .map(|name| (scene(&Setting::light(name)), FULL, format!("area_light {name}")));
        let lenses =
            lenses.iter().map(|name| (scene(&Setting::lens(name)), SMALL, (*name).to_owned()));
        let plain = Setting { camera: String::new(), ..Setting::lens("") };
        let fogs = fogs.iter().map(|fog| (scene(&plain) + fog, FULL, format!("plain {fog}")));
        for (text, size, name) in lights.chain(lenses).chain(fogs) {
            let (mut here, mut there) = (f64::INFINITY, f64::INFINITY);
            for _ in 0..PAIRS {
                here = here.min(self.lucarne(&text, size, None).0);
                there = there.min(self.povray(&text, size).0);
            }
            println!("| {name} | {there:.3} | {here:.3} | {:.2} |", there / here);
        }
    }

    fn shadow(&self) {
        let grids = [2, 4, 5, 8, 9, 17];
        let mut theirs: Vec<Setting> = Vec::new();
        for grid in grids {
            for jitter in ["", " jitter"] {
                theirs.push(Setting::light(&format!("{grid}, {grid}{jitter}")));
                let adaptive = [0, 1, 2].into_iter().filter(|level| 1 << level < grid - 1);
                theirs.extend(adaptive.map(|level| {
                    Setting::light(&format!("{grid}, {grid} adaptive {level}{jitter}"))
                }));
            }
        }
        let ours = [
            "1",
            "4",
            "16",
            "32",
            "64",
            "256",
            "adaptive:0.05:64",
            "adaptive:0.02:256",
            "adaptive:0.01:512",
        ];
        let grids = ["4, 4", "8, 8", "8, 8 adaptive 1", "17, 17", "17, 17 adaptive 1"];
        let spread = ours
            .map(|samples| Setting::light("8, 8").with_flag(&format!("light-samples={samples}")));
        let ours: Vec<Setting> =
            grids.iter().map(|grid| Setting::light(grid)).chain(spread).collect();
        let truth = Setting::light("8, 8").with_flag("light-samples=4096");
        let (_, truth) = self.lucarne(&scene(&truth), SMALL, truth.flag.as_deref());
        self.curve("soft shadow", &ours, &theirs, (&truth, &truth), SMALL);
    }

    fn blur(&self) {
        let mut theirs: Vec<Setting> = Vec::new();
        for count in [4, 10, 19, 37, 100, 200] {
            let fixed = format!("blur_samples {count} variance 0");
            theirs.push(Setting::lens(&fixed));
            for (confidence, variance) in
                [("0.9", "1/128"), ("0.95", "1/1000"), ("0.99", "1/10000")]
            {
                let text =
                    format!("blur_samples {count} confidence {confidence} variance {variance}");
                theirs.push(Setting::lens(&text));
            }
        }
        let ours = [
            "1",
            "4",
            "10",
            "25",
            "50",
            "100",
            "200",
            "500",
            "adaptive:0.05:100",
            "adaptive:0.02:200",
            "adaptive:0.01:500",
            "adaptive:0.005:1000",
        ];
        let lens = || Setting::lens("blur_samples 200 variance 0");
        let ours = ours.map(|samples| lens().with_flag(&format!("blur-samples={samples}")));
        let many = lens().with_flag("blur-samples=4096");
        let (_, here) = self.lucarne(&scene(&many), TINY, many.flag.as_deref());
        let (_, there) = self.povray(&scene(&Setting::lens("blur_samples 2000 variance 0")), TINY);
        self.curve("focal blur", &ours, &theirs, (&here, &there), TINY);
    }

    /// Prints the settings of both programs, and how many times as long as the fastest of ours each of theirs takes that
    /// has no less of an error.
    fn curve(
        &self,
        title: &str,
        ours: &[Setting],
        theirs: &[Setting],
        (here, there): (&Picture, &Picture),
        size: (u32, u32),
    ) {
        let measured = |setting: &Setting,
                        run: &dyn Fn(&str) -> (f64, Picture),
                        truth: &Picture| {
            let text = scene(setting);
            let runs: Vec<_> = (0..PAIRS).map(|_| run(&text)).collect();
            let seconds = runs.iter().map(|(seconds, _)| *seconds).fold(f64::INFINITY, f64::min);
            let error = truth.rmse(&runs[0].1);
            Point { name: setting.name.clone(), seconds, error }
        };
        let mut ours: Vec<Point> = ours
            .iter()
            .map(|setting| {
                let run = |text: &str| self.lucarne(text, size, setting.flag.as_deref());
                measured(setting, &run, here)
            })
            .collect();
        let mut theirs: Vec<Point> = theirs
            .iter()
            .map(|setting| measured(setting, &|text: &str| self.povray(text, size), there))
            .collect();
        println!("\n{title}, {}×{}\n\n| here | CPU s | RMSE |\n|---|---:|---:|", size.0, size.1);
        ours.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        for Point { name, seconds, error } in &ours {
            println!("| {name} | {seconds:.4} | {error:.5} |");
        }
        println!(
            "\n| POV-Ray | CPU s | RMSE | as good here | times as long |\n|---|---:|---:|---|---:|"
        );
        theirs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        for Point { name, seconds, error } in &theirs {
            match ours.iter().find(|ours| ours.error <= *error) {
                Some(better) => {
                    let times = seconds / better.seconds;
                    println!(
                        "| {name} | {seconds:.3} | {error:.5} | {} | {times:.1} |",
                        better.name
                    );
                }
                None => println!("| {name} | {seconds:.3} | {error:.5} | | |"),
            }
        }
    }

    /// One render by ours.
    fn lucarne(&self, text: &str, size: (u32, u32), flag: Option<&str>) -> (f64, Picture) {
        let (source, picture) = (self.written(text), self.folder.join("ours.png"));
        let output = Command::new(env!("CARGO_BIN_EXE_lucarne"))
            .args(["render", "--antialias=off", "--threads=1", "--stats=json", "--bits=16"])
            .arg(format!("--size={}x{}", size.0, size.1))
            .args(flag)
            .arg("-o")
            .args([&picture, &source])
            .output()
            .expect("lucarne starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let stats: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        (stats["trace_cpu_s"].as_f64().expect("seconds"), Picture::of(&picture))
    }

    /// One render by POV-Ray.
    fn povray(&self, text: &str, size: (u32, u32)) -> (f64, Picture) {
        let (source, picture) = (self.written(text), self.folder.join("theirs.png"));
        let output = Command::new("povray")
            .args(["+WT1", "-A", "-D", "+FN16", "-V"])
            .arg(format!("+W{}", size.0))
            .arg(format!("+H{}", size.1))
            .arg(format!("+I{}", source.display()))
            .arg(format!("+O{}", picture.display()))
            .output()
            .expect("povray starts");
        let report = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{report}");
        let part = report.split("Trace Time:").nth(1).expect("a time");
        let number = part.split("with ").nth(1).and_then(|rest| rest.split(' ').next());
        let seconds = number.and_then(|number| number.parse().ok()).expect("CPU seconds");
        (seconds, Picture::of(&picture))
    }

    fn written(&self, text: &str) -> PathBuf {
        let source = self.folder.join("scene.pov");
        fs::write(&source, text).expect("a scene written");
        source
    }
}

/// A picture in linear light.
struct Picture(Vec<f64>);

impl Picture {
    fn of(path: &Path) -> Self {
        let encoded = image::open(path).expect("a picture").to_rgb16().into_raw();
        let linear = |c: u16| match f64::from(c) / 65535.0 {
            c if c <= 0.04045 => c / 12.92,
            c => ((c + 0.055) / 1.055).powf(2.4),
        };
        Self(encoded.into_iter().map(linear).collect())
    }

    fn rmse(&self, other: &Self) -> f64 {
        let squares = self.0.iter().zip(&other.0).map(|(a, b)| (a - b) * (a - b));
        (squares.sum::<f64>() / self.0.len() as f64).sqrt()
    }
}

/// A floor with 30 balls and 10 boxes, a light above them.
fn scene(setting: &Setting) -> String {
    let Setting { camera, light, .. } = setting;
    let mut text = format!(
        "#version 3.7;
global_settings {{ assumed_gamma 1 }}
background {{ rgb <0.3, 0.4, 0.6> }}
camera {{ location <0, 4, -9> look_at <0, 0.6, 0> angle 50 right x*16/9 {camera} }}
light_source {{ <6, 9, -6> rgb 1 {light} }}
#default {{ finish {{ ambient 0.05 diffuse 0.8 }} }}
plane {{ y, 0 pigment {{ rgb <0.9, 0.88, 0.85> }} }}
"
    );
    let mut state = 7u64;
    let mut random = |low: f64, high: f64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for number in 0..40 {
        let (x, z) = (random(-5.0, 5.0), random(-3.0, 5.0));
        let (size, high) = (random(0.25, 0.6), random(0.35, 1.15));
        let color = format!(
            "pigment {{ rgb <{:.3}, {:.3}, {:.3}> }}",
            random(0.0, 1.0),
            random(0.0, 1.0),
            random(0.0, 1.0)
        );
        let turn = 150.0 * size;
        text += &match number {
            0..30 => format!("sphere {{ <{x:.4}, {high:.4}, {z:.4}>, {size:.4} {color} }}\n"),
            _ => format!(
                "box {{ <-0.3, 0, -0.3>, <0.3, {high:.4}, 0.3> rotate {turn:.3}*y translate <{x:.4}, 0, {z:.4}> {color} }}\n"
            ),
        };
    }
    text
}
