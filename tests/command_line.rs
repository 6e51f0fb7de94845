//! The program as it is used: real runs, in folders of their own.

mod channels;
mod language;
mod limits;
mod long;
#[cfg(unix)]
mod povray;
#[cfg(unix)]
mod povray_options;
#[cfg(unix)]
mod povray_programs;
mod programs;
mod reading;
mod words;
mod writing;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const SCENE: &str = "\
camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
sphere { 0, 1 pigment { color rgb <1, 0, 0> } }
";

const BROKEN: &str = "\
camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
sphere { 0, 1 pigmnt { color rgb <1, 0, 0> } }
";

/// A folder with a good scene, `a.scene`, and a broken one, `broken.scene`.
struct Place(TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().expect("a folder"));
        place.write("a.scene", SCENE);
        place.write("broken.scene", BROKEN);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("listed").flatten();
        let mut names: Vec<String> =
            entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    fn command(&self, words: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucarne"));
        command.args(words.split_whitespace()).current_dir(self.0.path()).stdin(Stdio::null());
        // Wide enough that no sentence that is looked for is broken.
        command.env("COLUMNS", "120");
        command
    }

    /// Runs the program with these words.
    fn run(&self, words: &str) -> Run {
        Run(self.command(words).output().expect("runs"))
    }
}

struct Run(Output);

impl Run {
    fn code(&self) -> i32 {
        self.0.status.code().expect("not killed")
    }

    fn stdout(&self) -> String {
        String::from_utf8_lossy(&self.0.stdout).into_owned()
    }

    fn stderr(&self) -> String {
        String::from_utf8_lossy(&self.0.stderr).into_owned()
    }

    /// Asserts the exit code, and that standard error has these words.
    fn ends(self, code: i32, words: &[&str]) -> Self {
        assert_eq!(self.code(), code, "{}{}", self.stdout(), self.stderr());
        for word in words {
            assert!(self.stderr().contains(word), "no `{word}` in:\n{}", self.stderr());
        }
        self
    }
}

// ── render ──

#[test]
fn a_scene_alone_becomes_a_picture_of_its_name_in_the_current_folder() {
    let place = Place::new();
    fs::create_dir(place.path("here")).expect("a folder");
    let mut command = place.command("../a.scene --size 32x24");
    let run = Run(command.current_dir(place.path("here")).output().expect("runs"));
    let run = run.ends(0, &["a.png: 32×24, 1 object, 1 light, ", " s\n"]);
    assert_eq!((run.stdout().as_str(), run.stderr().lines().count()), ("", 1));
    assert_eq!(&place.read("here/a.png")[..8], b"\x89PNG\r\n\x1a\n");
}

#[test]
fn the_extension_chooses_the_format() {
    let place = Place::new();
    let starts: [(&str, &[u8]); 7] = [
        ("b.png", b"\x89PNG"),
        ("b.jpg", b"\xff\xd8\xff"),
        ("b.JPEG", b"\xff\xd8\xff"),
        ("b.ppm", b"P6\n16 8\n255\n"),
        ("b.qoi", b"qoif"),
        ("b.hdr", b"#?RADIANCE"),
        ("b.exr", b"\x76\x2f\x31\x01"),
    ];
    for (name, start) in starts {
        place.run(&format!("render a.scene -o {name} --size 16x8")).ends(0, &[name]);
        assert!(place.read(name).starts_with(start), "{name}");
    }
    place.run("a.scene -o b.ppm --size 16x8 --bits 16").ends(0, &[]);
    assert!(place.read("b.ppm").starts_with(b"P6\n16 8\n65535\n"));
}

#[test]
fn a_picture_on_standard_output_is_alone_there() {
    let place = Place::new();
    let run = place.run("a.scene -o - --size 16x8 --stats json --message-format json").ends(0, &[]);
    assert!(run.0.stdout.starts_with(b"\x89PNG") && run.0.stdout.ends_with(b"IEND\xaeB`\x82"));
    assert!(run.stderr().contains("\"wall_s\""));
    assert_eq!(place.names(), ["a.scene", "broken.scene"]);
}

#[test]
fn the_same_scene_gives_the_same_bytes_for_any_number_of_threads() {
    let place = Place::new();
    place.run("a.scene -o one.png --size 96x64 --threads 1").ends(0, &[]);
    place.run("a.scene -o four.png --size 96x64 --threads 4").ends(0, &[]);
    assert_eq!(place.read("one.png"), place.read("four.png"));
}

#[test]
fn a_region_is_an_exact_crop() {
    let place = Place::new();
    place.run("a.scene -o whole.ppm --size 40x30").ends(0, &[]);
    place.run("a.scene -o part.ppm --size 40x30 --region 10,8,20,12").ends(0, &["20×12"]);
    let (whole, part) = (place.read("whole.ppm"), place.read("part.ppm"));
    let (whole, part) = (&whole[b"P6\n40 30\n255\n".len()..], &part[b"P6\n20 12\n255\n".len()..]);
    let cut: Vec<u8> =
        (8..20).flat_map(|y| &whole[(y * 40 + 10) * 3..(y * 40 + 30) * 3]).copied().collect();
    assert_eq!(cut, part);
}

#[test]
fn a_number_from_the_command_line_reaches_the_scene() {
    let place = Place::new();
    place.write("d.scene", &SCENE.replace("0, 1 pig", "0, Radius pig"));
    place.run("d.scene --size 8x8").ends(1, &["undeclared-name"]);
    let run = place.run("d.scene --size 8x6 -D Radius=0.5").ends(0, &["d.png"]);
    assert!(!run.stderr().contains("warning"), "{}", run.stderr());
    let said = ["`-D Radios` declares a name that the scene never uses", "`-D Radius=…`"];
    place.run("d.scene --size 8x6 -D Radius=0.5 -D Radios=1 -D clock=1").ends(0, &said);
}

#[test]
fn a_number_from_the_command_line_that_the_scene_replaces_is_told() {
    let place = Place::new();
    let scene =
        |declared: &str| format!("{declared}\n{}", SCENE.replace("0, 1 pig", "0, Radius pig"));
    place.write("d.scene", &scene("#declare Radius = 2;"));
    let said = ["`-D Radius` does nothing: the scene declares `Radius` itself", "#ifndef (Radius)"];
    place.run("d.scene --size 8x6 -D Radius=0.5").ends(0, &said);
    for asked in ["#ifndef (Radius) #declare Radius = 2; #end", "#declare Radius = 2*Radius;"] {
        place.write("d.scene", &scene(asked));
        let run = place.run("d.scene --size 8x6 -D Radius=0.5").ends(0, &["d.png"]);
        assert!(!run.stderr().contains("does nothing"), "{}", run.stderr());
    }
}

#[test]
fn stats_are_one_object_of_json_or_a_table() {
    let place = Place::new();
    let run = place.run("a.scene --size 16x8 --antialias off --stats json").ends(0, &[]);
    let stats: serde_json::Value = serde_json::from_str(&run.stdout()).expect("JSON");
    for key in ["parse", "evaluate", "lower", "build", "trace", "encode"] {
        let seconds = stats[format!("{key}_cpu_s")].as_f64().expect(key);
        assert!((0.0..10.0).contains(&seconds), "{key} {seconds}");
    }
    assert!(stats["wall_s"].as_f64().is_some_and(|s| s > 0.0));
    assert!(stats["peak_rss_bytes"].as_u64().is_some_and(|bytes| bytes > 100_000));
    assert_eq!((stats["objects"].as_u64(), stats["lights"].as_u64()), (Some(1), Some(1)));
    assert_eq!(stats["rays"]["camera"].as_u64(), Some(16 * 8));
    assert!(stats["rays"]["shadow"].is_u64() && stats["rays"]["reflection"].is_u64());
    // One ball: no tree of boxes, and an equation for each ray that may meet it.
    let solves = stats["work"]["root_solves"].as_u64().expect("a count");
    assert!((1..=16 * 8 * 2).contains(&solves) && stats["work"]["box_visits"] == 0, "{stats}");
    // The ball's rays that meet it, by a light each; and no pattern.
    assert!((1..=16 * 8).contains(&stats["evaluations"]["diffuse"].as_u64().expect("a count")));
    assert_eq!(stats["evaluations"]["patterns"].as_u64(), Some(0));
    let words = ["peak memory", "camera rays", "box visits", "root solves", "patterns"];
    let table = place.run("--stats a.scene --size 16x8").ends(0, &[]).stdout();
    assert!(table.contains(" CPU s\n") && words.iter().all(|word| table.contains(word)), "{table}");
    // What is traced to keep a promise is no building of trees.
    for promise in ["--max-error 0.2", "--time-budget 1s"] {
        let run = place.run(&format!("a.scene --size 32x24 {promise} --stats json"));
        let stats: serde_json::Value = serde_json::from_str(&run.stdout()).expect("JSON");
        let seconds = |key: &str| stats[key].as_f64().expect("a number");
        assert!(seconds("build_cpu_s") < seconds("trace_cpu_s"), "{stats}");
    }
}

#[test]
fn of_light_far_beyond_white_a_promise_says_what_no_sample_tells() {
    let place = Place::new();
    let run =
        |scene: &str, promise: &str| place.run(&format!("{scene} --size 32x24 {promise}")).stderr();
    place.write("glare.scene", &SCENE.replace("rgb 1 }", "rgb 1e6 }"));
    // One that fades is as bright as it is where it shines.
    let fading = "rgb 1e6 fade_distance 0.01 fade_power 2 }";
    place.write("fading.scene", &SCENE.replace("rgb 1 }", fading));
    for promise in ["--max-error 0.2", "--time-budget 1s"] {
        let said = run("glare.scene", promise);
        assert!(said.contains("note: light here is up to 1000000 times white: "), "{said}");
        let others = run("a.scene", promise) + &run("fading.scene", promise);
        assert!(!others.contains("times white"), "{others}");
    }
}

#[test]
fn flags_are_read_as_tables_and_scenes_write_them() {
    let place = Place::new();
    let bytes = |words: &str| {
        place.run(&format!("a.scene --size 16x12 {words}")).ends(0, &[]);
        place.read("a.png")
    };
    assert_eq!(bytes("--antialias 3x3"), bytes("--antialias 3"));
    assert_eq!(bytes("--antialias 3×3"), bytes("--antialias 3"));
    bytes("--root-tolerance 1/1000");
    place
        .run("accuracy a.scene --size 16x12 --budget 1s --knobs anti_alias")
        .ends(2, &["antialias"]);
    let idle = place.run("accuracy a.scene --size 16x12 --knobs adc_bailout").ends(0, &[]);
    assert!(idle.stdout().starts_with("adc-bailout does nothing"), "{}", idle.stdout());
    for seed in ["-1", "1.5"] {
        let expected = "expected a whole number from 0 to 18446744073709551615";
        place.run(&format!("a.scene --max-error 0.1 --seed {seed}")).ends(2, &[expected]);
    }
}

#[test]
fn a_broken_scene_gives_no_picture() {
    let place = Place::new();
    place.run("broken.scene").ends(1, &["unknown-word", "`pigment`", "1 error"]);
    assert_eq!(place.names(), ["a.scene", "broken.scene"]);
}

#[test]
fn a_picture_is_overwritten_and_anything_else_is_not() {
    let place = Place::new();
    place.run("a.scene --size 8x8").ends(0, &[]);
    place.run("a.scene --size 9x9").ends(0, &[]);
    place.write("notes.png", "my notes");
    place.run("a.scene --size 8x8 -o notes.png").ends(3, &["not a picture", "--force"]);
    assert_eq!(place.read("notes.png"), b"my notes");
    place.run("a.scene --size 8x8 -o notes.png --force").ends(0, &[]);
    assert!(place.read("notes.png").starts_with(b"\x89PNG"));
}

#[test]
fn a_source_is_never_overwritten() {
    let place = Place::new();
    place.write("part.png", "sphere { x, 1 }\n");
    place.write("b.scene", &format!("{SCENE}#include \"part.png\"\n"));
    place.run("b.scene --size 8x8 -o part.png --force").ends(3, &["part of the scene"]);
    assert_eq!(place.read("part.png"), b"sphere { x, 1 }\n");
}

#[test]
fn a_place_that_cannot_be_written_is_told_before_the_render() {
    let place = Place::new();
    place.run("a.scene -o no/such/a.png").ends(3, &["there is no folder `no/such`"]);
    fs::create_dir(place.path("b.png")).expect("a folder");
    place.run("a.scene -o b.png").ends(3, &["it is a folder"]);
}

#[test]
fn no_trace_of_a_failed_write_is_left() {
    let place = Place::new();
    place.run("a.scene --size 70000x1 -o wide.jpg").ends(2, &["65535"]);
    assert_eq!(place.names(), ["a.scene", "broken.scene"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let place = Place::new();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device");
    let mut command = place.command("a.scene --size 8x8 -o -");
    command.stdout(full).env("TMPDIR", place.0.path());
    let run = Run(command.output().expect("runs"));
    run.ends(3, &["cannot write to standard output", "no space left", "/picture.partial-"]);
    let kept = place.names().into_iter().find(|name| name.starts_with("picture.partial-"));
    assert!(place.read(&kept.expect("kept")).starts_with(b"\x89PNG"));
}

#[cfg(unix)]
#[test]
fn an_interrupted_render_leaves_what_is_done() {
    let place = Place::new();
    // Whoever is interrupted before the tracing begins has written nothing: then wait longer.
    let interrupted = |delay: &u32| {
        let mut command =
            place.command("a.scene -o big.png --size 4000x4000 --antialias 16 --threads 1");
        let child = command.stderr(Stdio::piped()).spawn().expect("runs");
        std::thread::sleep(std::time::Duration::from_millis(u64::from(*delay)));
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(interrupt.expect("kill").success());
        let run = Run(child.wait_with_output().expect("ends"));
        run.0.status.code()?;
        (!run.stderr().contains("nothing was written")).then_some(run)
    };
    let run = [200, 1000, 5000, 20_000].iter().find_map(interrupted).expect("a trace begins");
    run.ends(130, &["interrupted", "big.partial.png"]);
    assert!(place.read("big.partial.png").starts_with(b"\x89PNG"));
    assert!(!place.names().contains(&"big.png".to_owned()));
}

#[cfg(unix)]
#[test]
fn an_interrupt_before_the_trace_says_which_loop_turned() {
    let place = Place::new();
    place.write("loop.scene", "#for (I, 1, 1e9) #end\n");
    let interrupted = |delay: &u32| {
        let mut command = place.command("loop.scene --limit loop-turns=1000000000000");
        let child = command.stderr(Stdio::piped()).spawn().expect("runs");
        std::thread::sleep(std::time::Duration::from_millis(u64::from(*delay)));
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(interrupt.expect("kill").success());
        let run = Run(child.wait_with_output().expect("ends"));
        run.0.status.code().is_some().then_some(run)
    };
    let run = [200, 1000, 5000].iter().find_map(interrupted).expect("it hears");
    run.ends(130, &["interrupted while a loop turned", "loop.scene:1:1"]);
}

// ── what is known before ──

#[test]
fn a_picture_of_another_shape_than_the_cameras_is_told() {
    let place = Place::new();
    let shape = "the picture is 4:1, the camera 4:3: pixels are not square";
    let help = "`right image_width/image_height*x`";
    place.run("a.scene --size 80x20").ends(0, &["picture-shape", shape, help]);
    place.run("check a.scene --size 80x20").ends(0, &["picture-shape"]);
    let follows = SCENE.replace("look_at", "right image_width/image_height*x look_at");
    place.write("follows.scene", &follows);
    place.write("a.pov", &format!("#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\n{SCENE}"));
    for words in ["a.scene --size 81x60", "a.scene --size 3x2", "check a.scene"]
        .iter()
        .chain(&["follows.scene --size 80x20", "a.pov --size 80x20"])
    {
        let run = place.run(words).ends(0, &[]);
        assert!(!run.stderr().contains("picture-shape"), "{words}: {}", run.stderr());
    }
    place.run("a.pov --size 80x20 --lint").ends(0, &[shape]);
}

#[test]
fn a_picture_beyond_all_memory_is_a_limit() {
    let place = Place::new();
    place
        .run("a.scene --size 1000000x1000000 --limit pixels=10000000000000")
        .ends(4, &["GiB of memory", "--limit pixels=N"]);
    place.run("a.scene --size 20000x20000").ends(4, &["--limit pixels=400000000"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_is_no_place_for_a_picture_and_nobody_waits_for_its_other_end() {
    let place = Place::new();
    let made = Command::new("mkfifo").arg(place.path("a.png")).status();
    assert!(made.expect("mkfifo").success());
    place.run("a.scene -o a.png --size 4x4").ends(3, &["it is not a file"]);
}

#[test]
fn more_threads_than_are_useful_make_the_same_picture() {
    let place = Place::new();
    place.run("a.scene -o many.ppm --size 40x40 --threads 1000").ends(0, &[]);
    place.run("a.scene -o one.ppm --size 40x40 --threads 1").ends(0, &[]);
    assert_eq!(place.read("many.ppm"), place.read("one.ppm"));
}

// ── messages ──

#[test]
fn the_authors_notes_take_no_room_of_errors_and_move_no_cursor() {
    let place = Place::new();
    let notes = "#for (I, 1, 150) #debug concat(chr(27), \"[31mnote\\t\\n\") #end\n";
    place.write("notes.scene", &format!("{notes}{BROKEN}"));
    let words = ["␛[31mnote\t\n", "unknown-word", "`pigmnt`"];
    let run = place.run("check notes.scene").ends(1, &words);
    assert!(!run.stderr().contains('\u{1b}') && !run.stderr().contains("more;"));
}

#[test]
fn many_warnings_hide_no_error() {
    let place = Place::new();
    let warnings = "#warning \"careful\"\n".repeat(150);
    place.write("warnings.scene", &format!("{warnings}{BROKEN}"));
    place.run("check warnings.scene").ends(1, &["`pigmnt`", "… and 130 more"]);
}

#[test]
fn errors_that_are_alike_are_shown_twenty_times_and_json_has_them_all() {
    let place = Place::new();
    let spheres = "sphere { 0, 1 pigmnt { } }\n".repeat(60);
    place.write("alike.scene", &format!("{spheres}sphere {{ 0, Radius }}\n"));
    let words = ["… and 40 more", "undeclared-name", "61 errors"];
    let run = place.run("check alike.scene").ends(1, &words);
    assert_eq!(run.stderr().matches("unknown-word\n").count(), 20);
    let json = place.run("check alike.scene --message-format json").ends(1, &[]).stdout();
    assert_eq!(json.lines().count(), 61);
}

#[test]
fn what_stands_before_a_fault_on_its_line_is_told_too() {
    let place = Place::new();
    place.write("two.scene", "sphere { 0, 1 pigmnt { } } box { 0, 1 rotate * }\n");
    let run = place.run("check two.scene --message-format short");
    run.ends(1, &["`pigmnt`", "expected-expression"]);
}

#[test]
fn a_warning_is_dropped_told_or_denied_as_the_flags_and_the_comments_say() {
    let place = Place::new();
    let scene = "#declare Radius = 2;\n#declare Height = 3; // lucarne: allow(unused-declaration)\n\
                 camera { location 5*z look_at 0 } light_source { 9, 1 }\n\
                 sphere { 0, 1 pigment { rgb 128 } }\n";
    place.write("a.scene", scene);
    let both = place.run("check a.scene").ends(0, &["`Radius`", "color-range", "2 warnings"]);
    assert!(!both.stderr().contains("`Height`"));
    let one = place.run("check a.scene --allow unused-declaration").ends(0, &["1 warning"]);
    assert!(!one.stderr().contains("Radius"));
    assert_eq!(
        place.run("check a.scene --allow all").ends(0, &[]).stderr(),
        "a.scene: no messages\n"
    );
    let denied = ["error[unused-declaration]", "warning[color-range]"];
    place.run("check a.scene --deny unused-declaration --message-format short").ends(1, &denied);
    place.run("a.scene --size 8x6 --deny all").ends(1, &["2 errors"]);
    assert!(!place.path("a.png").exists());
    place.write("a.pov", scene);
    let words = ["old-version", "color-range", "2 warnings"];
    place.run("check a.pov --warn color-range").ends(0, &words);
    place.run("check a.scene --allow unused-declarations").ends(2, &["unused-declaration"]);
    place.run("check a.scene --allow unclosed-block").ends(2, &["never a warning", "no-pigment"]);
    place.run("check a.scene --allow zzzzzzzz").ends(2, &["expected `all`", " no-pigment "]);
}

#[test]
fn allowing_a_code_that_is_an_error_here_is_told_to_have_no_effect() {
    let place = Place::new();
    place.write("a.scene", "global_settings { radiosity { } }\nsphere { 0, 1 }\n");
    let said = "`--allow not-supported-yet` silences warnings, and these are errors";
    place.run("check a.scene --allow not-supported-yet").ends(1, &["not-supported-yet", said]);
    let without = place.run("check a.scene").ends(1, &[]);
    assert!(!without.stderr().contains("silences"));
}

#[test]
fn messages_are_narrated_for_those_who_hear_them() {
    let place = Place::new();
    place.write("a.scene", "sphere { 0, 1 pigmnt { rgb 1 } }\n");
    let words = [
        "Error in a.scene, line 1, columns 15 to 20: `pigmnt` is not a word in `sphere`.",
        "The line reads: sphere { 0, 1 pigmnt { rgb 1 } }",
        "1 error",
    ];
    let run = place.run("check a.scene --message-format narrated").ends(1, &words);
    assert!(!run.stderr().contains(['│', '─', '×']));
}

#[test]
fn a_stray_end_hides_nothing_after_it() {
    let place = Place::new();
    place.write("stray.scene", "#end\n\nsphere { 0, 1 pigmnt { } }\n");
    let run = place.run("check stray.scene --message-format short");
    run.ends(1, &["stray-directive", "`pigmnt`"]);
}

// ── usage ──

#[test]
fn wrong_usage_is_two() {
    let place = Place::new();
    for words in [
        "",
        "--no-such-flag a.scene",
        "a.scene --size 0x5",
        "a.scene --size big",
        "a.scene --region 0,0,9,9 --size 8x8",
        "a.scene --antialias maybe",
        "a.scene --threads 0",
        "a.scene --depth 0",
        "a.scene -D 1=2",
        "a.scene -D sphere=1",
        "a.scene --stats xml",
        "a.scene -o a.jpg --size 70000x1",
        "a.scene -o a.qoi --size 30000x30000 --limit pixels=900000000",
        "a.scene --limit colours=3",
        "a.scene -o a.gif",
        "a.scene -o a",
        "a.scene -o a.jpg --bits 16",
        "a.scene -o a.exr --bits 8",
        "a.scene -I no_such_folder",
        "check",
        "show a.scene --stage",
        "explain no-such-code",
        "chekc a.scene",
    ] {
        let run = place.run(words);
        assert_eq!(run.code(), 2, "{words}: {}", run.stderr());
        assert!(!run.stderr().is_empty(), "{words}");
    }
    place.run("a.scene -o a.gif").ends(2, &[".gif", ".png"]);
    place.run("a.scene --size -1x5").ends(2, &["-1x5", "each from 1 to 1000000"]);
    place.run("a.scene --threads -1").ends(2, &["-1", "a whole number from 1 to 1024"]);
    place.run("a.scene --depth 0").ends(2, &["a whole number from 1 to"]);
    place.run("a.scene --time-budget 3d").ends(2, &["a number alone is seconds"]);
    place.run("check a.scene -I no_such").ends(2, &["`-I no_such`: there is no such folder"]);
    place.run("a.scene -D x=2").ends(2, &["`x` is a word of the language"]);
    place.run("a.scene --stats xml").ends(2, &["xml", "possible values: json"]);
    place.run("a.scene -o a.jpg --size 70000x1").ends(2, &["at most 65535 pixels"]);
    place.run("explain unknwon-word").ends(2, &["did you mean `unknown-word`?"]);
}

#[test]
fn an_option_that_is_known_elsewhere_is_told_where() {
    let place = Place::new();
    let run = place.run("accuracy a.scene --antialias 3");
    let run = run.ends(2, &["it is an option of `lucarne render`", "`--knobs antialias`"]);
    assert!(!run.stderr().contains("as a value"), "{}", run.stderr());
    place.run("accuracy a.scene -o a.png").ends(2, &["`--svg OUT.svg`"]);
    place.run("plan a.scene --time-budget 3s").ends(2, &["an option of `lucarne render`"]);
    for (words, size) in [
        ("a.scene -w 640", "640x480"),
        ("a.scene +W320 +H200", "320x200"),
        ("accuracy a.scene -w", "640x480"),
    ] {
        place.run(words).ends(2, &["is an option of POV-Ray's", &format!("`--size {size}`")]);
    }
}

#[test]
fn help_and_version_are_asked_for() {
    let place = Place::new();
    let help = place.run("--help").ends(0, &[]).stdout();
    for word in [
        "lucarne [OPTIONS] <FILE>",
        "render",
        "check",
        "show",
        "plan",
        "accuracy",
        "explain",
        "Exit codes",
        "those of `lucarne render --help`",
    ] {
        assert!(help.contains(word), "{word}");
    }
    let lines = help.lines().skip_while(|line| !line.starts_with("Exit codes"));
    assert!(lines.clone().count() > 5 && lines.clone().all(|line| line.len() <= 60), "{help}");
    assert!(place.run("--version").ends(0, &[]).stdout().starts_with("lucarne "));
    assert!(place.run("render --help").ends(0, &[]).stdout().contains("--region"));
}

#[test]
fn a_scene_that_cannot_be_read_is_three() {
    let place = Place::new();
    place.run("b.scene").ends(3, &["cannot read `b.scene`", "there is no such file"]);
    place.run("a").ends(3, &["did you mean `a.scene`?"]);
    place.write("plain.scene", SCENE);
    place.run("plain").ends(3, &["did you mean `plain.scene`?"]);
    place.run("a.scen").ends(3, &["did you mean `a.scene`?"]);
    fs::create_dir(place.path("dir.scene")).expect("a folder");
    place.run("dir.scene").ends(3, &["it is a folder"]);
}

#[test]
fn a_dash_is_standard_input() {
    let place = Place::new();
    let from = |words: &str, file: &str| {
        let input = fs::File::open(place.path(file)).expect("there");
        Run(place.command(words).stdin(input).output().expect("runs"))
    };
    from("- --size 8x6", "a.scene").ends(0, &["picture.png: 8×6, 1 object"]);
    assert!(place.path("picture.png").exists());
    from("check -", "broken.scene").ends(1, &["standard input:3:15", "`pigmnt`"]);
    from("check --fix -", "broken.scene").ends(2, &["standard input cannot be fixed"]);
    assert!(from("- -o - --size 8x6", "a.scene").0.stdout.starts_with(b"\x89PNG"));
}

#[test]
fn utf_16_is_one_error() {
    let place = Place::new();
    let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    fs::write(place.path("wide.scene"), wide(&format!("\u{feff}{SCENE}"))).expect("written");
    fs::write(place.path("wide.inc"), wide(SCENE)).expect("written");
    place.write("i.scene", "#include \"wide.inc\"\n");
    let run = place.run("check wide.scene").ends(3, &["it is UTF-16", "save it as UTF-8"]);
    assert_eq!(run.stderr().lines().count(), 2);
    place.run("check i.scene").ends(1, &["unreadable-file", "UTF-16", "1 error"]);
}

#[test]
fn a_limit_is_four() {
    let place = Place::new();
    place.write("loop.scene", &format!("{SCENE}#while (1) #end\n"));
    place.run("check loop.scene --limit loop-turns=1000").ends(4, &["loop-limit"]);
    let text = "#declare T = \"a\"; #for (I, 1, 30) #declare T = concat(T, T); #end";
    place.write("text.scene", text);
    place.run("check text.scene").ends(4, &["string-limit", "16 MiB", "--limit string=N"]);
    place.run("check text.scene --limit string=1").ends(4, &["string-limit", "1 MiB"]);
    // Whatever else was wrong: it was the limit that stopped it.
    place.write("both.scene", "#include \"nowhere.inc\"\n#while (1) #end\n");
    let both = ["missing-include", "loop-limit"];
    place.run("check both.scene --limit loop-turns=1000").ends(4, &both);
    place.run("a.scene --size 99999x99999").ends(4, &["pixels", "--limit"]);
}

#[test]
fn the_first_assumed_gamma_counts_as_in_pov_ray() {
    let place = Place::new();
    place.write(
        "twice.scene",
        &format!("global_settings {{ assumed_gamma 1.8 assumed_gamma 2.5 }}\n{SCENE}"),
    );
    let world = place.run("show twice.scene --stage world").ends(0, &[]).stdout();
    assert!(world.contains("assumed_gamma 1.8"), "{world}");
}

#[test]
fn assumed_gamma_srgb_is_the_displays_own_curve_so_its_numbers_are_shown_as_written() {
    let place = Place::new();
    let scene = "global_settings { assumed_gamma srgb } background { rgb <0.5, 0.02, 0.8> }";
    place.write("curve.scene", scene);
    place.run("render curve.scene -o curve.ppm --size 1x1").ends(0, &[]);
    // The numbers POV-Ray shows: 255 times what is written. With 2.2 they are 128, 0 and 205.
    let image = place.read("curve.ppm");
    assert_eq!(image[image.len() - 3..], [128, 5, 204]);
}

#[test]
fn a_parallel_light_without_point_at_shines_at_z_in_a_pov_file_as_in_pov_ray() {
    let place = Place::new();
    let lamp = "#version 3.7; global_settings { assumed_gamma 1 } camera { location -9*z }
        light_source { <-5, 6, 2>, rgb 1 parallel } sphere { 0, 1 }";
    for (name, shown) in [("a.pov", "<0, 0, 1>"), ("b.scene", "<0, 0, 0>")] {
        place.write(name, lamp);
        let scene = place.run(&format!("show {name} --stage scene")).ends(0, &[]).stdout();
        assert!(scene.contains(&format!("parallel point_at {shown}")), "{scene}");
    }
}

#[test]
fn a_background_is_darker_by_its_transmit_as_in_pov_ray() {
    let place = Place::new();
    for (written, shown) in [
        ("rgbt <0.8, 0.6, 0.4, 0.5>", "<0.4, 0.3, 0.2>"),
        ("rgbft <0.5, 1, 0, 0.3, 0.75>", "<0.125, 0.25, 0>"),
        ("rgbf <0.8, 0.6, 0.4, 0.5>", "<0.8, 0.6, 0.4>"),
        ("rgbt <0.8, 0.6, 0.4, 1>", "<0, 0, 0>"),
        ("color 0.5", "<0.25, 0.25, 0.25>"),
    ] {
        place.write("sky.scene", &format!("background {{ {written} }} {SCENE}"));
        let world = place.run("show sky.scene --stage world").ends(0, &[]).stdout();
        let is_shown = |end: &str| world.contains(&format!("\nbackground {shown}{end}"));
        assert!(is_shown("\n") || is_shown(", with alpha "), "{written}: {world}");
    }
}

// ── check ──

#[test]
fn a_right_scene_gets_no_message() {
    let place = Place::new();
    let run = place.run("check a.scene").ends(0, &[]);
    assert_eq!((run.stdout().as_str(), run.stderr().as_str()), ("", "a.scene: no messages\n"));
    for quiet in ["--quiet", "--message-format short", "--message-format json"] {
        let run = place.run(&format!("check a.scene {quiet}")).ends(0, &[]);
        assert_eq!((run.stdout(), run.stderr()), (String::new(), String::new()), "{quiet}");
    }
}

#[test]
fn an_include_alone_is_not_judged_as_a_scene() {
    let place = Place::new();
    place
        .write("part.inc", "#declare Size = 2;\n#declare Ball = sphere { 0, 1 }\nbox { 0, Foo }\n");
    let run = place.run("check part.inc --lint --message-format short").ends(1, &["`Foo`"]);
    assert_eq!(run.stderr().lines().count(), 1, "{}", run.stderr());
    place.write("right.inc", "#declare Ball = sphere { 0, 1 }\n");
    place.run("check right.inc").ends(0, &["right.inc: no messages"]);
    place.run("check right.inc --deny never-placed").ends(1, &["never-placed"]);
}

#[test]
fn an_include_beside_the_scene_is_suggested_without_a_path() {
    let place = Place::new();
    place.write("shapes_of_mine.inc", "");
    place.write("i.scene", &format!("#include \"shape_of_mine.inc\"\n{SCENE}"));
    place.run("check i.scene").ends(1, &["missing-include", "`shapes_of_mine.inc`"]);
}

#[test]
fn warnings_may_be_named_with_commas() {
    let place = Place::new();
    place.write("l.scene", "#declare Size = 2;\nsphere { 0, 1 }\n");
    let all = "check l.scene --allow unused-declaration,no-camera,no-light,nothing-in-view";
    place.run(all).ends(0, &["l.scene: no messages"]);
}

#[test]
fn show_without_a_stage_shows_the_scene() {
    let place = Place::new();
    let [bare, named] = ["show a.scene", "show a.scene --stage scene"].map(|run| place.run(run));
    assert_eq!(bare.ends(0, &[]).stdout(), named.ends(0, &[]).stdout());
}

#[test]
fn json_is_one_object_a_line_on_standard_output() {
    let place = Place::new();
    let run = place.run("check broken.scene a.scene --message-format json").ends(1, &[]);
    assert_eq!(run.stderr(), "");
    let message: serde_json::Value = serde_json::from_str(&run.stdout()).expect("one object");
    assert_eq!(message["code"], "unknown-word");
    let label = &message["labels"][0];
    assert_eq!(
        (&label["file"], label["line"].as_u64(), label["column"].as_u64()),
        (&"broken.scene".into(), Some(3), Some(15))
    );
    assert_eq!((label["end_line"].as_u64(), label["end_column"].as_u64()), (Some(3), Some(21)));
    assert_eq!(message["fixes"][0]["text"], "pigment");
}

#[test]
fn short_is_one_line_a_message() {
    let run = Place::new().run("check broken.scene --message-format short").ends(1, &[]);
    assert_eq!(run.stderr().lines().count(), 1);
    assert!(run.stderr().starts_with("broken.scene:3:15: error[unknown-word]: "));
}

#[test]
fn colour_is_for_terminals() {
    assert!(!Place::new().run("check broken.scene").ends(1, &[]).stderr().contains('\u{1b}'));
}

#[test]
fn a_missing_file_does_not_keep_the_others_from_being_checked() {
    let place = Place::new();
    place.run("check missing.scene broken.scene").ends(3, &["missing.scene", "unknown-word"]);
}

#[test]
fn warnings_can_be_denied() {
    let place = Place::new();
    place.write("w.scene", &format!("{SCENE}#declare Unused = 1;\n"));
    place.run("check w.scene").ends(0, &["unused-declaration", "1 warning"]);
    place
        .run("check w.scene --deny-warnings")
        .ends(1, &["unused-declaration", "errors here (--deny"]);
    place.run("w.scene --deny-warnings").ends(1, &[]);
    assert!(!place.names().contains(&"w.png".to_owned()));
}

#[test]
fn lints_are_off_for_pov_files_unless_asked_for() {
    let place = Place::new();
    let text = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#declare Unused = 1;\n";
    place.write("w.pov", &format!("{text}{SCENE}"));
    assert_eq!(place.run("check w.pov").ends(0, &[]).stderr(), "w.pov: no messages\n");
    place.run("check w.pov --lint").ends(0, &["unused-declaration"]);
}

#[test]
fn syntax_only_reads_no_includes() {
    let place = Place::new();
    place.write("s.scene", "#include \"missing.inc\"\nsphere { 0, Undeclared }\n");
    place.run("check s.scene --syntax-only").ends(0, &[]);
    place.write("s.scene", "sphere { 0, 1\n");
    place.run("check s.scene --syntax-only").ends(1, &["unclosed-block"]);
}

#[test]
fn a_fix_in_an_included_file_is_told_with_what_applies_it() {
    let place = Place::new();
    place.write("part.inc", "sphere { 0, 1 pigmnt { rgb 1 } }\n");
    place.write(
        "whole.scene",
        "camera { location 5*z look_at 0 }\nlight_source { 9, 1 }\n#include \"part.inc\"\n",
    );
    let told = "1 fix is in part.inc: `lucarne check --fix part.inc` applies it";
    place.run("check --fix whole.scene").ends(1, &[told, "`pigmnt`"]);
    place.run("check --fix part.inc").ends(0, &["part.inc: 1 fix applied"]);
    assert_eq!(
        place.run("check --fix whole.scene").ends(0, &[]).stderr(),
        "whole.scene: no messages\n"
    );
}

#[test]
fn fixes_are_applied_and_the_rest_is_told() {
    let place = Place::new();
    place.write("f.scene", &format!("\u{feff}{}sphere {{ 0, Nowhere }}\r\n", BROKEN));
    place.run("check --fix f.scene").ends(1, &["f.scene: 1 fix applied", "undeclared-name"]);
    let mended = format!("\u{feff}{SCENE}sphere {{ 0, Nowhere }}\r\n");
    assert_eq!(String::from_utf8(place.read("f.scene")).as_deref(), Ok(mended.as_str()));
    assert_eq!(place.run("check --fix a.scene").ends(0, &[]).stderr(), "a.scene: no messages\n");
    assert_eq!(place.names(), ["a.scene", "broken.scene", "f.scene"]);
}

#[test]
fn a_misspelt_block_is_mended_with_what_it_hid_and_what_is_left_is_counted() {
    let place = Place::new();
    place.write("hid.scene", "Sphere { 0, 1 pigmet { rgb 1 } }\n");
    place.run("check --fix hid.scene").ends(0, &["hid.scene: 2 fixes applied"]);
    let mended = String::from_utf8(place.read("hid.scene"));
    assert_eq!(mended.as_deref(), Ok("sphere { 0, 1 pigment { rgb 1 } }\n"));
}

#[test]
fn includes_are_found_in_the_folders_given() {
    let place = Place::new();
    for folder in ["one", "two"] {
        fs::create_dir(place.path(folder)).expect("a folder");
        place.write(&format!("{folder}/ball.inc"), &format!("#debug \"{folder}\"\n"));
    }
    place.write("i.scene", &format!("#include \"ball.inc\"\n{SCENE}"));
    place.run("check i.scene").ends(1, &["missing-include"]);
    place.run("check i.scene -I two -I one").ends(0, &["two"]);
}

// ── show, plan, explain ──

#[test]
fn each_stage_can_be_shown() {
    let place = Place::new();
    for (stage, word) in [
        ("ast", "sphere"),
        ("scene", "sphere <0, 0, 0> 1"),
        ("world", "radius 1"),
        ("plan", "diffuse"),
    ] {
        let shown = place.run(&format!("show a.scene --stage {stage}")).ends(0, &[]).stdout();
        assert!(shown.contains(word), "{stage}:\n{shown}");
    }
    let plan = place.run("plan a.scene --size 8x8").ends(0, &[]).stdout();
    assert!(plan.contains("picture 8×8") && plan.contains("a.scene:"), "{plan}");
}

#[test]
fn a_plan_as_json_has_every_place_and_what_the_pilot_counted() {
    let place = Place::new();
    let plan = place.run("plan a.scene --json --size 80x60 --antialias 3").ends(0, &[]).stdout();
    let plan: serde_json::Value = serde_json::from_str(&plan).expect("one object");
    assert_eq!((&plan["width"], &plan["antialias"]["n"]), (&80.into(), &3.into()));
    let stages = ["camera", "intersect", "surface", "light", "shadow"];
    assert_eq!(plan["stages"], serde_json::json!(stages));
    let effects = plan["effects"].as_array().expect("a list");
    let row = |name: &str| effects.iter().find(|row| row["effect"] == name).expect("a row");
    let lamp = &row("shadows")["called_for_by"][0];
    assert_eq!((&lamp["file"], &lamp["line"]), (&"a.scene".into(), &2.into()));
    let range = |end: &str| lamp[end].as_u64().expect("a byte") as usize;
    assert_eq!(SCENE[range("start")..range("end")], *lamp["text"].as_str().expect("a text"));
    assert_eq!(lamp["text"], "light_source { <4, 8, 6>, rgb 1 }");
    assert_eq!((&row("reflection")["on"], &row("sky")["on"]), (&false.into(), &false.into()));
    assert_eq!(row("reflection")["why"], "no surface reflects");
    // Every lit hit of the pilot's camera rays sends one ray to the one light.
    let shadow = row("shadows")["rays_per_camera_ray"].as_f64().expect("a number");
    assert!(shadow > 0.05 && shadow < 0.5, "{shadow}");
    let rays = &plan["rays"];
    assert_eq!((&rays["pilot"][0], &rays["pilot"][1]), (&64.into(), &48.into()));
    assert_eq!(rays["camera"], 80.0 * 60.0 * 9.0);
    assert_eq!(rays["per_camera_ray"], 1.0 + shadow);
    assert_eq!(plan["numerics"]["largest_half_width"]["value"], 1.0);
    let again = place.run("plan a.scene --json --size 80x60 --antialias 3").ends(0, &[]).stdout();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&again).expect("the same"), plan);
}

#[test]
fn a_broken_scene_shows_what_there_is_of_it() {
    let run = Place::new().run("show broken.scene --stage world").ends(1, &["unknown-word"]);
    assert!(run.stdout().contains("lights 1"));
    let plan = Place::new().run("plan broken.scene").ends(1, &["unknown-word"]).stdout();
    assert!(plan.starts_with("incomplete: the scene has errors"), "{plan}");
    let json = Place::new().run("plan broken.scene --json").ends(1, &[]).stdout();
    let json: serde_json::Value = serde_json::from_str(&json).expect("one object");
    assert_eq!(json["incomplete"], true);
}

#[test]
fn explain_prints_a_page_or_lists_the_codes() {
    let place = Place::new();
    let page = place.run("explain zero-scale").ends(0, &[]).stdout();
    assert!(page.starts_with("zero-scale\n") && page.contains("\nInstead\n"));
    let list = place.run("explain").ends(0, &[]).stdout();
    for heading in ["\nErrors\n  unclosed-block ", "\nOpinions: ", "\nLimits: ", "\nLints: "] {
        assert!(list.contains(heading), "{heading}:\n{list}");
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let place = Place::new();
    let mut child = place.command("explain").stdout(Stdio::piped()).spawn().expect("runs");
    drop(child.stdout.take());
    assert!(child.wait().expect("ends").code().is_some_and(|code| code != 70));
}

// ── accuracy ──

#[test]
fn accuracy_prints_a_table_with_the_scenes_own_settings_starred() {
    let place = Place::new();
    let run = place.run("accuracy a.scene --size 24x18 --budget 6s --threads 1").ends(0, &[]);
    let table = run.stdout();
    let answer = table.lines().next().expect("a line");
    assert!(answer.starts_with("use --antialias ") || answer.starts_with("keep "), "{table}");
    assert!(table.contains("\na.scene 24×18: 432 audited pixels (seed 1), "), "{table}");
    assert!(table.contains("\n* adaptive 0.05 8×8 "), "{table}");
    assert!(table.lines().all(|line| line.chars().count() <= 100), "{table}");
    assert!(table.contains("\nantialias bought, from off to "), "{table}");
    // Nothing reflects.
    assert!(!table.contains("depth"), "{table}");
    assert_eq!(run.stderr(), "", "a bar only on a terminal");
    assert_eq!(place.names(), ["a.scene", "broken.scene"]);
    let words = "accuracy a.scene --size 24x18 --budget 2s --wide --knobs antialias";
    assert!(place.run(words).ends(0, &[]).stdout().contains(" rays/px boxes/px roots/px "));
}

#[test]
fn accuracy_ends_at_once_where_there_is_nothing_to_measure() {
    let place = Place::new();
    place.write("bare.scene", "camera { } background { rgb 0.5 }");
    let run = place.run("accuracy bare.scene --allow all").ends(0, &[]);
    assert!(run.stdout().starts_with(
        "antialias does nothing here: there is nothing to see, or a lens blurs it.\n"
    ));
    // A place that cannot be written is known before, too.
    let words = "accuracy a.scene --size 24x18 --budget 600s --svg no/such/d.svg";
    place.run(words).ends(3, &["there is no folder `no/such`"]);
    // A budget that the picture alone is too much for is refused, with one that is not.
    let words = "accuracy a.scene --size 4000x3000 --budget 2s";
    let run =
        place.run(words).ends(4, &["2 s are too few", "`--budget ", "is enough, or `--size "]);
    assert!(run.stdout().is_empty());
}

#[test]
fn accuracy_writes_json_and_a_diagram() {
    let place = Place::new();
    let words = "accuracy a.scene --size 32x24 --budget 4s --json --svg d.svg --metric bad";
    let run = place.run(words).ends(0, &["d.svg: the work-precision diagram"]);
    let report: serde_json::Value = serde_json::from_str(&run.stdout()).expect("JSON");
    assert_eq!(report["metric"], "bad");
    assert_eq!(report["host"]["version"], env!("CARGO_PKG_VERSION"));
    assert!(report["host"]["threads"].as_u64().is_some_and(|threads| threads > 0));
    assert_eq!(report["knobs"][0]["settings"][0]["flag"], "--antialias off");
    let rays = report["rows"][1]["rays"]["camera"].as_u64();
    assert_eq!(rays, Some(32 * 24));
    let work = &report["rows"][1]["work"];
    assert!(work["root_solves"].as_u64().is_some_and(|solves| solves > 0), "{work}");
    assert_eq!(work["box_visits"], 0);
    let svg = String::from_utf8(place.read("d.svg")).expect("text");
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert!(svg.contains("prefers-color-scheme:dark"));
}

#[test]
fn accuracy_turns_the_knobs_that_are_named_and_knows_their_names() {
    let place = Place::new();
    let mirror = SCENE.replace("pigment", "finish { reflection 0.5 } pigment");
    let mirror = format!("background {{ rgb 0.5 }}\n{mirror}");
    place.write("m.scene", &mirror);
    let words = "accuracy m.scene --size 32x24 --budget 4s --knobs depth,adc-bailout";
    let table = place.run(words).ends(0, &[]).stdout();
    assert!(table.contains("\ndepth\n") && table.contains("\nadc-bailout\n"), "{table}");
    assert!(!table.contains("\nantialias\n"), "{table}");
    // A single convex mirror on nothing: the second level is the last, and none beyond is another.
    assert!(table.contains("\n* 2 … 250 "), "{table}");
    place
        .run("accuracy m.scene --knobs depht")
        .ends(2, &["antialias, depth, adc-bailout, root-tolerance"]);
    place.run("accuracy m.scene --budget 0").ends(2, &["such as 500ms, 60s or 5m"]);
    place
        .run("accuracy m.scene --budget 1ms")
        .ends(4, &["0.001 s are too few", "nothing was measured", "`--budget "]);
    place.run("accuracy m.scene --svg d.png").ends(2, &["is an .svg"]);
    place.run("accuracy broken.scene").ends(1, &["unknown-word"]);
    place.run("accuracy no.scene").ends(3, &["no.scene"]);
}

#[test]
fn accuracy_says_at_once_of_a_knob_that_does_nothing_why() {
    let place = Place::new();
    let words = "accuracy a.scene --size 640x480 --knobs depth,adc-bailout --svg d.svg";
    let run = place.run(words).ends(0, &[]);
    assert_eq!(
        run.stdout(),
        "depth does nothing here: no surface reflects or is clear.
adc-bailout does nothing here: no surface reflects or is clear.
"
    );
    assert_eq!(place.names(), ["a.scene", "broken.scene"], "nothing to draw");
    let json = place.run(&format!("{words} --json")).ends(0, &[]).stdout();
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["does_nothing"].as_array().map(Vec::len), Some(2));
    // Beside one that does something it stands below the table.
    let words = "accuracy a.scene --size 24x18 --budget 4s --knobs depth,antialias";
    let table = place.run(words).ends(0, &[]).stdout();
    assert!(table.contains("\nantialias\n") && !table.contains("\ndepth\n"), "{table}");
    assert!(table.ends_with("\ndepth does nothing here: no surface reflects or is clear.\n"));
}

#[test]
fn the_flags_that_are_printed_make_the_picture_that_was_promised() {
    let place = Place::new();
    let words = "a.scene --size 64x48 --max-error 2% --seed 8 -o one.png";
    let run = place.run(words).ends(0, &["error 0.", "] ≤ 0.02", "fresh pixels"]);
    let said = run.stderr();
    let (_, flags) = said.split_once("the same picture: ").expect("flags");
    place.run(&format!("a.scene --size 64x48 -o other.png {}", flags.trim())).ends(0, &[]);
    assert_eq!(place.read("one.png"), place.read("other.png"));
    let again = place.run(&words.replace("one.png", "one.png --threads 3")).ends(0, &[]).stderr();
    // All but the lines with seconds: those that it is about to take, and those that it took.
    let found = |said: &str| -> Vec<String> {
        let is_timed = |line: &&str| {
            [".png: ", " about ", " takes ", " % after "].iter().any(|timed| line.contains(timed))
        };
        said.lines().filter(|line| !is_timed(line)).map(str::to_owned).collect()
    };
    assert_eq!(found(&again), found(&said));
    // Standard error is no terminal here: its steps are told in lines.
    assert!(said.starts_with("note: choosing settings"), "{said}");
    assert!(said.contains("\nnote: rendering with --antialias "), "{said}");
    assert!(said.contains("\nnote: that takes less than a second\n"), "{said}");
}

#[test]
fn a_promise_that_cannot_be_kept_is_told_and_ends_with_5() {
    let place = Place::new();
    place.write(
        "rare.scene",
        "camera { location <0, 0, 6> look_at 0 angle 40 } light_source { <4, 8, 6>, rgb 1 }
         plane { z, -9 pigment { checker rgb 0 rgb 1 scale 0.01 } finish { ambient 1 } }",
    );
    let run = place.run("rare.scene --size 24x18 --max-error 0.000001 -o r.png");
    let run = run.ends(
        5,
        &[
            "note: no settings are known to keep 1.0e-6; the best that can be reached here is ",
            " fresh pixels; the pixels are so noisy that not even their reference tells so small",
        ],
    );
    assert!(!run.stderr().contains("choosing better"), "{}", run.stderr());
    assert!(place.path("r.png").exists());
}

#[test]
fn a_promise_has_a_right_form_and_enough_pixels() {
    let place = Place::new();
    place.run("a.scene --max-error 0").ends(2, &["such as 0.01"]);
    place.run("a.scene --max-error 0.1 --antialias 3").ends(2, &["cannot be used with"]);
    place.run("a.scene --max-error 0.1 --time-budget 3s").ends(2, &["cannot be used with"]);
    place.run("a.scene --max-error 0.1 --size 4x4").ends(2, &["too few to prove"]);
    place.run("a.scene --max-error 3/2").ends(2, &["such as 0.01, 1% or 2/255"]);
    // What they speak of is not there.
    for alone in ["--metric bad", "--seed 2"] {
        let words = format!("a.scene {alone}");
        place.run(&words).ends(2, &["--max-error <E>", "--time-budget <T>"]);
    }
    assert_eq!(place.names(), ["a.scene", "broken.scene"]);
}

#[test]
fn a_time_that_suffices_is_used_and_one_that_does_not_leaves_what_there_is() {
    let place = Place::new();
    let run = place.run("a.scene --size 640x480 --time-budget 3s -o t.png");
    let run = run.ends(0, &["t.png: 640×480", " samples a pixel, ", " on average\n"]);
    let said = run.stderr();
    let took: f64 = said
        .split(", ")
        .find_map(|part| part.split_once(" s\n")?.0.parse().ok())
        .unwrap_or_else(|| panic!("no time in {said}"));
    assert!(took <= 3.0 * 1.05, "{said}");
    assert!(said.contains("error ") && said.contains(" pixels, after "), "{said}");
    let run = place.run("a.scene --size 16x12 --time-budget 100s --metric bad -o v.png");
    run.ends(0, &["\n1024 samples a pixel: that is the most there is"]);
    let run = place.run("a.scene --size 2000x1500 --time-budget 50ms -o u.png");
    run.ends(4, &["0.05 s are too few for one ray a pixel"]);
    assert!(place.path("u.partial.png").exists() && !place.path("u.png").exists());
}

const CROOKED: &str = "sphere{0,1 // a ball\n   pigment{rgb 1}}\n";
const STRAIGHT: &str = "sphere {\n  0, 1  // a ball\n  pigment { rgb 1 }\n}\n";

#[test]
fn fmt_lays_files_out_and_leaves_those_alone_that_it_cannot_read() {
    let place = Place::new();
    place.write("a.inc", CROOKED);
    place.write("open.scene", "sphere{0,1");
    place.run("fmt a.inc open.scene no.scene").ends(3, &["unclosed-block", "no such file"]);
    assert_eq!(String::from_utf8_lossy(&place.read("a.inc")), STRAIGHT);
    assert_eq!(place.read("open.scene"), b"sphere{0,1");
    let again = place.run("fmt a.inc --check").ends(0, &[]);
    assert_eq!(again.stdout() + &again.stderr(), "");
    assert_eq!(place.names(), ["a.inc", "a.scene", "broken.scene", "open.scene"]);
    // A misspelt word is no fault of form.
    place.run("fmt broken.scene --check").ends(0, &[]);
}

#[test]
fn fmt_says_what_would_change_and_writes_nothing() {
    let place = Place::new();
    place.write("b.scene", CROOKED);
    let listed = place.run("fmt a.scene b.scene --check").ends(1, &[]);
    assert_eq!(listed.stdout(), "b.scene\n");
    let diff = place.run("fmt a.scene b.scene --diff").ends(0, &[]).stdout();
    assert!(diff.starts_with("--- b.scene\n+++ b.scene (formatted)\n@@ -1,2 +1,4 @@\n"), "{diff}");
    assert!(diff.contains("\n-   pigment{rgb 1}}\n") && diff.contains("\n+  pigment { rgb 1 }\n"));
    place.run("fmt b.scene --diff --check").ends(1, &[]);
    assert_eq!(place.read("b.scene"), CROOKED.as_bytes());
}

#[test]
fn fmt_keeps_the_bytes_of_a_file_that_are_no_layout() {
    let place = Place::new();
    let write = |name: &str, bytes: &[u8]| fs::write(place.path(name), bytes).expect("written");
    write("latin.pov", b"// caf\xe9\nA( )\n");
    write("mark.pov", b"\xef\xbb\xbfA( )\r\n");
    place.run("fmt latin.pov mark.pov").ends(0, &[]);
    assert_eq!(place.read("latin.pov"), b"// caf\xe9\nA()\n");
    assert_eq!(place.read("mark.pov"), b"\xef\xbb\xbfA()\r\n");
}

#[cfg(unix)]
#[test]
fn fmt_keeps_permissions_and_links() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    place.write("b.scene", CROOKED);
    fs::set_permissions(place.path("b.scene"), fs::Permissions::from_mode(0o640)).expect("set");
    std::os::unix::fs::symlink(place.path("b.scene"), place.path("link.scene")).expect("a link");
    place.run("fmt link.scene").ends(0, &[]);
    assert!(fs::symlink_metadata(place.path("link.scene")).expect("there").is_symlink());
    let mode = fs::metadata(place.path("b.scene")).expect("there").permissions().mode();
    assert_eq!((mode & 0o777, place.read("b.scene")), (0o640, STRAIGHT.as_bytes().to_vec()));
}

#[test]
fn old_forms_are_listed_and_rewritten() {
    let place = Place::new();
    let old = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#declare Size = 2\n\
               sphere { <0 0 0>, Size pigment { color red 1 green 0.5 } }\n";
    place.write("a.pov", old);
    place.run("check a.pov").ends(0, &["semicolon", "1 warning"]);
    place.run("check a.pov --legacy").ends(0, &["legacy-form", "rgb <1, 0.5, 0>", "3 warnings"]);
    place.run("check a.pov --legacy --fix").ends(0, &["a.pov: 3 fixes applied"]);
    let new = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#declare Size = 2;\n\
               sphere { <0, 0, 0>, Size pigment { color rgb <1, 0.5, 0> } }\n";
    assert_eq!(String::from_utf8_lossy(&place.read("a.pov")), new);
    assert_eq!(place.run("check a.pov --legacy").ends(0, &[]).stderr(), "a.pov: no messages\n");
}

// ── files that a scene reads and writes ──

const WRITER: &str = "\
#fopen Out \"list.inc\" write
#write (Out, \"#declare Size = \", 1/4, \";\\n\")
#fclose Out
#include \"list.inc\"
camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
sphere { 0, Size pigment { rgb 1 } }
";

#[test]
fn a_scene_writes_only_where_it_is_allowed_to() {
    let place = Place::new();
    place.write("w.scene", WRITER);
    let refused =
        place.run("check w.scene").ends(1, &["forbidden-file", "`--allow-write` allows it"]);
    assert!(refused.stderr().contains("1 error\n"), "{}", refused.stderr());
    place.run("w.scene --size 16x12").ends(1, &["forbidden-file"]);
    assert_eq!(place.names(), ["a.scene", "broken.scene", "w.scene"]);
    for other in ["check", "plan", "show"] {
        let told = "list.inc: 22 bytes, not written: only rendering writes\n";
        place.run(&format!("{other} --allow-write w.scene")).ends(0, &[told]);
        assert_eq!(place.names(), ["a.scene", "broken.scene", "w.scene"]);
    }
    place
        .run("w.scene --allow-write --size 16x12")
        .ends(0, &["list.inc: 22 bytes, by the scene\n", "w.png: 16×12"]);
    assert_eq!(place.read("list.inc"), b"#declare Size = 0.25;\n");
    for name in ["../out.txt", "/tmp/out.txt", "none/../../out.txt"] {
        place.write("o.scene", &format!("#fopen F \"{name}\" write\n{SCENE}"));
        place
            .run("check --allow-write o.scene")
            .ends(1, &["forbidden-file", "the current folder only"]);
    }
}

#[test]
fn a_scene_overwrites_no_part_of_itself() {
    let place = Place::new();
    place.write("part.inc", "#declare Size = 1;\n");
    let write = "#fopen F \"part.inc\" write #write (F, 1) #fclose F\n";
    place.write("w.scene", &format!("#include \"part.inc\"\n{write}sphere {{ 0, Size }}\n"));
    place
        .run("w.scene --allow-write --size 16x12")
        .ends(1, &["`part.inc` is a part of this scene"]);
    assert_eq!(place.read("part.inc"), b"#declare Size = 1;\n");
    place.write("w.scene", "#fopen F \"w.scene\" append\n");
    place.run("w.scene --allow-write --size 16x12").ends(1, &["`w.scene` is this scene itself"]);
    // What it has written itself is its own.
    let reads = "#include \"own.inc\"\n";
    let write = "#fopen F \"own.inc\" write #write (F, \"#declare A = 1;\") #fclose F\n";
    place.write("o.scene", &format!("{write}{reads}{write}{reads}{SCENE}"));
    place.run("o.scene --allow-write --size 16x12").ends(0, &["own.inc: 15 bytes"]);
}

#[test]
fn a_scene_with_errors_writes_nothing() {
    let place = Place::new();
    place.write("list.inc", "old");
    place.write("w.scene", &format!("{WRITER}sphere {{ 0, Nowhere }}\n"));
    let words = ["undeclared-name", "the files that it writes were left as they are"];
    place.run("check --allow-write w.scene").ends(1, &words);
    place.run("w.scene --allow-write --size 16x12").ends(1, &words);
    assert_eq!(place.read("list.inc"), b"old");
}

#[test]
fn what_one_run_wrote_the_next_one_reads_where_it_is_run() {
    let place = Place::new();
    fs::create_dir(place.path("scenes")).expect("a folder");
    let count = "#declare N = 0; #if (file_exists(\"count.txt\")) #fopen F \"count.txt\" read \
                 #read (F, N) #fclose F #end #fopen F \"count.txt\" write #write (F, N + 1) #fclose F\n";
    place.write("scenes/c.scene", &format!("{count}{SCENE}"));
    for run in ["1", "2", "3"] {
        place.run("scenes/c.scene --allow-write --size 8x6").ends(0, &[]);
        assert_eq!(place.read("count.txt"), run.as_bytes());
    }
    assert_eq!(place.names(), ["a.scene", "broken.scene", "c.png", "count.txt", "scenes"]);
}

#[test]
fn check_says_which_file_answered() {
    let place = Place::new();
    place.write("colors.inc", "#declare Red = rgb <1, 0, 0>;\n");
    place.write("i.scene", &format!("#include \"colors.inc\"\n#include \"stdinc.inc\"\n{SCENE}"));
    let said = place.run("check --where i.scene").ends(0, &[]).stdout();
    assert!(said.starts_with("colors.inc: colors.inc\n"), "{said}");
    // POV-Ray's where it is installed, else ours.
    let (installed, embedded) = ("stdinc.inc: /", "stdinc.inc: built in\n");
    assert!(said.contains(installed) || said.contains(embedded), "{said}");
    assert_eq!(place.run("check i.scene").ends(0, &[]).stdout(), "");
    // A picture is a file that answers, too.
    place.write("h.pgm", "P2\n2 2\n255\n0 9 9 0\n");
    let hills = "height_field { pgm \"h.pgm\" pigment { rgb 1 } }";
    place.write("h.scene", &format!("{hills}\n{SCENE}"));
    let said = place.run("check --where h.scene").ends(0, &[]).stdout();
    assert_eq!(said, "h.pgm: h.pgm\n");
}

#[test]
fn the_present_moment_is_known() {
    let place = Place::new();
    place.write("n.scene", &format!("#debug datetime(now, \"%Y\")\n{SCENE}"));
    let year = place.run("check n.scene").ends(0, &[]).stderr();
    assert!(year.trim().parse::<u32>().is_ok_and(|year| year >= 2025), "{year}");
}
