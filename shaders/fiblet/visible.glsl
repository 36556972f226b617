// Whether something in a box can be seen: inside of the picture and, if the depths drawn so far are looked at, not behind all of them
// where it stands. Only what lies strictly behind every pixel it can touch is told hidden. To be included after layer.glsl.

bool fibletHidden(FibletLayerParams layer, FibletFootprint footprint) {
    const uint nearest = orderOfDepth(footprint.nearest);
    const ivec2 extent = footprint.pixels.zw - footprint.pixels.xy;
    // The finest level on which at most five by five entries stand above the footprint.
    const int level = min(max(findMSB(max(extent.x, extent.y)) - 1, 0), int(layer.pyramid_levels));
    ivec2 size = ivec2(layer.view.width, layer.view.height);
    uint offset = 0u;
    for (int i = 1; i <= level; ++i) {
        if (i > 1) offset += uint(size.x * size.y);
        size = (size + 1) / 2;
    }
    const ivec4 entries = footprint.pixels >> level;
    for (int y = entries.y; y <= entries.w; ++y) {
        for (int x = entries.x; x <= entries.z; ++x) {
            const uint at = uint(y * size.x + x);
            const uint farthest = level == 0 ? uint(WordBuffer(layer.words).at[at] >> 32) : UintBuffer(layer.pyramid).at[offset + at];
            if (nearest <= farthest) return false;
        }
    }
    return true;
}

// \param margin  pixels beside a line \param grown  mm beside it \param against_depths  what lies behind them is not seen either
bool fibletVisible(FibletLayerParams layer, vec3 low, vec3 high, float margin, float grown, bool against_depths) {
    const FibletFootprint footprint = fibletFootprint(layer.view, low, high, margin, grown);
    return footprint.seen && !(against_depths && fibletHidden(layer, footprint));
}
