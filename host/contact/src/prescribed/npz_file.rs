//! Histories in NPZ: an archive of arrays, read in place where the file allows it.

use super::super::npy::{ArrayFault, ArrayHeader};
use super::assemble::RowIndex;
use super::growing::fold;
use super::header::open;
use super::history::PointIds;
use super::npz_shape::{Extent, extent, steps};
use super::samples::{ColumnData, Samples, map_file};
use super::{Column, Header, History, HistoryError, Layout, Needs};
use memmap2::Mmap;
use std::collections::{BTreeMap, HashSet};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use std::sync::Arc;
use zip::ZipArchive;
use zip::result::ZipError;

/// One array of the archive.
struct Member {
    index: usize,
    name: String,
    array: ArrayHeader,
    elements: usize,
    /// Where its elements lie in the file, if they lie there as they are.
    place: Option<u64>,
    /// Bytes in the archive: what a damaged header may ask for is held to this.
    packed: u64,
}

/// An open archive and what its arrays say about themselves.
struct Archive<'a> {
    path: &'a Path,
    zip: ZipArchive<BufReader<File>>,
    members: Vec<Member>,
}

fn archive_fault(path: &Path, fault: &ZipError) -> HistoryError {
    HistoryError::Archive { path: path.into(), reason: fault.to_string() }
}

fn array_fault(path: &Path, name: &str, fault: ArrayFault) -> HistoryError {
    HistoryError::Array { path: path.into(), name: name.to_string(), fault }
}

impl Archive<'_> {
    fn open(path: &Path) -> Result<Archive<'_>, HistoryError> {
        let file = BufReader::new(open(path)?);
        let mut zip = ZipArchive::new(file).map_err(|e| archive_fault(path, &e))?;
        let mut members = Vec::with_capacity(zip.len());
        for index in 0..zip.len() {
            let mut entry = zip.by_index(index).map_err(|e| archive_fault(path, &e))?;
            let name = entry.name();
            let name = name.strip_suffix(".npy").unwrap_or(name).to_string();
            let (size, packed) = (entry.size(), entry.compressed_size());
            let stored = entry.compression() == zip::CompressionMethod::Stored && size == packed;
            let start = entry.data_start().filter(|_| stored);
            let array = ArrayHeader::read(&mut entry).map_err(|e| array_fault(path, &name, e))?;
            let found = size.saturating_sub(array.offset);
            let bytes = array.elements().and_then(|n| n.checked_mul(array.width));
            let expected = bytes.map_or(u64::MAX, |bytes| bytes as u64);
            if found != expected {
                return Err(array_fault(path, &name, ArrayFault::Length { found, expected }));
            }
            let elements = array.elements().unwrap_or(0);
            let in_place = array.is_native_double() && array.in_c_order();
            let place = start.filter(|_| in_place).and_then(|at| at.checked_add(array.offset));
            members.push(Member { index, name, array, elements, place, packed });
        }
        Ok(Archive { path, zip, members })
    }

    fn extent(&self) -> Result<Extent, HistoryError> {
        let shapes = self.members.iter().map(|m| (m.name.as_str(), m.array.shape.as_slice()));
        extent(self.path, &shapes.collect::<Vec<_>>())
    }

    fn find(&self, name: &str) -> Option<usize> {
        self.members.iter().position(|member| member.name == name)
    }

    /// Opens a member behind its header.
    fn elements_of(&mut self, at: usize) -> Result<impl Read + '_, HistoryError> {
        let (path, member) = (self.path, &self.members[at]);
        let mut entry = self.zip.by_index(member.index).map_err(|e| archive_fault(path, &e))?;
        ArrayHeader::read(&mut entry).map_err(|e| array_fault(path, &member.name, e))?;
        Ok(entry)
    }

    /// Reads every element once and hands it on; stops at the end with the first that is not finite.
    fn each(&mut self, at: usize, mut take: impl FnMut(f64)) -> Result<(), HistoryError> {
        let path = self.path.to_path_buf();
        let (name, array) = (self.members[at].name.clone(), self.members[at].array.clone());
        let (mut element, mut bad) = (0, None);
        let mut reader = self.elements_of(at)?;
        let read = array.each(&mut reader, |value| {
            if !value.is_finite() && bad.is_none() {
                bad = Some((element, value));
            }
            element += 1;
            take(value);
        });
        read.map_err(|e| array_fault(&path, &name, e))?;
        match bad {
            None => Ok(()),
            Some((element, value)) => Err(HistoryError::NotFiniteElement { path, name, element, value }),
        }
    }

    /// The elements of an array in C order.
    fn values(&mut self, at: usize) -> Result<Vec<f64>, HistoryError> {
        let member = &self.members[at];
        // Deflate packs at most 1032 to 1: more elements than that are not there.
        let most = member.packed.saturating_mul(1032) / member.array.width as u64;
        let room = member.elements.min(usize::try_from(most).unwrap_or(usize::MAX));
        let (array, elements) = (member.array.clone(), member.elements);
        let mut values = Vec::new();
        values.try_reserve_exact(room).map_err(|_| HistoryError::TooLarge {
            path: self.path.into(),
            name: self.members[at].name.clone(),
            bytes: 8 * room as u64,
        })?;
        self.each(at, |value| values.push(value))?;
        if array.in_c_order() || array.shape.len() != 2 {
            return Ok(values);
        }
        let (rows, columns) = (array.shape[0], array.shape[1]);
        Ok((0..elements).map(|at| values[at % columns * rows + at / columns]).collect())
    }

    /// The values of the array `point`.
    fn ids(&mut self, at: usize) -> Result<Vec<i64>, HistoryError> {
        let path = self.path.to_path_buf();
        let array = self.members[at].array.clone();
        let (mut ids, mut bad) = (Vec::new(), None);
        let mut reader = self.elements_of(at)?;
        let read = array.each_integer(&mut reader, |id, value| match id {
            Some(id) => ids.push(id),
            None if bad.is_none() => bad = Some((ids.len(), value)),
            None => {}
        });
        read.map_err(|e| array_fault(&path, "point", e))?;
        match bad {
            None => Ok(ids),
            Some((element, value)) => Err(HistoryError::NotAnIdElement { path, element, value }),
        }
    }

    /// The members that are needed and the columns they stand for.
    fn wanted(&self, needs: &Needs) -> Vec<(usize, Column)> {
        let members = self.members.iter().enumerate();
        members.filter_map(|(at, member)| Some((at, needs.wanted(&member.name)?))).collect()
    }

    fn read_long(mut self, needs: &Needs) -> Result<History, HistoryError> {
        let path = self.path;
        let (Some(time), Some(point)) = (self.find("time"), self.find("point")) else {
            return Err(HistoryError::NoRows { path: path.into() });
        };
        let mut index = RowIndex::default();
        for (time, id) in self.values(time)?.into_iter().zip(self.ids(point)?) {
            index.push(path, time, id, &|| 0)?;
        }
        let placement = index.finish(path)?;
        let (times, points) = (placement.times.len(), placement.ids.len());
        let mut columns = BTreeMap::new();
        for (at, column) in self.wanted(needs) {
            let values = self.values(at)?;
            let data = if self.members[at].array.shape.is_empty() {
                ColumnData::constant(values[0])
            } else {
                fold(placement.place_rows(values), times, points)
            };
            columns.insert(column, data);
        }
        let point_ids = placement.ids;
        Ok(History { path: path.into(), times: placement.times, point_ids, columns })
    }

    fn read_grid(mut self, extent: Extent, needs: &Needs) -> Result<History, HistoryError> {
        let path = self.path;
        let times = match self.find("time") {
            Some(at) => self.values(at)?,
            None => return Err(HistoryError::NoRows { path: path.into() }),
        };
        check_times(path, &times)?;
        let point_ids = match self.find("point") {
            None => PointIds::Counted(extent.points),
            Some(at) => {
                let ids = self.ids(at)?;
                let mut known = HashSet::with_capacity(ids.len());
                if let Some(&point) = ids.iter().find(|id| !known.insert(**id)) {
                    return Err(HistoryError::RepeatedId { path: path.into(), point });
                }
                PointIds::from_list(ids)
            }
        };
        for member in &self.members {
            if !matches!(member.name.as_str(), "time" | "point") {
                steps(path, (&member.name, &member.array.shape), extent)?;
            }
        }
        let mut map: Option<Arc<Mmap>> = None;
        let mut columns = BTreeMap::new();
        for (at, column) in self.wanted(needs) {
            let member = &self.members[at];
            let (time_step, point_step) = steps(path, (&member.name, &member.array.shape), extent)?;
            let (place, elements) = (member.place, member.elements);
            let samples = match place {
                None => None,
                Some(place) => {
                    let map = match &map {
                        Some(map) => map,
                        None => {
                            map.insert(map_file(path).map_err(|source| HistoryError::Io { path: path.into(), source })?)
                        }
                    };
                    Samples::mapped(map, place, elements)
                }
            };
            let data = match samples {
                // Checked through the archive, piece by piece, so that the map stays untouched.
                Some(samples) => {
                    self.each(at, |_| {})?;
                    ColumnData { samples, time_step, point_step }
                }
                None if time_step > 0 && point_step > 0 => fold(self.values(at)?, extent.times, extent.points),
                None => ColumnData { samples: Samples::Owned(self.values(at)?), time_step, point_step },
            };
            columns.insert(column, data);
        }
        Ok(History { path: path.into(), times, point_ids, columns })
    }
}

/// Times never go back, and come at most twice.
fn check_times(path: &Path, times: &[f64]) -> Result<(), HistoryError> {
    for (at, pair) in times.windows(2).enumerate() {
        let (before, time, path, element) = (pair[0], pair[1], path.to_path_buf(), at + 1);
        if time < before {
            return Err(HistoryError::TimesGoBack { path, element, before, time });
        }
        if time == before && times.get(at + 2) == Some(&time) {
            return Err(HistoryError::TimeThrice { path, element: at + 2, time });
        }
    }
    Ok(())
}

/// The names of an NPZ history, and its extent in the grid form.
pub(super) fn header(path: &Path) -> Result<Header, HistoryError> {
    let archive = Archive::open(path)?;
    let names: Vec<String> = archive.members.iter().map(|m| m.name.clone()).collect();
    let extent = archive.extent()?;
    let grid = extent.layout == Layout::NpzGrid;
    Ok(Header {
        path: path.into(),
        layout: extent.layout,
        names,
        times: grid.then_some(extent.times),
        points: grid.then_some(extent.points),
        line: 0,
    })
}

/// Reads the columns that are needed.
pub(super) fn read(header: &Header, needs: &Needs) -> Result<History, HistoryError> {
    let archive = Archive::open(&header.path)?;
    let extent = archive.extent()?;
    match extent.layout {
        Layout::NpzGrid => archive.read_grid(extent, needs),
        _ => archive.read_long(needs),
    }
}
