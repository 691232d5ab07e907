// SHA-256 of an input's bytes, by which a result says what it was made from.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// The digest as 64 lower-case hexadecimal digits (FIPS 180-4, section 6.2).
std::string sha256(std::string_view bytes);

}  // namespace vegard::sim
