//! An online Newton iteration must not allocate: more iterations, the same number of allocations.

use ehl_explorer::harness::model_file::embedded;
use ehl_explorer::solver::contact::{ContactKind, MoesRequest, si_from_moes};
use ehl_explorer::solver::lubricant::Lubricant;
use ehl_explorer::solver::reduced::{Online, ReducedOptions};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is handed on to the system allocator unchanged; only a counter is added.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's contract is the system allocator's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn more_online_iterations_do_not_allocate_more() {
    let model = embedded().unwrap();
    let point = si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap();
    let count = |max_newton: usize| {
        // A tolerance of zero is never met: every attempt runs to its limit.
        let options = ReducedOptions { tolerance: 0.0, max_newton, ..ReducedOptions::default() };
        let mut online = Online::new(Arc::clone(&model), options);
        assert!(online.solve(&point, Lubricant::default()).is_err());
        let before = ALLOCATIONS.load(Ordering::Relaxed);
        assert!(online.solve(&point, Lubricant::default()).is_err());
        ALLOCATIONS.load(Ordering::Relaxed) - before
    };
    let (few, many) = (count(3), count(11));
    assert_eq!(few, many, "allocations of the same attempts with 3 and with 11 iterations each");
}
