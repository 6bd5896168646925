//! The generated scenes: valid glTF, the same bytes each time, and what they promise to hold.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use glam::{Quat, Vec3};
use gltf::animation::util::ReadOutputs;
use gltf::animation::{Interpolation, Property};
use octolume::progress::Progress;
use octolume::scene::{Motion, Pose, Scene, builtin, load};

/// How far a written unit vector may be from length 1: three components each rounded to half a
/// step of 1/8192.
const NORMAL_TOLERANCE: f32 = 1.8 * 0.5 / 8192.0;
/// The same for quaternions, four components and steps of 2⁻²⁰, with f32 rounding on top.
const ROTATION_TOLERANCE: f32 = 2.0 * 0.5 / 1_048_576.0 + 1e-7;

fn courtyard() -> gltf::Gltf {
    gltf::Gltf::from_slice(builtin::bytes("courtyard").expect("a known name")).expect("valid glTF")
}

fn blob(file: &gltf::Gltf) -> &[u8] {
    file.blob.as_deref().expect("a binary chunk")
}

fn triangles(mesh: &gltf::Mesh) -> usize {
    mesh.primitives().map(|part| part.indices().expect("indexed").count() / 3).sum()
}

#[test]
fn names_are_known_and_others_are_not() {
    for name in builtin::NAMES {
        assert!(builtin::make(name, 1).is_some() && builtin::bytes(name).is_some(), "{name}");
    }
    assert!(builtin::make("nowhere", 1).is_none() && builtin::bytes("nowhere").is_none());
}

#[test]
fn committed_files_are_what_the_generator_makes() {
    for name in builtin::NAMES {
        let (made, committed) = (builtin::make(name, 1).unwrap().unwrap(), builtin::bytes(name).unwrap());
        let difference = made.iter().zip(committed).position(|(a, b)| a != b);
        assert!(
            made == committed,
            "{name}: {} and {} bytes, first difference at {difference:?}",
            made.len(),
            committed.len()
        );
        assert!(made.len() <= 2 << 20, "{name}: {} bytes", made.len());
    }
}

#[test]
fn our_own_loader_has_nothing_to_say_against_them() {
    for name in builtin::MADE {
        assert_eq!(made(name, 3).warnings, [""; 0], "{name}");
    }
}

fn made(name: &str, characters: usize) -> Scene {
    let bytes = builtin::make(name, characters).expect("a known name").expect("is made");
    load::open_bytes(name, &bytes, None, &Progress::default()).expect("opens")
}

fn drawn_triangles(scene: &Scene) -> usize {
    scene.objects().iter().map(|object| scene.meshes[object.mesh].triangle_count()).sum()
}

#[test]
fn the_character_is_54_skinned_parts_on_22_joints() {
    let scene = made("character", 1);
    let skinned = scene.objects().iter().filter(|object| matches!(object.motion, Motion::Skinned { .. })).count();
    assert_eq!((skinned, scene.skins.len(), scene.skins[0].joints.len()), (54, 1, 22));
    let triangles = drawn_triangles(&scene);
    assert!((25_200..=26_200).contains(&triangles), "{triangles}");
    let clips: Vec<&str> = scene.own_clips().iter().map(|clip| &*clip.name).collect();
    assert_eq!(clips, ["walk", "turn"]);
}

#[test]
fn the_atrium_is_patrolled_and_nine_things_move_in_it() {
    let scene = made("atrium", 1);
    let objects = scene.objects();
    let moving = |is: fn(&Motion) -> bool| objects.iter().filter(|object| is(&object.motion)).count();
    assert_eq!(moving(|motion| matches!(motion, Motion::Rigid)), 9);
    assert_eq!(moving(|motion| matches!(motion, Motion::Skinned { .. })), 54);
    assert!((370..=410).contains(&objects.len()), "{}", objects.len());
    let triangles = drawn_triangles(&scene);
    assert!((255_000..=269_000).contains(&triangles), "{triangles}");
}

/// Rotations of a guard's joints below the root, which lies where its lap begins.
fn gait(pose: &Pose, scene: &Scene, skin: usize) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    for joint in &scene.skins[skin].joints[1..] {
        let parent = scene.nodes[*joint].parent.expect("below the root");
        let local = pose.world_from_node[parent].inverse() * pose.world_from_node[*joint];
        local.to_cols_array().iter().for_each(|value| {
            hasher.update(&((value * 1e6).round() as i64).to_le_bytes());
        });
    }
    hasher.finalize()
}

#[test]
fn no_two_of_256_characters_walk_alike_and_all_share_their_meshes() {
    let scene = made("dynamic", builtin::MOST_CHARACTERS);
    assert_eq!((scene.skins.len(), scene.meshes.len()), (256, 54 + 2));
    assert_eq!(scene.objects().len(), 256 * (54 + 1));
    let triangles = drawn_triangles(&scene);
    assert!((6_400_000..=6_800_000).contains(&triangles), "{triangles}");
    for time_secs in [0.0, 0.5, 1.7, 3.9] {
        let pose = scene.pose(Some(0), time_secs);
        let gaits: HashSet<blake3::Hash> = (0..256).map(|skin| gait(&pose, &scene, skin)).collect();
        assert_eq!(gaits.len(), 256, "at {time_secs} s");
    }
}

#[test]
fn courtyard_holds_what_it_promises() {
    let file = courtyard();
    let used: BTreeSet<_> = file.extensions_used().collect();
    assert_eq!(used, BTreeSet::from(["KHR_lights_punctual", "KHR_materials_emissive_strength"]));
    assert_eq!(file.extensions_required().count(), 0);
    assert_eq!(file.cameras().count(), 1);
    assert_eq!(file.lights().expect("lights").count(), 1);
    assert!(file.materials().any(|material| material.emissive_strength().is_some_and(|strength| strength > 1.0)));
    assert!(file.materials().any(|material| material.double_sided()));

    let unique: usize = file.meshes().map(|mesh| triangles(&mesh)).sum();
    let drawn: usize = file.nodes().filter_map(|node| node.mesh()).map(|mesh| triangles(&mesh)).sum();
    assert!((15_000..=40_000).contains(&unique) && (15_000..=40_000).contains(&drawn), "{unique}, {drawn} drawn");

    let mut instances: BTreeMap<usize, usize> = BTreeMap::new();
    for mesh in file.nodes().filter_map(|node| node.mesh()) {
        *instances.entry(mesh.index()).or_default() += 1;
    }
    let column = file.meshes().find(|mesh| mesh.name() == Some("column")).expect("columns");
    assert!(instances[&column.index()] >= 10);
    let scales: Vec<Vec3> = file.nodes().map(|node| Vec3::from(node.transform().decomposed().2)).collect();
    assert!(scales.iter().any(|scale| scale.x * scale.y * scale.z < 0.0), "a mirrored instance");
    assert!(scales.iter().any(|scale| scale.x != scale.y && scale.min_element() > 0.0), "an uneven scale");
}

#[test]
fn courtyard_is_about_14_by_14_by_7_metres() {
    let file = courtyard();
    let wall = file.meshes().find(|mesh| mesh.name() == Some("back wall")).expect("a wall");
    let bounds: Vec<_> = wall.primitives().map(|part| part.bounding_box()).collect();
    let low = bounds.iter().map(|bounds| Vec3::from(bounds.min)).reduce(Vec3::min).unwrap();
    let high = bounds.iter().map(|bounds| Vec3::from(bounds.max)).reduce(Vec3::max).unwrap();
    assert!((14.0..15.0).contains(&(high.x - low.x)), "{low} to {high}");
    assert!((6.5..7.5).contains(&high.y), "{low} to {high}");
}

#[test]
fn vertices_are_finite_with_unit_normals_inside_their_bounds() {
    let file = courtyard();
    for mesh in file.meshes() {
        for part in mesh.primitives() {
            let reader = part.reader(|_| Some(blob(&file)));
            let bounds = part.bounding_box();
            let positions: Vec<Vec3> = reader.read_positions().expect("positions").map(Vec3::from).collect();
            for position in &positions {
                assert!(position.is_finite());
                assert!(position.cmpge(bounds.min.into()).all() && position.cmple(bounds.max.into()).all());
            }
            let normals: Vec<Vec3> = reader.read_normals().expect("normals").map(Vec3::from).collect();
            assert_eq!(normals.len(), positions.len());
            for normal in &normals {
                assert!((normal.length() - 1.0).abs() <= NORMAL_TOLERANCE, "{:?}: {normal}", mesh.name());
            }
            let uvs: Vec<[f32; 2]> = reader.read_tex_coords(0).expect("UVs").into_f32().collect();
            assert_eq!(uvs.len(), positions.len());
            let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
            for corners in indices.chunks(3) {
                let [a, b, c] = [0, 1, 2].map(|corner| positions[corners[corner] as usize]);
                let face = (b - a).cross(c - a);
                assert!(face.length() > 0.0, "{:?}: an empty triangle", mesh.name());
                let mean: Vec3 = corners.iter().map(|&corner| normals[corner as usize]).sum();
                assert!(face.dot(mean) > 0.0, "{:?}: a triangle against its normals", mesh.name());
            }
        }
    }
}

#[test]
fn the_traveller_is_many_parts_on_one_skin() {
    let file = courtyard();
    let skins: Vec<_> = file.skins().collect();
    assert_eq!(skins.len(), 1);
    let joints = skins[0].joints().count();
    assert!(joints >= 20, "{joints} joints");
    let skinned: Vec<_> = file.nodes().filter(|node| node.skin().is_some()).filter_map(|node| node.mesh()).collect();
    assert!(skinned.len() >= 3, "{} meshes", skinned.len());
    let parts: Vec<_> = skinned.iter().flat_map(|mesh| mesh.primitives()).collect();
    assert!(parts.len() >= 15, "{} parts", parts.len());

    let mut followed = BTreeSet::new();
    let mut blended = 0;
    for part in parts {
        let reader = part.reader(|_| Some(blob(&file)));
        let gltf::mesh::util::ReadWeights::U8(weights) = reader.read_weights(0).expect("weights") else {
            panic!("weights are stored as bytes");
        };
        let influences = reader.read_joints(0).expect("joints").into_u16().zip(weights);
        for (vertex_joints, weights) in influences {
            assert_eq!(weights.iter().map(|&weight| u32::from(weight)).sum::<u32>(), 255);
            let strong = vertex_joints.iter().zip(weights).filter(|&(_, weight)| weight > 0);
            let strong: Vec<u16> = strong.map(|(&joint, _)| joint).collect();
            blended += usize::from(strong.len() > 1);
            assert!(strong.iter().all(|&joint| usize::from(joint) < joints));
            assert_eq!(strong.iter().collect::<BTreeSet<_>>().len(), strong.len(), "a joint named twice");
            followed.extend(strong);
        }
    }
    // The root only carries the walk; nearly every other joint bends something.
    assert!(followed.len() >= 20, "joints with vertices: {followed:?}");
    assert!(blended > 500, "{blended} vertices follow more than one joint");
}

/// Keys of a channel as rows of floats, in-tangents and out-tangents left out.
fn keys(file: &gltf::Gltf, channel: &gltf::animation::Channel) -> (Vec<f32>, Vec<Vec<f32>>) {
    let reader = channel.reader(|_| Some(blob(file)));
    let times: Vec<f32> = reader.read_inputs().expect("times").collect();
    let rows: Vec<Vec<f32>> = match reader.read_outputs().expect("values") {
        ReadOutputs::Translations(rows) => rows.map(|row| row.to_vec()).collect(),
        ReadOutputs::Rotations(rows) => rows.into_f32().map(|row| row.to_vec()).collect(),
        _ => panic!("only translations and rotations move"),
    };
    match channel.sampler().interpolation() {
        Interpolation::CubicSpline => (times, rows.chunks(3).map(|key| key[1].clone()).collect()),
        _ => (times, rows),
    }
}

#[test]
fn clips_have_increasing_times_and_unit_rotations_and_walk_closes() {
    let file = courtyard();
    let clips: Vec<_> = file.animations().collect();
    assert_eq!(clips.iter().map(|clip| clip.name().unwrap()).collect::<Vec<_>>(), ["walk", "wave"]);
    for clip in &clips {
        for channel in clip.channels() {
            let name = channel.target().node().name().unwrap_or_default().to_owned();
            let (times, values) = keys(&file, &channel);
            assert_eq!(times.len(), values.len(), "{name}");
            assert!(times[0] == 0.0 && times.windows(2).all(|pair| pair[0] < pair[1]), "{name}: {times:?}");
            let (first, last) = (&values[0], &values[values.len() - 1]);
            if channel.target().property() == Property::Rotation {
                let rotations: Vec<Quat> = values.iter().map(|row| Quat::from_slice(row)).collect();
                assert!(rotations.iter().all(|key| (key.length() - 1.0).abs() <= ROTATION_TOLERANCE), "{name}");
                // After a whole turn the same rotation may come back with the other sign.
                let opposite: Vec<f32> = last.iter().map(|value| -value).collect();
                assert!(first == last || *first == opposite, "{name}: {first:?} to {last:?}");
            } else {
                assert_eq!(first, last, "{name}");
            }
        }
    }
}

#[test]
fn walk_moves_traveller_and_solids_with_every_interpolation() {
    let file = courtyard();
    let walk = file.animations().find(|clip| clip.name() == Some("walk")).expect("the clip walk");
    let mut moved: BTreeMap<String, Interpolation> = BTreeMap::new();
    for channel in walk.channels() {
        moved.insert(channel.target().node().name().unwrap().into(), channel.sampler().interpolation());
    }
    for (name, interpolation) in [
        ("turning ring", Interpolation::Linear),
        ("heart", Interpolation::Linear),
        ("cube", Interpolation::Linear),
        ("vane", Interpolation::Step),
        ("swinging lantern", Interpolation::CubicSpline),
        ("root", Interpolation::Linear),
        ("shin.L", Interpolation::Linear),
    ] {
        assert_eq!(moved.get(name), Some(&interpolation), "{name}");
    }
    let root = walk.channels().find(|channel| {
        channel.target().node().name() == Some("root") && channel.target().property() == Property::Translation
    });
    let (_, path) = keys(&file, &root.expect("the root moves"));
    let radii: Vec<f32> = path.iter().map(|place| Vec3::from_slice(place).length()).collect();
    assert!(radii.iter().all(|radius| (radius - radii[0]).abs() < 1e-3), "a circle round the fountain");
    let across = path.iter().map(|place| (Vec3::from_slice(place) - Vec3::from_slice(&path[0])).length());
    assert!(across.fold(0.0, f32::max) > 1.9 * radii[0], "a whole lap");
}
