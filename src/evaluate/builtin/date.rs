//! `datetime`: formats a day, counted from the year 2000, as text.
//!
//! **Domain:** the years 1400 to 9999 of the Gregorian calendar, in UTC, rounded to the nearest second. Names
//! of days and months are English on every machine. **Invariant:** an unknown conversion code is copied
//! unchanged.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.3.1.9.4 "String Functions"; codes as in C's `strftime`.
//! Calendar: H. Hinnant, "chrono-Compatible Low-Level Date Algorithms".

use std::fmt::Write;

use super::{Arguments, CallError, CallErrorKind, Function};
use crate::vocabulary::Word;

/// Returns the function that `word` names, if it is in this family.
pub(super) fn function(word: Word) -> Option<Function> {
    match word {
        Word::Datetime => Function::string(1..=2, datetime),
        _ => None,
    }
}

fn datetime(a: &Arguments) -> Result<String, CallError> {
    let days = a.number(0)?;
    let format = if a.values.len() > 1 { a.string(1)? } else { "%Y-%m-%d %H:%M:%SZ" };
    if format.is_empty() {
        let message = "takes a format that is not empty".to_owned();
        return Err(a.error(CallErrorKind::OutOfRange, Some(1), message));
    }
    // From far beyond the range on, the conversion saturates.
    let seconds = (days * DAY as f64).round() as i64;
    let date = Date::of(seconds);
    if !(1400..=9999).contains(&date.year) {
        return Err(
            a.out_of_range(0, "a day of the years 1400 to 9999, counted from the year 2000")
        );
    }
    let mut text = String::new();
    date.write(format, &mut text);
    Ok(text)
}

struct Date {
    year: i64,
    /// From 1.
    month: usize,
    day: i64,
    /// From 0.
    day_of_year: i64,
    /// From 0 for Sunday.
    weekday: i64,
    seconds: i64,
}

/// Seconds in a day.
const DAY: i64 = 86_400;
/// Days from 0000-03-01 to 2000-01-01.
const EPOCH: i64 = 730_425;
/// Days in four hundred years.
const ERA: i64 = 146_097;
const DAYS: [&str; 7] =
    ["Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday"];
const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

impl Date {
    /// Converts from seconds since the beginning of 2000.
    fn of(seconds: i64) -> Self {
        let days = seconds.div_euclid(DAY);
        let since = days.saturating_add(EPOCH);
        let (era, of_era) = (since.div_euclid(ERA), since.rem_euclid(ERA));
        let year_of_era = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146_096) / 365;
        // Years of this count begin in March.
        let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let from_march = (5 * of_year + 2) / 153;
        let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
        let year = year_of_era + era * 400 + i64::from(month <= 2);
        let leap = i64::from(year % 4 == 0 && (year % 100 != 0 || year % 400 == 0));
        Self {
            year,
            month: month as usize,
            day: of_year - (153 * from_march + 2) / 5 + 1,
            day_of_year: if month <= 2 { of_year - 306 } else { of_year + 59 + leap },
            // The year 2000 began on a Saturday.
            weekday: (days + 6).rem_euclid(7),
            seconds: seconds.rem_euclid(DAY),
        }
    }

    /// Appends the formatted date to `text`; writing to a string cannot fail.
    fn write(&self, format: &str, text: &mut String) {
        let mut characters = format.chars();
        while let Some(character) = characters.next() {
            if character != '%' {
                text.push(character);
                continue;
            }
            match characters.next() {
                Some(code) => self.write_code(code, text),
                None => text.push('%'),
            }
        }
    }

    fn write_code(&self, code: char, text: &mut String) {
        let (day, month) = (DAYS[self.weekday as usize], MONTHS[self.month - 1]);
        let (hour, minute, second) =
            (self.seconds / 3600, self.seconds / 60 % 60, self.seconds % 60);
        let of_twelve = (hour + 11) % 12 + 1;
        let half = if hour < 12 { "AM" } else { "PM" };
        let weeks_before =
            |first: i64| (self.day_of_year + 7 - (self.weekday - first).rem_euclid(7)) / 7;
        let _ = match code {
            'a' => write!(text, "{}", &day[..3]),
            'A' => write!(text, "{day}"),
            'b' | 'h' => write!(text, "{}", &month[..3]),
            'B' => write!(text, "{month}"),
            'c' => return self.write("%a %b %e %H:%M:%S %Y", text),
            'C' => write!(text, "{:02}", self.year / 100),
            'd' => write!(text, "{:02}", self.day),
            'D' | 'x' => return self.write("%m/%d/%y", text),
            'e' => write!(text, "{:2}", self.day),
            'F' => return self.write("%Y-%m-%d", text),
            'H' => write!(text, "{hour:02}"),
            'I' => write!(text, "{of_twelve:02}"),
            'j' => write!(text, "{:03}", self.day_of_year + 1),
            'm' => write!(text, "{:02}", self.month),
            'M' => write!(text, "{minute:02}"),
            'n' => writeln!(text),
            'p' => write!(text, "{half}"),
            'R' => return self.write("%H:%M", text),
            'S' => write!(text, "{second:02}"),
            't' => write!(text, "\t"),
            'T' | 'X' => return self.write("%H:%M:%S", text),
            'u' => write!(text, "{}", (self.weekday + 6) % 7 + 1),
            'U' => write!(text, "{:02}", weeks_before(0)),
            'w' => write!(text, "{}", self.weekday),
            'W' => write!(text, "{:02}", weeks_before(1)),
            'y' => write!(text, "{:02}", self.year % 100),
            'Y' => write!(text, "{}", self.year),
            'z' => write!(text, "+0000"),
            'Z' => write!(text, "UTC"),
            '%' => write!(text, "%"),
            other => write!(text, "%{other}"),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::builtin::{RandomStreams, call};
    use crate::evaluate::value::Value;

    fn at(days: f64, format: &str) -> Result<String, String> {
        let arguments = [Value::Number(days), Value::string(format)];
        match call(Word::Datetime, &arguments, &mut RandomStreams::default(), 1000) {
            Ok(Value::String(text)) => Ok(text.to_string()),
            Ok(other) => panic!("{other:?}"),
            Err(error) => Err(error.message),
        }
    }

    /// What the program prints.
    #[test]
    fn every_code_is_written_as_pov_ray_writes_it() {
        let all = "%a|%A|%b|%B|%c|%d|%H|%I|%j|%m|%M|%p|%S|%U|%w|%W|%x|%X|%y|%Y|%%|%e|%D|%F|%T|%C|%u|%h|%R|%Q";
        let answers = [
            (
                9821.6765592604,
                "Sat|Saturday|Nov|November|Sat Nov 21 16:14:15 2026|21|16|04|325|11|14|PM|15|46|6|46|\
                 11/21/26|16:14:15|26|2026|%|21|11/21/26|2026-11-21|16:14:15|20|6|Nov|16:14|%Q",
            ),
            (
                -0.25,
                "Fri|Friday|Dec|December|Fri Dec 31 18:00:00 1999|31|18|06|365|12|00|PM|00|52|5|52|\
                 12/31/99|18:00:00|99|1999|%|31|12/31/99|1999-12-31|18:00:00|19|5|Dec|18:00|%Q",
            ),
            (
                365.9,
                "Sun|Sunday|Dec|December|Sun Dec 31 21:36:00 2000|31|21|09|366|12|36|PM|00|53|0|52|\
                 12/31/00|21:36:00|00|2000|%|31|12/31/00|2000-12-31|21:36:00|20|7|Dec|21:36|%Q",
            ),
        ];
        for (days, answer) in answers {
            assert_eq!(at(days, all).as_deref(), Ok(answer));
        }
    }

    #[test]
    fn days_are_rounded_to_seconds_and_lie_between_1400_and_9999() {
        let day = |days| at(days, "%Y-%m-%d %H:%M:%S");
        assert_eq!(day(1.999995).as_deref(), Ok("2000-01-03 00:00:00"));
        assert_eq!(day(59.999999).as_deref(), Ok("2000-03-01 00:00:00"));
        assert_eq!(day(-36524.0).as_deref(), Ok("1900-01-01 00:00:00"));
        assert_eq!(day(1e5).as_deref(), Ok("2273-10-16 00:00:00"));
        assert_eq!(day(1e6).as_deref(), Ok("4737-11-28 00:00:00"));
        for days in [1e8, -1e7, 1e300, -1e300] {
            assert!(day(days).is_err_and(|message| message.contains("1400 to 9999")));
        }
        assert!(at(0.0, "").is_err());
        assert_eq!(at(0.0, "100%").as_deref(), Ok("100%"));
    }

    #[test]
    fn days_follow_each_other() {
        let mut last = (1999, 365);
        for days in 0..200_000 {
            let date = Date::of(days * DAY);
            let next = (date.year, date.day_of_year + 1);
            assert!(next == (last.0, last.1 + 1) || next.1 == 1 && next.0 == last.0 + 1);
            assert!(next.1 > 1 || last.1 >= 365 && (date.month, date.day) == (1, 1));
            last = next;
        }
    }
}
