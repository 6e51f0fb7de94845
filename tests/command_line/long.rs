//! Long renders and far ones: checkpoints, and parts that are merged.

use std::time::{Duration, Instant};

use super::*;

/// A scene that takes about a second in small, on one thread.
pub(super) const SLOW: &str = "\
camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 area_light 2*x, 2*z, 5, 5 jitter }
#for (I, 0, 40)
  sphere { <sin(I), cos(I * 2), sin(I * 3)> * 2, 0.4 pigment { rgb <1, 0.8, 0.6> transmit 0.5 } interior { ior 1.5 } finish { reflection 0.3 } }
#end
plane { y, -3 pigment { checker rgb 1 rgb 0.2 } }
";

const WORDS: &str = "slow.scene --size 160x120 --threads 1 -o a.png";

fn place() -> Place {
    let place = Place::new();
    place.write("slow.scene", SLOW);
    place
}

/// Kills a render as soon as there is a checkpoint and some time is over; returns whether it was still running.
fn killed(place: &Place, words: &str, after: Duration) -> bool {
    let mut run = place.command(words).stderr(Stdio::null()).spawn().expect("runs");
    let begun = Instant::now();
    let checkpoint = place.path("a.png.checkpoint");
    while run.try_wait().expect("asked").is_none() {
        if checkpoint.exists() && begun.elapsed() > after {
            run.kill().expect("killed");
            run.wait().expect("ended");
            return true;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    false
}

#[test]
fn a_render_that_is_killed_goes_on_to_the_same_bytes() {
    let place = place();
    let begun = Instant::now();
    place.run(WORDS).ends(0, &[]);
    let whole = begun.elapsed();
    let expected = place.read("a.png");
    let times = if std::env::var_os("LUCARNE_LONG").is_some() { 10 } else { 4 };
    let mut kills = 0;
    for time in 0..times {
        fs::remove_file(place.path("a.png")).expect("there");
        let words = format!("{WORDS} --resume --checkpoint 10ms");
        // Several times in one picture, at other times in each.
        while killed(&place, &words, whole * (time + 1) / (2 * times + 2)) {
            kills += 1;
            if kills % 5 == 4 {
                break;
            }
        }
        place.run(&format!("{WORDS} --resume")).ends(0, &[]);
        assert!(place.read("a.png") == expected);
        assert!(!place.path("a.png.checkpoint").exists());
    }
    assert!(kills >= times, "{kills}");
}

#[test]
fn a_checkpoint_of_another_scene_or_of_other_options_is_refused() {
    let place = place();
    let slow = format!("{WORDS} --checkpoint 10ms");
    assert!(killed(&place, &slow, Duration::ZERO));
    let resume = format!("{WORDS} --resume");
    let other =
        ["cannot go on from `a.png.checkpoint`: it is of another scene, or of other options"];
    place.run(&format!("{resume} --depth 3")).ends(3, &other);
    place.write("slow.scene", &SLOW.replace("40", "41"));
    place.run(&resume).ends(3, &other);
    place.write("slow.scene", SLOW);
    place.run("merge a.png.checkpoint -o b.png").ends(75, &["it is a checkpoint"]);
    let bytes = place.read("a.png.checkpoint");
    fs::write(place.path("a.png.checkpoint"), &bytes[..bytes.len() / 2]).expect("written");
    place.run(&resume).ends(3, &["it is incomplete or was changed"]);
    fs::write(place.path("a.png.checkpoint"), bytes).expect("written");
    place.run(&resume).ends(0, &["a.png: 160×120"]);
}

#[test]
fn a_checkpoint_of_a_render_that_runs_is_left_to_it() {
    let place = place();
    let long = WORDS.replace("160x120", "800x600");
    let mut first = place.command(&format!("{long} --checkpoint 10ms"));
    let mut first = first.stderr(Stdio::null()).spawn().expect("runs");
    while !place.path("a.png.checkpoint").exists() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let running = "another render of this picture is running";
    let run = place.run(&format!("{long} --resume"));
    run.ends(75, &["cannot go on from `a.png.checkpoint`: ", running]);
    // Another picture of the same name is rendered, and saves and removes nothing else.
    let other = place.run(&format!("{WORDS} --checkpoint 10ms"));
    other.ends(0, &["note: no checkpoint: cannot write `a.png.checkpoint`: ", running, "160×120"]);
    assert!(first.try_wait().expect("asked").is_none() && place.path("a.png.checkpoint").exists());
    first.kill().expect("killed");
    first.wait().expect("ended");
    // The lock ended with its process.
    place.run(&format!("{WORDS} --resume")).ends(3, &["of another scene, or of other options"]);
    place
        .run(&format!("{long} --resume --time 100ms"))
        .ends(75, &["`--resume` goes on from there"]);
    place.run("a.scene --size 8x6 -o a.png").ends(0, &["a.png: 8×6"]);
    assert!(!place.path("a.png.checkpoint").exists());
}

#[test]
fn merged_parts_are_the_picture() {
    let place = place();
    for (words, name) in [
        ("--size 40x31", "a.png"),
        ("--size 40x31 --alpha --antialias off", "b.exr"),
        ("--size 40x31 --region 5,3,20,17 --antialias 2", "c.ppm"),
    ] {
        let stem = &name[..1];
        place.run(&format!("slow.scene {words} -o {name}")).ends(0, &[]);
        let expected = place.read(name);
        fs::remove_file(place.path(name)).expect("there");
        for part in [3, 1, 2] {
            let told = format!("{stem}.{part}-of-3.part: rows ");
            place.run(&format!("slow.scene {words} -o {name} --shard {part}/3")).ends(0, &[&told]);
        }
        let parts = |list: &[u32]| -> String {
            list.iter().map(|part| format!("{stem}.{part}-of-3.part ")).collect()
        };
        place.run(&format!("merge {}-o {name}", parts(&[1, 3]))).ends(75, &["parts are missing: "]);
        place.run(&format!("merge {}-o {name}", parts(&[2, 1, 3]))).ends(0, &["of 3 parts"]);
        assert!(place.read(name) == expected, "{name}");
    }
    // Parts of two pictures, and half a part.
    let run = place.run("merge a.1-of-3.part b.2-of-3.part -o d.png");
    run.ends(3, &["cannot merge `b.2-of-3.part`: it is of another picture"]);
    let bytes = place.read("a.2-of-3.part");
    fs::write(place.path("a.2-of-3.part"), &bytes[..bytes.len() - 9]).expect("written");
    let run = place.run("merge a.1-of-3.part a.2-of-3.part a.3-of-3.part -o d.png");
    run.ends(75, &["it is incomplete or was changed"]);
    place.run("merge a.scene -o d.png").ends(3, &["it is not a film"]);
    place.run("merge none.part -o d.png").ends(75, &["no such file"]);
    place.run("slow.scene --size 40x3 --shard 1/4").ends(2, &["3 rows cannot be divided"]);
    assert!(!place.path("d.png").exists());
}

#[test]
fn parts_of_a_scene_that_asks_for_the_time_are_not_mixed() {
    let place = Place::new();
    place.write("now.scene", &SCENE.replace("<1, 0, 0>", "<mod(now, 1), 0, 0>"));
    for part in [1, 2] {
        place.run(&format!("now.scene --size 8x6 -o a.png --shard {part}/2")).ends(0, &[]);
    }
    let run = place.run("merge a.1-of-2.part a.2-of-2.part -o a.png");
    run.ends(3, &["it is of another picture"]);
    place.run("a.scene --shard 1/2 -o -").ends(2, &["a part cannot be written to standard output"]);
}

#[test]
fn parts_of_an_animation_are_some_of_its_frames() {
    let place = Place::new();
    for (part, names) in [("1/2", ["f1.png", "f3.png"]), ("2/2", ["f2.png", "f4.png"])] {
        place
            .run(&format!("a.scene --size 8x6 --frames 1..4 --shard {part} -o f.png"))
            .ends(0, &[]);
        names.iter().for_each(|name| assert!(place.path(name).exists(), "{part} {name}"));
    }
    let run = place.run("a.scene --size 8x6 --frames 1..4 --shard 1/2 -o f.gif");
    run.ends(2, &["numbered pictures, not one file"]);
}
