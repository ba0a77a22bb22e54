//! Sketch of a machine to scale, with the contact marked.

use crate::app::theme::Palette;
use crate::solver::physics::machines::{Bearing, CamFollower, Follower, GearPair, Machine};
use egui::{Color32, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, vec2};
use std::f64::consts::{PI, TAU};

/// Height of the sketch \[points\].
const HEIGHT: f32 = 130.0;

/// Drawing area with a scale. Its functions take coordinates in metres.
struct Sheet {
    painter: Painter,
    /// Screen position of the point (0, 0).
    origin: Pos2,
    /// Points per metre.
    scale: f32,
    /// Stroke of outlines.
    line: Stroke,
    /// Stroke of auxiliary lines.
    faint: Stroke,
    /// Colour of the contact.
    mark: Color32,
}

impl Sheet {
    /// Creates a sheet that shows a width and a height \[m\] around the origin.
    fn new(ui: &Ui, rect: Rect, (width, height): (f64, f64)) -> Self {
        let scale = (rect.width() / width as f32).min(rect.height() / height as f32) * 0.94;
        let text = ui.visuals().text_color();
        Self {
            painter: ui.painter_at(rect),
            origin: rect.center(),
            scale,
            line: Stroke::new(1.2, text),
            faint: Stroke::new(0.8, text.gamma_multiply(0.5)),
            mark: Palette::of(ui).accent,
        }
    }

    /// Returns the screen position of a point \[m\]; y points upwards.
    fn at(&self, x: f64, y: f64) -> Pos2 {
        self.origin + self.scale * vec2(x as f32, -y as f32)
    }

    fn circle(&self, (x, y): (f64, f64), radius: f64, stroke: Stroke) {
        self.painter.circle_stroke(self.at(x, y), radius as f32 * self.scale, stroke);
    }

    /// Marks the contact.
    fn mark(&self, x: f64, y: f64) {
        self.painter.circle_filled(self.at(x, y), 3.5, self.mark);
    }
}

/// Draws the sketch of a machine, `width` points wide. `modulus_pa` is the reduced modulus E′ \[Pa\], needed for a
/// bearing. Draws nothing if the data of the machine are refused.
pub(super) fn ui(ui: &mut Ui, machine: &Machine, modulus_pa: f64, width: f32) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(width, HEIGHT), Sense::hover());
    match machine {
        Machine::Bearing(bearing) => bearing_ui(ui, rect, bearing, modulus_pa),
        Machine::Gear(pair) => gear_ui(ui, rect, pair),
        Machine::Cam(cam) => cam_ui(ui, rect, cam),
    }
}

/// Draws the rings and the rolling elements. The radial load points downwards. A more heavily loaded element has a
/// stronger colour.
fn bearing_ui(ui: &Ui, rect: Rect, bearing: &Bearing, modulus_pa: f64) {
    let Ok(state) = bearing.state(modulus_pa) else { return };
    let (pitch, element) = (0.5 * bearing.pitch_diameter_m, 0.5 * bearing.element_diameter_m);
    let outer = pitch + element;
    let sheet = Sheet::new(ui, rect, (2.2 * outer, 2.2 * outer));
    for radius in [pitch - element, outer] {
        sheet.circle((0.0, 0.0), radius, sheet.line);
    }
    for k in 0..bearing.elements {
        let orbit = TAU * f64::from(k) / f64::from(bearing.elements);
        let share = (state.element(orbit).0 / state.largest_load_n) as f32;
        let at = sheet.at(pitch * orbit.sin(), -pitch * orbit.cos());
        let radius = element as f32 * sheet.scale;
        sheet.painter.circle(at, radius, sheet.mark.gamma_multiply(0.7 * share), sheet.faint);
    }
    let orbit = bearing.orbit_deg.to_radians();
    sheet.mark(pitch * orbit.sin(), -pitch * orbit.cos());
}

/// Draws tip and base circles near the mesh, and the path of contact.
fn gear_ui(ui: &Ui, rect: Rect, pair: &GearPair) {
    let Ok(geometry) = pair.geometry() else { return };
    let [first, second] = geometry.tip_radii_m;
    let size = 1.6 * first.min(second);
    let sheet = Sheet::new(ui, rect, (2.0 * size, size));
    // The pitch point is the origin. The pinion is at the left.
    let ratio = f64::from(pair.teeth.0) / f64::from(pair.teeth.0 + pair.teeth.1);
    let centres = [-geometry.centre_distance_m * ratio, geometry.centre_distance_m * (1.0 - ratio)];
    for (k, centre) in centres.into_iter().enumerate() {
        sheet.circle((centre, 0.0), geometry.tip_radii_m[k], sheet.line);
        sheet.circle((centre, 0.0), geometry.base_radii_m[k], sheet.faint);
    }
    let (sine, cosine) = geometry.working_angle.sin_cos();
    // Screen position of a point on the path of contact.
    let on = |position: f64| sheet.at(position * sine, position * cosine);
    let (from, to) = geometry.path;
    sheet.painter.line_segment([on(from), on(to)], Stroke::new(2.0, sheet.mark.gamma_multiply(0.6)));
    sheet.mark(pair.position_m * sine, pair.position_m * cosine);
}

/// Draws the cam turned to its angle, and the follower above it.
fn cam_ui(ui: &Ui, rect: Rect, cam: &CamFollower) {
    let (Ok(_), Ok(curve)) = (cam.state(), cam.lift.curve()) else { return };
    let roller = if let Follower::Roller { radius_m } = cam.follower { radius_m } else { 0.0 };
    // Contact point on the cam: coordinates along the axis of the follower and at right angles to it.
    let contact = |angle: f64| {
        let [lift, slope, _] = curve.at(angle);
        let radius = cam.base_radius_m + roller + lift;
        if roller == 0.0 {
            return (radius, slope);
        }
        let length = radius.hypot(slope);
        (radius - roller * radius / length, roller * slope / length)
    };
    let here = cam.angle_deg.to_radians();
    let outline: Vec<(f64, f64)> = (0..=360)
        .map(|k| {
            let angle = TAU * f64::from(k) / 360.0;
            let ((radial, along), turned) = (contact(angle), angle - here + 0.5 * PI);
            let (sine, cosine) = turned.sin_cos();
            (radial * cosine - along * sine, radial * sine + along * cosine)
        })
        .collect();
    let reach = outline.iter().map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max) + 2.0 * roller;
    let sheet = Sheet::new(ui, rect, (2.2 * reach, 2.2 * reach));
    let points = outline.into_iter().map(|(x, y)| sheet.at(x, y)).collect();
    sheet.painter.add(Shape::closed_line(points, sheet.line));
    sheet.circle((0.0, 0.0), 0.08 * cam.base_radius_m, sheet.faint);
    let (radial, along) = contact(here);
    match cam.follower {
        Follower::Flat => {
            let half = 0.7 * cam.base_radius_m;
            sheet.painter.line_segment([sheet.at(-half, radial), sheet.at(half, radial)], sheet.line);
        }
        Follower::Roller { radius_m } => {
            let lift = curve.at(here)[0];
            sheet.circle((0.0, cam.base_radius_m + radius_m + lift), radius_m, sheet.line);
        }
    }
    sheet.mark(-along, radial);
}
