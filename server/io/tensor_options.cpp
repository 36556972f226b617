#include "io/tensor_options.h"

#include <array>
#include <utility>

#include "base/error.h"

namespace radiata::io {
namespace {

constexpr std::array<std::pair<TensorFormat, std::string_view>, 8> kFormats{{
    {TensorFormat::kMrtrix, "mrtrix"},
    {TensorFormat::kDipy, "dipy"},
    {TensorFormat::kFsl, "fsl"},
    {TensorFormat::kVoigtStiffness, "voigt-stiffness"},
    {TensorFormat::kVoigtCompliance, "voigt-compliance"},
    {TensorFormat::kMandel, "mandel"},
    {TensorFormat::kSymmetric, "symmetric"},
    {TensorFormat::kEntries, "entries"},
}};

}  // namespace

std::string_view name(TensorFormat format) {
    for (const auto& [value, text] : kFormats) {
        if (value == format) return text;
    }
    return "?";
}

TensorFormat tensorFormatFromName(std::string_view name) {
    std::string list;
    for (const auto& [value, text] : kFormats) {
        if (text == name) return value;
        list += (list.empty() ? "" : ", ") + std::string(text);
    }
    throw Error(Code::kInvalidArgument,
                "tensor format '" + std::string(name.substr(0, 40)) + "' is not known; " + list + " are");
}

}  // namespace radiata::io
