//! Histories in NPZ, stored and aligned, so that the program can map them.

#![allow(dead_code)] // every test target takes its own part of this file

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// An archive of arrays of doubles that is being written.
pub struct Npz {
    zip: ZipWriter<BufWriter<File>>,
}

impl Npz {
    /// Begins a file.
    pub fn create(path: &Path) -> Self {
        Self { zip: ZipWriter::new(BufWriter::new(File::create(path).expect("a writable folder"))) }
    }

    /// Adds an array of `shape`, its elements in C order.
    pub fn array(mut self, name: &str, shape: &[usize], values: impl Iterator<Item = f64>) -> Self {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(shape.iter().product::<usize>() > 1 << 28)
            .with_alignment(64);
        self.zip.start_file(format!("{name}.npy"), options).expect("a writable file");
        let shape = shape.iter().map(|n| format!("{n},")).collect::<String>();
        let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({shape}), }}");
        while !(10 + header.len() + 1).is_multiple_of(64) {
            header.push(' ');
        }
        header.push('\n');
        let mut block = b"\x93NUMPY\x01\x00".to_vec();
        block.extend_from_slice(&(header.len() as u16).to_le_bytes());
        block.extend_from_slice(header.as_bytes());
        for value in values {
            block.extend_from_slice(&value.to_le_bytes());
            if block.len() >= 1 << 20 {
                self.zip.write_all(&block).expect("a writable file");
                block.clear();
            }
        }
        self.zip.write_all(&block).expect("a writable file");
        self
    }

    /// Ends the file.
    pub fn finish(self) {
        self.zip.finish().expect("a writable file").flush().expect("a writable file");
    }
}
