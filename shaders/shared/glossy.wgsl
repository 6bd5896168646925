// Which surfaces send out a specular cone: those that reflect, and are no rougher than a limit.
#import shared/surface.wgsl

// Of a dielectric that reflects 4 % straight on, as glTF has it; of a metal its colour.
fn reflects(s: Surface) -> bool {
    return s.metallic < 1.0 || any(s.albedo > vec3<f32>(0.0));
}

fn is_glossy(s: Surface, most_roughness: f32) -> bool {
    return s.is_there && s.roughness <= most_roughness && reflects(s);
}
