//! Histories in CSV: a header row with names, then a row per time and point.

use super::super::npy::exact_integer;
use super::assemble::RowIndex;
use super::growing::Growing;
use super::header::open;
use super::{Column, Header, History, HistoryError, Layout, Needs};
use csv::ByteRecord;
use std::cell::Cell;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

fn reader(path: &Path) -> Result<csv::Reader<File>, HistoryError> {
    let file = open(path)?;
    let mut builder = csv::ReaderBuilder::new();
    builder.has_headers(false).flexible(true).comment(Some(b'#'));
    Ok(builder.buffer_capacity(1 << 16).from_reader(file))
}

fn io_fault(path: &Path, fault: csv::Error) -> HistoryError {
    let source = match fault.into_kind() {
        csv::ErrorKind::Io(source) => source,
        _ => std::io::Error::from(std::io::ErrorKind::InvalidData),
    };
    HistoryError::Io { path: path.into(), source }
}

/// The names of a CSV history.
pub(super) fn header(path: &Path) -> Result<Header, HistoryError> {
    let mut reader = reader(path)?;
    next_header(path, &mut reader)
}

fn next_header(path: &Path, reader: &mut csv::Reader<File>) -> Result<Header, HistoryError> {
    let mut record = ByteRecord::new();
    let found = reader.read_byte_record(&mut record).map_err(|e| io_fault(path, e))?;
    if !found {
        return Err(HistoryError::Empty { path: path.into() });
    }
    let name = |field: &[u8]| String::from_utf8_lossy(field.trim_ascii()).into_owned();
    Ok(Header {
        path: path.into(),
        layout: Layout::Csv,
        names: record.iter().map(name).collect(),
        times: None,
        points: None,
        line: line_of(path, record.position().map_or(0, csv::Position::byte)),
    })
}

/// The line of the first row that starts at or behind a byte of the file, comments passed over.
///
/// Counted only when an error needs it: the reader's own count stops before comments.
fn line_of(path: &Path, byte: u64) -> u64 {
    let Ok(mut file) = File::open(path).map(BufReader::new) else {
        return 0;
    };
    let mut line = 1;
    let mut chunk = [0_u8; 1 << 13];
    let mut left = byte;
    while left > 0 {
        let most = usize::try_from(left).unwrap_or(usize::MAX).min(chunk.len());
        match file.read(&mut chunk[..most]) {
            Ok(0) | Err(_) => return line,
            Ok(read) => {
                line += chunk[..read].iter().filter(|b| **b == b'\n').count() as u64;
                left -= read as u64;
            }
        }
    }
    let mut text = Vec::new();
    while file.read_until(b'\n', &mut text).is_ok_and(|read| read > 0) {
        let blank = text.iter().all(|b| matches!(b, b'\n' | b'\r'));
        if !blank && text[0] != b'#' {
            break;
        }
        line += 1;
        text.clear();
    }
    line
}

/// One column of the file that is read.
struct Source {
    field: usize,
    column: Column,
    values: Growing,
}

/// Reads the columns that are needed.
pub(super) fn read(header: &Header, needs: &Needs) -> Result<History, HistoryError> {
    let path = header.path.as_path();
    let mut reader = reader(path)?;
    next_header(path, &mut reader)?;
    let length = std::fs::metadata(path).map_or(0, |m| m.len());
    let field_of = |name: &str| header.names.iter().position(|known| known == name);
    let (Some(time_field), Some(point_field)) = (field_of("time"), field_of("point")) else {
        return Err(HistoryError::NoRows { path: path.into() });
    };
    let mut sources: Vec<Source> = Vec::new();
    for (field, name) in header.names.iter().enumerate() {
        if let Some(column) = needs.wanted(name) {
            sources.push(Source { field, column, values: Growing::new() });
        }
    }
    let source_of = |column| sources.iter().position(|source| source.column == column);
    let bounded: Vec<(usize, Column)> =
        [Column::Area, Column::Friction].into_iter().filter_map(|c| Some((source_of(c)?, c))).collect();
    let normal: Vec<usize> = Column::NORMAL.iter().filter_map(|c| source_of(*c)).collect();
    let whole_normal = needs.has(Column::NormalX) && needs.has(Column::NormalZ);

    let mut index = RowIndex::default();
    let mut record = ByteRecord::new();
    let mut row_values = vec![0.0; sources.len()];
    // No field of a file: the first row's time is always parsed.
    let mut time_text: Vec<u8> = vec![b'\n', 0xff];
    let mut time = 0.0;
    let mut expected = 0;
    let byte = Cell::new(0);
    let line = || line_of(path, byte.get());
    while reader.read_byte_record(&mut record).map_err(|e| io_fault(path, e))? {
        byte.set(record.position().map_or(0, csv::Position::byte));
        if record.len() != header.names.len() {
            return Err(HistoryError::FieldCount {
                path: path.into(),
                line: line(),
                found: record.len(),
                expected: header.names.len(),
            });
        }
        let number = |field: usize| {
            let text = record[field].trim_ascii();
            parse(text).ok_or_else(|| bad_number(header, field, text, line()))
        };
        if time_text != record[time_field] {
            time = number(time_field)?;
            time_text.clear();
            time_text.extend_from_slice(&record[time_field]);
        }
        let id_text = record[point_field].trim_ascii();
        let id = parse_id(id_text).ok_or_else(|| HistoryError::NotAnId {
            path: path.into(),
            line: line(),
            column: point_field + 1,
            text: String::from_utf8_lossy(id_text).into_owned(),
        })?;
        for (value, source) in row_values.iter_mut().zip(&sources) {
            *value = number(source.field)?;
        }
        for (at, column) in &bounded {
            let value = row_values[*at];
            if let Some(expected) = column.refusal(value) {
                let column = column.fixed_name().unwrap_or("");
                let (path, point) = (path.into(), id);
                return Err(HistoryError::Value { path, line: line(), column, value, point, time, expected });
            }
        }
        if whole_normal && normal.iter().all(|at| row_values[*at] == 0.0) {
            return Err(HistoryError::ZeroNormal { path: path.into(), line: line(), point: id, time });
        }
        let slot = index.push(path, time, id, &line)?;
        if index.rows().is_multiple_of(1024) {
            // Two per cent more than the file seems to hold: rows differ in length.
            let rows = length as f64 * index.rows() as f64 / (byte.get() as f64).max(1.0);
            expected = (1.02 * rows) as usize;
        }
        for (value, source) in row_values.iter().zip(&mut sources) {
            source.values.push(&index, slot, *value, expected);
        }
    }
    let placement = index.finish(path)?;
    let columns = sources.into_iter().map(|source| (source.column, source.values.finish(&placement)));
    let columns = columns.collect();
    Ok(History { path: path.into(), columns, point_ids: placement.ids, times: placement.times })
}

fn parse(text: &[u8]) -> Option<f64> {
    let value: f64 = std::str::from_utf8(text).ok()?.parse().ok()?;
    value.is_finite().then_some(value)
}

/// An integer, also where a program wrote it as a decimal number.
fn parse_id(text: &[u8]) -> Option<i64> {
    let text = std::str::from_utf8(text).ok()?;
    text.parse().ok().or_else(|| exact_integer(text.parse().ok()?))
}

fn bad_number(header: &Header, field: usize, text: &[u8], line: u64) -> HistoryError {
    let path = header.path.clone();
    let name = header.names[field].clone();
    let text = String::from_utf8_lossy(text).into_owned();
    let column = field + 1;
    if text.parse::<f64>().is_ok() {
        HistoryError::NotFinite { path, line, column, name, text }
    } else {
        HistoryError::NotANumber { path, line, column, name, text }
    }
}
