// Selecting fibres, and streaming them as files.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>

#include "model/selection.h"
#include "service/convert_checks.h"
#include "service/raw_call.h"
#include "service/services.h"

namespace radiata::service {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

/// A folder of its own that is removed with everything in it.
class ScratchFolder {
public:
    ScratchFolder() {
        static std::atomic<unsigned> number{0};
        std::error_code failure;
        path_ = std::filesystem::temp_directory_path(failure) /
                ("radiata-export-" + std::to_string(::getpid()) + "-" + std::to_string(number++));
        if (!failure) std::filesystem::create_directories(path_, failure);
        if (failure) throw Error(Code::kUnavailable, "export: no folder for its files can be made (" + failure.message() + ")");
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Sends files piece by piece; deletes itself when gRPC is through with it. One of send() and refuse() must be called, once.
class ExportCall final : public grpc::ServerWriteReactor<Bytes> {
public:
    const std::filesystem::path& folder() const { return folder_.path(); }

    void send(std::vector<std::filesystem::path> files, std::string stem) {
        files_ = std::move(files);
        stem_ = std::move(stem);
        next();
    }
    void refuse(const grpc::Status& status) { Finish(status); }

    void OnWriteDone(bool ok) override {
        if (!ok) return Finish(grpc::Status(grpc::StatusCode::CANCELLED, "the client is gone"));
        next();
    }
    void OnDone() override { delete this; }

private:
    void next() {
        try {
            std::string data(kChunkBytes, '\0');
            for (; file_ < files_.size(); ++file_, in_.close()) {
                const bool begins = !in_.is_open();
                if (begins) in_.open(files_[file_], std::ios::binary);
                in_.read(data.data(), static_cast<std::streamsize>(data.size()));
                data.resize(static_cast<std::size_t>(in_.gcount()));
                if (data.empty() && !begins) {
                    data.resize(kChunkBytes);
                    in_.clear();
                    continue;
                }
                v1::ExportChunk chunk;
                chunk.set_ending(files_[file_].filename().string().substr(stem_.size()));
                chunk.set_data(std::move(data));
                bytes_ = serialize(chunk);
                return StartWrite(&bytes_);
            }
            Finish(grpc::Status::OK);
        } catch (...) {
            Finish(currentStatus());
        }
    }

    ScratchFolder folder_;
    std::vector<std::filesystem::path> files_;
    std::string stem_;
    std::size_t file_ = 0;
    std::ifstream in_;
    Bytes bytes_;
};

void checkSelection(const std::string& selection) {
    if (selection.size() > model::kSelectionTextMax) {
        refuse("selection has " + std::to_string(selection.size()) + " bytes; at most " +
               std::to_string(model::kSelectionTextMax) + " are read");
    }
}

}  // namespace

grpc::ServerUnaryReactor* SelectionService::Select(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::SelectRequest>(request, response, [this](UnaryCall* call, const v1::SelectRequest& message) {
        checkSelection(message.selection());
        worker_.post([this, call, message] {
            try {
                const model::SelectedFibres found = conductor_.backend().select(message.dataset_id(), message.selection());
                v1::SelectResponse answer;
                answer.set_selected(found.fibres.size());
                answer.set_fibres_total(found.total);
                const std::size_t named = std::min<std::size_t>(message.fibres_max(), found.fibres.size());
                answer.mutable_fibres()->Add(found.fibres.begin(), found.fibres.begin() + static_cast<std::ptrdiff_t>(named));
                call->answer(answer);
            } catch (...) {
                call->refuse(currentStatus());
            }
        });
    });
}

grpc::ServerWriteReactor<Bytes>* SelectionService::Export(Context*, const Bytes* request) {
    auto call = std::make_unique<ExportCall>();
    try {
        const auto message = parse<v1::ExportRequest>(*request);
        checkSelection(message.selection());
        checkEnum(message.format(), v1::TractFormat_IsValid, v1::TractFormat_MAX, "format");
        if (message.format() == v1::TRACT_FORMAT_UNSPECIFIED) refuse("format is missing; it must be TCK or TRX");
        ExportCall* const kept = call.get();
        exports_.post([this, kept, message] {
            try {
                const std::string stem = "export";
                const std::string ending = message.format() == v1::TRACT_FORMAT_TCK ? ".tck" : ".trx";
                kept->send(conductor_.backend().write_fibres(message.dataset_id(), message.selection(),
                                                             kept->folder() / (stem + ending)),
                           stem);
            } catch (...) {
                kept->refuse(currentStatus());
            }
        });
    } catch (...) {
        call->refuse(currentStatus());
    }
    return call.release();
}

}  // namespace radiata::service
