// Colours of glyphs.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

template <typename Message>
void mapFromProto(const Message& message, model::GlyphColour& colour, const std::string& where) {
    colour.map = fromProto(message.map(), where + ".map");
    if (message.has_range()) colour.range = model::ColourRange{message.range().low(), message.range().high()};
}

template <typename Message>
void mapToProto(const model::GlyphColour& colour, Message& message) {
    message.set_map(toProto(colour.map));
    if (!colour.range) return;
    message.mutable_range()->set_low(colour.range->low);
    message.mutable_range()->set_high(colour.range->high);
}

}  // namespace

ColourMap fromProto(v1::ColourMap map, const std::string& where) {
    checkEnum(map, v1::ColourMap_IsValid, v1::ColourMap_MAX, where);
    switch (map) {
        case v1::COLOUR_MAP_INFERNO:
            return ColourMap::kInferno;
        case v1::COLOUR_MAP_CIVIDIS:
            return ColourMap::kCividis;
        case v1::COLOUR_MAP_BLACK_RED_YELLOW:
            return ColourMap::kBlackRedYellow;
        case v1::COLOUR_MAP_GREY:
            return ColourMap::kGrey;
        default:
            return ColourMap::kViridis;
    }
}

v1::ColourMap toProto(ColourMap map) {
    switch (map) {
        case ColourMap::kViridis:
            return v1::COLOUR_MAP_VIRIDIS;
        case ColourMap::kInferno:
            return v1::COLOUR_MAP_INFERNO;
        case ColourMap::kCividis:
            return v1::COLOUR_MAP_CIVIDIS;
        case ColourMap::kBlackRedYellow:
            return v1::COLOUR_MAP_BLACK_RED_YELLOW;
        case ColourMap::kGrey:
            return v1::COLOUR_MAP_GREY;
    }
    return v1::COLOUR_MAP_UNSPECIFIED;
}

model::GlyphColour fromProto(const v1::GlyphColour& colour, const std::string& where) {
    model::GlyphColour result;
    switch (colour.source_case()) {
        case v1::GlyphColour::kRadius:
            result.mode = model::ColourMode::kRadius;
            mapFromProto(colour.radius(), result, where + ".radius");
            break;
        case v1::GlyphColour::kScalar:
            result.mode = model::ColourMode::kScalar;
            result.image_id = colour.scalar().image_id();
            mapFromProto(colour.scalar(), result, where + ".scalar");
            break;
        case v1::GlyphColour::kUniform:
            result.mode = model::ColourMode::kUniform;
            result.uniform = glm::vec3(glm::dvec3(colour.uniform().x(), colour.uniform().y(), colour.uniform().z()));
            break;
        case v1::GlyphColour::kDirection:
        case v1::GlyphColour::SOURCE_NOT_SET:
            break;
    }
    return result;
}

v1::GlyphColour toProto(const model::GlyphColour& colour) {
    v1::GlyphColour message;
    switch (colour.mode) {
        case model::ColourMode::kDirection:
            message.mutable_direction();
            break;
        case model::ColourMode::kRadius:
            mapToProto(colour, *message.mutable_radius());
            break;
        case model::ColourMode::kScalar:
            message.mutable_scalar()->set_image_id(colour.image_id);
            mapToProto(colour, *message.mutable_scalar());
            break;
        case model::ColourMode::kUniform:
            *message.mutable_uniform() = toProto(glm::dvec3(colour.uniform));
            break;
    }
    return message;
}

}  // namespace radiata::service
