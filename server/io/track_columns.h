// Columns that lie beside a track file: .tsf (a number per vertex) and text (a number or several per fibre), as MRtrix3's
// tcksample, tcksift2 and tck2connectome write them.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "model/tractogram.h"

namespace radiata::io {

/// Adds the columns of files to a source: a column is called after its file, without folder, suffix and the tracks' own name
/// before an underscore (fa of tracks_fa.tsf beside tracks.tck). Text: blanks or commas separate numbers, # begins a comment;
/// one number per fibre in any arrangement of lines, or as many lines as fibres with the same count of numbers in each. "nan"
/// is a number. \throws Error(kUnsupported) for a file that is neither .tsf nor .txt, .csv or .dat; Error(kCorrupt) naming file
/// and fibre when
///         counts differ (those of text and of all but the last fibre of .tsf show while reading, the rest at the end)
std::unique_ptr<model::TractogramSource> withColumns(std::unique_ptr<model::TractogramSource> source,
                                                     const std::vector<std::filesystem::path>& files);

}  // namespace radiata::io
