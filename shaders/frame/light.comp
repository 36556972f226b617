// Deferred lighting of the surface buffer: one sample's light is added to the picture's sum, or is the picture where there is one
// sample. One invocation per pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/pixel_place.glsl"
#include "shaders/common/invocation.glsl"
#include "shaders/shared/frame.glsl"
#include "shaders/shared/glyph.glsl"
#include "shaders/shared/uncertainty.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/common/base_colour.glsl"
#include "shaders/common/fibre_colour.glsl"
#include "shaders/common/light_visibility.glsl"
#include "shaders/common/medium.glsl"

layout(constant_id = 1) const bool kFirstSample = true;
layout(constant_id = 4) const uint kLayerKinds = 1u;   // the code of other kinds is not compiled
layout(constant_id = 6) const bool kVeil = false;       // transparent layers stand before everything
layout(constant_id = 9) const bool kGlobalLight = false;  // isosurfaces are lit by texels
layout(constant_id = 11) const bool kPeel = false;  // the surface is what was found nearest of transparent layers, for the veil
layout(constant_id = 12) const bool kTail = false;  // and stands for all that is behind it, which was counted
layout(constant_id = 13) const bool kPicture = false;   // the only sample: 8-bit sRGB is written at once, and no sum
layout(constant_id = 14) const bool kOneLayer = false;  // of the scene
layout(constant_id = 3) const bool kMedia = false;  // some layer shows its uncertainty
layout(constant_id = 10) const uint kSurfaceLooks = 0u;   // what no isosurface has is not compiled
#include "shaders/common/surface_shading.glsl"

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer InstanceBuffer { GlyphInstance at[]; };
layout(buffer_reference, scalar) readonly buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) buffer LightBuffer { vec3 at[]; };
layout(buffer_reference, scalar) writeonly buffer PictureBuffer { uint rgba[]; };
#include "shaders/frame/fibre_depth.glsl"

layout(buffer_reference, scalar) readonly buffer MediumBuffer { Medium at[]; };
layout(buffer_reference, scalar) buffer VeilBuffer { vec4 at[]; };  // radiance, transmittance
layout(buffer_reference, scalar) readonly buffer GlobalLightBuffer { vec3 at[]; };  // of a white surface; below 0: not known
layout(buffer_reference, scalar) readonly buffer LookBuffer { LayerLook at[]; };

#include "shaders/frame/peel.glsl"

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    SurfaceBuffer surface;
    LightBuffer light;  // not touched with kPicture
    LookBuffer looks;
    BitBuffer shadow_bits;     // blocked rays of each pixel; not read where the scene has no such rays
    BitBuffer occlusion_bits;
    MediumBuffer media;  // not read without kMedia
    VeilBuffer veil;     // not read without kVeil
    GlobalLightBuffer global_light;  // not read without kGlobalLight
    SurfaceLookBuffer surface_looks;  // not read without kSurfaceLooks
    PeelBuffer peel;                 // not read without kPeel
    PictureBuffer picture;           // not written without kPicture
} push;

bool isKind(LayerLook look, uint kind) { return (kLayerKinds & (1u << kind)) != 0u && look.kind == kind; }

vec3 glyphColour(FrameParams frame, LayerLook look, uint who, PixelRay ray, float depth) {
    const GlyphInstance instance = InstanceBuffer(look.instances).at[who];
    const vec3 centre = (instance.centre_high - frame.rays.reference_high) + (instance.centre_low - frame.rays.reference_low);
    return baseColour(look, who, ray.origin - centre + depth * ray.direction);
}

// Radiance of an isosurface, towards the viewer; negative: lit as everything else is. \param base  its colour, which is set here
vec3 surfaceRadiance(FrameParams frame, Surface surface, LayerLook look, PixelRay ray, uint at, inout vec3 base) {
    if (kSurfaceLooks != 0u) {
        const SurfaceLook own = push.surface_looks.at[surface.layer_and_steps >> 24u];
        base = surfaceColour(own, look, ray.origin + surface.depth * ray.direction);
        if (shadesItself(own)) {
            return shadeItself(frame, own, base, surface.normal, -ray.direction, litShare(push.shadow_bits, at),
                               openShare(push.occlusion_bits, at));
        }
    }
    if (!kGlobalLight || push.global_light.at[at].x < 0.0) return vec3(-1.0);
    return base * push.global_light.at[at];
}

void main() {
    // What all invocations read alike is one read on a CPU driver where all are active, and one for each behind a branch; so it comes
    // first, and the invocations past the last pixel go along.
    const FrameParams frame = push.frame.frame;
    const uint pixels = frame.width * frame.height, at = min(globalInvocation(), pixels - 1u);
    LayerLook look;
    if (kOneLayer) look = push.looks.at[0];
    const Surface surface = push.surface.at[at];
    if (globalInvocation() >= pixels) return;
    if (kPeel && kFirstSample) {
        push.veil.at[at] = vec4(0.0, 0.0, 0.0, 1.0);
        beginPeels(push.peel, at);
    }
    if (kPeel && surface.who == 0xffffffffu) return;
    vec3 radiance = frame.background;
    if (surface.who != 0xffffffffu) {
        const vec2 point = vec2(pixelPlace(at, frame.width)) + 0.5 + frame.jitter;
        const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), point);
        if (!kOneLayer) look = push.looks.at[surface.layer_and_steps >> 24u];
        vec3 base = vec3(0.5);
        if (isKind(look, LAYER_GLYPHS)) base = glyphColour(frame, look, surface.who, ray, surface.depth);
        if (isKind(look, LAYER_SURFACE)) base = baseColour(look, surface.who, vec3(1.0));
        bool line = false;
        float dimmed = 1.0;
        if (isKind(look, LAYER_TRACTS)) {
            base = fibreColour(look, surface.layer_and_steps >> 24u, surface.who, ray.origin + surface.depth * ray.direction, surface.normal, at, line, dimmed);
        }
        vec3 lit = vec3(-1.0);
        if ((kGlobalLight || kSurfaceLooks != 0u) && isKind(look, LAYER_SURFACE)) {
            lit = surfaceRadiance(frame, surface, look, ray, at, base);
        }
        if (lit.x < 0.0) {
            if (line) lit = shadeLine(frame, push.shadow_bits, push.occlusion_bits, at, base, 0.45, surface.normal, -ray.direction);
            else lit = shadeVisible(frame, push.shadow_bits, push.occlusion_bits, at, base, 0.45, surface.normal, -ray.direction);
        }
        if (kSurfaceLooks != 0u && isKind(look, LAYER_SURFACE)) {
            const SurfaceLook own = push.surface_looks.at[surface.layer_and_steps >> 24u];
            lit = mix(lit, frame.background, surfaceFog(frame, own, ray, surface.depth));
        }
        if ((kFibreOcclusion || kFibreHalos) && isKind(look, LAYER_TRACTS)) {
            const float size_mm = pixelSize(frame, ray.direction, surface.depth);
            if (kFibreOcclusion && look.occlusion_px > 0.0) {
                dimmed *= openness(push.surface, frame, look.occlusion_px, at, surface.depth, size_mm);
            }
            if (kFibreHalos && look.halo_px > 0.0 && inHalo(push.surface, frame, look.halo_px, at, surface.depth, size_mm)) {
                dimmed = 0.0;
            }
        }
        if (kPeel) {
            const bool counts = takePeel(push.peel, at, surface, line);
            const vec3 shown = min(dimmed * lit, vec3(1.0));
            push.veil.at[at] = peeled(push.peel, push.looks, push.veil.at[at], at, shown, look.opacity, counts, kTail);
            return;
        }
        // Transparent fibres are part of the veil; glyphs are, unless they are all there is.
        radiance = isKind(look, LAYER_TRACTS) ? dimmed * lit : mix(radiance, dimmed * lit, look.opacity);
    }
    if (kMedia) {
        const Medium medium = push.media.at[at];
        radiance = throughMedium(radiance, medium.weighted_emission, medium.optical_depth);
    }
    if (kVeil) {
        const vec4 veil = push.veil.at[at];
        radiance = veil.rgb + veil.a * radiance;
    }
    // Samples are averaged as they are shown, so bright highlights do not leave jagged edges.
    radiance = min(radiance, vec3(1.0));
    if (kPicture) push.picture.rgba[at] = packedColour(srgbFromLinear(radiance));
    else push.light.at[at] = kFirstSample ? radiance : push.light.at[at] + radiance;
}
