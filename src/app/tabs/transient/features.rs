//! Form of the features that pass the contact: kind, body, sizes and place of each, and the time scheme.

use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::heading;
use crate::app::document::Document;
use crate::app::document::features::{FeatureKind, place_of, sizes_of};
use crate::app::form::{Form, LastField, choose};
use crate::app::numbers;
use crate::app::purpose::Purpose;
use crate::app::tabs::transient::shared;
use crate::app::theme::rich;
use crate::app::units;
use crate::scene::study::transient::{SurfaceFeature, SurfaceShape};
use crate::scene::{Grid, TransientStudy};
use crate::solver::full::transient::{Scheme, TimeStep};
use crate::solver::physics::engineering::QuantityKind;
use egui::Ui;

/// Name under which refusals are stored.
pub const NAME: &str = "features";

/// Form with the chosen feature.
#[derive(Default)]
pub struct Features {
    chosen: usize,
    last: LastField,
}

impl Features {
    /// Draws the form.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let document = context.document;
        let mut wanted = None;
        let chosen = &mut self.chosen;
        self.last = shared::edit(ui, (NAME, self.last), context, commands, |ui, form, study| {
            let added = if study.surfaces.is_empty() {
                heading(ui, "Add a feature");
                kinds_ui(ui)
            } else {
                ui.menu_button("Add another", kinds_ui).inner.flatten()
            };
            if let Some(kind) = added {
                *chosen = study.surfaces.len();
                match kind {
                    FeatureKind::Profile => wanted = Some(*chosen),
                    _ => document.add_feature(study, document.new_feature(kind)),
                }
                form.changed = Some("Feature");
            }
            form.message(ui, "Feature");
            if study.surfaces.is_empty() {
                ui.weak(
                    "A feature moves through the contact with its body. Only the full system computes it, with \
                     constant speed and radius.",
                );
                return;
            }
            *chosen = (*chosen).min(study.surfaces.len() - 1);
            list_ui(ui, study, chosen);
            wanted = wanted.or(feature_ui(ui, form, document, study, *chosen));
            steps_ui(ui, form, document, study);
        });
        commands.extend(wanted.map(|k| Command::Ask(Purpose::Profile(k))));
    }
}

/// Draws a button for each kind. Returns the clicked one.
fn kinds_ui(ui: &mut Ui) -> Option<FeatureKind> {
    let button = |ui: &mut Ui, kind: FeatureKind| {
        let (name, tip) = kind.words();
        let name = if kind == FeatureKind::Profile { "Profile from CSV…" } else { name };
        let clicked = ui.button(name).on_hover_text(tip).clicked();
        if clicked {
            ui.close();
        }
        clicked.then_some(kind)
    };
    ui.horizontal_wrapped(|ui| FeatureKind::ALL.into_iter().filter_map(|kind| button(ui, kind)).last()).inner
}

/// Draws the list of several features, from which one is chosen.
fn list_ui(ui: &mut Ui, study: &TransientStudy, chosen: &mut usize) {
    if study.surfaces.len() == 1 {
        return;
    }
    heading(ui, "Features");
    ui.horizontal_wrapped(|ui| {
        for (k, feature) in study.surfaces.iter().enumerate() {
            let name = format!("{} {}", k + 1, FeatureKind::of(&feature.shape).words().0);
            ui.selectable_value(chosen, k, name).on_hover_text(format!("On body {}", feature.body));
        }
    });
}

/// Draws one feature. Returns its index if its profile is to be read.
fn feature_ui(
    ui: &mut Ui,
    form: &mut Form<'_>,
    document: &Document,
    study: &mut TransientStudy,
    k: usize,
) -> Option<usize> {
    let feature = study.surfaces.get_mut(k)?;
    let present = FeatureKind::of(&feature.shape);
    heading(ui, present.words().0);
    let (mut kind, mut body, mut wanted) = (present, feature.body, None);
    choose(ui, "Shape", "Shape of the feature", &mut kind, &FeatureKind::ALL, FeatureKind::words);
    if kind != present {
        match kind.shape(&feature.shape, &document.point) {
            Some(shape) => (feature.shape, form.changed) = (shape, Some("Shape")),
            None => wanted = Some(k),
        }
    }
    form.message(ui, "Shape");
    choose(ui, "Body", "Body that carries the feature", &mut body, &[1, 2], |body| {
        if body == 1 {
            ("Body 1", "Moves with u₁ = u_m (1 − SRR/2)")
        } else {
            ("Body 2", "Moves with u₂ = u_m (1 + SRR/2)")
        }
    });
    if body != feature.body {
        (feature.body, form.changed) = (body, Some("Body"));
    }
    speed_ui(ui, document, feature);
    form.message(ui, "Body");
    wanted = wanted.or(shape_ui(ui, form, feature).then_some(k));
    let place = (document.point.hertz().half_width_m, "Position at T = 0 in units of a; the inlet is negative");
    if let Some(at) = place_of(&mut feature.shape) {
        form.row(ui, "Start {X}", QuantityKind::Number, at, place.1);
        ui.weak(format!("{} from the centre", numbers::length(*at * place.0, units::system(ui.ctx()))));
    }
    if ui.button("Remove").on_hover_text("Removes this feature").clicked() {
        study.surfaces.remove(k);
        if study.surfaces.is_empty() {
            study.scheme = Scheme::Default;
        }
        form.changed = Some("Feature");
    }
    wanted
}

/// Draws height and length. Returns true if a profile is to be read.
fn shape_ui(ui: &mut Ui, form: &mut Form<'_>, feature: &mut SurfaceFeature) -> bool {
    let names = match feature.shape {
        SurfaceShape::Dent { .. } => [("Depth {d}", "Depth in the middle"), ("Radius {r_0}", "It ends at 1.2 r₀")],
        SurfaceShape::Gauss { .. } => {
            [("Height {A}", "Negative for a dent"), ("Width {W}", "Distance at which the height falls to 1/e")]
        }
        SurfaceShape::Venner { .. } => {
            [("Height {A}", "Negative for a dent in the middle"), ("Width {W}", "Wavelength and width of the packet")]
        }
        SurfaceShape::Wave { .. } => {
            [("Amplitude {A}", "Half of the height from valley to crest"), ("Wavelength {W}", "At least four spacings")]
        }
        SurfaceShape::Profile(ref path) => {
            ui.weak(format!("Every run reads the heights from {}.", path.display()));
            return false;
        }
        SurfaceShape::Sampled { ref places, .. } => {
            ui.weak(format!("{} points.", places.len()));
            let tip = "A table with a title line x,height, both in metres";
            return ui.button("Other profile from CSV…").on_hover_text(tip).clicked();
        }
    };
    if let Some((height, length)) = sizes_of(&mut feature.shape) {
        form.row(ui, names[0].0, QuantityKind::FilmThickness, height, names[0].1);
        form.row(ui, names[1].0, QuantityKind::FilmThickness, length, names[1].1);
    }
    false
}

/// Draws the speed of a feature, which follows from the sliding of the contact.
fn speed_ui(ui: &mut Ui, document: &Document, feature: &SurfaceFeature) {
    let ratio = feature.speed(document.point.sliding.slide_to_roll_ratio);
    let speed = numbers::shown(QuantityKind::Speed, ratio * document.point.speed_m_per_s, units::system(ui.ctx()));
    let text = format!("Speed {speed} = {} {{u_m}}, from {{SRR}}", numbers::digits(ratio, 3));
    ui.label(rich(&text, 13.0, ui.visuals().weak_text_color()));
}

/// Draws duration, step and time scheme.
fn steps_ui(ui: &mut Ui, form: &mut Form<'_>, document: &Document, study: &mut TransientStudy) {
    heading(ui, "Run");
    form.row(ui, "Duration {T}", QuantityKind::Number, &mut study.duration, "The last T, in units of a/u_m");
    let spacing = match document.transient_grid() {
        Grid::Uniform { dx, .. } if document.point.kind.is_line() => Some(dx),
        _ => None,
    };
    if let Some(dx) = spacing {
        let present = study.scheme == Scheme::Characteristic;
        let mut along = present;
        choose(ui, "Scheme", "Time scheme of the full system", &mut along, &[false, true], |along| match along {
            true => {
                ("Along the flow", "Differences along X − T = const, with ΔT = ΔX: loses least of a feature’s height")
            }
            false => ("Upwind, BDF2", "Any grid and step"),
        });
        if along != present {
            study.scheme = if along { Scheme::Characteristic } else { Scheme::Default };
            study.time_step = if along { TimeStep::Fixed(dx) } else { study.time_step };
            form.changed = Some("Scheme");
        }
        form.message(ui, "Scheme");
    }
    if let TimeStep::Fixed(step) = &mut study.time_step {
        form.row(
            ui,
            "Step {ΔT}",
            QuantityKind::Number,
            step,
            "A step moves a feature by at most a quarter of its length",
        );
    }
}
