//! The options of shear thinning and of a limiting stress, shared by `solve` and `sweep`.

use super::failure::Failure;
use crate::solver::physics::lubricant::{LimitingStress, Lubricant, ShearLaw};
use clap::{Args, ValueEnum};

/// Laws of shear thinning that can be written by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ShearName {
    /// Viscosity does not hang on stress.
    Newtonian,
    /// Ree and Eyring's hyperbolic sine.
    Eyring,
    /// The modified Carreau law (3.40).
    Carreau,
}

/// How viscosity falls with shear stress, and what limits that.
#[derive(Clone, Debug, Args)]
pub struct ShearOptions {
    /// Law of shear thinning in place of the named lubricant's
    #[arg(long, value_enum, value_name = "LAW")]
    shear: Option<ShearName>,
    /// Eyring's or Carreau's critical stress in Pa
    #[arg(long, value_name = "PA", allow_hyphen_values = true)]
    shear_stress: Option<f64>,
    /// Carreau's exponent β_c (default: 2)
    #[arg(long, value_name = "BETA", allow_hyphen_values = true)]
    shear_beta: Option<f64>,
    /// Carreau's power-law exponent n_c
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    shear_n: Option<f64>,
    /// Limiting stress τ_L0 + Λ p that the film carries at most: Pa and a slope
    #[arg(long, value_name = "TAU0,SLOPE", allow_hyphen_values = true, value_parser = pair)]
    limiting_stress: Option<(f64, f64)>,
}

fn pair(text: &str) -> Result<(f64, f64), String> {
    let numbers = text.split_once(',').and_then(|(a, b)| Some((a.trim().parse().ok()?, b.trim().parse().ok()?)));
    numbers.ok_or_else(|| "accepted are two numbers with a comma between them, as in 5e6,0.05".to_owned())
}

impl ShearOptions {
    /// The lubricant with what they say.
    ///
    /// # Errors
    /// When a constant is missing or has no effect.
    pub fn applied(&self, lubricant: Lubricant) -> Result<Lubricant, Failure> {
        let refuse = |sentence: &str| Err(Failure::Request(sentence.to_owned()));
        let stress = |law: &str| {
            self.shear_stress.ok_or_else(|| {
                Failure::Request(format!("--shear {law} needs --shear-stress in Pa; 5e6 is customary for mineral oils"))
            })
        };
        let carreau_only = self.shear_beta.is_some() || self.shear_n.is_some();
        if carreau_only && self.shear != Some(ShearName::Carreau) {
            return refuse("--shear-beta and --shear-n belong to --shear carreau; leave them out or add it");
        }
        let npr = 0.0;
        let shear = match self.shear {
            None | Some(ShearName::Newtonian) if self.shear_stress.is_some() => {
                return refuse("--shear-stress belongs to --shear eyring or carreau; leave it out or add one");
            }
            None => lubricant.shear,
            Some(ShearName::Newtonian) => ShearLaw::Newtonian,
            Some(ShearName::Eyring) => ShearLaw::Eyring { critical_stress: stress("eyring")?, npr },
            Some(ShearName::Carreau) => {
                let critical_stress = stress("carreau")?;
                let Some(n) = self.shear_n else {
                    return refuse("--shear carreau needs --shear-n, its power-law exponent between 0.05 and 1");
                };
                ShearLaw::Carreau { critical_stress, beta: self.shear_beta.unwrap_or(2.0), n, npr }
            }
        };
        // A law of the film's own takes the place of a stress that only bent the traction.
        let own_limit = lubricant.limiting_stress.filter(|_| self.shear.is_none() || shear == ShearLaw::Newtonian);
        let limiting_stress = match self.limiting_stress {
            Some((ambient, slope)) => Some(LimitingStress { ambient, slope, eyring: None }),
            None => own_limit,
        };
        Ok(Lubricant { shear, limiting_stress, ..lubricant })
    }
}
