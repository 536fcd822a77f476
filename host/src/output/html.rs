//! A report as one HTML file that needs nothing else: pieces of a page, and the pages of a run and of a study.
//!
//! The file holds its style and its pictures, asks for nothing from a network and runs no script. It reads on a phone, on
//! paper and in the dark; what stands in it is escaped.

mod run_page;
mod study_page;

use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

use super::{OutputError, write_file};

pub use run_page::{RunPage, write_run_page};
pub(super) use study_page::{StudyPage, write_study_page};

const STYLE: &str = include_str!("html/style.css");

/// A page while it is put together, from its top to its end.
#[derive(Clone, Debug, Default)]
struct Page {
    title: String,
    body: String,
}

impl Page {
    /// A page with a title, a sentence below it and a word for how it ended, which is set off if it is not good.
    #[must_use]
    pub fn new(title: &str, lead: &str, ended: &str, good: bool) -> Page {
        let mark = if good { "good" } else { "bad" };
        let body = format!(
            "<header><h1>{}</h1><p class=\"lead\">{} <span class=\"mark {mark}\">{}</span></p></header>\n",
            escaped(title),
            escaped(lead),
            escaped(ended)
        );
        Page { title: title.to_owned(), body }
    }

    /// Begins a section.
    pub fn heading(&mut self, text: &str) {
        let _ = writeln!(self.body, "<h2>{}</h2>", escaped(text));
    }

    /// A paragraph.
    pub fn text(&mut self, text: &str) {
        let _ = writeln!(self.body, "<p>{}</p>", escaped(text));
    }

    /// The few numbers that matter: label, value and what belongs to it.
    pub fn figures(&mut self, figures: &[(&str, String, String)]) {
        self.body.push_str("<div class=\"figures\">\n");
        for (label, value, note) in figures {
            let _ = writeln!(
                self.body,
                "<div><span>{}</span><strong>{}</strong><small>{}</small></div>",
                escaped(label),
                escaped(value),
                escaped(note)
            );
        }
        self.body.push_str("</div>\n");
    }

    /// Labels and what they are, a line each.
    pub fn facts(&mut self, facts: &[(String, String)]) {
        self.body.push_str("<dl>\n");
        for (label, value) in facts {
            let _ = writeln!(self.body, "<div><dt>{}</dt><dd>{}</dd></div>", escaped(label), escaped(value));
        }
        self.body.push_str("</dl>\n");
    }

    /// A table; its first column holds names, the others numbers.
    pub fn table(&mut self, head: &[&str], rows: &[Vec<String>]) {
        self.body.push_str("<div class=\"wide\"><table>\n<tr>");
        for name in head {
            let _ = write!(self.body, "<th>{}</th>", escaped(name));
        }
        self.body.push_str("</tr>\n");
        for row in rows {
            self.body.push_str("<tr>");
            for cell in row {
                let _ = write!(self.body, "<td>{}</td>", escaped(cell));
            }
            self.body.push_str("</tr>\n");
        }
        self.body.push_str("</table></div>\n");
    }

    /// A list.
    pub fn list<'a>(&mut self, items: impl IntoIterator<Item = &'a str>) {
        self.body.push_str("<ul>\n");
        for item in items {
            let _ = writeln!(self.body, "<li>{}</li>", escaped(item));
        }
        self.body.push_str("</ul>\n");
    }

    /// A picture, which is the text of an SVG file of this program, and what it shows.
    pub fn picture(&mut self, svg: &str, shows: &str) {
        // What stands before the element (a declaration) has no place inside a page.
        let svg = svg.find("<svg").map_or(svg, |at| &svg[at..]);
        let _ = writeln!(
            self.body,
            "<figure role=\"img\" aria-label=\"{0}\"><div class=\"wide\">{svg}</div><figcaption>{0}</figcaption></figure>",
            escaped(shows)
        );
    }

    /// A text as it stands, behind a line that opens it.
    pub fn hidden(&mut self, summary: &str, text: &str) {
        let _ = writeln!(
            self.body,
            "<details><summary>{}</summary><pre>{}</pre></details>",
            escaped(summary),
            escaped(text)
        );
    }

    /// The whole file.
    #[must_use]
    pub fn document(&self) -> String {
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n\
             <body>\n<main>\n{}</main>\n</body>\n</html>\n",
            escaped(&self.title),
            self.body
        )
    }

    /// Writes the file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let document = self.document();
        write_file(path, |to| to.write_all(document.as_bytes()))
    }
}

/// A text whose signs mean nothing in HTML, inside an attribute too; signs that no text has are left out.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for sign in text.chars() {
        match sign {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            sign if sign.is_control() && sign != '\n' && sign != '\t' => {}
            sign => safe.push(sign),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_page_is_taken_for_its_signs() {
        let evil = "</title><script>alert(\"1\")</script> & 'x'\u{0}";
        let mut page = Page::new(evil, evil, evil, false);
        page.heading(evil);
        page.text(evil);
        page.figures(&[(evil, evil.to_owned(), evil.to_owned())]);
        page.facts(&[(evil.to_owned(), evil.to_owned())]);
        page.table(&[evil], &[vec![evil.to_owned()]]);
        page.list([evil]);
        page.picture("<?xml version=\"1.0\"?><svg></svg>", evil);
        page.hidden(evil, evil);
        let document = page.document();
        assert!(!document.contains("<script") && !document.contains('\u{0}'), "{document}");
        assert!(!document.contains("<?xml"), "{document}");
        assert_eq!(document.matches("&lt;script&gt;").count(), 18);
    }

    #[test]
    fn a_page_needs_nothing_from_elsewhere() {
        let document = Page::new("a", "b", "done", true).document();
        for part in ["http:", "https:", "src=", "<link", "@import", "url("] {
            assert!(!document.contains(part), "{part}");
        }
    }
}
