//! Arrays for other programs: an archive (`.npz`) that `numpy.load` reads. It contains files (`.npy`, version 1.0) of
//! eight-byte numbers, neither compressed nor aligned.

use super::archive::zip;

/// Named array.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Name, made of letters, digits and `_`.
    pub name: String,
    /// Length of each axis. The last axis varies fastest.
    pub shape: Vec<usize>,
    /// Numbers.
    pub values: Vec<f64>,
}

impl Array {
    /// Returns a one-dimensional array.
    pub fn list(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), shape: vec![values.len()], values }
    }

    /// Returns a matrix of rows of equal length. An empty table has no columns.
    pub fn rows<R: AsRef<[f64]>>(name: impl Into<String>, rows: &[R]) -> Self {
        let columns = rows.first().map_or(0, |row| row.as_ref().len());
        let values = rows.iter().flat_map(|row| row.as_ref()).copied().collect();
        Self { name: name.into(), shape: vec![rows.len(), columns], values }
    }

    /// Returns a matrix whose columns have `length` numbers each.
    pub fn columns(name: impl Into<String>, length: usize, columns: &[&Vec<f64>]) -> Self {
        let row = |i: usize| columns.iter().map(move |column| column.get(i).copied().unwrap_or(f64::NAN));
        Self { name: name.into(), shape: vec![length, columns.len()], values: (0..length).flat_map(row).collect() }
    }

    /// Returns the array as an `.npy` file.
    fn to_npy(&self) -> Vec<u8> {
        let shape: String = self.shape.iter().map(|length| format!("{length}, ")).collect();
        let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape.trim_end());
        // Magic, version, length and header are padded to a multiple of 64 bytes, ending with a line break.
        let blanks = 64 - (10 + header.len() + 1) % 64;
        header.push_str(&" ".repeat(blanks % 64));
        header.push('\n');
        let mut file = b"\x93NUMPY\x01\x00".to_vec();
        file.extend((header.len() as u16).to_le_bytes());
        file.extend(header.as_bytes());
        file.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        file
    }
}

/// Returns the archive of some arrays. Names must differ.
pub fn npz(arrays: &[Array]) -> Vec<u8> {
    zip(arrays.iter().map(|array| (format!("{}.npy", array.name), array.to_npy())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;

    fn arrays() -> [Array; 3] {
        [
            Array::rows("modes", &[[1.5, -2.0, 0.1], [f64::MIN_POSITIVE, f64::NAN, 4.0]]),
            Array::list("singular_values", (0..40).map(f64::from).collect()),
            Array::rows::<Vec<f64>>("nothing", &[]),
        ]
    }

    /// Reads the entries from the directory at the end: names and contents.
    fn entries(file: &[u8]) -> Vec<(String, Vec<u8>)> {
        let word = |at: usize| usize::from(u16::from_le_bytes(file[at..at + 2].try_into().unwrap()));
        let long = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        let end = file.len() - 22;
        assert_eq!(&file[end..end + 4], b"PK\x05\x06");
        let mut at = long(end + 16);
        let mut found = Vec::new();
        for _ in 0..word(end + 10) {
            assert_eq!(&file[at..at + 4], b"PK\x01\x02");
            let (crc, size, name, entry) = (long(at + 16), long(at + 24), word(at + 28), long(at + 42));
            let title = String::from_utf8(file[at + 46..at + 46 + name].to_vec()).unwrap();
            assert_eq!(&file[entry..entry + 4], b"PK\x03\x04");
            let begin = entry + 30 + word(entry + 26) + word(entry + 28);
            let content = file[begin..begin + size].to_vec();
            assert_eq!(crc32fast::hash(&content) as usize, crc, "{title}");
            found.push((title, content));
            at += 46 + name;
        }
        assert_eq!(at, end);
        found
    }

    #[test]
    fn an_archive_holds_every_array_to_the_last_bit() {
        let found = entries(&npz(&arrays()));
        assert_eq!(found.len(), 3);
        for (array, (name, content)) in arrays().iter().zip(found) {
            assert_eq!(name, format!("{}.npy", array.name));
            assert_eq!(&content[..8], b"\x93NUMPY\x01\x00");
            let length = usize::from(u16::from_le_bytes([content[8], content[9]]));
            assert_eq!((10 + length) % 64, 0);
            let header = std::str::from_utf8(&content[10..10 + length]).unwrap();
            let shape: Vec<String> = array.shape.iter().map(|length| format!("{length},")).collect();
            assert!(header.contains(&format!("'shape': ({})", shape.join(" "))) && header.ends_with('\n'), "{header}");
            let values = content[10 + length..].chunks(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()));
            let same = |(a, b): (f64, &f64)| a.to_bits() == b.to_bits();
            assert_eq!(values.len(), array.values.len());
            assert!(values.zip(&array.values).all(same), "{name}");
        }
    }

    #[test]
    fn other_programs_read_it() {
        let path = std::env::temp_dir().join(format!("ehl-arrays-{}.npz", std::process::id()));
        std::fs::write(&path, npz(&arrays())).unwrap();
        // Python's zipfile module checks sizes and checksums, and numpy, if installed, the arrays.
        let program = "\
import sys, zipfile, ast\n\
with zipfile.ZipFile(sys.argv[1]) as archive:\n    \
    assert archive.testzip() is None\n    \
    head = archive.read('modes.npy')\n    \
    assert ast.literal_eval(head[10:128].decode().strip())['shape'] == (2, 3)\n\
try:\n    import numpy\nexcept ImportError:\n    sys.exit(0)\n\
arrays = numpy.load(sys.argv[1])\n\
assert arrays['modes'].shape == (2, 3) and arrays['modes'][0, 1] == -2.0\n\
assert (arrays['singular_values'] == numpy.arange(40.0)).all() and arrays['nothing'].size == 0\n";
        let run = Command::new("python3").args(["-c", program]).arg(&path).output();
        std::fs::remove_file(&path).unwrap();
        // Skipped if Python is not installed.
        if let Ok(run) = run {
            assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        }
    }
}
