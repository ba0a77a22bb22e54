use super::container::{VERSION, head_length};
use super::{Catalogue, ModelFileError, ModelKind, SavedModel};
use crate::engine::checked_file::HEADER;
use crate::engine::model_file::{from_bytes, to_bytes, write};
use crate::engine::{bytes_of, catalogue, embedded, in_time as in_time_of};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, Moes};
use crate::solver::physics::lubricant::{Cavitation, ShearLaw};
use crate::solver::reduced::{Online, PressureModes, ReducedModel, ReducedOptions, Sampling, Scheme, Window};
use crate::solver::training::small::{
    ellipses, heated_balls, heated_bounded, heated_ellipses_bounded, heated_oils_bounded, line, oils, oils_of_points,
    rough_bounded, rough_oils_of_points, sliding_oils, trained, with_ends,
};
use crate::solver::training::{TrainingSpec, WindowSpec, Windows, random_points, train};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// `EHL_WRITE_MODELS=FOLDER cargo test --release --lib the_models_of_the_program` writes the embedded models in the
/// current format. Use it after a change of the format, together with a reader of the previous format.
#[test]
fn embedded_models_survive_a_round_trip() {
    let folder = std::env::var_os("EHL_WRITE_MODELS").map(PathBuf::from);
    let steady = catalogue().iter().map(|entry| {
        let model = embedded(entry.name).unwrap();
        assert!(!model.windows.is_empty() && model.domain == entry.domain, "{}", entry.name);
        (entry.name, SavedModel::Stationary(model))
    });
    let in_time = [("line_in_time", ContactKind::Line), ("point_in_time", ContactKind::Point)];
    let in_time = in_time.map(|(name, kind)| (name, SavedModel::InTime(in_time_of(kind).unwrap())));
    for (name, model) in steady.chain(in_time) {
        // Together with this check, it is the same as reading a model's file.
        model.prove(&()).unwrap_or_else(|why| panic!("{name}: {why}"));
        let bytes = model.to_bytes().unwrap();
        match &folder {
            Some(folder) => std::fs::write(folder.join(format!("{name}.rom")), bytes).unwrap(),
            None => assert!(bytes == *bytes_of(name).unwrap(), "{name} is saved as another file"),
        }
    }
}

#[test]
fn damage_is_named_and_never_panics() {
    assert!(matches!(from_bytes(b"PNG something else entirely"), Err(ModelFileError::Foreign)));
    assert!(matches!(from_bytes(&[]), Err(ModelFileError::Foreign)));
    let line = bytes_of("line").unwrap();
    assert!(matches!(from_bytes(&line[..10]), Err(ModelFileError::Truncated { .. })));
    assert!(matches!(from_bytes(&line[..line.len() - 9]), Err(ModelFileError::Truncated { .. })));
    let mut flipped = line.to_vec();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 0x40;
    assert!(matches!(from_bytes(&flipped), Err(ModelFileError::Damaged { .. })));
    let mut huge = line.to_vec();
    huge[12..20].copy_from_slice(&u64::MAX.to_le_bytes());
    assert!(matches!(from_bytes(&huge), Err(ModelFileError::TooLarge { .. })));
    for version in [VERSION - 1, VERSION + 1, 1 << 16] {
        let mut bytes = bytes_of("line_shear").unwrap().to_vec();
        bytes[8..12].copy_from_slice(&version.to_le_bytes());
        assert!(matches!(from_bytes(&bytes), Err(ModelFileError::OtherVersion { found }) if found == version));
    }
}

#[test]
fn the_hash_covers_the_whole_file() {
    let model = embedded("line_shear").unwrap();
    let bytes = to_bytes(&model).unwrap();
    for place in (8..HEADER).chain([HEADER + 7]) {
        let mut changed = bytes.clone();
        changed[place] ^= 1;
        assert!(from_bytes(&changed).is_err(), "byte {place}");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(from_bytes(&longer), Err(ModelFileError::Damaged { .. })));
}

/// Change that makes a model invalid, and the expected error.
type Lie<'a> = (&'a dyn Fn(&mut ReducedModel), &'a str);

/// Changes an interval of a model's trained range.
fn lie_about(model: &mut ReducedModel, quantity: Quantity, ends: (f64, f64)) {
    model.domain.space = with_ends(&model.domain.space, quantity, ends);
}

#[test]
fn a_payload_that_lies_is_refused_even_with_a_right_hash() {
    let spec = line(Sampling::QDeim, 16);
    let (low, high) = spec.domain().m();
    let middle = (low * high).sqrt();
    let window = |m| WindowSpec::new(m, GridSpec::Graded { nodes: 240, domain: (-8.0, 3.2), registered: true });
    let windows = Windows::Given(vec![window((low, middle)), window((middle, high))]);
    let model = train(&TrainingSpec { windows, ..spec }, &()).unwrap();
    let refused = |spoil: &dyn Fn(&mut ReducedModel)| {
        let mut wrong = model.clone();
        spoil(&mut wrong);
        from_bytes(&to_bytes(&wrong).unwrap()).err()
    };
    let lies: [&dyn Fn(&mut ReducedModel); 9] = [
        &|m| *m.windows[0].sampled_rows.last_mut().unwrap() = 1_000_000,
        &|m| m.windows[1].snapshots[0].h_c = f64::NAN,
        &|m| m.windows[1].snapshots.truncate(3),
        &|m| m.windows[0].m = (7.0, 4.0),
        &|m| m.windows.swap(0, 1),
        &|m| lie_about(m, Quantity::Load, (f64::NAN, 4e5)),
        &|m| lie_about(m, Quantity::Speed, (500.0, 2.0)),
        &|m| lie_about(m, Quantity::HertzPressure, (0.0, f64::INFINITY)),
        &|m| m.domain.space.fixed[1] = (Quantity::Viscosity, -1.0),
    ];
    for (k, lie) in lies.iter().enumerate() {
        assert!(matches!(refused(lie), Some(ModelFileError::Damaged { .. })), "lie {k}");
    }
    // Parts that are consistent in shape but belong to different models.
    let other = refused(&|m| {
        m.windows[0].reconstruction *= faer::Scale(-1.0);
        m.windows[0].snapshots.iter_mut().for_each(|snapshot| snapshot.h_c *= 2.0);
    });
    assert!(matches!(other, Some(ModelFileError::Unproven { .. })), "{other:?}");
    let mut loud = model.clone();
    loud.title.push_str("\u{1b}[2J");
    loud.log.push("a\u{7}b".to_owned());
    let quiet = from_bytes(&to_bytes(&loud).unwrap()).unwrap();
    assert!(quiet.title == format!("{}[2J", model.title) && quiet.log.last().unwrap() == "ab");
}

#[test]
fn rupture_law_and_scheme_survive_a_round_trip() {
    for spec in [line(Sampling::QDeim, 50), sliding_oils(Sampling::QDeim, 60)] {
        let model = ReducedModel::clone(&trained(&spec.under(Cavitation::Complementarity)));
        let read = from_bytes(&to_bytes(&model).unwrap()).unwrap();
        let (own, other) = (&read.windows[0], &model.windows[0]);
        assert_eq!((read.domain, own.cavitation), (model.domain.clone(), Cavitation::Complementarity));
        assert!(own.snapshots.iter().map(|s| &s.fronts).eq(other.snapshots.iter().map(|s| &s.fronts)));
        let lies: [&dyn Fn(&mut ReducedModel); 2] =
            [&|m| m.windows[0].snapshots[3].fronts[0] = 10_000, &|m| m.windows[0].snapshots[3].fronts.clear()];
        for lie in lies {
            let mut wrong = model.clone();
            lie(&mut wrong);
            let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
            assert!(matches!(refused, Some(ModelFileError::Damaged { what: "cavitation" })), "{refused:?}");
        }
    }
    let scheme = Scheme::Gnat { weighted: true };
    let model = train(&TrainingSpec { scheme, ..line(Sampling::QDeim, 24) }, &()).unwrap();
    let own = &from_bytes(&to_bytes(&model).unwrap()).unwrap().windows[0];
    assert_eq!(own.scheme, scheme);
    assert!(own.residual_reconstruction == model.windows[0].residual_reconstruction);
    let mut wrong = model;
    wrong.windows[0].residual_reconstruction = None;
    let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
    assert!(matches!(refused, Some(ModelFileError::Damaged { what: "scheme" })), "{refused:?}");
}

#[test]
fn shapes_survive_a_round_trip_and_must_fit_the_windows() {
    let model = ReducedModel::clone(&trained(&ellipses(Sampling::Cubature, 60)));
    let read = from_bytes(&to_bytes(&model).unwrap()).unwrap();
    assert_eq!(read.domain, model.domain);
    for (own, other) in read.windows.iter().zip(&model.windows) {
        let [one, two] = [own, other].map(|window| window.shapes.as_ref().map(|shapes| shapes.ratios));
        assert!(one == two && one.is_some());
        for (own, other) in own.snapshots.iter().zip(&other.snapshots) {
            assert_eq!(own.point.radius_y_m, other.point.radius_y_m);
            assert!((own.point.load / other.point.load - 1.0).abs() < 1e-5);
        }
    }
    let lies: [Lie; 3] = [
        (&|m| lie_about(m, Quantity::RadiusRatio, (0.5, f64::NAN)), "its domain"),
        (&|m| lie_about(m, Quantity::RadiusRatio, (4.0, 0.5)), "its domain"),
        (&|m| m.windows[0].snapshots[3].point.radius_y_m = Some(-1.0), "snapshots"),
    ];
    for (lie, wanted) in lies {
        let mut wrong = model.clone();
        lie(&mut wrong);
        let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
        assert!(matches!(refused, Some(ModelFileError::Damaged { what }) if what == wanted), "{refused:?}");
    }
}

#[test]
fn heat_survives_a_round_trip_and_must_fit_the_windows() {
    let model = ReducedModel::clone(&trained(&heated_bounded()));
    let read = from_bytes(&to_bytes(&model).unwrap()).unwrap();
    assert_eq!(read.domain, model.domain);
    assert!(read.domain.heats() && read.domain.space.slides());
    assert_eq!(read.windows[0].traction, model.windows[0].traction);
    let lies: [&dyn Fn(&mut ReducedModel); 4] = [
        &|m| lie_about(m, Quantity::SlideToRollRatio, (0.5, 2.5)),
        &|m| m.domain.space.fixed[0] = (Quantity::Radius, f64::NAN),
        &|m| m.domain.lubricant.heat.iter_mut().for_each(|heat| heat.inlet_temperature = -1.0),
        &|m| m.domain.lubricant.heat.iter_mut().for_each(|heat| heat.oil.conductivity = f64::INFINITY),
    ];
    for lie in lies {
        let mut wrong = model.clone();
        lie(&mut wrong);
        let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
        assert!(matches!(refused, Some(ModelFileError::Damaged { what: "its domain" })), "{refused:?}");
    }
}

#[test]
fn rough_surfaces_survive_a_round_trip_with_their_bounds() {
    for spec in [rough_bounded(), rough_oils_of_points()] {
        let model = trained(&spec);
        let bytes = to_bytes(&model).unwrap();
        let read = Arc::new(from_bytes(&bytes).unwrap());
        assert!(read.domain == model.domain && read.domain.is_rough() && to_bytes(&read).unwrap() == bytes);
        assert_eq!(read.domain.lubricant.roughness, spec.lubricant.roughness);
        let (own, lines) = (&read.windows[0], read.windows[0].grid.lines());
        assert!(own.snapshots.iter().all(|snapshot| snapshot.fronts.len() == lines));
        assert_eq!(own.anchor.is_some(), spec.range.varies_lubricant());
        let point = random_points(&spec.range, spec.contact(), 1, 7)[0];
        let solved = |model: &Arc<ReducedModel>| {
            Online::new(Arc::clone(model), ReducedOptions::default()).solve(&point, spec.lubricant).unwrap()
        };
        let (own, again) = (solved(&model), solved(&read));
        assert!((own.h_c / again.h_c - 1.0).abs() < 1e-6, "{} {}", own.h_c, again.h_c);
        assert!(again.error.unwrap().load_share.is_some());
        let lies: [Lie<'_>; 3] = [
            (&|m| lie_about(m, Quantity::SmoothFilmRatio, (f64::NAN, 2.0)), "its domain"),
            (&|m| m.domain.lubricant.roughness.iter_mut().for_each(|rough| rough.sigma = -1.0), "its domain"),
            // Either all local models have anchors, or none has.
            (&|m| m.windows.extend(m.windows.last().map(|w| Window { anchor: other_anchor(w), ..w.clone() })), "oils"),
        ];
        for (lie, wanted) in lies {
            let mut wrong = ReducedModel::clone(&model);
            lie(&mut wrong);
            let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
            assert!(matches!(refused, Some(ModelFileError::Damaged { what }) if what == wanted), "{refused:?}");
        }
    }
}

/// Returns an anchor for a local model without one, and none for others.
fn other_anchor(window: &Window) -> Option<Moes> {
    window.anchor.is_none().then_some(Moes { m: 20.0, l: 8.0 })
}

#[test]
fn heat_of_many_oils_survives_a_round_trip_too() {
    let model = ReducedModel::clone(&trained(&heated_oils_bounded()));
    let bytes = to_bytes(&model).unwrap();
    let read = from_bytes(&bytes).unwrap();
    assert!(read.domain == model.domain && read.domain.heats() && read.domain.space.varies_lubricant());
    assert!(read.windows.iter().map(|w| w.anchor).eq(model.windows.iter().map(|w| w.anchor)));
    assert_eq!(to_bytes(&read).unwrap(), bytes);
    assert_eq!(read.domain.space.constants.len(), 10);
    let lies = [
        (Quantity::Effusivity1, (f64::NAN, 1e4)),
        (Quantity::Radius, (0.2, 0.1)),
        (Quantity::Speed, (f64::NAN, 3.0)),
        (Quantity::Modulus, (0.0, 2e11)),
    ];
    for (quantity, ends) in lies {
        let mut wrong = model.clone();
        lie_about(&mut wrong, quantity, ends);
        let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
        assert!(matches!(refused, Some(ModelFileError::Damaged { what: "its domain" })), "{refused:?}");
    }
}

#[test]
fn heat_of_balls_survives_a_round_trip_too() {
    let model = trained(&heated_balls(Sampling::Cubature, 24));
    let read = from_bytes(&to_bytes(&model).unwrap()).unwrap();
    assert!(read.domain == model.domain && read.contact() == ContactKind::Point && read.domain.heats());
    assert!(read.windows[0].traction.is_some() && read.windows[0].traction == model.windows[0].traction);
}

#[test]
fn heat_of_ellipses_of_many_oils_survives_a_round_trip_too() {
    let model = ReducedModel::clone(&trained(&heated_ellipses_bounded()));
    let bytes = to_bytes(&model).unwrap();
    let read = from_bytes(&bytes).unwrap();
    assert!(read.domain == model.domain && read.of_ellipses() && to_bytes(&read).unwrap() == bytes);
    let window = &read.windows[0];
    assert!(window.shapes.is_some() && window.anchor == model.windows[0].anchor && window.traction.is_some());
    assert!(window.snapshots.iter().any(|snapshot| snapshot.point.radius_ratio() > 2.0));
}

#[test]
fn oils_that_thin_survive_a_round_trip_with_their_stresses() {
    let model = ReducedModel::clone(&trained(&sliding_oils(Sampling::QDeim, 60)));
    let bytes = to_bytes(&model).unwrap();
    let read = from_bytes(&bytes).unwrap();
    assert!(read.domain == model.domain && read.domain.is_shear_thinning() && read.domain.space.varies_lubricant());
    assert!(read.windows.iter().all(|window| window.metric == model.windows[0].metric
        && window.anchor.is_some()
        && window.traction.is_some()));
    assert_eq!(to_bytes(&read).unwrap(), bytes);
    let lies = [
        (Quantity::SlideToRollRatio, (0.5, 0.2)),
        (Quantity::Modulus, (0.0, 2e11)),
        (Quantity::LimitSlope, (f64::NAN, 0.1)),
        (Quantity::GradientStress, (0.0, f64::INFINITY)),
    ];
    let mut wrong: Vec<ReducedModel> = lies.iter().map(|_| model.clone()).collect();
    wrong.iter_mut().zip(lies).for_each(|(wrong, (quantity, ends))| lie_about(wrong, quantity, ends));
    let mut newtonian = model.clone();
    newtonian.domain.lubricant.shear = ShearLaw::Newtonian;
    for wrong in wrong.into_iter().chain([newtonian]) {
        let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
        assert!(matches!(refused, Some(ModelFileError::Damaged { what: "its domain" })), "{refused:?}");
    }
}

#[test]
fn oils_and_anchors_survive_a_round_trip() {
    let model = ReducedModel::clone(&trained(&oils(Sampling::QDeim, 60).under(Cavitation::Complementarity)));
    let read = from_bytes(&to_bytes(&model).unwrap()).unwrap();
    assert_eq!(read.domain, model.domain);
    assert!(read.windows.iter().map(|w| w.anchor).eq(model.windows.iter().map(|w| w.anchor)));
    // Starting values are rounded before error bounds are measured.
    for (read, own) in read.windows.iter().zip(&model.windows) {
        for (read, own) in read.snapshots.iter().zip(&own.snapshots) {
            assert_eq!((&read.coefficients, read.h_0, read.h_c), (&own.coefficients, own.h_0, own.h_c));
        }
    }
    let shared = |w: &crate::solver::reduced::Window| w.deformation.modes == read.windows[0].deformation.modes;
    assert!(read.windows.len() == 3 && read.windows.iter().all(shared));
    let lies: [Lie; 4] = [
        (&|m| lie_about(m, Quantity::RoelandsExponent, (0.5, f64::NAN)), "its domain"),
        (&|m| lie_about(m, Quantity::RoelandsExponent, (0.8, 0.4)), "its domain"),
        (&|m| lie_about(m, Quantity::HertzPressure, (0.4e9, 1e3)), "its domain"),
        (&|m| m.windows[0].anchor = Some(Moes { m: -1.0, l: 2.0 }), "oils"),
    ];
    for (lie, wanted) in lies {
        let mut wrong = model.clone();
        lie(&mut wrong);
        let refused = from_bytes(&to_bytes(&wrong).unwrap()).err();
        assert!(matches!(refused, Some(ModelFileError::Damaged { what }) if what == wanted), "{refused:?}");
    }
}

#[test]
fn windows_of_points_keep_one_basis_and_what_their_grid_costs() {
    let model = ReducedModel::clone(&trained(&oils_of_points(50)));
    let bytes = to_bytes(&model).unwrap();
    let read = from_bytes(&bytes).unwrap();
    assert_eq!(to_bytes(&read).unwrap(), bytes);
    assert_eq!(read.domain, model.domain);
    for (ours, own) in read.windows.iter().zip(&model.windows) {
        let (kept, made) = (ours.pressure.combined().unwrap(), own.pressure.combined().unwrap());
        // Modes are rounded before equations are sampled and error bounds are measured.
        assert!(kept.factors == made.factors && kept.shared.basis.modes == made.shared.basis.modes);
        assert!(ours.pressure.basis().modes == own.pressure.basis().modes);
        for (ours, own) in ours.snapshots.iter().zip(&own.snapshots) {
            let (ours, own) = (ours.grid_cost.unwrap(), own.grid_cost.unwrap());
            assert!((ours.total() / own.total() - 1.0).abs() < 4e-3, "an estimate has two digits");
        }
    }
    // Otherwise each local model would store 48 modes.
    let apart: usize = model.windows.iter().map(|w| w.pressure.count() * w.grid.len()).sum();
    assert!(bytes.len() < 4 * apart, "{} bytes", bytes.len());
    let mut fewer = model.clone();
    let (own, grid) = (model.windows[1].pressure.basis().clone(), &model.windows[1].grid);
    fewer.windows[1].pressure = PressureModes::own(own, grid);
    let read = from_bytes(&to_bytes(&fewer).unwrap()).unwrap();
    assert!(read.windows.iter().all(|w| w.pressure.combined().is_none()));
    let mut wrong = model.clone();
    lie_about(&mut wrong, Quantity::FilmThickness, (f64::NAN, 1e6));
    assert!(from_bytes(&to_bytes(&wrong).unwrap()).is_err());
}

#[test]
fn the_catalogue_is_read_without_the_arrays() {
    for name in ["line", "point_heat", "ellipse"] {
        let (bytes, model) = (&*bytes_of(name).unwrap(), embedded(name).unwrap());
        let catalogue = Catalogue::of(bytes).unwrap();
        assert_eq!((catalogue.kind, catalogue.contact), (ModelKind::Steady, model.contact()));
        assert_eq!((&catalogue.title, &catalogue.domain), (&model.title, &model.domain));
        assert_eq!(
            (catalogue.bytes, catalogue.hash.to_le_bytes()),
            (bytes.len(), bytes[20..HEADER].try_into().unwrap())
        );
        // Data after the directory are not read, and may be missing.
        let head = head_length(bytes);
        assert_eq!(Catalogue::of_head(&bytes[..head]).unwrap(), catalogue);
        assert!(Catalogue::of_head(&bytes[..head - 1]).is_err() && Catalogue::of(&bytes[..head]).is_err());
        let mut other = bytes.to_vec();
        let end = other.len() - 1000;
        other[end..].fill(0x55);
        assert_eq!(Catalogue::of(&other).unwrap(), catalogue);
        assert!(from_bytes(&other).is_err());
    }
}

#[test]
fn an_unwritable_target_is_one_sentence() {
    let model = embedded("line").unwrap();
    let error = write(&model, Path::new("/nonexistent-folder/model.rom")).unwrap_err().to_string();
    assert!(error.contains("/nonexistent-folder/model.rom"), "{error}");
}
