//! Profiles tab: pressure and film thickness against X, one above the other on a shared axis, and optionally the
//! difference to the full solution.

use super::curves::{Scene, key_ui};
use super::film_shear::{self, FilmShear, FilmShearImage};
use super::plots::{difference_plot, film_plot, pressure_plot};
use super::stress::{self, StressImage};
use super::temperatures::{self, TemperatureImage};
use super::why::Facts;
use crate::app::animations::loads;
use crate::app::answers::Answers;
use crate::app::answers::picture::{Origin, Picture};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::named;
use crate::app::document::Shape;
use crate::app::drawn::{self, Owner};
use crate::app::plot::cut_line;
use crate::app::plot::direction::Direction;
use crate::app::tabs::{About, Offer, View, view};
use crate::app::theme::{Palette, rich};
use crate::app::units::Scales;
use crate::app::{badge, caption, export, numbers};
use crate::engine::job::Standing;
use crate::engine::stress_table;
use crate::solver::discrete::half_space::StressMeasure;
use egui::{Checkbox, ComboBox, Ui};
use serde::{Deserialize, Serialize};

/// Profiles tab: its settings and the images below the curves.
#[derive(Default)]
pub struct Profiles {
    /// Settings of the display.
    pub choices: Choices,
    image: FilmShearImage,
    stress: StressImage,
    warm: TemperatureImage,
}

/// Settings of the profiles, stored with the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// True if the full solution is drawn over the reduced one.
    pub overlay: bool,
    /// True if the difference is drawn below.
    pub difference: bool,
    /// Quantity shown across the film.
    pub film_shear: FilmShear,
    /// Measure of the stress shown below the surface; `None` to show none.
    pub stress: Option<StressMeasure>,
    /// True if temperatures of a thermal contact are drawn next to the profiles.
    pub temperatures: bool,
}

impl Default for Choices {
    fn default() -> Self {
        Self { overlay: false, difference: false, film_shear: FilmShear::Off, stress: None, temperatures: true }
    }
}

const ABOUT: About = About {
    keywords: "pressure film thickness spike shear Hertz Hertzian temperature inlet outlet cavitation starvation",
    page: "tour.md",
    has_units: true,
    why: "The surfaces drag oil into the narrowing gap, where it builds up pressure; in a heavily loaded contact the \
          bodies flatten, the pressure is close to that of the dry contact (dashed), and the film is nearly flat. Near \
          the outlet the film narrows so that no more oil leaves than enters, and in front of this constriction the \
          pressure rises to a spike. The film forms in the inlet: more speed or viscosity makes it thicker, while load \
          hardly matters.",
};

impl View for Profiles {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn why(&self, context: &Context<'_>) -> String {
        let present = context.answers.shown_picture();
        present.map_or_else(|| ABOUT.why.to_owned(), |picture| Facts::of(picture).explain())
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        badge::ui(ui, context);
        toolbar(ui, &mut self.choices, context, commands);
        pins_ui(ui, context, commands);
        let answers = context.answers;
        let Some(picture) = answers.picture() else {
            ui.centered_and_justified(|ui| ui.weak("The first picture is being computed"));
            return;
        };
        let stale = drawn::is_grey(ui.ctx(), "profiles", Owner::Contact(picture.key), context);
        let reduced = picture.origin != Origin::Full;
        let full = answers.full().filter(|_| self.choices.overlay && reduced);
        let comparison = answers.comparison().filter(|_| self.choices.difference);
        let shear = self.choices.film_shear;
        if shear != FilmShear::Off {
            self.image.follow(ui.ctx(), picture, shear);
        }
        let stress = self.choices.stress;
        if let Some(measure) = stress {
            self.stress.follow(ui.ctx(), context, picture, measure);
        }
        let extra = |shown: bool| if shown { 0.6 } else { 0.0 };
        let parts = 2.0 + extra(comparison.is_some()) + extra(shear != FilmShear::Off) + 1.5 * extra(stress.is_some());
        let scene = Scene {
            picture,
            full,
            pins: answers.pins(),
            stale,
            full_stale: full
                .is_some_and(|full| drawn::is_grey(ui.ctx(), "full solution", Owner::Contact(full.key), context)),
            fit: context.fit,
            cuts: context.cuts,
        };
        // The space is reserved as soon as heat is switched on.
        let warm = self.choices.temperatures && context.document.lubricant.heat.is_some();
        let gap = 8.0;
        let half = 0.5 * (ui.available_width() - gap);
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            let width = if warm { half } else { ui.available_width() };
            ui.scope(|ui| {
                ui.set_width(width);
                key_ui(ui, &scene);
            });
            if warm {
                temperatures::key_ui(ui, stale);
            }
        });
        let unit = (ui.available_height() - 6.0) / parts;
        let along = Scales::of(&picture.key.point, context.system).along;
        let mut moved = None;
        let mut stack = |ui: &mut Ui, direction: Direction| {
            let by_pressure = pressure_plot(ui, &scene, direction, unit);
            let by_film = film_plot(ui, &scene, direction, unit);
            moved = by_pressure.or(by_film).map(|to| (direction, to)).or(moved);
        };
        if warm {
            self.warm.follow(ui.ctx(), &picture.solution);
            let scales = Scales::of(&picture.key.point, context.system);
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = gap;
                ui.vertical(|ui| {
                    ui.set_width(half);
                    stack(ui, Direction::Along);
                });
                ui.vertical(|ui| {
                    ui.set_width(half);
                    match &picture.solution.heat {
                        Some(_) => temperatures::ui(ui, &self.warm, context, (scales, stale), unit),
                        None => _ = ui.weak("The temperatures are being computed"),
                    }
                });
            });
        } else if !picture.has_plane() {
            stack(ui, Direction::Along);
        } else {
            ui.horizontal_top(|ui| {
                let across = 0.4 * (ui.available_width() - 8.0);
                let along = ui.available_width() - 8.0 - across;
                for (direction, width) in [(Direction::Along, along), (Direction::Across, across)] {
                    ui.vertical(|ui| {
                        ui.set_width(width);
                        stack(ui, direction);
                    });
                }
            });
        }
        if let Some(comparison) = comparison {
            difference_plot(ui, (comparison, along), (context.fit, stale), 0.6 * unit);
        }
        if shear != FilmShear::Off {
            film_shear::ui(ui, (&self.image, along), shear, stale, 0.6 * unit);
        }
        if let Some(measure) = stress {
            stress::ui(ui, &self.stress, (picture, measure), stale, 0.9 * unit);
        }
        if let Some((direction, to)) = moved {
            let mut cuts = context.cuts;
            direction.move_other(&mut cuts, to);
            commands.push(Command::Cut(cuts));
        }
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let (answers, cuts) = (context.answers, context.cuts);
        let picture = answers.picture();
        let tip = "Live, full and pinned profiles over the whole domain, dimensionless and in SI units";
        let mut offers = vec![Offer::new("Profiles as CSV…", tip, picture.map(|_| || Command::ExportProfiles))];
        if picture.is_some_and(Picture::has_plane) {
            let tip = "The live profile across, dimensionless and in SI units";
            let across = move |answers: &&Answers| export::profile_across(answers, cuts.x);
            offers.push(Offer::table("Profile across as CSV…", tip, Some(answers), across));
        }
        if self.choices.stress.is_some() {
            let tip = "The stress below the surface at all depths, and its measures, in SI units";
            let field = picture.and_then(|picture| Some((picture, self.stress.field_of(&picture.solution)?)));
            offers.push(Offer::table("Stress below the surface as CSV…", tip, field, |(picture, field)| {
                let table = stress_table("stress", field, &picture.key.point);
                export::commented(&[export::describe(picture), answers.means()], &table)
            }));
        }
        let there = loads(context.document, answers).map(|_| || Command::AnimateLoad);
        let tip = "Profiles while the load moves through its range, by the reduced model, as a film of 960×540 pixels";
        offers.push(Offer::new("Animation over load as APNG…", tip, there));
        offers
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        let key = context.answers.picture()?.key;
        Some(format!(
            "{}; {}",
            caption::contact(&key.point, &key.lubricant, context.system),
            caption::means(context.answers)?
        ))
    }

    fn receive(&mut self) {
        self.stress.receive();
    }

    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        view::lasting(self.stress.standing()).into_iter().collect()
    }

    fn stop(&mut self) {
        self.stress.stop();
    }

    fn kept(&self) -> Option<String> {
        view::kept(&self.choices)
    }

    fn restore(&mut self, text: &str) -> bool {
        view::restore(&mut self.choices, text, |_| true)
    }
}

/// Draws the pressure and, once there is a full solution, the difference of the reduced one to it, side by side.
pub fn with_difference(ui: &mut Ui, context: &Context<'_>) {
    let answers = context.answers;
    let Some(picture) = answers.picture() else {
        ui.weak("The first picture is being computed");
        return;
    };
    let stale = drawn::is_grey(ui.ctx(), "profiles", Owner::Contact(picture.key), context);
    let scene =
        Scene { picture, full: None, pins: &[], stale, full_stale: false, fit: context.fit, cuts: context.cuts };
    let (height, half) = ((ui.available_height() - 4.0).max(90.0), 0.5 * ui.available_width() - 6.0);
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(half);
            pressure_plot(ui, &scene, Direction::Along, height);
        });
        ui.vertical(|ui| {
            ui.set_width(half);
            match answers.comparison() {
                Some(comparison) => {
                    let along = Scales::of(&context.document.point, context.system).along;
                    difference_plot(ui, (comparison, along), (context.fit, stale), height);
                }
                None => {
                    _ = ui.weak("The difference appears when the sliders are idle and the full solution is available")
                }
            }
        });
    });
}

fn toolbar(ui: &mut Ui, choices: &mut Choices, context: &Context<'_>, commands: &mut Commands) {
    let answers = context.answers;
    if context.presenting {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        if ui.button("Pin curve").on_hover_text("Keep this curve and its parameters for comparison (Ctrl+D)").clicked()
        {
            commands.push(Command::Pin);
        }
        let reduced = answers.picture().is_some_and(|p| p.origin != Origin::Full);
        let why = "The picture is the full solution itself";
        let switches = [
            ("Full solution", "Draw the full solution over the reduced one", &mut choices.overlay),
            ("Difference", "Reduced minus full, on a separate axis", &mut choices.difference),
        ];
        for (name, tip, on) in switches {
            ui.add_enabled(reduced, Checkbox::new(on, name)).on_hover_text(tip).on_disabled_hover_text(why);
        }
        let shear = &mut choices.film_shear;
        let tip = "Shows a field between the surfaces below the profiles";
        let choice = ComboBox::from_id_salt("film shear").selected_text(shear.name()).width(104.0).show_ui(ui, |ui| {
            for option in FilmShear::ALL {
                ui.selectable_value(shear, option, option.name()).on_hover_text(option.tip());
            }
        });
        named(ui, choice.response, "Across the film").on_hover_text(tip);
        let stress = &mut choices.stress;
        let tip = "Shows the stress below the surface of body 1, from pressure and shear stress";
        let shown = stress.map_or("no stress", StressMeasure::name);
        let choice = ComboBox::from_id_salt("stress below").selected_text(shown).width(104.0).show_ui(ui, |ui| {
            ui.selectable_value(stress, None, "no stress");
            for measure in StressMeasure::ALL {
                ui.selectable_value(stress, Some(measure), measure.name());
            }
        });
        named(ui, choice.response, "Below the surface").on_hover_text(tip);
        if context.document.lubricant.heat.is_some() {
            let tip = "Temperature rises along and across the film and of both bodies, and the heat balance";
            ui.checkbox(&mut choices.temperatures, "Temperatures").on_hover_text(tip);
        }
        if ui.button(Command::Verify.name()).on_hover_text("Solve this contact in full now (F5)").clicked() {
            commands.push(Command::Verify);
        }
        if answers.picture().is_some_and(|picture| picture.has_plane()) {
            cut_line::cuts_ui(ui, context, commands);
        }
    });
}

fn pins_ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let pins = context.answers.pins();
    if pins.is_empty() || context.presenting {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (k, pin) in pins.iter().enumerate() {
            let palette = Palette::of(ui);
            let color = palette.ink(palette.pin(pin.number));
            let point = &pin.picture.key.point;
            let moes = point.moes();
            let ratio = point
                .stated_ratio()
                .map_or_else(String::new, |ratio| format!(", {{R_y}}/{{R}} {}", numbers::significant(ratio)));
            let text = format!(
                "Pin {}, {}: {{M}} {}, {{L}} {}{ratio}, {{H_c}} {}",
                pin.number,
                Shape::of(point).contact(),
                numbers::significant(moes.m),
                numbers::significant(moes.l),
                numbers::significant(pin.picture.solution.scalars.h_c)
            );
            ui.label(rich(&text, 12.5, color)).on_hover_text(export::describe(&pin.picture));
            let response = ui.small_button("×").on_hover_text("Remove this pin");
            if named(ui, response, &format!("Remove pin {}", pin.number)).clicked() {
                commands.push(Command::RemovePin(k));
            }
            ui.add_space(8.0);
        }
    });
}
