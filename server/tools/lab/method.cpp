#include "tools/lab/method.h"

#include "base/error.h"

namespace radiata::lab {
namespace {

Method march(const std::string& name, model::PoleTable table) {
    return {name, "march", [table](model::Quality& quality) {
                quality.intersection = model::Intersection::kMarch;
                quality.pole_table = table;
            }};
}

Method polynomial(const std::string& name, bool bracket_stop) {
    return {name, "polynomial", [bracket_stop](model::Quality& quality) {
                quality.intersection = model::Intersection::kPolynomial;
                quality.pole_table = model::PoleTable::kOff;
                quality.polynomial.bracket_stop = bracket_stop;
            }};
}

/// Of k = 4 only.
Method byName(model::Intersection intersection) {
    const std::string name(model::methodName(intersection));
    return {name, name, [intersection](model::Quality& quality) { quality.intersection = intersection; }};
}

/// The march again, once per fragment of drawn boxes.
Method rasterBoxes(const std::string& name, model::PoleTable table) {
    return {name, "raster boxes", [table](model::Quality& quality) {
                quality.intersection = model::Intersection::kMarch;
                quality.traversal = model::Traversal::kRasterBoxes;
                quality.pole_table = table;
            }};
}

Method tessellated(const std::string& name, model::SphereMesh mesh, int level) {
    return {name, "tessellated", [mesh, level](model::Quality& quality) {
                quality.intersection = model::Intersection::kTessellated;
                quality.tessellation = {mesh, level, model::MeshNormals::kAnalytic};
            }};
}

/// What devices that draw triangles can do besides.
void addRasterMethods(std::vector<Method>& methods) {
    methods.push_back(rasterBoxes("raster boxes", model::PoleTable::kOff));
    methods.push_back(rasterBoxes("raster boxes, pole table", model::PoleTable::kOn));
    for (const int level : {2, 3, 4, 5, 6}) {
        const std::string name = "tessellated, icosphere " + std::to_string(level);
        methods.push_back(tessellated(name, model::SphereMesh::kIcosphere, level));
    }
    for (const int bands : {7, 10, 20}) {  // Hlawitschka et al. 2011, Table 2
        const std::string name = "tessellated, grid " + std::to_string(bands);
        methods.push_back(tessellated(name, model::SphereMesh::kLatitudeLongitude, bands));
    }
}

}  // namespace

Method rayMarch(model::Intersection intersection, int steps, bool per_ray) {
    const std::string family(model::methodName(intersection));
    const std::string name = family + ", " + std::to_string(steps) + " steps" + (per_ray ? ", rotated per ray" : "");
    return {name, family, [intersection, steps, per_ray](model::Quality& quality) {
                quality.intersection = intersection;
                quality.ray_march.steps = steps;
                quality.pole_table = per_ray ? model::PoleTable::kOff : model::PoleTable::kOn;
            }};
}

std::vector<Method> glyphMethods(ShLayout layout) {
    std::vector<Method> methods = {march("march", model::PoleTable::kOff), march("march, pole table", model::PoleTable::kOn)};
    if (!layout.full && layout.lmax <= 12) {
        methods.push_back(polynomial("polynomial, bracket stop", true));
        methods.push_back(polynomial("polynomial, paper's stop", false));
        if (layout.lmax <= 4) {
            methods.push_back(byName(model::Intersection::kPolynomialDouble));
            methods.push_back(byName(model::Intersection::kLaguerre));
        }
        for (const int steps : {100, 200}) {
            methods.push_back(rayMarch(model::Intersection::kRayMarchPeeters, steps, false));
            methods.push_back(rayMarch(model::Intersection::kRayMarchVanAlmsick, steps, false));
            methods.push_back(rayMarch(model::Intersection::kRayMarchVanAlmsick, steps, true));
        }
    }
    addRasterMethods(methods);
    return methods;
}

std::vector<Method> glyphMethods(ShLayout layout, const std::vector<std::string>& names) {
    const std::vector<Method> all = glyphMethods(layout);
    std::vector<Method> chosen;
    for (const std::string& name : names) {
        const std::size_t before = chosen.size();
        for (const Method& method : all) {
            if (method.name.starts_with(name)) chosen.push_back(method);
        }
        if (chosen.size() == before) throw Error(Code::kInternal, "no method is named '" + name + "'");
    }
    return chosen;
}

}  // namespace radiata::lab
