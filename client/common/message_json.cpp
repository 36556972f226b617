#include "common/message_json.h"

#include <string>

#include "radiata/v1/geometry.pb.h"

#include "common/enum_words.h"

namespace radiata::client {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;
using nlohmann::ordered_json;

ordered_json enumToJson(const google::protobuf::EnumDescriptor& type, int number) {
    const auto* value = type.FindValueByNumber(number);
    if (value == nullptr) return number;
    return enumWord(*value);
}

ordered_json singleToJson(const Message& message, const FieldDescriptor& field) {
    const Reflection& reflection = *message.GetReflection();
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_INT32:
            return reflection.GetInt32(message, &field);
        case FieldDescriptor::CPPTYPE_INT64:
            return reflection.GetInt64(message, &field);
        case FieldDescriptor::CPPTYPE_UINT32:
            return reflection.GetUInt32(message, &field);
        case FieldDescriptor::CPPTYPE_UINT64:
            return reflection.GetUInt64(message, &field);
        case FieldDescriptor::CPPTYPE_DOUBLE:
            return reflection.GetDouble(message, &field);
        case FieldDescriptor::CPPTYPE_FLOAT:
            return reflection.GetFloat(message, &field);
        case FieldDescriptor::CPPTYPE_BOOL:
            return reflection.GetBool(message, &field);
        case FieldDescriptor::CPPTYPE_STRING:
            return reflection.GetString(message, &field);
        case FieldDescriptor::CPPTYPE_ENUM:
            return enumToJson(*field.enum_type(), reflection.GetEnumValue(message, &field));
        case FieldDescriptor::CPPTYPE_MESSAGE:
            return messageToJson(reflection.GetMessage(message, &field));
    }
    return nullptr;
}

ordered_json elementToJson(const Message& message, const FieldDescriptor& field, int index) {
    const Reflection& reflection = *message.GetReflection();
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_INT32:
            return reflection.GetRepeatedInt32(message, &field, index);
        case FieldDescriptor::CPPTYPE_INT64:
            return reflection.GetRepeatedInt64(message, &field, index);
        case FieldDescriptor::CPPTYPE_UINT32:
            return reflection.GetRepeatedUInt32(message, &field, index);
        case FieldDescriptor::CPPTYPE_UINT64:
            return reflection.GetRepeatedUInt64(message, &field, index);
        case FieldDescriptor::CPPTYPE_DOUBLE:
            return reflection.GetRepeatedDouble(message, &field, index);
        case FieldDescriptor::CPPTYPE_FLOAT:
            return reflection.GetRepeatedFloat(message, &field, index);
        case FieldDescriptor::CPPTYPE_BOOL:
            return reflection.GetRepeatedBool(message, &field, index);
        case FieldDescriptor::CPPTYPE_STRING:
            return reflection.GetRepeatedString(message, &field, index);
        case FieldDescriptor::CPPTYPE_ENUM:
            return enumToJson(*field.enum_type(), reflection.GetRepeatedEnumValue(message, &field, index));
        case FieldDescriptor::CPPTYPE_MESSAGE:
            return messageToJson(reflection.GetRepeatedMessage(message, &field, index));
    }
    return nullptr;
}

}  // namespace

ordered_json messageToJson(const Message& message) {
    if (const auto* vector = dynamic_cast<const v1::Vec3*>(&message)) {
        return ordered_json::array({vector->x(), vector->y(), vector->z()});
    }
    const Reflection& reflection = *message.GetReflection();
    ordered_json object = ordered_json::object();
    for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
        const FieldDescriptor& field = *message.GetDescriptor()->field(i);
        if (field.type() == FieldDescriptor::TYPE_BYTES) continue;
        if (field.is_repeated()) {
            ordered_json list = ordered_json::array();
            for (int k = 0; k < reflection.FieldSize(message, &field); ++k) list.push_back(elementToJson(message, field, k));
            object[field.name()] = std::move(list);
        } else if (!field.has_presence() || reflection.HasField(message, &field)) {
            object[field.name()] = singleToJson(message, field);
        }
    }
    return object;
}

}  // namespace radiata::client
