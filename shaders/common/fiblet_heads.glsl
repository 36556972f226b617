// Heads of fiblets by address.
#ifndef RADIATA_COMMON_FIBLET_HEADS
#define RADIATA_COMMON_FIBLET_HEADS
#include "shaders/shared/fiblet.glsl"

layout(buffer_reference, scalar) readonly buffer HeadBuffer { FibletHead at[]; };

#endif
