//! One case a file: a source, and every noun it becomes, and what is said of it.
//!
//! The cases are `tests/cases/*.scene`; `cargo insta review` shows what changed.

use lucarne::diagnostic::render::{Style, human};
use lucarne::plan::{Antialias, Frame, PlanOptions, Samples, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;

const PLAN: PlanOptions = PlanOptions {
    frame: Frame {
        width: 64,
        height: 48,
        region: lucarne::plan::Region { x: 0, y: 0, width: 64, height: 48 },
    },
    antialias: Antialias::Off,
    depth: None,
    adc_bailout: None,
    root_tolerance: 0.0,
    julia_iterations: None,
    light_samples: Samples::Scene,
    blur_samples: Samples::Scene,
    alpha: false,
};

fn stages(name: &str, text: &str) -> String {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
    let file = road.read(name, text.as_bytes().to_vec());
    let ast = road.parse(file);
    let ast_text = lucarne::syntax::dump(&ast, road.sources.get(file));
    let scene = road.evaluate(ast);
    let scene_text = lucarne::scene::print::dump(&scene, &road.sources);
    let (world, origins) = road.lower(scene);
    let plan = plan(&world, &origins, &PLAN);
    let messages: String = road
        .diagnostics
        .iter()
        .map(|message| human(message, &road.sources, Style::PLAIN))
        .collect();
    let sections = [
        ("source", text.to_owned()),
        ("ast", ast_text),
        ("scene", scene_text),
        ("world", lucarne::world::print::dump(&world, &origins, &road.sources)),
        ("plan", lucarne::plan::print::dump(&plan, &road.sources)),
        ("messages", messages),
    ];
    sections.iter().map(|(title, text)| format!("──── {title}\n{}\n", text.trim_end())).collect()
}

#[test]
fn every_case_becomes_what_its_snapshot_says() {
    insta::glob!("cases/*.scene", |path| {
        let text = std::fs::read_to_string(path).expect("readable");
        let name = path.file_name().expect("a name").to_string_lossy();
        insta::assert_snapshot!(stages(&name, &text));
    });
}
