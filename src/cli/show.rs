//! `lucarne show`: prints a scene at one stage of compilation.

use lucarne::plan;
use lucarne::road::Road;
use lucarne::{scene, syntax, world};

use super::arguments::{PictureArguments, ShowArguments, Stage};
use super::exit::{Exit, Failure, Outcome};
use super::files;
use super::messages;
use super::scene::SceneArguments;
use super::text::{name_of, read_scene};

pub fn run(arguments: &ShowArguments) -> Outcome {
    show(&arguments.file, arguments.stage, &arguments.picture, &arguments.scene)
}

/// Prints one stage. For a scene with errors, prints what was compiled of it.
pub fn show(
    path: &std::path::Path,
    stage: Stage,
    picture: &PictureArguments,
    arguments: &SceneArguments,
) -> Outcome {
    let frame = picture.frame(arguments)?;
    let bytes = read_scene(path)?;
    let files = files::of(path, arguments);
    let dialect = arguments.dialect(path, &bytes);
    let mut road = Road::new(&files, arguments.options(dialect, Some(frame)));
    let file = road.read(&name_of(path), bytes);
    let ast = road.parse(file);
    let text = if stage == Stage::Ast {
        syntax::dump(&ast, road.sources.get(file))
    } else {
        let scene = road.evaluate(ast);
        if stage == Stage::Scene {
            scene::print::dump(&scene, &road.sources)
        } else {
            let (world, origins) = road.lower(scene);
            match stage {
                Stage::Plan => {
                    let options = picture.options(frame);
                    plan::print::dump(&plan::plan(&world, &origins, &options), &road.sources)
                }
                Stage::Ast | Stage::Scene | Stage::World => {
                    world::print::dump(&world, &origins, &road.sources)
                }
            }
        }
    };
    let mut messages = arguments.messages();
    // Standard output is reserved for the stage.
    messages.picture_on_stdout = true;
    messages.print(road.diagnostics.in_text_order().into_iter(), &road.sources)?;
    messages.summarize();
    files::announce(&files, messages.exit() == Exit::Done)?;
    messages::print(&text)?;
    Ok::<Exit, Failure>(messages.exit())
}
