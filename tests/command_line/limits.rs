//! Limits on a run: how long it may take, and how much memory.

use std::time::Instant;

use super::*;

/// Never ends, and takes more memory with each turn.
const ENDLESS: &str = "\
#declare A = array[4000000];
#declare I = 0;
#while (1)
  #declare A[mod(I, 4000000)] = array[100];
  #declare A[mod(I, 4000000)][0] = \"text\";
  #declare I = I + 1;
  #if (I < 0) #break #end
#end
camera { location 5*z look_at 0 }
";

const READ: &str = "the scene was being read\n";

#[test]
fn a_scene_that_takes_more_and_more_memory_is_stopped() {
    let place = Place::new();
    place.write("endless.scene", ENDLESS);
    let run = place.run("endless.scene --memory 200M");
    run.ends(4, &["error: more memory is used than 200 MiB (`--memory`): ", READ]);
    let run = place.run("a.scene --size 8x6 --memory 2G").ends(0, &["a.png: 8×6"]);
    assert!(!run.stderr().contains("memory"));
    place.run("a.scene --memory 2").ends(2, &["expected a size with its unit"]);
}

#[test]
fn time_that_is_over_stops_a_loop_of_the_scene_and_names_it() {
    let place = Place::new();
    place.write("turns.scene", "#declare I = 0; #while (I >= 0) #declare I = I + 1; #end");
    let run = place.run("turns.scene --time 100ms");
    run.ends(4, &["interrupted while a loop turned", "error: the limit of 0.1 s (`--time`)", READ]);
    assert!(!place.path("turns.png").exists());
}

#[test]
fn a_picture_whose_time_is_over_goes_on_to_the_same_bytes() {
    let place = Place::new();
    place.write("slow.scene", super::long::SLOW);
    let words = "slow.scene --size 320x240 --antialias off --threads 1";
    let begun = Instant::now();
    place.run(&format!("{words} -o whole.png")).ends(0, &[]);
    let limit = format!("{}ms", begun.elapsed().as_millis() / 3);
    let limited = format!("{words} -o a.png --resume --time {limit}");
    let mut runs = 1;
    while let run = place.run(&limited)
        && run.code() != 0
    {
        run.ends(75, &["(`--time`) is over: the ", "; `--resume` goes on from there"]);
        assert!(place.path("a.png.checkpoint").exists() && runs < 99);
        runs += 1;
    }
    assert!(place.read("a.png") == place.read("whole.png"));
    assert!(!place.path("a.png.checkpoint").exists());
    let run = place.run(&format!("{words} -o b.png --shard 1/2 --time 50ms"));
    run.ends(75, &["b.1-of-2.part is not written; `--resume` goes on from there"]);
}

#[test]
fn an_animation_whose_time_is_over_keeps_its_frames() {
    let place = Place::new();
    let words = "a.scene --size 8x6 --frames 1..999999 --time 1s -o f.png";
    place.run(words).ends(4, &["the limit of 1 s (`--time`) is over: "]);
    assert!(place.path("f000001.png").exists() && !place.path("f999999.png").exists());
    let run = place.run(&words.replace("f.png", "f.gif"));
    run.ends(4, &["is over: in frame ", " of 999999\n"]);
    assert!(!place.path("f.gif").exists());
}
