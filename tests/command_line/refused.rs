//! Refused requests, each with one sentence.

use crate::commands::{TABLE_2_1, assert_refused, program};
use crate::common::scratch::Scratch;

#[test]
fn bad_points_are_refused_with_one_sentence() {
    for bad in ["nan", "inf", "0", "-1", "1e30"] {
        for option in ["--radius", "--speed", "--load", "--modulus", "--viscosity", "--alpha"] {
            let mut arguments: Vec<&str> = [&["solve"], &TABLE_2_1[..]].concat();
            let place = arguments.iter().position(|&a| a == option).unwrap();
            arguments[place + 1] = bad;
            if option == "--alpha" && bad == "0" {
                // An isoviscous contact.
                continue;
            }
            assert_refused(&arguments, option.trim_start_matches('-'));
        }
        assert_refused(&["solve", "--moes-m", "40", "--moes-l", "10", "--viscosity", bad], "viscosity");
        assert_refused(&["solve", "--moes-m", bad, "--moes-l", "10"], "Moes number M");
        if bad != "0" {
            assert_refused(&["solve", "--moes-m", "10", "--moes-l", bad], "Moes number L");
        }
    }
}

#[test]
fn bad_options_are_refused_with_one_sentence() {
    let moes = ["solve", "--moes-m", "40", "--moes-l", "10"];
    for (more, words) in [
        (&["--contact", "point", "--dx", "0.5"][..], "hold the contact"),
        (&["--contact", "point", "--dy", "nan"], "ΔY"),
        (&["--contact", "point", "--dy", "thin"], "“thin” is no number; write it like 0.125"),
        (&["--contact", "point", "--dy", "0"], "ΔY"),
        (&["--u1", "100 rpm", "--u2", "1"], "needs the radius of the body"),
        (&["--viscosity", "1 mm"], "no unit of a viscosity"),
        (&["--oil", "ISO VG 68"], "needs a temperature"),
        (
            &["--oil", "68", "--temperature", "60", "--heat", "--inlet-temperature", "300"],
            "leave out --inlet-temperature",
        ),
        (&["--contact", "point", "--dx", "0.001", "--dy", "0.001"], "GB of memory"),
        (&["--contact", "point", "--domain=-4,0.5,-2"], "cuts the contact"),
        (&["--contact", "point", "--domain=-4,2,-0.5"], "cuts the contact"),
        (&["--contact", "point", "--grid", "model", "--dy", "0.05"], "--dy"),
        (&["--contact", "point", "--method", "reduced", "--dy", "0.05"], "own grid"),
        (&["--contact", "point", "--method", "reduced", "--rom", "assets/line.rom"], "of line contacts"),
        (&["--contact", "point", "--grid", "model", "--rom", "assets/line.rom"], "of line contacts"),
        (&["--method", "reduced", "--rom", "assets/point.rom"], "of point contacts"),
        (&["--contact", "sphere"], "point"),
        (&["--cavitation", "elrod"], "penalty"),
        (&["--density", "tait"], "squalane-pip"),
        (&["--pressure-viscosity", "doolittle"], "pao-650"),
        (&["--density", "foam"], "dowson-higginson"),
        (&["--lubricant", "squalane-pip", "--alpha", "2e-8"], "viscosity law"),
        (&["--lubricant", "honey"], "roelands-oil"),
        (&["--npr", "0.2"], "--npr"),
        (&["--alpha", "0"], "proportional"),
        (&["--u1", "1"], "give both"),
        (&["--u1", "1", "--u2", "-1"], "entrains no lubricant"),
        (&["--u1", "1", "--u2", "-1.25"], "SRR is 18"),
        (&["--u1", "1", "--u2", "2", "--srr", "0.1"], "give two of them"),
        (&["--srr", "nan"], "--srr"),
        (&["--dy", "0.1"], "--dy"),
        (&["--domain=-4,2,-2"], "--domain"),
        (&["--domain=4"], "--domain"),
        (&["--domain=-4,2,-2,1"], "the outer edge of a point contact"),
        (&["--domain=-4,1e-300"], "1e-300"),
        (&["--load", "-inf"], "--load is -inf, but must be a finite number"),
        (&["--npr", "1e-300"], "--npr is 1e-300,"),
        (&["--method", "reduced", "--rom", &"m".repeat(300)], "longer than the system accepts"),
        (&["--domain=-1,2"], "domain"),
        (&["--domain=nan,2"], "domain"),
        (&["--dx", "0"], "nodes"),
        (&["--dx", "nan"], "nodes"),
        (&["--dx", "1e-9"], "nodes"),
        (&["--grid", "graded", "--dx", "0.01"], "--dx"),
        (&["--grid", "hexagonal"], "uniform"),
        (&["--method", "reduced", "--dx", "0.01"], "--dx"),
        (&["--method", "reduced", "--grid", "uniform"], "--grid model"),
        (&["--rom", "x.rom"], "--rom"),
        (&["--method", "reduced", "--rom", "no/such.rom"], "no/such.rom"),
        (&["--e1", "2e11"], "--nu1"),
        (&["--speed", "1", "--load", "1e5", "--radius", "0.01"], "radius, speed and load"),
        (&["--profiles", "/no/such/folder/p.csv"], "/no/such/folder/p.csv"),
        (&["--wings", "2"], "--wings"),
        (&["--speed", "fast"], "fast"),
    ] {
        assert_refused(&[&moes[..], more].concat(), words);
    }
    assert_refused(&["solve"], "--radius");
    assert_refused(&["solve", "--moes-m", "3"], "--moes-l");
    assert_refused(&[&["solve"], &TABLE_2_1[..10]].concat(), "--alpha");
    assert_refused(&["fly"], "commands are solve");
    assert_refused(&["run"], "SCENE.ron");
    assert_refused(&["info", "no/such.rom"], "no/such.rom");
}

#[test]
fn bad_scenes_are_refused_with_one_sentence() {
    let folder = Scratch::new("bad-scenes");
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path.to_string_lossy().into_owned()
    };
    let unknown = write("unknown.ron", "Scene(\n  version: 1,\n  titel: \"x\",\n  study: Point(methods: [Full]),\n)");
    assert_refused(&["run", &unknown], "line 3");
    assert_refused(&[&unknown], "line 3");
    let newer = write("newer.ron", "Scene(version: 99, title: \"x\", dream: Deep(3))");
    assert_refused(&["run", &newer], "99");
    let good = write("good.ron", "Scene(version: 1, title: \"x\", study: Point(methods: [Reduced()]))");
    let no_model = "Scene(version: 1, title: \"x\", study: Point(methods: [Reduced(model: File(\"none.rom\"))]))";
    let no_model = write("no_model.ron", no_model);
    assert_refused(&["run", &good, &no_model], "no_model.ron: the reduced model");
    let loud = write("loud.ron", "Scene(version: 1, title: \"\\u{1b}[2J\", study: Point(methods: [Full]))");
    assert_refused(&["run", &loud], "control characters");
    let grid = "Training((title: \"x\", grid: Hexagonal, range: (axes: {Load: (1.0, 2.0)})))";
    let grid = write("grid.ron", &format!("Scene(version: 1, title: \"x\", study: {grid})"));
    let told = String::from_utf8(program(&["run", &grid]).stderr).unwrap();
    assert!(!told.contains("Written"), "{told}");
    let nan =
        write("nan.ron", "Scene(version: 1, title: \"x\", at: Moes(m: NaN, l: 1), study: Point(methods: [Full]))");
    assert_refused(&["run", &nan], "Moes number M");
    assert_refused(&["run", "no/such/scene.ron"], "no/such/scene.ron");
    let binary = folder.join("binary.ron");
    std::fs::write(&binary, [0u8, 159, 146, 150]).unwrap();
    assert_refused(&["run", &binary.to_string_lossy()], "UTF-8");
    let good = write("good.ron", "Scene(version: 1, title: \"x\", study: Point(methods: [Full]))");
    assert_refused(&["run", &good, "--out", "/proc/none"], "/proc/none");
    assert_refused(&["train", &good, "--out", "x.rom"], "Training");
}
