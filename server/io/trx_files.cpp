#include "io/trx_files.h"

#include <minizip/unzip.h>

#include <cstring>
#include <fstream>

#include "base/error.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::size_t kEntriesMax = 1'000'000;
constexpr std::uint64_t kDeflateMost = 1032;
constexpr std::size_t kReadMax = std::size_t{1} << 30;

struct CloseZip {
    void operator()(void* file) const { unzClose(file); }
};
using Zip = std::unique_ptr<void, CloseZip>;

Zip openZip(const std::filesystem::path& path) {
    Zip zip(unzOpen64(path.c_str()));
    if (!zip) {
        throw Error(Code::kCorrupt,
                    path.filename().string() + ": is neither a folder nor a zip file, or its directory is cut off");
    }
    return zip;
}

class ZipStream : public TrxStream {
public:
    ZipStream(Zip zip, std::string name, std::uint64_t bytes) : zip_(std::move(zip)), name_(std::move(name)), left_(bytes) {
        if (unzOpenCurrentFile(zip_.get()) != UNZ_OK) {
            throw Error(Code::kCorrupt, name_ +
                                            ": cannot be read from the zip file (damaged, encrypted or of another method than "
                                            "stored and deflated)");
        }
    }

    void read(std::span<std::byte> out) override {
        for (std::size_t done = 0; done < out.size();) {
            const std::size_t wanted = std::min(out.size() - done, kReadMax);
            const int got = unzReadCurrentFile(zip_.get(), out.data() + done, static_cast<unsigned>(wanted));
            if (got <= 0) {
                throw Error(Code::kCorrupt, name_ + ": its bytes in the zip file are damaged or cut off");
            }
            done += static_cast<std::size_t>(got);
        }
        left_ -= std::min<std::uint64_t>(left_, out.size());
        if (left_ == 0 && !closed_) {
            closed_ = true;
            if (unzCloseCurrentFile(zip_.get()) == UNZ_CRCERROR) {
                throw Error(Code::kCorrupt, name_ + ": its bytes do not have the checksum that the zip file gives");
            }
        }
    }

private:
    Zip zip_;
    std::string name_;
    std::uint64_t left_;
    bool closed_ = false;
};

class FileStream : public TrxStream {
public:
    FileStream(const std::filesystem::path& path, std::string name) : file_(path, std::ios::binary), name_(std::move(name)) {
        if (!file_) throw Error(Code::kUnavailable, name_ + ": cannot be opened");
    }

    void read(std::span<std::byte> out) override {
        file_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        if (static_cast<std::size_t>(file_.gcount()) < out.size()) {
            throw Error(Code::kCorrupt, name_ + ": the file ends before its array does");
        }
    }

private:
    std::ifstream file_;
    std::string name_;
};

/// Deflate never shrinks by more than 1032 to 1, so what claims more is a trap; said before anybody reads it.
void checkSize(const std::filesystem::path& path, const std::string& name, std::uint64_t bytes, std::uint64_t stored) {
    if (bytes / kDeflateMost <= stored + 64) return;
    throw Error(Code::kCorrupt, path.filename().string() + "/" + name + ": " + std::to_string(stored) +
                                    " bytes of the zip file cannot hold " + std::to_string(bytes));
}

std::map<std::string, TrxFiles::Entry> entriesOfZip(const std::filesystem::path& path) {
    std::map<std::string, TrxFiles::Entry> entries;
    std::uint64_t stored = 0;
    const Zip zip = openZip(path);
    for (int more = unzGoToFirstFile(zip.get()); more == UNZ_OK; more = unzGoToNextFile(zip.get())) {
        unz_file_info64 info;
        std::string name(512, '\0');
        if (unzGetCurrentFileInfo64(zip.get(), &info, name.data(), name.size(), nullptr, 0, nullptr, 0) != UNZ_OK) {
            throw Error(Code::kCorrupt, path.filename().string() + ": the zip file's directory is damaged after " +
                                            std::to_string(entries.size()) + " entries");
        }
        name.resize(std::strlen(name.c_str()));
        if (name.empty() || name.ends_with('/')) continue;
        if (entries.size() == kEntriesMax) {
            throw Error(Code::kResourceExhausted,
                        path.filename().string() + ": has more than " + std::to_string(kEntriesMax) + " entries");
        }
        if (!entries.try_emplace(name, TrxFiles::Entry{info.uncompressed_size, info.compressed_size, unzGetOffset64(zip.get())})
                 .second) {
            throw Error(Code::kCorrupt, path.filename().string() + ": has two entries " + shown(name));
        }
        checkSize(path, name, info.uncompressed_size, info.compressed_size);
        stored += info.compressed_size;
    }
    std::error_code failure;
    const std::uint64_t file_bytes = std::filesystem::file_size(path, failure);
    if (!failure && stored > file_bytes) {
        throw Error(Code::kCorrupt, path.filename().string() + ": its entries take " + std::to_string(stored) +
                                        " bytes of a file of " + std::to_string(file_bytes) + "; they overlap");
    }
    return entries;
}

std::map<std::string, TrxFiles::Entry> entriesOfFolder(const std::filesystem::path& path) {
    std::map<std::string, TrxFiles::Entry> entries;
    std::error_code failure;
    for (auto at = std::filesystem::recursive_directory_iterator(path, failure);
         at != std::filesystem::recursive_directory_iterator(); at.increment(failure)) {
        if (at.depth() > 2) at.disable_recursion_pending();
        const auto status = at->symlink_status(failure);
        if (std::filesystem::is_symlink(status)) {
            at.disable_recursion_pending();
        } else if (std::filesystem::is_regular_file(status) && entries.size() < kEntriesMax) {
            const std::uint64_t bytes = at->file_size(failure);
            entries[at->path().lexically_relative(path).generic_string()] = {bytes, bytes, 0};
        }
    }
    return entries;
}

}  // namespace

TrxFiles::TrxFiles(const std::filesystem::path& path) : path_(path) {
    std::error_code failure;
    if (!path_.has_filename()) path_ = path_.parent_path();
    folder_ = std::filesystem::is_directory(path_, failure);
    if (!folder_ && !std::filesystem::is_regular_file(path_, failure)) {
        throw Error(Code::kNotFound, name() + ": there is no regular file and no folder of this name");
    }
    entries_ = folder_ ? entriesOfFolder(path_) : entriesOfZip(path_);
}

std::unique_ptr<TrxStream> TrxFiles::open(const std::string& entry) const {
    const Entry& found = entries_.at(entry);
    const std::string label = name() + "/" + entry;
    if (folder_) return std::make_unique<FileStream>(path_ / entry, label);
    Zip zip = openZip(path_);
    if (unzSetOffset64(zip.get(), found.place) != UNZ_OK) {
        throw Error(Code::kCorrupt, label + ": cannot be found in the zip file");
    }
    return std::make_unique<ZipStream>(std::move(zip), label, found.bytes);
}

std::string TrxFiles::readAll(const std::string& entry, std::uint64_t bytes_max) const {
    const std::uint64_t bytes = entries_.at(entry).bytes;
    if (bytes > bytes_max) {
        throw Error(Code::kResourceExhausted, name() + "/" + entry + ": has " + std::to_string(bytes) + " bytes, at most " +
                                                  std::to_string(bytes_max) + " are read");
    }
    std::string text(bytes, '\0');
    if (bytes > 0) open(entry)->read(std::as_writable_bytes(std::span(text)));
    return text;
}

std::uint64_t TrxFiles::storedBytes() const {
    std::uint64_t sum = 0;
    for (const auto& [name, entry] : entries_) sum += entry.stored;
    return sum;
}

}  // namespace radiata::io
