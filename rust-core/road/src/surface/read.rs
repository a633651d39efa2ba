//! The reader of r-tables.

use super::Table;
use gonio_formats::FormatError;

/// What a table's numbers count, in 1/sr.
const UNIT: f64 = 1e-4;
/// The largest number of a table; the most specular of wet roads stay far below.
const LARGEST: f64 = 1e7;
/// The most rows and columns.
const MOST: usize = 1000;

/// A line's numbers with its number in the file.
struct Line {
    number: u64,
    values: Vec<f64>,
}

impl Table {
    /// Reads the text of a table: a line of β in degrees, then lines of tan γ and r · 10⁴ for each β.
    ///
    /// Blanks, tabs, commas or semicolons stand between numbers, `#` begins a comment, a word or a number may stand in the corner. A cell
    /// without a value is written as `-` and counts as 0.
    ///
    /// # Errors
    /// Anything else, with the line.
    pub fn read(bytes: &[u8]) -> Result<Self, FormatError> {
        let text = std::str::from_utf8(bytes).map_err(|_| FormatError::whole("not a text in UTF-8: no r-table"))?;
        let mut lines = numbered(text.trim_start_matches('\u{feff}'));
        let head = lines.next().ok_or_else(|| FormatError::whole("no numbers: expected an r-table, a line of β and lines of tan γ"))?;
        let mut head = parsed(head, true)?;
        let rows = lines.map(|line| parsed(line, false)).collect::<Result<Vec<_>, _>>()?;
        // A number in the corner stands for nothing: β begins after it.
        if head.values.get(1) == Some(&0.0) {
            head.values.remove(0);
        }
        check_axis(&head, "β")?;
        if head.values.last() != Some(&180.0) {
            return Err(FormatError::line(head.number, "the last β is not 180, expected β from 0 to 180 degrees"));
        }
        Self::from_rows(head, &rows)
    }

    fn from_rows(head: Line, rows: &[Line]) -> Result<Self, FormatError> {
        let columns = head.values.len();
        for row in rows {
            if row.values.len() != columns + 1 {
                let problem = format!("{} numbers, expected {}: tan γ and a value for each β", row.values.len(), columns + 1);
                return Err(FormatError::line(row.number, problem));
            }
            if let Some(value) = row.values.iter().find(|value| **value < 0.0) {
                return Err(FormatError::line(row.number, format!("{value} is negative, expected r · 10⁴")));
            }
        }
        let last = rows.last().map_or(head.number, |row| row.number);
        if rows.len() < 2 || rows.len() > MOST || columns > MOST {
            let problem = format!("{} lines of tan γ and {columns} of β, expected 2 to {MOST} of each", rows.len());
            return Err(FormatError::line(last, problem));
        }
        let tangents = Line { number: rows[0].number, values: rows.iter().map(|row| row.values[0]).collect() };
        check_axis(&tangents, "tan γ").map_err(|error| lines_own(error, rows, &tangents.values))?;
        let values = rows.iter().flat_map(|row| row.values[1..].iter().map(|value| value * UNIT)).collect();
        Ok(Self { beta: head.values, tangent: tangents.values, values })
    }
}

/// Puts the line of the first tan γ that is out of order into an error.
fn lines_own(error: FormatError, rows: &[Line], tangents: &[f64]) -> FormatError {
    let wrong = tangents.windows(2).position(|pair| pair[1] <= pair[0]).filter(|_| tangents[0] == 0.0);
    wrong.map_or(error.clone(), |index| FormatError::line(rows[index + 1].number, error.problem))
}

/// Lines that hold anything, without comments.
fn numbered(text: &str) -> impl Iterator<Item = (u64, &str)> {
    let lines = (1_u64..).zip(text.lines());
    lines.map(|(number, line)| (number, line.split('#').next().unwrap_or("").trim())).filter(|(_, line)| !line.is_empty())
}

/// The numbers of a line; the first word of the head may be a name.
fn parsed((number, line): (u64, &str), is_head: bool) -> Result<Line, FormatError> {
    let words = line.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty());
    let mut values = Vec::new();
    for (place, word) in words.enumerate() {
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() && value.abs() <= LARGEST => values.push(value),
            Err(_) if word == "-" && !is_head => values.push(0.0),
            Err(_) if is_head && place == 0 => {}
            _ => {
                let shown: String = word.chars().take(40).collect();
                return Err(FormatError::line(number, format!("'{shown}' was found, expected a number of an r-table")));
            }
        }
    }
    Ok(Line { number, values })
}

/// Angles and tangents start at 0 and increase.
fn check_axis(line: &Line, name: &str) -> Result<(), FormatError> {
    if line.values.first() != Some(&0.0) {
        return Err(FormatError::line(line.number, format!("the first {name} is not 0")));
    }
    match line.values.windows(2).find(|pair| pair[1] <= pair[0]) {
        Some(pair) => Err(FormatError::line(line.number, format!("{name} {} does not follow {}: they must increase", pair[1], pair[0]))),
        None => Ok(()),
    }
}
