//! Requests of two methods, and the exact voxels that both are compared with.

use octolume::digest::Digest;
use octolume::plan::{Asked, Held, Part, Pass, State, WantedFor, plan};
use octolume::settings::{Filter, Settings, View};

use super::{BUILD, RIGID, after, other, running, with};

/// The two methods of a request that measures both filters.
fn measured(exact: Option<Digest>) -> [Asked; 2] {
    let mut shown = Asked::new(RIGID, Settings::default());
    shown.settings.method.look.accuracy = true;
    shown.contents.exact = exact;
    let mut other = Asked { wanted_for: WantedFor::Comparison, ..shown.clone() };
    other.settings.method.discretization.filter = Filter::Nearest;
    [shown, other]
}

#[test]
fn accuracy_builds_the_other_filter_and_compares_once_the_exact_set_is_known() {
    let mut held = Held::default();
    held.hold_all(&plan(&[Asked::new(RIGID, Settings::default())], &held));
    let built = plan(&measured(None), &held);
    let nearest = BUILD.map(|pass| if pass == Pass::GatherSplit { Pass::GatherNearest } else { pass });
    assert_eq!(running(&built), with(&nearest), "of the other method alone; nothing is moved or drawn");
    assert!(built.rows.iter().all(|row| row.state != State::Run || row.method == 1));
    held.hold_all(&built);
    assert_eq!(running(&plan(&measured(Some(other())), &held)), [Pass::UploadExact, Pass::CompareExact]);
}

#[test]
fn what_two_methods_share_is_made_once() {
    let plan = plan(&measured(None), &Held::default());
    let count = |part: Part| plan.to_run().iter().filter(|planned| planned.part == part).count();
    assert_eq!([Part::Caches, Part::Pages, Part::RigidVoxels].map(count), [1; 3]);
    assert_eq!([Part::Masks, Part::Topology, Part::Payload].map(count), [2; 3]);
    assert_eq!(count(Part::Picture), 1);
}

#[test]
fn the_ghost_waits_for_the_exact_set() {
    let mut settings = Settings::default();
    let mut before = Asked::new(RIGID, settings.clone());
    settings.method.look.view = View::Ghost;
    let mut ghost = Asked::new(RIGID, settings);
    assert!(after(&before, &ghost).is_idle());
    ghost.contents.exact = Some(other());
    assert_eq!(running(&after(&before, &ghost)), [Pass::UploadExact, Pass::ReduceExact, Pass::MarchGhost]);
    before = ghost.clone();
    ghost.contents.rigid = other();
    ghost.contents.exact = None;
    let moved = after(&before, &ghost);
    assert!(moved.runs(Pass::MarkLeaves) && !moved.runs(Pass::MarchGhost), "the ghost of another pose is no ghost");
}
