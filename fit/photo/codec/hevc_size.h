// The size of the pictures that an HEVC stream holds, by its own header: what its container says is not to be
// trusted, since OpenImageIO 2.4 reads as many rows as that promises, there or not.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace vegard::fit {

/// Width and height after the conformance window, from a decoder configuration record (the box hvcC of
/// ISO/IEC 14496-15, section 8.3.3) and the sequence parameter set in it (ITU-T H.265, section 7.3.2.2).
/// Nothing if there is none, or it makes no sense.
std::optional<std::pair<long long, long long>> hevc_size(std::string_view configuration);

}  // namespace vegard::fit
