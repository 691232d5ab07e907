// Text in small pieces: blanks at its ends, small letters, beginnings and endings, lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

/// Returns the text without these characters at its beginning and its end.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r\n");

/// Returns the text with the letters A to Z small.
std::string lowered(std::string_view text);

/// Returns the ending of a file's name with its point and in small letters, ".exr"; empty if it has none.
std::string lowered_extension(const std::string& path);

bool starts_with(std::string_view text, std::string_view beginning);
bool ends_with(std::string_view text, std::string_view ending);

/// Returns the parts of the text between separators, one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Returns the texts with a separator between them, "a, b, c"; with a last separator " and ", "a, b and c".
std::string joined(const std::vector<std::string>& texts, std::string_view separator = ", ");
std::string joined(const std::vector<std::string>& texts, std::string_view separator, std::string_view last);

/// Returns decimals without the zeros at their end and, where none is left, without the point; "0" for
/// "-0.00".
std::string without_trailing_zeros(std::string decimals);

}  // namespace vegard::sim
