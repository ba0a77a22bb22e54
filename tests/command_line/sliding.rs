//! Sliding contacts with Eyring lubricants on the command line.

use crate::commands::{json, program};

const OIL: [&str; 6] = ["--shear", "eyring", "--shear-stress", "5e6", "--limiting-stress", "5e6,0.05"];

#[test]
fn shear_thinning_contacts_use_embedded_models() {
    for contact in ["line", "point"] {
        for srr in ["0.02", "0.6"] {
            let at = ["solve", "--json", "--contact", contact, "--moes-m", "60", "--moes-l", "7", "--srr", srr];
            let asked = [&at[..], &OIL].concat();
            let reduced = json(&program(&[&asked[..], &["--method", "reduced"]].concat()));
            assert_eq!((reduced.get("warning"), &reduced["reduced"]["trained"]), (None, &true.into()), "{contact}");
            let full = json(&program(&[&asked[..], &["--grid", "model"]].concat()));
            let value = |object: &serde_json::Value, name: &str| object[name].as_f64().unwrap();
            for (name, within) in [("H_c", 1e-2), ("H_min", 3e-2), ("traction", 2e-2)] {
                let error = (value(&reduced, name) / value(&full, name) - 1.0).abs();
                assert!(error < within, "{contact} at SRR {srr}: {name} is off by {error:e}");
            }
            let [bound, error] =
                [value(&reduced["reduced"], "h_c_error_bound"), value(&reduced, "H_c") / value(&full, "H_c") - 1.0];
            assert!(error.abs() < bound && bound < 0.05, "{contact} at SRR {srr}: {error:e} of {bound:e}");
        }
    }
}

#[test]
fn untrained_stress_and_shear_thinning_ellipse_are_reported() {
    let at = ["solve", "--json", "--method", "reduced", "--contact", "point", "--moes-m", "60", "--moes-l", "7"];
    for (stress, words) in [("5e5", "Eyring stress τ₀ = 0.5 MPa"), ("3e7", "Eyring stress τ₀ = 30 MPa")] {
        let other = json(&program(&[&at[..], &["--shear", "eyring", "--shear-stress", stress]].concat()));
        let told = other["warning"].as_str().unwrap();
        assert!(other["reduced"]["trained"] == false && told.contains(words), "{told}");
    }
    let ellipse = json(&program(&[&at[..], &OIL, &["--radius-y", "0.02"]].concat()));
    let told = ellipse["warning"].as_str().unwrap();
    assert!(ellipse["method"] == "full" && told.contains("circular contacts only"), "{told}");
}
