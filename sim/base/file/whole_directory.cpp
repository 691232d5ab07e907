#include "sim/base/file/whole_directory.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <filesystem>

#include "sim/base/file/durable_rename.h"
#include "sim/base/file/output_error.h"

namespace vegard::sim {
namespace fs = std::filesystem;
namespace {

/// Throws unless the target is free or a run that may be replaced. Returns whether there is one.
bool check_target(const std::string& target, bool overwrite, const std::string& mark,
                  const std::string& kind) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (!fs::exists(status)) {
    // A link to nowhere counts as taken: the rename would not replace it.
    if (fs::is_symlink(fs::symlink_status(target, error))) throw already_exists(target);
    return false;
  }
  ErrorDetails details;
  details.file = target;
  details.hint = "choose another name";
  if (!fs::is_directory(status)) {
    details.problem = "exists and is not a directory";
    throw Error(ErrorKind::existing_output, details);
  }
  if (!overwrite) throw already_exists(target);
  const bool is_run = fs::exists(fs::path(target) / mark, error) || fs::is_empty(target, error);
  if (!is_run) {
    details.problem = "is not replaced: it has no " + mark + ", so it is not " + kind;
    throw Error(ErrorKind::existing_output, details);
  }
  return true;
}

/// "runs/h000/" names what "runs/h000" does. Nothing else is simplified: "link/.." need not be ".".
std::string without_trailing_slash(std::string target) {
  while (target.size() > 1 && target.back() == '/') target.pop_back();
  return target;
}

}  // namespace

WholeDirectory::WholeDirectory(const std::string& target, bool overwrite, const std::string& mark,
                               const std::string& kind)
    : target_(without_trailing_slash(target)),
      resolved_(target_),
      overwrite_(overwrite),
      mark_(mark),
      kind_(kind) {
  if (target_.empty()) throw unwritable(target, ENOENT);
  if (check_target(target_, overwrite_, mark_, kind_)) {
    std::error_code error;
    resolved_ = fs::canonical(target_, error).string();  // also gives "." and ".." a name that can be renamed
    if (error) throw unwritable(target_, error.value());
  }

  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path parent = fs::path(resolved_).parent_path(); !parent.empty() && !fs::exists(parent, ignored);
       parent = parent.parent_path()) {
    missing.push_back(parent);
  }
  const auto give_up = [this](int error_number) {
    for (auto parent = made_parents_.rbegin(); parent != made_parents_.rend(); ++parent) {
      ::rmdir(parent->c_str());
    }
    return unwritable(target_, error_number);
  };
  for (auto parent = missing.rbegin(); parent != missing.rend(); ++parent) {
    if (::mkdir(parent->c_str(), 0777) == 0) {
      made_parents_.push_back(parent->string());
    } else if (errno != EEXIST) {
      throw give_up(errno);
    }
  }
  for (int attempt = 0;; ++attempt) {
    temporary_ = partial_name(resolved_, attempt);
    if (::mkdir(temporary_.c_str(), 0777) == 0) break;
    if (errno != EEXIST) throw give_up(errno);
  }
}

WholeDirectory::~WholeDirectory() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  // rmdir spares a folder in which someone else has put something by now.
  for (auto parent = made_parents_.rbegin(); parent != made_parents_.rend(); ++parent)
    ::rmdir(parent->c_str());
}

void WholeDirectory::commit() {
  assert(!committed_);
  std::error_code walk_error;
  for (fs::recursive_directory_iterator entry(temporary_, walk_error), end; entry != end && !walk_error;
       entry.increment(walk_error)) {
    if (entry->is_symlink()) continue;
    if (const int error = make_durable(entry->path().string()); error != 0) throw unwritable(target_, error);
  }
  if (walk_error) throw unwritable(target_, walk_error.value());
  if (const int error = make_durable(temporary_); error != 0) throw unwritable(target_, error);

  const bool replaces = check_target(target_, overwrite_, mark_, kind_);
  const int error =
      replaces ? exchange_directories(temporary_, resolved_) : rename_to_free_name(temporary_, resolved_);
  if (error == EEXIST) throw already_exists(target_);
  if (error != 0) throw unwritable(target_, error);
  committed_ = true;
  const std::string parent = fs::path(resolved_).parent_path().string();
  make_durable(parent.empty() ? "." : parent);
  if (replaces) {
    std::error_code
        ignored;  // the run itself is in place; what is left of the old one bears the temporary's name
    fs::remove_all(temporary_, ignored);
  }
}

}  // namespace vegard::sim
