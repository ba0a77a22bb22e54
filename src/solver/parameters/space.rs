//! Space of contacts: varied quantities, limits on dependent quantities, and fixed values.

use super::axis::Axis;
use super::named::{self, Named};
use super::quantity::Quantity;
use super::sampling;
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, DEFAULT_VISCOSITY_PA_S, MoesRequest, OperatingPoint};
use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};

/// R_y/R of spaces of line contacts and of circular contacts.
pub const CIRCLES: (f64, f64) = (1.0, 1.0);

/// Factor by which a training extends beyond the ends of a space with lubricant ranges.
const BEYOND: f64 = 1.04;
/// The same for the sliding speed of a space of thermal constants. Full solutions have the mean constants, and
/// heating increases with β and with 1/k.
const BEYOND_SLIDING: f64 = 2.0;

/// Set of contacts for which a reduced model is trained, or from which random contacts are drawn.
///
/// A contact is given by M and L, or by R, u_m and w. Quantities that are neither varied nor fixed have the values of
/// the default realisation ([`MoesRequest`]).
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterSpace {
    /// Varied quantities, in the order in which random coordinates are drawn.
    #[serde(deserialize_with = "named::deserialize")]
    pub axes: Vec<Axis>,
    /// Intervals of quantities that follow from the axes.
    #[serde(deserialize_with = "named::deserialize", default)]
    pub limits: Vec<(Quantity, (f64, f64))>,
    /// Values that all contacts share.
    #[serde(deserialize_with = "named::deserialize", default)]
    pub fixed: Vec<(Quantity, f64)>,
    /// Constants of lubricant and bodies that vary independently of the axes. The reduced equations contain them
    /// exactly; the full solutions of a basis contain some of their values.
    #[serde(deserialize_with = "named::deserialize", default)]
    pub constants: Vec<Axis>,
}

impl Serialize for ParameterSpace {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Formats that are not self-describing need all lists.
        let always = !serializer.is_human_readable();
        let Self { axes, limits, fixed, constants } = self;
        let written = [!limits.is_empty(), !fixed.is_empty(), !constants.is_empty()].map(|has| has || always);
        let count = 1 + written.into_iter().filter(|has| *has).count();
        let mut lists = serializer.serialize_struct("ParameterSpace", count)?;
        lists.serialize_field("axes", &Named(axes))?;
        let [limited, fixes, has_constants] = written;
        if limited {
            lists.serialize_field("limits", &Named(limits))?;
        }
        if fixes {
            lists.serialize_field("fixed", &Named(fixed))?;
        }
        if has_constants {
            lists.serialize_field("constants", &Named(constants))?;
        }
        lists.end()
    }
}

impl ParameterSpace {
    /// Creates a space of these axes.
    pub fn of(axes: impl IntoIterator<Item = Axis>) -> Self {
        Self { axes: axes.into_iter().collect(), ..Self::default() }
    }

    /// Returns the space with additional limits.
    pub fn limited(mut self, limits: impl IntoIterator<Item = (Quantity, (f64, f64))>) -> Self {
        self.limits.extend(limits);
        self
    }

    /// Returns the space with additional fixed values.
    pub fn fixing(mut self, fixed: impl IntoIterator<Item = (Quantity, f64)>) -> Self {
        self.fixed.extend(fixed);
        self
    }

    /// Returns the axis of a quantity.
    pub fn axis(&self, quantity: Quantity) -> Option<&Axis> {
        self.axes.iter().find(|axis| axis.quantity == quantity)
    }

    /// Returns the axis of a quantity, for a change.
    pub fn axis_mut(&mut self, quantity: Quantity) -> Option<&mut Axis> {
        self.axes.iter_mut().find(|axis| axis.quantity == quantity)
    }

    /// Returns the limits of a quantity that follows from the axes.
    pub fn limit(&self, quantity: Quantity) -> Option<(f64, f64)> {
        self.limits.iter().find(|(own, _)| *own == quantity).map(|(_, ends)| *ends)
    }

    /// Returns the value of a quantity that all contacts share.
    pub fn fixed(&self, quantity: Quantity) -> Option<f64> {
        self.fixed.iter().find(|(own, _)| *own == quantity).map(|(_, value)| *value)
    }

    /// Returns the interval of a constant of lubricant or bodies that varies.
    pub fn constant(&self, quantity: Quantity) -> Option<(f64, f64)> {
        self.constants.iter().find(|axis| axis.quantity == quantity).map(|axis| axis.ends)
    }

    /// True if a quantity varies along an axis.
    pub fn varies(&self, quantity: Quantity) -> bool {
        self.axis(quantity).is_some()
    }

    /// True if a quantity varies or is fixed.
    pub fn gives(&self, quantity: Quantity) -> bool {
        self.varies(quantity) || self.fixed(quantity).is_some()
    }

    /// True if a quantity varies or is limited.
    pub fn knows(&self, quantity: Quantity) -> bool {
        self.varies(quantity) || self.limit(quantity).is_some()
    }

    /// True for a box of SI quantities, without M and L.
    pub fn is_si_box(&self) -> bool {
        !self.gives(Quantity::M)
    }

    /// True if the lubricant varies: η₀ in addition to α. Such models consist of local reduced bases.
    pub fn varies_lubricant(&self) -> bool {
        self.varies(Quantity::Viscosity)
    }

    /// True if SRR varies.
    pub fn slides(&self) -> bool {
        self.varies(Quantity::SlideToRollRatio)
    }

    /// Returns R_y/R of its contacts; [`CIRCLES`] if it does not vary.
    pub fn radius_ratio(&self) -> (f64, f64) {
        self.axis(Quantity::RadiusRatio).map_or(CIRCLES, |axis| axis.ends)
    }

    /// True for a space of elliptical contacts.
    pub fn of_ellipses(&self) -> bool {
        self.varies(Quantity::RadiusRatio)
    }

    /// True for a space of contacts with rough surfaces.
    pub fn is_rough(&self) -> bool {
        self.varies(Quantity::SmoothFilmRatio)
    }

    /// Sets the limits of a quantity and replaces existing ones.
    pub fn set_limit(&mut self, quantity: Quantity, ends: (f64, f64)) {
        match self.limits.iter_mut().find(|(own, _)| *own == quantity) {
            Some((_, own)) => *own = ends,
            None => self.limits.push((quantity, ends)),
        }
    }

    /// Returns the interval of a quantity over all contacts of a kind. It is that of an axis, a limit or a fixed
    /// value, or the interval that follows from these. `None` if none of them determines it.
    pub fn interval(&self, quantity: Quantity, kind: ContactKind) -> Option<(f64, f64)> {
        let own = self.axis(quantity).map(|axis| axis.ends).or(self.fixed(quantity).map(|value| (value, value)));
        let within = |(low, high): (f64, f64)| {
            let (least, most) = self.limit(quantity).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
            (low.max(least), high.min(most))
        };
        own.map(within).or_else(|| self.limit(quantity)).or_else(|| match quantity {
            Quantity::HertzPressure => self.at_corners(quantity, kind).map(|(_, highest)| (0.0, highest)),
            Quantity::M | Quantity::L => self.at_corners(quantity, kind),
            Quantity::Viscosity => Some((DEFAULT_VISCOSITY_PA_S, DEFAULT_VISCOSITY_PA_S)),
            Quantity::Alpha => {
                let (low, high) = self.axis(Quantity::L)?.ends;
                let end = |l| MoesRequest::new(kind, 1.0, l).default_alpha();
                Some((end(low), end(high)))
            }
            _ => self.constant(quantity),
        })
    }

    /// Returns the space with additional limits that follow from its axes: those of p_H, and for a box of SI
    /// quantities those of M and L. They need not be computed again.
    pub fn with_followers(&self, kind: ContactKind) -> Self {
        let mut space = self.clone();
        for quantity in [Quantity::HertzPressure, Quantity::M, Quantity::L] {
            if let Some(ends) = self.interval(quantity, kind).filter(|_| !self.knows(quantity)) {
                space.set_limit(quantity, ends);
            }
        }
        space
    }

    /// Returns the smallest and largest value of a quantity at the corners of the axes, without limits. For products
    /// of powers of the axes this is the interval of all contacts.
    fn at_corners(&self, quantity: Quantity, kind: ContactKind) -> Option<(f64, f64)> {
        let free = Self { limits: Vec::new(), ..self.clone() };
        let values = sampling::corners(self.axes.len()).filter_map(|unit| quantity.of(&free.at(kind, &unit)?));
        let ends = values.fold((f64::INFINITY, 0.0f64), |(low, high), v| (low.min(v), high.max(v)));
        (ends.0 <= ends.1).then_some(ends)
    }

    /// Refuses intervals that are empty, inverted or outside the accepted values of a quantity, and spaces without
    /// contacts.
    ///
    /// # Errors
    /// If an entry is refused; the error names it.
    pub fn check(&self) -> Result<(), Refused> {
        let axes = [("axes", &self.axes), ("constants", &self.constants)];
        for (list, axis) in axes.into_iter().flat_map(|(list, axes)| axes.iter().map(move |axis| (list, axis))) {
            between(list, axis.quantity, axis.ends)?;
            if axis.scale == super::Scale::Log && axis.ends.0 <= 0.0 {
                let field = format!("{list}.{:?}", axis.quantity);
                return Err(Refused::new(field, "begins at zero, where ratios mean nothing; write it as Linear"));
            }
        }
        self.limits.iter().try_for_each(|(quantity, ends)| between("limits", *quantity, *ends))?;
        for (quantity, value) in &self.fixed {
            let (low, high) = quantity.range();
            number(&format!("fixed.{quantity:?}"), *value, low, high)?;
        }
        if self.axes.len() > sampling::MOST_AXES {
            return Err(Refused::new(
                "axes",
                format!("are {}; at most {} are supported", self.axes.len(), sampling::MOST_AXES),
            ));
        }
        self.check_names()
    }

    /// Refuses quantities in lists in which they have no meaning.
    fn check_names(&self) -> Result<(), Refused> {
        let settable = |quantity: Quantity| quantity.at(&OperatingPoint::TABLE_2_1, 0.3) != OperatingPoint::TABLE_2_1;
        let given = self.axes.iter().map(|axis| ("axes", axis.quantity));
        let given = given.chain(self.fixed.iter().map(|(quantity, _)| ("fixed", *quantity)));
        for (list, quantity) in given.clone() {
            if !settable(quantity) {
                let why =
                    "follows from other quantities or belongs to the lubricant; write it under `limits` or `constants`";
                return Err(Refused::new(format!("{list}.{quantity:?}"), why));
            }
            if given.clone().filter(|(_, other)| *other == quantity).count() > 1 {
                return Err(Refused::new(format!("{list}.{quantity:?}"), "is given twice; write it once"));
            }
        }
        if let Some(axis) = self.constants.iter().find(|axis| settable(axis.quantity)) {
            let why = "belongs to the operating point; write it under `axes`";
            return Err(Refused::new(format!("constants.{:?}", axis.quantity), why));
        }
        let has = |quantity: Quantity| given.clone().any(|(_, own)| own == quantity);
        if has(Quantity::SmoothFilmRatio) && (has(Quantity::Radius) || !has(Quantity::M)) {
            let why = "needs M and L, and determines the radius; leave out Radius, Speed and Load";
            return Err(Refused::new("axes.SmoothFilmRatio", why));
        }
        let moes = [Quantity::M, Quantity::L].map(has);
        let si = [Quantity::Radius, Quantity::Speed, Quantity::Load].map(has);
        match (moes, si) {
            ([true, true], [_, false, false]) | ([false, false], [true, true, true]) => Ok(()),
            _ => Err(Refused::new(
                "axes",
                "must give either M and L, or Radius, Speed and Load (each varied or fixed), but not a mixture of both",
            )),
        }
    }

    /// Returns the space that a training covers. If the lubricant varies, it is slightly larger on all sides, because
    /// solutions beyond the ends improve a model near its boundary.
    pub fn beyond(&self) -> Self {
        let mut wider = self.clone();
        if !self.varies_lubricant() {
            return wider;
        }
        let kept = [Quantity::RadiusRatio, Quantity::SlideToRollRatio, Quantity::NewtonianPlateauRatio];
        for axis in wider.axes.iter_mut().filter(|axis| !kept.contains(&axis.quantity)) {
            axis.ends = (axis.ends.0 / BEYOND, axis.ends.1 * BEYOND);
        }
        for (quantity, (low, high)) in &mut wider.limits {
            let warmer = *quantity == Quantity::SlidingSpeed && !self.constants.is_empty();
            let by = if warmer { BEYOND_SLIDING } else { BEYOND };
            (*low, *high) = (*low / by, *high * by);
        }
        wider
    }
}

fn between(list: &str, quantity: Quantity, ends: (f64, f64)) -> Result<(), Refused> {
    let (low, high) = quantity.range();
    interval(&format!("{list}.{quantity:?}"), ends, low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: ContactKind = ContactKind::Line;

    #[test]
    fn empty_and_inverted_intervals_are_refused() {
        for load in [(5e5, 1e5), (0.0, 1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
            let mut space = ParameterSpace::table_3_1();
            space.axis_mut(Quantity::Load).unwrap().ends = load;
            assert!(space.check().unwrap_err().to_string().contains("axes.Load"));
        }
        assert!(ParameterSpace::table_3_1().check().is_ok());
    }

    #[test]
    fn quantities_in_the_wrong_place_are_refused() {
        let moes = || ParameterSpace::of([Axis::new(Quantity::M, (2.0, 50.0)), Axis::new(Quantity::L, (2.0, 10.0))]);
        assert!(moes().check().is_ok());
        let refused = |space: ParameterSpace| space.check().unwrap_err().to_string();
        let pressure = ParameterSpace { axes: vec![Axis::new(Quantity::HertzPressure, (1e8, 1e9))], ..moes() };
        assert!(refused(pressure).contains("limits"));
        assert!(refused(moes().fixing([(Quantity::M, 3.0)])).contains("twice"));
        assert!(refused(moes().fixing([(Quantity::Speed, 3.0)])).contains("mixture"));
        assert!(refused(ParameterSpace::default()).contains("either M and L"));
        let radius = ParameterSpace { constants: vec![Axis::new(Quantity::Radius, (1e-3, 1e-2))], ..moes() };
        assert!(refused(radius).contains("axes"));
    }

    #[test]
    fn intervals_of_a_box_are_those_of_its_corners() {
        let space = ParameterSpace::table_3_1();
        let (low, high) = space.interval(Quantity::M, LINE).unwrap();
        // The dissertation prints them rounded, with a tilde.
        assert!((low / 7.4 - 1.0).abs() < 0.01 && (high / 164.6 - 1.0).abs() < 1e-3, "{low} {high}");
        let (low, high) = space.interval(Quantity::L, LINE).unwrap();
        assert!((low / 2.5 - 1.0).abs() < 0.02 && (high / 21.1 - 1.0).abs() < 5e-3, "{low} {high}");
        assert_eq!(space.interval(Quantity::Viscosity, LINE), Some((0.01, 0.01)));
    }

    #[test]
    fn a_space_survives_ron_and_json_and_refuses_unknown_quantities() {
        let space = ParameterSpace::of([
            Axis::new(Quantity::M, (2.0, 1000.0)),
            Axis::logarithmic(Quantity::L, (0.5, 25.0)),
            Axis::new(Quantity::Alpha, (8e-9, 30e-9)),
        ])
        .limited([(Quantity::HertzPressure, (0.2e9, 3.2e9))])
        .fixing([(Quantity::Viscosity, 0.01)]);
        let text = ron::to_string(&space).unwrap();
        assert_eq!(ron::from_str::<ParameterSpace>(&text).unwrap(), space, "{text}");
        let json = serde_json::to_string(&space).unwrap();
        assert_eq!(serde_json::from_str::<ParameterSpace>(&json).unwrap(), space, "{json}");
        let bytes = postcard::to_allocvec(&space).unwrap();
        assert_eq!(postcard::from_bytes::<ParameterSpace>(&bytes).unwrap(), space);
        let written = "(axes: {M: (2.0, 1000.0), L: (0.5, 25.0, Log), Alpha: (8e-9, 30e-9)}, \
             limits: {HertzPressure: (0.2e9, 3.2e9)}, fixed: {Viscosity: 0.01})";
        assert_eq!(ron::from_str::<ParameterSpace>(written).unwrap(), space);
        assert!(ron::from_str::<ParameterSpace>("(axes: {Q: (2.0, 1000.0)})").is_err());
        let twice = ron::from_str::<ParameterSpace>("(axes: {M: (2.0, 3.0), M: (2.0, 3.0)})").unwrap_err();
        assert!(twice.to_string().contains("given twice"), "{twice}");
    }
}
