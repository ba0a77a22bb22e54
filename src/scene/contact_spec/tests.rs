//! Tests of fields and spellings, of refusals in each interface, and of combined specifications.

use super::*;
use crate::scene::{At, Grid, Scene, names};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant, ShearLaw};
use crate::solver::physics::surfaces::{AsperityLaw, Roughness};

const INTERFACES: [Words; 3] = [Words::Flags, Words::Keywords, Words::Columns];

/// Reads a contact from texts, as in a table.
fn stated(texts: &[(Field, &str)]) -> ContactSpec {
    ContactSpec::read_over(&ContactSpec::default(), texts.iter().map(|(field, text)| (*field, *text, ""))).unwrap()
}

fn moes(more: &[(Field, &str)]) -> ContactSpec {
    stated(&[&[(Field::MoesM, "40"), (Field::MoesL, "10")], more].concat())
}

#[test]
fn every_word_leads_back_to_its_field() {
    for &field in Field::ALL {
        let facts = field.facts();
        assert_eq!(Field::named(facts.name), Some(field));
        assert_eq!(Field::named(&facts.name.replace('-', "_")), Some(field));
        if Field::of(Words::Columns).any(|column| column == field) {
            for title in facts.titles.iter().chain([&facts.column, &&*names::of_field(field)]) {
                assert_eq!(Field::titled(title), Some(field), "{title}");
            }
        }
        for words in INTERFACES {
            let help = words.help(field);
            assert!(!help.is_empty() && !help.contains(['<', '>']), "{help}");
        }
    }
    assert_eq!(
        (Field::titled("method"), Field::titled("Modulus"), Field::named("colour")),
        (None, Some(Field::Modulus), None)
    );
    assert_eq!((Field::varied("L"), Field::varied("moes.L")), (Ok(Field::MoesL), Ok(Field::MoesL)));
    assert!(Field::varied("lubricant").unwrap_err().to_string().contains("accepted are radius, radius-y"));
}

#[test]
fn each_interface_names_its_own_words_in_a_refusal() {
    for (contact, field, sentences) in [
        (
            moes(&[(Field::Modulus, "-1 Pa")]),
            Field::Modulus,
            ["--modulus is -1 Pa, but must", "modulus= is -1 Pa, but must", "modulus is -1 Pa, but must"],
        ),
        (
            moes(&[(Field::Contact, "line"), (Field::RadiusY, "1 mm")]),
            Field::RadiusY,
            ["across (--radius-y):", "across (radius_y=):", "across (radius-y):"],
        ),
        (
            moes(&[(Field::SupplyFilm, "0.1 µm")]),
            Field::SupplyFilm,
            [
                "--supply-film needs --cavitation mass-conserving",
                "supply_film= needs cavitation=\"mass-conserving\"",
                "supply-film needs cavitation mass-conserving",
            ],
        ),
        (
            moes(&[(Field::Body1, "glass")]),
            Field::Body1,
            [
                "--body1 has no effect without --heat",
                "body1= has no effect without heat=True",
                "body1 has no effect without heat",
            ],
        ),
        (
            stated(&[(Field::MoesM, "40")]),
            Field::MoesL,
            ["--moes-m and --moes-l belong", "moes_m= and moes_l= belong", "M and L belong"],
        ),
        (
            stated(&[(Field::Speed, "1"), (Field::Modulus, "231 GPa")]),
            Field::Radius,
            [
                "give --radius, --load, --viscosity, --alpha too",
                "give radius=, load=, viscosity=, alpha= too",
                "give radius, load, viscosity, alpha too",
            ],
        ),
        (
            moes(&[(Field::E1, "210 GPa")]),
            Field::Nu1,
            ["need all of --e1, --nu1", "need all of e1=, nu1=", "need all of e1, nu1"],
        ),
        (
            moes(&[(Field::Shear, "eyring")]),
            Field::ShearStress,
            [
                "--shear eyring needs --shear-stress",
                "shear=\"eyring\" needs shear_stress=",
                "shear eyring needs shear-stress",
            ],
        ),
        (
            moes(&[(Field::Grid, "graded"), (Field::Dx, "0.01")]),
            Field::Dx,
            ["use --grid uniform", "use grid=\"uniform\"", "use grid uniform"],
        ),
        (
            moes(&[(Field::Npr, "0.2")]),
            Field::Npr,
            ["--npr is 0.2, but the", "npr= is 0.2, but the", "npr is 0.2, but the"],
        ),
    ] {
        let refusal = contact.request().unwrap_err();
        assert_eq!(refusal.field, field, "{refusal:?}");
        for (words, sentence) in INTERFACES.into_iter().zip(sentences) {
            let said = refusal.in_words(words);
            assert!(said.contains(sentence), "{said}");
        }
    }
    let unread = ContactSpec::default().read(Field::Contact, "cube", "").unwrap_err();
    assert_eq!(unread.in_words(Words::Keywords), "contact=: “cube” is not valid; accepted are line, point");
    let srr = ContactSpec { srr: Some(11.0), ..moes(&[]) }.request().unwrap_err();
    assert_eq!(srr.in_words(Words::Variables), "`srr` is 11, but must be a finite number between -10 and 10");
    // Text that is not a field is unchanged.
    assert_eq!(Words::Flags.spelled("a < b, <name>, <speed>"), "a < b, <name>, --speed");
}

#[test]
fn everything_that_flags_say_a_table_says_too() {
    let spec = stated(&[
        (Field::Contact, "point"),
        (Field::Radius, "10 mm"),
        (Field::RadiusY, "20 mm"),
        (Field::Speed, "2"),
        (Field::Load, "50"),
        (Field::E1, "210 GPa"),
        (Field::Nu1, "0.3"),
        (Field::E2, "81 GPa"),
        (Field::Nu2, "0.21"),
        (Field::Viscosity, "20 mPa·s"),
        (Field::Alpha, "20 1/GPa"),
        (Field::Srr, "5 %"),
        (Field::Shear, "eyring"),
        (Field::ShearStress, "5 MPa"),
        (Field::LimitingStress, "5e6,0.05"),
        (Field::Heat, "yes"),
        (Field::InletTemperature, "60 °C"),
        (Field::Body2, "glass"),
        (Field::ViscosityTemperature, "0.03 1/K"),
        (Field::Cavitation, "mass-conserving"),
        (Field::SupplyFilm, "0.2 µm"),
        (Field::Grid, "graded"),
        (Field::Dx, "0.05"),
        (Field::Domain, "-3,1.8,-1.6"),
    ]);
    let request = spec.request().unwrap();
    let heat = request.lubricant.heat.unwrap();
    assert_eq!(request.lubricant.shear, ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 });
    assert_eq!(request.lubricant.cavitation, Cavitation::MassConserving { supply_film_m: Some(2e-7) });
    assert_eq!(
        (heat.inlet_temperature, heat.oil.viscosity_temperature, heat.bodies[1].conductivity),
        (333.15, 0.03, 1.1)
    );
    assert_eq!((request.point.radius_y_m, request.point.sliding.slide_to_roll_ratio), (Some(0.02), 0.05));
    assert!(matches!(request.grid, Grid::Plane(plane) if plane.dx == 0.05 && plane.domain == (-3.0, 1.8, -1.6)));
    let text = serde_json::to_string(&spec).unwrap();
    assert_eq!(serde_json::from_str::<ContactSpec>(&text).unwrap(), spec, "{text}");
    assert!(serde_json::from_str::<ContactSpec>("{\"colour\": 1}").unwrap_err().to_string().contains("colour"));
}

#[test]
fn link_omits_what_equals_the_scene() {
    let heat = Heat { inlet_temperature: 333.0, ..Heat::default() };
    let scene =
        Scene { at: OperatingPoint::TABLE_2_1.into(), heat: Some(heat), srr: 0.3, ..Scene::at_moes(40.0, 10.0) };
    let base = ContactSpec::from(&scene.experiment());
    let over = |texts: &[(Field, &'static str)]| {
        let texts = texts.iter().map(|(field, text)| (*field, *text, ""));
        ContactSpec::read_over(&base, texts).unwrap().request()
    };
    let request = over(&[]).unwrap();
    assert_eq!(request.point, OperatingPoint { sliding: scene.sliding(), ..OperatingPoint::TABLE_2_1 });
    assert_eq!((request.lubricant, request.grid), (scene.laws(), Grid::Graded));
    // The scene's inlet temperature is kept if a line changes a body or the lubricant.
    let warm = over(&[(Field::Body1, "glass"), (Field::Lubricant, "mineral-oil")]).unwrap().lubricant.heat.unwrap();
    assert_eq!((warm.inlet_temperature, warm.bodies[0].conductivity), (333.0, 1.1));
    assert_eq!(over(&[(Field::Heat, "no")]).unwrap().lubricant.heat, None);
    let bodies = [(Field::E1, "206e9"), (Field::Nu1, "0.3"), (Field::E2, "206e9"), (Field::Nu2, "0.3")];
    assert!((over(&bodies).unwrap().point.modulus_pa / 226.373_626e9 - 1.0).abs() < 1e-6);
    assert!(matches!(over(&[(Field::Dx, "0.02")]).unwrap().grid, Grid::Uniform { dx: 0.02, .. }));
    let refused = over(&[(Field::Contact, "point")]).unwrap_err();
    assert_eq!((refused.field, refused.in_words(Words::Columns).contains("give load too")), (Field::Load, true));
    // The α of a lubricant that determines it replaces the scene's.
    let squalane = over(&[(Field::Lubricant, "squalane-pip")]).unwrap();
    assert_eq!(Some(squalane.point.alpha_per_pa), squalane.lubricant.own_coefficient());
    // M and L replace all SI quantities.
    let moes = over(&[(Field::MoesM, "40"), (Field::MoesL, "10")]).unwrap().point;
    assert_eq!(
        moes,
        OperatingPoint { sliding: scene.sliding(), ..At::moes(40.0, 10.0).point(ContactKind::Line).unwrap() }
    );
    assert_eq!(ContactSpec::default().lubricant().unwrap(), Lubricant::default());
}

#[test]
fn roughness_fields_are_read_and_set_complementarity() {
    let rough = moes(&[
        (Field::Roughness, "0.4 µm"),
        (Field::Asperities, "zhao-maietta-chang,0.05,0.01,5e9"),
        (Field::Peklenik, "3"),
        (Field::ShearFlow, "-0.5"),
        (Field::BoundaryFriction, "0.1"),
        (Field::WearRate, "1e-16"),
    ]);
    let lubricant = rough.request().unwrap().lubricant;
    let wanted = Roughness {
        sigma: 4e-7,
        asperities: AsperityLaw::ZhaoMaiettaChang { n_beta_sigma: 0.05, sigma_over_beta: 0.01, hardness: 5e9 },
        peklenik: 3.0,
        shear_flow: -0.5,
        boundary_friction: 0.1,
        wear_rate: 1e-16,
    };
    assert_eq!(lubricant.cavitation, Cavitation::Complementarity);
    let stated = lubricant.roughness.unwrap();
    assert!((stated.sigma / wanted.sigma - 1.0).abs() < 1e-14);
    assert_eq!(Roughness { sigma: wanted.sigma, ..stated }, wanted);
    let with = |field: Field, text: &'static str| {
        let mut spec = rough.clone();
        spec.read(field, text, "").unwrap();
        spec.request().unwrap_err()
    };
    for (field, text, said) in [
        (Field::Cavitation, "penalty", "--cavitation complementarity"),
        (Field::Cavitation, "mass-conserving", "--cavitation complementarity"),
        (Field::Roughness, "-1e-7", "between 0 and 0.001"),
        (Field::Peklenik, "12", "between 0.111"),
        (Field::Asperities, "zhao-maietta-chang,0.05,0.01,0", "the hardness in Pa is 0"),
        (Field::ShearFlow, "2", "between -1 and 1"),
        (Field::BoundaryFriction, "-1", "between 0 and 2"),
        (Field::WearRate, "-1", "the specific wear rate in m²/N is -1"),
    ] {
        let refusal = with(field, text);
        assert!(refusal.field == field && refusal.in_words(Words::Flags).contains(said), "{refusal:?}");
    }
    let warm = ContactSpec { heat: Some(true), ..rough.clone() }.request().unwrap().lubricant;
    assert!(warm.is_rough() && warm.heat.is_some());
    let smooth = ContactSpec { roughness: Some(0.0), ..rough.clone() }.request().unwrap().lubricant;
    assert!(!smooth.is_rough() && smooth.cavitation == Cavitation::Penalty);
    let without = ContactSpec { roughness: None, ..rough.clone() }.request().unwrap_err();
    assert!(without.in_words(Words::Keywords).contains("has no effect without roughness="), "{without:?}");
    assert!(ContactSpec::default().read(Field::Asperities, "cones,1", "").is_err());
    // A scene states the same, and a line of a table replaces its roughness.
    let at = OperatingPoint::TABLE_2_1.into();
    let scene = Scene { roughness: Some(wanted), at, ..Scene::at_moes(40.0, 10.0) };
    let again = Scene::from_ron(&scene.to_ron().unwrap()).unwrap();
    assert_eq!((again.laws(), again.roughness), (scene.laws(), Some(wanted)));
    let base = ContactSpec::from(&scene.experiment());
    assert_eq!(base.request().unwrap().lubricant, scene.laws());
    let other = ContactSpec::read_over(&base, [(Field::Roughness, "1e-7", "")]).unwrap().request().unwrap().lubricant;
    assert_eq!(other.roughness, Some(Roughness { sigma: 1e-7, ..wanted }));
}

#[test]
fn revolutions_and_degrees_celsius_are_converted_in_any_order() {
    let turning = [(Field::U1, "1500 rpm"), (Field::Radius1, "6 mm"), (Field::U2, "1 m/s"), (Field::Radius2, "-20 mm")];
    let own = stated(&turning);
    let wanted = 1500.0 * std::f64::consts::PI / 30.0 * 6e-3;
    assert!((own.u1.unwrap() / wanted - 1.0).abs() < 1e-12 && own.u2 == Some(1.0));
    // The radius may be that of the scene; it is not stated by the line.
    let line = ContactSpec::read_over(&own, [(Field::U1, "3000 rpm", ""), (Field::U2, "0.5", "")]).unwrap();
    assert!((line.u1.unwrap() / wanted - 2.0).abs() < 1e-12 && line.radius1 == Some(6e-3));
    let without = ContactSpec::read_over(&ContactSpec::default(), [(Field::U1, "100 rpm", "")]).unwrap_err();
    assert!(without.in_words(Words::Columns).contains("needs the radius"), "{without:?}");

    let mut warm = stated(&[(Field::Temperature, "70")]);
    assert_eq!(warm.temperature, Some(343.15));
    warm.set_as_typed(Field::Temperature, 40.0);
    warm.set_as_typed(Field::InletTemperature, 313.15);
    warm.set_as_typed(Field::Radius, 0.012);
    assert_eq!((warm.temperature, warm.inlet_temperature, warm.radius), (Some(313.15), Some(313.15), Some(0.012)));
}
