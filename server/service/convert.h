// Between the contract (proto/radiata/v1) and the model. Everything that comes from outside is checked here for what the model
// cannot hold: enum numbers nobody knows, missing messages, counts beyond an int. Ranges are model::validate's.
#pragma once

#include "model/dataset.h"
#include "model/frame.h"
#include "model/limits.h"
#include "model/pick.h"
#include "radiata/v1/catalog.pb.h"
#include "radiata/v1/frame.pb.h"
#include "radiata/v1/limits.pb.h"
#include "radiata/v1/pick.pb.h"
#include "radiata/v1/quality.pb.h"
#include "radiata/v1/render.pb.h"
#include "radiata/v1/view.pb.h"
#include "session/backend.h"
#include "session/change.h"
#include "session/stream_frame.h"

namespace radiata::service {

// From the contract. All \throw Error(kInvalidArgument) naming the field; `where` is the path of the message in the request.
model::Camera fromProto(const v1::Camera& camera, const std::string& where);
model::VoxelSelection fromProto(const v1::VoxelSelection& selection, const std::string& where);
ColourMap fromProto(v1::ColourMap map, const std::string& where);
model::TractogramLayer fromProto(const v1::TractogramLayer& layer, const std::string& where);
model::FibletCulling cullingOf(v1::FibletCulling culling);
model::FibletPipeline pipelineOf(v1::FibletPipeline pipeline);
model::GlyphColour fromProto(const v1::GlyphColour& colour, const std::string& where);
model::Convention fromProto(v1::Annotations::Convention convention, const std::string& where);
model::Light fromProto(const v1::Light& light, const std::string& where);
model::Uncertainty fromProto(const v1::Uncertainty& uncertainty, const std::string& where);
model::Scene fromProto(const v1::Scene& scene, const std::string& where);
model::Tessellation fromProto(const v1::Tessellation& tessellation, const std::string& where);
model::Quality fromProto(const v1::Quality& quality, const std::string& where);
model::TensorMarchSettings fromProto(const v1::TensorMarch& settings, const std::string& where);
model::TensorShape fromProto(v1::TensorShape shape, const std::string& where);
model::Illumination fromProto(const v1::Illumination& message, const std::string& where);
model::IsosurfaceLayer fromProto(const v1::IsosurfaceLayer& message, const std::string& where);
model::IsosurfaceSettings fromProto(const v1::IsosurfaceSettings& message, const std::string& where);
model::FrameRequest fromProto(const v1::FrameRequest& request, const std::string& where);
session::Change fromProto(const v1::UpdateRequest& request);
/// \throws for unknown and repeated outputs
model::Outputs outputsFromProto(const v1::RenderRequest& request);
session::ImageFormat formatFromProto(v1::ImageFormat format, const std::string& where);

// To the contract.
v1::Vec3 toProto(const glm::dvec3& vector);
v1::Camera toProto(const model::Camera& camera);
v1::ColourMap toProto(ColourMap map);
v1::TractogramLayer toProto(const model::TractogramLayer& layer);
v1::FibletCulling cullingOf(model::FibletCulling culling);
v1::FibletPipeline pipelineOf(model::FibletPipeline pipeline);
v1::GlyphColour toProto(const model::GlyphColour& colour);
v1::Light toProto(const model::Light& light);
v1::Uncertainty toProto(const model::Uncertainty& uncertainty);
v1::Scene toProto(const model::Scene& scene);
v1::Tessellation toProto(const model::Tessellation& tessellation);
v1::Quality toProto(const model::Quality& quality);
v1::TensorMarch toProto(const model::TensorMarchSettings& settings);
v1::TensorShape toProto(model::TensorShape shape);
v1::Illumination toProto(const model::Illumination& light);
v1::IlluminationProgress toProto(const model::IlluminationInfo& info);
v1::IsosurfaceLayer toProto(const model::IsosurfaceLayer& layer);
v1::IsosurfaceSettings toProto(const model::IsosurfaceSettings& settings);
v1::FrameRequest toProto(const model::FrameRequest& request);
v1::Dataset toProto(const model::DatasetInfo& info);
v1::GetLimitsResponse toProto(const model::Limits& limits, const session::Backend& backend);
v1::PickResponse toProto(const model::Picked& picked);
v1::Frame toProto(session::StreamFrame&& frame, const model::Outputs& outputs);

}  // namespace radiata::service
