//! One contact through every command and study: the same numbers, trust and warnings.

use crate::commands::{json, program};
use crate::common::scratch::Scratch;
use crate::common::six_contacts::Stated;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::Scene;
use serde_json::Value;

/// Answer of an interface for a contact: named numbers, NaN if it has none, and the warnings as one sentence.
type Said = (Vec<f64>, String);

const NAMES: [&str; 6] = ["H_c", "H_min", "traction", "reduced.trained", "reduced.h_c_error_bound", "hertz.p_h_pa"];

fn of_object(object: &Value) -> Said {
    let number = |name: &&str| {
        let value = name.split('.').fold(object, |object, name| &object[name]);
        value.as_bool().map(|truth| f64::from(u8::from(truth))).or(value.as_f64()).unwrap_or(f64::NAN)
    };
    (NAMES.iter().map(number).collect(), object["warning"].as_str().unwrap_or_default().to_owned())
}

/// Returns the first row of a table; `tag` precedes the names of results.
fn of_table(csv: &str, tag: &str) -> Said {
    let mut lines = csv.lines();
    let titles: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = lines.next().unwrap();
    // The warning is the last cell and may contain commas.
    let numbers: Vec<&str> = row.splitn(titles.len(), ',').collect();
    let (warning, numbers) = numbers.split_last().unwrap();
    let number = |name: &&str| {
        let known = |title: &&str| *title == format!("{tag}{name}") || *title == *name;
        let place = titles.iter().position(known).unwrap_or_else(|| panic!("{name} is no column of {titles:?}"));
        numbers[place].parse().unwrap_or(f64::NAN)
    };
    assert_eq!(titles.last(), Some(&"warning"));
    (NAMES.iter().map(number).collect(), warning.trim_matches('"').to_owned())
}

fn same(said: &Said, wanted: &Said, by: &str) {
    for ((name, a), b) in NAMES.iter().zip(&said.0).zip(&wanted.0) {
        assert!(a == b || a.is_nan() && b.is_nan(), "{by}: {name} is {a}, not {b}");
    }
    assert_eq!(said.1, wanted.1, "{by}");
}

#[test]
fn six_contacts_are_answered_alike_by_commands_and_studies() {
    let folder = Scratch::new("six-contacts");
    for contact in Stated::all() {
        let (name, options) = (contact.name(), contact.options());
        let with = |words: &[&str]| {
            let mut words: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
            words.extend(options.iter().cloned());
            program(&words.iter().map(String::as_str).collect::<Vec<_>>())
        };
        let solved = json(&with(&["solve", "--json", "--method", "reduced"]));
        let wanted = of_object(&solved);
        assert_eq!(solved["method"], "reduced", "{name}: {solved}");
        assert_eq!(solved["reduced"]["trained"], contact.trained(), "{name}: {solved}");
        let warnings = solved["warnings"].as_array().cloned().unwrap_or_default();
        let texts: Vec<&str> = warnings.iter().map(|warning| warning["text"].as_str().unwrap()).collect();
        assert_eq!(texts.join("; "), wanted.1, "{name}");
        let kinds: Vec<&str> = warnings.iter().map(|warning| warning["kind"].as_str().unwrap()).collect();
        assert_eq!(kinds.contains(&"outside_trained_range"), !contact.trained(), "{name}: {kinds:?}");
        assert!(contact.says().is_none_or(|words| texts[0].contains(words)), "{name}: {texts:?}");

        let srr = contact.srr();
        let varied = format!("srr={srr}:{srr}:1");
        let sweep = with(&["sweep", &varied, "--method", "reduced"]);
        same(&of_table(&String::from_utf8(sweep.stdout).unwrap(), ""), &wanted, &format!("{name}, sweep"));
        same(&of_object(&json(&with(&["sweep", &varied, "--method", "reduced", "--json"]))), &wanted, name);

        let table = folder.write("cases.csv", &contact.table()).to_str().unwrap().to_owned();
        let cases = ["cases", &table, "--method", "reduced"];
        let text = String::from_utf8(program(&cases).stdout).unwrap();
        same(&of_table(&text, "reduced."), &wanted, &format!("{name}, cases"));
        let rises = text.lines().next().unwrap().contains(",reduced.heat.mid_film_rise_k,");
        assert_eq!(rises, solved["heat"].is_object(), "{name}: {text}");
        same(&of_object(&json(&program(&[&cases[..], &["--json"]].concat()))), &wanted, name);

        let methods = "methods: [Reduced(model: Embedded)]";
        let studies = [
            format!("Point({methods})"),
            format!("Sweep(over: [(vary: SlideToRollRatio, values: List([{srr:?}]))], {methods})"),
        ];
        let [point, sweep] = studies.map(|study| {
            run_scene(&contact.scene(&study), &mut Workbench::new(""), &())
                .unwrap_or_else(|why| panic!("{name}: {why}"))
        });
        let value = |name: &&str| {
            point.found.values.iter().find(|value| value.name == *name).map_or(f64::NAN, |value| value.value)
        };
        let said = point.found.warnings.iter().filter_map(|notice| Some(notice.warning()?.to_string()));
        let said = said.collect::<Vec<_>>();
        same(&(NAMES.iter().map(value).collect(), said.join("; ")), &wanted, &format!("{name}, Point"));
        same(&of_table(&sweep.tables[0].to_csv(), "reduced."), &wanted, &format!("{name}, Sweep"));
        for warning in texts {
            assert!(
                sweep.found.warnings.iter().any(|said| said.to_string().ends_with(warning)),
                "{name}: {:?}",
                sweep.found.warnings
            );
        }
    }
}

#[test]
fn a_contact_that_makes_no_sense_refuses_its_own_row_of_a_study() {
    // At M = 1000 the pressure exceeds the limit of Doolittle's law.
    let study = "Sweep(over: [(vary: M, values: List([1000.0, 20.0]))], methods: [Reduced(model: Embedded)])";
    let lubricant = "viscosity: Doolittle(b: 4.2, r_0: 0.658, volume: (k_0: 1007837000.0, k_0_prime: 11.29)), \
                     density: Tait(k_0: 1007837000.0, k_0_prime: 11.29)";
    let at = "Moes(m: 20.0, l: 10.0, viscosity: 0.0705, modulus: 123.878213951e9)";
    let scene =
        |study: &str| format!("Scene(version: 1, title: \"far\", at: {at}, lubricant: ({lubricant}), study: {study})");
    let run = |text: &str| run_scene(&Scene::from_ron(text).unwrap(), &mut Workbench::new(""), &());
    let outcome = run(&scene(study)).unwrap();
    let text = outcome.tables[0].to_csv();
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[1].starts_with("1000,") && lines[1].contains(",refused,") && lines[1].contains("Doolittle"),
        "{text}"
    );
    assert!(lines[2].starts_with("20,") && lines[2].contains(",converged,"), "{text}");
    assert!(!outcome.found.converged && outcome.found.value("refused", None) == Some(1.0));
    let said = outcome.found.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert!(said.contains("1 of 2 contacts are refused, the first of them: ") && said.contains("Doolittle"), "{said}");
    // All contacts are invalid: the study is refused.
    let refused = run(&scene(&study.replace(", 20.0", ""))).unwrap_err().to_string();
    assert!(refused.contains("Doolittle"), "{refused}");
}

/// Returns named columns of a table with one method, from the first row.
fn row<'a>(csv: &'a str, tag: &str) -> impl Fn(&str) -> &'a str {
    let mut lines = csv.lines();
    let titles: Vec<&str> = lines.next().unwrap().split(',').collect();
    let cells: Vec<&str> = lines.next().unwrap().splitn(titles.len(), ',').collect();
    let tag = tag.to_owned();
    move |name| {
        let known = |title: &&str| *title == name || *title == format!("{tag}{name}");
        cells[titles.iter().position(known).unwrap_or_else(|| panic!("{name} is not in {titles:?}"))]
    }
}

#[test]
fn every_row_of_every_table_says_that_a_contact_is_far_outside() {
    let folder = Scratch::new("far-outside");
    let contact = ["--moes-l", "10", "--method", "reduced"];
    let solved = json(&program(&[&["solve", "--json", "--moes-m", "3000"][..], &contact].concat()));
    assert!(solved["hertz"]["p_h_pa"].as_f64().unwrap() > 15e9 && solved["converged"] == true, "{solved}");
    let told = |by: &str, trained: &str, warning: &str| {
        assert!(trained == "0" || trained == "false", "{by}: trained is {trained}");
        for part in ["M = 3000", "outside", "4.6 GPa"] {
            assert!(warning.contains(part), "{by}: {part} is not in {warning}");
        }
    };
    told("solve", &solved["reduced"]["trained"].to_string(), solved["warning"].as_str().unwrap());

    let varied = [&["sweep", "moes-m=3000:3000:1"][..], &contact].concat();
    let object = json(&program(&[&varied[..], &["--json"]].concat()));
    assert_eq!(object["warnings"], solved["warnings"]);
    let table = folder.write("cases.csv", "moes.M;moes.L\n3000;10\n");
    let cases = ["cases", table.to_str().unwrap(), "--method", "reduced"];
    for (by, arguments, tag) in [("sweep", &varied[..], ""), ("cases", &cases, "reduced.")] {
        let text = String::from_utf8(program(arguments).stdout).unwrap();
        let cell = row(&text, tag);
        told(by, cell("reduced.trained"), cell("warning"));
        assert_eq!((cell("moes.M").parse(), cell("moes.L").parse()), (Ok(3000.0), Ok(10.0)), "{by}");
    }

    let method = "Reduced(model: Embedded)";
    let range = "range: (axes: {M: (2999.99, 3000.01), L: (9.99, 10.01)}, limits: {HertzPressure: (0.0, 5e10)})";
    let studies = [
        format!("Sweep(over: [(vary: M, values: List([3000.0]))], methods: [{method}])"),
        format!("RandomTest({range}, tests: 2, seed: 1, method: {method})"),
    ];
    for study in studies {
        let scene = format!("Scene(version: 1, title: \"far\", at: Moes(m: 40.0, l: 10.0), study: {study})");
        let outcome = run_scene(&Scene::from_ron(&scene).unwrap(), &mut Workbench::new(""), &()).unwrap();
        let text = outcome.tables[0].to_csv();
        let cell = row(&text, "reduced.");
        told(&study, cell("reduced.trained"), cell("warning").replace("M = 2999", "M = 3000").as_str());
        assert!(
            outcome.found.warnings.iter().any(|said| said.to_string().contains("4.6 GPa")),
            "{:?}",
            outcome.found.warnings
        );
    }
}
