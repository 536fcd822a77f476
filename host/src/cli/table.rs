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
    fn long_texts_go_on_below_their_beginning() {
        assert_eq!(labelled("reads", "one two three", 7, 17), "  reads  one two\n         three\n");
        assert_eq!(labelled("reads", "", 7, 17), "  reads\n");
    }
}
