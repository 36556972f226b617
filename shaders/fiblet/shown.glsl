// What the surface buffer keeps of a segment's directions. Included where kTubes, kSelectedOnly and kPaged are known.

// Of a fiblet that was drawn. Only a pick draws more than stays, and does not look at what depends on the fibre.
uint fibreOf(FibletLayerParams layer, uint fiblet) {
    uint at = fiblet;
    if (kPaged) {
        const FibletPlace place = PlaceBuffer(layer.places).at[fiblet / FIBLET_PAGE];
        if (!fibletHeld(place, fiblet % FIBLET_PAGE)) return 0u;
        at = fibletHeldAt(place, fiblet % FIBLET_PAGE);
    }
    return HeadBuffer(layer.heads).at[at].fibre;
}

// The normal of a tube, the tangent of a line. \param bits  as raster.comp packs them
vec3 shownDirection(FibletLayerParams layer, uint who, uint bits) {
    bool tube = kTubes;
    if (kTubes && kSelectedOnly) tube = fibreState(layer, fibreOf(layer, who >> FIBLET_SEGMENT_BITS)) == FIBRE_SELECTED;
    return tube ? tubeNormal(bits) : lineTangent(bits);
}
