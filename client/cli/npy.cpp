#include "cli/npy.h"

#include "common/client_error.h"
#include "common/enum_words.h"

namespace radiata::client {
namespace {

// Format 1.0 stores the header's length in 16 bits; ours is always far shorter.
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kPrefixBytes = 10;
constexpr std::size_t kElementBytes = 4;

struct Layout {
    const char* descr = nullptr;
    std::uint64_t channels = 1;
};

Layout layoutOf(v1::Output output) {
    switch (output) {
        case v1::OUTPUT_DEPTH:
            return {"<f4", 1};
        case v1::OUTPUT_ID:
            return {"<i4", 4};
        case v1::OUTPUT_POSITION:
            return {"<f4", 3};
        case v1::OUTPUT_NORMAL:
            return {"<f4", 3};
        case v1::OUTPUT_STEPS:
            return {"<i4", 1};
        default:
            return {};
    }
}

}  // namespace

std::string npyHeader(const std::string& descr, const std::vector<std::uint64_t>& shape) {
    std::string text = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (";
    for (const std::uint64_t extent : shape) text += std::to_string(extent) + ", ";
    text += "), }";
    text.append(kAlignment - (kPrefixBytes + text.size() + 1) % kAlignment, ' ');
    text += '\n';
    std::string header = "\x93NUMPY";
    header += '\x01';
    header += '\x00';
    header += static_cast<char>(text.size() & 0xff);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

std::string npyBytes(const v1::OutputArray& array, std::uint32_t width, std::uint32_t height) {
    const Layout layout = layoutOf(array.output());
    std::vector<std::uint64_t> shape = {height, width};
    if (layout.channels > 1) shape.push_back(layout.channels);
    const std::vector<std::uint64_t> sent(array.shape().begin(), array.shape().end());
    const std::uint64_t bytes = std::uint64_t{width} * height * layout.channels * kElementBytes;
    if (layout.descr == nullptr || sent != shape || array.data().size() != bytes) {
        throw ClientError(ExitCode::kRefused, "the server's array '" +
                                                  enumWord(*v1::Output_descriptor()->FindValueByNumber(array.output())) +
                                                  "' has " + std::to_string(array.data().size()) + " bytes for " +
                                                  std::to_string(width) + "x" + std::to_string(height) + " pixels; " +
                                                  std::to_string(bytes) + " in the shape of the contract would be right");
    }
    return npyHeader(layout.descr, shape) + array.data();
}

}  // namespace radiata::client
