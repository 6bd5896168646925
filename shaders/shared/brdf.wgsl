// The reflection of glTF's metallic-roughness materials (glTF 2.0, appendix B.3).
#import shared/surface.wgsl

// Reflectance at normal incidence.
fn f0_of(s: Surface) -> vec3<f32> {
    return mix(vec3<f32>(DIELECTRIC_REFLECTANCE), s.albedo, s.metallic);
}

fn diffuse_color(s: Surface) -> vec3<f32> {
    return s.albedo * (1.0 - s.metallic);
}

// Schlick's. What reflects nothing at normal incidence reflects nothing at all: a surface without shading.
fn fresnel(f0: vec3<f32>, cosine: f32) -> vec3<f32> {
    let grazing = pow(1.0 - min(cosine, 1.0), 5.0);
    return select(f0 + (1.0 - f0) * grazing, vec3<f32>(0.0), all(f0 == vec3<f32>(0.0)));
}

// Square of α: Trowbridge and Reitz's width.
fn squared_alpha(roughness: f32) -> f32 {
    let r = max(roughness, LEAST_ROUGHNESS);
    return r * r * r * r;
}

// Distribution and height-correlated visibility of the microfacets. 1 − (n·h)² is |n × h|², which loses no
// digits where a smooth surface has its highlight.
fn microfacets(a2: f32, n: vec3<f32>, h: vec3<f32>, n_l: f32, n_v: f32) -> f32 {
    let n_h = dot(n, h);
    let away = cross(n, h);
    let width = dot(away, away) + n_h * n_h * a2;
    let distribution = a2 * INVERSE_PI / (width * width);
    let seen = n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2);
    return distribution * 0.5 / seen;
}

// Radiance towards the eye from irradiance 1 on a plane across `to_light`, without the cosine. Per steradian.
fn brdf(s: Surface, to_light: vec3<f32>) -> vec3<f32> {
    let half_way = normalize(to_light - s.from_eye);
    let n_l = max(dot(s.normal, to_light), 0.0);
    // Normals are stored in 32 bits: what was drawn at LEAST_EYE_COSINE may have come back a little lower.
    let n_v = max(-dot(s.normal, s.from_eye), 0.5 * LEAST_EYE_COSINE);
    let reflected = fresnel(f0_of(s), max(-dot(s.from_eye, half_way), 0.0));
    let lobe = microfacets(squared_alpha(s.roughness), s.normal, half_way, n_l, n_v);
    return (1.0 - reflected) * diffuse_color(s) * INVERSE_PI + reflected * lobe;
}

// Share of a uniform sky that the specular lobe reflects to an eye at `cosine`: f0 · a + b, the rational fit of
// MaterialX (mx_ggx_dir_albedo_analytic) to the lobe's integral. How near it is: brdf_ref::ALBEDO_FIT_ERROR.
fn specular_albedo(f0: vec3<f32>, roughness: f32, cosine: f32) -> vec3<f32> {
    let x = cosine;
    let y = max(roughness, LEAST_ROUGHNESS) * max(roughness, LEAST_ROUGHNESS);
    let fit = vec4<f32>(0.1003, 0.9345, 1.0, 1.0) +
        vec4<f32>(-0.6303, -2.323, -1.765, 0.2281) * x +
        vec4<f32>(9.748, 2.229, 8.263, 15.94) * y +
        vec4<f32>(-2.038, -3.748, 11.53, -55.83) * (x * y) +
        vec4<f32>(29.34, 1.424, 28.96, 13.08) * (x * x) +
        vec4<f32>(-8.245, -0.7684, -7.507, 41.26) * (y * y) +
        vec4<f32>(-26.44, 1.436, -36.11, 54.9) * (x * x * y) +
        vec4<f32>(19.99, 0.2913, 15.86, 300.2) * (x * y * y) +
        vec4<f32>(-5.448, 0.6286, 33.37, -285.1) * (x * x * y * y);
    let ab = clamp(fit.xy / fit.zw, vec2<f32>(0.0), vec2<f32>(1.0));
    return select(min(f0 * ab.x + ab.y, vec3<f32>(1.0)), vec3<f32>(0.0), all(f0 == vec3<f32>(0.0)));
}
