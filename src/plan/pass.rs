//! The passes of a frame, and the kernels of each.

use serde::Serialize;

/// A pass, in the order of the frame. One row of the plan; one or more kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pass {
    UploadCaches,
    ObjectIo,
    TransformRigid,
    TransformSkinned,
    MarkLeaves,
    ReduceMasks,
    ScanBlocks,
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
    /// From pixels that share cones to every pixel.
    FilterDiffuse,
    /// Where a specular cone is called for.
    ListGlossyTiles,
    TraceSpecular,
    FilterSpecular,
    /// What is shown of it, as linear light.
    ComposeSurfaces,
    MeasureExposure,
    ShowSurfaces,
    MarchVoxels,
    MarchLight,
    SliceOctree,
    ShowShadowMap,
    DrawMesh,
    /// The masks above the exact leaves, by which rays skip empty space.
    ReduceExact,
    MarchGhost,
    /// The octree of the filter that is not shown, for the accuracy panel.
    BuildOther,
    CompareExact,
}

impl Pass {
    /// Every pass, in frame order.
    pub const ALL: [Self; 43] = [
        Self::UploadCaches,
        Self::ObjectIo,
        Self::TransformRigid,
        Self::TransformSkinned,
        Self::MarkLeaves,
        Self::ReduceMasks,
        Self::ScanBlocks,
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
        Self::FilterDiffuse,
        Self::ListGlossyTiles,
        Self::TraceSpecular,
        Self::FilterSpecular,
        Self::ComposeSurfaces,
        Self::MeasureExposure,
        Self::ShowSurfaces,
        Self::MarchVoxels,
        Self::MarchLight,
        Self::SliceOctree,
        Self::ShowShadowMap,
        Self::DrawMesh,
        Self::ReduceExact,
        Self::MarchGhost,
        Self::BuildOther,
        Self::CompareExact,
    ];

    /// The kernels a run of it dispatches; none for work of the CPU.
    pub fn kernels(self) -> &'static [&'static str] {
        match self {
            Self::UploadCaches | Self::ObjectIo => &[],
            Self::TransformRigid => &["transform/rigid"],
            Self::TransformSkinned => &["transform/skinned"],
            Self::MarkLeaves => &["build/mark"],
            Self::ReduceMasks | Self::ReduceExact => &["build/reduce"],
            Self::ScanBlocks => &["build/scan_sum", "build/scan_spread"],
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
            Self::BuildOther => &[
                "build/mark",
                "build/reduce",
                "build/scan_sum",
                "build/scan_spread",
                "build/emit",
                "fill/count",
                "fill/place",
                "fill/gather",
                "fill/gather_heavy",
                "averaging/average",
            ],
            Self::CompareExact => &["compare/compare_sets"],
            Self::DrawSurfaces => &["surface/draw"],
            Self::EmitSurfaces => &["surface/emission"],
            Self::LightSurfaces => &["surface/direct"],
            Self::LightByMarching => &["surface/direct_march"],
            Self::TraceDiffuse => &["cones/diffuse"],
            Self::FilterDiffuse | Self::FilterSpecular => &["cones/filter"],
            Self::ListGlossyTiles => &["cones/glossy_tiles"],
            Self::TraceSpecular => &["cones/specular"],
            Self::ComposeSurfaces => &["surface/compose"],
            Self::MeasureExposure => &["surface/sum_luminance"],
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
