//! What does not fit an adapter is refused before it is voxelized, with what would fit.

use std::sync::Arc;

use octolume::prepare::{PrepareError, Prepared, Room, Stores, prepare_with};
use octolume::progress::Progress;
use octolume::scene::builtin;
use octolume::scene::{Scene, load};
use octolume::settings::Discretization;

fn scene(name: &str) -> Arc<Scene> {
    let bytes = builtin::bytes(name).expect("is built in");
    Arc::new(load::open_bytes(name, bytes, None, &Progress::default()).expect("opens"))
}

fn prepared(scene: &Arc<Scene>, discretization: &Discretization, bytes: u64) -> Result<Prepared, PrepareError> {
    let room = Room { adapter: "a small GPU".to_owned(), buffer_bytes: bytes };
    let stores = Stores { room: Some(&room), ..Stores::default() };
    prepare_with(Arc::clone(scene), discretization, stores, &Progress::default())
}

#[test]
fn what_is_too_large_is_refused_with_what_would_fit() {
    let scene = scene("courtyard");
    let wanted = Discretization { grid: 256, ..Discretization::default() };
    let voxels = prepared(&scene, &wanted, u64::MAX).unwrap_or_else(|error| panic!("{error}")).voxel_count();
    // Nothing is refused that has room: the forecast is a lower bound, and not a bad one.
    let (all, half) = (16 * voxels, 8 * voxels);
    assert!(prepared(&scene, &wanted, all).is_ok());
    let error = prepared(&scene, &wanted, half).map(|_| ()).expect_err("half of them fit").to_string();
    assert!(error.starts_with("courtyard: at a span of ") && error.contains("\"a small GPU\" allows"), "{error}");
    assert!(error.contains("a grid of 128, or a span of "), "{error}");
    assert!(prepared(&scene, &Discretization { grid: 128, ..wanted }, half).is_ok(), "{error}");
    let span: f64 =
        error.rsplit_once("span of ").and_then(|(_, end)| end.split(' ').next()?.parse().ok()).expect("a span");
    assert!(prepared(&scene, &Discretization { span: Some(span), ..wanted }, half).is_ok(), "{error}");
    // With a span that is set, another grid has as many voxels.
    let error = prepared(&scene, &Discretization { span: Some(span / 8.0), ..wanted }, half).map(|_| ());
    let error = error.expect_err("is much too fine").to_string();
    assert!(!error.contains("a grid of"), "{error}");
}
