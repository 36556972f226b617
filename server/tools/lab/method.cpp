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
                quality.polynomial_bracket_stop = bracket_stop;
            }};
}

}  // namespace

std::vector<Method> glyphMethods(ShLayout layout) {
    std::vector<Method> methods = {march("march", model::PoleTable::kOff), march("march, pole table", model::PoleTable::kOn)};
    if (!layout.full && layout.lmax <= 12) {
        methods.push_back(polynomial("polynomial, bracket stop", true));
        methods.push_back(polynomial("polynomial, paper's stop", false));
    }
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
