//! The camera where it could break: poles, empty viewports, empty and huge scenes.

use approx::assert_relative_eq;
use glam::{DMat4, DQuat, DVec3};
use octolume::scene::{Aabb, LocalTransform, Node, OrbitCamera, Projection, Scene, SceneCamera, Trs};
use proptest::prelude::*;

/// No test looks at what is farther from an orthographic camera.
const FARTHEST: f64 = 1e4;

fn looking(eye: DVec3, target: DVec3) -> OrbitCamera {
    OrbitCamera::new(eye, target, 45.0)
}

/// Finite here and as the f32 numbers a GPU gets, with a view that is a rigid motion.
fn assert_sound(camera: &OrbitCamera, aspect: f64) {
    let (view, projection) = (camera.camera_from_world(), camera.projection(aspect, FARTHEST));
    for matrix in [view, projection, projection * view] {
        assert!(matrix.as_mat4().is_finite(), "{camera:?} at {aspect}: {matrix}");
    }
    let world = camera.world_from_camera();
    for (a, b) in [(world.x_axis, world.y_axis), (world.y_axis, world.z_axis), (world.z_axis, world.x_axis)] {
        assert!(a.dot(b).abs() < 1e-9 && (a.length() - 1.0).abs() < 1e-9, "{camera:?}");
    }
}

/// Depth and position on the image (−1 to 1) of a world point.
fn seen(camera: &OrbitCamera, aspect: f64, point: DVec3) -> DVec3 {
    (camera.projection(aspect, FARTHEST) * camera.camera_from_world()).project_point3(point)
}

#[test]
fn looking_along_up_is_sound() {
    for direction in [DVec3::Y, DVec3::NEG_Y, DVec3::new(1e-9, 1.0, 0.0), DVec3::new(0.0, -1.0, 1e-12)] {
        assert_sound(&looking(direction * 5.0, DVec3::ZERO), 1.5);
    }
    assert_sound(&looking(DVec3::ONE, DVec3::ONE), 1.5);
}

/// Straight down is where orbiting up from the front leads: what was away is at the top.
#[test]
fn up_does_not_flip_at_the_pole() {
    let mut camera = looking(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO);
    camera.orbit(0.0, 10.0);
    assert!(seen(&camera, 1.0, DVec3::NEG_Z).y > 0.0);
    assert!(seen(&looking(DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO), 1.0, DVec3::NEG_Z).y > 0.0);
    camera.orbit(0.0, -20.0);
    assert!(seen(&camera, 1.0, DVec3::NEG_Z).y < 0.0);
    assert!(seen(&looking(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO), 1.0, DVec3::NEG_Z).y < 0.0);
}

#[test]
fn a_viewport_of_no_size_is_sound() {
    let mut camera = OrbitCamera::default();
    for (width, height) in [(0.0, 0.0), (5.0, 0.0), (0.0, 5.0), (1e30, 1.0)] {
        assert_sound(&camera, width / height);
        camera.frame(Some(Aabb { min: DVec3::ZERO, max: DVec3::ONE }), width / height);
        camera.pan(3.0 / height, 4.0 / height);
        camera.orbit(3.0 / width, 4.0 / width);
        camera.zoom(height / width);
        assert_sound(&camera, width / height);
    }
}

/// Reversed: 1 on the near plane, 0 at infinity; 0 just behind what is farthest from an orthographic camera.
#[test]
fn depth_is_reversed() {
    let depth = |projection: DMat4, distance: f64| projection.project_point3(DVec3::NEG_Z * distance).z;
    let camera = looking(DVec3::Z * 1000.0, DVec3::ZERO);
    let projection = camera.projection(1.0, FARTHEST);
    assert_relative_eq!(depth(projection, camera.near()), 1.0, epsilon = 1e-12);
    assert!(depth(projection, 1e12) > 0.0);
    let flat = orthographic(camera, 4.0);
    assert_eq!((flat.near(), depth(flat.projection(1.0, 8.0), 0.0)), (0.0, 1.0));
    for farthest in [1e-9, 1.0, 8.0, 1e12] {
        let last = depth(flat.projection(1.0, farthest), farthest);
        assert!(last > 0.0 && last < 2e-3, "{farthest}: {last}");
    }
}

#[test]
fn a_far_plane_before_the_near_one_is_sound() {
    let camera = looking(DVec3::Z * 3.0, DVec3::ZERO);
    for camera in [camera, orthographic(camera, 4.0)] {
        for farthest in [0.0, -1.0, 1e-300, f64::NAN, f64::INFINITY] {
            assert!(camera.projection(1.0, farthest).as_mat4().is_finite(), "{farthest}");
        }
    }
}

fn orthographic(camera: OrbitCamera, height: f64) -> OrbitCamera {
    OrbitCamera { orthographic_height: Some(height), ..camera }
}

/// Equal sizes at every distance, and neither a zoom nor a height that is none breaks it.
#[test]
fn orthographic_views_keep_sizes() {
    let camera = orthographic(looking(DVec3::Z * 9.0, DVec3::ZERO), 4.0);
    for depth in [-50.0, 0.0, 8.0] {
        assert_near!(
            seen(&camera, 2.0, DVec3::new(4.0, 2.0, depth)).truncate().extend(0.0),
            DVec3::new(1.0, 1.0, 0.0),
            1e-12
        );
    }
    let mut moved = camera;
    moved.zoom(0.5);
    assert_eq!((moved.eye, moved.orthographic_height), (camera.eye, Some(2.0)));
    moved.pan(0.5, 0.0);
    assert_near!(moved.target, DVec3::X, 1e-12);
    moved.frame(Some(Aabb { min: DVec3::splat(-1.0), max: DVec3::ONE }), 0.5);
    // The width of the cylinder around it, twice as high as wide, with the margin.
    let (height, least) = (moved.orthographic_height.expect("stays"), 1.05 * 4.0 * 2.0f64.sqrt());
    assert!((least..=1.006 * least).contains(&height), "{height}");
    for height in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        let mut camera = orthographic(camera, height);
        camera.zoom(1e-300);
        assert_sound(&camera, 1.0);
    }
}

/// What is at the target has the same size through either lens.
#[test]
fn a_lens_is_changed_without_changing_what_is_seen_at_the_target() {
    let camera = looking(DVec3::new(3.0, 4.0, 5.0), DVec3::ONE);
    let mut changed = camera;
    changed.set_orthographic(true);
    let beside = camera.target + camera.world_from_camera().x_axis.truncate() * 0.7;
    let flat = |at: DVec3| at.truncate().extend(0.0);
    assert_near!(flat(seen(&changed, 1.5, beside)), flat(seen(&camera, 1.5, beside)), 1e-12);
    changed.set_orthographic(false);
    assert_near!(changed.eye, camera.eye, 1e-12);
    assert_eq!((changed.orthographic_height, changed.fov_y_degrees), (None, camera.fov_y_degrees));
}

/// A camera turned to the left sees what was to its left nearer to the middle of its upper edge.
#[test]
fn a_roll_turns_the_picture() {
    let camera = OrbitCamera { roll_degrees: 90.0, ..looking(DVec3::Z * 5.0, DVec3::ZERO) };
    let place = |point| seen(&camera, 1.0, point).truncate().extend(0.0);
    assert!(place(DVec3::NEG_X).y > 0.1 && place(DVec3::Y).x > 0.1);
    assert_sound(&camera, 1.0);
    assert_sound(&OrbitCamera { roll_degrees: f64::NAN, ..camera }, 1.0);
}

#[test]
fn any_scene_can_be_framed() {
    let at = |center: f64, size: f64| {
        Some(Aabb { min: DVec3::splat(center - size / 2.0), max: DVec3::splat(center + size / 2.0) })
    };
    let huge = Some(Aabb { min: DVec3::splat(-f64::MAX), max: DVec3::splat(f64::MAX) });
    let nowhere = Some(Aabb { min: DVec3::splat(f64::NAN), max: DVec3::splat(f64::INFINITY) });
    for bounds in
        [None, at(0.0, 0.0), at(1e6, 0.0), at(0.0, 1e6), at(1e6, 1e6), at(0.0, 1e-6), at(1e6, 1e-6), nowhere, huge]
    {
        let mut camera = OrbitCamera::default();
        camera.frame(bounds, 1.6);
        assert_sound(&camera, 1.6);
        assert!(camera.eye != camera.target, "{bounds:?}");
    }
}

proptest! {
    /// Every corner of what is framed lies inside the image, and does so wherever it is orbited to sideways. A cube
    /// fills it, but for its margin and the corners that it turns through the silhouette of its cylinder.
    #[test]
    fn what_is_framed_is_in_view(
        center in proptest::array::uniform3(-10.0..10.0f64),
        size in proptest::array::uniform3(0.1..10.0f64),
        turn in [-3.0..3.0f64, -1.5..1.5],
        aspect in 0.2..5.0f64,
    ) {
        let (center, half) = (DVec3::from_array(center), DVec3::from_array(size) / 2.0);
        let mut camera = OrbitCamera::default();
        camera.orbit(turn[0], turn[1]);
        let mut widest_framed = |half: DVec3| {
            let bounds = Aabb { min: center - half, max: center + half };
            camera.frame(Some(bounds), aspect);
            let corners = bounds.corners().map(|corner| seen(&camera, aspect, corner));
            let widest = corners.into_iter().fold(0.0, |widest: f64, p| widest.max(p.x.abs()).max(p.y.abs()));
            for turn in [0.7, 2.0, 4.0] {
                let mut turned = camera;
                turned.orbit(turn, 0.0);
                let inside = bounds.corners().map(|corner| seen(&turned, aspect, corner).abs().max_element() <= 1.0);
                assert!(inside.iter().all(|inside| *inside), "turned by {turn}");
            }
            widest
        };
        let (any, cube) = (widest_framed(half), widest_framed(DVec3::splat(half.x)));
        prop_assert!(any <= 1.0, "{any}");
        prop_assert!((0.55..=1.0).contains(&cube), "{cube}");
    }

    #[test]
    fn orbiting_keeps_the_distance(turns in proptest::collection::vec([-4.0..4.0f64, -4.0..4.0], 1..20)) {
        let mut camera = looking(DVec3::new(3.0, 4.0, 12.0), DVec3::ZERO);
        for turn in turns {
            camera.orbit(turn[0], turn[1]);
            prop_assert!((camera.distance() - 13.0).abs() < 1e-11);
            assert_sound(&camera, 1.0);
        }
    }
}

#[test]
fn orbit_pan_and_zoom_do_what_they_say() {
    let mut camera = looking(DVec3::Z * 2.0, DVec3::ZERO);
    camera.orbit(std::f64::consts::FRAC_PI_2, 0.0);
    assert_near!(camera.eye, DVec3::X * 2.0, 1e-14);
    camera.zoom(0.5);
    assert_near!(camera.eye, DVec3::X, 1e-14);
    let before = seen(&camera, 1.0, DVec3::ZERO);
    camera.pan(0.25, -0.5);
    let after = seen(&camera, 1.0, DVec3::ZERO);
    // A height of the view is 2 on the image; the scene moves against the camera.
    assert_near!(after - before, DVec3::new(-0.5, 1.0, 0.0), 1e-12);
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let still = camera;
        camera.zoom(factor);
        assert_eq!(camera, still);
    }
    for _ in 0..10_000 {
        camera.zoom(0.5);
    }
    assert_sound(&camera, 1.0);
    for _ in 0..10_000 {
        camera.zoom(2.0);
    }
    assert_sound(&camera, 1.0);
}

/// A pointer drag on a screen of twice the scale factor has twice the pixels on twice the height.
#[test]
fn the_scale_factor_changes_nothing() {
    let dragged = |scale_factor: f64| {
        let (width_px, height_px) = (1280.0 * scale_factor, 800.0 * scale_factor);
        let mut camera = OrbitCamera::default();
        camera.pan(30.0 * scale_factor / height_px, 70.0 * scale_factor / height_px);
        (camera, camera.projection(width_px / height_px, FARTHEST))
    };
    assert_eq!(dragged(1.0), dragged(2.0));
    assert!(dragged(0.0).1.is_finite());
}

fn camera_scene(trs: Trs, projection: Projection) -> Scene {
    let mut scene = Scene::default();
    scene.cameras.push(SceneCamera { name: "camera".to_owned(), projection });
    scene.nodes.push(Node {
        name: "node".to_owned(),
        parent: None,
        local: LocalTransform::Trs(trs),
        mesh: None,
        skin: None,
        camera: Some(0),
        light: None,
        is_visible: true,
    });
    scene
}

fn taken(scene: &Scene, camera: usize, aspect: f64) -> Option<OrbitCamera> {
    scene.camera_at(camera, &scene.pose(None, 0.0), aspect)
}

#[test]
fn cameras_of_the_file_can_be_taken() {
    let perspective = Projection::Perspective { fov_y_radians: 0.5, aspect: None, near: 0.1, far: None };
    let placed = Trs {
        translation: DVec3::new(1.0, 2.0, 3.0),
        rotation: DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2),
        scale: DVec3::splat(0.01),
    };
    let camera = taken(&camera_scene(placed, perspective), 0, 1.0).expect("a camera");
    assert_eq!((camera.eye, camera.roll_degrees, camera.orthographic_height), (placed.translation, 0.0, None));
    assert_relative_eq!(camera.fov_y_degrees, 0.5f64.to_degrees(), epsilon = 1e-12);
    assert_near!(camera.target, DVec3::new(0.0, 2.0, 3.0), 1e-14);

    let flat = Projection::Orthographic { half_width: 3.0, half_height: 2.0, near: 0.0, far: 9.0 };
    let camera = taken(&camera_scene(placed, flat), 0, 1.5).expect("a camera");
    assert_eq!((camera.eye, camera.orthographic_height), (placed.translation, Some(4.0)));
    let top = camera.target + camera.world_from_camera().y_axis.truncate() * 2.0;
    assert_relative_eq!(seen(&camera, 1.5, top).y, 1.0, epsilon = 1e-12);

    let flat = camera_scene(Trs { scale: DVec3::ZERO, ..placed }, perspective);
    assert_eq!((taken(&flat, 0, 1.0), taken(&flat, 7, 1.0)), (None, None));
}

/// The node's own axes are those of the picture, whatever way it looks.
#[test]
fn a_camera_of_the_file_keeps_its_roll() {
    let lens = Projection::Perspective { fov_y_radians: 0.5, aspect: None, near: 0.1, far: None };
    for (turn, roll) in [(0.0, 30.0), (100.0, -75.0), (-20.0, 180.0), (10.0, 0.0)] {
        let (turn, pitch) = (f64::to_radians(turn), DQuat::from_rotation_x(-0.4));
        let rotation = DQuat::from_rotation_y(turn) * pitch * DQuat::from_rotation_z(f64::to_radians(roll));
        let camera = taken(&camera_scene(Trs { rotation, ..Trs::default() }, lens), 0, 1.0).expect("a camera");
        let axes = camera.world_from_camera();
        assert_near!(axes.x_axis.truncate(), rotation * DVec3::X, 1e-6);
        assert_near!(axes.y_axis.truncate(), rotation * DVec3::Y, 1e-6);
    }
}

/// A picture of another aspect shows all that the camera's own shows, and no less.
#[test]
fn a_camera_of_the_file_shows_all_of_its_own_picture() {
    let lenses = [
        Projection::Perspective { fov_y_radians: 0.9, aspect: Some(2.0), near: 0.1, far: None },
        Projection::Orthographic { half_width: 3.0, half_height: 1.5, near: 0.0, far: 9.0 },
    ];
    for lens in lenses {
        let scene = camera_scene(Trs::default(), lens);
        let half = |aspect| taken(&scene, 0, aspect).expect("a camera").half_extents(aspect);
        let own = half(2.0);
        for aspect in [0.5, 1.0, 1.9] {
            assert_relative_eq!(half(aspect).x, own.x, epsilon = 1e-12);
        }
        for aspect in [2.1, 4.0] {
            assert_relative_eq!(half(aspect).y, own.y, epsilon = 1e-12);
        }
    }
}
