//! Features of the surfaces of a transient contact: their kinds, usual sizes for a contact, and profiles from a table.

use super::Document;
use crate::app::refusal::Refusal;
use crate::scene::study::transient::{SurfaceFeature, SurfaceShape, read_profile};
use crate::scene::{Grid, TransientStudy};
use crate::solver::full::transient::{Frame, Scheme, Signal, TimeStep};
use crate::solver::physics::contact::OperatingPoint;
use std::path::Path;

/// Kind of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// Dent of a ball.
    Dent,
    /// Gaussian bump, a ridge in a line contact.
    Bump,
    /// Wave packet of Venner and Lubrecht.
    Packet,
    /// Wave behind a smooth front.
    Wave,
    /// Measured heights.
    Profile,
}

/// Position X of a new feature at T = 0, and the position where a new run ends.
const BEFORE: f64 = -2.5;
const BEHIND: f64 = 1.5;
/// Slowest body whose feature starts in front of the contact. Slower ones start inside it.
const SLOWEST: f64 = 0.1;
/// Duration of a run with a feature at rest.
const AT_REST: f64 = 2.0;
/// Height of a new feature over the central film thickness, and its limit in a²/R.
const OF_FILM: f64 = 0.5;
const HIGHEST: f64 = 0.1;
/// Largest number of points of a profile in a document. The limit exists because undo stores many copies.
const MOST_POINTS: usize = 20_000;

impl FeatureKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::Dent, Self::Bump, Self::Packet, Self::Wave, Self::Profile];

    /// Returns the kind of a shape.
    pub fn of(shape: &SurfaceShape) -> Self {
        match shape {
            SurfaceShape::Dent { .. } => Self::Dent,
            SurfaceShape::Gauss { .. } => Self::Bump,
            SurfaceShape::Venner { .. } => Self::Packet,
            SurfaceShape::Wave { .. } => Self::Wave,
            SurfaceShape::Profile(_) | SurfaceShape::Sampled { .. } => Self::Profile,
        }
    }

    /// Returns the name and the description.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Dent => {
                ("Dent", "−d cos(½π r/1.2r₀) exp(−2 (r/1.2r₀)²), as a ball leaves it (Mourier and others 2006)")
            }
            Self::Bump => ("Bump", "A exp(−y²/W²): a ridge in a line contact, round in a circular one"),
            Self::Packet => ("Wave packet", "A 10^(−10 (y/W)²) cos(2π y/W) (Venner and Lubrecht 1994)"),
            Self::Wave => ("Wave", "A cos(2π (X − sT)/W) behind a front of one wavelength"),
            Self::Profile => ("Profile", "Measured heights, columns x and height in metres"),
        }
    }

    /// Returns a shape of this kind with the height, the length and the place of another. `None` for a profile, which a
    /// table gives.
    pub fn shape(self, like: &SurfaceShape, point: &OperatingPoint) -> Option<SurfaceShape> {
        let SurfaceSizes { height, length, at } = SurfaceSizes::of(like).unwrap_or_else(|| SurfaceSizes::usual(point));
        Some(match self {
            Self::Dent => SurfaceShape::Dent { depth: height.abs(), radius: length, at },
            Self::Bump => SurfaceShape::Gauss { height, width: length, at },
            Self::Packet => SurfaceShape::Venner { height, width: 3.0 * length, at },
            Self::Wave => SurfaceShape::Wave { height, wavelength: 2.0 * length, front: None, at },
            Self::Profile => return None,
        })
    }
}

/// Height \[m\], length of one flank \[m\] and place X of a shape.
struct SurfaceSizes {
    height: f64,
    length: f64,
    at: f64,
}

impl SurfaceSizes {
    /// Returns those of a shape. `None` for measured heights.
    fn of(shape: &SurfaceShape) -> Option<Self> {
        let (height, length, at) = match *shape {
            SurfaceShape::Dent { depth, radius, at } => (depth, radius, at),
            SurfaceShape::Gauss { height, width, at } => (height, width, at),
            SurfaceShape::Venner { height, width, at } => (height, width / 3.0, at),
            SurfaceShape::Wave { height, wavelength, at, .. } => (height, 0.5 * wavelength, at),
            SurfaceShape::Profile(_) | SurfaceShape::Sampled { .. } => return None,
        };
        Some(Self { height, length, at })
    }

    /// Returns those of a new feature: half of the film thickness, a third of the half-width.
    fn usual(point: &OperatingPoint) -> Self {
        let round = |value: f64| format!("{value:.1e}").parse().unwrap_or(value);
        let height = (OF_FILM * point.formula_film_m()).min(HIGHEST * point.film_scale_m());
        Self { height: round(height), length: round(0.3 * point.hertz().half_width_m), at: BEFORE }
    }
}

/// Returns height and length of a shape, to be changed. `None` for measured heights.
pub fn sizes_of(shape: &mut SurfaceShape) -> Option<(&mut f64, &mut f64)> {
    match shape {
        SurfaceShape::Dent { depth, radius, .. } => Some((depth, radius)),
        SurfaceShape::Gauss { height, width, .. } | SurfaceShape::Venner { height, width, .. } => Some((height, width)),
        SurfaceShape::Wave { height, wavelength, .. } => Some((height, wavelength)),
        SurfaceShape::Profile(_) | SurfaceShape::Sampled { .. } => None,
    }
}

/// Returns X of a shape at T = 0, to be changed. `None` for a profile that a scene names by its file.
pub fn place_of(shape: &mut SurfaceShape) -> Option<&mut f64> {
    match shape {
        SurfaceShape::Dent { at, .. }
        | SurfaceShape::Gauss { at, .. }
        | SurfaceShape::Venner { at, .. }
        | SurfaceShape::Wave { at, .. }
        | SurfaceShape::Sampled { at, .. } => Some(at),
        SurfaceShape::Profile(_) => None,
    }
}

impl Document {
    /// Returns a new feature of this kind on body 1. A profile is replaced by a dent.
    pub fn new_feature(&self, kind: FeatureKind) -> SurfaceFeature {
        let SurfaceSizes { height, length, at } = SurfaceSizes::usual(&self.point);
        let dent = SurfaceShape::Dent { depth: height, radius: length, at };
        let mut feature =
            SurfaceFeature { body: 1, shape: kind.shape(&dent, &self.point).unwrap_or_else(|| dent.clone()) };
        if feature.speed(self.point.sliding.slide_to_roll_ratio).abs() < SLOWEST
            && let Some(at) = place_of(&mut feature.shape)
        {
            *at = 0.0;
        }
        feature
    }

    /// Adds a feature to a transient study. The first one replaces inputs, methods and steps by those with which it
    /// passes the contact.
    pub fn add_feature(&self, study: &mut TransientStudy, mut feature: SurfaceFeature) {
        if study.surfaces.is_empty() {
            let speed = feature.speed(self.point.sliding.slide_to_roll_ratio).abs();
            let (scheme, step) = match self.transient_grid() {
                Grid::Uniform { dx, .. } => (Scheme::Characteristic, dx),
                Grid::Plane(spec) => (Scheme::Default, spec.dx),
                _ => (Scheme::Default, 0.01),
            };
            let way = BEHIND - place_of(&mut feature.shape).map_or(BEFORE, |at| *at);
            let wanted = if speed < SLOWEST { AT_REST } else { way / speed };
            (study.scheme, study.time_step) = (scheme, TimeStep::Fixed(step));
            study.duration = (wanted / step).ceil() * step;
            (study.inputs.load, study.sampled, study.window) = (Signal::Constant, None, None);
        }
        (study.inputs.speed, study.inputs.radius) = (Signal::Constant, Signal::Constant);
        study.frames = vec![Frame::Fixed];
        study.drop_models();
        study.surfaces.push(feature);
    }

    /// Reads the heights of a profile from a table and puts them on feature `k`, or on a new one. The document stores
    /// their values.
    ///
    /// # Errors
    /// A sentence with the invalid line, or the reason why the profile is refused. The document is then unchanged.
    pub fn read_profile(&mut self, k: usize, path: &Path) -> Result<(), Refusal> {
        let (places, heights): (Vec<f64>, Vec<f64>) = read_profile(path)?.into_iter().map(|[x, h]| (x, h)).unzip();
        if places.len() > MOST_POINTS {
            return Err(Refusal::new(format!(
                "the table has {} points, but a scene edited here stores at most {MOST_POINTS}; reduce the table, or name \
                 the file in the scene as `Profile`",
                places.len()
            )));
        }
        let mut study = self.transient_study();
        let mut feature = study.surfaces.get(k).cloned().unwrap_or_else(|| self.new_feature(FeatureKind::Dent));
        let at = place_of(&mut feature.shape).map_or(BEFORE, |at| *at);
        feature.shape = SurfaceShape::Sampled { places, heights, at };
        match study.surfaces.get_mut(k) {
            Some(own) => *own = feature,
            None => self.add_feature(&mut study, feature),
        }
        self.set_transient(study)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Shape;
    use crate::solver::parameters::Quantity;

    #[test]
    fn new_features_are_accepted_and_pass_the_contact() {
        for shape in [Shape::Roller, Shape::Ball] {
            for srr in [0.0, -0.5, 1.0, 2.0] {
                let mut document = Document::default();
                document.set_shape(shape).unwrap();
                document.set_quantity(Quantity::SlideToRollRatio, srr).unwrap();
                for kind in FeatureKind::ALL {
                    let mut study = document.transient_study();
                    let feature = document.new_feature(kind);
                    document.add_feature(&mut study, feature.clone());
                    let moving = feature.moving(&document.point, |_| Err(())).unwrap();
                    let end = moving.at + moving.speed * study.duration;
                    assert!(end >= BEHIND - 1e-9 || moving.speed < SLOWEST, "{kind:?} at SRR {srr} ends at {end}");
                    document.clone().set_transient(study).unwrap();
                }
            }
        }
    }

    #[test]
    fn another_kind_keeps_height_length_and_place() {
        let document = Document::default();
        let dent = document.new_feature(FeatureKind::Dent).shape;
        for kind in FeatureKind::ALL.into_iter().filter(|kind| *kind != FeatureKind::Profile) {
            let there = kind.shape(&dent, &document.point).unwrap();
            assert_eq!(FeatureKind::of(&there), kind);
            let SurfaceShape::Dent { depth, radius, at } = FeatureKind::Dent.shape(&there, &document.point).unwrap()
            else {
                panic!()
            };
            let SurfaceShape::Dent { depth: d, radius: r, at: x } = dent else { panic!() };
            assert!((depth / d - 1.0).abs() < 1e-12 && (radius / r - 1.0).abs() < 1e-12 && at == x, "{kind:?}");
        }
    }
}
