// Directions towards a distant spherical light, with a density proportional to the cosine at the surface: the spherical cap that the light
// covers, less what is below the horizon, projected orthogonally onto the tangent plane and sampled evenly there. So each ray stands for
// the same part of the irradiance, and nothing is noisy where the light stands half below the horizon.
// Source: Peters and Dachsbacher 2019, "Sampling Projected Spherical Caps in Real Time". The projection is an ellipse, or where the horizon
// cuts it the union of a cut ellipse and a cut disk, or (centre below the horizon) their difference.
// Note: the paper samples the difference approximately, with bounded deviation; here its marginal is inverted by safeguarded Newton steps
// until float32 knows no better, so the density is exact in all three cases. Twin: server/reference/projected_cap.
#ifndef RADIATA_COMMON_PROJECTED_CAP
#define RADIATA_COMMON_PROJECTED_CAP

struct ProjectedCap {
    vec3 x_axis, y_axis, normal;  // tangent towards the cap's centre, tangent across, surface normal
    float ct, st;        // cosine and sine of the angle between normal and centre
    float sa, ca;        // sine and cosine of the cap's angular radius
    float area;          // projected solid angle, 0 to pi sa^2; 0: below the horizon
    bool cut;            // the horizon cuts the cap
    float cut_sine;      // y where the cap's circle meets the horizon
    float disk_area;     // of the unit disk's part beyond that line
    float ellipse_area;  // of the ellipse on this side of it (centre below the horizon: beyond it), scaled to a unit disk
};

// Area of the unit disk's part with angles up to +-t, t in [0, pi]: t - sin t cos t, without cancellation for small sines.
float diskSegment(float cosine, float sine) {
    const float s2 = sine * sine;
    const float series = sine * s2 * (2.0 / 3.0 + s2 * (0.2 + s2 * (3.0 / 28.0 + s2 * (5.0 / 72.0 + s2 * (35.0 / 704.0)))));
    const float near = s2 < 0.25 ? series : atan(sine, abs(cosine)) - sine * abs(cosine);
    return cosine >= 0.0 ? near : 3.14159265 - near;
}

// \param light  unit, towards the cap's centre; \param normal  unit
// \param sine, cosine  of the cap's angular radius, which is above 0 and below pi / 2
ProjectedCap projectedCap(vec3 light, vec3 normal, float sine, float cosine) {
    ProjectedCap cap;
    cap.normal = normal;
    cap.ct = clamp(dot(light, normal), -1.0, 1.0);
    const vec3 tangent = light - cap.ct * normal;
    cap.st = length(tangent);
    const vec3 other = abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    cap.x_axis = cap.st > 1e-6 ? tangent / cap.st : normalize(cross(normal, other));
    cap.y_axis = cross(normal, cap.x_axis);
    cap.sa = sine;
    cap.ca = cosine;
    cap.cut = abs(cap.ct) < sine;
    cap.area = cap.ct > 0.0 ? 3.14159265 * sine * sine * cap.ct : 0.0;
    cap.cut_sine = cap.disk_area = cap.ellipse_area = 0.0;
    if (cap.cut) {
        cap.cut_sine = min(sqrt((sine - cap.ct) * (sine + cap.ct)) / cap.st, 1.0);
        cap.disk_area = diskSegment(cosine / cap.st, cap.cut_sine);
        cap.ellipse_area = diskSegment(-cosine * cap.ct / (cap.st * sine), min(cap.cut_sine / sine, 1.0));
        cap.area = max(cap.disk_area + sine * sine * cap.ct * cap.ellipse_area, 0.0);
    }
    return cap;
}

// (cos t, sin t), x = cos t having the share u of a segment of the unit disk beyond it. \param area  of it, as diskSegment gives it
vec2 segmentQuantile(float area, float u) {
    // Solves t - sin(2t) / 2 = a for the angle t = acos(x), in the smaller half. The series does for small angles, Newton for others.
    const float wanted = u * area;
    const bool upper = wanted > 1.57079633;
    const float a = upper ? 3.14159265 - wanted : wanted;
    const float s = pow(max(1.5 * a, 0.0), 1.0 / 3.0);
    float t = s + s * s * s * (1.0 / 15.0);
    for (int i = 0; i < 2; ++i) {
        const float sine = sin(t);
        t -= t > 0.3 ? (t - 0.5 * sin(2.0 * t) - a) / (2.0 * sine * sine) : 0.0;
    }
    return vec2(upper ? -cos(t) : cos(t), sin(t));
}

// Width of the lune between ellipse and unit circle at y.
float luneWidth(ProjectedCap cap, float y) {
    // circle - ca st + ct arc, with the first difference written so that small lights keep their digits.
    const float circle = sqrt(max(1.0 - y * y, 0.0)), arc2 = max((cap.sa - y) * (cap.sa + y), 0.0);
    return (arc2 + cap.ct * cap.ct * cap.ca * cap.ca) / (circle + cap.ca * cap.st) + cap.ct * sqrt(arc2);
}

// The y below which the lune has the share u of its area.
float luneQuantile(ProjectedCap cap, float u) {
    const float wanted = (u - 0.5) * cap.area;
    float low = -cap.cut_sine, high = cap.cut_sine, y = (2.0 * u - 1.0) * cap.cut_sine;
    for (int i = 0; i < 8; ++i) {
        const float v = min(abs(y) / cap.sa, 1.0), width = max(luneWidth(cap, y), 0.0);
        const float parts = diskSegment(sqrt(max(1.0 - y * y, 0.0)), abs(y)) +
                            cap.ct * cap.sa * cap.sa * diskSegment(sqrt((1.0 - v) * (1.0 + v)), v);
        const float below = y * width + 0.5 * (y < 0.0 ? -parts : parts);
        if (below < wanted) low = y; else high = y;
        const float next = y - (below - wanted) / max(width, 1e-12);
        y = next > low && next < high ? next : 0.5 * (low + high);
    }
    return y;
}

// The direction whose projection is the point q of the ellipse, scaled to a unit disk; q.x towards the cap's centre.
vec3 ellipseDirection(ProjectedCap cap, vec2 q) {
    const float x = cap.sa * cap.ct * q.x, y = cap.sa * q.y, middle = cap.ca * cap.st;
    const float up = cap.ct * cap.ct + cap.sa * cap.sa * cap.st * cap.st;  // 1 - middle^2
    return vec3(middle + x, y, sqrt(max(up - x * (2.0 * middle + x) - y * y, 0.0)));
}

// \param u  in [0, 1)^2; \return unit, above the horizon. Only for caps with an area.
vec3 projectedCapSample(ProjectedCap cap, vec2 u) {
    // Heights are not taken from 1 - x^2 - y^2, which has no digits left where a small light stands on the horizon.
    vec3 p;
    if (!cap.cut) {
        const float r = sqrt(u.x), turn = 6.28318531 * u.y;
        p = ellipseDirection(cap, r * vec2(cos(turn), sin(turn)));
    } else if (cap.ct >= 0.0) {
        const float share = min(cap.disk_area / cap.area, 1.0), v = 2.0 * u.y - 1.0;
        const bool disk = u.x < share;
        const float along = disk ? u.x / share : (u.x - share) / (1.0 - share);
        const vec2 x = segmentQuantile(disk ? cap.disk_area : cap.ellipse_area, along);
        if (disk) p = vec3(x.x, v * x.y, x.y * sqrt(max(1.0 - v * v, 0.0)));
        else p = ellipseDirection(cap, vec2(-x.x, v * x.y));
    } else {
        const float y = luneQuantile(cap, u.x);
        const float last = sqrt(max(1.0 - y * y, 0.0)), inwards = u.y * max(luneWidth(cap, y), 0.0);
        p = vec3(last - inwards, y, sqrt(max(inwards * (2.0 * last - inwards), 0.0)));
    }
    return normalize(p.x * cap.x_axis + p.y * cap.y_axis + p.z * cap.normal);
}

#endif
