//! Position and size of the window on the screen.

use egui::{Context, Rect};
use serde::{Deserialize, Serialize};

/// Position and size of the window in points of the screen, independent of the zoom factor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Place {
    pub(super) corner: Option<(f32, f32)>,
    /// Width and height.
    pub size: (f32, f32),
    /// True if it fills the screen.
    pub maximized: bool,
    /// Width of the panel with the sliders.
    pub sliders: f32,
    /// Width of the panel with a lesson.
    pub lessons: f32,
}

impl Default for Place {
    fn default() -> Self {
        Self { corner: None, size: (1280.0, 800.0), maximized: false, sliders: 312.0, lessons: 320.0 }
    }
}

/// Returns true if a value lies in a range. False for NaN.
pub fn within<T: PartialOrd>(value: T, (from, to): (T, T)) -> bool {
    from <= value && value <= to
}

impl Place {
    /// Minimum size of a window.
    pub const LEAST: (f32, f32) = (900.0, 560.0);
    /// Range of widths of the panel with the sliders.
    pub const SLIDERS: (f32, f32) = (250.0, 520.0);
    /// Range of widths of the panel with a lesson.
    pub const LESSONS: (f32, f32) = (300.0, 640.0);

    /// Returns true if all numbers lie in their ranges.
    pub fn is_sound(&self) -> bool {
        let ((width, height), (least_width, least_height)) = (self.size, Self::LEAST);
        within(width, (0.5 * least_width, 16e3))
            && within(height, (0.5 * least_height, 16e3))
            && within(self.sliders, Self::SLIDERS)
            && within(self.lessons, Self::LESSONS)
            && self.corner.is_none_or(|(x, y)| within(x, (-16e3, 16e3)) && within(y, (-16e3, 16e3)))
    }

    /// Stores the present position. A window that fills the screen keeps its previous position.
    pub fn follow(&mut self, ctx: &Context) {
        let zoom = ctx.zoom_factor();
        ctx.input(|input| {
            let viewport = input.viewport();
            self.maximized = viewport.maximized.unwrap_or(false);
            if self.maximized || viewport.fullscreen == Some(true) || viewport.minimized == Some(true) {
                return;
            }
            if let Some(size) = viewport.inner_rect.map(|rect| rect.size() * zoom).filter(|size| size.is_finite()) {
                self.size = (size.x.round(), size.y.round());
            }
            let corner = |rect: Rect| ((rect.min.x * zoom).round(), (rect.min.y * zoom).round());
            self.corner = viewport.outer_rect.map(corner).or(self.corner);
        });
    }

    #[cfg(feature = "desktop")]
    pub fn window(&self) -> egui::ViewportBuilder {
        let window = egui::ViewportBuilder::default()
            .with_inner_size([self.size.0, self.size.1])
            .with_min_inner_size([Self::LEAST.0, Self::LEAST.1])
            .with_maximized(self.maximized);
        // Windows would show nothing if the screen of this position has been removed.
        match self.corner.filter(|_| !cfg!(windows)) {
            Some((x, y)) => window.with_position([x, y]),
            None => window,
        }
    }
}
