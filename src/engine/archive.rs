//! Writes ZIP archives without compression.

/// Returns the ZIP archive of some files, each with its path inside, with slashes. Paths must differ. All files
/// together must have less than 4 GiB.
pub fn zip(files: impl IntoIterator<Item = (String, Vec<u8>)>) -> Vec<u8> {
    let mut archive = Vec::new();
    let (mut directory, mut count) = (Vec::new(), 0u16);
    for (name, content) in files {
        let (at, size) = (archive.len() as u32, content.len() as u32);
        // Fields shared by the local header and the directory entry: version 2.0, no flags, stored, 1 January 1980,
        // checksum, both sizes, length of the name, no extra field.
        let mut common = Vec::new();
        [20u16, 0, 0, 0, 0x21].iter().for_each(|word| common.extend(word.to_le_bytes()));
        [crc32fast::hash(&content), size, size].iter().for_each(|word| common.extend(word.to_le_bytes()));
        [name.len() as u16, 0].iter().for_each(|word| common.extend(word.to_le_bytes()));
        archive.extend(b"PK\x03\x04");
        archive.extend(&common);
        archive.extend(name.as_bytes());
        archive.extend(&content);
        directory.extend(b"PK\x01\x02");
        directory.extend(20u16.to_le_bytes());
        directory.extend(&common);
        // No comment, first disk, no attributes, offset of the local header.
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(name.as_bytes());
        count += 1;
    }
    let (begin, size) = (archive.len() as u32, directory.len() as u32);
    archive.extend(directory);
    archive.extend(b"PK\x05\x06");
    archive.extend([0; 4]);
    archive.extend([count, count].iter().flat_map(|count| count.to_le_bytes()));
    archive.extend(size.to_le_bytes());
    archive.extend(begin.to_le_bytes());
    archive.extend([0; 2]);
    archive
}
