//! The passes of a frame, and the kernels of each.

use serde::Serialize;

use super::Part;

/// A pass, in the order of the frame. One row of the plan; one or more kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pass {
    UploadCaches,
    ObjectIo,
    TransformRigid,
    TransformSkinned,
    /// Textures as the voxelizer of posed triangles reads them.
    UploadMaterials,
    /// Of every posed triangle.
    CountColumns,
    /// Before the voxelizer fills them.
    ClearCells,
    VoxelizeTriangles,
    /// To one voxel of an object in a cell.
    MergeFragments,
    /// Moved voxels and those of voxelized objects, in one list.
    JoinVoxels,
    MarkLeaves,
    ReduceMasks,
    ScanBlocks,
    /// How many blocks, nodes and leaves there are: everything behind ends there.
    CountNodes,
    EmitNodes,
    SortVoxels,
    GatherNearest,
    GatherSplit,
    AverageNodes,
    NumberObjects,
    /// Forward neighbour pointers (section 4.4).
    LinkNodes,
    GatherEmission,
    DrawShadows,
    /// Direct irradiance of every leaf, a light at a time.
    Illuminate,
    GatherSky,
    /// What leaves each leaf.
    InjectLight,
    AverageLight,
    /// Each gathers at the leaves, injects and averages.
    Bounces,
    /// Irradiance of every node, for the view of it.
    AverageIrradiance,
    /// What the camera sees: places and materials.
    DrawSurfaces,
    /// Direct light on it begins with what it emits.
    EmitSurfaces,
    /// A light at a time, shadows by maps or not at all.
    LightSurfaces,
    /// The same, shadows marched through the octree.
    LightByMarching,
    TraceDiffuse,
    /// Pixels share cones with those around them on the same surface.
    BlurDiffuse,
    /// From fewer pixels to those of the picture.
    UpsampleDiffuse,
    /// Where a specular cone is called for.
    ListGlossyTiles,
    TraceSpecular,
    UpsampleSpecular,
    /// What is shown of it, as linear light.
    ComposeSurfaces,
    MeasureExposure,
    /// The exact voxels of the pose.
    UploadExact,
    /// The masks above the exact leaves, by which rays skip empty space.
    ReduceExact,
    ShowSurfaces,
    MarchVoxels,
    MarchLight,
    SliceOctree,
    ShowShadowMap,
    DrawMesh,
    MarchGhost,
    CompareExact,
}

impl Pass {
    /// Every pass, in frame order.
    pub const ALL: [Self; 51] = [
        Self::UploadCaches,
        Self::ObjectIo,
        Self::TransformRigid,
        Self::TransformSkinned,
        Self::UploadMaterials,
        Self::CountColumns,
        Self::ClearCells,
        Self::VoxelizeTriangles,
        Self::MergeFragments,
        Self::JoinVoxels,
        Self::MarkLeaves,
        Self::ReduceMasks,
        Self::ScanBlocks,
        Self::CountNodes,
        Self::EmitNodes,
        Self::SortVoxels,
        Self::GatherNearest,
        Self::GatherSplit,
        Self::AverageNodes,
        Self::NumberObjects,
        Self::LinkNodes,
        Self::GatherEmission,
        Self::DrawShadows,
        Self::Illuminate,
        Self::GatherSky,
        Self::InjectLight,
        Self::AverageLight,
        Self::Bounces,
        Self::AverageIrradiance,
        Self::DrawSurfaces,
        Self::EmitSurfaces,
        Self::LightSurfaces,
        Self::LightByMarching,
        Self::TraceDiffuse,
        Self::BlurDiffuse,
        Self::UpsampleDiffuse,
        Self::ListGlossyTiles,
        Self::TraceSpecular,
        Self::UpsampleSpecular,
        Self::ComposeSurfaces,
        Self::MeasureExposure,
        Self::UploadExact,
        Self::ReduceExact,
        Self::ShowSurfaces,
        Self::MarchVoxels,
        Self::MarchLight,
        Self::SliceOctree,
        Self::ShowShadowMap,
        Self::DrawMesh,
        Self::MarchGhost,
        Self::CompareExact,
    ];

    /// The parts that it makes, or helps to make.
    pub fn parts(self) -> &'static [Part] {
        match self {
            Self::UploadCaches => &[Part::Caches],
            Self::ObjectIo => &[Part::Pages],
            Self::TransformRigid => &[Part::RigidVoxels],
            Self::TransformSkinned => &[Part::SkinnedVoxels],
            Self::UploadMaterials => &[Part::Materials],
            Self::CountColumns => &[Part::Columns],
            Self::ClearCells | Self::VoxelizeTriangles | Self::MergeFragments => &[Part::PosedVoxels],
            Self::JoinVoxels => &[Part::JoinedVoxels],
            Self::MarkLeaves | Self::ReduceMasks | Self::ScanBlocks | Self::CountNodes => &[Part::Masks],
            Self::EmitNodes => &[Part::Topology],
            Self::SortVoxels | Self::GatherNearest | Self::GatherSplit | Self::AverageNodes => &[Part::Payload],
            Self::NumberObjects => &[Part::ObjectNumbers],
            Self::LinkNodes => &[Part::BlockLinks, Part::NodeLinks],
            Self::GatherEmission => &[Part::Emission],
            Self::DrawShadows => &[Part::ShadowMaps],
            Self::Illuminate | Self::GatherSky | Self::InjectLight | Self::AverageLight => &[Part::Light],
            Self::Bounces => &[Part::Light],
            Self::AverageIrradiance => &[Part::Irradiance],
            Self::DrawSurfaces => &[Part::SurfaceImage],
            Self::EmitSurfaces | Self::LightSurfaces | Self::LightByMarching => &[Part::DirectLight],
            Self::TraceDiffuse | Self::BlurDiffuse | Self::UpsampleDiffuse => &[Part::DiffuseLight],
            Self::ListGlossyTiles => &[Part::GlossyTiles],
            Self::TraceSpecular | Self::UpsampleSpecular => &[Part::SpecularLight],
            Self::ComposeSurfaces => &[Part::ComposedLight],
            Self::MeasureExposure => &[Part::Exposure],
            Self::UploadExact => &[Part::ExactBits],
            Self::ReduceExact => &[Part::ExactMasks],
            Self::ShowSurfaces | Self::MarchVoxels | Self::MarchLight | Self::SliceOctree => &[Part::Picture],
            Self::ShowShadowMap | Self::DrawMesh | Self::MarchGhost => &[Part::Picture],
            Self::CompareExact => &[Part::Comparison],
        }
    }

    /// The kernels a run of it dispatches; none for work of the CPU.
    pub fn kernels(self) -> &'static [&'static str] {
        match self {
            Self::UploadCaches | Self::ObjectIo | Self::UploadMaterials => &[],
            Self::ClearCells | Self::JoinVoxels | Self::UploadExact => &[],
            Self::TransformRigid => &["transform/rigid"],
            Self::TransformSkinned => &["transform/skinned"],
            Self::CountColumns => &["voxelize/count", "build/scan_sum", "build/scan_spread"],
            Self::VoxelizeTriangles => &["voxelize/cover", "voxelize/shade"],
            Self::MergeFragments => &["voxelize/merge"],
            Self::MarkLeaves => &["build/mark"],
            Self::ReduceMasks | Self::ReduceExact => &["build/reduce"],
            Self::ScanBlocks => &["build/scan_sum", "build/scan_spread"],
            Self::CountNodes => &["build/size"],
            Self::EmitNodes => &["build/emit"],
            Self::SortVoxels => &["fill/count", "build/scan_sum", "build/scan_spread", "fill/place"],
            Self::GatherNearest | Self::GatherSplit => &["fill/gather", "fill/gather_heavy"],
            Self::AverageNodes => &["averaging/average"],
            Self::NumberObjects => &["fill/number_objects"],
            Self::LinkNodes => &["build/link"],
            Self::GatherEmission => &["fill/place_emission", "fill/gather_emission"],
            Self::DrawShadows => &["light/shadow"],
            Self::Illuminate => &["light/illuminate"],
            Self::GatherSky => &["light/inject", "light/average_light", "light/gather"],
            Self::InjectLight => &["light/inject"],
            Self::AverageLight => &["light/average_light"],
            Self::Bounces => &["light/gather", "light/inject", "light/average_light"],
            Self::AverageIrradiance => &["light/inject", "light/average_light"],
            Self::CompareExact => &["compare/compare_sets"],
            Self::DrawSurfaces => &["surface/draw"],
            Self::EmitSurfaces => &["surface/emission"],
            Self::LightSurfaces => &["surface/direct"],
            Self::LightByMarching => &["surface/direct_march"],
            Self::TraceDiffuse => &["cones/diffuse"],
            Self::BlurDiffuse => &["cones/blur"],
            Self::UpsampleDiffuse | Self::UpsampleSpecular => &["cones/upsample"],
            Self::ListGlossyTiles => &["cones/glossy_tiles", "build/scan_sum", "build/scan_spread", "cones/list_tiles"],
            Self::TraceSpecular => &["cones/specular"],
            Self::ComposeSurfaces => &["surface/compose"],
            Self::MeasureExposure => &["surface/count_luminance", "surface/expose"],
            Self::ShowSurfaces => &["view/show_surfaces"],
            Self::MarchVoxels => &["view/march"],
            Self::MarchLight => &["view/march_light"],
            Self::SliceOctree => &["view/slice"],
            Self::ShowShadowMap => &["view/show_shadow"],
            Self::DrawMesh => &["view/mesh"],
            Self::MarchGhost => &["view/ghost"],
        }
    }
}
