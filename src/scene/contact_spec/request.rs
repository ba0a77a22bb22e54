//! Converts a contact specification into a request. All checks of the specification are made here.

use super::fields::{ContactSpec, Field};
use super::given::{MethodName, OilGrade};
use super::refusal::{Refusal, refuse};
use crate::scene::answer::Request;
use crate::scene::at::At;
use crate::scene::grid::Grid;
use crate::scene::method::{Method, ModelSource};
use crate::solver::limits::Number;
use crate::solver::parameters::Quantity;
use crate::solver::physics::bodies::reduced_radius_m;
use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint, reduced_modulus};
use crate::solver::physics::engineering::{Extent, Grade, Oil, OilFamily, OilState};
use crate::solver::physics::lubricant::{Lubricant, Sliding};

/// The six SI quantities.
const SI: [Field; 6] = [Field::Radius, Field::Speed, Field::Load, Field::Modulus, Field::Viscosity, Field::Alpha];
/// Fields of the motion, with the quantities that define their ranges.
const SLIDING: [(Field, Quantity); 2] =
    [(Field::Srr, Quantity::SlideToRollRatio), (Field::Npr, Quantity::NewtonianPlateauRatio)];
/// Elastic constants of both bodies.
const BODIES: [Field; 4] = [Field::E1, Field::Nu1, Field::E2, Field::Nu2];

impl ContactSpec {
    /// Returns the request to solve.
    ///
    /// # Errors
    /// With the first field that is out of range, missing, or inconsistent with another one.
    pub fn request(&self) -> Result<Request, Refusal> {
        if let Some(plain) = self.of_machine()? {
            return plain.request();
        }
        let lubricant = self.lubricant()?;
        let grid_model = self.rom.clone().map_or(ModelSource::Embedded, ModelSource::File);
        let full = self.method != Some(MethodName::Reduced);
        if full && self.rom.is_some() && self.grid != Some(Grid::Model) {
            return refuse(
                Field::Rom,
                "<rom> has no effect here; add <method=reduced>, or <grid=model> for a full solution on the model's grid",
            );
        }
        let point = self.operating_point(&lubricant)?;
        let grid = self.grid_for(full, &lubricant.grid_contact(&point))?;
        let method = if full { Method::Full } else { Method::reduced(grid_model.clone()) };
        Ok(Request { point, lubricant, grid, grid_model, method, extent: self.extent()? })
    }

    /// Returns the operating point of a contact with these laws.
    ///
    /// # Errors
    /// With the first field that is out of range, missing, or inconsistent with another one.
    pub fn operating_point(&self, lubricant: &Lubricant) -> Result<OperatingPoint, Refusal> {
        if let Some(plain) = self.of_machine()? {
            return plain.operating_point(lubricant);
        }
        for (field, quantity) in SLIDING {
            let (low, high) = quantity.range();
            if let Some(value) = self.number(field).filter(|value| !(low..=high).contains(value)) {
                let (name, value) = (field.facts().name, Number(value));
                return refuse(
                    field,
                    format!("<{name}> is {value}, but must be a finite number between {low} and {high}"),
                );
            }
        }
        let (speed, slide_to_roll_ratio) = self.motion()?;
        let modulus = self.reduced_modulus()?;
        let oil = self.oil_state()?;
        let named = self.lubricant.and_then(|named| named.viscosity_pa_s);
        let viscosity = self.viscosity.or(oil.map(|oil| oil.viscosity_pa_s)).or(named);
        let own_alpha = lubricant.own_coefficient();
        if let (Some(_), Some(own)) = (self.alpha, own_alpha) {
            let sentence = format!("<alpha> follows from the lubricant's viscosity law ({own:.4e} 1/Pa); leave it out");
            return refuse(Field::Alpha, sentence);
        }
        let alpha = own_alpha.or(self.alpha).or(oil.map(|oil| oil.alpha_per_pa));
        let alpha = alpha.or(self.lubricant.and_then(|named| named.alpha_per_pa));
        let at = self.numbers([self.reduced_radius()?, speed, self.load_of_kind()?, modulus, viscosity, alpha])?;
        let point = at.point(self.kind()).map_err(|error| self.of_contact(&error))?;
        Ok(OperatingPoint { sliding: Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: self.npr }, ..point })
    }

    /// Returns length and radii of the bodies as stated.
    fn extent(&self) -> Result<Extent, Refusal> {
        let (least, most) = Extent::LENGTHS_M;
        if let Some(length) = self.length {
            if self.kind().is_point() {
                return refuse(Field::Length, "<length> belongs to a line contact; leave it out");
            }
            if !(least..=most).contains(&length) {
                let length = Number(length);
                return refuse(
                    Field::Length,
                    format!("<length> is {length} m, but must be between {least} and {most}"),
                );
            }
        }
        Ok(Extent { length_m: self.length, radii_m: [self.radius1, self.radius2] })
    }

    /// Returns the load \[N/m\] or \[N\], as stated or from the total load over the length of a line contact.
    fn load_of_kind(&self) -> Result<Option<f64>, Refusal> {
        let Some(total) = self.total_load else { return Ok(self.load) };
        if self.load.is_some() || self.moes_m.is_some() {
            return refuse(Field::TotalLoad, "<total-load> says what <load> or <moes-m> says; leave one of them out");
        }
        match (self.kind(), self.extent()?.length_m) {
            (ContactKind::Point, _) => refuse(Field::TotalLoad, "<total-load> belongs to a line contact; give <load>"),
            (ContactKind::Line, Some(length)) => Ok(Some(total / length)),
            (ContactKind::Line, None) => {
                refuse(Field::Length, "a load in N on a line contact needs its length; give <length> too")
            }
        }
    }

    /// Returns R as stated, or from the radii of both bodies, 1/R = 1/R₁ + 1/R₂ (2.3).
    fn reduced_radius(&self) -> Result<Option<f64>, Refusal> {
        let radii = [self.radius1, self.radius2];
        let Some(field) = [Field::Radius1, Field::Radius2].into_iter().find(|field| self.states(*field)) else {
            return Ok(self.radius);
        };
        if self.radius.is_some() {
            return refuse(
                Field::Radius,
                "<radius> and <radius1> <radius2> give the same quantity; leave one of them out",
            );
        }
        reduced_radius_m(radii)
            .map(Some)
            .map_err(|error| Refusal::new(field, format!("<radius1> and <radius2>: {error}")))
    }

    /// u_m and SRR, as they are stated or of both surfaces. X points where the lubricant is entrained.
    fn motion(&self) -> Result<(Option<f64>, f64), Refusal> {
        let (Some(u1), Some(u2)) = (self.u1, self.u2) else {
            return match [(self.u1, Field::U2), (self.u2, Field::U1)].into_iter().find(|(given, _)| given.is_some()) {
                Some((_, missing)) => refuse(missing, "<u1> and <u2> belong together; give both"),
                None => Ok((self.speed, self.srr.unwrap_or(0.0))),
            };
        };
        if let Some(field) = [Field::Speed, Field::Srr].into_iter().find(|field| self.states(*field)) {
            return refuse(field, "<u1> and <u2> say what <speed> and <srr> say; give two of them");
        }
        let (mean, sliding) = (0.5 * (u1 + u2), u2 - u1);
        let (low, high) = Quantity::SlideToRollRatio.range();
        if !(low..=high).contains(&(sliding / mean)) {
            let (u1, u2, srr) = (Number(u1), Number(u2), Number(sliding / mean));
            let sentence = if mean == 0.0 {
                "their mean entrains no lubricant, and without heat there is no film".to_owned()
            } else {
                format!("SRR is {srr}, but must be a finite number between {low} and {high}")
            };
            return refuse(Field::U2, format!("<u1> is {u1} m/s and <u2> is {u2} m/s: {sentence}"));
        }
        Ok((Some(mean.abs()), sliding / mean))
    }

    /// Returns the six SI quantities, or the Moes numbers with the SI quantities that are given.
    fn numbers(&self, given: [Option<f64>; 6]) -> Result<At, Refusal> {
        let (radius_y, [radius, speed, load, modulus, viscosity, alpha]) = (self.radius_y, given);
        if let (Some(m), Some(l)) = (self.moes_m, self.moes_l) {
            return Ok(At::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha });
        }
        if let Some((_, missing)) = self.moes_m.zip(Some(Field::MoesL)).or(self.moes_l.zip(Some(Field::MoesM))) {
            return refuse(missing, "<moes-m> and <moes-l> belong together; give both");
        }
        if let [Some(radius), Some(speed), Some(load), Some(modulus), Some(viscosity), Some(alpha)] = given {
            return Ok(At::Si { radius, radius_y, speed, load, modulus, viscosity, alpha });
        }
        let missing: Vec<Field> =
            SI.into_iter().zip(given).filter(|(_, given)| given.is_none()).map(|(field, _)| field).collect();
        let marks: Vec<String> = missing.iter().map(|field| format!("<{}>", field.facts().name)).collect();
        let (first, marks) = (missing.first().copied().unwrap_or(Field::Radius), marks.join(", "));
        let instead = "or <moes-m> and <moes-l> instead";
        refuse(first, format!("the operating point is incomplete: give {marks} too, {instead}"))
    }

    /// Returns E′ as stated, or computed from both bodies.
    pub(super) fn reduced_modulus(&self) -> Result<Option<f64>, Refusal> {
        let Some(stated) = BODIES.into_iter().find(|field| self.states(*field)) else { return Ok(self.modulus) };
        if self.modulus.is_some() {
            return refuse(
                Field::Modulus,
                "<modulus> and <e1> <nu1> <e2> <nu2> give the same quantity; leave one of them out",
            );
        }
        let (Some(e1), Some(nu1), Some(e2), Some(nu2)) = (self.e1, self.nu1, self.e2, self.nu2) else {
            let missing = BODIES.into_iter().find(|field| !self.states(*field)).unwrap_or(stated);
            return refuse(missing, "two bodies need all of <e1>, <nu1>, <e2> and <nu2>");
        };
        reduced_modulus(e1, nu1, e2, nu2).map(Some).map_err(|error| {
            let sentence = error.to_string();
            let field = BODIES.into_iter().find(|field| sentence.contains(&format!(" {} is", field.facts().name)));
            Refusal::new(field.unwrap_or(stated), sentence)
        })
    }

    /// Returns viscosity and α of the stated oil grade at its temperature.
    pub(super) fn oil_state(&self) -> Result<Option<OilState>, Refusal> {
        let (OilGrade(grade), temperature_k) = match (self.oil, self.temperature) {
            (Some(grade), Some(temperature)) => (grade, temperature),
            (Some(_), None) => return refuse(Field::Temperature, "<oil> needs a temperature; give <temperature> too"),
            (None, Some(_)) => {
                return refuse(Field::Oil, "<temperature> needs an oil; give <oil> too, as ISO VG 68");
            }
            (None, None) => return Ok(None),
        };
        if self.viscosity.is_some() || self.lubricant.is_some() {
            return refuse(
                Field::Oil,
                "<oil> determines <viscosity> and <lubricant>; leave out <oil>, or both of them",
            );
        }
        let family = OilFamily::Mineral;
        let oil = Oil {
            grade: Grade::IsoVg(grade),
            family,
            temperature_k,
            density_15: family.usual_density(),
            alpha_per_pa: None,
        };
        oil.state().map(Some).map_err(|error| Refusal::new(Field::Oil, format!("<oil>: {error}")))
    }

    /// Returns the refusal of an operating point, assigned to the field that causes it.
    fn of_contact(&self, error: &ContactError) -> Refusal {
        let sentence = error.to_string();
        let quantity = match error {
            ContactError::OutOfRange { quantity, .. } => quantity,
            ContactError::LineAcross | ContactError::Concave { .. } => "radius-y",
            ContactError::Overdetermined { .. } => return Refusal::new(Field::MoesM, sentence),
            ContactError::Isoviscous { .. } => {
                let sentence = sentence.replacen("alpha", "<alpha>", 1);
                return Refusal::new(if self.alpha.is_some() { Field::Alpha } else { Field::MoesL }, sentence);
            }
        };
        match quantity {
            "Moes number M" if self.moes_m.is_some() => Refusal::new(Field::MoesM, format!("<moes-m>: {sentence}")),
            "Moes number L" if self.moes_l.is_some() => Refusal::new(Field::MoesL, format!("<moes-l>: {sentence}")),
            _ => match Field::named(quantity).filter(|field| self.states(*field)) {
                Some(field) => Refusal::new(field, sentence.replacen(quantity, &format!("<{quantity}>"), 1)),
                None => Refusal::new(Field::Contact, sentence),
            },
        }
    }
}
