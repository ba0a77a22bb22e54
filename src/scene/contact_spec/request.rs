//! From a stated contact to what is to be solved. Everything is checked here, once.

use super::facts::Measure;
use super::fields::{ContactSpec, Field};
use super::given::{MethodName, OilGrade};
use super::refusal::{Refusal, refuse};
use crate::scene::at::At;
use crate::scene::bench::Request;
use crate::scene::grid::Grid;
use crate::scene::method::{Method, ModelSource};
use crate::solver::limits::Number;
use crate::solver::physics::contact::{ContactError, OperatingPoint, Quantity, reduced_modulus};
use crate::solver::physics::engineering::{Grade, Oil, OilFamily, OilState};
use crate::solver::physics::lubricant::{Lubricant, Sliding};

/// The constants of one body and of the other one.
const BODIES: [Field; 4] = [Field::E1, Field::Nu1, Field::E2, Field::Nu2];

impl ContactSpec {
    /// What is to be solved, and how.
    ///
    /// # Errors
    /// With the field that contradicts another one, is missing, or outside any sense.
    pub fn request(&self) -> Result<(Request, Method), Refusal> {
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
        let grid = self.grid_for(full, &point)?;
        let method = if full { Method::Full } else { Method::reduced(grid_model.clone()) };
        Ok((Request { point, lubricant, grid, grid_model }, method))
    }

    /// Refuses numbers outside the ranges of their fields; a concave R_y gets its own sentence later.
    fn check_ranges(&self) -> Result<(), Refusal> {
        for &field in Field::ALL.iter().filter(|field| **field != Field::RadiusY) {
            let (Some(value), Measure::Of(quantity)) = (self.number(field), field.facts().measure) else { continue };
            let (low, high) = quantity.range();
            if !(low..=high).contains(&value) {
                let (name, unit) = (field.facts().name, quantity.unit());
                let title = if matches!(quantity, Quantity::M | Quantity::L) { ": Moes number " } else { "" };
                let symbol = if title.is_empty() { "" } else { quantity.name() };
                let (value, low, high) = (Number(value), Bound(low), Bound(high));
                let accepted = format!("must be a finite number between {low} and {high}{unit}");
                return refuse(field, format!("<{name}>{title}{symbol} is {value}{unit}, but {accepted}"));
            }
        }
        Ok(())
    }

    /// The operating point of a contact with these laws.
    ///
    /// # Errors
    /// With the field that is missing, contradicts another one, or is outside any sense.
    pub fn operating_point(&self, lubricant: &Lubricant) -> Result<OperatingPoint, Refusal> {
        self.check_ranges()?;
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
        let at = self.numbers([self.radius, self.speed, self.load, modulus, viscosity, alpha])?;
        let point = at.point(self.kind()).map_err(|error| self.of_contact(&error))?;
        let slide_to_roll_ratio = self.srr.unwrap_or(0.0);
        Ok(OperatingPoint { sliding: Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: self.npr }, ..point })
    }

    /// The six SI quantities, or Moes' numbers with those of them that are known.
    fn numbers(&self, [radius, speed, load, modulus, viscosity, alpha]: [Option<f64>; 6]) -> Result<At, Refusal> {
        let radius_y = self.radius_y;
        let fields = [Field::Radius, Field::Speed, Field::Load, Field::Modulus, Field::Viscosity, Field::Alpha];
        match (self.moes_m, self.moes_l) {
            (Some(m), Some(l)) => Ok(At::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha }),
            (Some(_), None) => refuse(Field::MoesL, "<moes-m> and <moes-l> belong together; give both"),
            (None, Some(_)) => refuse(Field::MoesM, "<moes-m> and <moes-l> belong together; give both"),
            (None, None) => match (radius, speed, load, modulus, viscosity, alpha) {
                (Some(radius), Some(speed), Some(load), Some(modulus), Some(viscosity), Some(alpha)) => {
                    Ok(At::Si { radius, radius_y, speed, load, modulus, viscosity, alpha })
                }
                _ => {
                    let given = [radius, speed, load, modulus, viscosity, alpha];
                    let missing = fields.into_iter().zip(given).filter_map(|(field, given)| match given {
                        None => Some(field),
                        Some(_) => None,
                    });
                    let marks: Vec<String> = missing.clone().map(|field| format!("<{}>", field.facts().name)).collect();
                    refuse(
                        missing.clone().next().unwrap_or(Field::Radius),
                        format!(
                            "the operating point is incomplete: give {} too, or <moes-m> and <moes-l> instead",
                            marks.join(", ")
                        ),
                    )
                }
            },
        }
    }

    /// E′, as it is stated or of both bodies.
    fn reduced_modulus(&self) -> Result<Option<f64>, Refusal> {
        let Some(field) = BODIES.into_iter().find(|field| self.states(*field)) else { return Ok(self.modulus) };
        if self.modulus.is_some() {
            return refuse(
                Field::Modulus,
                "<modulus> and <e1> <nu1> <e2> <nu2> say the same thing; give one of both",
            );
        }
        match (self.e1, self.nu1, self.e2, self.nu2) {
            (Some(e1), Some(nu1), Some(e2), Some(nu2)) => reduced_modulus(e1, nu1, e2, nu2).map(Some).map_err(|error| {
                let sentence = error.to_string();
                let named = |field: &Field| sentence.contains(&format!(" {} is", field.facts().name));
                Refusal::new(BODIES.into_iter().find(named).unwrap_or(field), sentence.clone())
            }),
            _ => {
                let missing = BODIES.into_iter().find(|field| !self.states(*field)).unwrap_or(field);
                refuse(missing, "two bodies need all of <e1>, <nu1>, <e2> and <nu2>")
            }
        }
    }

    /// The oil of a grade at its temperature.
    fn oil_state(&self) -> Result<Option<OilState>, Refusal> {
        let (OilGrade(grade), temperature_k) = match (self.oil, self.temperature) {
            (Some(grade), Some(temperature)) => (grade, temperature),
            (Some(_), None) => return refuse(Field::Temperature, "<oil> needs a temperature; give <temperature> too"),
            (None, Some(_)) => {
                return refuse(Field::Oil, "<temperature> needs an oil; give <oil> too, as ISO VG 68");
            }
            (None, None) => return Ok(None),
        };
        if self.viscosity.is_some() || self.lubricant.is_some() {
            return refuse(Field::Oil, "<oil> says what <viscosity> and <lubricant> say; give one of them");
        }
        let family = OilFamily::Mineral;
        let oil = Oil { grade: Grade::IsoVg(grade), family, temperature_k, density_15: family.usual_density() };
        oil.state().map(Some).map_err(|error| Refusal::new(Field::Oil, format!("<oil>: {error}")))
    }

    /// The refusal of an operating point, of the field that it is about.
    fn of_contact(&self, error: &ContactError) -> Refusal {
        let sentence = error.to_string();
        match error {
            ContactError::OutOfRange { quantity, .. } => {
                let field = Field::named(quantity).filter(|field| self.states(*field));
                field.map_or_else(
                    || Refusal::new(Field::Contact, sentence.clone()),
                    |field| Refusal::new(field, sentence.replacen(quantity, &format!("<{quantity}>"), 1)),
                )
            }
            ContactError::LineAcross | ContactError::Concave { .. } => {
                Refusal::new(Field::RadiusY, sentence.replacen("radius-y", "<radius-y>", 1))
            }
            ContactError::Overdetermined { .. } => Refusal::new(Field::MoesM, sentence),
        }
    }
}

/// An end of a range: plain where that is short.
struct Bound(f64);

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let plain = self.0 == 0.0 || (0.01..1e4).contains(&self.0.abs());
        if plain { write!(f, "{}", self.0) } else { write!(f, "{:e}", self.0) }
    }
}
