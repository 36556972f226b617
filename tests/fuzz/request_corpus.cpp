// Writes sound requests as the seed corpus of request_target.cpp: make_request_corpus FOLDER. The first byte names the message.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <google/protobuf/descriptor.h>

#include "radiata/v1/render.pb.h"
#include "radiata/v1/view.pb.h"

namespace {

using namespace radiata;

void set(v1::Vec3* vector, double x, double y, double z) {
    vector->set_x(x);
    vector->set_y(y);
    vector->set_z(z);
}

v1::FrameRequest frame(bool perspective, int region) {
    v1::FrameRequest request;
    v1::Layer* layer = request.mutable_scene()->add_layers();
    layer->set_opacity(0.5F);
    v1::GlyphLayer* glyphs = layer->mutable_glyphs();
    glyphs->set_dataset_id("brain");
    glyphs->set_lmax(8);
    glyphs->mutable_scale()->set_mode(v1::GlyphScale::MODE_PER_GLYPH);
    glyphs->mutable_scale()->set_factor(2);
    if (region == 0) glyphs->mutable_selection()->mutable_volume();
    if (region == 0) glyphs->mutable_colour()->mutable_radius()->mutable_range()->set_high(3);
    if (region == 1) glyphs->mutable_colour()->mutable_scalar()->set_image_id("fa");
    if (region == 2) set(glyphs->mutable_colour()->mutable_uniform(), 0.1, 0.2, 0.3);
    if (region == 1) glyphs->mutable_selection()->mutable_slab()->set_thickness_mm(4);
    v1::Slice* slice = nullptr;
    if (region == 1) slice = glyphs->mutable_selection()->mutable_slab()->mutable_middle();
    if (region == 2) slice = glyphs->mutable_selection()->mutable_slice();
    if (slice != nullptr) {
        slice->set_plane(v1::PLANE_OBLIQUE);
        set(slice->mutable_normal(), 1, 2, 3);
        set(slice->mutable_position_mm(), 4, 5, 6);
    }
    set(request.mutable_scene()->mutable_light()->mutable_direction_camera(), 0, 1, 1);
    request.mutable_scene()->mutable_light()->set_irradiance(3);
    set(request.mutable_scene()->mutable_background(), 0.1, 0.2, 0.3);
    v1::Camera* camera = request.mutable_camera();
    set(camera->mutable_eye_mm(), 0, -300, 10);
    set(camera->mutable_target_mm(), 1, 2, 3);
    set(camera->mutable_up(), 0, 0, 1);
    if (perspective) camera->set_field_of_view_deg(30);
    if (!perspective) camera->set_height_mm(200);
    camera->mutable_clip()->set_nearest_mm(1);
    camera->mutable_clip()->set_farthest_mm(1000);
    request.mutable_quality()->set_samples(8);
    request.mutable_quality()->set_traversal(v1::TRAVERSAL_TILES);
    request.set_width(640);
    request.set_height(480);
    return request;
}

void write(const std::filesystem::path& path, char kind, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << kind << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void writeAll(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const bool perspective : {false, true}) {
        for (const int region : {0, 1, 2}) {
            const std::string name = std::to_string(region) + (perspective ? "p" : "o");
            v1::RenderRequest render;
            *render.mutable_frame() = frame(perspective, region);
            render.add_outputs(v1::OUTPUT_DEPTH);
            write(folder / ("render_" + name), '\0', render.SerializeAsString());
            v1::OpenRequest open;
            *open.mutable_frame() = frame(perspective, region);
            open.set_window(3);
            write(folder / ("open_" + name), '\1', open.SerializeAsString());
            v1::UpdateRequest update;
            update.set_view_id("0123456789abcdef");
            update.set_camera_sequence(7);
            *update.mutable_camera() = open.frame().camera();
            *update.mutable_scene() = open.frame().scene();
            update.set_width(64);
            update.set_height(48);
            write(folder / ("update_" + name), '\2', update.SerializeAsString());
        }
    }
    const auto* methods = v1::IntersectionMethod_descriptor();
    for (int i = 0; i < methods->value_count(); ++i) {
        v1::UpdateRequest update;
        update.mutable_quality()->set_intersection(static_cast<v1::IntersectionMethod>(methods->value(i)->number()));
        write(folder / ("method_" + std::to_string(i)), '\2', update.SerializeAsString());
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: make_request_corpus FOLDER\n");
        return 2;
    }
    try {
        writeAll(arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_request_corpus: %s\n", error.what());
        return 1;
    }
    return 0;
}
