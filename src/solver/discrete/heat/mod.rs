//! Temperature across and along the film: nodes of the Reynolds equation with temperatures, and the march of the
//! energy equation that computes them.

mod across;
mod film;
mod lines;
mod march;
mod station;
mod surfaces;

pub use across::{ACROSS, POINTS, Profile, RULE, apply, interpolated_across};
pub use film::{StressLaw, WarmFilm, WarmLaws};
pub use lines::{Line, Lines, Spread};
pub use march::{Course, HeatBalance, March};
pub use station::{Limit, Station};
pub use surfaces::MovingSource;
