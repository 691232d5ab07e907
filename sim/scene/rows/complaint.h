// What is wrong with a scene, as one says it to whoever wrote it.
#pragma once

#include <string>

namespace vegard::sim {

/// What is wrong with a value, before anyone knows in which file it stands.
struct Complaint {
  std::string problem, expected, hint;
  int element = -1;       ///< of a list: the number that is wrong, where it is one alone
  bool is_inert = false;  ///< of a number: nothing depends on it, free or not
};

/// Where a value stands, for messages.
struct Origin {
  std::string file;
  int line = 0;
  std::string key;
};

/// " in line 12", or nothing for 0: a line of a file that is not known.
std::string in_line(int line);

/// Throws Error(scene).
[[noreturn]] void complain(const Complaint& complaint, const Origin& origin);

}  // namespace vegard::sim
