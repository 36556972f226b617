// Values of all real spherical harmonics of bands 0 to 4 at one direction: full layout, internal convention (server/math/sh_convention.h:
// cos m phi at -m, (-1)^m sin m phi at m). Twin: server/reference/sh_function.
#ifndef RADIATA_COMMON_SH_VALUES
#define RADIATA_COMMON_SH_VALUES

// \param d  unit; \param order  bands, 1 to 5; \param y  the first order^2 are set
void shValues(vec3 d, uint order, out float y[25]) {
    y[0] = 0.282094792;
    if (order < 2u) return;
    const float z2 = d.z * d.z;
    y[1] = 0.488602512 * d.x;
    y[2] = 0.488602512 * d.z;
    y[3] = -0.488602512 * d.y;
    if (order < 3u) return;
    const float c2 = d.x * d.x - d.y * d.y, s2 = 2.0 * d.x * d.y;
    y[4] = 0.546274215 * c2;
    y[5] = 1.092548431 * d.x * d.z;
    y[6] = 0.315391565 * (3.0 * z2 - 1.0);
    y[7] = -1.092548431 * d.y * d.z;
    y[8] = 0.546274215 * s2;
    if (order < 4u) return;
    const float c3 = d.x * c2 - d.y * s2, s3 = d.y * c2 + d.x * s2;
    y[9] = 0.590043590 * c3;
    y[10] = 1.445305721 * d.z * c2;
    y[11] = 0.457045799 * d.x * (5.0 * z2 - 1.0);
    y[12] = 0.373176333 * d.z * (5.0 * z2 - 3.0);
    y[13] = -0.457045799 * d.y * (5.0 * z2 - 1.0);
    y[14] = 1.445305721 * d.z * s2;
    y[15] = -0.590043590 * s3;
    if (order < 5u) return;
    y[16] = 0.625835735 * (d.x * c3 - d.y * s3);
    y[17] = 1.770130769 * d.z * c3;
    y[18] = 0.473087348 * (7.0 * z2 - 1.0) * c2;
    y[19] = 0.669046544 * d.z * (7.0 * z2 - 3.0) * d.x;
    y[20] = 0.105785547 * ((35.0 * z2 - 30.0) * z2 + 3.0);
    y[21] = -0.669046544 * d.z * (7.0 * z2 - 3.0) * d.y;
    y[22] = 0.473087348 * (7.0 * z2 - 1.0) * s2;
    y[23] = -1.770130769 * d.z * s3;
    y[24] = 0.625835735 * (d.y * c3 + d.x * s3);
}

#endif
