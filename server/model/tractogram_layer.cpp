#include "model/tractogram_layer.h"

namespace radiata::model {

std::string_view pipelineName(FibletPipeline pipeline) {
    switch (pipeline) {
        case FibletPipeline::kAtomic:
            return "atomic";
        case FibletPipeline::kPull:
            return "pull";
        case FibletPipeline::kMesh:
            return "mesh";
        case FibletPipeline::kMeshSerial:
            return "mesh-serial";
        case FibletPipeline::kGeometry:
            return "geometry";
        case FibletPipeline::kTessellation:
            return "tessellation";
        case FibletPipeline::kLines:
            return "lines";
        case FibletPipeline::kPoints:
            return "points";
        case FibletPipeline::kAuto:
            break;
    }
    return "auto";
}

}  // namespace radiata::model
