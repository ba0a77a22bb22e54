//! Web page, or one of its workers: no threads, files in memory, dialogs of the browser, and other instances for
//! long work.

#![allow(unsafe_code, reason = "functions of the page are declared here")]

pub mod browser;
pub mod dialogs;
pub mod files;
pub mod models;
pub mod page;
pub mod remote;
pub mod worker;
