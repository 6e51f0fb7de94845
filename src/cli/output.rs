//! Writes pictures to files or to standard output.
//!
//! **Invariant:** everything that can be checked before rendering is checked then: the format, and whether
//! the destination is writable. A file is written under a temporary name and renamed, so that it is
//! complete or absent, and keeps its permissions. A file the scene was read from is never overwritten. If a
//! picture cannot be written to its destination, it is saved elsewhere.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use lucarne::disk::reason;
use lucarne::film::Depth;
use lucarne::picture::{Format, is_picture};
use lucarne::plan::Region;
use lucarne::source::Sources;

use super::exit::Failure;
use super::messages;
use super::text::is_stdin;

/// Writes the bytes of a picture.
pub type Picture<'a> = &'a dyn Fn(&mut dyn Write) -> io::Result<()>;

/// Destination of one picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    Stdout,
    File { path: PathBuf, format: Format },
}

impl Output {
    /// Returns the destination for `OUT` as typed; by default, the scene's name with `.png` in the current
    /// folder.
    pub fn from_arguments(scene: &Path, out: Option<&Path>) -> Result<Self, Failure> {
        let Some(out) = out else {
            let stem = scene.file_stem().filter(|_| !is_stdin(scene));
            let mut path = stem.unwrap_or("picture".as_ref()).to_owned();
            path.push(".png");
            let path = PathBuf::from(path);
            return Ok(Self::File { path, format: Format::Png });
        };
        if out == Path::new("-") {
            return Ok(Self::Stdout);
        }
        if out.is_dir() {
            let sentence = format!("cannot write `{}`: it is a folder", out.display());
            return Err(Failure::file(sentence));
        }
        let extension = out.extension().map(|e| e.to_string_lossy().into_owned());
        let format = extension.as_deref().and_then(Format::from_extension).ok_or_else(|| {
            let known = Format::ALL.iter().flat_map(|format| format.extensions());
            let known: Vec<String> = known.map(|e| format!(".{e}")).collect();
            let sentence = match &extension {
                Some(extension) => format!("`.{extension}` is no format that can be written"),
                None => format!("`{}` has no extension to tell the format by", out.display()),
            };
            Failure::usage(sentence).help(format!("use one of {}", known.join(" ")))
        })?;
        Ok(Self::File { path: out.to_owned(), format })
    }

    pub fn format(&self) -> Format {
        match self {
            Self::Stdout => Format::Png,
            Self::File { format, .. } => *format,
        }
    }

    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Stdout => None,
            Self::File { path, .. } => Some(path),
        }
    }

    /// Returns the name of the destination for messages.
    pub fn name(&self) -> String {
        match self {
            Self::Stdout => "standard output".to_owned(),
            Self::File { path, .. } => path.display().to_string(),
        }
    }

    /// Returns the destination of an interrupted picture: `OUT.partial.EXT`.
    pub fn partial(&self) -> Option<Self> {
        match self {
            Self::Stdout => None,
            Self::File { path, format } => {
                let extension = path.extension().unwrap_or_default().to_string_lossy();
                let path = path.with_extension(format!("partial.{extension}"));
                Some(Self::File { path, format: *format })
            }
        }
    }

    /// Fails if it is known before rendering that the picture cannot or should not be written. With
    /// `force`, files that are not pictures or are write-protected may be overwritten.
    pub fn check(&self, part: Region, depth: Depth, force: bool) -> Result<(), Failure> {
        let (width, height) = (part.width, part.height);
        if let Some(sentence) = self.format().too_large(width, height) {
            let help = "the other formats hold more; `--region` renders a part";
            return Err(Failure::usage(sentence).help(help));
        }
        let Self::File { path, format } = self else { return Ok(()) };
        // Opening a pipe would block until its other end is opened.
        can_be_made(path).map_err(|failure| match path.exists() {
            true => failure.help("`-o -` writes a PNG to standard output"),
            false => failure,
        })?;
        if let Ok(file) = fs::File::open(path) {
            let mut start = Vec::new();
            let read = file.take(64).read_to_end(&mut start);
            if read.is_ok() && !start.is_empty() && !is_picture(&start) && !force {
                let sentence =
                    format!("`{}` exists and is not a picture: not overwritten", path.display());
                return Err(Failure::file(sentence).help("`--force` overwrites it"));
            }
        }
        if is_protected(path) && !force {
            let sentence = format!("`{}` is write-protected: not overwritten", path.display());
            return Err(Failure::file(sentence).help("`--force` overwrites it"));
        }
        match free_bytes(folder(path)) {
            Some(free) if free < format.least_bytes(depth, width, height) => {
                Err(cannot(path, "the disk is full"))
            }
            _ => Ok(()),
        }
    }

    /// Fails if the picture would overwrite a file that the scene was read from, or another one that it reads.
    pub fn keeps(&self, sources: &Sources, others: &BTreeSet<String>) -> Result<(), Failure> {
        let Self::File { path, .. } = self else { return Ok(()) };
        let Ok(truth) = fs::canonicalize(path) else { return Ok(()) };
        let is = |name: &str| fs::canonicalize(name).is_ok_and(|other| other == truth);
        let texts = sources.iter().map(|(_, source)| source.name.as_str());
        match texts.chain(others.iter().map(String::as_str)).any(is) {
            true => Err(Failure::file(format!(
                "`{}` is a part of the scene: not overwritten",
                path.display()
            ))),
            false => Ok(()),
        }
    }

    /// Writes the picture.
    pub fn write(&self, picture: Picture) -> Result<(), Failure> {
        match self {
            Self::Stdout => messages::print_with(picture),
            Self::File { path, .. } => write_with(path, picture),
        }
    }

    /// Saves a picture that could not be written to `place`: under the name of a partial picture or,
    /// failing that, in the temporary folder. Returns `failure`, extended by the path of the saved picture.
    pub fn rescue(&self, place: &Self, picture: Picture, failure: Failure) -> Failure {
        let beside = self.partial().filter(|partial| partial != place);
        let kept = match beside.filter(|beside| beside.write(picture).is_ok()) {
            Some(beside) => Ok(beside.name()),
            None => self.keep_in(&std::env::temp_dir(), picture),
        };
        match kept {
            Ok(name) => failure.help(format!("the picture is not lost: it is in `{name}`")),
            Err(why) => failure.help(format!("the picture is lost: {}", why.sentence)),
        }
    }

    /// Writes the picture to a new file in a folder that may be shared with other users; returns its name.
    fn keep_in(&self, folder: &Path, picture: Picture) -> Result<String, Failure> {
        let (stem, extension) = match self {
            Self::Stdout => ("picture".as_ref(), "png".as_ref()),
            Self::File { path, .. } => {
                (path.file_stem().unwrap_or_default(), path.extension().unwrap_or_default())
            }
        };
        let prefix = format!("{}.partial-", stem.display());
        let suffix = format!(".{}", extension.display());
        let failed = |error: io::Error| cannot(folder, &reason(&error));
        let mut file = tempfile::Builder::new()
            .prefix(&prefix)
            .suffix(&suffix)
            .tempfile_in(folder)
            .map_err(failed)?;
        written(&mut file, picture).map_err(failed)?;
        let (_, path) = file.keep().map_err(|error| failed(error.error))?;
        Ok(path.display().to_string())
    }
}

/// Returns the numbers that a component has in a picture file. Fails if the format has no so many bits, or no alpha.
pub fn depth_of(format: Format, bits: Option<u8>, alpha: bool) -> Result<Depth, Failure> {
    let name = format.extensions()[0];
    if alpha && !format.holds_alpha() {
        return Err(Failure::usage(format!("a .{name} picture cannot have an alpha channel"))
            .help("with `--alpha`, write a .png, .qoi, .tga, .bmp or .exr"));
    }
    format.depth(bits).ok_or_else(|| {
        let bits = bits.unwrap_or_default();
        Failure::usage(format!("a .{name} picture cannot have {bits} bits a channel"))
            .help("`--bits` may be 8 (png, jpg, ppm, qoi, tga, bmp) or 16 (png, ppm)")
    })
}

/// Whether the file is write-protected, for everyone or for the current user.
fn is_protected(path: &Path) -> bool {
    let denied = || {
        let opened = fs::OpenOptions::new().append(true).open(path);
        opened.is_err_and(|error| error.kind() == ErrorKind::PermissionDenied)
    };
    fs::metadata(path).is_ok_and(|about| about.permissions().readonly()) || denied()
}

/// Fails if no file can be created at this path, or if something other than a file exists there.
pub fn can_be_made(path: &Path) -> Result<(), Failure> {
    if fs::metadata(path).is_ok_and(|about| !about.is_file()) {
        return Err(cannot(path, "it is not a file"));
    }
    // Creating a file is the only reliable test.
    temporary(path).map(drop)
}

/// Overwrites a source file with its new text, unless it is write-protected.
pub fn write_over(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    match is_protected(file) {
        true => {
            Err(Failure::file(format!("`{}` is write-protected: not overwritten", file.display())))
        }
        false => write_whole(file, bytes),
    }
}

/// Writes a file atomically and keeps its permissions.
pub fn write_whole(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_with(file, &|out| out.write_all(bytes))
}

/// Writes a file like [`write_whole`], piece by piece.
pub fn write_with(file: &Path, content: Picture) -> Result<(), Failure> {
    replaced(file, content, |_| ()).map(drop)
}

/// Writes a file like [`write_with`], and returns it open. `before` is called with it before it has its name.
pub fn replaced(
    file: &Path,
    content: Picture,
    before: impl FnOnce(&fs::File),
) -> Result<fs::File, Failure> {
    let failed = |error: io::Error| cannot(file, &reason(&error));
    // Keeps a link and replaces its target.
    let path = &fs::canonicalize(file).unwrap_or(file.to_owned());
    let mut beside = temporary(path)?;
    written(&mut beside, content).map_err(failed)?;
    if let Ok(about) = fs::metadata(path) {
        beside.as_file().set_permissions(about.permissions()).map_err(failed)?;
    }
    before(beside.as_file());
    beside.persist(path).map_err(|error| failed(error.error))
}

fn written(out: &mut dyn Write, content: Picture) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    content(&mut out)?;
    out.flush()
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

pub fn cannot(path: &Path, why: &str) -> Failure {
    Failure::file(format!("cannot write `{}`: {why}", path.display()))
}

/// Creates a temporary file in the folder of `path`; it is deleted unless renamed.
pub fn temporary(path: &Path) -> Result<tempfile::NamedTempFile, Failure> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lucarne-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Default permissions of new files; the system applies the umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder(path)).map_err(|error| {
        let folder = folder(path);
        match folder.is_dir() {
            true => cannot(path, &reason(&error)),
            false => cannot(path, &format!("there is no folder `{}`", folder.display())),
        }
    })
}

#[cfg(unix)]
fn free_bytes(folder: &Path) -> Option<u64> {
    let about = nix::sys::statvfs::statvfs(folder).ok()?;
    // The count has 32 bits on some systems.
    #[allow(clippy::useless_conversion)]
    let blocks = u64::from(about.blocks_available());
    Some(blocks.saturating_mul(about.fragment_size() as u64))
}

#[cfg(not(unix))]
fn free_bytes(_: &Path) -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXEL: Region = Region { x: 0, y: 0, width: 1, height: 1 };

    #[test]
    fn the_default_is_the_scenes_name_where_it_was_run() {
        let output = Output::from_arguments(Path::new("scenes/gallery/first.scene"), None);
        let path = PathBuf::from("first.png");
        assert_eq!(output.expect("a place"), Output::File { path, format: Format::Png });
    }

    #[test]
    fn the_extension_chooses_the_format() {
        let format = |out: &str| {
            Output::from_arguments(Path::new("a.scene"), Some(Path::new(out)))
                .map(|output| output.format())
                .map_err(|failure| failure.exit)
        };
        assert_eq!(format("a.EXR"), Ok(Format::Exr));
        assert_eq!(format("-"), Ok(Format::Png));
        assert_eq!(format("a.gif"), Err(super::super::exit::Exit::Usage));
        assert_eq!(format("a"), Err(super::super::exit::Exit::Usage));
    }

    #[test]
    fn a_partial_picture_keeps_its_extension() {
        let output = Output::File { path: "b/a.png".into(), format: Format::Png };
        assert_eq!(output.partial().map(|partial| partial.name()), Some("b/a.partial.png".into()));
        assert_eq!(Output::Stdout.partial(), None);
    }

    #[test]
    fn only_pictures_are_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.ppm");
        let output = Output::File { path: path.clone(), format: Format::Ppm };
        assert!(output.check(PIXEL, Depth::Eight, false).is_ok());
        fs::write(&path, "my notes").expect("written");
        assert!(output.check(PIXEL, Depth::Eight, false).is_err());
        assert!(output.check(PIXEL, Depth::Eight, true).is_ok());
        fs::write(&path, "P6\n1 1\n255\nabc").expect("written");
        assert!(output.check(PIXEL, Depth::Eight, false).is_ok());
        output.write(&|out| out.write_all(b"P6\n1 1\n255\ndef")).expect("written");
        assert_eq!(fs::read(&path).expect("read"), b"P6\n1 1\n255\ndef");
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1);
    }

    #[test]
    fn a_picture_that_cannot_be_written_is_kept_elsewhere() {
        let folder = tempfile::tempdir().expect("a folder");
        let picture: Picture = &|out| out.write_all(b"picture");
        let rescued = |output: &Output| {
            let failure = output.write(picture).expect_err("no place");
            let help = output.rescue(output, picture, failure).help.expect("a place");
            let (_, path) = help.split_once("it is in `").expect("kept");
            PathBuf::from(path.trim_end_matches('`'))
        };
        // A folder took its place meanwhile.
        let path = folder.path().join("a.png");
        fs::create_dir_all(path.join("inside")).expect("a folder");
        let kept = rescued(&Output::File { path, format: Format::Png });
        assert_eq!(kept, folder.path().join("a.partial.png"));
        assert_eq!(fs::read(kept).expect("read"), b"picture");
        // The folder is gone.
        let path = folder.path().join("none/b.exr");
        let output = Output::File { path, format: Format::Exr };
        let kept = rescued(&output);
        let name = kept.file_name().expect("a name").to_string_lossy().into_owned();
        assert!(name.starts_with("b.partial-") && name.ends_with(".exr"), "{name}");
        assert_eq!(fs::read(&kept).expect("read"), b"picture");
        fs::remove_file(kept).expect("removed");
        // There is no place at all.
        assert!(output.keep_in(&folder.path().join("none"), picture).is_err());
    }

    #[test]
    fn a_place_that_cannot_be_written_is_known_before() {
        let output = Output::File { path: "/no/such/folder/a.png".into(), format: Format::Png };
        let failure = output.check(PIXEL, Depth::Eight, false).expect_err("no folder");
        assert!(failure.sentence.contains("there is no folder `/no/such/folder`"));
    }
}
