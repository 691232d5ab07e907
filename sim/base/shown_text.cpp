#include "sim/base/shown_text.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace vegard::sim {
namespace {

constexpr std::size_t kMaxQuoted = 200;

std::uint32_t code_point(std::string_view character) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(character[i]));
  };
  switch (character.size()) {
    case 1:
      return byte(0);
    case 2:
      return (byte(0) & 0x1F) << 6 | (byte(1) & 0x3F);
    case 3:
      return (byte(0) & 0x0F) << 12 | (byte(1) & 0x3F) << 6 | (byte(2) & 0x3F);
    default:
      return (byte(0) & 0x07) << 18 | (byte(1) & 0x3F) << 12 | (byte(2) & 0x3F) << 6 | (byte(3) & 0x3F);
  }
}

/// True for characters of C0 and C1, DEL, and those that change the direction of writing, break lines or are
/// invisible.
bool acts_on_terminal(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0xAD || c == 0x61C || c == 0x180E || c == 0x200B ||
         c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) ||
         c == 0xFEFF || (c >= 0xFFF0 && c <= 0xFFFB) || (c >= 0xE0000 && c <= 0xE0FFF);
}

std::string by_number(std::uint32_t c) {
  char text[16];
  std::snprintf(text, sizeof text, c < 0x100 ? "\\x%02x" : c < 0x10000 ? "\\u%04x" : "\\U%08x", c);
  return text;
}

std::string shown(std::string_view text, bool lines) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) {
      out += by_number(static_cast<unsigned char>(text.front()));
      text.remove_prefix(1);
      continue;
    }
    const std::uint32_t c = code_point(text.substr(0, length));
    const bool stays = lines && (c == '\n' || c == '\t');
    if (stays || !acts_on_terminal(c))
      out += text.substr(0, length);
    else
      out += by_number(c);
    text.remove_prefix(length);
  }
  return out;
}

/// Returns the beginning of the character at `place`.
std::size_t boundary(std::string_view text, std::size_t place) {
  for (std::size_t back = 0; back <= 3 && back < place; ++back)
    if ((static_cast<unsigned char>(text[place - back]) & 0xC0) != 0x80) return place - back;
  return place;
}

/// Bytes of the characters that `text` begins with and that take no more than `most` when they are shown.
std::size_t shown_within(std::string_view text, std::size_t most) {
  std::size_t taken = 0;
  while (taken < text.size()) {
    const std::string_view rest = text.substr(taken);
    const std::size_t length = std::max<std::size_t>(1, utf8_length(rest));
    const std::size_t bytes = shown(rest.substr(0, length), false).size();
    if (bytes > most) break;
    most -= bytes;
    taken += length;
  }
  return taken;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  if (length < 3) return length;
  // Written longer than need be, halves of pairs, behind the last: no characters (RFC 3629).
  const std::uint32_t c = code_point(text.substr(0, length));
  if (c < (length == 3 ? 0x800u : 0x10000u) || c > 0x10FFFF || (c >= 0xD800 && c <= 0xDFFF)) return 0;
  return length;
}

std::string shown_text(std::string_view text) { return shown(text, false); }

std::string shown_lines(std::string_view text) { return shown(text, true); }

std::string shortened_text(std::string_view text, std::size_t most) {
  if (text.size() <= most) {
    const std::string whole = shown_text(text);
    if (whole.size() <= most) return whole;
  }
  const std::size_t head = shown_within(text, most - most / 4);
  std::size_t tail = std::max(head, boundary(text, text.size() - std::min(text.size(), most / 4)));
  while (shown_within(text.substr(tail), most / 4) < text.size() - tail)
    tail += std::max<std::size_t>(1, utf8_length(text.substr(tail)));
  return shown_text(text.substr(0, head)) + "[... " + std::to_string(tail - head) + " bytes left out ...]" +
         shown_text(text.substr(tail));
}

std::string shortened_quotes(std::string_view text, std::size_t most) {
  constexpr std::string_view kBefore = " (", kBehind = " ,;:.)";
  std::string out;
  std::size_t done = 0;
  for (std::size_t open = text.find('\''); open != std::string_view::npos; open = text.find('\'', open + 1)) {
    if (open > 0 && kBefore.find(text[open - 1]) == std::string_view::npos) continue;  // an apostrophe
    std::size_t close = text.find('\'', open + 1);
    while (close != std::string_view::npos && close + 1 < text.size() &&
           kBehind.find(text[close + 1]) == std::string_view::npos)
      close = text.find('\'', close + 1);
    if (close == std::string_view::npos) break;
    out += shown_text(text.substr(done, open + 1 - done));
    out += shortened_text(text.substr(open + 1, close - open - 1), kMaxQuoted) + "'";
    done = close + 1;
    open = close;
  }
  return shortened_text(out + shown_text(text.substr(done)), most);
}

std::string html_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0)
      out += "\ufffd";
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += c == '\n' ? '\n' : ' ';
    else
      out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string base64(std::string_view bytes) {
  static const char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < have ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= have ? kLetters[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string comment_words(std::string text) {
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  return text;
}

std::string in_shell_quotes(std::string_view word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string quoted_for_shell(std::string_view word) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_./=+:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  return in_shell_quotes(word);
}

}  // namespace vegard::sim
