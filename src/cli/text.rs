//! Reads the main file named on the command line, or standard input, and checks that it can be a scene.

use std::borrow::Cow;
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use lucarne::diagnostic::suggest::closest;
use lucarne::disk::{LARGEST, or_here, reason};
use lucarne::source::{UTF_16, is_utf_16};

use super::exit::{Exit, Failure};

/// Whether the path is `-`, for standard input.
pub fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Returns the name of the main file for messages.
pub fn name_of(path: &Path) -> Cow<'_, str> {
    if is_stdin(path) { "standard input".into() } else { path.to_string_lossy() }
}

/// Whether the file extension is that of an include file.
pub fn is_include(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("inc"))
}

/// Like [`read_main`], but fails for an empty file, which is not a scene.
pub fn read_scene(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = read_main(path)?;
    let text = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&bytes);
    let what = match text {
        [] => "is empty",
        text if text.iter().all(u8::is_ascii_whitespace) => "has nothing but blanks",
        _ => return Ok(bytes),
    };
    let sentence = format!("`{}` {what}: there is no scene in it", name_of(path));
    let failure = Failure { exit: Exit::Scene, ..Failure::file(sentence) };
    Err(match is_stdin(path) {
        true => failure.help("pipe a scene into it, or name a file: `lucarne FILE`"),
        false => failure,
    })
}

/// Reads the main file, which may be a pipe; fails with the reason if it cannot.
pub fn read_main(path: &Path) -> Result<Vec<u8>, Failure> {
    let wrong = |why: &str| Failure::file(format!("cannot read `{}`: {why}", name_of(path)));
    if is_stdin(path) {
        return whole(std::io::stdin().lock(), wrong);
    }
    let file = fs::File::open(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => match near(path) {
            Some(near) => wrong("there is no such file").help(format!("did you mean `{near}`?")),
            None if path.to_string_lossy().starts_with('-') => wrong("there is no such file")
                .help("behind `--` every word is a file name; options go before it"),
            None => wrong("there is no such file"),
        },
        _ => wrong(&reason(&error)),
    })?;
    if file.metadata().is_ok_and(|about| about.is_dir()) {
        return Err(wrong("it is a folder"));
    }
    whole(file, wrong)
}

/// Reads a text that can be a scene.
fn whole(from: impl Read, wrong: impl Fn(&str) -> Failure) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    from.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|error| wrong(&reason(&error)))?;
    if bytes.len() as u64 > LARGEST {
        return Err(wrong("it is larger than 1 GiB"));
    }
    if is_utf_16(&bytes) {
        return Err(wrong(UTF_16).help("save it as UTF-8"));
    }
    if is_binary(&bytes) {
        return Err(wrong("it is not a text").help("a scene is a text file: `.scene`, or `.pov`"));
    }
    Ok(bytes)
}

/// Whether this is a picture, a program or other binary data: text does not have several zero bytes near
/// its start.
fn is_binary(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(4096)];
    start.iter().filter(|byte| **byte == 0).count() > 2
}

/// Returns a similar name in the same folder, or this name with the extension of a scene.
fn near(path: &Path) -> Option<String> {
    if let Some(scene) = as_scene(path) {
        return Some(scene.display().to_string());
    }
    let folder = path.parent()?;
    let names: Vec<String> = fs::read_dir(or_here(folder))
        .ok()?
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    let near = closest(path.file_name()?.to_str()?, names.iter().map(String::as_str))?;
    Some(folder.join(near).display().to_string())
}

/// Returns the scene with this name plus an extension, if it exists.
pub fn as_scene(path: &Path) -> Option<PathBuf> {
    let with = |extension: &str| PathBuf::from(format!("{}.{extension}", path.display()));
    ["scene", "pov"].map(with).into_iter().find(|path| path.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_no_scene() {
        let failure = read_main(Path::new(".")).expect_err("a folder");
        assert!(failure.sentence.ends_with("it is a folder"), "{}", failure.sentence);
    }
}
