//! Tests of the document: edits, refusals, files, undo.

use super::*;
use crate::app::document::{History, Shape};
use crate::scene::ReducedTransient;
use crate::scene::named_lubricant::by_name;
use crate::solver::full::transient::{Frame, Inputs, Signal, Unsupported};
use crate::solver::physics::lubricant::ShearLaw;
use crate::solver::training::Windows;

#[test]
fn followers_reach_m_and_l_and_keep_the_rest() {
    for m_follower in LoadFollower::ALL {
        for &l_follower in m_follower.partners() {
            let view = View { when_m_moves: m_follower, when_l_moves: l_follower, ..View::default() };
            let mut document = Document { view, ..Document::default() };
            document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
            let moes = document.point.moes();
            assert!((moes.m / 55.0 - 1.0).abs() < 1e-9 && (moes.l / 8.0 - 1.0).abs() < 1e-9);
            assert_eq!(document.point.modulus_pa, Document::default().point.modulus_pa);
        }
    }
}

#[test]
fn saving_and_opening_again_loses_nothing() {
    let view = View { pressure_loss: Some(1e-6), ..View::default() };
    let mut document = Document { title: "a".into(), view, ..Document::default() };
    document.set_quantity(Quantity::SlideToRollRatio, 0.2).unwrap();
    document.set_load_follower(LoadFollower::Speed);
    document.set_quantity(Quantity::Radius, 0.0123).unwrap();
    let text = document.to_ron().unwrap();
    let again = Document::from_ron(&text).unwrap();
    assert_eq!((&again.title, again.point, &again.view), (&document.title, document.point, &document.view));
    assert_eq!(again.to_ron().unwrap(), text);
    assert!(Document::from_ron(&text.replace("title", "titel")).unwrap_err().contains("titel"));
    assert!(Document::from_ron(&text.replace("pressure_loss: ", "pressure_loss: -")).is_err(), "{text}");
}

#[test]
fn a_scene_keeps_what_the_explorer_does_not_edit() {
    let before = Scene::from_ron(include_str!("../../../scenes/line/table_2_1.ron")).unwrap();
    assert_eq!(before.view, None);
    let mut document = Document::of_scene(before.clone()).unwrap();
    assert_eq!(document.to_scene(), before);
    document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
    let after = document.to_scene();
    assert_eq!((&after.study, &after.expect, &after.view), (&before.study, &before.expect, &None));
    assert_eq!(Document::of_scene(after).unwrap().point, document.point);
    document.view.projected_deformation = true;
    assert_eq!(document.to_scene().view, Some(document.view.clone()));
    document.view.projected_deformation = false;
    assert_eq!(document.to_scene().view, None);
}

#[test]
fn a_training_is_edited_saved_and_refused_like_the_rest() {
    let scene = Scene::from_ron(include_str!("../../../scenes/training/slider_range_model.ron")).unwrap();
    let mut document = Document::of_scene(scene.clone()).unwrap();
    assert_eq!(document.to_scene(), scene);
    let mut spec = document.training.clone().unwrap();
    spec.seed = 7;
    document.set_training(spec.clone()).unwrap();
    assert_eq!(Document::from_ron(&document.to_ron().unwrap()).unwrap().training, Some(spec.clone()));
    spec.windows = Windows::Given(Vec::new());
    assert!(document.set_training(spec.clone()).unwrap_err().contains("window"));
    assert_eq!(document.training.as_ref().unwrap().seed, 7);
    // A scene with another study keeps it. A new document stores the training.
    let other = Scene::from_ron(include_str!("../../../scenes/line/table_2_1.ron")).unwrap();
    let training = document.training.clone();
    let document = Document { training: training.clone(), ..Document::of_scene(other.clone()).unwrap() };
    assert_eq!(document.to_scene().study, other.study);
    let fresh = Document { training: training.clone(), ..Document::default() };
    assert_eq!(Document::of_scene(fresh.to_scene()).unwrap().training, training);
    // A training of point contacts belongs to a point contact and is not saved with a line contact.
    let mut point = Document::default();
    point.set_shape(Shape::Ball).unwrap();
    let scene = Scene::from_ron(include_str!("../../../scenes/training/table_3_4_model.ron")).unwrap();
    let Study::Training(spec) = scene.study else { panic!() };
    point.set_training(spec.clone()).unwrap();
    let saved = point.to_scene();
    saved.check().unwrap();
    assert_eq!(Document::of_scene(saved).unwrap().training, Some(spec));
    point.set_shape(Shape::Roller).unwrap();
    assert!(!point.saves_training() && point.to_scene().check().is_ok());
}

#[test]
fn transient_contact_is_saved_and_checked() {
    let mut document = Document::default();
    let study = document.transient_study();
    document.set_transient(study.clone()).unwrap();
    let again = Document::of_scene(document.to_scene()).unwrap();
    assert_eq!((again.transient.as_ref(), again.transient_grid()), (Some(&study), document.transient_grid()));
    assert_eq!(again.to_scene(), document.to_scene());
    let backwards = TransientStudy { duration: -1.0, ..study.clone() };
    assert!(document.set_transient(backwards).unwrap_err().contains("duration"));
    assert_eq!(document.transient, Some(study));
    // A new scene stores one study. A scene with another study keeps that study.
    assert!(!document.saves_training());
    let other = Scene::from_ron(include_str!("../../../scenes/line/table_2_1.ron")).unwrap();
    let kept = Document { transient: document.transient.clone(), ..Document::of_scene(other.clone()).unwrap() };
    assert_eq!(kept.to_scene().study, other.study);
    document.set_shape(Shape::Ball).unwrap();
    assert!(document.to_scene().check().is_ok());
}

#[test]
fn transient_scenes_open_and_are_saved_unchanged() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/time");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut count = 0;
    for path in paths {
        let scene = Scene::read(&path).unwrap();
        let Study::Transient(study) = &scene.study else { continue };
        count += 1;
        let mut document = Document::of_scene(scene.clone()).unwrap();
        assert_eq!(document.to_scene(), scene, "{}", path.display());
        // Only edited parts change. Further inputs, rules, trainings, published figures and expectations stay.
        let edited = TransientStudy { frames: vec![Frame::Fixed], duration: 2.0 * study.duration, ..study.clone() };
        document.set_transient(edited.clone()).unwrap();
        assert_eq!(document.to_scene(), Scene { study: Study::Transient(edited), ..scene }, "{}", path.display());
    }
    assert!(count >= 15, "{count} contacts in time");
}

#[test]
fn changing_the_kind_keeps_numbers_and_lubricant() {
    let mut document = Document::default();
    let line = document.point;
    document.set_shape(Shape::Ball).unwrap();
    let (before, after) = (line.moes(), document.point.moes());
    assert!((after.m / before.m - 1.0).abs() < 1e-9 && (after.l / before.l - 1.0).abs() < 1e-9);
    let kept = |p: &OperatingPoint| [p.modulus_pa, p.viscosity_pa_s, p.alpha_per_pa];
    assert_eq!((document.point.kind, kept(&document.point)), (ContactKind::Point, kept(&line)));
    assert_eq!((document.title.as_str(), document.plane()), ("Point contact", PointGridSpec::EXPLORER));
    document.set_plane(PointGridSpec::DISSERTATION);
    let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
    assert_eq!((again.point, again.plane()), (document.point, PointGridSpec::DISSERTATION));
    document.set_shape(Shape::Roller).unwrap();
    let [back, there] = [document.point, line].map(|p| p.quantities());
    assert!(back.iter().zip(there).all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{back:?} {there:?}");
}

#[test]
fn point_scene_keeps_its_question_until_the_kind_changes() {
    let scene = Scene::from_ron(include_str!("../../../scenes/point/table_2_3.ron")).unwrap();
    let mut document = Document::of_scene(scene.clone()).unwrap();
    assert_eq!((document.point.kind, document.to_scene()), (ContactKind::Point, scene));
    document.set_shape(Shape::Roller).unwrap();
    let scene = document.to_scene();
    assert!(scene.expect.is_empty() && scene.check().is_ok());
    assert_eq!(Document::of_scene(scene).unwrap().point, document.point);
}

#[test]
fn lubricant_sets_viscosity_and_keeps_alpha() {
    let squalane = by_name("squalane-pip").unwrap();
    let mut document = Document::default();
    document.set_quantity(Quantity::SlideToRollRatio, 0.3).unwrap();
    document.pick_lubricant(&squalane).unwrap();
    let alpha = squalane.laws.own_coefficient().unwrap();
    assert_eq!((document.point.alpha_per_pa, document.point.viscosity_pa_s), (alpha, 0.0705));
    assert_eq!((document.plateau_ratio(), document.point.sliding.slide_to_roll_ratio), (0.2227, 0.3));
    for load in document.possible_followers().0 {
        document.set_load_follower(*load);
        for follower in document.possible_followers().1 {
            document.view.when_l_moves = *follower;
            assert_eq!(document.followers(), (*load, *follower));
            document.set_moes(Moes { m: 30.0, l: 8.0 }).unwrap();
            let moes = document.point.moes();
            assert!((moes.m / 30.0 - 1.0).abs() < 1e-9 && (moes.l / 8.0 - 1.0).abs() < 1e-9);
            assert_eq!((document.point.alpha_per_pa, document.point.sliding.slide_to_roll_ratio), (alpha, 0.3));
        }
    }
    document.set_quantity(Quantity::NewtonianPlateauRatio, 0.4).unwrap();
    let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
    assert_eq!((again.point, again.lubricant), (document.point, document.lubricant));
    let before = document.clone();
    for (bad, word) in [(-0.1, "plateau ratio is -0.1"), (1.5, "plateau ratio is 1.5"), (f64::NAN, "NaN")] {
        assert!(document.set_quantity(Quantity::NewtonianPlateauRatio, bad).unwrap_err().contains(word));
    }
    assert!(document.set_quantity(Quantity::SlideToRollRatio, f64::INFINITY).is_err());
    assert_eq!(document, before);
    // Laws without a viscosity leave η₀ of the contact unchanged.
    document.pick_lubricant(&by_name("roelands-oil").unwrap()).unwrap();
    let sliding = Sliding { newtonian_plateau_ratio: None, ..before.point.sliding };
    assert_eq!((document.point, document.plateau_ratio()), (OperatingPoint { sliding, ..before.point }, 1.0));
    assert!(document.set_quantity(Quantity::NewtonianPlateauRatio, 0.5).unwrap_err().contains("no shear constants"));
}

#[test]
fn shear_thinning_ends_the_transient_contact() {
    let scene = Scene::from_ron(include_str!("../../../scenes/time/fig_2_6_right.ron")).unwrap();
    let mut document = Document::of_scene(scene).unwrap();
    document.pick_lubricant(&by_name("squalane-pip").unwrap()).unwrap();
    assert!(document.to_scene().check().is_ok());
}

#[test]
fn lost_question_is_reported_with_its_title() {
    let load_cases = include_str!("../../../scenes/load_cases/rollers_and_balls.ron");
    for (text, keeps_with_heat) in
        [(load_cases, true), (include_str!("../../../scenes/accuracy/grid_convergence.ron"), false)]
    {
        let scene = Scene::from_ron(text).unwrap();
        let mut document = Document::of_scene(scene.clone()).unwrap();
        assert_eq!(document.lost_question(), None);
        document.switch_heat(true).unwrap();
        let warm = document.to_scene();
        warm.check().unwrap();
        assert_eq!(document.lost_question().is_none(), keeps_with_heat);
        assert_eq!(warm.study == scene.study && warm.title == scene.title, keeps_with_heat);
        document.switch_heat(false).unwrap();
        assert_eq!((document.to_scene().study, document.to_scene().title), (scene.study, scene.title));
        document.set_shape(Shape::Ball).unwrap();
        assert!(document.lost_question().is_some() && document.to_scene().title == "Point contact");
    }
}

#[test]
fn refused_values_leave_the_document_as_it_was() {
    let mut document = Document::default();
    let before = document.clone();
    for bad in [f64::NAN, 0.0, -1.0, 1e300] {
        assert!(document.set_quantity(Quantity::Radius, bad).is_err());
        assert!(document.set_moes(Moes { m: bad, l: 10.0 }).is_err());
    }
    assert_eq!(document, before);
}

#[test]
fn history_goes_back_and_forth() {
    let mut document = Document::default();
    let first = document.clone();
    let mut history = History::default();
    history.restart(&document);
    document.set_moes(Moes { m: 80.0, l: 10.0 }).unwrap();
    let second = document.clone();
    history.commit(&document);
    history.undo(&mut document);
    assert_eq!(document, first);
    history.redo(&mut document);
    assert_eq!(document, second);
    assert!(!history.can_redo() && history.can_undo(&document));
}

#[test]
fn transient_refusals_agree_in_all_interfaces() {
    let reason = |document: &Document| {
        let why = Unsupported::check_lubricant(&document.lubricant).unwrap_err().to_string();
        let said = document.no_transient().unwrap();
        assert!(said.to_lowercase().starts_with(&why.to_lowercase()) && said.contains("; "), "{said}");
        why
    };
    let mut document = Document::default();
    assert_eq!(document.no_transient(), None);
    document.lubricant.shear = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
    assert!(reason(&document).contains("shear-thinning"));
    document = Document::default();
    document.switch_heat(true).unwrap();
    assert!(reason(&document).contains("isothermal"));
    // The full system marches all point contacts, linearised models only circular ones.
    document = Document::default();
    document.set_shape(Shape::Ball).unwrap();
    let reasons = |document: &Document| (document.no_transient(), document.unsupported_in_time());
    assert_eq!((reasons(&document), document.no_linearised()), ((None, None), None));
    document.set_shape(Shape::Ellipse).unwrap();
    assert_eq!(reasons(&document), (None, None));
    assert!(document.no_linearised().unwrap().contains("circular contacts"));
}

#[test]
fn transient_studies_are_adapted_to_point_contacts_and_back() {
    let mut document = Document::default();
    let reversing = Signal::Reversing { amplitude: 1.0, period: 40.0 };
    let harmonic = Signal::Harmonic { amplitude: 0.2, period: 3.0 };
    let inputs = Inputs { radius: harmonic.clone(), speed: reversing, load: harmonic.clone() };
    let line = TransientStudy { inputs, ..document.transient_study() };
    document.set_transient(line.clone()).unwrap();
    document.set_shape(Shape::Ball).unwrap();
    let ball = document.transient_study();
    assert_eq!((&ball.reduced, &ball.linearised), (&line.reduced, &line.linearised));
    assert_eq!(ball.inputs, Inputs::load(harmonic));
    let saved = Document::of_scene(document.to_scene()).unwrap();
    assert_eq!(
        (saved.transient_study(), saved.transient_grid()),
        (document.transient_study(), document.transient_grid())
    );
    document.set_shape(Shape::Ellipse).unwrap();
    let ellipse = document.transient_study();
    assert_eq!((ellipse.reduced, ellipse.linearised), (None, None));
    document.set_shape(Shape::Roller).unwrap();
    assert_eq!(document.transient_study(), line);
    // Marches do not train the model of a circular contact.
    document.set_transient(TransientStudy { reduced: Some(ReducedTransient::default()), ..line }).unwrap();
    document.set_shape(Shape::Ball).unwrap();
    assert_eq!(document.transient_study().reduced, Some(ReducedTransient::by_responses()));
    document.set_transient(document.transient_study()).unwrap();
}
