#include "sim/base/file/whole_directory.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/durable_rename.h"
#include "sim/base/text.h"

namespace vegard::sim {
namespace fs = std::filesystem;
namespace {

Error not_replaced(const std::string& target, const std::string& why, const std::string& hint) {
  return Error(ErrorKind::existing_output, "is not replaced: " + why).file(target).hint(hint);
}

/// Entries that the kind does not know, in the order of their names, as messages call them. Throws
/// Error(unwritable_output) if the folder cannot be read to its end: what is not seen cannot be spared.
std::vector<std::string> strangers(const std::string& directory, const KnownFolder& known,
                                   const std::string& target) {
  std::vector<std::string> found;
  std::error_code error;
  fs::directory_iterator entry(directory, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code gone;
    const fs::file_status status = entry->symlink_status(gone);  // a link is not followed
    if (fs::is_directory(status))
      found.push_back(name + " (a folder)");
    else if (fs::is_symlink(status))
      found.push_back(name + " (a link)");
    else if (!fs::is_regular_file(status) || !known.has(name))
      found.push_back(name);
  }
  if (error) throw unwritable(target, error.value());
  std::sort(found.begin(), found.end());
  return found;
}

/// Throws if anything lies in the directory that is not known. `target`: what the user calls it.
void refuse_strangers(const std::string& directory, const KnownFolder& known, const std::string& target,
                      const std::string& words) {
  const std::vector<std::string> found = strangers(directory, known, target);
  if (found.empty()) return;
  constexpr std::size_t kMaxNamed = 3;
  std::string names = joined({found.begin(), found.begin() + std::min(found.size(), kMaxNamed)});
  if (found.size() > kMaxNamed) names += " and " + std::to_string(found.size() - kMaxNamed) + " more";
  throw not_replaced(
      target,
      names + (found.size() == 1 ? " in it is" : " in it are") + " not what vegard wrote for " + words,
      "move what is to be kept, or choose another name");
}

/// A folder's place in the tree of all files, by which two names of one folder are known.
bool is_same_folder(const struct stat& a, const char* path) {
  struct stat b {};
  return path != nullptr && *path != '\0' && ::stat(path, &b) == 0 && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

/// True if a disk, or another part of one, is mounted there: such a folder cannot be renamed.
bool is_mount_point(const std::string& directory) {
  struct statx status {};
  if (::statx(AT_FDCWD, directory.c_str(), 0, STATX_BASIC_STATS, &status) != 0) return false;
  return (status.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0 &&
         (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// Throws for folders that are more than what lies in them.
void refuse_special_place(const std::string& target) {
  const std::string hint = "choose another name";
  struct stat status {};
  if (::stat(target.c_str(), &status) != 0) throw unwritable(target, errno);
  if (is_same_folder(status, "."))
    throw not_replaced(target, "it is the current folder", "call vegard from another folder, or " + hint);
  if (is_same_folder(status, std::getenv("HOME"))) throw not_replaced(target, "it is the home folder", hint);
  if (is_same_folder(status, "/") || is_mount_point(target))
    throw not_replaced(target, "a file system is mounted there", "choose the name of a folder in it");
}

/// Throws unless the target is free or an output that may be replaced. Returns whether there is one.
bool check_target(const std::string& target, bool overwrite, const DirectoryKind& kind) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (!fs::exists(status)) {
    // A link to nowhere counts as taken: the rename would not replace it.
    if (fs::is_symlink(fs::symlink_status(target, error))) throw already_exists(target);
    return false;
  }
  if (!fs::is_directory(status)) {
    throw Error(ErrorKind::existing_output, "exists and is not a directory")
        .file(target)
        .hint("choose another name");
  }
  if (!overwrite) throw already_exists(target);
  refuse_special_place(target);
  const bool is_empty = fs::is_empty(target, error);
  if (error) throw unwritable(target, error.value());
  if (is_empty) return true;
  const KnownFolder known = kind.look(target);
  if (!known.objection.empty())
    throw not_replaced(target, known.objection + ", so it is not " + kind.words, "choose another name");
  refuse_strangers(target, known, target, kind.words);
  return true;
}

/// Deletes the files of `directory` that are known, one by one, and then the folder if nothing is left in it.
/// In a temporary, files on their way are known too, by the number of the same process.
void remove_known(const std::string& directory, const DirectoryKind& kind) {
  const KnownFolder known = kind.look(directory);
  const std::optional<Partial> owner = partial_of(fs::path(directory).filename().string());
  const auto is_known = [&](const std::string& name) {
    const std::optional<Partial> partial = partial_of(name);
    return partial ? owner && partial->process == owner->process : known.has(name);
  };
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(directory, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code gone;
    if (fs::is_regular_file(entry->symlink_status(gone)) && is_known(name) &&
        std::find(kind.marks.begin(), kind.marks.end(), name) == kind.marks.end())
      names.push_back(name);
  }
  for (const std::string& mark : kind.marks)
    if (known.has(mark)) names.push_back(mark);
  for (const std::string& name : names) ::unlink((directory + "/" + name).c_str());  // never a folder
  ::rmdir(directory.c_str());                                                        // only if it is empty
}

/// "runs/h000/" names what "runs/h000" does. Nothing else is simplified: "link/.." need not be ".".
std::string without_trailing_slash(std::string target) {
  while (target.size() > 1 && target.back() == '/') target.pop_back();
  return target;
}

}  // namespace

WholeDirectory::WholeDirectory(const std::string& target, bool overwrite, DirectoryKind kind)
    : named_(target),
      target_(without_trailing_slash(target)),
      resolved_(target_),
      overwrite_(overwrite),
      kind_(std::move(kind)) {
  if (target_.empty()) throw unwritable(target, ENOENT);
  if (check_target(target_, overwrite_, kind_)) {
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
  for (const std::string& stale : stale_partials(resolved_, S_IFDIR)) remove_known(stale, kind_);
  for (int attempt = 0;; ++attempt) {
    temporary_ = partial_name(resolved_, attempt);
    if (create_unfinished_directory(temporary_) == 0) break;
    if (errno != EEXIST) throw give_up(errno);
  }
  lock_ = PartialLock(::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

WholeDirectory::~WholeDirectory() {
  if (!is_ours_) return;
  // By the descriptor that it has: there may be none left for a search.
  lock_.delete_content();
  lock_.release();
  std::error_code ignored;
  if (::rmdir(temporary_.c_str()) != 0) fs::remove_all(temporary_, ignored);
  forget_unfinished(temporary_);
  // rmdir spares a folder in which someone else has put something by now.
  for (auto parent = made_parents_.rbegin(); parent != made_parents_.rend(); ++parent)
    ::rmdir(parent->c_str());
}

void WholeDirectory::commit() {
  assert(is_ours_);
  std::error_code walk_error;
  for (fs::recursive_directory_iterator entry(temporary_, walk_error), end; entry != end && !walk_error;
       entry.increment(walk_error)) {
    if (entry->is_symlink()) continue;
    if (const int error = make_durable(entry->path().string()); error != 0) throw unwritable(target_, error);
  }
  if (walk_error) throw unwritable(target_, walk_error.value());
  if (const int error = make_durable(temporary_); error != 0) throw unwritable(target_, error);

  if (!check_target(target_, overwrite_, kind_)) {
    const int error = [&] {
      const Uninterrupted whole;
      const int refused = rename_to_free_name(temporary_, resolved_);
      if (refused == 0) forget_unfinished(temporary_);
      return refused;
    }();
    if (error == EEXIST) throw already_exists(target_);
    if (error != 0) throw unwritable(target_, error);
    is_ours_ = false;
  } else {
    const int error = [&] {
      const Uninterrupted whole;
      forget_unfinished(temporary_);  // from now on the name may be that of the old folder
      return exchange_directories(temporary_, resolved_);
    }();
    if (error != 0) throw unwritable(target_, error);
    is_ours_ = false;  // it is the old folder that bears the temporary's name now
    // Between the look and the exchange someone may have put something into the old folder. It has a name of
    // its own now, under which nobody looks for it.
    try {
      refuse_strangers(temporary_, kind_.look(temporary_), target_, kind_.words);
    } catch (const Error&) {
      is_ours_ = exchange_directories(temporary_, resolved_) == 0;
      throw;
    }
  }
  const std::string parent = fs::path(resolved_).parent_path().string();
  make_durable(parent.empty() ? "." : parent);
  remove_known(temporary_, kind_);  // if there was an old one; what is left of it bears the temporary's name
}

void WholeDirectory::fill(const std::function<void()>& write) {
  try {
    write();
    commit();
  } catch (const Error& error) {
    const std::string& file = error.details().file;
    if (file.compare(0, temporary_.size(), temporary_) != 0) throw;
    throw Error(error).file(named_ + file.substr(temporary_.size()));
  }
}

}  // namespace vegard::sim
