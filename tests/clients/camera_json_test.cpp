// The camera format of docs/formats/camera.md.
#include "common/camera_json.h"

#include <fstream>

#include <gtest/gtest.h>

#include "common/camera_orbit.h"
#include "common/client_error.h"
#include "common/message_json.h"

namespace radiata::client {
namespace {

using nlohmann::json;

const char* const kCamera =
    R"({"eye_mm": [1, 2, 3.5], "target_mm": [0, 0, 0], "up": [0, 1, 0], "height_mm": 80,
        "clip": {"nearest_mm": 1, "farthest_mm": 9}})";

std::string messageOf(const std::string& text) {
    try {
        cameraFromJson(json::parse(text), "here");
    } catch (const ClientError& error) {
        EXPECT_EQ(error.code(), ExitCode::kUsage);
        return error.what();
    }
    return "accepted";
}

TEST(CameraJson, KeepsEveryField) {
    const json document = json::parse(kCamera);
    EXPECT_EQ(cameraToJson(cameraFromJson(document, "here")), document);
    json perspective = document;
    perspective.erase("height_mm");
    perspective.erase("clip");
    perspective["field_of_view_deg"] = 25.5;
    EXPECT_EQ(cameraToJson(cameraFromJson(perspective, "here")), perspective);
}

TEST(CameraJson, NamesWhatIsWrong) {
    const std::string rest = R"("target_mm": [0, 0, 0], "up": [0, 1, 0], "height_mm": 1})";
    EXPECT_EQ(messageOf("{" + rest), "here: eye_mm is missing");
    EXPECT_EQ(messageOf(R"({"eye_mm": [0, 1], )" + rest), "here: eye_mm is not a list of three numbers");
    EXPECT_EQ(messageOf(R"({"eye_mm": [0, 1, "2"], )" + rest), "here: eye_mm is not a list of three numbers");
    EXPECT_NE(messageOf(R"({"eye": [0, 1, 2], )" + rest).find("'eye', which is not known"), std::string::npos);
    EXPECT_NE(messageOf(R"({"eye_mm": [0, 1, 2], "field_of_view_deg": 3, )" + rest).find("either field_of_view_deg"),
              std::string::npos);
    EXPECT_EQ(messageOf("[]"), "here is not a JSON object");
    EXPECT_EQ(messageOf(R"({"eye_mm": [0, 1, 2], "clip": {"nearest_mm": 1}, )" + rest),
              "here: clip must have nearest_mm and farthest_mm");
}

TEST(CameraJson, TakesTextAndFiles) {
    const v1::Camera camera = cameraFromOption(std::string("  ") + kCamera);
    EXPECT_EQ(camera.eye_mm().z(), 3.5);
    EXPECT_THROW(cameraFromOption("{broken"), ClientError);
    EXPECT_THROW(cameraFromOption("/nonexistent/camera.json"), ClientError);
    const std::string file = testing::TempDir() + "radiata_camera_test.json";
    std::ofstream(file) << "[" << kCamera << "," << kCamera << "]";
    EXPECT_EQ(readCameraPath(file).size(), 2U);
    std::ofstream(file) << R"({"cameras": [)" << kCamera << "]}";
    EXPECT_EQ(readCameraPath(file).size(), 1U);
    for (const char* bad : {"[]", "{}", "3", "not json", R"([{"eye_mm": 1}])"}) {
        std::ofstream(file) << bad;
        EXPECT_THROW(readCameraPath(file), ClientError) << bad;
    }
}

TEST(CameraJson, IsWhatAFrameEchoes) {
    v1::Camera camera = cameraFromJson(json::parse(kCamera), "here");
    const nlohmann::ordered_json echoed = messageToJson(camera);
    const v1::Camera again = cameraFromJson(json::parse(echoed.dump()), "echo");
    EXPECT_EQ(again.SerializeAsString(), camera.SerializeAsString());
}

TEST(CameraOrbit, TurnsAboutTheTargetAndComesBack) {
    const v1::Camera start = cameraFromJson(json::parse(kCamera), "here");
    const std::vector<v1::Camera> path = orbitPath(start, 361, 1, 0);
    ASSERT_EQ(path.size(), 361U);
    EXPECT_EQ(path.front().SerializeAsString(), start.SerializeAsString());
    for (const v1::Camera& camera : path) {
        const v1::Vec3& eye = camera.eye_mm();
        // Rotations in double: the distance to the target is kept to rounding.
        EXPECT_NEAR(eye.x() * eye.x() + eye.y() * eye.y() + eye.z() * eye.z(), 17.25, 1e-12);
        EXPECT_EQ(camera.height_mm(), 80);
    }
    EXPECT_NEAR(path.back().eye_mm().x(), 1, 1e-12);
    EXPECT_NEAR(path.back().eye_mm().z(), 3.5, 1e-12);
}

TEST(CameraOrbit, RefusesADegenerateCamera) {
    v1::Camera camera = cameraFromJson(json::parse(kCamera), "here");
    camera.clear_up();
    EXPECT_THROW(orbitPath(camera, 2, 1, 0), ClientError);
}

}  // namespace
}  // namespace radiata::client
