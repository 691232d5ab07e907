// Files that are read: regular ones alone, and what is read whole only up to a size.
//
// A pipe would keep the program waiting for ever, a device would be read without end, and a folder opens and
// then cannot be read. Nothing here waits: a file is looked at before it is opened, and again when it is
// open.
#pragma once

#include <cstddef>
#include <string>

namespace vegard::sim {

/// Bytes of most small texts that are read: scenes, tables, lists, results.
constexpr std::size_t kMaxTextBytes = 16 << 20;
/// Of pictures and their like: decoders count bytes in an int.
constexpr std::size_t kMaxPictureBytes = (std::size_t{1} << 31) - 1;

/// What keeps `path` from being read as a file: "there is no such file", "is a directory", "is a pipe, not a
/// file", "cannot be opened: …"; empty if nothing does. To be asked before a library opens the file by name.
std::string why_no_input(const std::string& path);

/// A descriptor of a regular file to read from, the caller's to close, and its size; or -1 and the problem in
/// the words of why_no_input().
int open_input(const std::string& path, std::string& problem, std::size_t& size_bytes);

struct InputFile {
  std::string bytes;
  std::string problem;  ///< why there are none, in words that follow the file's name; empty if it was read
};
/// All of a regular file; the problem is why_no_input()'s, "is larger than 16 MB" or "cannot be read: …". For
/// those who word the error themselves.
InputFile read_input(const std::string& path, std::size_t max_bytes = kMaxTextBytes);

/// Its first bytes, up to so many, whatever its size.
InputFile read_beginning(const std::string& path, std::size_t max_bytes);

/// read_input(), or throws Error(unreadable_input) that names the file.
std::string input_bytes(const std::string& path, const std::string& expected,
                        std::size_t max_bytes = kMaxTextBytes);

/// "16 MB", for messages.
std::string bytes_text(std::size_t bytes);

}  // namespace vegard::sim
