// Local reflection as volume renderers commonly have it: Lambert's cosine, Phong's highlight, and ambient light that varies with
// the normal, so that what the light does not reach still shows its shape. Twin: server/reference/phong.
// Sources: Phong 1975; Wyman et al. 2006, Sec. 5 ("a varying ambient component based on the surface normal").
#ifndef RADIATA_COMMON_PHONG
#define RADIATA_COMMON_PHONG

const float kPhongExponent = 30.0;
const float kPhongShare = 0.04;  // of the light goes into the highlight: the reflectance of a dielectric at normal incidence

// Radiance by an irradiance of 1 on a surface that faces the light. \param normal, viewer, light  unit, away from the surface
vec3 lambertReflection(vec3 base, vec3 normal, vec3 light) {
    return base * (0.318309886 * max(dot(normal, light), 0.0));
}
// The highlight's lobe (exponent + 1) / 2 pi cos^exponent adds up to 1 over its hemisphere.
vec3 phongReflection(vec3 base, vec3 normal, vec3 viewer, vec3 light) {
    if (dot(normal, light) <= 0.0) return vec3(0.0);
    const float mirrored = max(dot(2.0 * dot(normal, light) * normal - light, viewer), 0.0);
    const float lobe = (kPhongExponent + 1.0) * 0.159154943 * pow(mirrored, kPhongExponent);
    return lambertReflection(base, normal, light) + kPhongShare * lobe;
}

// Factor on the ambient light: 2 towards the light, 0 away from it, 1 in the mean over all normals.
float varyingAmbient(vec3 normal, vec3 light) { return 1.0 + dot(normal, light); }

#endif
