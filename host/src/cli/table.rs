//! Aligned columns and lists that keep to the width of the terminal.

/// Rows with their columns aligned to the left, two blanks apart, `indent` blanks in front, none at the end.
pub(super) fn aligned(rows: &[Vec<String>], indent: usize) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| length(cell)).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = " ".repeat(indent);
        for (cell, width) in row.iter().zip(&widths) {
            line.push_str(cell);
            line.push_str(&" ".repeat(width - length(cell) + 2));
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// A label and a text behind it, broken at blanks so that no line is longer than `width` where that can be.
pub(super) fn labelled(label: &str, text: &str, label_width: usize, width: usize) -> String {
    let mut lines = String::new();
    let mut line = format!("  {label}{}", " ".repeat(label_width.saturating_sub(length(label)).max(2)));
    let mut empty = true;
    for word in text.split(' ') {
        if !empty && length(&line) + 1 + length(word) > width {
            lines.push_str(&line);
            lines.push('\n');
            line = " ".repeat(2 + label_width);
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    lines.push_str(line.trim_end());
    lines.push('\n');
    lines
}

/// A text whose lines are broken at blanks so that none is longer than `width` where that can be; what is broken goes on
/// below the place that `hang` answers for a line, and a line without one stays whole.
pub(super) fn folded(text: &str, width: usize, hang: impl Fn(&str) -> Option<usize>) -> String {
    let mut all = String::new();
    for whole in text.lines() {
        let place = hang(whole).filter(|place| length(whole) > width && *place > 0 && place + 20 <= width);
        let place = place.filter(|place| whole.is_char_boundary(*place) && *place < whole.len());
        match place {
            Some(place) => {
                let (before, rest) = whole.split_at(place);
                let lines = labelled("", rest.trim_start(), place - 2, width);
                // The first line begins with what stands before the place.
                all.push_str(before);
                all.push_str(lines.get(place..).unwrap_or_default());
            }
            None => {
                all.push_str(whole);
                all.push('\n');
            }
        }
    }
    all
}

fn length(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_and_lines_have_no_blanks_at_the_end() {
        let row = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect();
        let rows = [row(&["a", "1/Pa", ""]), row(&["long", "m", "what"])];
        assert_eq!(aligned(&rows, 2), "  a     1/Pa\n  long  m     what\n");
        assert_eq!(aligned(&[], 2), "");
    }

    #[test]
    fn long_lines_go_on_below_the_place_that_is_theirs() {
        let text =
            "  ok    one     in two three four five six\n  again do not break this line at any of its blanks\nshort\n";
        let hang = |line: &str| (!line.contains("again")).then_some(16);
        let wanted = "  ok    one     in two three four\n                five six\n  again do not break this line at any of its blanks\n\
                      short\n";
        assert_eq!(folded(text, 36, hang), wanted);
        assert_eq!(folded(text, 20, hang), text, "no room");
    }

    #[test]
    fn long_texts_go_on_below_their_beginning() {
        assert_eq!(labelled("reads", "one two three", 7, 17), "  reads  one two\n         three\n");
        assert_eq!(labelled("reads", "", 7, 17), "  reads\n");
    }
}
