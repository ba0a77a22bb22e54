//! Forms that turn a rolling bearing, a gear pair, or a cam with its follower into bodies, speeds and load.

mod along;
mod bearing;
mod cam;
mod derived;
mod field;
mod gear;
mod kind;
mod sketch;
mod window;

pub use kind::MachineKind;
pub use window::MachineWindow;
