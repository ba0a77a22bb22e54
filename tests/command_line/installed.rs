//! The installed program, outside its source tree.

use crate::common::scratch::Scratch;
use std::path::Path;
use std::process::{Command, Output};

/// Runs `export fmu` for an embedded model by a copy of the program in a separate folder, in an empty folder.
fn export(program: &Path, folder: &Path, model: &str, options: &[&str]) -> Output {
    let export = ["export", "fmu", model, "--out", "contact.fmu"];
    Command::new(program).args(export).args(options).current_dir(folder).env_clear().output().unwrap()
}

#[test]
fn units_are_exported_by_an_installed_program() {
    let prefix = Scratch::new("installed");
    let folders = ["bin", "lib/ehl-explorer", "work"].map(|name| prefix.join(name));
    folders.iter().for_each(|folder| std::fs::create_dir_all(folder).unwrap());
    let [bin, lib, work] = folders;
    let program = bin.join("ehl-explorer");
    std::fs::copy(env!("CARGO_BIN_EXE_ehl-explorer"), &program).unwrap();

    let none = export(&program, &work, "line", &[]);
    let said = String::from_utf8(none.stderr).unwrap();
    assert_eq!((none.status.code(), said.lines().count()), (Some(2), 1), "{said}");
    let [beside, installed] = [&bin, &lib].map(|folder| std::fs::canonicalize(folder).unwrap().display().to_string());
    for part in [&*beside, &*installed, "Debian package", "cargo build", "--library"] {
        assert!(said.contains(part), "{part} is not in {said}");
    }
    assert_eq!(std::fs::read_dir(&work).unwrap().count(), 0);

    let library = format!("{}ehl_contact{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    std::fs::write(lib.join(library), "the library of the units").unwrap();
    let versions: [(&[&str], &str); 3] =
        [(&[], "fmiVersion=\"2.0\""), (&["--fmi", "2"], "fmiVersion=\"2.0\""), (&["--fmi", "3"], "fmiVersion=\"3.0\"")];
    for (model, (options, version)) in [("line", versions[0]), ("point", versions[1]), ("line_in_time", versions[2])] {
        let done = export(&program, &work, model, options);
        assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
        let unit = std::fs::read(work.join("contact.fmu")).unwrap();
        for part in ["modelDescription.xml", "resources/model.rom", "the library of the units", version] {
            assert!(unit.windows(part.len()).any(|bytes| bytes == part.as_bytes()), "{model}: {part}");
        }
    }
    let unknown = export(&program, &work, "no_such_model", &[]);
    assert_eq!(unknown.status.code(), Some(2));
    let newer = export(&program, &work, "line", &["--fmi", "4"]);
    let said = String::from_utf8(newer.stderr).unwrap();
    assert_eq!((newer.status.code(), said.lines().count()), (Some(2), 1), "{said}");
    assert!(said.contains("accepted are 2 and 3"), "{said}");
}
