// What a task shader hands to the mesh shaders that it starts: the fiblets of a page that are drawn. Each of the first `decoded` has a
// mesh shader; the `whole` from the end on are one line each, many to a mesh shader.
struct FibletPayload {
    uint fiblet[FIBLET_PAGE];
    uint decoded;
    uint whole;
};
taskPayloadSharedEXT FibletPayload payload;

const uint kWholeLines = 32u;  // of a mesh shader, two vertices for each
