// Uncertainty of a glyph layer.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {

model::Uncertainty fromProto(const v1::Uncertainty& uncertainty, const std::string& where) {
    checkEnum(uncertainty.kind(), v1::Uncertainty::Kind_IsValid, v1::Uncertainty::Kind_MAX, where + ".kind");
    model::Uncertainty result;
    result.dataset_id = uncertainty.dataset_id();
    const bool deviations = uncertainty.kind() == v1::Uncertainty::KIND_DEVIATIONS;
    if (deviations) result.kind = model::UncertaintyKind::kDeviations;
    if (uncertainty.has_deviations()) {
        if (!deviations) refuse(where + ".deviations is set, but its kind is not deviations");
        result.deviations = uncertainty.deviations();
    }
    if (uncertainty.has_extinction_per_mm()) result.extinction_per_mm = uncertainty.extinction_per_mm();
    if (uncertainty.has_emission()) {
        const v1::Vec3& emission = uncertainty.emission();
        result.emission = glm::vec3(glm::dvec3(emission.x(), emission.y(), emission.z()));
    }
    return result;
}

v1::Uncertainty toProto(const model::Uncertainty& uncertainty) {
    v1::Uncertainty message;
    message.set_dataset_id(uncertainty.dataset_id);
    if (uncertainty.kind == model::UncertaintyKind::kDeviations) {
        message.set_kind(v1::Uncertainty::KIND_DEVIATIONS);
        message.set_deviations(uncertainty.deviations);
    } else {
        message.set_kind(v1::Uncertainty::KIND_GLYPHS);
    }
    if (uncertainty.extinction_per_mm) message.set_extinction_per_mm(*uncertainty.extinction_per_mm);
    *message.mutable_emission() = toProto(glm::dvec3(uncertainty.emission));
    return message;
}

}  // namespace radiata::service
