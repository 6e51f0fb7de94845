//! Diagnostics for a `matrix` as other tools print it (in rows, with a fourth column, or without brackets),
//! and for columns of zeros.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::math::transform::Step;
use crate::source::Span;

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};

/// Dimensions of a matrix: its rows, and its columns here and in other tools.
const ROWS: usize = 4;
const COLUMNS: usize = 3;
const COLUMNS_ELSEWHERE: usize = 4;

/// POV-Ray 3.7 takes a smaller element of a matrix for 0 (measured: 1e-11 is, 1e-10 is not).
const NO_LENGTH: f64 = 1e-10;

impl Evaluator<'_> {
    /// Replaces the diagonal element of a column of zeros by 1 with a warning, as POV-Ray 3.7 does
    /// (measured).
    pub(super) fn with_columns(&mut self, matrix: &Token, rows: [Vector; 4]) -> Outcome<Step> {
        let [mut x, mut y, mut z, place] = rows.map(|row| row.to_array());
        let linear = [&mut x, &mut y, &mut z];
        let empty = [0, 1, 2].map(|column| linear.iter().all(|row| row[column].abs() < NO_LENGTH));
        for (column, row) in linear.into_iter().enumerate() {
            if empty[column] {
                row[column] = 1.0;
            }
        }
        if empty.contains(&true) {
            let message = "a column of zeros in a `matrix` flattens everything to nothing";
            let diagnostic = Diagnostic::new(Code::ZeroScale, message)
                .at(matrix.span, "its element on the diagonal is read as 1");
            self.opinion(&matrix.here, diagnostic)?;
        }
        Ok(Step::Matrix([x, y, z, place].map(Vector::from_array)))
    }

    /// Reports a matrix without brackets, whose first number was taken: `matrix 1,0,0, 0,1,0, 0,0,1, 0,0,0`.
    pub(super) fn bare_matrix(&mut self, first: &Token) -> Option<Reported> {
        let text = self.sources.get(first.span.file).text.get(first.span.start as usize..)?;
        let of_number = |c: char| c.is_ascii_digit() || c.is_whitespace() || ".,+-eE".contains(c);
        let plain = &text[..text.find(|c| !of_number(c)).unwrap_or(text.len())];
        let plain = plain.trim_end_matches(|c: char| c.is_whitespace() || c == ',');
        let numbers = plain.split([',', ' ', '\t', '\n', '\r']).filter(|part| !part.is_empty());
        let numbers: Vec<&str> = numbers.collect();
        let all_plain = numbers.iter().all(|number| number.parse::<f64>().is_ok());
        if numbers.len() != ROWS * COLUMNS || !all_plain {
            return None;
        }
        let whole = Span { end: first.span.start + plain.len() as u32, ..first.span };
        let is_parted = plain.matches(',').count() == numbers.len() - 1;
        let right = match is_parted {
            true => format!("<{plain}>"),
            false => format!("<{}>", numbers.join(", ")),
        };
        let told = Diagnostic::new(
            Code::ExpectedExpression,
            "the numbers of a matrix stand in angle brackets",
        )
        .at(whole, "expected `<` before these, and `>` behind")
        .fix(whole, right);
        let reported = self.report(&first.here, told);
        self.skip_values();
        Some(reported)
    }

    /// Reports a matrix of rows: `matrix <<1,0,0>, <0,1,0>, <0,0,1>, <0,0,0>>`.
    pub(super) fn matrix_of_rows(&mut self, matrix: &Token) -> Option<Reported> {
        let TokenKind::Expression(_) = matrix.kind else { return None };
        let inside = self.sources.text(matrix.span).strip_prefix('<')?.strip_suffix('>')?;
        if inside.matches('<').count() != ROWS {
            return None;
        }
        let flat = inside.replace(['<', '>'], "");
        let numbers: Vec<&str> = flat.split(',').map(str::trim).collect();
        let all_plain = numbers.iter().all(|number| number.parse::<f64>().is_ok());
        if numbers.len() != ROWS * COLUMNS || !all_plain {
            return None;
        }
        let right = format!("<{}>", flat.trim());
        let told =
            Diagnostic::new(Code::WrongArity, "a matrix is 12 numbers in one pair of brackets")
                .at(matrix.span, "expected numbers, not vectors")
                .help(format!("write `matrix {right}`"))
                .fix(matrix.span, right);
        Some(self.report(&matrix.here, told))
    }

    /// Returns `<1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1>` without its fourth column.
    pub(super) fn without_column(&self, matrix: Span) -> Option<String> {
        let inside = self.sources.text(matrix).strip_prefix('<')?.strip_suffix('>')?;
        let numbers: Vec<&str> = inside.split(',').map(str::trim).collect();
        let values: Option<Vec<f64>> = numbers.iter().map(|number| number.parse().ok()).collect();
        let column = values?.into_iter().skip(COLUMNS).step_by(COLUMNS_ELSEWHERE);
        if numbers.len() != ROWS * COLUMNS_ELSEWHERE || !column.eq([0.0, 0.0, 0.0, 1.0]) {
            return None;
        }
        let rows = numbers.chunks(COLUMNS_ELSEWHERE).map(|row| row[..COLUMNS].join(", "));
        Some(format!("<{}>", rows.collect::<Vec<_>>().join(", ")))
    }
}
