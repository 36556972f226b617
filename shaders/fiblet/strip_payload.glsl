// What a task shader hands to the mesh shaders that it starts: the fiblets of a page that are drawn.
struct FibletPayload {
    uint fiblet[FIBLET_PAGE];
};
taskPayloadSharedEXT FibletPayload payload;
