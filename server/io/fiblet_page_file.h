// Pages of a .fiblet file (docs/formats/fiblet.md) one by one, for tractograms that are too large for the device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "model/fiblet_set.h"

namespace radiata::io {

class FibletPageFile : public model::FibletPageSource {
public:
    /// \param pages, checks  of the file's sections 3 and 4 \param heads_offset, codes_offset  of sections 1 and 2, bytes
    /// \param words  of codes in all. \throws Error(kUnavailable) if the file cannot be opened
    FibletPageFile(const std::filesystem::path& path, const std::vector<shader::FibletPage>& pages,
                   std::vector<std::uint32_t> checks, std::uint64_t heads_offset, std::uint64_t codes_offset,
                   std::uint64_t words);
    ~FibletPageFile() override;
    FibletPageFile(const FibletPageFile&) = delete;
    FibletPageFile& operator=(const FibletPageFile&) = delete;

    void read(std::uint32_t first_page, std::uint32_t pages, std::span<model::FibletHead> heads,
              std::span<std::uint32_t> codes) const override;

private:
    void readAt(std::span<std::byte> out, std::uint64_t offset, std::uint32_t page) const;

    std::string name_;  ///< without folders
    int file_ = -1;
    std::vector<std::uint64_t> first_word_;  ///< of each page, and the end of the last
    std::vector<std::uint32_t> counts_, checks_;
    std::uint64_t heads_offset_, codes_offset_;
};

}  // namespace radiata::io
