//! Colours in web notation: `#ff8000`, `#f80`.

use super::Rgb;

/// Parses `#` with three or six hexadecimal digits; returns display values, 0 to 1.
pub fn web(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#')?;
    let width = match digits.len() {
        3 => 1,
        6 => 2,
        _ => return None,
    };
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let component = |i: usize| {
        let value = u8::from_str_radix(digits.get(i * width..(i + 1) * width)?, 16).ok()?;
        Some(f64::from(if width == 1 { value * 17 } else { value }) / 255.0)
    };
    Some(Rgb::new(component(0)?, component(1)?, component(2)?))
}

/// Formats a colour as an author would write it: to four decimals, a grey as one number.
pub fn rounded(color: Rgb) -> String {
    let rounded = color.map(|c| format!("{c:.4}").parse().unwrap_or(c));
    match rounded.red == rounded.green && rounded.red == rounded.blue {
        true => rounded.red.to_string(),
        false => rounded.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_the_web_are_what_a_display_shows() {
        assert_eq!(web("#ff0000"), Some(Rgb::new(1.0, 0.0, 0.0)));
        assert_eq!(web("#0F8"), web("#00ff88"));
        assert_eq!(web("#808080").map(rounded).as_deref(), Some("0.502"));
        assert_eq!(web("#ff8000").map(rounded).as_deref(), Some("<1, 0.502, 0>"));
        for wrong in ["ff0000", "#ff000", "#gg0000", "#", "#é", "#-10101"] {
            assert_eq!(web(wrong), None, "{wrong}");
        }
    }
}
