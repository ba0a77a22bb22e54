//! The options of heat, shared by `solve` and `sweep`.

use super::failure::Failure;
use crate::solver::physics::bodies::{BodyHeat, MATERIALS, Material};
use crate::solver::physics::lubricant::{Heat, OilHeat};
use clap::Args;

/// Heat in the film. SI units throughout.
#[derive(Clone, Debug, Args)]
pub struct HeatOptions {
    /// Compute temperatures of film and bodies, and what they do to film and traction (with --method reduced, of lines
    /// and circles, by the program's models with heat, or by another one, --rom FILE)
    #[arg(long)]
    heat: bool,
    /// Temperature of oil and bodies in front of the contact in K; viscosity and α are those at it (default: 313.15)
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    inlet_temperature: Option<f64>,
    /// Heat capacity in J/(kg K), thermal conductivity in W/(m K) and density in kg/m³ of the oil (default: the named
    /// lubricant's, or 2000,0.14,870)
    #[arg(long, value_name = "CP,K,RHO0", allow_hyphen_values = true, value_parser = three)]
    oil_thermal: Option<[f64; 3]>,
    /// How viscosity falls with temperature, β = -d ln η/dT in 1/K (default: 0.045); not with Doolittle's law
    #[arg(long, value_name = "BETA", allow_hyphen_values = true)]
    viscosity_temperature: Option<f64>,
    /// How density falls with temperature, in 1/K (default: 6.5e-4); not with Tait's law
    #[arg(long, value_name = "BETA_RHO", allow_hyphen_values = true)]
    density_temperature: Option<f64>,
    /// Thermal conductivity in W/(m K), heat capacity in J/(kg K) and density in kg/m³ of body 1, which moves with
    /// u_m (1 - SRR/2), or a material: steel, silicon-nitride, bronze, cast-iron, glass, tungsten-carbide
    /// (default: steel, 47,460,7850)
    #[arg(long, value_name = "K,C,RHO|MATERIAL", allow_hyphen_values = true, value_parser = body)]
    body1: Option<BodyHeat>,
    /// The same of body 2, which moves with u_m (1 + SRR/2)
    #[arg(long, value_name = "K,C,RHO|MATERIAL", allow_hyphen_values = true, value_parser = body)]
    body2: Option<BodyHeat>,
}

fn three(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    let accepted = "accepted are three numbers with commas between them, as in 2000,0.14,870";
    numbers.ok().and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| accepted.to_owned())
}

fn body(text: &str) -> Result<BodyHeat, String> {
    if let Some(material) = Material::named(text) {
        return Ok(material.heat);
    }
    let names = || MATERIALS.map(|material| material.word()).join(", ");
    let [conductivity, heat_capacity, density] =
        three(text).map_err(|_| format!("accepted are three numbers, as in 47,460,7850, or one of {}", names()))?;
    Ok(BodyHeat { conductivity, heat_capacity, density })
}

impl HeatOptions {
    /// What they describe of a lubricant with its own thermal constants; none without `--heat`.
    ///
    /// # Errors
    /// When something is said about heat without it.
    pub fn heat(&self, own: Option<OilHeat>) -> Result<Option<Heat>, Failure> {
        let Self { inlet_temperature, oil_thermal, viscosity_temperature, density_temperature, body1, body2, .. } =
            self;
        if !self.heat {
            let given = [
                ("--inlet-temperature", inlet_temperature.is_some()),
                ("--oil-thermal", oil_thermal.is_some()),
                ("--viscosity-temperature", viscosity_temperature.is_some()),
                ("--density-temperature", density_temperature.is_some()),
                ("--body1", body1.is_some()),
                ("--body2", body2.is_some()),
            ];
            return match given.into_iter().find(|(_, given)| *given) {
                Some((name, _)) => Err(Failure::Request(format!("{name} has no effect without --heat; add it"))),
                None => Ok(None),
            };
        }
        let mut oil = own.unwrap_or_default();
        if let Some([heat_capacity, conductivity, density]) = *oil_thermal {
            oil = OilHeat { heat_capacity, conductivity, density, ..oil };
        }
        oil.viscosity_temperature = viscosity_temperature.unwrap_or(oil.viscosity_temperature);
        oil.density_temperature = density_temperature.unwrap_or(oil.density_temperature);
        let default = Heat::default();
        let [first, second] = default.bodies;
        Ok(Some(Heat {
            inlet_temperature: inlet_temperature.unwrap_or(default.inlet_temperature),
            oil,
            bodies: [body1.unwrap_or(first), body2.unwrap_or(second)],
        }))
    }
}
