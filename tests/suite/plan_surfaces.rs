//! The plan's rules of lit surfaces, one by one: only what the picture calls for.

use octolume::plan::{Asked, FramePlan, Pass, SceneFacts, State};
use octolume::settings::lighting::Shadows;
use octolume::settings::{Lookup, Settings, SurfaceView, View};

use crate::plan::{RIGID, changed, first, other, reason, running};

const SUN: SceneFacts = SceneFacts { lights: 1, ..RIGID };
const GLOSSY: SceneFacts = SceneFacts { glossy: true, ..SUN };
const CONES: [Pass; 6] = [
    Pass::TraceDiffuse,
    Pass::BlurDiffuse,
    Pass::UpsampleDiffuse,
    Pass::ListGlossyTiles,
    Pass::TraceSpecular,
    Pass::UpsampleSpecular,
];
const SHOWN: [Pass; 3] = [Pass::ComposeSurfaces, Pass::MeasureExposure, Pass::ShowSurfaces];

fn showing(surface: SurfaceView) -> Settings {
    let mut settings = Settings::default();
    settings.method.look.view = View::Surfaces;
    settings.method.look.surface = surface;
    settings
}

fn builds_octree(plan: &FramePlan) -> bool {
    plan.runs(Pass::MarkLeaves)
}

#[test]
fn another_view_draws_no_surface() {
    let plan = first(&GLOSSY, &Settings::default());
    for pass in [Pass::DrawSurfaces, Pass::EmitSurfaces, Pass::LightSurfaces, Pass::LightByMarching]
        .into_iter()
        .chain(CONES)
        .chain(SHOWN)
    {
        assert_eq!(reason(&plan, pass), (State::Skip, "another view is shown"));
    }
}

#[test]
fn without_light_nothing_is_traced_and_no_octree_built() {
    let plan = first(&SceneFacts { glossy: true, ..RIGID }, &showing(SurfaceView::Final));
    assert_eq!(reason(&plan, Pass::TraceDiffuse), (State::Skip, "no light and no emission"));
    assert_eq!(reason(&plan, Pass::TraceSpecular), (State::Skip, "no light and no emission"));
    assert_eq!(reason(&plan, Pass::MarkLeaves), (State::Skip, "no cone and no shadow asks the octree"));
    assert_eq!(running(&plan), [&[Pass::DrawSurfaces, Pass::EmitSurfaces], &SHOWN[..]].concat());
}

#[test]
fn a_sun_on_matte_surfaces_calls_for_diffuse_cones_alone() {
    let of = |scene: &SceneFacts| {
        let plan = first(scene, &showing(SurfaceView::Final));
        CONES.into_iter().filter(|pass| plan.runs(*pass)).collect::<Vec<_>>()
    };
    assert_eq!(of(&SUN), [Pass::TraceDiffuse, Pass::BlurDiffuse, Pass::UpsampleDiffuse]);
    assert_eq!(
        of(&GLOSSY),
        [Pass::TraceDiffuse, Pass::BlurDiffuse, Pass::UpsampleDiffuse, Pass::ListGlossyTiles, Pass::TraceSpecular]
    );
    let matte = first(&SUN, &showing(SurfaceView::Specular));
    assert_eq!(reason(&matte, Pass::TraceSpecular), (State::Skip, "no glossy surface in the scene"));
}

#[test]
fn cones_that_are_off_are_not_traced() {
    let mut settings = showing(SurfaceView::Final);
    settings.method.cone_tracing.diffuse = false;
    settings.method.cone_tracing.specular = false;
    let dark = first(&GLOSSY, &settings);
    assert_eq!(reason(&dark, Pass::TraceDiffuse), (State::Skip, "diffuse cones are off"));
    assert_eq!(reason(&dark, Pass::TraceSpecular), (State::Skip, "the specular cone is off"));
    assert!(CONES.into_iter().all(|pass| !dark.runs(pass)) && !builds_octree(&dark));
    assert!(dark.runs(Pass::DrawShadows) && dark.runs(Pass::LightSurfaces), "direct light is looked at");
}

#[test]
fn occlusion_alone_reads_opacity_and_no_light() {
    let mut settings = showing(SurfaceView::Final);
    settings.method.cone_tracing.diffuse = false;
    settings.method.cone_tracing.specular = false;
    settings.method.cone_tracing.ambient_occlusion = true;
    assert!(!first(&SUN, &settings).runs(Pass::TraceDiffuse), "there is no sky to occlude");
    settings.method.lighting.sky_nits = [1.0; 3];
    let guessed = first(&SUN, &settings);
    assert!(guessed.runs(Pass::TraceDiffuse) && guessed.runs(Pass::AverageLight));
    assert_eq!(reason(&guessed, Pass::Illuminate), (State::Skip, "only opacity is looked at"));
    assert_eq!(reason(&guessed, Pass::GatherSky), (State::Skip, "only opacity is looked at"));
    let shown = first(&SUN, &showing(SurfaceView::Ao));
    assert!(shown.runs(Pass::TraceDiffuse) && !shown.runs(Pass::LightSurfaces) && !shown.runs(Pass::DrawShadows));
    assert_eq!(reason(&shown, Pass::MeasureExposure), (State::Skip, "no light is shown"));
}

#[test]
fn each_part_calls_for_what_it_shows() {
    use Pass::{DrawSurfaces, LightSurfaces, TraceDiffuse, TraceSpecular};
    for (surface, expected) in [
        (SurfaceView::Final, &[DrawSurfaces, LightSurfaces, TraceDiffuse, TraceSpecular][..]),
        (SurfaceView::Direct, &[DrawSurfaces, LightSurfaces]),
        (SurfaceView::Diffuse, &[DrawSurfaces, TraceDiffuse]),
        // What is not glossy reflects what diffuse cones see.
        (SurfaceView::Specular, &[DrawSurfaces, TraceDiffuse, TraceSpecular]),
        (SurfaceView::Irradiance, &[DrawSurfaces, TraceDiffuse]),
        (SurfaceView::Albedo, &[DrawSurfaces]),
        (SurfaceView::Depth, &[DrawSurfaces]),
    ] {
        let plan = first(&GLOSSY, &showing(surface));
        let ran =
            [DrawSurfaces, LightSurfaces, TraceDiffuse, TraceSpecular].into_iter().filter(|pass| plan.runs(*pass));
        assert_eq!(ran.collect::<Vec<_>>(), expected, "{surface:?}");
        assert_eq!(builds_octree(&plan), plan.runs(TraceDiffuse) || plan.runs(TraceSpecular), "{surface:?}");
    }
}

#[test]
fn a_moved_camera_draws_and_traces_again_and_lights_no_voxel() {
    let moved = changed(&GLOSSY, &showing(SurfaceView::Final), |asked| asked.contents.camera = other());
    let expected = [
        &[
            Pass::DrawSurfaces,
            Pass::EmitSurfaces,
            Pass::LightSurfaces,
            Pass::TraceDiffuse,
            Pass::BlurDiffuse,
            Pass::UpsampleDiffuse,
        ],
        &[Pass::ListGlossyTiles, Pass::TraceSpecular][..],
        &SHOWN,
    ];
    assert_eq!(running(&moved), expected.concat());
    assert!(changed(&GLOSSY, &showing(SurfaceView::Final), |_| {}).is_idle(), "all still");
}

#[test]
fn a_changed_light_draws_no_surface() {
    let edited = |asked: &mut Asked| asked.contents.lights = other();
    let plan = changed(&SUN, &showing(SurfaceView::Final), edited);
    assert_eq!(reason(&plan, Pass::DrawSurfaces), (State::Reuse, "camera and objects unmoved"));
    let expected = [
        &[Pass::Illuminate, Pass::InjectLight, Pass::AverageLight, Pass::EmitSurfaces, Pass::LightSurfaces][..],
        &[Pass::TraceDiffuse, Pass::BlurDiffuse, Pass::UpsampleDiffuse],
        &SHOWN,
    ];
    assert_eq!(running(&plan), expected.concat());
}

#[test]
fn pixels_that_share_no_cones_need_no_filter() {
    let mut settings = showing(SurfaceView::Final);
    settings.method.cone_tracing.half_resolution = false;
    let shared = first(&GLOSSY, &settings);
    assert!(shared.runs(Pass::BlurDiffuse));
    assert_eq!(reason(&shared, Pass::UpsampleDiffuse), (State::Skip, "every pixel sends out cones"));
    settings.method.cone_tracing.pattern_px = 1;
    let whole = first(&GLOSSY, &settings);
    assert_eq!(reason(&whole, Pass::BlurDiffuse), (State::Skip, "every pixel has all its cones"));
    assert_eq!(reason(&whole, Pass::UpsampleSpecular), (State::Skip, "every pixel sends out its cone"));
    settings.method.cone_tracing.indirect_px = Some([1280, 720]);
    assert!(!first(&GLOSSY, &settings).runs(Pass::UpsampleDiffuse), "the picture is no larger");
    let large = SceneFacts { picture_px: [1920, 1080], ..GLOSSY };
    let paper = first(&large, &settings);
    assert!(paper.runs(Pass::UpsampleDiffuse) && paper.runs(Pass::UpsampleSpecular));
}

#[test]
fn marched_shadows_and_pointers_ask_the_octree() {
    let mut settings = showing(SurfaceView::Direct);
    assert!(!builds_octree(&first(&SUN, &settings)));
    settings.method.lighting.shadows = Shadows::March;
    let marched = first(&SUN, &settings);
    assert!(builds_octree(&marched) && marched.runs(Pass::LightByMarching));
    assert!(!marched.runs(Pass::DrawShadows) && !marched.runs(Pass::AverageLight));
    settings.method.look.surface = SurfaceView::Diffuse;
    settings.method.cone_tracing.lookup = Lookup::BlockPointers;
    assert!(first(&SUN, &settings).runs(Pass::LinkNodes));
}

#[test]
fn a_set_exposure_is_not_measured() {
    let mut settings = showing(SurfaceView::Final);
    settings.method.look.exposure_stops = Some(-3.0);
    let plan = first(&SUN, &settings);
    assert_eq!(reason(&plan, Pass::MeasureExposure), (State::Skip, "the exposure is set"));
}
