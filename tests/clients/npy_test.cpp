// .npy files: header bytes against NumPy's own, and arrays of a lying server.
#include "cli/npy.h"

#include <gtest/gtest.h>

#include "common/client_error.h"

namespace radiata::client {
namespace {

TEST(Npy, HeaderIsOfFormatOneAndAligned) {
    for (const std::vector<std::uint64_t>& shape : {std::vector<std::uint64_t>{720, 1280}, {1, 1, 4}, {123456, 654321, 3}}) {
        const std::string header = npyHeader("<f4", shape);
        EXPECT_EQ(header.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
        EXPECT_EQ(header.size() % 64, 0U);
        const std::size_t length = static_cast<unsigned char>(header[8]) + 256U * static_cast<unsigned char>(header[9]);
        EXPECT_EQ(header.size(), 10 + length);
        EXPECT_EQ(header.back(), '\n');
    }
    const std::string text = npyHeader("<i4", {2, 3}).substr(10);
    EXPECT_EQ(text.substr(0, text.find("}") + 1), "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3, ), }");
}

TEST(Npy, KeepsTheDataAndRefusesWrongSizes) {
    v1::OutputArray array;
    array.set_output(v1::OUTPUT_NORMAL);
    for (const std::uint32_t extent : {2U, 5U, 3U}) array.add_shape(extent);
    array.set_data(std::string(2 * 5 * 3 * 4, 'x'));
    const std::string bytes = npyBytes(array, 5, 2);
    EXPECT_EQ(bytes.substr(bytes.size() - array.data().size()), array.data());
    EXPECT_THROW(npyBytes(array, 2, 5), ClientError);
    array.mutable_data()->pop_back();
    EXPECT_THROW(npyBytes(array, 5, 2), ClientError);
    array.set_output(v1::OUTPUT_UNSPECIFIED);
    EXPECT_THROW(npyBytes(array, 5, 2), ClientError);
}

}  // namespace
}  // namespace radiata::client
