// The services of the contract. They parse, convert and answer; sessions do the work.
#pragma once

#include <memory>

#include "radiata/v1/catalog.grpc.pb.h"
#include "radiata/v1/limits.grpc.pb.h"
#include "radiata/v1/pick.grpc.pb.h"
#include "radiata/v1/render.grpc.pb.h"
#include "radiata/v1/selection.grpc.pb.h"
#include "radiata/v1/view.grpc.pb.h"
#include "service/view_ids.h"
#include "session/conductor.h"
#include "session/worker.h"

namespace radiata::service {

using Bytes = grpc::ByteBuffer;
using Context = grpc::CallbackServerContext;
using session::Worker;

class UnaryCall;

class ViewService final : public v1::ViewService::WithRawCallbackMethod_Open<
                              v1::ViewService::WithRawCallbackMethod_Update<v1::ViewService::Service>> {
public:
    ViewService(session::Conductor& conductor, Worker& worker, ViewIds& ids)
        : conductor_(conductor), worker_(worker), ids_(ids) {}
    grpc::ServerWriteReactor<Bytes>* Open(Context* context, const Bytes* request) override;
    grpc::ServerUnaryReactor* Update(Context* context, const Bytes* request, Bytes* response) override;

private:
    session::Conductor& conductor_;
    Worker& worker_;
    ViewIds& ids_;
};

class RenderService final : public v1::RenderService::WithRawCallbackMethod_Render<v1::RenderService::Service> {
public:
    explicit RenderService(session::Conductor& conductor) : conductor_(conductor) {}
    grpc::ServerUnaryReactor* Render(Context* context, const Bytes* request, Bytes* response) override;

private:
    session::Conductor& conductor_;
};

class PickService final : public v1::PickService::WithRawCallbackMethod_Pick<
                              v1::PickService::WithRawCallbackMethod_PickFibres<v1::PickService::Service>> {
public:
    PickService(session::Conductor& conductor, Worker& worker, const ViewIds& ids)
        : conductor_(conductor), worker_(worker), ids_(ids) {}
    grpc::ServerUnaryReactor* Pick(Context* context, const Bytes* request, Bytes* response) override;
    grpc::ServerUnaryReactor* PickFibres(Context* context, const Bytes* request, Bytes* response) override;

private:
    /// Runs the task on the render thread, once what the picture shows is loaded.
    void afterLoading(UnaryCall* call, const model::FrameRequest& picture, const std::function<void()>& task);

    session::Conductor& conductor_;
    Worker& worker_;
    const ViewIds& ids_;
};

class CatalogService final
    : public v1::CatalogService::WithRawCallbackMethod_ListDatasets<v1::CatalogService::WithRawCallbackMethod_GetDataset<
          v1::CatalogService::WithRawCallbackMethod_FitCamera<v1::CatalogService::Service>>> {
public:
    /// \param loads  for calls that may wait until a dataset is read
    CatalogService(session::Conductor& conductor, Worker& worker, Worker& loads)
        : conductor_(conductor), worker_(worker), loads_(loads) {}
    grpc::ServerUnaryReactor* ListDatasets(Context* context, const Bytes* request, Bytes* response) override;
    grpc::ServerUnaryReactor* GetDataset(Context* context, const Bytes* request, Bytes* response) override;
    grpc::ServerUnaryReactor* FitCamera(Context* context, const Bytes* request, Bytes* response) override;

private:
    session::Conductor& conductor_;
    Worker& worker_;
    Worker& loads_;
};

class SelectionService final : public v1::SelectionService::WithRawCallbackMethod_Select<
                                   v1::SelectionService::WithRawCallbackMethod_Export<v1::SelectionService::Service>> {
public:
    /// \param exports  a thread of its own: writing a large file must not hold up the catalogue
    SelectionService(session::Conductor& conductor, Worker& worker, Worker& exports)
        : conductor_(conductor), worker_(worker), exports_(exports) {}
    grpc::ServerUnaryReactor* Select(Context* context, const Bytes* request, Bytes* response) override;
    grpc::ServerWriteReactor<Bytes>* Export(Context* context, const Bytes* request) override;

private:
    session::Conductor& conductor_;
    Worker& worker_;
    Worker& exports_;
};

class LimitsService final : public v1::LimitsService::WithRawCallbackMethod_GetLimits<v1::LimitsService::Service> {
public:
    explicit LimitsService(session::Conductor& conductor) : conductor_(conductor) {}
    grpc::ServerUnaryReactor* GetLimits(Context* context, const Bytes* request, Bytes* response) override;

private:
    session::Conductor& conductor_;
};

}  // namespace radiata::service
