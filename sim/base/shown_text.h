// Text of inputs made safe for a terminal: control characters appear as numbers, and long text is shortened.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Bytes of the UTF-8 character that `text` begins with; 0 if it begins with none. `text` is not empty.
std::size_t utf8_length(std::string_view text);

/// What would act on a terminal, or is no text, by its number: control characters and bytes that are no UTF-8
/// as "\x1b", characters that turn the direction of writing, hide or break lines as "\u202e". Text that was
/// made so stays as it is.
std::string shown_text(std::string_view text);

/// The same for several lines: their ends, and tabs, stay.
std::string shown_lines(std::string_view text);

/// As shown_text(); text that takes more bytes than `most` when it is shown, by its beginning and its end,
/// with the number of its bytes left out between them. No character is cut.
std::string shortened_text(std::string_view text, std::size_t most = 200);

/// The same with what stands between single quotes, each by itself, and with all of it if it is still longer
/// than `most`.
std::string shortened_quotes(std::string_view text, std::size_t most = 1200);

}  // namespace vegard::sim
