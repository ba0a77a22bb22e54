//! Panel of the reduced model of the contact: its numbers of modes and equations, and its deformation operator.

use crate::app::context::{Commands, Context};
use crate::app::controls::{NAME_WIDTH, choice, heading, reserved, warning_ui};
use crate::app::document::Edit;
use crate::solver::physics::lubricant::ShearLaw;
use crate::solver::reduced::{ReducedModel, Trust};
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Grid, Layout, TextStyle, Ui, vec2};

const NO_MODEL: &str = "No reduced model of this contact; the full solver draws the picture.";
const NO_MODEL_THINS: &str =
    "No reduced model of this contact with a shear-thinning lubricant; the full solver draws the picture.";

/// Draws the group Model.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    heading(ui, "Model");
    model_ui(ui, context, commands);
}

fn deformation_operator(projected: bool) -> (&'static str, &'static str) {
    if projected {
        ("through its basis", "V_δ V_δ^T K V_p, as in the dissertation, with a separate truncation")
    } else {
        ("exact", "K V_p, without additional error")
    }
}

/// Draws the rows of the model. Every row keeps its place with and without a model, because a model may arrive
/// while a field of the same panel is edited.
fn model_ui(ui: &mut Ui, Context { document, answers, .. }: &Context<'_>, commands: &mut Commands) {
    let model = answers.model(document);
    let window = model.and_then(|model| model.windows.get(model.window_for(&document.point)));
    title_ui(ui, model.map(|model| &**model), document.lubricant.shear);
    let options = answers.options(document);
    let of = |kept: Option<usize>, all: Option<usize>| match all {
        Some(all) => format!("{} of {all}", kept.unwrap_or(all)),
        None => "–".to_owned(),
    };
    Grid::new("model").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        ui.label("Pressure modes")
            .on_hover_text("Modes in use, of all modes. Drag the tolerance in the Reduced basis tab");
        ui.label(of(options.pressure_modes, window.map(|window| window.pressure.count())));
        ui.end_row();
        ui.label("Sampled equations")
            .on_hover_text("Discrete Reynolds equations that the reduced model evaluates (hyper-reduction)");
        let rows = window.map(|window| window.sampled_rows.len());
        ui.label(of(rows, window.map(|window| window.grid.unknowns())));
        ui.end_row();
        let tip = "How the reduced model computes the deformation";
        let mut view = document.view.clone();
        choice(ui, "Deformation", tip, &mut view.projected_deformation, &[false, true], deformation_operator);
        if view != document.view {
            commands.edit(Edit::View(view.clone().into()), "Deformation");
        }
        if view.projected_deformation {
            ui.label("Deformation modes");
            ui.label(of(options.deformation_modes, window.map(|window| window.deformation.modes.ncols())));
            ui.end_row();
        }
    });
    reserved(ui, 3, |ui| {
        if let Some(Trust::Outside(why)) = answers.trust(document) {
            warning_ui(ui, &format!("{why}; the full solver draws the picture"));
        }
    });
}

/// Draws the title of the model, or that there is none, in two lines, or in three if it is long. The full text is shown
/// on hover.
fn title_ui(ui: &mut Ui, model: Option<&ReducedModel>, shear: ShearLaw) {
    let (text, tip) = match (model, shear) {
        (Some(model), _) => (model.title.as_str(), format!("{}\n{}", model.title, model.log.join("\n"))),
        (None, ShearLaw::Newtonian) => (NO_MODEL, NO_MODEL.to_owned()),
        (None, _) => (NO_MODEL_THINS, NO_MODEL_THINS.to_owned()),
    };
    let font_id = TextStyle::Body.resolve(ui.style());
    let color = if model.is_some() { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
    let two_lines = ui.painter().layout_no_wrap("M\nM".to_owned(), font_id.clone(), color);
    let height = two_lines.size().y.ceil() + 1.0;
    let mut job = LayoutJob::single_section(text.to_owned(), TextFormat { font_id, color, ..TextFormat::default() });
    job.wrap.max_rows = 3;
    ui.allocate_ui_with_layout(vec2(ui.available_width(), height), Layout::top_down(Align::LEFT), |ui| {
        ui.set_min_height(height);
        ui.label(job).on_hover_text(tip);
    });
}
