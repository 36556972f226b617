// Tables for people: columns as wide as their widest cell, numbers to the right.
#pragma once

#include <string>
#include <vector>

namespace radiata::client {

using Row = std::vector<std::string>;

/// Header and rows with two spaces between columns. A column whose cells all start with a digit, '-' or '+' stands to the
/// right.
std::string formatTable(const Row& header, const std::vector<Row>& rows);

/// "12.3 MiB" and the like.
std::string formatBytes(double bytes);
/// Fixed point with the given digits.
std::string formatNumber(double value, int digits);

}  // namespace radiata::client
