#include "apps/output_files.h"

#include <filesystem>
#include <system_error>

#include "sim/base/error.h"

namespace vegard::apps {

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  // weakly_canonical() leaves a name relative whose first part does not exist.
  const auto whole = [&](const std::string& name) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(name, ignored), ignored);
  };
  return whole(a) == whole(b);
}

void refuse_same_file(const std::string& key, const std::string& file, const std::string& other) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = "'" + file + "' is " + other + " as well";
  details.hint = "choose another name";
  throw sim::Error(sim::ErrorKind::usage, details);
}

}  // namespace vegard::apps
