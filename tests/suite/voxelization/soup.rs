//! Meshes made in memory, and a small deterministic random source.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use octolume::settings::VoxelizationMode;
use octolume::stages::voxelize::voxelize_cells;

#[derive(Clone, Debug, Default)]
pub struct Soup {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// splitmix64
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn point(&mut self, low: f64, high: f64) -> DVec3 {
        let mut coordinate = || low + (high - low) * self.unit();
        DVec3::new(coordinate(), coordinate(), coordinate())
    }

    /// Uniform over all rotations (Shoemake).
    pub fn rotation(&mut self) -> DQuat {
        let (u, v, w) = (self.unit(), std::f64::consts::TAU * self.unit(), std::f64::consts::TAU * self.unit());
        let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
        DQuat::from_xyzw(a * v.sin(), a * v.cos(), b * w.sin(), b * w.cos())
    }

    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }
}

impl Soup {
    pub fn triangle(corners: [DVec3; 3]) -> Self {
        Self { positions: corners.to_vec(), triangles: vec![[0, 1, 2]] }
    }

    /// The parallelogram at `corner`, as two triangles.
    pub fn parallelogram(corner: DVec3, a: DVec3, b: DVec3) -> Self {
        Self { positions: vec![corner, corner + a, corner + a + b, corner + b], triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    /// Triangles whose corners lie within `size` of a random place in [0, extent)³.
    pub fn random(random: &mut Random, count: usize, extent: f64, size: f64) -> Self {
        let mut soup = Self::default();
        for i in 0..count as u32 {
            let place = random.point(0.0, extent);
            soup.positions.extend([0; 3].map(|_| place + random.point(-size, size)));
            soup.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        soup
    }

    /// A closed sphere: an octahedron whose edges are halved `levels` times.
    pub fn sphere(center: DVec3, radius: f64, levels: u32) -> Self {
        let mut soup = Self {
            positions: vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z],
            triangles: vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]],
        };
        for _ in 0..levels {
            soup.subdivide();
        }
        soup.map(|p| center + radius * p.normalize())
    }

    pub fn torus(center: DVec3, radius: f64, tube: f64, segments: u32) -> Self {
        let mut soup = Self::default();
        let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(segments);
        for i in 0..segments {
            for j in 0..segments {
                let (around, across) = (angle(i), angle(j));
                let ring = radius + tube * across.cos();
                soup.positions.push(center + DVec3::new(ring * around.cos(), ring * around.sin(), tube * across.sin()));
                let at = |i: u32, j: u32| (i % segments) * segments + j % segments;
                soup.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                soup.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        soup
    }

    fn subdivide(&mut self) {
        let mut midpoints = BTreeMap::new();
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        for &[a, b, c] in &self.triangles {
            let positions = &mut self.positions;
            let mut middle = |i: u32, j: u32| {
                *midpoints.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    positions.push((positions[i as usize] + positions[j as usize]).normalize());
                    positions.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        self.triangles = triangles;
    }

    pub fn map(mut self, place: impl Fn(DVec3) -> DVec3) -> Self {
        self.positions.iter_mut().for_each(|position| *position = place(*position));
        self
    }

    /// The same triangles, listed in another order, wound at random, over shuffled vertices.
    pub fn shuffled(&self, random: &mut Random) -> (Self, Vec<usize>) {
        let mut from: Vec<usize> = (0..self.positions.len()).collect();
        random.shuffle(&mut from);
        let mut to = vec![0; from.len()];
        from.iter().enumerate().for_each(|(new, &old)| to[old] = new as u32);
        let mut triangles: Vec<[u32; 3]> = self.triangles.iter().map(|t| t.map(|v| to[v as usize])).collect();
        triangles.iter_mut().for_each(|triangle| random.shuffle(triangle));
        random.shuffle(&mut triangles);
        (Self { positions: from.iter().map(|&old| self.positions[old]).collect(), triangles }, from)
    }

    pub fn area(&self) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|v| self.positions[v as usize]);
        self.triangles.iter().map(corners).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
    }

    pub fn cells(&self, mode: VoxelizationMode) -> Vec<glam::IVec3> {
        voxelize_cells(&self.positions, &self.triangles, mode, None).unwrap()
    }
}
