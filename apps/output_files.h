// Names of outputs that would take each other's place, or an input's.
#pragma once

#include <string>

namespace vegard::apps {

/// True if both names lead to one file, whether it exists yet or not: "./a.exr" and "a.exr", a link and what
/// it points to. An empty name is no file.
bool same_file(const std::string& a, const std::string& b);

/// True if the name leads to the folder itself or into it, at any depth. An empty name leads nowhere.
bool is_inside(const std::string& file, const std::string& folder);

/// Throws Error(usage): the file that the option `key` names is `other` ("an input") as well.
[[noreturn]] void refuse_same_file(const std::string& key, const std::string& file, const std::string& other);

}  // namespace vegard::apps
