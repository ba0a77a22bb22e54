//! What a lecturer projects: plots and the sliders in use, large, over the full screen.

use egui::{Context, Vec2, ViewportCommand, vec2};

/// What plots and sliders need at least, in points: where the screen has more, everything is larger.
const LEAST: Vec2 = vec2(760.0, 470.0);
/// As large as it gets.
const LARGEST: f32 = 2.0;

/// A presentation under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Presentation {
    /// Whether the window filled the screen before, and does so afterwards.
    filled_before: bool,
}

impl Presentation {
    /// Begins: the window fills the screen.
    pub fn begin(ctx: &Context) -> Self {
        let filled_before = ctx.input(|i| i.viewport().fullscreen).unwrap_or(false);
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(true));
        Self { filled_before }
    }

    /// Ends: the window is as it was.
    pub fn end(self, ctx: &Context) {
        ctx.send_viewport_cmd(ViewportCommand::Fullscreen(self.filled_before));
    }
}

/// How much larger everything is in a window of a size in points at the size of text that the user chose.
pub fn enlargement(window: Vec2) -> f32 {
    let fits = window / LEAST;
    // In steps, so that a window that is being resized does not flicker.
    let factor = (20.0 * fits.min_elem()).floor() / 20.0;
    factor.clamp(1.0, LARGEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn larger_screens_enlarge_more_and_plots_keep_their_room() {
        let screens = [vec2(600.0, 400.0), vec2(1024.0, 640.0), vec2(1280.0, 800.0), vec2(1920.0, 1080.0)];
        let factors = screens.map(enlargement);
        assert!((factors[0] - 1.0).abs() < 1e-6 && (factors[3] - 2.0).abs() < 1e-6, "{factors:?}");
        assert!(
            factors[1] > 1.25 && factors[2] > 1.6 && factors.windows(2).all(|pair| pair[0] < pair[1]),
            "{factors:?}"
        );
        for (screen, factor) in screens.iter().zip(factors).skip(1) {
            assert!((*screen / factor).x >= LEAST.x && (*screen / factor).y >= LEAST.y);
        }
    }
}
