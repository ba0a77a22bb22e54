//! Tables of load cases: columns accept everything that `solve` accepts as flags.

use crate::commands::{json, program};
use crate::common::scratch::Scratch;
use serde_json::Value;

/// Runs a table with one line through `cases`, and `solve` with equal flags.
fn both(titles: &str, cells: &str) -> [Value; 2] {
    let folder = Scratch::new("load-cases");
    let path = folder.join("cases.csv");
    std::fs::write(&path, format!("{titles}\n{cells}\n")).unwrap();
    let table = json(&program(&["cases", &path.to_string_lossy(), "--json"]));
    let pairs = titles.split(';').zip(cells.split(';'));
    let flags = pairs.map(|(title, cell)| match (title, cell) {
        ("heat", _) => "--heat".to_owned(),
        (title, cell) => format!("--{title}={cell}"),
    });
    let flags: Vec<String> = flags.collect();
    let words: Vec<&str> = flags.iter().map(String::as_str).collect();
    [table, json(&program(&[&["solve", "--json"], &words[..]].concat()))]
}

#[test]
fn load_case_columns_equal_the_options() {
    let si = "radius;speed;load;viscosity;alpha;e1;nu1;e2;nu2";
    let contact = "0.01;2;3e5;0.02;1.8e-8;210e9;0.3;310e9;0.27";
    let thermal = "heat;srr;shear;shear-stress;limiting-stress;inlet-temperature;body2;oil-thermal;grid;domain";
    for (titles, cells, key) in [
        (thermal, "yes;0.5;eyring;6e6;4e6,0.06;333.15;glass;1900,0.12,880;graded;-10,2", "heat"),
        ("cavitation;supply-film;dx", "mass-conserving;2e-7;0.01", "supply_film_m"),
        ("lubricant;srr;dx", "mineral-oil;-0.1;0.01", "H_c"),
    ] {
        let [mut table, mut solved] = both(&format!("{si};{titles}"), &format!("{contact};{cells}"));
        for object in [&mut table, &mut solved] {
            let object = object.as_object_mut().unwrap();
            object.remove("wall_s");
            object.remove("line");
            assert!(object.contains_key(key) && object["converged"] == true, "{object:?}");
        }
        assert_eq!(table, solved, "{titles}");
    }
}

#[test]
fn a_refused_line_is_named_by_its_number_and_its_column() {
    let folder = Scratch::new("refused-cases");
    let path = folder.join("cases.csv");
    let text = "M;L;modulus;body1;supply-film\n40;10;-3 GPa;;\n40;10;;glass;\n40;10;;;0.1 µm\n";
    std::fs::write(&path, text).unwrap();
    let output = program(&["cases", &path.to_string_lossy()]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).unwrap();
    for sentence in [
        "line 2: modulus is -3000000000 Pa, but must be a finite number between 1e5 and 1e14 Pa",
        "line 3: body1 has no effect without heat; add it",
        "line 4: supply-film needs cavitation mass-conserving",
    ] {
        assert!(said.contains(sentence), "{said}");
    }
    assert!(!said.contains("--"), "{said}");
}
