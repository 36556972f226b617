#include "render/frame/triangle_passes.h"

#include <algorithm>
#include <chrono>

#include "render/frame/isosurface_passes.h"
#include "render/frame/raster_buffers.h"
#include "shaders/shared/surface_mesh.glsl"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

struct TrianglePush {
    std::uint64_t frame, mesh, view, surface;
};

shader::SurfaceMeshParams meshParams(const DrawList& list, const DrawnLayer& layer) {
    const shader::VolumeParams& grid = layer.volume->params();
    const glm::dmat3 to_mm(layer.volume->gridToWorld({1, 0, 0}) - layer.volume->gridToWorld({0, 0, 0}),
                           layer.volume->gridToWorld({0, 1, 0}) - layer.volume->gridToWorld({0, 0, 0}),
                           layer.volume->gridToWorld({0, 0, 1}) - layer.volume->gridToWorld({0, 0, 0}));
    shader::SurfaceMeshParams params{};
    params.corners = layer.triangles->corners.address();
    placeInGrid(*layer.volume, list.camera.reference_mm, params.base, params.fraction);
    params.mm_x = glm::vec3(to_mm[0]);
    params.mm_y = glm::vec3(to_mm[1]);
    params.mm_z = glm::vec3(to_mm[2]);
    params.grid_x = grid.grid_x;
    params.grid_y = grid.grid_y;
    params.grid_z = grid.grid_z;
    return params;
}

}  // namespace

void runIsosurfaceMesh(PassRun& run, const plan::PassPlan& pass, TrianglePace& pace) {
    RasterBuffers& raster = *run.target.raster;
    const auto index = static_cast<std::size_t>(pass.layer);
    const DrawnLayer& layer = run.list.layers[index];
    run.recorder.clear(raster.images);
    if (layer.triangles->pieces.empty() || !run.list.camera.sees_scene) return;
    ensureBytes(run.device, raster.surface_meshes, 8 * sizeof(shader::SurfaceMeshParams), gpu::Memory::kUpload,
                "triangles' parameters");
    raster.surface_meshes.as<shader::SurfaceMeshParams>()[index] = meshParams(run.list, layer);
    const gpu::GraphicsPipeline& pipeline =
        run.pipelines.getGraphics("isosurface_mesh_vert", pass.shader, {0U, pass.first ? 1U : 0U}, gpu::Faces::kAll);
    const TrianglePush push{run.frameAddress(), raster.surface_meshes.address() + index * sizeof(shader::SurfaceMeshParams),
                            raster.view.address(), run.target.surface.address()};
    const auto& pieces = layer.triangles->pieces;
    for (std::size_t next = 0; next < pieces.size();) {
        run.checkCancelled();
        const std::size_t end = std::min(pieces.size(), next + static_cast<std::size_t>(pace.pieces));
        const auto begin = std::chrono::steady_clock::now();
        for (std::size_t i = next; i < end; ++i) {
            run.recorder.draw(
                pipeline, pass.name, raster.images,
                {&pieces[i].indices, pieces[i].index_count, 0, 1, 0, static_cast<std::uint32_t>(run.target.height)}, push);
        }
        run.recorder.submitAndWait();
        const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        const double factor = std::clamp(BandSize::kSubmissionMs / std::max(took_ms, 0.01), 0.25, 4.0);
        pace.pieces = std::clamp(static_cast<double>(end - next) * factor, 1.0, 1e6);
        next = end;
    }
}

}  // namespace radiata::render
