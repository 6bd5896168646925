//! Where light comes from: KHR_lights_punctual, the sky, and triangles that emit.
//!
//! In: posed lights and the posed triangles. Out: what arrives at a point from a light, lux across its
//! direction; and points on emitting triangles, chosen by the light that they send out.

use glam::DVec3;

use super::surface::SurfaceReader;
use crate::accuracy::ray_tree::RayTree;
use crate::accuracy::triangle::weighted;
use crate::color::luminance;
use crate::data::grid::Grid;
use crate::lights::PosedLight;
use crate::scene::LightKind;

/// A light in cells.
pub struct Punctual {
    pub kind: LightKind,
    /// Lux, or candela over the squared span.
    pub strength: DVec3,
    pub position: DVec3,
    pub direction: DVec3,
    pub span: f64,
}

/// Light at a point.
pub struct Arrival {
    /// To the light.
    pub direction: DVec3,
    /// Cells; infinite for directional lights.
    pub distance: f64,
    /// Across the direction, linear RGB, lux.
    pub lux: DVec3,
}

impl Punctual {
    pub fn new(light: &PosedLight, grid: &Grid) -> Self {
        let position = grid.grid_from_world().transform_point3(light.position);
        let per_square = match light.kind {
            LightKind::Directional => 1.0,
            LightKind::Point { .. } | LightKind::Spot { .. } => grid.span.powi(-2),
        };
        let strength = light.strength * per_square;
        Self { kind: light.kind, strength, position, direction: light.direction, span: grid.span }
    }

    /// `None` in the light itself, and where none of it arrives.
    pub fn arrival(&self, point: DVec3) -> Option<Arrival> {
        let to_light = self.position - point;
        let distance = to_light.length();
        let direction = to_light.try_normalize();
        let (direction, distance, share) = match self.kind {
            LightKind::Directional => (-self.direction, f64::INFINITY, 1.0),
            LightKind::Point { range } => (direction?, distance, self.falloff(distance, range)),
            LightKind::Spot { range, inner_cone_radians, outer_cone_radians } => {
                let [inner, outer] = [inner_cone_radians, outer_cone_radians].map(|angle| f64::from(angle).cos());
                let inside = (self.direction.dot(-direction?) - outer) / (inner - outer).max(0.001);
                (direction?, distance, self.falloff(distance, range) * inside.clamp(0.0, 1.0).powi(2))
            }
        };
        (share > 0.0).then(|| Arrival { direction, distance, lux: self.strength * share })
    }

    fn falloff(&self, distance: f64, range: Option<f32>) -> f64 {
        let window =
            range.map_or(1.0, |range| (1.0 - (distance * self.span / f64::from(range)).powi(4)).clamp(0.0, 1.0));
        window / (distance * distance)
    }
}

/// Triangles that emit, to be chosen by area times luminance.
#[derive(Default)]
pub struct Emitters {
    triangles: Vec<usize>,
    /// Sums of the chances up to each, the last 1.
    ends: Vec<f64>,
    /// By triangle of the scene: chance of a point on it, per square cell. Empty where nothing emits.
    densities: Vec<f64>,
}

/// A point that emits.
pub struct EmitterPoint {
    pub triangle: usize,
    pub place: DVec3,
    pub position: DVec3,
    /// Of the triangle, on either side.
    pub face: DVec3,
    /// Per square cell.
    pub density: f64,
}

impl Emitters {
    /// `readers`: by surface.
    pub fn new(tree: &RayTree, readers: &[SurfaceReader]) -> Self {
        let power = |number: usize| {
            let triangle = &tree.triangles()[number];
            let reader = &readers[triangle.surface as usize];
            if !reader.emits() {
                return 0.0;
            }
            // A few places say roughly how bright a texture is; chances need not be exact, and none is 0.
            let places = [[1.0, 1.0, 1.0], [4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]].map(DVec3::from_array);
            let nits = |place: DVec3| reader.emission(triangle.vertices, place / place.element_sum());
            let mean = places.into_iter().map(|place| luminance(nits(place).to_array())).sum::<f64>() / 4.0;
            let factor = luminance(reader.material.emissive.map(f64::from)) * reader.emission;
            (0.9 * mean + 0.1 * factor) * triangle.doubled_area().length() / 2.0
        };
        let powers: Vec<f64> = (0..tree.triangles().len()).map(power).collect();
        let total: f64 = powers.iter().sum();
        if total <= 0.0 {
            return Self::default();
        }
        let triangles: Vec<usize> = (0..powers.len()).filter(|&number| powers[number] > 0.0).collect();
        let mut sum = 0.0;
        let ends = triangles.iter().map(|&number| {
            sum += powers[number] / total;
            sum
        });
        let density = |number: usize| match powers[number] {
            power if power > 0.0 => power / total / (tree.triangles()[number].doubled_area().length() / 2.0),
            _ => 0.0,
        };
        Self { ends: ends.collect(), triangles, densities: (0..powers.len()).map(density).collect() }
    }

    /// `None` where nothing emits.
    pub fn choose(&self, tree: &RayTree, [choice, u, v]: [f64; 3]) -> Option<EmitterPoint> {
        let last = self.triangles.len().checked_sub(1)?;
        let triangle = self.triangles[self.ends.partition_point(|&end| end <= choice).min(last)];
        // Folds the square onto the triangle without a seam in area.
        let root = u.sqrt();
        let place = DVec3::new(1.0 - root, root * (1.0 - v), root * v);
        let posed = &tree.triangles()[triangle];
        Some(EmitterPoint {
            triangle,
            place,
            position: weighted(posed.corners, place),
            face: posed.doubled_area().try_normalize()?,
            density: self.densities[triangle],
        })
    }

    /// Chance per steradian that [`Self::choose`] gives a point that a ray met under a cosine.
    pub fn solid_density(&self, triangle: usize, distance: f64, cosine: f64) -> f64 {
        match self.densities.get(triangle) {
            Some(&density) if density > 0.0 => solid(density, distance, cosine),
            _ => 0.0,
        }
    }
}

/// From a density per square cell to one per steradian.
pub fn solid(density: f64, distance: f64, cosine: f64) -> f64 {
    density * distance * distance / cosine.abs().max(f64::MIN_POSITIVE)
}
