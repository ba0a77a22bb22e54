//! The speed table: names, fields, plausible numbers, and a full solver much faster than the dense one. It has a
//! separate test program, so that no other test runs in parallel.

use serde_json::Value;
use std::process::Command;

const FIELDS: [&str; 6] = ["baseline", "median_s", "name", "p99_s", "ratio", "runs"];
const BASELINE: &str = "line/dense-newton";
const POINT_BASELINE: &str = "point/full/cold";
const TRANSIENT_BASELINE: &str = "line/transient/full-step";
const HEAT_BASELINE: &str = "line/heat/full/cold";

#[test]
#[cfg_attr(debug_assertions, ignore = "times mean nothing without optimisation")]
fn the_quick_speed_table_keeps_its_contract() {
    let output =
        Command::new(env!("CARGO_BIN_EXE_ehl-explorer")).args(["bench", "--json", "--quick"]).output().unwrap();
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{complaints}");
    assert!(complaints.is_empty(), "missing rows or failed solves: {complaints}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.lines().count(), 1, "{text}");
    let table: Value = serde_json::from_str(&text).unwrap();
    let names: Vec<&str> = table.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(names, ["rows"]);

    let rows = table["rows"].as_array().unwrap();
    for row in rows {
        let mut fields: Vec<&str> = row.as_object().unwrap().keys().map(String::as_str).collect();
        fields.sort_unstable();
        assert_eq!(fields, FIELDS, "{row}");
        let number = |field: &str| row[field].as_f64().filter(|value| value.is_finite() && *value > 0.0);
        let (median, p99) = (number("median_s").unwrap(), number("p99_s").unwrap());
        assert!(median <= p99 && number("ratio").is_some(), "{row}");
        assert!(row["runs"].as_u64().unwrap() >= 3, "{row}");
        let name = row["name"].as_str().unwrap();
        let baseline = match name {
            _ if name.starts_with("point/") => POINT_BASELINE,
            _ if name.starts_with("line/transient/") => TRANSIENT_BASELINE,
            _ if name.starts_with("line/heat/") => HEAT_BASELINE,
            _ => BASELINE,
        };
        assert_eq!(row["baseline"], baseline, "{name}");
    }
    let row =
        |name: &str| rows.iter().find(|row| row["name"] == name).unwrap_or_else(|| panic!("no row {name}: {text}"));
    let ratio = |name: &str| row(name)["ratio"].as_f64().unwrap();
    assert!((ratio(BASELINE) - 1.0).abs() < 1e-12);
    assert!((ratio(POINT_BASELINE) - 1.0).abs() < 1e-12 && ratio("point/full/warm") > 1.0);
    assert!(row(TRANSIENT_BASELINE)["median_s"].as_f64().unwrap() < row(BASELINE)["median_s"].as_f64().unwrap());
    assert!(ratio("line/heat/reduced") > 2.0);
    assert!(ratio("line/transient/rnsa-step") > 3.0);
    assert!(ratio("line/transient/local-step") > 5.0);
    assert!(ratio("line/transient/tpwl-step") > 3.0);
    for (name, least) in [("line/full/cold", 10.0), ("line/full/warm", 10.0), ("line/reduced", 100.0)] {
        assert!(ratio(name) >= least, "{name} is only {:.1} times faster than {BASELINE}", ratio(name));
        let quotient = row(BASELINE)["median_s"].as_f64().unwrap() / row(name)["median_s"].as_f64().unwrap();
        assert!((ratio(name) / quotient - 1.0).abs() < 1e-9, "{name}");
    }
}
