// Which invocation this is: of its workgroup, of a dispatch along x, and of blocks of pixels.
// They number like gl_LocalInvocationIndex and gl_GlobalInvocationID.x, up to the order within a workgroup. Mesa's CPU driver makes the
// latter with integer divisions for each lane, which take as long as the rest of a small shader; subgroup numbers come for nothing.
// Declares the workgroup: one-dimensional, its size constant 0.
#ifndef RADIATA_COMMON_INVOCATION
#define RADIATA_COMMON_INVOCATION
#extension GL_KHR_shader_subgroup_basic : require

layout(local_size_x_id = 0) in;
// Set by gpu/pipeline where the pipeline's subgroups are known to be full; without it their numbers would leave gaps.
layout(constant_id = 63) const bool kFullSubgroups = false;

uint localInvocation() {
    return kFullSubgroups ? gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID : gl_LocalInvocationIndex;
}
uint globalInvocation() { return gl_WorkGroupID.x * gl_WorkGroupSize.x + localInvocation(); }

// Workgroups of 64 cover blocks of 8x8 pixels, laid out so that any subgroup of 8, 16, 32 or 64 covers a compact part of one.
// Dispatched as (columns of blocks, rows / z, z): a CPU driver gives each thread one run of workgroups, x fastest, and a run of
// neighbouring rows would be all sky for one thread and all surface for another. So each gets every z-th row, for some of the z.
// \param first_block_row  of the dispatch
uvec2 pixelOfInvocation(uint first_block_row) {
    const uint i = localInvocation();
    const uvec2 inside = uvec2((i & 3u) | ((i >> 1u) & 4u), ((i >> 2u) & 1u) | ((i >> 3u) & 6u));
    const uint row = gl_WorkGroupID.y * gl_NumWorkGroups.z + gl_WorkGroupID.z;
    return uvec2(gl_WorkGroupID.x, row + first_block_row) * 8u + inside;
}

#endif
