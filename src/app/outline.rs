//! The scene's nodes as a tree a person can read: what hangs below each, and which of them a search
//! finds. Made once a voxelization, so that a frame of the window only walks the rows on screen.

use std::ops::AddAssign;

use crate::prepare::Prepared;
use crate::scene::Scene;

/// More rows than this are not unfolded before somebody asks.
const ROWS_AT_FIRST: usize = 64;
/// Nor deeper branches.
const DEPTH_AT_FIRST: usize = 6;

/// What a node and everything below it hold together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Contents {
    pub nodes: u64,
    pub objects: u64,
    pub triangles: u64,
    /// As moved: an object that shares its cache counts the cache's voxels once more.
    pub voxels: u64,
}

impl AddAssign for Contents {
    fn add_assign(&mut self, other: Self) {
        self.nodes += other.nodes;
        self.objects += other.objects;
        self.triangles += other.triangles;
        self.voxels += other.voxels;
    }
}

/// All vectors but `roots` are by node.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outline {
    pub roots: Vec<usize>,
    pub children: Vec<Vec<usize>>,
    pub contents: Vec<Contents>,
    /// Into [`Prepared::objects`].
    pub objects: Vec<Option<usize>>,
    pub is_joint: Vec<bool>,
    pub is_warned: Vec<bool>,
    /// Nodes above this depth are unfolded at first.
    pub unfolded_depth: usize,
}

impl Outline {
    pub fn new(prepared: &Prepared) -> Self {
        let scene = &prepared.scene;
        let count = scene.nodes.len();
        let mut outline = Self {
            children: vec![Vec::new(); count],
            contents: vec![Contents { nodes: 1, ..Contents::default() }; count],
            objects: vec![None; count],
            is_joint: vec![false; count],
            is_warned: vec![false; count],
            ..Self::default()
        };
        for (index, node) in scene.nodes.iter().enumerate() {
            match node.parent {
                Some(parent) => outline.children[parent].push(index),
                None => outline.roots.push(index),
            }
        }
        scene.skins.iter().flat_map(|skin| &skin.joints).for_each(|&joint| outline.is_joint[joint] = true);
        outline.count_objects(prepared);
        // Children come after their parents: from the last node on, every sum is complete when it is added.
        for index in (0..count).rev() {
            if let Some(parent) = scene.nodes[index].parent {
                let contents = outline.contents[index];
                outline.contents[parent] += contents;
            }
        }
        prepared.warnings.iter().flat_map(|warning| &warning.nodes).for_each(|&node| outline.is_warned[node] = true);
        outline.unfolded_depth = unfolded_depth(scene);
        outline
    }

    fn count_objects(&mut self, prepared: &Prepared) {
        for (index, object) in prepared.objects.iter().enumerate() {
            let (node, mesh) = (object.object.node, object.object.mesh);
            self.objects[node] = Some(index);
            self.contents[node] += Contents {
                nodes: 0,
                objects: 1,
                triangles: prepared.scene.meshes[mesh].triangle_count() as u64,
                voxels: prepared.caches[object.cache].voxels.len() as u64,
            };
        }
    }
}

/// By node: does its name hold the words searched for, in any case? `None` for an empty search.
pub fn found(scene: &Scene, search: &str) -> Option<Vec<usize>> {
    let search = search.trim().to_lowercase();
    let holds = |node: &usize| name(scene, *node).to_lowercase().contains(&search);
    (!search.is_empty()).then(|| (0..scene.nodes.len()).filter(holds).collect())
}

/// As it is called in the file, or by its number.
pub fn name(scene: &Scene, node: usize) -> String {
    match scene.nodes[node].name.as_str() {
        "" => format!("node {node}"),
        name => name.to_owned(),
    }
}

/// As deep as all rows down to there are few.
fn unfolded_depth(scene: &Scene) -> usize {
    let mut depths: Vec<usize> = Vec::with_capacity(scene.nodes.len());
    let mut rows: Vec<usize> = Vec::new();
    for node in &scene.nodes {
        let depth = node.parent.map_or(0, |parent| depths[parent] + 1);
        depths.push(depth);
        rows.resize(rows.len().max(depth + 1), 0);
        rows[depth] += 1;
    }
    let mut total = 0;
    let mut fits = |&rows: &usize| {
        total += rows;
        total <= ROWS_AT_FIRST
    };
    // The first depth whose rows do not fit stays folded into the one above.
    rows.iter().take_while(|rows| fits(rows)).count().saturating_sub(1).min(DEPTH_AT_FIRST)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::prepare::prepare;
    use crate::progress::Progress;
    use crate::scene::{LocalTransform, Mesh, Node, Primitive, Trs};
    use crate::settings::Discretization;

    fn node(name: &str, parent: Option<usize>, mesh: Option<usize>) -> Node {
        let local = LocalTransform::Trs(Trs::default());
        Node { name: name.to_owned(), parent, local, mesh, skin: None, camera: None, light: None, is_visible: true }
    }

    fn triangle() -> Mesh {
        let positions = vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y];
        let normals = vec![glam::Vec3::Z; 3];
        let primitive = Primitive { positions, normals, triangles: vec![[0, 1, 2]], ..Primitive::default() };
        Mesh { name: "triangle".to_owned(), primitives: vec![primitive] }
    }

    fn outline(nodes: Vec<Node>) -> (Outline, Prepared) {
        let scene = Scene { nodes, meshes: vec![triangle()], ..Scene::default() };
        let discretization = Discretization { grid: 64, ..Discretization::default() };
        let prepared = prepare(Arc::new(scene), &discretization, None, &Progress::default()).expect("a scene");
        (Outline::new(&prepared), prepared)
    }

    #[test]
    fn contents_are_summed_up_the_tree() {
        let nodes = vec![node("a", None, None), node("b", Some(0), Some(0)), node("c", Some(1), Some(0))];
        let (outline, prepared) = outline(nodes);
        assert_eq!((outline.roots, outline.children), (vec![0], vec![vec![1], vec![2], vec![]]));
        let voxels = prepared.caches[0].voxels.len() as u64;
        assert_eq!(outline.contents[0], Contents { nodes: 3, objects: 2, triangles: 2, voxels: 2 * voxels });
        assert_eq!(outline.contents[2], Contents { nodes: 1, objects: 1, triangles: 1, voxels });
        assert_eq!(outline.objects, [None, Some(0), Some(1)]);
    }

    #[test]
    fn small_trees_are_unfolded_and_large_ones_only_near_the_root() {
        let chain = |length: usize| (0..length).map(|index| node("link", index.checked_sub(1), None)).collect();
        assert_eq!(unfolded_depth(&Scene { nodes: chain(4), ..Scene::default() }), 3);
        assert_eq!(unfolded_depth(&Scene { nodes: chain(10_000), ..Scene::default() }), DEPTH_AT_FIRST);
        let mut flat = vec![node("root", None, None)];
        flat.extend((0..500).map(|_| node("cube", Some(0), None)));
        assert_eq!(unfolded_depth(&Scene { nodes: flat, ..Scene::default() }), 0);
    }

    #[test]
    fn a_search_finds_parts_of_names_in_any_case() {
        let nodes = vec![node("Wheel left", None, None), node("axle", None, None), node("", None, None)];
        let scene = Scene { nodes, ..Scene::default() };
        assert_eq!(found(&scene, "  "), None);
        assert_eq!(found(&scene, "WHEEL"), Some(vec![0]));
        assert_eq!(found(&scene, "node 2"), Some(vec![2]));
        assert_eq!(found(&scene, "door"), Some(vec![]));
    }
}
