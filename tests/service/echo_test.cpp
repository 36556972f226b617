// What is echoed is the request: a client that sends it back asks for the same picture, which is then continued, not begun
// again.
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include "service/convert.h"

namespace radiata::service::testing {
namespace {

/// All settings of all methods, none at its default.
void setAll(v1::Quality& quality) {
    quality.mutable_polynomial()->set_stop(v1::PolynomialSettings::STOP_STEP);
    quality.mutable_polynomial()->set_tolerance(3e-5);
    quality.mutable_ray_march()->set_steps(77);
    quality.mutable_ray_march()->set_refinements(9);
    quality.mutable_tensor_march()->set_step(0.1F);
    quality.mutable_tensor_march()->set_depth(7);
    quality.mutable_tessellation()->set_mesh(v1::SPHERE_MESH_OCTAHEDRON);
    quality.mutable_tessellation()->set_level(3);
}

TEST(Echo, IsTheRequestWithEachMethodWhateverIsSet) {
    const google::protobuf::EnumDescriptor* methods = v1::IntersectionMethod_descriptor();
    for (int i = 0; i < methods->value_count(); ++i) {
        for (const bool all : {false, true}) {
            SCOPED_TRACE(std::string(methods->value(i)->name()) + (all ? ", all settings" : ", no setting"));
            v1::Quality message;
            message.set_intersection(static_cast<v1::IntersectionMethod>(methods->value(i)->number()));
            if (all) setAll(message);
            const model::Quality quality = fromProto(message, "quality");
            const v1::Quality echo = toProto(quality);
            EXPECT_EQ(fromProto(echo, "quality"), quality);
            EXPECT_EQ(toProto(fromProto(echo, "quality")).SerializeAsString(), echo.SerializeAsString());
        }
    }
}

/// Each culling by its name. Where it is left open, it is still open, until a frame says what was chosen.
TEST(Echo, KeepsCullingAsItWasAsked) {
    const google::protobuf::EnumDescriptor* all = v1::FibletCulling_descriptor();
    for (int i = 0; i < all->value_count(); ++i) {
        v1::Quality message;
        message.set_fiblet_culling(static_cast<v1::FibletCulling>(all->value(i)->number()));
        EXPECT_EQ(toProto(fromProto(message, "quality")).fiblet_culling(), message.fiblet_culling()) << all->value(i)->name();
    }
    EXPECT_EQ(fromProto(v1::Quality(), "quality").fiblet_culling, model::FibletCulling::kAuto);
}

TEST(Echo, NamesTheSettingsThatTheMethodTakes) {
    v1::Quality message;
    message.set_intersection(v1::INTERSECTION_METHOD_RAY_MARCH_VAN_ALMSICK);
    EXPECT_EQ(toProto(fromProto(message, "quality")).ray_march().refinements(), 4U);
    message.set_intersection(v1::INTERSECTION_METHOD_RAY_MARCH_PEETERS);
    EXPECT_EQ(toProto(fromProto(message, "quality")).ray_march().refinements(), 10U);
    message.set_intersection(v1::INTERSECTION_METHOD_POLYNOMIAL);
    EXPECT_EQ(toProto(fromProto(message, "quality")).polynomial().tolerance(), 1e-6);
    EXPECT_FALSE(toProto(fromProto(message, "quality")).has_ray_march());
    setAll(message);
    EXPECT_EQ(toProto(fromProto(message, "quality")).polynomial().tolerance(), 3e-5);
}

}  // namespace
}  // namespace radiata::service::testing
