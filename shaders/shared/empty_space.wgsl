// Empty space, found in the masks above the leaves. A kernel says `node_occupied(level, key)`.

// Level of the largest empty node around the cell `key` of `level`; one more than `level` where the
// cell itself is occupied. `hint` is where to begin; neighbours mostly have the same answer.
fn empty_level(level: u32, key: u32, hint: u32) -> u32 {
    var l = min(hint, level);
    if node_occupied(l, key >> (3u * (level - l))) {
        while l < level {
            l += 1u;
            if !node_occupied(l, key >> (3u * (level - l))) {
                return l;
            }
        }
        return level + 1u;
    }
    while l > 0u && !node_occupied(l - 1u, key >> (3u * (level - l + 1u))) {
        l -= 1u;
    }
    return l;
}
