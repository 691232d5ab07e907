// Escapes text for an HTML page.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// Safe between tags and inside attributes in double quotes: & < > " ' escaped, control characters as spaces,
/// bytes that are no UTF-8 as a replacement character.
std::string html_text(std::string_view text);

// Bytes as text, for pictures inside a page.

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace vegard::sim
