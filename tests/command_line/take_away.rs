//! Exported documents of the built program: a table of load cases, a sheet of one contact.

use crate::common::scratch::Scratch;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ehl-explorer")).args(arguments).output().unwrap()
}

fn objects(output: &Output) -> Vec<Value> {
    String::from_utf8_lossy(&output.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn written(folder: &Scratch, name: &str, text: &str) -> String {
    folder.write(name, text).to_str().unwrap().to_owned()
}

/// 200 contacts of rollers and a ball; lines 51, 101, 151 and 201 are invalid.
fn two_hundred() -> String {
    let mut table = String::from("name,contact,R [mm],u,w,modulus [GPa],viscosity,alpha [1/GPa],srr\n");
    for k in 0..200 {
        let (speed, load) = (f64::from(50 + 2 * k) / 100.0, 50 + k);
        let line = match k {
            49 => format!("case {k},line,12,{speed},-{load} N/mm,231,20 mPa·s,20,0.05"),
            99 => format!("case {k},line,12,{speed},{load} N/mm,231,20 mm,20,0.05"),
            149 => format!("case {k},line,,{speed},{load} N/mm,231,20 mPa·s,20,0.05"),
            199 => format!("case {k},cone,12,{speed},{load} N/mm,231,20 mPa·s,20,0.05"),
            57 => format!("case {k},ball,12.7,{speed},30,231,20 mPa·s,20,5 %"),
            _ => format!("case {k},line,12,{speed},{load} N/mm,231,20 mPa·s,20,5 %"),
        };
        writeln!(table, "{line}").unwrap();
    }
    table
}

#[test]
fn load_cases_agree_with_solve_or_are_refused() {
    let folder = Scratch::new("load-cases");
    let table = written(&folder, "cases.csv", &two_hundred());
    let out = folder.join("results.csv");
    let output = program(&["cases", &table, "--method", "full,reduced", "--csv", out.to_str().unwrap(), "--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for (line, reason) in [
        (51, "load is -"),
        (101, "“mm” is no unit of a viscosity"),
        (151, "give radius too"),
        (201, "“cone” is not valid"),
    ] {
        let named = said.lines().find(|said| said.contains(&format!("line {line} "))).unwrap_or_default();
        assert!(named.contains(reason), "{said}");
    }
    let objects = objects(&output);
    assert_eq!(objects.len(), 2 * 196 + 4);
    assert_eq!(objects.iter().filter(|object| !object["refused"].is_null()).count(), 4);
    for (k, contact, speed, load) in
        [(0, "line", "0.5", "50000"), (57, "point", "1.64", "30"), (198, "line", "4.46", "248000")]
    {
        for method in ["full", "reduced"] {
            let radius = if contact == "line" { "0.012" } else { "0.0127" };
            let options =
                ["--contact", contact, "--method", method, "--radius", radius, "--speed", speed, "--load", load];
            let oil = ["--modulus", "231e9", "--viscosity", "0.02", "--alpha", "20e-9", "--srr", "0.05"];
            let single = program(&[&["solve", "--json"], &options[..], &oil].concat());
            let mut wanted: Value = serde_json::from_slice(&single.stdout).unwrap();
            let is_it = |object: &&Value| object["line"] == k + 2 && object["method"] == wanted["method"];
            let all: Vec<&Value> = objects.iter().filter(is_it).collect();
            // If the full solver replaced the model, its result is the second one of that name.
            let mut got = (*if method == "full" { all.first() } else { all.last() }.unwrap()).clone();
            for object in [&mut got, &mut wanted] {
                let object = object.as_object_mut().unwrap();
                for name in ["wall_s", "line", "name"] {
                    object.remove(name);
                }
            }
            assert_eq!(got, wanted, "case {k}, {method}");
        }
    }
    let text = std::fs::read_to_string(&out).unwrap();
    assert_eq!(text.lines().count(), 201, "each line has its own in the results");
    assert!(text.lines().nth(50).unwrap().contains(",refused,\"load is -"), "{text}");
}

#[test]
fn a_table_that_is_none_is_refused() {
    let folder = Scratch::new("no-load-cases");
    for (text, reason) in [("", "is empty"), ("speed,laod\n1,2\n", "“laod” is unknown"), ("M,M\n1,2\n", "two columns")]
    {
        let table = written(&folder, "cases.csv", text);
        let output = program(&["cases", &table]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(reason) && said.lines().count() == 1, "{said}");
    }
    let output = program(&["cases", folder.join("none.csv").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn a_sheet_says_what_solve_says_in_three_formats() {
    let folder = Scratch::new("sheet");
    let contact = ["--moes-m", "40", "--moes-l", "10", "--srr", "0.05", "--lubricant", "mineral-oil", "--json"];
    let sheet = |name: &str| {
        let path = folder.join(name);
        let output = program(&[&["solve", "--sheet", path.to_str().unwrap()], &contact[..]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let result: Value = serde_json::from_slice(&output.stdout).unwrap();
        (std::fs::read_to_string(Path::new(&path)).unwrap(), result)
    };
    let (csv, result) = sheet("sheet.csv");
    for (name, value) in [
        ("Central film thickness h_c", &result["h_c_m"]),
        ("Hertzian pressure p_H", &result["hertz"]["p_h_pa"]),
        ("Friction coefficient µ", &result["traction"]),
        ("Entrainment speed u_m", &result["si"]["speed"]),
    ] {
        let line = csv.lines().find(|line| line.split(',').nth(1) == Some(name)).expect(name);
        assert_eq!(line.split(',').nth(2).unwrap().parse::<f64>().unwrap(), value.as_f64().unwrap(), "{name}");
    }
    let (markdown, _) = sheet("sheet.md");
    for (name, title) in
        [("sheet_pressure.svg", "Pressure"), ("sheet_film.svg", "Film"), ("sheet_regime.svg", "Regime")]
    {
        assert!(markdown.contains(&format!("![{title}](<{name}>)")), "{name}");
        let figure = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(figure.starts_with("<svg ") && figure.trim_end().ends_with("</svg>"), "{name}");
    }
    assert!(markdown.contains("| Regime | elastic, piezoviscous: "));
    assert!(markdown.contains("| Central film thickness h_c | ") && markdown.contains("## Published film formulas"));
    let (page, _) = sheet("sheet.html");
    assert!(page.contains("<svg ") && page.contains("Dowson–Toyoda") && page.trim_end().ends_with("</html>"));
    assert!(page.contains(&format!("ehl-explorer {}", env!("CARGO_PKG_VERSION"))));
    let output = program(&[&["solve", "--sheet", "sheet.docx"], &contact[..]].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("accepted are md, html, csv"));
}
