//! The document in the words of engineers: an oil at a temperature, two bodies.

use super::experiment::Document;
use crate::app::refusal::Refusal;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, Quantity};
use crate::solver::physics::engineering::{Bodies, Oil};

const OF_THE_OIL: [Quantity; 2] = [Quantity::Viscosity, Quantity::Alpha];
const OF_THE_BODIES: [Quantity; 3] = [Quantity::Radius, Quantity::Modulus, Quantity::Speed];

impl Document {
    /// Takes η₀ and α from an oil and holds them.
    ///
    /// # Errors
    /// A sentence when there is no such oil, or the lubricant's own law fixes α; the document is unchanged then.
    pub fn set_oil(&mut self, oil: Oil) -> Result<(), Refusal> {
        if self.lubricant.own_coefficient().is_some() {
            let why = "the lubricant’s own viscosity law fixes α; choose Mineral oil above to enter a grade";
            return Err(Refusal::new(why));
        }
        let point = self.of_oil(&oil)?;
        self.accept(point)?;
        self.view.oil = Some(oil);
        OF_THE_OIL.into_iter().for_each(|quantity| self.view.held.set(quantity, true));
        Ok(())
    }

    /// Takes R, E′, u_m and SRR from two bodies and holds the first three; of a point contact R_y as well, where the
    /// bodies are not as round across as along.
    ///
    /// # Errors
    /// A sentence when the bodies make no contact; the document is unchanged then.
    pub fn set_bodies(&mut self, bodies: Bodies) -> Result<(), Refusal> {
        let point = self.of_bodies(&bodies)?;
        self.accept(point)?;
        self.view.bodies = Some(bodies);
        OF_THE_BODIES.into_iter().for_each(|quantity| self.view.held.set(quantity, true));
        if self.point.radius_y_m.is_some() {
            self.view.held.set(Quantity::RadiusY, true);
        }
        Ok(())
    }

    /// Whether the present contact still has the values of its oil.
    pub fn oil_counts(&self) -> bool {
        self.view.oil.is_some_and(|oil| self.of_oil(&oil) == Ok(self.point))
    }

    /// Whether the present contact still has the values of its bodies.
    pub fn bodies_count(&self) -> bool {
        self.view.bodies.is_some_and(|bodies| self.of_bodies(&bodies) == Ok(self.point))
    }

    fn of_oil(&self, oil: &Oil) -> Result<OperatingPoint, Refusal> {
        let state = oil.state()?;
        Ok(OperatingPoint { viscosity_pa_s: state.viscosity_pa_s, alpha_per_pa: state.alpha_per_pa, ..self.point })
    }

    fn of_bodies(&self, bodies: &Bodies) -> Result<OperatingPoint, Refusal> {
        let (speed_m_per_s, srr) = bodies.entrainment()?;
        let radius_m = bodies.reduced_radius_m()?;
        let modulus_pa = bodies.reduced_modulus_pa()?;
        let radius_y_m = match self.point.kind {
            ContactKind::Line => None,
            // An ellipse stays one where its radii happen to be equal.
            ContactKind::Point => Some(bodies.reduced_transverse_radius_m()?)
                .filter(|radius_y| *radius_y != radius_m || self.point.radius_y_m.is_some()),
        };
        let mut point = OperatingPoint { radius_m, radius_y_m, modulus_pa, speed_m_per_s, ..self.point };
        point.sliding.slide_to_roll_ratio = srr;
        Ok(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Shape;
    use crate::solver::physics::contact::Moes;
    use crate::solver::physics::engineering::{Body, Grade, OilFamily};

    const VG_68: Oil =
        Oil { grade: Grade::IsoVg(68.0), family: OilFamily::Mineral, temperature_k: 333.15, density_15: 880.0 };

    #[test]
    fn an_oil_and_two_bodies_become_the_contact_and_stay_when_m_moves() {
        let mut document = Document::default();
        document.set_oil(VG_68).unwrap();
        let bodies = Bodies::on_plane(0.012, 3.0, 0.05);
        document.set_bodies(bodies).unwrap();
        let point = document.point;
        assert!((point.radius_m - 0.012).abs() < 1e-15 && (point.speed_m_per_s - 3.0).abs() < 1e-12);
        assert!((point.sliding.slide_to_roll_ratio - 0.05).abs() < 1e-12);
        assert!(document.oil_counts() && document.bodies_count());
        let moes = point.moes();
        document.set_moes(Moes { m: 1.5 * moes.m, ..moes }).unwrap();
        assert_eq!(OperatingPoint { load: point.load, ..document.point }, point, "only the load follows");
        assert!((document.point.load / point.load - 1.5).abs() < 1e-9);
        assert!(document.set_moes(Moes { l: 1.1 * moes.l, ..moes }).unwrap_err().contains("held"));
        // Saved and opened again nothing is lost.
        let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
        assert_eq!((again.view, again.point), (document.view, document.point));
        // A value that is typed over them is not theirs any more.
        document.type_quantity(Quantity::Alpha, 2e-8).unwrap();
        assert!(!document.oil_counts() && document.view.oil == Some(VG_68));
    }

    #[test]
    fn a_ball_in_a_groove_becomes_an_ellipse_and_a_roller_has_no_groove() {
        let mut document = Document::default();
        document.set_shape(Shape::Ball).unwrap();
        let Bodies(ball, race) = Bodies::on_plane(4.7625e-3, 3.0, 0.0);
        let race = Body { radius_m: Some(18.2e-3), ..race };
        let pair = |groove_m: f64| Bodies(ball, race.with_transverse_radius_m(Some(groove_m)));
        document.set_bodies(pair(-4.953e-3)).unwrap();
        assert!((document.point.radius_ratio() - 32.8).abs() < 0.1, "{}", document.point.radius_ratio());
        assert!(document.bodies_count() && document.holds(Quantity::RadiusY));
        let said = document.set_bodies(pair(-4.5e-3)).unwrap_err();
        assert!(said.contains("across the rolling direction") && said.contains("beyond -0.0047625 m"), "{said}");
        let said = document.set_bodies(pair(-4.8e-3)).unwrap_err();
        assert!(said.contains("R_y/R_x"), "{said}");
        document.set_shape(Shape::Roller).unwrap();
        document.set_bodies(pair(-4.953e-3)).unwrap();
        assert_eq!(document.point.radius_y_m, None);
    }

    #[test]
    fn what_is_refused_leaves_the_document_as_it_was() {
        let mut document = Document::default();
        let before = document.clone();
        assert!(document.set_oil(Oil { grade: Grade::IsoVg(33.0), ..VG_68 }).unwrap_err().contains("no ISO"));
        let Bodies(first, second) = Bodies::on_plane(0.012, 3.0, 0.05);
        let backwards = Bodies(Body { speed_m_per_s: -9.0, ..first }, second);
        assert!(document.set_bodies(backwards).unwrap_err().contains("carry no oil"));
        assert_eq!(document, before);
    }
}
