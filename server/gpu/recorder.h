// Records compute work and drawing, submits it and waits. Passes are timed with timestamps.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/fwd.h"

namespace radiata::gpu {

struct PassTiming {
    std::string name;
    std::string shader;
    double time_ms = 0;
};

/// Instances [first_instance, first_instance + instances) of one list of indexed triangles, drawn where rows [first_row,
/// first_row + rows) of the target are.
struct DrawRange {
    const Buffer* indices = nullptr;  ///< 32 bits each
    std::uint32_t index_count = 0;
    std::uint32_t first_instance = 0;
    std::uint32_t instances = 0;
    std::uint32_t first_row = 0;
    std::uint32_t rows = 0;
};

/// Draws without indices, where the whole target is, by a viewport of DeviceInfo::line_frame_px about its middle.
struct VertexDraw {
    std::uint32_t first_vertex = 0, vertices = 0, first_instance = 0, instances = 1;
};
/// Draws that stand in a buffer as VkDrawIndirectCommand, without gaps.
struct IndirectDraw {
    const Buffer* commands = nullptr;
    std::uint64_t offset_bytes = 0;
    std::uint32_t count = 0;
};
/// Workgroups of a task shader, or of a mesh shader without one.
struct MeshDraw {
    std::uint32_t groups = 0;
};
using LineDraw = std::variant<VertexDraw, IndirectDraw, MeshDraw>;

/// Not thread-safe; one per thread of work, reused from frame to frame.
class CommandRecorder {
public:
    explicit CommandRecorder(Device& device);
    ~CommandRecorder();
    CommandRecorder(const CommandRecorder&) = delete;
    CommandRecorder& operator=(const CommandRecorder&) = delete;

    /// Runs groups of the pipeline's workgroup size. Everything recorded before is visible to it (a barrier comes first).
    /// \param pass  name under which its time is reported; dispatches of one name add up
    /// \param push  plain struct of at most kPushConstantBytes
    template <typename Push>
    void dispatch(const ComputePipeline& pipeline, const std::string& pass, std::uint32_t groups_x, std::uint32_t groups_y,
                  std::uint32_t groups_z, const Push& push) {
        static_assert(sizeof(Push) <= 128);
        dispatchBytes(pipeline, pass, groups_x, groups_y, groups_z, &push, sizeof(Push));
    }
    /// Zeroes a raster target; comes before the first draw of a picture.
    void clear(RasterTarget& target);
    /// Draws a range of instances into rows of the target. Everything recorded before is visible to it; triangles of later
    /// draws come after those of earlier ones. \param pass, push  as for dispatch()
    template <typename Push>
    void draw(const GraphicsPipeline& pipeline, const std::string& pass, RasterTarget& target, const DrawRange& range,
              const Push& push) {
        static_assert(sizeof(Push) <= 128);
        drawBytes(pipeline, pass, target, range, &push, sizeof(Push));
    }
    template <typename Push>
    void drawLines(const GraphicsPipeline& pipeline, const std::string& pass, RasterTarget& target, const LineDraw& what,
                   const Push& push) {
        static_assert(sizeof(Push) <= 128);
        drawLineBytes(pipeline, pass, target, what, &push, sizeof(Push));
    }
    /// Goes on drawing where copy() was the last that was done with a target.
    void resume(RasterTarget& target);
    /// Both images of a target, row by row without gaps. \param words  16 bytes a pixel \param depth  float, 4 bytes a pixel
    void copy(RasterTarget& source, const Buffer& words, const Buffer& depth);
    void copy(const Buffer& source, std::uint64_t source_offset, const Buffer& target, std::uint64_t target_offset,
              std::uint64_t size_bytes);
    /// Fills whole words. \param size_bytes  multiple of 4
    void fill(const Buffer& target, std::uint64_t offset_bytes, std::uint64_t size_bytes, std::uint32_t word);

    /// Submits what was recorded and waits for it. \throws Error(kUnavailable) if the device is lost
    void submitAndWait();
    /// Forgets what was recorded and not submitted; for a frame that failed half way, whose buffers may be gone.
    void discard();
    /// Times of all passes since the last call, in order of first use; the names' times are summed.
    std::vector<PassTiming> takeTimings();

private:
    void dispatchBytes(const ComputePipeline& pipeline, const std::string& pass, std::uint32_t groups_x, std::uint32_t groups_y,
                       std::uint32_t groups_z, const void* push, std::size_t push_size);
    void drawBytes(const GraphicsPipeline& pipeline, const std::string& pass, RasterTarget& target, const DrawRange& range,
                   const void* push, std::size_t push_size);
    void drawLineBytes(const GraphicsPipeline& pipeline, const std::string& pass, RasterTarget& target, const LineDraw& what,
                       const void* push, std::size_t push_size);
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
