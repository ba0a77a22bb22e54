//! The options of an operating point and how it is solved, shared by `solve` and `sweep`.

use super::failure::Failure;
use super::heat::HeatOptions;
use super::shear::ShearOptions;
use crate::engine::Request;
use crate::scene::named_lubricant::{NAMED, NamedLubricant, by_name};
use crate::scene::{At, Grid, Method, ModelSource};
use crate::solver::discrete::grid::{GridError, GridSpec, PointGridSpec};
use crate::solver::limits::Number;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, reduced_modulus};
use crate::solver::physics::lubricant::{Cavitation, DensityLaw, Lubricant, ShearLaw, Sliding, ViscosityLaw};
use clap::{Args, Parser, ValueEnum};
use std::path::PathBuf;

/// Line or point contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ContactName {
    /// Line contact, loads in N/m.
    Line,
    /// Point contact, loads in N: a circle, or with --radius-y an ellipse.
    Point,
}

/// Full or reduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// The full system.
    Full,
    /// A reduced model.
    Reduced,
}

/// Kinds of grids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum GridName {
    /// Equidistant nodes.
    Uniform,
    /// The explorer's default.
    Graded,
    /// The reduced model's own.
    Model,
}

/// How a film ruptures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CavitationName {
    /// The penalty term of (2.36).
    Penalty,
    /// No pressure below zero, by a multiplier (appendix D).
    Complementarity,
    /// No liquid lost behind the contact: the gap is filled in part (Elrod and Adams).
    MassConserving,
}

impl From<CavitationName> for Cavitation {
    fn from(name: CavitationName) -> Self {
        match name {
            CavitationName::Penalty => Self::Penalty,
            CavitationName::Complementarity => Self::Complementarity,
            CavitationName::MassConserving => Self::MassConserving { supply_film_m: None },
        }
    }
}

/// An operating point and how it is solved. SI units throughout.
#[derive(Clone, Debug, Args)]
pub struct PointOptions {
    /// Shape of the contact
    #[arg(long, value_enum, default_value = "line")]
    pub contact: ContactName,
    /// How it is solved
    #[arg(long, value_enum, default_value = "full")]
    pub method: MethodName,
    /// Reduced model to use (default: the embedded one)
    #[arg(long, value_name = "FILE")]
    pub rom: Option<PathBuf>,
    /// Reduced radius R in m
    #[arg(long, allow_negative_numbers = true)]
    pub radius: Option<f64>,
    /// Reduced radius R_y across the rolling direction in m, of a point contact (default: --radius)
    #[arg(long, allow_negative_numbers = true)]
    pub radius_y: Option<f64>,
    /// Mean entrainment speed u_m in m/s
    #[arg(long, allow_negative_numbers = true)]
    pub speed: Option<f64>,
    /// Load w in N/m (line) or N (point)
    #[arg(long, allow_negative_numbers = true)]
    pub load: Option<f64>,
    /// Reduced modulus E′ in Pa, or --e1 --nu1 --e2 --nu2
    #[arg(long, allow_negative_numbers = true)]
    pub modulus: Option<f64>,
    /// Young's modulus of body 1 in Pa
    #[arg(long, allow_negative_numbers = true)]
    pub e1: Option<f64>,
    /// Poisson ratio of body 1
    #[arg(long, allow_negative_numbers = true)]
    pub nu1: Option<f64>,
    /// Young's modulus of body 2 in Pa
    #[arg(long, allow_negative_numbers = true)]
    pub e2: Option<f64>,
    /// Poisson ratio of body 2
    #[arg(long, allow_negative_numbers = true)]
    pub nu2: Option<f64>,
    /// Viscosity at ambient pressure η₀ in Pa·s (default: the named lubricant's, where it has one)
    #[arg(long, allow_negative_numbers = true)]
    pub viscosity: Option<f64>,
    /// Pressure–viscosity coefficient α in 1/Pa; not with a lubricant that determines it
    #[arg(long, allow_negative_numbers = true)]
    pub alpha: Option<f64>,
    /// Moes' load number M; what is not given of the SI quantities follows or takes its default
    #[arg(long, allow_negative_numbers = true)]
    pub moes_m: Option<f64>,
    /// Moes' lubricant number L
    #[arg(long, allow_negative_numbers = true)]
    pub moes_l: Option<f64>,
    /// Named lubricant: a set of laws, which --density and --pressure-viscosity override
    #[arg(long, value_name = "NAME", value_parser = by_name, long_help = lubricant_help())]
    pub lubricant: Option<NamedLubricant>,
    /// Density law: dowson-higginson or incompressible (default: dowson-higginson)
    #[arg(long, value_name = "LAW", value_parser = density)]
    pub density: Option<DensityLaw>,
    /// Viscosity law: roelands or barus (default: roelands)
    #[arg(long, value_name = "LAW", value_parser = pressure_viscosity)]
    pub pressure_viscosity: Option<ViscosityLaw>,
    /// Slide-to-roll ratio; of a Newtonian fluid it moves only the traction
    #[arg(long, allow_negative_numbers = true, default_value = "0")]
    pub srr: Option<f64>,
    /// Newtonian plateau ratio of a shear-thinning lubricant (default: its own); 1 is a Newtonian fluid
    #[arg(long, allow_negative_numbers = true)]
    pub npr: Option<f64>,
    /// Grid of a full solution (default: the dissertation's uniform one, or one that does for the contact where that
    /// does not)
    #[arg(long, value_enum)]
    pub grid: Option<GridName>,
    /// Spacing ΔX of a uniform grid (default: 0.005 line, 0.02 point)
    #[arg(long, allow_negative_numbers = true)]
    pub dx: Option<f64>,
    /// Spacing ΔY of a point contact's grid (default: 0.05); a graded grid is four times finer in the side lobes
    #[arg(long, allow_negative_numbers = true)]
    pub dy: Option<f64>,
    /// Inlet and outlet (default: -4,2 on a uniform grid), and outer edge of a point contact's half domain
    /// (default: -2); of a graded grid in its reference coordinate
    #[arg(long, value_name = "X0,X1[,Y0]", allow_hyphen_values = true, value_parser = domain)]
    pub domain: Option<Domain>,
    /// How the film of a full solution ruptures
    #[arg(long, value_enum, value_name = "MODEL", default_value = "penalty")]
    pub cavitation: CavitationName,
    /// Thickness of the film that the surfaces bring to the inlet in metres, with `--cavitation mass-conserving`
    /// (default: a flooded inlet)
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub supply_film: Option<f64>,
    /// Shear thinning and a limiting stress.
    #[command(flatten)]
    pub shear: ShearOptions,
    /// Heat.
    #[command(flatten)]
    pub heat: HeatOptions,
}

/// Ends of the computational domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    x: (f64, f64),
    y: Option<f64>,
}

fn lubricant_help() -> String {
    let list = NAMED.map(|lubricant| format!("  {}: {}", lubricant.name, lubricant.about)).join("\n");
    format!("Named lubricant: a set of laws, which --density and --pressure-viscosity override:\n{list}")
}

fn density(word: &str) -> Result<DensityLaw, String> {
    match word {
        "dowson-higginson" => Ok(DensityLaw::DowsonHigginson),
        "incompressible" => Ok(DensityLaw::Incompressible),
        "tait" => {
            Err("Tait's law needs constants, which come with --lubricant squalane-pip, --lubricant pao-650 or a scene; accepted are dowson-higginson, incompressible".to_owned())
        }
        _ => Err("accepted are dowson-higginson, incompressible".to_owned()),
    }
}

fn pressure_viscosity(word: &str) -> Result<ViscosityLaw, String> {
    match word {
        "roelands" => Ok(ViscosityLaw::Roelands),
        "barus" => Ok(ViscosityLaw::Barus),
        "doolittle" => Err(
            "Doolittle's law needs constants, which come with --lubricant squalane-pip, --lubricant pao-650 or a scene; accepted are roelands, barus"
                .to_owned(),
        ),
        _ => Err("accepted are roelands, barus".to_owned()),
    }
}

fn domain(text: &str) -> Result<Domain, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok(&[from, to]) => Ok(Domain { x: (from, to), y: None }),
        Ok(&[from, to, side]) => Ok(Domain { x: (from, to), y: Some(side) }),
        _ => Err(
            "accepted are the inlet and the outlet with a comma between them, as in --domain=-4,2, and after another \
                  comma the outer edge of a point contact, as in --domain=-4,2,-2"
                .to_owned(),
        ),
    }
}

/// Where an option keeps its number.
type Place = fn(&mut PointOptions) -> &mut Option<f64>;

fn refuse<T>(sentence: impl Into<String>) -> Result<T, Failure> {
    Err(Failure::Request(sentence.into()))
}

/// Options without a command before them.
#[derive(Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Words {
    #[command(flatten)]
    point: PointOptions,
}

impl PointOptions {
    /// The contact that words describe as on the command line, as in `--moes-m=40`.
    ///
    /// # Errors
    /// With the sentence of the command line.
    pub fn from_words(words: impl IntoIterator<Item = String>) -> Result<Self, Failure> {
        Words::try_parse_from(words).map(|words| words.point).map_err(|error| super::usage(&error))
    }

    /// The numeric options that a sweep can vary, by their names without the leading dashes.
    const VARIABLES: [(&str, Place); 17] = [
        ("moes-m", |options| &mut options.moes_m),
        ("moes-l", |options| &mut options.moes_l),
        ("radius", |options| &mut options.radius),
        ("radius-y", |options| &mut options.radius_y),
        ("speed", |options| &mut options.speed),
        ("load", |options| &mut options.load),
        ("modulus", |options| &mut options.modulus),
        ("viscosity", |options| &mut options.viscosity),
        ("alpha", |options| &mut options.alpha),
        ("e1", |options| &mut options.e1),
        ("nu1", |options| &mut options.nu1),
        ("e2", |options| &mut options.e2),
        ("nu2", |options| &mut options.nu2),
        ("srr", |options| &mut options.srr),
        ("npr", |options| &mut options.npr),
        ("dx", |options| &mut options.dx),
        ("dy", |options| &mut options.dy),
    ];

    /// Sets a numeric option by name; `m` and `l` are short for `moes-m` and `moes-l`.
    ///
    /// # Errors
    /// With the accepted names.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Failure> {
        let known = match name {
            "m" | "M" => "moes-m",
            "l" | "L" => "moes-l",
            name => name,
        };
        let Some((_, place)) = Self::VARIABLES.iter().find(|(variable, _)| *variable == known) else {
            let accepted = Self::VARIABLES.map(|(variable, _)| variable).join(", ");
            return refuse(format!("`{name}` cannot be varied; accepted are {accepted}"));
        };
        *place(self) = Some(value);
        Ok(())
    }

    /// The request that the options describe.
    ///
    /// # Errors
    /// When they contradict each other or a value is outside any sense.
    pub fn request(&self) -> Result<Request, Failure> {
        let srr = self.srr.unwrap_or(0.0);
        if !(srr.is_finite() && srr.abs() <= 10.0) {
            return refuse(format!("--srr is {}, but must be a finite number between -10 and 10", Number(srr)));
        }
        let named = self.lubricant.map_or_else(Lubricant::default, |named| named.laws);
        let mut lubricant = self.shear.applied(named)?;
        lubricant.heat = self.heat.heat(self.lubricant.map(|named| named.heat))?;
        if let Some(npr) = self.npr {
            if !(0.0..=1.0).contains(&npr) {
                return refuse(format!("--npr is {}, but must lie between 0 and 1", Number(npr)));
            }
            if npr < 1.0 && lubricant.shear == ShearLaw::Newtonian {
                return refuse(format!(
                    "--npr is {}, but the lubricant has no shear constants; only 1 (Newtonian) is accepted",
                    Number(npr)
                ));
            }
        }
        lubricant.density = self.density.unwrap_or(lubricant.density);
        lubricant.viscosity = self.pressure_viscosity.unwrap_or(lubricant.viscosity);
        lubricant.cavitation = match self.cavitation.into() {
            Cavitation::MassConserving { .. } => Cavitation::MassConserving { supply_film_m: self.supply_film },
            other => other,
        };
        if self.supply_film.is_some() && self.cavitation != CavitationName::MassConserving {
            return refuse(
                "--supply-film needs --cavitation mass-conserving: no other rupture knows a gap that is filled in part"
                    .to_owned(),
            );
        }
        let method = self.method()?;
        let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: self.npr };
        let point = OperatingPoint { sliding, ..self.point(&lubricant)? };
        let grid = self.grid(&method, &point)?;
        let grid_model = self.model_source();
        Ok(Request { point, lubricant, grid, grid_model, method })
    }

    fn model_source(&self) -> ModelSource {
        self.rom.clone().map_or(ModelSource::Embedded, ModelSource::File)
    }

    fn method(&self) -> Result<Method, Failure> {
        match self.method {
            MethodName::Full if self.rom.is_some() && self.grid != Some(GridName::Model) => refuse(
                "--rom has no effect here; add --method reduced, or --grid model for a full solution on the model's grid",
            ),
            MethodName::Full => Ok(Method::Full),
            MethodName::Reduced => Ok(Method::reduced(self.model_source())),
        }
    }

    fn modulus(&self) -> Result<Option<f64>, Failure> {
        match (self.modulus, self.e1, self.nu1, self.e2, self.nu2) {
            (modulus, None, None, None, None) => Ok(modulus),
            (None, Some(e1), Some(nu1), Some(e2), Some(nu2)) => {
                reduced_modulus(e1, nu1, e2, nu2).map(Some).map_err(|error| Failure::Request(error.to_string()))
            }
            (Some(_), ..) => refuse("--modulus and --e1 --nu1 --e2 --nu2 say the same thing; give one of both"),
            _ => refuse("two bodies need all of --e1, --nu1, --e2 and --nu2"),
        }
    }

    fn point(&self, lubricant: &Lubricant) -> Result<OperatingPoint, Failure> {
        let modulus = self.modulus()?;
        let (radius, radius_y, speed, load) = (self.radius, self.radius_y, self.speed, self.load);
        let own_viscosity = self.lubricant.and_then(|named| named.viscosity_pa_s);
        let viscosity = self.viscosity.or(own_viscosity);
        let own_alpha = lubricant.own_coefficient();
        if let (Some(_), Some(own)) = (self.alpha, own_alpha) {
            return refuse(format!(
                "--alpha follows from the lubricant's viscosity law ({own:.4e} 1/Pa); leave it out"
            ));
        }
        let alpha = own_alpha.or(self.alpha);
        let at = match (self.moes_m, self.moes_l) {
            (Some(m), Some(l)) => At::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha },
            (None, None) => {
                let required = [
                    ("--radius", radius),
                    ("--speed", speed),
                    ("--load", load),
                    ("--modulus", modulus),
                    ("--viscosity", viscosity),
                    ("--alpha", alpha),
                ];
                let missing: Vec<&str> = required.iter().filter(|(_, v)| v.is_none()).map(|&(name, _)| name).collect();
                if let (Some(radius), Some(speed), Some(load), Some(modulus), Some(viscosity), Some(alpha)) =
                    (radius, speed, load, modulus, viscosity, alpha)
                {
                    At::Si { radius, radius_y, speed, load, modulus, viscosity, alpha }
                } else {
                    let missing = missing.join(", ");
                    return refuse(format!(
                        "the operating point is incomplete: give {missing} too, or --moes-m and --moes-l instead"
                    ));
                }
            }
            _ => return refuse("--moes-m and --moes-l belong together; give both"),
        };
        at.point(self.kind()).map_err(|error| Failure::Request(error.to_string()))
    }

    fn kind(&self) -> ContactKind {
        match self.contact {
            ContactName::Line => ContactKind::Line,
            ContactName::Point => ContactKind::Point,
        }
    }

    /// The grid of a full solution of a point contact.
    fn plane(&self, point: &OperatingPoint) -> Result<Grid, Failure> {
        let default = match self.grid {
            None | Some(GridName::Uniform) => PointGridSpec::DISSERTATION,
            Some(GridName::Graded) => PointGridSpec::EXPLORER,
            Some(GridName::Model) if self.dx.is_some() || self.dy.is_some() || self.domain.is_some() => {
                return refuse("--grid model is the model's own: leave out --dx, --dy and --domain");
            }
            Some(GridName::Model) => return Ok(Grid::Model),
        };
        let refused = |error: GridError| Failure::Request(error.to_string());
        let own = self.dx.is_some() || self.dy.is_some() || self.domain.is_some();
        if !own {
            return match self.grid {
                Some(GridName::Graded) => default.for_contact(point).map(Grid::Plane),
                _ => Grid::Usual.for_contact(point),
            }
            .map_err(refused);
        }
        let (from, to, edge) = default.domain;
        let ends = self.domain.map_or((from, to), |domain| domain.x);
        let edge = self.domain.and_then(|domain| domain.y).unwrap_or(edge);
        let (dx, dy) = (self.dx.unwrap_or(default.dx), self.dy.unwrap_or(default.dy));
        let spec = PointGridSpec { dx, dy, domain: (ends.0, ends.1, edge), ..default };
        spec.check().map_err(refused)?;
        Ok(Grid::Plane(spec))
    }

    fn grid(&self, method: &Method, point: &OperatingPoint) -> Result<Grid, Failure> {
        let plane = self.kind() == ContactKind::Point;
        if !plane && (self.dy.is_some() || self.domain.is_some_and(|domain| domain.y.is_some())) {
            return refuse("a line contact has no Y: leave out --dy and the third number of --domain");
        }
        if *method != Method::Full {
            let own = "a reduced model brings its own grid";
            if self.dx.is_some() || self.dy.is_some() || self.domain.is_some() {
                return refuse(format!("{own}: leave out --dx, --dy and --domain with --method reduced"));
            }
            if self.grid.is_some_and(|grid| grid != GridName::Model) {
                return refuse(format!("{own}: with --method reduced only --grid model is accepted"));
            }
            return Ok(Grid::Model);
        }
        if plane {
            return self.plane(point);
        }
        let ends = self.domain.map(|domain| domain.x);
        let grid = match self.grid {
            None | Some(GridName::Uniform) if self.dx.is_none() && ends.is_none() => {
                let grid = Grid::Usual.for_contact(point);
                grid.map_err(|error| Failure::Request(error.to_string()))?
            }
            None | Some(GridName::Uniform) => {
                Grid::Uniform { dx: self.dx.unwrap_or(0.005), domain: ends.unwrap_or((-4.0, 2.0)) }
            }
            Some(GridName::Graded | GridName::Model) if self.dx.is_some() => {
                return refuse("--dx belongs to the uniform grid; leave it out or use --grid uniform");
            }
            Some(GridName::Model) if ends.is_some() => {
                return refuse("--domain belongs to uniform and graded grids; leave it out with --grid model");
            }
            Some(GridName::Model) => Grid::Model,
            Some(GridName::Graded) => match (ends, GridSpec::EXPLORER) {
                (Some(domain), GridSpec::Graded { nodes, registered, .. }) => {
                    Grid::GradedNodes { nodes, domain, registered }
                }
                _ => Grid::Graded,
            },
        };
        Ok(grid)
    }
}
