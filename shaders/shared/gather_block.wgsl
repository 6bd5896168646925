// What both gathering kernels write: the leaves of a block, and the node above them.
#import shared/block_sources.wgsl
#import shared/leaf_sum.wgsl
#import shared/node.wgsl

// Leaves of the block and the node above them, resolved: each occupied leaf is written once.
struct BlockWriter {
    slot: u32,
    sum: NodeSum,
}

fn write_leaf(writer: BlockWriter, leaf: Leaf) -> BlockWriter {
    if leaf.occupancy == 0u {
        return writer;
    }
    leaves[3u * writer.slot] = leaf.occupancy;
    leaves[3u * writer.slot + 1u] = leaf.albedo;
    leaves[3u * writer.slot + 2u] = leaf.normal;
    let sum = add_child(writer.sum, leaf.occupancy, 0u, unpack_biased(leaf.albedo), unpack_biased(leaf.normal));
    return BlockWriter(writer.slot + 1u, sum);
}

fn begin_block(block: u32) -> BlockWriter {
    return BlockWriter(block_starts[2u * block + 1u], empty_sum());
}

fn finish_block(writer: BlockWriter, key: u32) {
    nodes[node_index(octree.depth - 1u, key)] = finish_node(writer.sum);
}
