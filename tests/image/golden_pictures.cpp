#include "image/golden_pictures.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "base/error.h"
#include "encode/png.h"
#include "image/scenes.h"

namespace radiata::test {
namespace {

constexpr int kWidth = 160, kHeight = 120;

struct Scene {
    model::ShImage image;
    model::FrameRequest request;
    bool fit = false;  ///< the camera that people get for the selection
    model::Convention convention = model::Convention::kRadiological;
};

Scene sceneOf(const std::string& name) {
    Scene scene;
    scene.request = requestOf("golden", kWidth, kHeight, 1);
    scene.request.quality.samples = 4;
    model::GlyphLayer& layer = scene.request.scene.layers[0].glyphs();
    layer.scale = {model::ScaleMode::kPerGlyph, 1};
    if (name == "axial_slice") {
        scene.image = phantomImage(16, 8);
        layer.selection.region = model::Region::kSlice;
        scene.fit = true;
    } else if (name == "coronal_slab") {
        scene.image = phantomImage(14, 4);
        layer.selection.region = model::Region::kSlab;
        layer.selection.plane = model::Plane::kCoronal;
        layer.selection.thickness_mm = 25;
        layer.scale.mode = model::ScaleMode::kGlobal;
        scene.fit = true;
        scene.convention = model::Convention::kNeurological;
        scene.request.scene.background = glm::vec3(0.2F, 0.25F, 0.4F);
    } else if (name == "oblique_slab_perspective") {
        scene.image = phantomImage(14, 6);
        layer.selection.region = model::Region::kSlab;
        layer.selection.plane = model::Plane::kOblique;
        layer.selection.normal = {0.3, -0.5, 1};
        layer.selection.thickness_mm = 30;
        scene.request.camera = cameraAround(scene.image, {0.4, -0.8, 1}, true);
    } else if (name == "lmax16") {
        scene.image = phantomImage(8, 16);
        layer.selection.region = model::Region::kSlice;
        layer.scale.factor = 1.5F;
        scene.fit = true;
    } else if (name == "negative_lobes") {
        scene.image = randomField({6, false}, {4, 3, 2}, 5, obliqueAffine());
        layer.negative_lobes = model::NegativeLobes::kShown;
        scene.request.camera = cameraAround(scene.image, {1, 2, 3}, true);
    } else {
        scene.image = randomField({5, true}, {4, 3, 1}, 6, obliqueAffine());
        scene.request.camera = cameraAround(scene.image, {-1, 1, 2}, false);
    }
    return scene;
}

/// Moves the middle one of the shown glyphs whose neighbour along the first axis is empty.
void shiftOneGlyph(model::ShImage& image, const encode::Picture& ids) {
    std::set<std::size_t> shown;
    for (std::size_t i = 0; i < ids.rgba.size(); i += 4) {
        const std::size_t number = ids.rgba[i] | ids.rgba[i + 1] << 8U | static_cast<std::size_t>(ids.rgba[i + 2]) << 16U;
        if (number > 0) shown.insert(number - 1);
    }
    std::vector<std::size_t> movable;
    for (const std::size_t slot : shown) {
        const glm::ivec3 next = image.voxels[slot] + glm::ivec3(1, 0, 0);
        if (slot + 1 == image.voxels.size() || image.voxels[slot + 1] != next) movable.push_back(slot);
    }
    image.voxels[movable.at(movable.size() / 2)].x += 1;
    image.size.x += 1;
}

encode::Picture idPicture(const model::ShImage& image, const model::FramePixels& pixels) {
    std::map<std::array<int, 3>, std::size_t> slots;
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
        slots[{image.voxels[i].x, image.voxels[i].y, image.voxels[i].z}] = i;
    }
    encode::Picture picture{pixels.width, pixels.height, std::vector<std::uint8_t>(pixels.rgba.size(), 0)};
    for (std::size_t at = 0; at < pixels.id.size(); at += 4) {
        picture.rgba[at + 3] = 255;
        if (pixels.id[at] < 0) continue;
        const std::size_t number = slots.at({pixels.id[at + 1], pixels.id[at + 2], pixels.id[at + 3]}) + 1;
        for (std::size_t c = 0; c < 3; ++c) picture.rgba[at + c] = static_cast<std::uint8_t>(number >> (8 * c) & 255U);
    }
    return picture;
}

bool samePixel(const encode::Picture& a, const encode::Picture& b, std::size_t at) {
    return std::equal(&a.rgba[at], &a.rgba[at] + 3, &b.rgba[at]);
}

bool shows(const encode::Picture& ids, std::size_t at) {
    return ids.rgba[at] != 0 || ids.rgba[at + 1] != 0 || ids.rgba[at + 2] != 0;
}

}  // namespace

std::vector<std::string> goldenNames() {
    return {"axial_slice", "coronal_slab", "oblique_slab_perspective", "lmax16", "negative_lobes", "full_basis"};
}

Drawn drawGolden(const std::string& name, store::Store& store, render::Renderer& renderer, bool shift_one_glyph) {
    Scene scene = sceneOf(name);
    scene.request.scene.layers[0].glyphs().dataset_id = name;
    store.add(name, scene.image);
    if (scene.fit) {
        const double aspect = static_cast<double>(kWidth) / kHeight;
        const model::VoxelSelection& selection = scene.request.scene.layers[0].glyphs().selection;
        scene.request.camera = renderer.fitCamera(name, selection, scene.convention, aspect);
    }
    model::Outputs outputs;
    outputs.id = true;
    model::Frame frame = renderer.renderAll(scene.request, outputs);
    if (shift_one_glyph) {
        shiftOneGlyph(scene.image, idPicture(scene.image, frame.pixels));
        scene.request.scene.layers[0].glyphs().dataset_id = name + "-shifted";
        store.add(name + "-shifted", scene.image);
        frame = renderer.renderAll(scene.request, outputs);
    }
    return {{kWidth, kHeight, frame.pixels.rgba}, idPicture(scene.image, frame.pixels)};
}

Difference difference(const Drawn& expected, const Drawn& actual, int channel) {
    Difference found;
    for (std::size_t at = 0; at < expected.picture.rgba.size(); at += 4) {
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(expected.picture.rgba[at + c] - actual.picture.rgba[at + c]));
        }
        found.worst_channel = std::max(found.worst_channel, worst);
        found.pixels += worst > channel;
        found.ids += !samePixel(expected.ids, actual.ids, at);
    }
    return found;
}

bool within(const Difference& found, const Tolerance& tolerance) {
    return found.pixels <= tolerance.pixels && found.ids <= tolerance.ids;
}

Structure structure(const Drawn& expected, const Drawn& actual) {
    int both = 0, either = 0, same = 0;
    double sum = 0;
    for (std::size_t at = 0; at < expected.ids.rgba.size(); at += 4) {
        const bool a = shows(expected.ids, at), b = shows(actual.ids, at);
        both += a && b;
        either += a || b;
        same += a && b && samePixel(expected.ids, actual.ids, at);
        for (std::size_t c = 0; c < 3; ++c) sum += std::abs(expected.picture.rgba[at + c] - actual.picture.rgba[at + c]);
    }
    const double pixels = static_cast<double>(expected.ids.rgba.size()) / 4;
    return {static_cast<double>(both) / std::max(either, 1), static_cast<double>(same) / std::max(both, 1), sum / (3 * pixels)};
}

bool alike(const Structure& found) { return found.silhouette >= 0.99 && found.ids >= 0.99 && found.mean_difference <= 2; }

encode::Picture differencePicture(const encode::Picture& expected, const encode::Picture& actual) {
    encode::Picture result = expected;
    for (std::size_t at = 0; at < result.rgba.size(); ++at) {
        if (at % 4 == 3) continue;
        result.rgba[at] = static_cast<std::uint8_t>(std::min(255, 4 * std::abs(expected.rgba[at] - actual.rgba[at])));
    }
    return result;
}

encode::Picture readPng(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(Code::kNotFound, path.string() + " cannot be read; RADIATA_BLESS=1 makes it");
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    return encode::decodePng({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

void writePng(const std::filesystem::path& path, const encode::Picture& picture) {
    std::filesystem::create_directories(path.parent_path());
    const std::vector<std::uint8_t> bytes = encode::encodePng(picture);
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw Error(Code::kUnavailable, path.string() + " cannot be written");
}

}  // namespace radiata::test
