//! Doubles in JSON, which has no word for infinity and NaN: these become the texts `inf`, `-inf` and `nan`.

use serde::{Deserialize, Deserializer, Serializer};

/// Writes a finite number as a number and any other as a text.
pub fn serialize<S: Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
    if value.is_finite() {
        to.serialize_f64(*value)
    } else if value.is_nan() {
        to.serialize_str("nan")
    } else {
        to.serialize_str(if *value > 0.0 { "inf" } else { "-inf" })
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Either {
    Number(f64),
    Text(String),
}

/// Reads what [`serialize`] wrote.
pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    match Either::deserialize(from)? {
        Either::Number(value) => Ok(value),
        Either::Text(text) => text.parse().map_err(|_| serde::de::Error::custom(format!("`{text}` is not a number"))),
    }
}
