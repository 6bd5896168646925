//! One sample of a pixel: the rendering equation along a path, term by term.
//!
//! At the first surface both lobes are sampled by themselves, so that each term is an estimate of its own.
//! Further along the path one direction is chosen by both. Lights are looked for from every surface (all at
//! the first one, later one, by what it would bring); emitting triangles are found in both ways, weighted by
//! the squares of their densities (Veach). Roulette ends paths without bias; nothing is clamped.

use glam::DVec3;

use super::brdf::Scattered;
use super::film::Sample;
use super::lights::{Arrival, solid};
use super::sampler::{Sampler, is_heads};
use super::surface::{Shape, Surface};
use super::{Term, TracedScene};
use crate::accuracy::posed_triangles::START_OFFSET_CELLS;
use crate::accuracy::ray_tree::Segment;
use crate::color::luminance;

/// Surfaces after the first that a path meets before roulette may end it.
const SURE_BOUNCES: u32 = 2;
/// Paths go on with no less and no more than this chance: an end must come, in a white furnace too.
const GOES_ON: [f64; 2] = [0.05, 0.95];

/// What comes along a direction, linear RGB, nits.
#[derive(Clone, Copy, Default)]
struct Arriving {
    /// From the sky, and from surfaces that emit or that lights and sky light.
    first: DVec3,
    all: DVec3,
}

impl TracedScene<'_> {
    /// Along a ray of the camera.
    pub(super) fn sample(&self, ray: Segment, sampler: &mut Sampler) -> Sample {
        let Some(seen) = self.meet(ray, sampler.coin()) else { return Sample::default() };
        let mut sample = Sample::of_surface();
        sample.add(Term::Direct, seen.emission + seen.unlit + self.lit_by_all(&seen, sampler));
        self.add_emitters(&seen, sampler, &mut sample);
        let [u, v, s, t] = sampler.four();
        if let Some(chosen) = seen.brdf.scatter_diffuse(seen.view, [u, v]) {
            let (distance, arriving) = self.arriving(&seen, &chosen, seen.brdf.is_diffuse(), sampler);
            sample.open = f64::from(u8::from(distance > self.occlusion_cells));
            sample.add(Term::DiffuseFirst, chosen.weight * arriving.first);
            sample.add(Term::DiffuseAll, chosen.weight * arriving.all);
        }
        if seen.brdf.is_glossy()
            && let Some(chosen) = seen.brdf.scatter_specular(seen.view, [s, t])
        {
            let (_, arriving) = self.arriving(&seen, &chosen, true, sampler);
            sample.add(Term::SpecularFirst, chosen.weight * arriving.first);
            sample.add(Term::SpecularAll, chosen.weight * arriving.all);
        }
        sample
    }

    /// What of `segment` is met first.
    fn meet(&self, segment: Segment, coin: u64) -> Option<Surface> {
        let tree = self.triangles.tree();
        let seen = |triangle, place| self.is_there((triangle, place), segment.direction, coin);
        let met = tree.nearest(segment, seen)?;
        let triangle = &tree.triangles()[met.triangle];
        let surface = triangle.surface as usize;
        let (reader, normals) = (&self.readers[surface], &self.triangles.surfaces()[surface].normals);
        let shape = Shape { number: met.triangle, triangle, normals };
        reader.read(&shape, met.place, (segment.direction, met.distance))
    }

    /// For who looks along a direction.
    fn is_there(&self, (number, place): (usize, DVec3), direction: DVec3, coin: u64) -> bool {
        let triangle = &self.triangles.tree().triangles()[number];
        let reader = &self.readers[triangle.surface as usize];
        let presence = || reader.presence(triangle.vertices, place);
        triangle.is_there_along(direction)
            && (reader.is_opaque() || is_heads(coin, triangle.decider(number, place), presence()))
    }

    /// `looked`: along which sides are looked at.
    fn is_open(&self, from: &Surface, (direction, length): (DVec3, f64), looked: DVec3, coin: u64) -> bool {
        let segment = Segment { from: from.point.start(direction), direction, length };
        let tree = self.triangles.tree();
        !tree.meets_any(segment, |triangle, place| self.is_there((triangle, place), looked, coin))
    }

    /// A punctual light sees as shadow maps do: what turns its single side away from it hides nothing.
    fn reaches(&self, at: &Surface, light: &Arrival, coin: u64) -> bool {
        self.is_open(at, (light.direction, light.distance), -light.direction, coin)
    }

    /// What a light brings to the eye, were nothing between.
    fn unshadowed(&self, at: &Surface, arrival: &Arrival) -> DVec3 {
        let cosine = at.brdf.normal().dot(arrival.direction);
        if cosine <= 0.0 || at.point.face.dot(arrival.direction) <= 0.0 {
            return DVec3::ZERO;
        }
        at.brdf.both(at.view, arrival.direction) * arrival.lux * cosine
    }

    /// All punctual lights.
    fn lit_by_all(&self, at: &Surface, sampler: &mut Sampler) -> DVec3 {
        let arrivals = self.punctual.iter().filter_map(|light| light.arrival(at.point.position));
        arrivals
            .map(|arrival| {
                let brought = self.unshadowed(at, &arrival);
                let is_lit = brought.max_element() > 0.0 && self.reaches(at, &arrival, sampler.coin());
                if is_lit { brought } else { DVec3::ZERO }
            })
            .sum()
    }

    /// One punctual light, chosen by what it would bring.
    fn lit_by_one(&self, at: &Surface, mut choice: f64, coin: u64) -> DVec3 {
        let mut total = 0.0;
        let mut chosen = None;
        for arrival in self.punctual.iter().filter_map(|light| light.arrival(at.point.position)) {
            let brought = self.unshadowed(at, &arrival);
            let amount = luminance(brought.to_array());
            if amount <= 0.0 {
                continue;
            }
            total += amount;
            // The number is used again: within either part it is even once more.
            let chance = amount / total;
            if choice < chance {
                choice /= chance;
                chosen = Some((arrival, brought, amount));
            } else {
                choice = (choice - chance) / (1.0 - chance);
            }
        }
        match chosen {
            Some((arrival, brought, amount)) if self.reaches(at, &arrival, coin) => brought * (total / amount),
            _ => DVec3::ZERO,
        }
    }

    /// A point of an emitting triangle: where it is, what it sends, and its density per steradian.
    fn emitter(&self, at: &Surface, numbers: [f64; 3], coin: u64) -> Option<(DVec3, DVec3, f64)> {
        let tree = self.triangles.tree();
        let point = self.emitters.choose(tree, numbers)?;
        let to_point = point.position - at.point.position;
        let distance = to_point.length();
        let direction = to_point.try_normalize()?;
        let faces = at.brdf.normal().dot(direction) > 0.0 && at.point.face.dot(direction) > 0.0;
        let cosine = point.face.dot(direction);
        if !faces || cosine == 0.0 {
            return None;
        }
        let triangle = &tree.triangles()[point.triangle];
        if !triangle.is_there_along(direction) {
            return None;
        }
        let reader = &self.readers[triangle.surface as usize];
        let share = reader.presence(triangle.vertices, point.place);
        let nits = reader.emission(triangle.vertices, point.place) * share;
        // Ends above the emitter, as rays start above what they leave.
        let length = distance - 2.0 * START_OFFSET_CELLS / cosine.abs();
        let is_seen = nits.max_element() > 0.0 && self.is_open(at, (direction, length), direction, coin);
        is_seen.then(|| (direction, nits, solid(point.density, distance, cosine)))
    }

    /// Emitting triangles at the first surface, for either lobe.
    fn add_emitters(&self, at: &Surface, sampler: &mut Sampler, sample: &mut Sample) {
        let [choice, u, v, _] = sampler.four();
        let Some((direction, nits, density)) = self.emitter(at, [choice, u, v], sampler.coin()) else { return };
        let arrived = nits * (at.brdf.normal().dot(direction) / density);
        let [diffuse, specular] = [at.brdf.diffuse_density(direction), at.brdf.specular_density(at.view, direction)];
        let diffuse = at.brdf.diffuse(at.view, direction) * arrived * share(density, diffuse);
        let specular = at.brdf.specular(at.view, direction) * arrived * share(density, specular);
        [Term::DiffuseFirst, Term::DiffuseAll].into_iter().for_each(|term| sample.add(term, diffuse));
        [Term::SpecularFirst, Term::SpecularAll].into_iter().for_each(|term| sample.add(term, specular));
    }

    /// How far the next surface is along a chosen direction, and what comes from there. `is_wanted`: more
    /// than the distance is.
    fn arriving(&self, from: &Surface, chosen: &Scattered, is_wanted: bool, sampler: &mut Sampler) -> (f64, Arriving) {
        // Below the face is the surface itself, whatever its shading normal says.
        if from.point.face.dot(chosen.direction) <= 0.0 {
            return (0.0, Arriving::default());
        }
        let ray = |from: &Surface, direction: DVec3| Segment {
            from: from.point.start(direction),
            direction,
            length: f64::INFINITY,
        };
        let Some(next) = self.meet(ray(from, chosen.direction), sampler.coin()) else {
            return (f64::INFINITY, Arriving { first: self.sky_nits, all: self.sky_nits });
        };
        let distance = next.distance;
        if !is_wanted {
            return (distance, Arriving::default());
        }
        (distance, self.along_path(next, chosen.density, sampler))
    }

    /// What a surface that was met by a direction of `density` sends back.
    fn along_path(&self, met: Surface, mut density: f64, sampler: &mut Sampler) -> Arriving {
        let mut arriving = Arriving::default();
        let (mut at, mut carried) = (met, DVec3::ONE);
        for bounce in 0.. {
            let cosine = at.point.face.dot(at.view);
            let looked_for = self.emitters.solid_density(at.triangle, at.distance, cosine);
            let [choice, u, v, light] = sampler.four();
            let lit = at.emission * share(density, looked_for) + self.lit_by_one(&at, light, sampler.coin());
            arriving.all += carried * lit;
            if bounce == 0 {
                arriving.first += lit;
            }
            arriving.all += carried * self.lit_by_emitter(&at, [choice, u, v], sampler.coin());
            let [choice, u, v, roulette] = sampler.four();
            let Some(chosen) = at.brdf.scatter(at.view, [choice, u, v]) else { break };
            carried *= chosen.weight;
            let chance = carried.max_element().clamp(GOES_ON[0], GOES_ON[1]);
            if bounce >= SURE_BOUNCES {
                if roulette >= chance {
                    break;
                }
                carried /= chance;
            }
            if carried.max_element() <= 0.0 || at.point.face.dot(chosen.direction) <= 0.0 {
                break;
            }
            let (from, direction) = (at.point.start(chosen.direction), chosen.direction);
            let Some(next) = self.meet(Segment { from, direction, length: f64::INFINITY }, sampler.coin()) else {
                arriving.all += carried * self.sky_nits;
                if bounce == 0 {
                    arriving.first += carried * self.sky_nits;
                }
                break;
            };
            (at, density) = (next, chosen.density);
        }
        arriving
    }

    fn lit_by_emitter(&self, at: &Surface, numbers: [f64; 3], coin: u64) -> DVec3 {
        if !at.brdf.reflects() {
            return DVec3::ZERO;
        }
        let Some((direction, nits, density)) = self.emitter(at, numbers, coin) else { return DVec3::ZERO };
        let cosine = at.brdf.normal().dot(direction);
        let met = at.brdf.density(at.view, direction);
        at.brdf.both(at.view, direction) * nits * (cosine / density * share(density, met))
    }
}

/// Weight of a way that found something with a density of its own beside that of the other way.
fn share(own: f64, other: f64) -> f64 {
    if other <= 0.0 { 1.0 } else { 1.0 / (1.0 + (other / own).powi(2)) }
}
