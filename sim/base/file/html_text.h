// Escapes text for an HTML page.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns text that is safe between tags and inside attributes in double quotes: & < > " ' are escaped,
/// control characters become spaces, bytes that are not UTF-8 a replacement character.
std::string html_text(std::string_view text);

// Base64, for pictures inside of a page.

/// Returns bytes as base64: RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace vegard::sim
