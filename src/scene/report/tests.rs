//! Content and form of reports.

use super::rows::measured;
use super::*;
use crate::scene::contact_spec::{ContactSpec, Field};
use crate::solver::physics::contact::FilmShape;
use crate::solver::physics::engineering::{QuantityKind as K, UnitSystem};

fn spec(fields: &[(Field, &str)]) -> ContactSpec {
    let texts = fields.iter().map(|(field, text)| (*field, *text, ""));
    ContactSpec::read_over(&ContactSpec::default(), texts).unwrap()
}

#[test]
fn numbers_have_units_that_engineers_write() {
    let texts = |system| {
        let lengths = [4.8387e-3, 2.54e-7, 0.012, 1.2e-9].map(|length| measured(K::Length, length, system));
        let others = [(K::Pressure, 1.1469e9), (K::Temperature, 343.15)];
        lengths.into_iter().chain(others.map(|(kind, si)| measured(kind, si, system))).collect::<Vec<_>>().join("; ")
    };
    assert_eq!(texts(UnitSystem::Engineering), "4.839 mm; 0.254 µm; 12 mm; 1.2 nm; 1.147 GPa; 70.0 °C");
    assert_eq!(texts(UnitSystem::Imperial), "0.1905 in; 10 µin; 0.4724 in; 0.04724 µin; 166.3 ksi; 158.0 °F");
}

#[test]
fn a_total_load_over_a_length_and_two_radii_give_the_contact() {
    let roller = [
        (Field::Radius1, "12 mm"),
        (Field::Radius2, "50 mm"),
        (Field::Length, "10 mm"),
        (Field::Load, "3.2 kN"),
        (Field::Speed, "3 m/s"),
        (Field::Modulus, "231 GPa"),
        (Field::Oil, "ISO VG 68"),
        (Field::Temperature, "70 °C"),
    ];
    let spec = spec(&roller);
    let request = spec.request().unwrap();
    assert!((request.point.load / 3.2e5 - 1.0).abs() < 1e-12);
    assert!((request.point.radius_m / (0.012 * 0.05 / 0.062) - 1.0).abs() < 1e-12);
    assert_eq!(request.extent.length_m, Some(0.01));
    let stated = Stated::of_spec("Roller", &spec, UnitSystem::default());
    assert_eq!((stated.oil.as_str(), stated.bodies[0].as_str()), ("ISO VG 68, mineral, at 70.0 °C", "radius 12 mm"));
    let without: Vec<_> = roller.into_iter().filter(|(field, _)| *field != Field::Length).collect();
    let refused = self::spec(&without).request().unwrap_err().in_words(crate::scene::Words::Keywords);
    assert!(refused.contains("length="), "{refused}");
}

#[test]
fn a_drawing_becomes_a_page_of_pdf() {
    let stated = Stated { title: "Roller".to_owned(), ..Stated::default() };
    let pdf = Report::new(&stated, &[], Paper::Letter).file(ReportFormat::Pdf);
    assert!(pdf.starts_with(b"%PDF-") && pdf.ends_with(b"%%EOF"), "{} bytes", pdf.len());
}

#[test]
fn elliptical_contacts_are_named_and_formats_follow_extensions() {
    let spec =
        spec(&[(Field::Contact, "point"), (Field::MoesM, "100"), (Field::MoesL, "8"), (Field::RadiusY, "30 mm")]);
    let point = spec.request().unwrap().point;
    assert_eq!(FilmShape::of(&point).name(), "elliptical contact");
    assert_eq!(ReportFormat::of(Path::new("a.PDF")), Some(ReportFormat::Pdf));
    assert_eq!(ReportFormat::of(Path::new("a.docx")), None);
}
