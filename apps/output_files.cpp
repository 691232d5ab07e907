#include "apps/output_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "sim/base/error.h"

namespace vegard::apps {

namespace {

std::filesystem::path whole_name(const std::string& name) {
  std::error_code ignored;
  // weakly_canonical() leaves a name relative whose first part does not exist.
  return std::filesystem::weakly_canonical(std::filesystem::absolute(name, ignored), ignored);
}

}  // namespace

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  return whole_name(a) == whole_name(b);
}

bool is_inside(const std::string& file, const std::string& folder) {
  if (file.empty() || folder.empty()) return false;
  const std::filesystem::path inner = whole_name(file);
  std::filesystem::path outer = whole_name(folder);
  if (outer.filename().empty()) outer = outer.parent_path();  // of "run/"
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

void refuse_same_file(const std::string& key, const std::string& file, const std::string& other) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = "'" + file + "' is " + other + " as well";
  details.hint = "choose another name";
  throw sim::Error(sim::ErrorKind::usage, details);
}

}  // namespace vegard::apps
