//! The parts of a frame in the order of section 4.1: voxels are moved, the octree is built from them, light is
//! injected and averaged, cones are traced, a picture is shown.

/// One thing that the GPU holds. What it is made from is its [`super::Key`]; its buffers are in `engine::parts`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The voxels of every object, each cache once (section 3.1).
    Caches,
    /// Pages and segments of the objects in the grid (section 4.2, Object I-O).
    Pages,
    /// World voxels of static and rigid objects, in those pages (section 3.2).
    RigidVoxels,
    SkinnedVoxels,
    /// Materials and textures as the voxelizer of posed triangles reads them.
    Materials,
    /// How many columns of cells each posed triangle runs through.
    Columns,
    /// World voxels of the posed triangles: the other discretizer.
    PosedVoxels,
    /// Both lists of world voxels in one, where some objects are moved and others voxelized.
    JoinedVoxels,
    /// Which leaves and blocks there are, and their ranks (section 4.3).
    Masks,
    /// Keys of the blocks and pointers to children.
    Topology,
    /// Leaves and averaged nodes.
    Payload,
    /// Which object fills a leaf most.
    ObjectNumbers,
    /// Forward neighbour pointers, once a block (section 4.4).
    BlockLinks,
    /// The same once a node, as in the paper.
    NodeLinks,
    /// What leaves emit.
    Emission,
    ShadowMaps,
    /// Direct irradiance, sky, bounces, and the averaged radiance that samplers read.
    Light,
    /// Averaged irradiance, for the view of it.
    Irradiance,
    /// What the camera sees: places and materials.
    SurfaceImage,
    /// What lights send to it without a detour, and what it emits.
    DirectLight,
    /// What diffuse cones bring (section 4.5).
    DiffuseLight,
    /// Where a specular cone is called for.
    GlossyTiles,
    SpecularLight,
    /// What is shown of all that, in linear light.
    ComposedLight,
    /// What it is multiplied by.
    Exposure,
    /// The exact voxels of the pose.
    ExactBits,
    /// The masks above them.
    ExactMasks,
    Picture,
    /// Holes and spill beside the exact voxels.
    Comparison,
}

impl Part {
    /// Every part, in flow order: each is made from parts before it.
    pub const ALL: [Self; 29] = [
        Self::Caches,
        Self::Pages,
        Self::RigidVoxels,
        Self::SkinnedVoxels,
        Self::Materials,
        Self::Columns,
        Self::PosedVoxels,
        Self::JoinedVoxels,
        Self::Masks,
        Self::Topology,
        Self::Payload,
        Self::ObjectNumbers,
        Self::BlockLinks,
        Self::NodeLinks,
        Self::Emission,
        Self::ShadowMaps,
        Self::Light,
        Self::Irradiance,
        Self::SurfaceImage,
        Self::DirectLight,
        Self::DiffuseLight,
        Self::GlossyTiles,
        Self::SpecularLight,
        Self::ComposedLight,
        Self::Exposure,
        Self::ExactBits,
        Self::ExactMasks,
        Self::Picture,
        Self::Comparison,
    ];
    /// World voxels, by either discretizer.
    pub const DISCRETIZED: [Self; 5] =
        [Self::RigidVoxels, Self::SkinnedVoxels, Self::Columns, Self::PosedVoxels, Self::JoinedVoxels];
    /// The octree behind them.
    pub const BUILT: [Self; 3] = [Self::Masks, Self::Topology, Self::Payload];
    /// Made of what the camera sees: other ones for another camera, and dearer the more pixels there are.
    pub const SEEN: [Self; 8] = [
        Self::SurfaceImage,
        Self::DirectLight,
        Self::DiffuseLight,
        Self::GlossyTiles,
        Self::SpecularLight,
        Self::ComposedLight,
        Self::Exposure,
        Self::Picture,
    ];

    /// What a plan says where it is kept.
    pub(super) fn unchanged(self) -> &'static str {
        match self {
            Self::Caches => "caches unchanged",
            Self::Pages => "same objects in the grid",
            Self::RigidVoxels => "no rigid object moved",
            Self::SkinnedVoxels => "pose unchanged",
            Self::Materials => "materials unchanged",
            Self::Columns | Self::PosedVoxels => "no triangle moved",
            Self::JoinedVoxels | Self::Masks | Self::Topology | Self::Payload => "voxels unchanged",
            Self::ObjectNumbers => "voxels unchanged",
            Self::BlockLinks | Self::NodeLinks | Self::Emission => "voxels unchanged",
            Self::ShadowMaps => "lights and objects unmoved",
            Self::Light => "lighting unchanged",
            Self::Irradiance => "light unchanged",
            Self::SurfaceImage => "camera and objects unmoved",
            Self::DirectLight => "lights and surfaces unchanged",
            Self::DiffuseLight | Self::GlossyTiles | Self::SpecularLight => "light and surfaces unchanged",
            Self::ExactBits | Self::ExactMasks => "exact voxels unchanged",
            Self::Comparison => "both sets unchanged",
            Self::ComposedLight | Self::Exposure | Self::Picture => "nothing changed",
        }
    }
}
