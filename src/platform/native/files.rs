//! The file system.

use std::fs::{self, File};
use std::io::{self, Read as _, stdin};
use std::path::Path;

use crate::headless::Files;

/// Files of the machine that the program runs on.
#[derive(Clone, Copy, Debug, Default)]
pub struct NativeFiles;

impl Files for NativeFiles {
    fn read(&self, path: &Path, limit: usize) -> io::Result<Vec<u8>> {
        first(File::open(path)?, limit)
    }

    fn read_stdin(&self, limit: usize) -> io::Result<Vec<u8>> {
        first(stdin().lock(), limit)
    }

    fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        fs::write(path, bytes)
    }

    fn create_folder(&self, path: &Path) -> io::Result<()> {
        fs::create_dir_all(path)
    }
}

fn first(source: impl io::Read, limit: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(limit as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}
