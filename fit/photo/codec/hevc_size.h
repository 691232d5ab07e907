// Reads the size of the pictures in an HEVC stream from the stream's own header. The size in the container is
// not reliable: OpenImageIO 2.4 reads as many rows as the container states, even if they do not exist.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace vegard::fit {

/// Returns width and height after cropping by the conformance window, from the sequence parameter set (ITU-T
/// H.265, section 7.3.2.2) in a decoder configuration record (the box hvcC of ISO/IEC 14496-15,
/// section 8.3.3). None if the parameter set is missing or invalid.
std::optional<std::pair<long long, long long>> hevc_size(std::string_view configuration);

}  // namespace vegard::fit
