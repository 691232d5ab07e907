// Reads input files: regular files only, and up to a limit of size.
//
// A pipe would block the program forever, a device might have no end, and a folder can be opened but not
// read. Nothing here blocks: the type of a file is checked before it is opened, and again when it is open.
#pragma once

#include <cstddef>
#include <string>

namespace vegard::sim {

/// Size limit of texts: scenes, tables, lists, results.
constexpr std::size_t kMaxTextBytes = 16 << 20;
/// Size limit of pictures and similar files: decoders count bytes in an int.
constexpr std::size_t kMaxPictureBytes = (std::size_t{1} << 31) - 1;

/// Returns why `path` cannot be read as a file: "there is no such file", "is a directory", "is a pipe, not a
/// file", "cannot be opened: …"; empty if it can. Call it before a library opens the file by name.
std::string why_no_input(const std::string& path);

/// Opens a regular file for reading. Returns its descriptor, which the caller must close, and sets its size;
/// or returns -1 and sets the problem in the words of why_no_input().
int open_input(const std::string& path, std::string& problem, std::size_t& size_bytes);

struct InputFile {
  std::string bytes;
  std::string problem;  ///< why it was not read, in words that follow the file's name; empty: it was
};
/// Reads a whole regular file; the problem is that of why_no_input(), "is larger than 16 MB" or "cannot be
/// read: …". For callers that make their own message.
InputFile read_input(const std::string& path, std::size_t max_bytes = kMaxTextBytes);

/// Reads the first bytes of a file of any size, at most `max_bytes`.
InputFile read_beginning(const std::string& path, std::size_t max_bytes);

/// Returns the bytes of read_input(), or throws Error(unreadable_input) that names the file.
std::string input_bytes(const std::string& path, const std::string& expected,
                        std::size_t max_bytes = kMaxTextBytes);

/// Returns a size as text for messages, "16 MB".
std::string bytes_text(std::size_t bytes);

}  // namespace vegard::sim
