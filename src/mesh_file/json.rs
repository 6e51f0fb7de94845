//! Locates a value in a JSON text by its path of keys and indices.
//!
//! **In:** a text that was parsed successfully, so its syntax is valid. **Invariant:** never panics and never
//! recurses, for any text.

use super::{Fault, Place, line_at};

/// A document, by itself or in a binary file.
#[derive(Clone, Copy)]
pub(super) struct Text<'t> {
    pub bytes: &'t [u8],
    /// Offset of its start in a binary file.
    pub start: Option<usize>,
}

/// A step from a value to a nested one.
#[derive(Clone, Copy)]
pub(super) enum Step<'s> {
    Key(&'s str),
    /// Counted from 0.
    Entry(usize),
}

impl Text<'_> {
    pub fn place(&self, at: usize) -> Place {
        match self.start {
            None => Place::Line(line_at(self.bytes, at)),
            Some(start) => Place::Byte(start + at),
        }
    }

    /// Returns the fault, located at the value with this path, if there is one and the fault has no location
    /// yet.
    pub fn fault_at(&self, fault: Fault, path: &[Step]) -> Fault {
        match find(self.bytes, path) {
            Some(at) => fault.at(self.place(at)),
            None => fault,
        }
    }
}

fn find(text: &[u8], path: &[Step]) -> Option<usize> {
    let mut cursor = Cursor { text, at: 0 };
    for step in path {
        cursor.enter(*step)?;
    }
    cursor.next()?;
    Some(cursor.at)
}

struct Cursor<'t> {
    text: &'t [u8],
    at: usize,
}

impl<'t> Cursor<'t> {
    /// Advances to the next byte that is not whitespace, and returns it.
    fn next(&mut self) -> Option<u8> {
        let rest = self.text.get(self.at..)?;
        self.at += rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        self.text.get(self.at).copied()
    }

    fn take(&mut self, wanted: u8) -> Option<()> {
        (self.next()? == wanted).then(|| self.at += 1)
    }

    /// Reads a string, without its quotes.
    fn string(&mut self) -> Option<&'t [u8]> {
        self.take(b'"')?;
        let start = self.at;
        loop {
            match self.text.get(self.at)? {
                b'"' => break,
                b'\\' => self.at += 2,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        self.text.get(start..self.at - 1)
    }

    /// Advances to the value of a key, or to an entry.
    fn enter(&mut self, step: Step) -> Option<()> {
        match step {
            Step::Key(wanted) => {
                self.take(b'{')?;
                loop {
                    let key = self.string()?;
                    self.take(b':')?;
                    if key == wanted.as_bytes() {
                        return Some(());
                    }
                    self.skip()?;
                    self.take(b',')?;
                }
            }
            Step::Entry(number) => {
                self.take(b'[')?;
                for _ in 0..number {
                    self.skip()?;
                    self.take(b',')?;
                }
                (self.next()? != b']').then_some(())
            }
        }
    }

    /// Skips a value with its contents.
    fn skip(&mut self) -> Option<()> {
        let mut depth = 0usize;
        loop {
            match self.next()? {
                b'"' => drop(self.string()?),
                b'{' | b'[' => {
                    self.at += 1;
                    depth += 1;
                }
                b'}' | b']' => {
                    self.at += 1;
                    depth = depth.checked_sub(1)?;
                }
                b',' | b':' => self.at += 1,
                _ => {
                    let ends = |byte: &u8| b",:]}".contains(byte) || byte.is_ascii_whitespace();
                    let rest = &self.text[self.at..];
                    self.at += rest.iter().position(ends).unwrap_or(rest.len());
                }
            }
            if depth == 0 {
                return Some(());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Step::{Entry, Key};
    use super::*;

    #[test]
    fn a_value_is_found_by_the_path_to_it() {
        let text = br#"{ "a": [1, {"b,]": "x\"}"}, [ ]], "c" : { "d": null,"e":[true ,-2e5]} }"#;
        let found = |path: &[Step]| {
            let at = find(text, path)?;
            Some(String::from_utf8_lossy(&text[at..]).chars().take(3).collect::<String>())
        };
        for (path, value) in [
            (&[] as &[Step], Some("{ \"")),
            (&[Key("a")], Some("[1,")),
            (&[Key("a"), Entry(1)], Some("{\"b")),
            (&[Key("a"), Entry(1), Key("b,]")], Some("\"x\\")),
            (&[Key("a"), Entry(2)], Some("[ ]")),
            (&[Key("a"), Entry(3)], None),
            (&[Key("a"), Entry(2), Entry(0)], None),
            (&[Key("c"), Key("e"), Entry(1)], Some("-2e")),
            (&[Key("d")], None),
            (&[Entry(0)], None),
        ] {
            assert_eq!(found(path).as_deref(), value);
        }
        assert!(
            (0..text.len())
                .all(|end| find(&text[..end], &[Key("c"), Key("e"), Entry(2)]).is_none())
        );
    }
}
