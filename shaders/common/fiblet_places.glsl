// Finding the fiblets of a tractogram beyond the memory budget, of which some pages and a subset of fibres are on the device
// (server/render/fiblet/fiblet_residency.h).
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PlaceBuffer {
    FibletPlaces head;
    FibletPlace at[];
};

// \param lane  of the page's fiblets
bool fibletHeld(FibletPlace place, uint lane) {
    return ((lane < 32u ? place.held_low >> lane : place.held_high >> (lane - 32u)) & 1u) != 0u;
}

// Of its head and box.
uint fibletHeldAt(FibletPlace place, uint lane) {
    const uint low = lane < 32u ? place.held_low & ((1u << lane) - 1u) : place.held_low;
    const uint high = lane < 32u ? 0u : place.held_high & ((1u << (lane - 32u)) - 1u);
    return place.first_head + uint(bitCount(low) + bitCount(high));
}
