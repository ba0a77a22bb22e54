//! Studies divided into pieces, for campaigns: which studies can be divided, and the parts of their rows that depend on
//! time and order.

use super::question::{Divisible, RunError, Setting};
use super::sweep::Sweep;
use super::{Bench, Experiment, Method, Study, StudyObserver, StudyRow, load_cases, random_test};
use crate::scene::contact_result::ContactResult;
use crate::scene::load_cases::CaseTable;

impl StudyRow {
    /// Returns the measured times in the row, the only difference between two runs. Empty for studies that cannot be
    /// divided.
    pub fn seconds(&mut self) -> Vec<&mut f64> {
        match self {
            Self::Sweep(row) => Sweep::seconds(row),
            Self::RandomTest(row) => random_test::RandomTest::seconds(row),
            Self::LoadCases(row) => load_cases::LoadCases::seconds(row),
            _ => Vec::new(),
        }
    }

    /// Returns the index among rows that may arrive in any order. Other rows arrive in order and have index 0.
    pub fn place(&self) -> usize {
        match self {
            Self::RandomTest(random_test::Row::Truth(index, _)) => *index,
            _ => 0,
        }
    }

    /// Returns true if the row belongs to a divisible study, its contacts are valid, and each result has film
    /// thicknesses if and only if it converged.
    pub fn is_sound(&self) -> bool {
        let sound = |result: &ContactResult| {
            let film = result.scalars.is_some_and(|scalars| scalars.h_c.is_finite() && scalars.h_min.is_finite());
            result.point.check().is_ok() && result.converged == film
        };
        match self {
            Self::Sweep(row) => row.results().iter().all(sound),
            Self::RandomTest(random_test::Row::Test(test)) => test.point.check().is_ok(),
            Self::RandomTest(random_test::Row::Truth(..)) => true,
            Self::LoadCases(row) => row.results.iter().flatten().all(sound),
            _ => false,
        }
    }
}

/// Error for studies that cannot be divided.
fn whole() -> RunError {
    let sentence = "a campaign is a sweep, a random test, a table of load cases or a training; run this scene with `run` \
                    on one machine";
    RunError::Study(sentence.to_owned())
}

impl Study {
    /// Returns the pieces of a round as numbers defined by the study, in the order of their rows; empty after the last
    /// round. `before` are the rows of the previous rounds, in order.
    ///
    /// # Errors
    /// If the study cannot be divided, or if something is refused.
    pub fn pieces(
        &self,
        experiment: &Experiment,
        bench: &mut dyn Bench,
        round: usize,
        before: &[StudyRow],
    ) -> Result<Vec<usize>, RunError> {
        let mut setting = Setting { experiment, bench, observer: &(), wants_states: false };
        match self {
            Self::Sweep(study) => study.pieces(&mut setting, round, &only!(before, StudyRow::Sweep)),
            Self::RandomTest(study) => study.pieces(&mut setting, round, &only!(before, StudyRow::RandomTest)),
            Self::LoadCases(study) => study.pieces(&mut setting, round, &only!(before, StudyRow::LoadCases)),
            _ => Err(whole()),
        }
    }

    /// Computes some pieces of a round. The observer receives their rows. The rows do not depend on other pieces or on
    /// threads, bit for bit, but rows that are solved in parallel may arrive in any order.
    ///
    /// # Errors
    /// As [`Study::run`].
    pub fn work(
        &self,
        experiment: &Experiment,
        bench: &mut dyn Bench,
        (round, pieces): (usize, &[usize]),
        observer: &dyn StudyObserver,
    ) -> Result<(), RunError> {
        let mut setting = Setting { experiment, bench, observer, wants_states: false };
        let tell = |row: StudyRow| observer.row(row);
        match self {
            Self::Sweep(study) => study.work(&mut setting, round, pieces, &|row| tell(StudyRow::Sweep(row))),
            Self::RandomTest(study) => study.work(&mut setting, round, pieces, &|row| tell(StudyRow::RandomTest(row))),
            Self::LoadCases(study) => study.work(&mut setting, round, pieces, &|row| tell(StudyRow::LoadCases(row))),
            _ => Err(whole()),
        }
    }

    /// Returns the methods of a divisible study, so that their models can be replaced; empty for other studies.
    pub fn methods_mut(&mut self) -> &mut [Method] {
        match self {
            Self::Sweep(study) => study.methods_mut(),
            Self::RandomTest(study) => study.methods_mut(),
            Self::LoadCases(study) => study.methods_mut(),
            _ => &mut [],
        }
    }

    /// Returns the table of load cases, if the study has one.
    pub fn table_mut(&mut self) -> Option<&mut CaseTable> {
        match self {
            Self::LoadCases(study) => Some(&mut study.cases),
            _ => None,
        }
    }
}
