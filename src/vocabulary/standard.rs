//! Lists the includes that ship with POV-Ray, and the names that each declares.

use std::collections::HashMap;
use std::sync::LazyLock;

/// One line per include, without the extension `.inc`: `colors: Aquamarine BakersChoc …`. Names that only
/// record that an include was read are omitted. If several lines have a name, the first is the include to
/// suggest: `stones` and `glass` also have the names of the files they include.
///
/// **Source:** every `#declare` and `#macro` outside of macros in the includes of POV-Ray 3.7; its manual
/// lists them in section 3.4.9 "Include Files".
const TABLE: &str = include_str!("includes.txt");

fn rows() -> impl Iterator<Item = (&'static str, &'static str)> {
    TABLE.lines().filter_map(|line| line.split_once(':'))
}

/// Whether a file with this name ships with POV-Ray.
pub fn is_standard_include(file: &str) -> bool {
    file.strip_suffix(".inc").is_some_and(|name| rows().any(|(include, _)| include == name))
}

/// Whether a text is one of those files, wherever it is located, or lucarne's replacement for one.
pub fn is_standard_source(path: &str) -> bool {
    is_standard_include(path.rsplit(['/', '\\', ':']).next().unwrap_or(path))
}

/// Returns the includes that ship with POV-Ray, without the extension `.inc`.
pub fn standard_includes() -> impl Iterator<Item = &'static str> {
    rows().map(|(include, _)| include)
}

/// Returns the names that an include declares.
pub fn standard_names(file: &str) -> impl Iterator<Item = &'static str> {
    let row = rows().find(|(include, _)| file.strip_suffix(".inc") == Some(*include));
    row.map_or("", |(_, names)| names).split_whitespace()
}

/// Returns the include that declares `name`, as written in `#include`.
pub fn standard_include_of(name: &str) -> Option<String> {
    static INCLUDES: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| {
        let mut all = HashMap::new();
        for (include, names) in rows() {
            for name in names.split_whitespace() {
                all.entry(name).or_insert(include);
            }
        }
        all
    });
    INCLUDES.get(name).map(|include| format!("{include}.inc"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_leads_to_its_include() {
        let include = |name| standard_include_of(name);
        assert_eq!(include("Red").as_deref(), Some("colors.inc"));
        assert_eq!(include("Phong_Shiny").as_deref(), Some("finish.inc"));
        assert_eq!(include("Round_Box").as_deref(), Some("shapes.inc"));
        assert_eq!(include("T_Stone1").as_deref(), Some("stones.inc"));
        assert_eq!(include("red"), None);
        assert_eq!(include("colors:"), None);
    }

    #[test]
    fn an_include_is_known_by_its_whole_name() {
        assert!(is_standard_include("colors.inc") && is_standard_include("stdcam.inc"));
        assert!(!is_standard_include("colors") && !is_standard_include("color.inc"));
    }
}
