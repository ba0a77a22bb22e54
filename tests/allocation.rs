//! An online Newton iteration must not allocate: more iterations, the same number of allocations.

use ehl_explorer::harness::model_file::{embedded, embedded_shear_of};
use ehl_explorer::scene::named_lubricant::SQUALANE_PIP;
use ehl_explorer::solver::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use ehl_explorer::solver::lubricant::Lubricant;
use ehl_explorer::solver::reduced::{Online, ReducedModel, ReducedOptions};
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

/// Allocations of a solve whose attempts all run to their limit: a tolerance of zero is never met.
fn allocations(model: &Arc<ReducedModel>, point: &OperatingPoint, lubricant: Lubricant, max_newton: usize) -> usize {
    let options = ReducedOptions { tolerance: 0.0, max_newton, ..ReducedOptions::default() };
    let mut online = Online::new(Arc::clone(model), options);
    assert!(online.solve(point, lubricant).is_err());
    let before = ALLOCATIONS.load(Ordering::Relaxed);
    assert!(online.solve(point, lubricant).is_err());
    ALLOCATIONS.load(Ordering::Relaxed) - before
}

// One test: another one at the same time would be counted with it.
#[test]
fn more_online_iterations_do_not_allocate_more() {
    let newtonian = si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap();
    let request = MoesRequest {
        radius_m: Some(12.7e-3),
        modulus_pa: Some(123.878213951e9),
        viscosity_pa_s: Some(0.0705),
        alpha_per_pa: Some(1.8925e-8),
        ..MoesRequest::new(ContactKind::Line, 20.0, 9.0)
    };
    let sliding = Sliding { slide_to_roll_ratio: 0.5, newtonian_plateau_ratio: Some(0.3) };
    let thinning = OperatingPoint { sliding, ..si_from_moes(&request).unwrap() };
    for (model, point, lubricant) in [
        (embedded().unwrap(), newtonian, Lubricant::default()),
        (embedded_shear_of(ContactKind::Line).unwrap(), thinning, SQUALANE_PIP),
    ] {
        let [few, many] = [3, 11].map(|max_newton| allocations(&model, &point, lubricant, max_newton));
        assert_eq!(few, many, "allocations of the same attempts with 3 and with 11 iterations each");
    }
}
