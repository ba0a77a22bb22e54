//! Explanation of pressure and film thickness of the present contact.

use crate::app::answers::picture::Picture;
use crate::app::numbers::{digits, share};
use crate::scene::regime::Ratios;
use crate::solver::physics::contact::{FilmShape, Moes};

/// Deformation over film thickness from which the film is nearly parallel.
const PARALLEL: f64 = 3.0;
/// Thinning of the film by twice the load from which load matters.
const MATTERS: f64 = 0.15;

/// Properties of a contact that its explanation uses.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    pub shape: FilmShape,
    pub moes: Moes,
    pub ratios: Ratios,
    /// Maximum pressure over p_H.
    pub largest_pressure: f64,
    /// True if the pressure has a spike.
    pub has_spike: bool,
    /// True if the inlet is starved.
    pub is_starved: bool,
}

impl Facts {
    /// Returns the properties of a picture.
    pub fn of(picture: &Picture) -> Self {
        let point = &picture.key.point;
        Self {
            shape: FilmShape::of(point),
            moes: point.moes(),
            ratios: Ratios::of(&picture.solution),
            largest_pressure: picture.solution.scalars.p_max,
            has_spike: picture.spike.is_some(),
            is_starved: picture.meniscus.is_some(),
        }
    }

    /// Returns the explanation in three sentences.
    pub fn explain(&self) -> String {
        format!(
            "The surfaces drag oil into the narrowing gap, where it builds up pressure: {}. {}. {}.",
            self.bodies(),
            self.outlet(),
            self.film()
        )
    }

    fn bodies(&self) -> String {
        let by = digits(self.ratios.deformation, 2);
        let largest = share(self.largest_pressure);
        if self.ratios.deformation > PARALLEL {
            format!(
                "here the bodies flatten by {by} times the film thickness, the film is nearly parallel, and the \
                 pressure is close to that of the dry contact (dashed), with a maximum of {largest} of p_H"
            )
        } else if self.ratios.deformation > 1.0 {
            format!(
                "here the bodies flatten by {by} times the film thickness, and the pressure begins to follow that of \
                 the dry contact (dashed), with a maximum of {largest} of p_H"
            )
        } else {
            format!(
                "here the bodies hardly flatten, by {by} times the film thickness, so that the pressure is a \
                 separate hill with a maximum of {largest} of that of the dry contact (dashed)"
            )
        }
    }

    fn outlet(&self) -> &'static str {
        match (self.has_spike, self.ratios.deformation > 1.0) {
            (true, _) => {
                "Near the outlet the film narrows so that no more oil leaves than enters, and in front of this \
                 constriction the pressure rises to a spike"
            }
            (false, true) => {
                "Near the outlet the film narrows so that no more oil leaves than enters; the viscosity is too low \
                 for a pressure spike there"
            }
            (false, false) => "Behind the narrowest place the gap opens, the pressure falls, and the film cavitates",
        }
    }

    fn film(&self) -> String {
        if self.is_starved {
            return "The inlet is starved: the oil supply limits the film thickness more than speed and viscosity do"
                .to_owned();
        }
        let film = |m: f64| self.shape.film(Moes { m, ..self.moes });
        let thinner = 1.0 - film(2.0 * self.moes.m) / film(self.moes.m);
        let (but, only) = if thinner < MATTERS { ("while", " only") } else { ("and", "") };
        format!(
            "The film forms in the inlet: more speed or viscosity makes it thicker, {but} twice the load makes it{only} \
             {} thinner (by Moes’ formula)",
            share(thinner)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(m: f64, deformation: f64, largest_pressure: f64) -> Facts {
        let ratios = Ratios { deformation, viscosity: 10.0 };
        let (shape, moes) = (FilmShape::Line, Moes { m, l: 2.0 });
        Facts { shape, moes, ratios, largest_pressure, has_spike: false, is_starved: false }
    }

    #[test]
    fn the_text_follows_the_contact_and_has_three_sentences() {
        let light = facts(1.2, 0.4, 0.46).explain();
        assert!(
            light.contains("hardly flatten") && light.contains("46\u{2009}% of that of the dry contact"),
            "{light}"
        );
        assert!(light.contains("and twice the load makes it"), "{light}");
        let heavy = Facts { has_spike: true, ..facts(300.0, 12.0, 1.03) }.explain();
        assert!(heavy.contains("12 times the film thickness") && heavy.contains("a spike"), "{heavy}");
        assert!(heavy.contains("makes it only"), "{heavy}");
        let starved = Facts { is_starved: true, ..facts(40.0, 2.0, 0.98) }.explain();
        assert!(starved.contains("begins to follow") && starved.contains("starved"), "{starved}");
        for text in [light, heavy, starved] {
            assert!(text.ends_with('.') && text.matches(". ").count() == 2, "{text}");
        }
    }
}
