//! Which file a name finds, with and without a sandbox.

use super::*;

struct Place {
    root: tempfile::TempDir,
}

impl Place {
    fn new(files: &[&str]) -> Self {
        let root = tempfile::tempdir().expect("a folder");
        for file in files {
            let path = root.path().join(file);
            fs::create_dir_all(path.parent().expect("a parent")).expect("folders");
            fs::write(path, file).expect("written");
        }
        Self { root }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.root.path().join(name)
    }

    fn files(&self, include: &[&str]) -> DiskFiles {
        let include: Vec<PathBuf> = include.iter().map(|name| self.path(name)).collect();
        DiskFiles::new(&self.path("scene/main.scene"), &include)
    }

    fn sandbox(&self, include: &[&str]) -> DiskFiles {
        DiskFiles { sandbox: true, ..self.files(include) }
    }

    fn read(&self, files: &DiskFiles, name: &str) -> Result<String, FileError> {
        let main = self.path("scene/main.scene").display().to_string();
        files.read(name, &main).map(|found| String::from_utf8_lossy(&found.bytes).into_owned())
    }
}

#[test]
fn folders_are_searched_in_order() {
    let place = Place::new(&["scene/a.inc", "one/a.inc", "one/b.inc", "two/b.inc", "two/c.inc"]);
    let files = place.files(&["one", "two"]);
    assert_eq!(place.read(&files, "a.inc").as_deref(), Ok("scene/a.inc"));
    assert_eq!(place.read(&files, "b.inc").as_deref(), Ok("one/b.inc"));
    assert_eq!(place.read(&files, "c.inc").as_deref(), Ok("two/c.inc"));
}

#[test]
fn an_include_finds_its_neighbours_first() {
    let place = Place::new(&["scene/a.inc", "scene/parts/b.inc", "scene/parts/a.inc"]);
    let files = place.files(&[]);
    let found = files.read("a.inc", &place.path("scene/parts/b.inc").display().to_string());
    assert_eq!(found.expect("found").bytes, b"scene/parts/a.inc");
}

#[test]
fn a_name_that_leads_out_is_read_as_any_other() {
    let place = Place::new(&["scene/main.scene", "lib.inc", "far/away.inc", "far/beside.inc"]);
    let files = place.files(&[]);
    assert_eq!(place.read(&files, "../lib.inc").as_deref(), Ok("lib.inc"));
    let absolute = place.path("far/away.inc").display().to_string();
    assert_eq!(place.read(&files, &absolute).as_deref(), Ok("far/away.inc"));
    // Whose neighbours are found from there.
    assert_eq!(files.read("beside.inc", &absolute).expect("found").bytes, b"far/beside.inc");
    let missing = place.read(&files, "../no_such.inc");
    assert!(matches!(missing, Err(FileError::NotFound { .. })), "{missing:?}");
}

#[test]
fn in_a_sandbox_a_name_that_leads_out_is_forbidden() {
    let place = Place::new(&["scene/a.inc", "secret.inc", "scene/parts/b.inc"]);
    let files = place.sandbox(&[]);
    assert_eq!(place.read(&files, "../secret.inc"), Err(FileError::Forbidden));
    assert_eq!(place.read(&files, "../no_such.inc"), Err(FileError::Forbidden));
    assert_eq!(place.read(&files, "parts/../../secret.inc"), Err(FileError::Forbidden));
    assert_eq!(place.read(&files, "/etc/hostname"), Err(FileError::Forbidden));
    assert_eq!(place.read(&files, "parts/../a.inc").as_deref(), Ok("scene/a.inc"));
    let absolute = place.path("scene/a.inc").display().to_string();
    assert_eq!(place.read(&files, &absolute).as_deref(), Ok("scene/a.inc"));
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_out_is_followed_but_in_a_sandbox() {
    use std::os::unix::fs::symlink;
    let place = Place::new(&["scene/a.inc", "other/secret.inc", "other/parts/b.inc"]);
    symlink(place.path("other/secret.inc"), place.path("scene/link.inc")).expect("a link");
    symlink(place.path("scene/a.inc"), place.path("scene/near.inc")).expect("a link");
    symlink(place.path("other/parts"), place.path("scene/parts")).expect("a link");
    let (files, sandbox) = (place.files(&[]), place.sandbox(&[]));
    assert_eq!(place.read(&files, "link.inc").as_deref(), Ok("other/secret.inc"));
    assert_eq!(place.read(&sandbox, "link.inc"), Err(FileError::Forbidden));
    // `..` behind a link leads to where the link does.
    for name in ["parts/../secret.inc", "parts/b.inc"] {
        assert!(place.read(&files, name).is_ok_and(|text| text.starts_with("other/")), "{name}");
        assert!(place.read(&sandbox, name).is_err(), "{name}");
    }
    for files in [files, sandbox] {
        assert_eq!(place.read(&files, "near.inc").as_deref(), Ok("scene/a.inc"));
    }
}

#[test]
fn one_file_has_one_name() {
    let place = Place::new(&["scene/main.scene", "scene/a.inc", "scene/parts/b.inc"]);
    let files = place.files(&["scene"]);
    let main = place.path("scene/main.scene").display().to_string();
    let name = |name: &str| files.read(name, &main).expect("found").name;
    assert_eq!(name("main.scene"), main);
    assert_eq!(name("parts/../a.inc"), name("./a.inc"));
    assert_eq!(name("../scene/a.inc"), name("a.inc"));
    assert_eq!(name(&place.path("one/../scene/a.inc").display().to_string()), name("a.inc"));
}

#[test]
fn a_missing_file_has_the_folders_searched_and_a_near_name() {
    let place = Place::new(&["scene/colours.inc", "one/x.inc"]);
    let files = place.files(&["one"]);
    let Err(FileError::NotFound { searched, similar }) = place.read(&files, "colors.inc2") else {
        panic!("found")
    };
    assert!(searched.len() >= 2);
    assert_eq!(similar[0], "colours.inc");
}

#[test]
fn a_file_that_is_missing_where_it_was_named_is_suggested_where_it_is() {
    let place =
        Place::new(&["scene/main.scene", "one/lib.inc", "parts.inc", "scene/deep/ball.inc"]);
    let files = place.files(&["one"]);
    let similar = |files: &DiskFiles, name: &str| match place.read(files, name) {
        Err(FileError::NotFound { similar, .. }) => similar,
        other => panic!("{name}: {other:?}"),
    };
    for name in ["C:\\POV\\lib.inc", "C:lib.inc", "/no/such/lib.inc", "../lib.inc"] {
        assert_eq!(similar(&files, name), ["lib.inc"], "{name}");
    }
    assert_eq!(similar(&files, "../part.inc"), ["../parts.inc"]);
    assert_eq!(similar(&files, "deep/bal.inc"), ["deep/ball.inc"]);
    assert!(similar(&place.files(&[]), "D:\\lib.inc").is_empty());
}

#[test]
fn a_standard_include_names_the_folders_that_are_not_there_too() {
    let place = Place::new(&["scene/main.scene"]);
    let main = place.path("scene/main.scene");
    let mut files = place.files(&[]);
    files.folders.truncate(1);
    let main = main.display().to_string();
    let searched = |name: &str| match files.read(name, &main) {
        Err(FileError::NotFound { searched, .. }) => searched.join(", "),
        other => panic!("{other:?}"),
    };
    let absent = WELL_KNOWN.iter().filter(|folder| !Path::new(folder).is_dir()).count();
    assert_eq!(searched("colors.inc").matches("(not there)").count(), absent);
    assert!(!searched("mine.inc").contains("(not there)"));
}

#[test]
fn the_page_of_the_language_names_the_well_known_folders() {
    let page = include_str!("../../docs/language.md");
    for folder in WELL_KNOWN {
        assert!(page.contains(&format!("`{folder}`")), "{folder}");
    }
}

#[test]
fn a_folder_is_no_file() {
    let place = Place::new(&["scene/parts/a.inc"]);
    let files = place.files(&[]);
    let wrong = place.read(&files, "parts");
    assert_eq!(wrong, Err(FileError::Unreadable("it is a folder".to_owned())));
}
