//! Transient contacts: their runs, and the views of them (time series, profiles, space and time, linearised model).

mod advice;
pub mod amplitude;
pub mod badge;
mod cost;
mod dials;
pub mod export;
mod feature_dials;
mod features;
mod follow;
mod form;
pub mod linearised;
pub mod method;
pub mod methods;
mod plane_map;
mod player;
mod profiles;
pub mod projection;
pub mod reach;
mod recorded;
mod run;
mod runs;
pub mod series;
mod setup;
pub mod shared;
pub mod space_time;
mod tab;
mod tpwl;

pub use linearised::{NumberTask, OtherRuleTask};
pub use recorded::Recorded;
pub use run::Run;
pub use runs::{TransientCommand, TransientRuns};
pub use setup::{Setup, model_in_use};
pub use tab::Transient;
pub use tpwl::Tpwl;
