// Which invocation this is: of its workgroup, and of a dispatch along x.
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

#endif
