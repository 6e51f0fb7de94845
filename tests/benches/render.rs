//! Whole pictures, beside POV-Ray 3.7 where it is installed.
//!
//! `cargo bench --bench render`. **In:** scenes written here, one text for both programs. **Out:**
//! a table: CPU seconds of our `--stats json` and of POV-Ray's own report, runs alternating, and
//! how far the two pictures are apart. Ratios of one run can be compared, seconds of two cannot:
//! the machine may have been busy.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::time::Instant;

const SIZE: (u32, u32) = (1920, 1080);
const PAIRS: usize = 7;
const STARTS: usize = 20;

fn main() -> ExitCode {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let povray = povray_version();
    match &povray {
        Some(version) => println!("{version}"),
        None => println!("POV-Ray is not installed (`povray`): nothing to compare with"),
    }
    let with_povray = povray.is_some();
    pair(folder, "3 spheres, box, plane, 2 lights, reflection", "few", &few(), 2.5, with_povray);
    pair(folder, "100,000 spheres, 2 lights", "many", &many(100_000), 3.0, with_povray);
    starts(folder);
    ExitCode::SUCCESS
}

/// The kind of scene the speed promise is about.
fn few() -> String {
    let gloss = "phong 0.4 phong_size 40";
    let mut scene = head("<0, 1.2, 6>", "<0, 0.9, 0>");
    let mut add = |shape: &str, color: &str, gloss: &str, reflection: f64| {
        writeln!(
            scene,
            "{shape} pigment {{ rgb {color} }} finish {{ ambient 0.1 diffuse 0.6 {gloss} \
             reflection {reflection} }} }}"
        )
        .expect("written");
    };
    add("plane { y, 0", "<0.8, 0.8, 0.7>", "", 0.1);
    add("sphere { <0, 1, 0>, 1", "<0.8, 0.2, 0.2>", gloss, 0.3);
    add("sphere { <-2, 0.6, 0.8>, 0.6", "<0.2, 0.7, 0.3>", "specular 0.4 roughness 0.02", 0.2);
    add("sphere { <1.6, 0.5, 1.6>, 0.5", "<0.2, 0.3, 0.8>", gloss, 0.2);
    let turned = "box { -0.5, 0.5 rotate 30*y translate <2.4, 0.5, -0.6>";
    add(turned, "<0.8, 0.7, 0.2>", gloss, 0.1);
    scene
}

fn many(count: usize) -> String {
    let mut scene = head("<0, 0, 30>", "<0, 0, 0>");
    scene += "#default { pigment { rgb <0.8, 0.6, 0.4> } finish { ambient 0.1 diffuse 0.6 } }\n";
    let mut state = 7u64;
    let mut number = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..count {
        let [x, y, z] = [(); 3].map(|()| number() * 20.0 - 10.0);
        let radius = 0.03 + 0.09 * number();
        writeln!(scene, "sphere {{ <{x:.6}, {y:.6}, {z:.6}>, {radius:.6} }}").expect("written");
    }
    scene
}

fn head(location: &str, look_at: &str) -> String {
    format!(
        "#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level 5 }}
camera {{ location {location} right -x*16/9 up y direction -1.2*z look_at {look_at} }}
background {{ rgb <0.2, 0.3, 0.5> }}
light_source {{ <50, 80, 60>, rgb 0.7 }}
light_source {{ <-60, 50, 30>, rgb 0.5 }}
"
    )
}

/// CPU seconds of the stages both programs have.
#[derive(Debug, Clone, Copy)]
struct Cost {
    parse: f64,
    build: f64,
    trace: f64,
}

/// Both programs on one scene, taking turns.
fn pair(folder: &Path, title: &str, name: &str, scene: &str, bar: f64, with_povray: bool) {
    let source = folder.join(format!("{name}.pov"));
    fs::write(&source, scene).expect("a scene written");
    let (ours, theirs) = (folder.join("ours.png"), folder.join("theirs.png"));
    let mut runs = Vec::new();
    for _ in 0..PAIRS {
        let lucarne = lucarne(&source, &ours);
        runs.push((lucarne, with_povray.then(|| povray(&source, &theirs))));
    }
    println!("\n{title}: {}×{}, one ray a pixel, one thread, n = {PAIRS}", SIZE.0, SIZE.1);
    println!("  CPU seconds         lucarne         POV-Ray        ratio of");
    println!("                    min   median    min   median    min  median");
    let row = |what: &str, cost: fn(&Cost) -> f64, note: &str| {
        let (least, median) = spread(runs.iter().map(|(ours, _)| cost(ours)));
        print!("  {what:14} {least:8.3} {median:8.3}");
        if with_povray {
            let theirs = spread(runs.iter().filter_map(|(_, theirs)| theirs.as_ref().map(cost)));
            let (a, b) = (theirs.0 / least, theirs.1 / median);
            print!(" {:7.3} {:8.3} {a:7.2} {b:7.2}{note}", theirs.0, theirs.1);
        }
        println!();
    };
    let note = format!("   promised: {bar}");
    let of_trace = name == "few";
    row("trace", |cost| cost.trace, if of_trace { &note } else { "" });
    row("build, trace", |cost| cost.build + cost.trace, if of_trace { "" } else { &note });
    row("all but files", |cost| cost.parse + cost.build + cost.trace, "");
    if with_povray {
        let (most, count, all) = difference(&ours, &theirs);
        println!("  pictures: {count} of {all} numbers differ, by at most {most} of 255");
    }
}

/// One render by ours: `parse` is up to the World, `build` the tree.
fn lucarne(source: &Path, picture: &Path) -> Cost {
    let output = Command::new(env!("CARGO_BIN_EXE_lucarne"))
        .args(["render", "--antialias", "off", "--threads", "1", "--stats=json"])
        .arg(format!("--size={}x{}", SIZE.0, SIZE.1))
        .arg("-o")
        .args([picture, source])
        .output()
        .expect("lucarne starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let stats: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let seconds = |key: &str| stats[key].as_f64().expect("seconds");
    Cost {
        parse: seconds("parse_cpu_s") + seconds("evaluate_cpu_s") + seconds("lower_cpu_s"),
        build: seconds("build_cpu_s"),
        trace: seconds("trace_cpu_s"),
    }
}

fn povray_version() -> Option<String> {
    let output = Command::new("povray").arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    text.lines().find(|line| line.contains("POV-Ray")).map(str::to_owned)
}

/// One render by POV-Ray, its times as it reports them.
fn povray(source: &Path, picture: &Path) -> Cost {
    let output = Command::new("povray")
        .args(["+WT1", "-A", "-D", "+FN", "-V"])
        .arg(format!("+W{}", SIZE.0))
        .arg(format!("+H{}", SIZE.1))
        .arg(format!("+I{}", source.display()))
        .arg(format!("+O{}", picture.display()))
        .output()
        .expect("povray starts");
    let report = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{report}");
    let seconds = |heading: &str| -> f64 {
        let part = report.split(heading).nth(1).expect("a time");
        let number = part.split("with ").nth(1).and_then(|rest| rest.split(' ').next());
        number.and_then(|number| number.parse().ok()).expect("CPU seconds")
    };
    Cost {
        parse: seconds("Parse Time:"),
        build: seconds("Bounding Time:"),
        trace: seconds("Trace Time:"),
    }
}

/// The largest difference of two 8-bit pictures, how many numbers differ, and of how many.
fn difference(one: &Path, other: &Path) -> (u8, usize, usize) {
    let [one, other] =
        [one, other].map(|path| image::open(path).expect("a picture").to_rgb8().into_raw());
    assert_eq!(one.len(), other.len());
    let apart: Vec<u8> = one.iter().zip(&other).map(|(a, b)| a.abs_diff(*b)).collect();
    let most = apart.iter().max().copied().unwrap_or(0);
    (most, apart.iter().filter(|&&d| d > 0).count(), apart.len())
}

/// How long one waits for next to nothing, by the clock.
fn starts(folder: &Path) {
    let tiny = folder.join("tiny.scene");
    fs::write(
        &tiny,
        "camera { location <0, 0, 5> look_at <0, 0, 0> }\nlight_source { <5, 5, 5>, rgb 1 }\n\
         sphere { <0, 0, 0>, 1 pigment { rgb <1, 0.5, 0.2> } }\n",
    )
    .expect("a scene written");
    let small = folder.join("few.pov");
    println!("\nFrom start to finish, by the clock, n = {STARTS}     min   median");
    let row = |what: &str, command: &mut Command| {
        let times = (0..STARTS).map(|_| {
            let start = Instant::now();
            let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
            assert!(status.expect("lucarne starts").success(), "{what}");
            start.elapsed().as_secs_f64() * 1e3
        });
        let (least, median) = spread(times);
        println!("  {what:36} {least:6.1} {median:8.1} ms   promised: 20");
    };
    let lucarne = || Command::new(env!("CARGO_BIN_EXE_lucarne"));
    let picture = folder.join("tiny.png");
    row(
        "render a sphere at 64×64",
        lucarne().args(["render", "--size=64x64", "-o"]).args([&picture, &tiny]),
    );
    row("check the scene of few things", lucarne().arg("check").arg(&small));
}

/// The least and the median.
fn spread(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    (values[0], values[values.len() / 2])
}
