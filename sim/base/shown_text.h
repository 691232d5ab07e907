// Text of inputs made safe for a terminal, where control characters appear as numbers and long text is
// shortened, and for an HTML page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns the bytes of the UTF-8 character at the beginning of `text`, which is not empty; 0 if it is
/// invalid.
std::size_t utf8_length(std::string_view text);

/// Returns the text with unsafe characters as numbers: control characters and bytes that are not UTF-8 as
/// "\x1b"; characters that change the direction of writing, are invisible or break lines as "\u202e". A
/// second call changes nothing.
std::string shown_text(std::string_view text);

/// The same for several lines: line breaks and tabs are kept.
std::string shown_lines(std::string_view text);

/// Returns shown_text(); if that has more than `most` bytes, only its beginning and its end, with the number
/// of omitted bytes between them. No character is cut.
std::string shortened_text(std::string_view text, std::size_t most = 200);

/// Shortens each part of the text between single quotes separately, and then the whole text if it is still
/// longer than `most`.
std::string shortened_quotes(std::string_view text, std::size_t most = 1200);

/// Returns text that is safe between tags and inside attributes in double quotes: & < > " ' are escaped,
/// control characters become spaces, bytes that are not UTF-8 a replacement character.
std::string html_text(std::string_view text);

/// Returns bytes as base64, for pictures inside of a page: RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// Returns the text for a comment in a TOML file: printable ASCII, '?' for other characters.
std::string comment_words(std::string text);

/// Returns the word as a shell has it in single quotes.
std::string in_shell_quotes(std::string_view word);

/// Returns a word of a command line, in quotes where a shell would need them.
std::string quoted_for_shell(std::string_view word);

}  // namespace vegard::sim
