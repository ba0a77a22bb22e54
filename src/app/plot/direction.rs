//! The two directions of profiles: along X, in the direction of motion, and across a point contact.

use crate::app::answers::picture::{Cuts, Picture};
use crate::app::numbers;
use crate::app::units::{Scale, Scales};
use crate::solver::physics::contact::Hertz;
use egui_plot::PlotPoint;

/// Direction of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along X, in the direction of motion.
    Along,
    /// Across a point contact, along Y.
    Across,
}

impl Direction {
    fn either<T>(self, along: T, across: T) -> T {
        match self {
            Self::Along => along,
            Self::Across => across,
        }
    }

    /// Returns P along it.
    pub fn pressure(self, picture: &Picture) -> &[PlotPoint] {
        self.either(&picture.pressure, &picture.across.pressure)
    }

    /// Returns H along it.
    pub fn film(self, picture: &Picture) -> &[PlotPoint] {
        self.either(&picture.film, &picture.across.film)
    }

    /// Returns P_a along it; empty for smooth surfaces.
    pub fn asperities(self, picture: &Picture) -> &[PlotPoint] {
        self.either(&picture.asperities, &picture.across.asperities)
    }

    /// Returns the scale of lengths along it: a, or b across a point contact.
    pub fn length(self, scales: Scales) -> Scale {
        self.either(scales.along, scales.across)
    }

    /// Returns the unit of its coordinate \[m\]: a, or b across a point contact.
    pub fn length_m(self, hertz: &Hertz) -> f64 {
        self.either(hertz.half_width_m, hertz.half_length_m)
    }

    /// Returns the length that scales its coordinate. Both semi-axes of a circular contact are a.
    fn semi_axis(self, kappa: f64) -> &'static str {
        if self == Self::Across && kappa != 1.0 { "b" } else { "a" }
    }

    /// Returns the title of its axis without the position of the cut.
    pub fn title(self, kappa: f64) -> String {
        format!("{{{0}}} = {{{1}}}/{{{2}}}", self.name(), self.name().to_lowercase(), self.semi_axis(kappa))
    }

    /// Returns the name of the coordinate.
    pub fn name(self) -> &'static str {
        self.either("X", "Y")
    }

    /// Returns the name of a profile along it.
    pub fn profile_name(self, of: &str) -> String {
        self.either(format!("{of} profile"), format!("{of} profile across"))
    }

    /// Returns the initial range: the contact with inlet and outlet, or with both sides.
    pub fn range(self) -> (f64, f64) {
        self.either((-2.2, 1.6), (-1.6, 1.6))
    }

    /// Returns the name of the plots that share an axis. Each direction has separate ones.
    pub fn id(self, plot: &str) -> String {
        self.either(plot.to_owned(), format!("{plot} across"))
    }

    /// Returns the title of the axis with the position of the cut.
    pub fn x_title(self, picture: &Picture, cuts: Cuts) -> String {
        match self {
            Self::Along if picture.has_plane() => {
                format!("{} at {{Y}} = {}", self.title(1.0), numbers::digits(cuts.y, 3))
            }
            Self::Along => self.title(1.0),
            Self::Across => format!("{} at {{X}} = {}", self.title(picture.kappa()), numbers::digits(cuts.x, 3)),
        }
    }

    /// Returns the title of its axis with units, without the unit.
    pub fn dimensional_title(self, title: &str) -> String {
        let at = title.split_once(" at ").map_or_else(String::new, |(_, at)| format!(" at {at}"));
        format!("{{{}}}{at}", self.name().to_lowercase())
    }

    /// Returns the position of the profile on the other axis.
    pub fn elsewhere(self, cuts: Cuts) -> f64 {
        self.either(cuts.y, cuts.x)
    }

    /// Returns the position of the other profile on this axis.
    pub fn other(self, cuts: Cuts) -> f64 {
        self.either(cuts.x, cuts.y)
    }

    /// Moves the other profile.
    pub fn move_other(self, cuts: &mut Cuts, to: f64) {
        *self.either(&mut cuts.x, &mut cuts.y) = to;
    }

    /// Returns the position of the minimum film thickness on a profile. `None` if it is more than 0.02 away from
    /// the profile.
    pub fn minimum(self, picture: &Picture, cuts: Cuts) -> Option<f64> {
        const NEAR: f64 = 0.02;
        let s = picture.solution.scalars;
        self.either(
            ((cuts.y.abs() + s.y_h_min).abs() < NEAR).then_some(s.x_h_min),
            ((cuts.x - s.x_h_min).abs() < NEAR).then_some(s.y_h_min),
        )
    }
}
