//! Shape of the contact as one choice: roller, ball or ellipse.

use super::experiment::Document;
use crate::app::refusal::Refusal;
use crate::scene::ShapeKeeps;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};

/// Shape of the contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Line contact.
    Roller,
    /// Point contact with equal radii: a circular contact.
    Ball,
    /// Point contact with a different radius across the rolling direction: an elliptical contact.
    Ellipse,
}

/// R_y/R of an elliptical contact before the user enters a radius across.
const USUAL_RATIO: f64 = 3.0;

impl Shape {
    /// All shapes.
    pub const ALL: [Self; 3] = [Self::Roller, Self::Ball, Self::Ellipse];

    /// Returns the shape of a contact.
    pub fn of(point: &OperatingPoint) -> Self {
        match (point.kind, point.radius_y_m) {
            (ContactKind::Line, _) => Self::Roller,
            (ContactKind::Point, None) => Self::Ball,
            (ContactKind::Point, Some(_)) => Self::Ellipse,
        }
    }

    /// Returns the name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Roller => "Roller",
            Self::Ball => "Ball",
            Self::Ellipse => "Ellipse",
        }
    }

    /// Returns the field's name of the contact.
    pub fn contact(self) -> &'static str {
        match self {
            Self::Roller => "line contact",
            Self::Ball => "circular contact",
            Self::Ellipse => "elliptical contact",
        }
    }

    /// Returns keywords for the search.
    pub fn synonyms(self) -> &'static str {
        match self {
            Self::Roller => "line contact",
            Self::Ball => "point contact circle",
            Self::Ellipse => "elliptical contact point groove race crowned roller radius across",
        }
    }
}

impl Document {
    /// Changes the shape. L, R, u_m, E′, η₀ and α keep their values. The load, which has another unit for a line contact,
    /// follows M or p_H, as chosen in the view, and is no longer held. R_y of an elliptical contact is stored until the next one.
    ///
    /// # Errors
    /// A sentence if the point is refused. The document is then unchanged.
    pub fn set_shape(&mut self, shape: Shape) -> Result<(), Refusal> {
        let here = self.point;
        let kind = if shape == Shape::Roller { ContactKind::Line } else { ContactKind::Point };
        let former = here.radius_y_m.or(self.view.radius_y_m);
        let ellipse = here.radius_y_m.unwrap_or_else(|| former.unwrap_or(USUAL_RATIO * here.radius_m));
        let other = OperatingPoint { kind, radius_y_m: Some(ellipse).filter(|_| shape == Shape::Ellipse), ..here };
        let other = match self.view.new_shape_keeps {
            _ if kind == here.kind => other,
            ShapeKeeps::LoadNumber => Quantity::M.at(&other, here.moes().m),
            ShapeKeeps::HertzPressure => other.at_hertz_pressure(here.hertz().pressure_pa),
        };
        self.accept(other)?;
        self.view.radius_y_m = former.filter(|_| shape != Shape::Ellipse);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::Moes;

    #[test]
    fn a_shape_keeps_all_that_others_have_too_and_r_y_comes_back() {
        let mut document = Document::default();
        let home = document.point.moes();
        document.set_shape(Shape::Ellipse).unwrap();
        assert_eq!(Shape::of(&document.point), Shape::Ellipse);
        assert!((document.point.radius_ratio() / USUAL_RATIO - 1.0).abs() < 1e-12);
        let moes = document.point.moes();
        assert!((moes.m / home.m - 1.0).abs() < 1e-12 && (moes.l / home.l - 1.0).abs() < 1e-12);
        document.type_quantity(Quantity::RadiusY, 0.02).unwrap();
        let ellipse = document.point;
        for shape in [Shape::Ball, Shape::Roller, Shape::Ball] {
            document.set_shape(shape).unwrap();
            assert_eq!((Shape::of(&document.point), document.point.radius_y_m), (shape, None));
        }
        let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
        assert_eq!(again.view.radius_y_m, Some(0.02), "kept with the file");
        document.set_shape(Shape::Ellipse).unwrap();
        assert!(!document.holds(Quantity::RadiusY));
        assert!((document.point.load / ellipse.load - 1.0).abs() < 1e-12);
        assert_eq!(OperatingPoint { load: ellipse.load, ..document.point }, ellipse);
        assert_eq!(document.view.radius_y_m, None);
    }

    #[test]
    fn another_shape_keeps_the_load_number_or_the_hertz_pressure() {
        for (keeps, of) in [
            (ShapeKeeps::LoadNumber, (|point| point.moes().m) as fn(&OperatingPoint) -> f64),
            (ShapeKeeps::HertzPressure, |point| point.hertz().pressure_pa),
        ] {
            let mut document = Document::default();
            document.view.new_shape_keeps = keeps;
            let before = document.point;
            for shape in [Shape::Ball, Shape::Roller] {
                document.set_shape(shape).unwrap();
                assert!((of(&document.point) / of(&before) - 1.0).abs() < 1e-12, "{keeps:?} {shape:?}");
            }
            assert!((document.point.load / before.load - 1.0).abs() < 1e-12, "there and back");
        }
    }

    #[test]
    fn r_y_stays_where_it_is_held_and_follows_r_where_not() {
        use crate::scene::LoadFollower;
        let mut document = Document::default();
        document.set_shape(Shape::Ellipse).unwrap();
        document.set_load_follower(LoadFollower::Radius);
        let before = document.point;
        document.set_moes(Moes { m: 0.5 * before.moes().m, ..before.moes() }).unwrap();
        assert!(document.point.radius_m != before.radius_m);
        assert!((document.point.radius_ratio() / before.radius_ratio() - 1.0).abs() < 1e-12, "the same ellipse");
        let ratio = document.point.radius_ratio();
        document.type_quantity(Quantity::RadiusY, 1.5 * ratio * document.point.radius_m).unwrap();
        let held = document.point.radius_y_m;
        document.set_moes(before.moes()).unwrap();
        assert_eq!(document.point.radius_y_m, held);
        let said = document.set_quantity(Quantity::RadiusRatio, 2.0).unwrap_err();
        assert!(said.contains("R_y is held"), "{said}");
        document.view.held.set(Quantity::RadiusY, false);
        document.set_quantity(Quantity::RadiusRatio, 2.0).unwrap();
        assert!((document.point.radius_ratio() - 2.0).abs() < 1e-12);
        // A typed R changes only R; the other quantities keep their values.
        let radius_y = document.point.radius_y_m;
        document.type_quantity(Quantity::Radius, 1.1 * document.point.radius_m).unwrap();
        assert_eq!(document.point.radius_y_m, radius_y);
        assert!(document.set_quantity(Quantity::RadiusRatio, 1000.0).unwrap_err().contains("between"));
    }
}
