//! Normal maps in the surface image, against closed forms.

use glam::{Affine2, DMat3, DQuat, DVec3, Vec2, Vec4};
use octolume::scene::{LocalTransform, Material, Scene, Texture, TextureRef, Trs};
use octolume::stages::surface::LEAST_EYE_COSINE;

use crate::mesh_rig::one_square;
use crate::surface_image::{drawn, inside, shot, texture};
use crate::surface_rig::is_there;

fn plain(texel: [u8; 4]) -> Texture {
    texture(image::RgbaImage::from_pixel(2, 2, image::Rgba(texel)))
}

/// The normal that a texel stands for, in the frame of the surface.
fn decoded(texel: [u8; 4]) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|lane| f64::from(texel[lane]) / 127.5 - 1.0)).normalize()
}

fn assert_normals(scene: &Scene, expected: DVec3, what: &str) {
    let texels = drawn(scene);
    let mut count = 0;
    for (place, texel) in inside(&texels) {
        assert!(texel.normal.distance(expected) < 2e-3, "{what}: {} is not {expected} at {place}", texel.normal);
        count += 1;
    }
    assert!(count > 200, "{what}: {count} pixels");
}

const BUMP: [u8; 4] = [218, 128, 218, 255];

fn bumped(texel: [u8; 4], material: Material) -> Scene {
    let material = Material { normal_texture: Some(TextureRef::new(0, 0)), double_sided: true, ..material };
    Scene { textures: vec![plain(texel)], ..one_square(material) }
}

#[test]
fn normal_maps_turn_the_normal_in_the_frame_of_the_texture() {
    let expected = decoded(BUMP);
    assert!((expected.x - expected.z).abs() < 1e-12, "45 degrees");
    let mut scene = bumped(BUMP, Material::default());
    assert_normals(&scene, expected, "u grows along x");
    let up = [128, 218, 218, 255];
    assert_normals(&bumped(up, Material::default()), decoded(up), "green is up, where v falls");
    let scaled = DVec3::new(0.5 * expected.x, 0.5 * expected.y, expected.z).normalize();
    assert_normals(&bumped(BUMP, Material { normal_scale: 0.5, ..Material::default() }), scaled, "half the scale");
    // Texture coordinates turned by 90 degrees: u grows along y.
    let quarter = Affine2::from_angle(std::f32::consts::FRAC_PI_2);
    let mut turned = scene.clone();
    turned.materials[0].normal_texture = Some(TextureRef { uv_from_tex_coord: quarter, ..TextureRef::new(0, 0) });
    let about_z = DMat3::from_rotation_z(std::f64::consts::FRAC_PI_2) * expected;
    assert_normals(&turned, about_z, "texture coordinates turned");
    // The vertices' own frame: tangent up, bitangent by its handedness.
    for handed in [1.0, -1.0] {
        scene.meshes[0].primitives[0].tangents = vec![Vec4::new(0.0, 1.0, 0.0, handed); 4];
        let bitangent = DVec3::Z.cross(DVec3::Y) * f64::from(handed);
        let expected = expected.x * DVec3::Y + expected.y * bitangent + expected.z * DVec3::Z;
        assert_normals(&scene, expected, "tangents");
    }
    // Coordinates without extent give no frame.
    let mut pinched = bumped(BUMP, Material::default());
    pinched.meshes[0].primitives[0].tex_coords[0] = vec![Vec2::ZERO; 4];
    assert_normals(&pinched, DVec3::Z, "no frame");
}

/// A bump seen from behind is a dent, and a mirrored one leans the other way, with tangents or without.
#[test]
fn normal_maps_turn_and_mirror_with_their_surface() {
    let bump = decoded([218, 160, 218, 255]);
    for with_tangents in [false, true] {
        for (turn, mirror) in [(0.0, 1.0), (180.0, 1.0), (0.0, -1.0), (180.0, -1.0)] {
            let mut scene = bumped([218, 160, 218, 255], Material::default());
            if with_tangents {
                scene.meshes[0].primitives[0].tangents = vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4];
            }
            let rotation = DQuat::from_rotation_y(f64::to_radians(turn));
            let scale = DVec3::new(mirror, 1.0, 1.0);
            scene.nodes[0].local = LocalTransform::Trs(Trs { rotation, scale, ..Trs::default() });
            // The reflection is its own inverse transpose.
            let moved = rotation * (scale * bump);
            let expected = if moved.z < 0.0 { -moved } else { moved };
            assert_normals(&scene, expected, &format!("turned {turn}, mirrored {mirror}, tangents {with_tangents}"));
        }
    }
}

#[test]
fn normals_that_turn_away_from_the_eye_are_moved_back_to_it() {
    let away = [255, 128, 130, 255];
    for angle in [0.0, 180.0_f64] {
        let mut scene = bumped(away, Material::default());
        scene.nodes[0].local = LocalTransform::Trs(Trs {
            rotation: DQuat::from_rotation_y(angle.to_radians()) * DQuat::from_rotation_z(angle.to_radians()),
            ..Trs::default()
        });
        let shot = shot(&scene);
        let texels = shot.drawn().texels;
        let (mut least, mut moved) = (f64::INFINITY, 0);
        for (pixel, texel) in texels.iter().enumerate().filter(|(_, texel)| is_there(texel)) {
            let cosine = texel.normal.dot(shot.place(pixel, texel).1);
            least = least.min(cosine);
            moved += usize::from(cosine < LEAST_EYE_COSINE + 1e-4);
        }
        assert!(least > LEAST_EYE_COSINE - 1e-4, "{least}");
        assert!(moved > 20, "{moved} moved");
    }
}
