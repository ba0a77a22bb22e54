//! Studies in pieces, for campaigns: which studies fall into pieces, and what of their rows a clock and a place say.

use super::question::{Divisible, RunError, Setting};
use super::sweep::Sweep;
use super::{Bench, Experiment, Method, Study, StudyObserver, StudyRow, load_cases, random_test};
use crate::scene::contact_result::ContactResult;
use crate::scene::load_cases::CaseTable;

impl StudyRow {
    /// The seconds in it: all that two runs of it differ by. None of studies that do not fall into pieces.
    pub fn seconds(&mut self) -> Vec<&mut f64> {
        match self {
            Self::Sweep(row) => Sweep::seconds(row),
            Self::RandomTest(row) => random_test::RandomTest::seconds(row),
            Self::LoadCases(row) => load_cases::LoadCases::seconds(row),
            _ => Vec::new(),
        }
    }

    /// Its place among rows that arrive in any order; rows of all other kinds arrive in theirs.
    pub fn place(&self) -> usize {
        match self {
            Self::RandomTest(random_test::Row::Truth(index, _)) => *index,
            _ => 0,
        }
    }

    /// Whether it is of a study that falls into pieces, its contacts make sense, and a result has a film if and only if it
    /// converged.
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

/// Studies that do not fall into pieces.
fn whole() -> RunError {
    let sentence = "a campaign is a sweep, a random test, a table of load cases or a training; this scene asks something \
                    else, which `run` answers on one machine";
    RunError::Study(sentence.to_owned())
}

impl Study {
    /// The pieces of a round, each by a number of the study's own, in the order of their rows; none behind the last
    /// round. `before` are the rows of the rounds before it, in their order.
    ///
    /// # Errors
    /// When the study does not fall into pieces, or something is refused.
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

    /// Works out some pieces of a round; the observer is told their rows. Neither other pieces nor threads change a bit
    /// of them, but rows that are solved at the same time may come in any order.
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

    /// The methods of a study that falls into pieces, to be given other models; none of any other study.
    pub fn methods_mut(&mut self) -> &mut [Method] {
        match self {
            Self::Sweep(study) => study.methods_mut(),
            Self::RandomTest(study) => study.methods_mut(),
            Self::LoadCases(study) => study.methods_mut(),
            _ => &mut [],
        }
    }

    /// The table of load cases, where it is about one.
    pub fn table_mut(&mut self) -> Option<&mut CaseTable> {
        match self {
            Self::LoadCases(study) => Some(&mut study.cases),
            _ => None,
        }
    }
}
