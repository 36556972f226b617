// Scenes: layers, light, background, annotations.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

glm::dvec3 vectorOf(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

void fromSlice(const v1::Slice& slice, model::VoxelSelection& selection, const std::string& where) {
    checkEnum(slice.plane(), v1::Plane_IsValid, v1::Plane_MAX, where + ".plane");
    switch (slice.plane()) {
        case v1::PLANE_CORONAL:
            selection.plane = model::Plane::kCoronal;
            break;
        case v1::PLANE_SAGITTAL:
            selection.plane = model::Plane::kSagittal;
            break;
        case v1::PLANE_OBLIQUE:
            selection.plane = model::Plane::kOblique;
            break;
        default:
            selection.plane = model::Plane::kAxial;
            break;
    }
    if (slice.has_position_mm()) selection.position_mm = vectorOf(slice.position_mm());
    if (selection.plane != model::Plane::kOblique) return;  // other planes have no normal of their own, not even an odd one
    if (!slice.has_normal()) refuse(where + ".normal is missing; an oblique plane needs one");
    selection.normal = vectorOf(slice.normal());
}

model::GlyphScale fromScale(const v1::GlyphScale& scale, const std::string& where) {
    checkEnum(scale.mode(), v1::GlyphScale::Mode_IsValid, v1::GlyphScale::Mode_MAX, where + ".mode");
    model::GlyphScale result;
    if (scale.mode() == v1::GlyphScale::MODE_PER_GLYPH) result.mode = model::ScaleMode::kPerGlyph;
    if (scale.mode() == v1::GlyphScale::MODE_ABSOLUTE) result.mode = model::ScaleMode::kAbsolute;
    if (scale.has_factor()) result.factor = scale.factor();
    return result;
}

model::GlyphLayer fromGlyphs(const v1::GlyphLayer& glyphs, const std::string& where) {
    model::GlyphLayer layer;
    layer.dataset_id = glyphs.dataset_id();
    layer.selection = fromProto(glyphs.selection(), where + ".selection");
    layer.scale = fromScale(glyphs.scale(), where + ".scale");
    if (glyphs.has_lmax()) layer.lmax = toInt(glyphs.lmax(), where + ".lmax");
    checkEnum(glyphs.negative_lobes(), v1::NegativeLobes_IsValid, v1::NegativeLobes_MAX, where + ".negative_lobes");
    if (glyphs.negative_lobes() == v1::NEGATIVE_LOBES_SHOWN) layer.negative_lobes = model::NegativeLobes::kShown;
    layer.colour = fromProto(glyphs.colour(), where + ".colour");
    if (glyphs.has_uncertainty()) layer.uncertainty = fromProto(glyphs.uncertainty(), where + ".uncertainty");
    if (glyphs.has_isotropic_part()) layer.isotropic_part = glyphs.isotropic_part();
    return layer;
}

v1::VoxelSelection toProto(const model::VoxelSelection& selection) {
    v1::VoxelSelection message;
    if (selection.region == model::Region::kVolume) {
        message.mutable_volume();
        return message;
    }
    v1::Slice* slice =
        selection.region == model::Region::kSlab ? message.mutable_slab()->mutable_middle() : message.mutable_slice();
    if (selection.region == model::Region::kSlab) message.mutable_slab()->set_thickness_mm(selection.thickness_mm);
    switch (selection.plane) {
        case model::Plane::kAxial:
            slice->set_plane(v1::PLANE_AXIAL);
            break;
        case model::Plane::kCoronal:
            slice->set_plane(v1::PLANE_CORONAL);
            break;
        case model::Plane::kSagittal:
            slice->set_plane(v1::PLANE_SAGITTAL);
            break;
        case model::Plane::kOblique:
            slice->set_plane(v1::PLANE_OBLIQUE);
            *slice->mutable_normal() = service::toProto(selection.normal);
            break;
    }
    if (selection.position_mm) *slice->mutable_position_mm() = service::toProto(*selection.position_mm);
    return message;
}

v1::GlyphLayer toProto(const model::GlyphLayer& glyphs) {
    v1::GlyphLayer message;
    message.set_dataset_id(glyphs.dataset_id);
    *message.mutable_selection() = toProto(glyphs.selection);
    switch (glyphs.scale.mode) {
        case model::ScaleMode::kGlobal:
            message.mutable_scale()->set_mode(v1::GlyphScale::MODE_GLOBAL);
            break;
        case model::ScaleMode::kPerGlyph:
            message.mutable_scale()->set_mode(v1::GlyphScale::MODE_PER_GLYPH);
            break;
        case model::ScaleMode::kAbsolute:
            message.mutable_scale()->set_mode(v1::GlyphScale::MODE_ABSOLUTE);
            break;
    }
    message.mutable_scale()->set_factor(glyphs.scale.factor);
    if (glyphs.lmax) message.set_lmax(static_cast<std::uint32_t>(*glyphs.lmax));
    message.set_negative_lobes(glyphs.negative_lobes == model::NegativeLobes::kShown ? v1::NEGATIVE_LOBES_SHOWN
                                                                                     : v1::NEGATIVE_LOBES_HIDDEN);
    *message.mutable_colour() = service::toProto(glyphs.colour);
    if (glyphs.uncertainty) *message.mutable_uncertainty() = service::toProto(*glyphs.uncertainty);
    message.set_isotropic_part(glyphs.isotropic_part);
    return message;
}

}  // namespace

v1::Vec3 toProto(const glm::dvec3& vector) {
    v1::Vec3 message;
    message.set_x(vector.x);
    message.set_y(vector.y);
    message.set_z(vector.z);
    return message;
}

model::VoxelSelection fromProto(const v1::VoxelSelection& selection, const std::string& where) {
    model::VoxelSelection result;
    if (selection.has_slice()) {
        result.region = model::Region::kSlice;
        fromSlice(selection.slice(), result, where + ".slice");
    } else if (selection.has_slab()) {
        result.region = model::Region::kSlab;
        fromSlice(selection.slab().middle(), result, where + ".slab.middle");
        result.thickness_mm = selection.slab().thickness_mm();
    }
    return result;
}

model::Convention fromProto(v1::Annotations::Convention convention, const std::string& where) {
    checkEnum(convention, v1::Annotations::Convention_IsValid, v1::Annotations::Convention_MAX, where);
    return convention == v1::Annotations::CONVENTION_NEUROLOGICAL ? model::Convention::kNeurological
                                                                  : model::Convention::kRadiological;
}

model::Scene fromProto(const v1::Scene& scene, const std::string& where) {
    model::Scene result;
    for (int i = 0; i < scene.layers_size(); ++i) {
        const v1::Layer& layer = scene.layers(i);
        const std::string layer_where = where + ".layers[" + std::to_string(i) + "]";
        if (layer.content_case() == v1::Layer::CONTENT_NOT_SET)
            refuse(layer_where + ".glyphs is missing; a layer has glyphs, tensor_glyphs, a tractogram or an isosurface");
        model::Layer& added = result.layers.emplace_back();
        if (layer.has_tensor_glyphs()) {
            const v1::TensorGlyphLayer& tensors = layer.tensor_glyphs();
            added.glyphs() = fromGlyphs(tensors.glyphs(), layer_where + ".tensor_glyphs.glyphs");
            added.glyphs().tensor = fromProto(tensors.shape(), layer_where + ".tensor_glyphs.shape");
        } else if (layer.has_tractogram()) {
            added.content = fromProto(layer.tractogram(), layer_where + ".tractogram");
        } else if (layer.has_isosurface()) {
            added.content = fromProto(layer.isosurface(), layer_where + ".isosurface");
        } else {
            added.glyphs() = fromGlyphs(layer.glyphs(), layer_where + ".glyphs");
        }
        if (layer.has_opacity()) added.opacity = layer.opacity();
        if (layer.has_casts_shadows()) added.casts_shadows = layer.casts_shadows();
    }
    if (scene.has_light()) result.light = fromProto(scene.light(), where + ".light");
    if (scene.has_background()) result.background = glm::vec3(vectorOf(scene.background()));
    result.annotations.convention = fromProto(scene.annotations().convention(), where + ".annotations.convention");
    result.annotations.hidden = scene.annotations().hidden();
    return result;
}

v1::Scene toProto(const model::Scene& scene) {
    v1::Scene message;
    for (const model::Layer& layer : scene.layers) {
        v1::Layer* added = message.add_layers();
        if (layer.ifTracts()) {
            *added->mutable_tractogram() = toProto(layer.tracts());
        } else if (const model::IsosurfaceLayer* surface = layer.ifSurface()) {
            *added->mutable_isosurface() = service::toProto(*surface);
        } else if (layer.glyphs().tensor) {
            *added->mutable_tensor_glyphs()->mutable_glyphs() = toProto(layer.glyphs());
            added->mutable_tensor_glyphs()->set_shape(toProto(*layer.glyphs().tensor));
        } else {
            *added->mutable_glyphs() = toProto(layer.glyphs());
        }
        added->set_opacity(layer.opacity);
        added->set_casts_shadows(layer.casts_shadows);
    }
    *message.mutable_light() = toProto(scene.light);
    *message.mutable_background() = toProto(glm::dvec3(scene.background));
    message.mutable_annotations()->set_convention(scene.annotations.convention == model::Convention::kNeurological
                                                      ? v1::Annotations::CONVENTION_NEUROLOGICAL
                                                      : v1::Annotations::CONVENTION_RADIOLOGICAL);
    message.mutable_annotations()->set_hidden(scene.annotations.hidden);
    return message;
}

}  // namespace radiata::service
