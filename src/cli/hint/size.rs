//! Recognizes sizes in pixels that are not written as `--size 320x240`.
//!
//! **In:** the words of the command line. **Out:** the intended size. If only one side is given, the other
//! one makes the picture 4:3.

/// The words that specify a size, as typed, and the size they mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Meant {
    pub typed: String,
    pub width: u32,
    pub height: u32,
}

/// Whether an unknown option specifies a size: `--width`, `-w`, `+H240`.
pub fn is_size(word: &str) -> bool {
    matches!(word, "--width" | "--height") || switch(word).is_some()
}

/// Whether `--size` is followed by width and height as two words.
pub fn is_parted(words: &[String]) -> bool {
    let is_number = |word: &String| word.parse::<u32>().is_ok();
    words.windows(3).any(|three| three[0] == "--size" && three[1..].iter().all(is_number))
}

/// Returns the size specified by the words before `--`, if any.
pub fn meant(words: &[String]) -> Option<Meant> {
    let (mut typed, mut width, mut height) = (Vec::new(), None, None);
    let mut rest = words.split(|word| word == "--").next()?;
    while let [word, behind @ ..] = rest {
        rest = behind;
        let (name, value) = match (word.split_once('='), switch(word)) {
            (_, Some((side, ""))) => (side, None),
            (_, Some((side, value))) => (side, Some(value)),
            (Some((name, value)), _) => (name, Some(value)),
            (None, _) => (word.as_str(), None),
        };
        if !["--size", "--width", "--height"].contains(&name) {
            continue;
        }
        typed.push(word.as_str());
        let value = match (value, rest) {
            (Some(value), _) => value,
            (None, [value, behind @ ..]) => {
                rest = behind;
                typed.push(value);
                value
            }
            (None, []) => return None,
        };
        match (name, value.parse().ok(), rest.first().and_then(|next| next.parse().ok())) {
            ("--width", side, _) => width = side,
            ("--height", side, _) => height = side,
            (_, Some(first), Some(second)) => {
                (width, height) = (Some(first), Some(second));
                typed.extend(rest.first().map(String::as_str));
            }
            (_, first @ Some(_), None) => width = first,
            (_, None, _) => (width, height) = sides(value)?,
        }
    }
    let of = |side: u32, part: u64, of: u64| u32::try_from((u64::from(side) * part + of / 2) / of);
    let (width, height) = match (width, height) {
        (Some(width), Some(height)) => (width, height),
        (Some(width), None) => (width, of(width, 3, 4).ok()?),
        (None, Some(height)) => (of(height, 4, 3).ok()?, height),
        (None, None) => return None,
    };
    let is_side = |side: u32| (1..=1_000_000).contains(&side);
    (is_side(width) && is_side(height)).then(|| Meant { typed: typed.join(" "), width, height })
}

/// Parses `+W320`, `-w` and similar switches into the side and the attached number.
fn switch(word: &str) -> Option<(&'static str, &str)> {
    let word = word.strip_prefix(['+', '-'])?;
    let side = match word.get(..1)? {
        "w" | "W" => "--width",
        "h" | "H" => "--height",
        _ => return None,
    };
    let value = word[1..].trim_start_matches('=');
    value.bytes().all(|byte| byte.is_ascii_digit()).then_some((side, value))
}

/// Parses `320*240`, `320, 240` or `320 240`; `320x` is a width.
fn sides(value: &str) -> Option<(Option<u32>, Option<u32>)> {
    let value = value.trim();
    let behind = value.trim_start_matches(|c: char| c.is_ascii_digit());
    let first = &value[..value.len() - behind.len()];
    let second = behind.trim_start_matches([' ', 'x', 'X', '×', '*', ',', ';', ':', '/']);
    match second {
        "" => Some((Some(first.parse().ok()?), None)),
        _ if second == behind => None,
        _ => Some((Some(first.parse().ok()?), Some(second.parse().ok()?))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(words: &str) -> Option<(u32, u32)> {
        let words: Vec<String> = words.split(' ').map(|word| word.replace('_', " ")).collect();
        meant(&words).map(|meant| (meant.width, meant.height))
    }

    #[test]
    fn a_size_is_known_in_every_form() {
        for words in [
            "--width 320 --height 200",
            "--width=320 a.scene --height=200",
            "-w 320 -h 200",
            "+W320 +H200",
            "-w320 -H200",
            "-w=320 --height 200",
            "--size 320*200",
            "--size=320,200",
            "--size 320,_200",
            "--size 320_200",
            "--size 320_x_200",
            "--size 320:200",
            "--size 320×200",
            "--size 320 200",
            "--size 320 --height 200",
        ] {
            assert_eq!(size(words), Some((320, 200)), "{words}");
        }
    }

    #[test]
    fn where_one_side_is_given_the_picture_is_4_to_3() {
        for words in ["--width 320", "--height 240", "-w320", "+H240", "--size 320", "--size 320x"]
        {
            assert_eq!(size(words), Some((320, 240)), "{words}");
        }
        assert_eq!(size("--width 1"), Some((1, 1)));
    }

    #[test]
    fn what_is_no_size_means_none() {
        for words in [
            "--size big",
            "--size 0x5",
            "--size -1x5",
            "--size 1e3x3",
            "--size 2000000x1",
            "--width",
            "--width wide",
            "-w",
            "--width 0",
            "-- --width 320",
            "a.scene 320",
        ] {
            assert_eq!(size(words), None, "{words}");
        }
        let words = ["--size", "320", "200"].map(str::to_owned);
        assert!(is_parted(&words) && !is_parted(&words[..2]));
        assert!(is_size("-w") && is_size("+H240") && is_size("--width"));
        assert!(!is_size("--wide") && !is_size("+wt4") && !is_size("-") && !is_size("w320"));
    }
}
