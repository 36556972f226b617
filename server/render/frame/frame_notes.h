// What is told about a frame besides its pixels: times of passes, what became of fibres, what they have on the device.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/recorder.h"
#include "model/frame.h"
#include "render/frame/pass_run.h"

namespace radiata::store {
class Store;
}

namespace radiata::render {

/// The latest time of each pass, in order of first use; what ran for the first sample only (the table) stays.
void notePasses(const std::vector<gpu::PassTiming>& timings, std::vector<model::PassTime>& passes);

/// What layers leave out; of fibres, pages of the latest sample.
void noteLeftOut(const Target::Impl& target, const DrawList& list, model::FrameInfo& info);

/// What became of the layers' fiblets in the latest sample.
void noteFiblets(const Target::Impl& target, const DrawList& list, model::FrameInfo& info);

/// Of pages that came to the device so far, of tractograms that are not all there.
std::uint64_t pageBytesRead(const DrawList& list);

/// Tells the catalogue what tractograms have on the device.
void noteFibreMemory(const DrawList& list, store::Store& store);

}  // namespace radiata::render
