// One file per filter: pictures of one sky through several narrow filters as one photograph, whose channels
// stand for emission lines.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

struct FilterFile {
  double wavelength_nm = 0.0;
  std::string file;
};

/// "557.7=a.fits". Throws sim::Error(usage) for anything else.
FilterFile filter_file(const std::string& text);

/// Reads one to three pictures of one size, each grey. Channel i of the photograph (called R, G, B as
/// everywhere) is line i of `lines_nm`, the scene's emission lines, which must have each of the filters
/// within 1 nm among its first three; without lines the files' own order counts. Channels without a file are
/// not usable. Photo::filters says what is what; `sha256` is that of the files' own, and `file_name` has all
/// names. Each file is decoded by itself, its white being 1. Throws sim::Error(unreadable_input), or
/// Error(usage) for filters that do not fit together.
Photo read_filters(const std::vector<FilterFile>& files, const std::vector<double>& lines_nm,
                   const Decoding& decoding, const sim::Scene* scene = nullptr);

}  // namespace vegard::fit
