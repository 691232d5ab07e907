// Messages to the user about what is wrong with a scene.
#pragma once

#include <string>

namespace vegard::sim {

/// What is wrong with a value, without the place of the value.
struct Complaint {
  std::string problem, expected, hint;
  int element = -1;  ///< index of the wrong number in a list, if there is only one
};

/// The place of a value, for messages.
struct Origin {
  std::string file;
  int line = 0;
  std::string key;
};

/// Returns " in line 12", or an empty text for 0 (unknown line).
std::string in_line(int line);

/// Throws Error(scene) with the complaint and its place.
[[noreturn]] void complain(const Complaint& complaint, const Origin& origin);

}  // namespace vegard::sim
