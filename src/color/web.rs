//! Colours as the web writes them: `#ff8000`, `#f80`.

use super::{Rgb, srgb_decode};

/// The linear colour of `#` and three or six hexadecimal digits, to four decimals.
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
        let value = if width == 1 { value * 17 } else { value };
        format!("{:.4}", srgb_decode(f64::from(value) / 255.0)).parse().ok()
    };
    Some(Rgb::new(component(0)?, component(1)?, component(2)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_the_web_are_on_a_displays_curve() {
        assert_eq!(web("#ff0000"), Some(Rgb::new(1.0, 0.0, 0.0)));
        assert_eq!(web("#0F8"), web("#00ff88"));
        assert_eq!(web("#808080"), Some(Rgb::gray(0.2159)));
        for wrong in ["ff0000", "#ff000", "#gg0000", "#", "#é", "#-10101"] {
            assert_eq!(web(wrong), None, "{wrong}");
        }
    }
}
