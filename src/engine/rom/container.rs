//! Container of a `.rom` file: a header, a directory in JSON, and independently encoded arrays. The format is described
//! in the manual (`assets/manual/model_file.md`).

use super::error::{ModelFileError, damaged};
use super::multiples;
use crate::engine::checked_file::{Flaw, Format, HEADER};
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::Multiples;
use faer::Mat;
use pco::ChunkConfig;
use pco::data_types::Number;
use pco::standalone::{simple_compress, simple_decompress_into};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::collections::BTreeMap;

/// Version of the format. Other versions are refused.
pub(super) const VERSION: u32 = 20;
/// Header of the file. The size limit is far above that of real models, which have a few MB.
pub(super) const FORMAT: Format = Format { magic: b"EHLROM\r\n", version: VERSION, max_payload: 512 << 20 };
/// Largest number of decoded bytes per byte of a file.
const MOST: usize = 64;
/// Number of bytes for the length of the directory.
const LENGTH: usize = 8;

/// Kind of the model in a `.rom` file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ModelKind {
    /// Steady contacts.
    Steady,
    /// Transient contacts.
    Transient,
}

/// Type of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Element {
    F64,
    F32,
    U32,
}

impl Element {
    fn bytes(self) -> usize {
        match self {
            Self::F64 => 8,
            Self::F32 | Self::U32 => 4,
        }
    }
}

/// Number type of arrays.
pub(super) trait Stored: Number + Default {
    const ELEMENT: Element;
}

impl Stored for f64 {
    const ELEMENT: Element = Element::F64;
}

impl Stored for f32 {
    const ELEMENT: Element = Element::F32;
}

impl Stored for u32 {
    const ELEMENT: Element = Element::U32;
}

/// Encoding of an array.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Codec {
    /// One standalone stream of pco. The last axis varies fastest.
    Pco,
    /// [`multiples`]: three such streams with their lengths in bytes. `across` is the number of nodes across the grid.
    Multiples { across: usize, parts: [usize; 3] },
}

/// Array in the directory. Offsets count from the end of the directory.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    #[serde(rename = "type")]
    element: Element,
    shape: Vec<usize>,
    codec: Codec,
    offset: usize,
    bytes: usize,
}

impl Entry {
    fn count(&self) -> Option<usize> {
        self.shape.iter().try_fold(1usize, |count, length| count.checked_mul(*length))
    }
}

/// Sections of the directory before the arrays.
pub(super) struct Heading<'a, D, M> {
    pub kind: ModelKind,
    pub contact: ContactKind,
    pub title: &'a str,
    /// Trained range.
    pub domain: &'a D,
    /// Everything else that is not an array.
    pub model: &'a M,
    pub scene: &'a str,
    pub log: &'a [String],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Directory<'a> {
    kind: ModelKind,
    contact: ContactKind,
    title: String,
    // Kept as text because the order of its axes matters.
    #[serde(borrow)]
    domain: &'a RawValue,
    #[serde(borrow)]
    model: &'a RawValue,
    scene: String,
    log: Vec<String>,
    arrays: BTreeMap<String, Entry>,
}

/// Collects arrays for a file.
#[derive(Default)]
pub(super) struct Writer {
    entries: Vec<(String, Entry)>,
    bytes: Vec<u8>,
}

impl Writer {
    fn add(&mut self, name: String, element: Element, shape: Vec<usize>, codec: Codec, parts: &[Vec<u8>]) {
        let (offset, bytes) = (self.bytes.len(), parts.iter().map(Vec::len).sum());
        parts.iter().for_each(|part| self.bytes.extend_from_slice(part));
        self.entries.push((name, Entry { element, shape, codec, offset, bytes }));
    }

    /// Adds an array. The last axis varies fastest. An empty array is left out. Returns `None` if it cannot be encoded.
    pub fn table<T: Stored>(&mut self, name: impl Into<String>, shape: &[usize], numbers: &[T]) -> Option<()> {
        if !numbers.is_empty() {
            let stream = simple_compress(numbers, &ChunkConfig::default()).ok()?;
            self.add(name.into(), T::ELEMENT, shape.to_vec(), Codec::Pco, &[stream]);
        }
        Some(())
    }

    /// Adds a list.
    pub fn list<T: Stored>(&mut self, name: impl Into<String>, numbers: &[T]) -> Option<()> {
        self.table(name, &[numbers.len()], numbers)
    }

    /// Adds a list of non-negative integers.
    pub fn indices(&mut self, name: impl Into<String>, indices: &[usize]) -> Option<()> {
        let indices = indices.iter().map(|index| u32::try_from(*index).ok());
        self.list(name, &indices.collect::<Option<Vec<u32>>>()?)
    }

    /// Adds a matrix without rounding.
    pub fn exact(&mut self, name: impl Into<String>, matrix: &Mat<f64>) -> Option<()> {
        let numbers: Vec<f64> = matrix.row_iter().flat_map(|row| row.iter().copied()).collect();
        self.table(name, &[matrix.nrows(), matrix.ncols()], &numbers)
    }

    /// Adds a matrix of fields over a grid with `across` nodes across, rounded by [`Multiples::keep`].
    pub fn rounded(
        &mut self,
        name: impl Into<String>,
        matrix: &Mat<f64>,
        across: usize,
        scales: &[f64],
        [accuracy, least]: [f64; 2],
    ) -> Option<()> {
        let (multiples, matrix) = Multiples::keep(matrix.clone(), scales, accuracy, least);
        let streams = multiples::encode(&matrix, across, &multiples)?;
        let parts = streams.each_ref().map(Vec::len);
        let shape = vec![matrix.nrows(), matrix.ncols()];
        self.add(name.into(), Element::F64, shape, Codec::Multiples { across, parts }, &streams);
        Some(())
    }

    /// Returns the content of the file, or `None` if something cannot be encoded.
    pub fn seal<D: Serialize, M: Serialize>(self, heading: &Heading<'_, D, M>) -> Option<Vec<u8>> {
        let Heading { kind, contact, title, domain, model, scene, log } = heading;
        let entry = |(name, entry): &(String, Entry)| Some(format!("  {}: {}", json(name)?, json(entry)?));
        let arrays = self.entries.iter().map(entry).collect::<Option<Vec<_>>>()?.join(",\n");
        let sections = [
            ("kind", json(kind)?),
            ("contact", json(contact)?),
            ("title", json(title)?),
            ("domain", json(domain)?),
            ("model", json(model)?),
            ("scene", json(scene)?),
            ("log", json(log)?),
            ("arrays", format!("{{\n{arrays}\n}}")),
        ];
        let sections = sections.map(|(name, text)| format!("\"{name}\": {text}"));
        let directory = format!("{{\n{}\n}}\n", sections.join(",\n"));
        let mut payload = (directory.len() as u64).to_le_bytes().to_vec();
        payload.extend_from_slice(directory.as_bytes());
        payload.extend_from_slice(&self.bytes);
        Some(FORMAT.seal(&payload))
    }
}

fn json<T: Serialize + ?Sized>(value: &T) -> Option<String> {
    serde_json::to_string(value).ok()
}

/// Returns the number of bytes of a file before its arrays.
#[cfg(any(test, not(feature = "models")))]
#[allow(clippy::indexing_slicing, reason = "at compile time, and in tests")]
pub(in crate::engine) const fn head_length(file: &[u8]) -> usize {
    let (mut length, mut digit) = (0usize, LENGTH);
    while digit > 0 {
        digit -= 1;
        length = length << 8 | file[HEADER + digit] as usize;
    }
    HEADER + LENGTH + length
}

/// Returns the bytes of a file before its arrays.
#[cfg(not(feature = "models"))]
#[allow(clippy::indexing_slicing, reason = "at compile time")]
pub(in crate::engine) const fn head<const N: usize>(file: &[u8]) -> [u8; N] {
    let (mut head, mut k) = ([0; N], 0);
    while k < N {
        head[k] = file[k];
        k += 1;
    }
    head
}

/// Splits a payload into the directory and the arrays.
fn directory(payload: &[u8]) -> Result<(Directory<'_>, &[u8]), ModelFileError> {
    let (length, rest) = payload.split_first_chunk::<LENGTH>().ok_or(damaged("its directory"))?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok().filter(|length| *length <= rest.len());
    let (directory, arrays) = rest.split_at(length.ok_or(damaged("its directory"))?);
    Ok((serde_json::from_slice(directory).map_err(|_| damaged("its directory"))?, arrays))
}

/// Directory of a file, and its arrays as bytes.
pub(super) struct Contents<'a> {
    directory: Directory<'a>,
    arrays: &'a [u8],
    /// Bytes of the payload.
    pub bytes: usize,
    /// True if matrices are left empty.
    outline: bool,
}

impl<'a> Contents<'a> {
    /// Opens the content of a file. Checks the hash and the memory that the arrays would need.
    ///
    /// # Errors
    /// If the file has another format or version, is truncated or damaged.
    pub fn open(bytes: &'a [u8]) -> Result<Self, ModelFileError> {
        Self::of_payload(FORMAT.open(bytes)?)
    }

    /// Opens the content of a file without checking the hash.
    pub fn unchecked(bytes: &'a [u8]) -> Result<Self, ModelFileError> {
        Self::of_payload(FORMAT.payload(bytes)?)
    }

    /// Opens the content of a file for an outline: matrices have no rows.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn outline(bytes: &'a [u8]) -> Result<Self, ModelFileError> {
        Ok(Self { outline: true, ..Self::open(bytes)? })
    }

    /// Returns true if matrices are left empty.
    pub fn is_outline(&self) -> bool {
        self.outline
    }

    /// Opens only the directory. The arrays may be missing.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn of_head(bytes: &'a [u8]) -> Result<Self, ModelFileError> {
        let (directory, arrays) = directory(bytes.get(HEADER..).unwrap_or_default())?;
        let announced = FORMAT.announced(bytes)?;
        let bytes = usize::try_from(announced).map_err(|_| Flaw::TooLarge { bytes: announced })?;
        Ok(Self { directory, arrays, bytes, outline: false })
    }

    fn of_payload(payload: &'a [u8]) -> Result<Self, ModelFileError> {
        let (directory, arrays) = directory(payload)?;
        let mut decoded = 0usize;
        for entry in directory.arrays.values() {
            let end = entry.offset.checked_add(entry.bytes).filter(|end| *end <= arrays.len());
            let count = entry.count().ok_or(damaged("its arrays"))?;
            decoded = decoded.saturating_add(count.saturating_mul(entry.element.bytes()));
            end.ok_or(damaged("its arrays"))?;
        }
        if decoded > payload.len().saturating_mul(MOST) {
            return Err(damaged("its arrays"));
        }
        Ok(Self { directory, arrays, bytes: payload.len(), outline: false })
    }

    /// Returns the kind of the model.
    pub fn kind(&self) -> ModelKind {
        self.directory.kind
    }

    /// Returns the contact kind.
    pub fn contact(&self) -> ContactKind {
        self.directory.contact
    }

    /// Returns title, scene and log. Control characters are removed from title and log, because they are printed on
    /// terminals.
    pub fn texts(&self) -> (String, String, Vec<String>) {
        let quiet = |text: &String| text.chars().filter(|letter| !letter.is_control()).collect();
        let Directory { title, scene, log, .. } = &self.directory;
        (quiet(title), scene.clone(), log.iter().map(quiet).collect())
    }

    /// Returns the trained range.
    pub fn domain<D: DeserializeOwned>(&self) -> Option<D> {
        serde_json::from_str(self.directory.domain.get()).ok()
    }

    /// Returns the section with all other data that are not arrays.
    pub fn model<M: DeserializeOwned>(&self) -> Option<M> {
        serde_json::from_str(self.directory.model.get()).ok()
    }

    /// Returns the shape of an array; `None` if there is no array with this name.
    pub fn shape(&self, name: &str) -> Option<&[usize]> {
        Some(&self.directory.arrays.get(name)?.shape)
    }

    /// Decodes an array. The last axis varies fastest. A missing array is empty. Returns `None` if it is damaged or has
    /// another type.
    pub fn list<T: Stored>(&self, name: &str) -> Option<Vec<T>> {
        let Some(entry) = self.directory.arrays.get(name) else { return Some(Vec::new()) };
        let fits = entry.element == T::ELEMENT && entry.codec == Codec::Pco;
        unpacked(self.bytes_of(entry).filter(|_| fits)?, entry.count()?)
    }

    /// Decodes an array of `f32` or `f64`. A missing array is empty. Returns `None` if it is damaged.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        match self.directory.arrays.get(name).map(|entry| entry.element) {
            Some(Element::F32) => Some(self.list::<f32>(name)?.into_iter().map(f64::from).collect()),
            _ => self.list(name),
        }
    }

    /// Decodes a list of non-negative integers.
    pub fn indices(&self, name: &str) -> Option<Vec<usize>> {
        Some(self.list::<u32>(name)?.into_iter().map(|index| index as usize).collect())
    }

    /// Decodes a matrix of finite numbers with this number of rows. In an outline it has its columns, but no rows.
    /// Returns `None` if it is damaged or missing.
    pub fn matrix(&self, name: &str, rows: usize) -> Option<Mat<f64>> {
        let entry = self.directory.arrays.get(name)?;
        let [own, columns] = entry.shape[..] else { return None };
        let bytes = self.bytes_of(entry).filter(|_| own == rows && entry.element == Element::F64)?;
        if self.outline {
            return Some(Mat::zeros(0, columns));
        }
        let matrix = match &entry.codec {
            Codec::Multiples { across, parts } => multiples::decode(bytes, parts, *across, (rows, columns))?,
            Codec::Pco => {
                let numbers: Vec<f64> = unpacked(bytes, entry.count()?)?;
                Mat::from_fn(rows, columns, |i, k| numbers.get(i * columns + k).copied().unwrap_or(f64::NAN))
            }
        };
        let finite = matrix.col_iter().all(|column| column.iter().all(|value| value.is_finite()));
        finite.then_some(matrix)
    }

    fn bytes_of(&self, entry: &Entry) -> Option<&'a [u8]> {
        self.arrays.get(entry.offset..)?.get(..entry.bytes)
    }
}

/// Decodes one stream. Returns `None` if it does not contain `count` numbers.
pub(super) fn unpacked<T: Number + Default>(stream: &[u8], count: usize) -> Option<Vec<T>> {
    let mut numbers = vec![T::default(); count];
    let read = simple_decompress_into(stream, &mut numbers).ok()?;
    (read.finished && read.n_processed == count).then_some(numbers)
}

impl From<Flaw> for ModelFileError {
    fn from(flaw: Flaw) -> Self {
        match flaw {
            Flaw::Foreign => Self::Foreign,
            Flaw::OtherVersion { found } => Self::OtherVersion { found },
            Flaw::Truncated { found, wanted } => Self::Truncated { found, wanted },
            Flaw::TooLarge { bytes } => Self::TooLarge { bytes },
            Flaw::Changed => damaged("its content does not match its hash"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sealed(writer: Writer) -> Vec<u8> {
        let heading = Heading {
            kind: ModelKind::Steady,
            contact: ContactKind::Point,
            title: "A \"title\"\u{7}",
            domain: &[1.0, 0.1 + 0.2, 1e-300],
            model: &(3, "three"),
            scene: "Scene(\n)",
            log: &["one".to_owned()],
        };
        writer.seal(&heading).unwrap()
    }

    fn filled() -> Writer {
        let mut writer = Writer::default();
        writer.table("table", &[2, 3], &[1.5f32, f32::NAN, 0.25, 7.0, -0.0, 1e-30]).unwrap();
        writer.indices("rows", &[3, 5, 70_000]).unwrap();
        writer.list::<f64>("nothing", &[]).unwrap();
        writer.exact("matrix", &Mat::from_fn(5, 2, |i, k| 0.1 * i as f64 - k as f64)).unwrap();
        writer
    }

    /// Returns a file with a changed directory.
    fn with(bytes: &[u8], change: impl FnOnce(String) -> String) -> Vec<u8> {
        let (length, rest) = FORMAT.open(bytes).unwrap().split_first_chunk::<LENGTH>().unwrap();
        let (directory, arrays) = rest.split_at(u64::from_le_bytes(*length) as usize);
        let directory = change(String::from_utf8(directory.to_vec()).unwrap());
        let length = (directory.len() as u64).to_le_bytes();
        FORMAT.seal(&[&length, directory.as_bytes(), arrays].concat())
    }

    #[test]
    fn arrays_and_sections_come_back_to_the_last_bit() {
        let bytes = sealed(filled());
        let contents = Contents::open(&bytes).unwrap();
        assert_eq!((contents.kind(), contents.contact()), (ModelKind::Steady, ContactKind::Point));
        assert_eq!(contents.texts(), ("A \"title\"".to_owned(), "Scene(\n)".to_owned(), vec!["one".to_owned()]));
        assert_eq!(contents.domain(), Some([1.0, 0.1 + 0.2, 1e-300]));
        assert_eq!(contents.model(), Some((3, "three".to_owned())));
        let table: Vec<f32> = contents.list("table").unwrap();
        assert!(table[1].is_nan() && table[4].to_bits() == (-0.0f32).to_bits() && table[5] == 1e-30);
        assert_eq!(contents.shape("table"), Some(&[2, 3][..]));
        assert_eq!(contents.indices("rows").unwrap(), [3, 5, 70_000]);
        assert_eq!((contents.shape("nothing"), contents.numbers("nothing")), (None, Some(Vec::new())));
        assert!(contents.matrix("matrix", 5).unwrap() == Mat::from_fn(5, 2, |i, k| 0.1 * i as f64 - k as f64));
        // Wrong type, wrong number of rows, missing matrix, values that are not finite.
        assert!(contents.list::<f64>("table").is_none() && contents.list::<f64>("rows").is_none());
        assert!(contents.matrix("matrix", 4).is_none() && contents.matrix("none", 0).is_none());
        assert!(contents.matrix("table", 2).is_none() && contents.matrix("rows", 3).is_none());
    }

    #[test]
    fn a_directory_that_asks_for_more_than_there_is_is_refused() {
        let bytes = sealed(filled());
        let damaged = |from: &str, to: &str| {
            let changed = with(&bytes, |text| {
                assert!(text.contains(from), "{from} in {text}");
                text.replacen(from, to, 1)
            });
            matches!(Contents::open(&changed), Err(ModelFileError::Damaged { .. }))
        };
        assert!(!damaged("three", "seven"));
        assert!(damaged("\"shape\":[2,3]", "\"shape\":[200000,300000]"));
        assert!(damaged("\"shape\":[2,3]", "\"shape\":[18446744073709551615,3]"));
        assert!(damaged("\"offset\":0", "\"offset\":1000000"));
        assert!(damaged("\"offset\":0", "\"offset\":18446744073709551615"));
        assert!(damaged("\"kind\"", "\"sort\"") && damaged("\"f32\"", "\"f16\"") && damaged("{", ""));
        let short = FORMAT.seal(&[0; 7]);
        assert!(matches!(Contents::open(&short), Err(ModelFileError::Damaged { .. })));
        let long = FORMAT.seal(&[0xff; 40]);
        assert!(matches!(Contents::open(&long), Err(ModelFileError::Damaged { .. })));
    }
}
