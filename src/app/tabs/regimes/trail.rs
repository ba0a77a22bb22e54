//! Trail of the contact on the chart of regimes. Older parts are fainter.

use crate::app::figure::Canvas;
use crate::app::theme::faded;
use crate::solver::physics::contact::ContactKind;
use egui::Color32;
use egui_plot::{Line, PlotPoint, PlotPoints};

/// Maximum number of places.
const MOST: usize = 480;
/// Minimum distance between two places \[decades\].
const STEP: f64 = 0.006;
/// Number of shades from the oldest to the newest part.
const SHADES: usize = 12;

/// Trail of the contact.
#[derive(Default)]
pub struct Trail {
    kind: ContactKind,
    points: Vec<PlotPoint>,
}

impl Trail {
    /// Adds the place of the contact. Another kind of contact starts a new trail.
    pub fn follow(&mut self, kind: ContactKind, here: PlotPoint) {
        if self.kind != kind {
            *self = Self { kind, points: Vec::new() };
        }
        let far = |last: &PlotPoint| (last.x - here.x).hypot(last.y - here.y) > STEP;
        if here.x.is_finite() && here.y.is_finite() && self.points.last().is_none_or(far) {
            self.points.push(here);
            let surplus = self.points.len().saturating_sub(MOST);
            self.points.drain(..surplus);
        }
    }

    /// Returns the places, the oldest first.
    pub fn points(&self) -> &[PlotPoint] {
        &self.points
    }

    /// Removes all but the last place.
    pub fn clear(&mut self) {
        let last = self.points.len().saturating_sub(1);
        self.points.drain(..last);
    }

    pub fn draw<'a>(&'a self, plot: &mut Canvas<'_, 'a>, color: Color32) {
        let each = self.points.len().div_ceil(SHADES).max(1);
        let parts = self.points.len().div_ceil(each);
        for k in 0..parts {
            // Each part ends where the next one starts.
            let end = ((k + 1) * each + 1).min(self.points.len());
            let Some(part) = self.points.get(k * each..end).filter(|part| part.len() > 1) else { continue };
            let strength = 0.15 + 0.6 * (k + 1) as f32 / parts as f32;
            let line = Line::new("", PlotPoints::Borrowed(part)).id(("trail", k)).width(2.5);
            plot.line(line.color(faded(color, strength)).allow_hover(false));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_keeps_the_last_places_and_begins_anew_with_another_kind() {
        let mut trail = Trail::default();
        for k in 0..2 * MOST {
            trail.follow(ContactKind::Line, PlotPoint::new(0.01 * k as f64, 0.0));
            trail.follow(ContactKind::Line, PlotPoint::new(0.01 * k as f64 + 1e-3, 0.0));
        }
        let last = trail.points().last().unwrap().x;
        assert!(trail.points().len() == MOST && (last - 0.01 * (2 * MOST - 1) as f64).abs() < 1e-9);
        trail.follow(ContactKind::Line, PlotPoint::new(f64::NAN, 0.0));
        assert_eq!(trail.points().len(), MOST);
        trail.clear();
        assert_eq!(trail.points().len(), 1);
        trail.follow(ContactKind::Point, PlotPoint::new(2.0, 0.0));
        assert!(trail.points().len() == 1 && trail.points()[0].x == 2.0);
    }
}
