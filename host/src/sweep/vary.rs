//! One varied key: `step.0.load=5,10,20`, `step.0.load=5..20:4`, `law.constants.K=1e-6..1e-3:4:log`.

use super::SweepError;

/// A key of the scene and the values that it takes, as they would stand behind `--set KEY=`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vary {
    /// The dotted path.
    pub key: String,
    /// The values, one at least.
    pub values: Vec<String>,
}

/// Most values of one key.
const MOST: usize = 1_000_000;

impl Vary {
    /// Reads the text of one `--vary`.
    ///
    /// A list is cut at commas outside of brackets and quotes. A range gives COUNT values from FIRST to LAST, both of them
    /// included, at equal distances, or at equal ratios with `:log`.
    ///
    /// # Errors
    /// Text of another form, a range that has no values.
    pub fn parse(text: &str) -> Result<Vary, SweepError> {
        let wrong = |found: &str| SweepError::Vary { text: text.to_owned(), found: found.to_owned() };
        let (key, values) = text.split_once('=').ok_or_else(|| wrong("no `=`"))?;
        let (key, values) = (key.trim(), values.trim());
        if key.is_empty() {
            return Err(wrong("no key"));
        }
        let values = match range(values) {
            Some(range) => range.map_err(|found| wrong(&found))?,
            None => list(values).ok_or_else(|| wrong("a value that is empty"))?,
        };
        Ok(Vary { key: key.to_owned(), values })
    }
}

/// The values of a range; `None`: it is a list.
fn range(text: &str) -> Option<Result<Vec<String>, String>> {
    // Numbers with colons between them, as other programs have ranges, or a range without a count, are no values of a list.
    let all_numbers = |between: &str| text.split(between).all(|one| one.trim().parse::<f64>().is_ok());
    if text.contains(':') && !text.contains("..") && all_numbers(":") || text.contains("..") && all_numbers("..") {
        return Some(Err(format!("`{text}`")));
    }
    let (first, rest) = text.split_once("..")?;
    let (last, rest) = rest.split_once(':')?;
    let first: f64 = first.trim().parse().ok()?;
    let last: f64 = last.trim().parse().ok()?;
    let (count, even) = match rest.split_once(':') {
        None => (rest, true),
        Some((count, "log")) => (count, false),
        Some((_, other)) => return Some(Err(format!("`{other}` behind the count"))),
    };
    let count = match count.trim().parse::<usize>() {
        Ok(count @ 2..=MOST) => count,
        _ => return Some(Err(format!("a count of `{}`, from 2 to {MOST}", count.trim()))),
    };
    if !(first.is_finite() && last.is_finite()) {
        return Some(Err("an end that is not finite".to_owned()));
    }
    if !even && first.min(last) <= 0.0 {
        return Some(Err("equal ratios from or to what is not above 0".to_owned()));
    }
    let value = |k: usize| {
        let part = k as f64 / (count - 1) as f64;
        match k {
            0 => first,
            _ if k == count - 1 => last,
            _ if even => first + part * (last - first),
            _ => (first.ln() + part * (last.ln() - first.ln())).exp(),
        }
    };
    // Written so that they are numbers of TOML and give the same bits back.
    Some(Ok((0..count).map(|k| format!("{:?}", value(k))).collect()))
}

/// The parts of a list; `None`: one of them is empty.
fn list(text: &str) -> Option<Vec<String>> {
    let (mut depth, mut quote) = (0_i32, None);
    let mut parts = vec![String::new()];
    for sign in text.chars() {
        match (sign, quote) {
            (_, Some(open)) if sign == open => quote = None,
            (_, Some(_)) => {}
            ('"' | '\'', None) => quote = Some(sign),
            ('[' | '{', None) => depth += 1,
            (']' | '}', None) => depth -= 1,
            (',', None) if depth == 0 => {
                parts.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(part) = parts.last_mut() {
            part.push(sign);
        }
    }
    let parts: Vec<String> = parts.iter().map(|part| part.trim().to_owned()).collect();
    parts.iter().all(|part| !part.is_empty()).then_some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        Vary::parse(text).unwrap().values
    }

    #[test]
    fn lists_are_cut_at_their_own_commas() {
        assert_eq!(values("a.b = 1, 2,3"), ["1", "2", "3"]);
        assert_eq!(values("grid.cells=[32,32],[64,64]"), ["[32,32]", "[64,64]"]);
        assert_eq!(values("title=\"a,b\",'c,]'"), ["\"a,b\"", "'c,]'"]);
        assert_eq!(values("surface.file=../a.npy"), ["../a.npy"]);
        assert_eq!(Vary::parse("step.0.load=5").unwrap().key, "step.0.load");
    }

    #[test]
    fn ranges_hold_both_ends() {
        assert_eq!(values("x=1..2:5"), ["1.0", "1.25", "1.5", "1.75", "2.0"]);
        assert_eq!(values("x=2..-2:3"), ["2.0", "0.0", "-2.0"]);
        let log: Vec<f64> = values("x=1e-6..1e-3:4:log").iter().map(|text| text.parse().unwrap()).collect();
        assert_eq!((log[0], log[3]), (1e-6, 1e-3));
        assert!((log[1] / 1e-5 - 1.0).abs() < 1e-12 && (log[2] / 1e-4 - 1.0).abs() < 1e-12, "{log:?}");
    }

    #[test]
    fn what_is_no_variation_says_so() {
        for text in [
            "",
            "a",
            "=1",
            "a=",
            "a=1,,2",
            "a=1:2:3",
            "a=1..2",
            "a=1..2:1",
            "a=1..2:x",
            "a=1..2:3:lin",
            "a=0..1:3:log",
            "a=1..inf:2",
        ] {
            let error = Vary::parse(text).unwrap_err().to_string();
            assert!(error.starts_with(&format!("--vary {text}: found ")) && error.contains("expected KEY="), "{error}");
        }
    }
}
