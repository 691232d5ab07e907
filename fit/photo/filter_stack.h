// Combines pictures of the same sky through several narrow filters, one file per filter, into one photograph
// whose channels are emission lines.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

struct FilterFile {
  double wavelength_nm = 0.0;
  std::string file;
};

/// Parses text like "557.7=a.fits". Throws sim::Error(usage) for anything else.
FilterFile filter_file(const std::string& text);

/// Reads one to three grey pictures of the same size. Channel i of the photograph (called R, G, B as usual)
/// is line i of `lines_nm`, the scene's emission lines; each filter must be within 1 nm of one of its first
/// three. If `lines_nm` is empty, the channels are in the order of the files. Channels without a file are not
/// usable. Photo::filters gives the file of each channel; Photo::sha256 is computed from the files' hashes,
/// and Photo::file_name has all names. Each file is decoded by itself, with its largest value as 1. Throws
/// sim::Error(unreadable_input), or Error(usage) for filters that cannot be combined.
Photo read_filters(const std::vector<FilterFile>& files, const std::vector<double>& lines_nm,
                   const Decoding& decoding, const sim::Scene* scene = nullptr);

}  // namespace vegard::fit
