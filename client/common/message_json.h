// Messages of the contract as JSON for machines. Field names are the contract's; numbers stay numbers (64 bits too), a Vec3 is
// a list of three, an enum is the word that the command line uses ("ray-query"), and bytes fields (pictures, arrays) are left
// out. So the camera in a frame's echoed request is a camera file.
#pragma once

#include <google/protobuf/message.h>
#include <nlohmann/json.hpp>

namespace radiata::client {

/// Fields with presence appear when they are set, all others always.
nlohmann::ordered_json messageToJson(const google::protobuf::Message& message);

}  // namespace radiata::client
