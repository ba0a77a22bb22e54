//! Optics of the interferogram: light, refractive index, phase and visibility, and their formula.

use super::map_view::MapView;
use crate::app::controls::{described, named};
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::app::units;
use crate::solver::physics::optics::Interferometer;
use egui::{DragValue, Ui};

/// Number of the optics as a field.
struct Dial {
    symbol: &'static str,
    name: &'static str,
    tip: &'static str,
    /// Value of one displayed unit in internal units.
    scale: f64,
    range: (f64, f64),
    speed: f64,
    unit: &'static str,
}

/// Returns a field in SI units.
const fn dial(symbol: &'static str, name: &'static str, range: (f64, f64), speed: f64, tip: &'static str) -> Dial {
    Dial { symbol, name, tip, scale: 1.0, range, speed, unit: "" }
}

const WAVELENGTH_TIP: &str = "Wavelength of the monochromatic light in vacuum";
const INDEX_TIP: &str = "Refractive index of the oil; a few per cent higher at 1 GPa";
const PHASE_TIP: &str = "Phase shift by the reflections at coating and ball; at 180° touching surfaces are dark";
const VISIBILITY_TIP: &str = "Contrast of the fringes: 1 where both beams are equally strong";

const WAVELENGTH: Dial =
    Dial { scale: 1e-9, unit: " nm", ..dial("{λ}", "Wavelength", (380.0, 780.0), 1.0, WAVELENGTH_TIP) };
const REFRACTIVE_INDEX: Dial = dial("{n}", "Refractive index", (1.0, 2.5), 0.005, INDEX_TIP);
const PHASE: Dial =
    Dial { scale: std::f64::consts::PI / 180.0, unit: "°", ..dial("{φ}", "Phase", (0.0, 360.0), 1.0, PHASE_TIP) };
const VISIBILITY: Dial = dial("{V}", "Visibility", (0.0, 1.0), 0.01, VISIBILITY_TIP);

/// Returns true if optics read from a file are within their ranges.
pub fn are_sound(rig: &Interferometer) -> bool {
    let numbers = [rig.wavelength_m, rig.refractive_index, rig.phase, rig.visibility];
    let dials = [WAVELENGTH, REFRACTIVE_INDEX, PHASE, VISIBILITY];
    // The conversion to degrees and back may change the last digit.
    dials
        .iter()
        .zip(numbers)
        .all(|(Dial { scale, range: (low, high), .. }, number)| (low - 1e-6..=high + 1e-6).contains(&(number / scale)))
}

impl Dial {
    fn ui(&self, ui: &mut Ui, value: &mut f64) {
        ui.horizontal(|ui| {
            ui.label(rich(self.symbol, 13.5, ui.visuals().text_color())).on_hover_text(self.tip);
            let mut shown = *value / self.scale;
            let (low, high) = self.range;
            let field = DragValue::new(&mut shown).range(low..=high).speed(self.speed).suffix(self.unit);
            let response = ui.add(field.max_decimals(2)).on_hover_text(self.tip);
            let response = named(ui, response, self.name);
            if described(ui, response, self.tip).changed() {
                *value = shown * self.scale;
            }
        });
    }
}

/// Draws the row of the optics.
pub fn ui(ui: &mut Ui, view: &mut MapView) {
    ui.horizontal_wrapped(|ui| {
        let tip = "630, 532 and 460 nm at once, as a three-colour camera sees them";
        ui.selectable_value(&mut view.three_colors, true, "Three colours").on_hover_text(tip);
        ui.selectable_value(&mut view.three_colors, false, "Monochromatic").on_hover_text("One wavelength, in grey");
        let rig = &mut view.rig;
        if !view.three_colors {
            WAVELENGTH.ui(ui, &mut rig.wavelength_m);
        }
        REFRACTIVE_INDEX.ui(ui, &mut rig.refractive_index);
        PHASE.ui(ui, &mut rig.phase);
        VISIBILITY.ui(ui, &mut rig.visibility);
        let formula = "{I} = ½(1 + {V} cos(4π{n}{h}/{λ} + {φ}))";
        let text = if view.three_colors {
            format!("{formula} at 630, 532 and 460 nm")
        } else {
            format!("{formula}; one fringe is {}", numbers::length(rig.fringe_spacing_m(rig.wavelength_m), units::system(ui.ctx())))
        };
        ui.label(rich(&text, 12.5, Palette::of(ui).quiet)).on_hover_text(
            "Two-beam interference: Cameron & Gohar 1966, Proc. R. Soc. A 291; Wedeven, Evans & Cameron 1971, ASME J. Lubr. Technol. 93",
        );
    });
}
