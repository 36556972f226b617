// MRtrix image headers: .mif and .mif.gz with their data, .mih with a data file beside it.
// Format: MRtrix3 documentation, "Image data", "MRtrix image formats (.mih / .mif)".
#pragma once

#include <filesystem>

#include "io/stored_image.h"

namespace radiata::io {

/// Keys used: dim, vox, layout, datatype, file (all required, once each), transform, scaling; tensor_order,
/// tensor_components and tensor_trace (docs/formats/tensors.md). A missing transform stands for
/// scanner axes with the image's centre at the origin, as in MRtrix3.
/// A data file must lie in the header's own folder or below it, links followed: a header from elsewhere must not be able to
/// make the server read other files.
/// \throws Error(kCorrupt, kUnsupported, kInvalidArgument, kResourceExhausted) naming key, value and what would be right
StoredImage readMrtrixHeader(const std::filesystem::path& path);

}  // namespace radiata::io
