#include "sim/base/file/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/file/durable_rename.h"

namespace vegard::sim {
namespace fs = std::filesystem;
namespace {

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Throws unless there may be a file of that name at the end. Returns the file's permissions, 0 if it is new.
mode_t check_target(const std::string& target, bool overwrite) {
  struct stat status {};
  if (::stat(target.c_str(), &status) != 0) {
    if (errno != ENOENT) throw unwritable(target, errno);
    if (!overwrite && ::lstat(target.c_str(), &status) == 0)
      throw already_exists(target);  // a link to nowhere
    return 0;
  }
  if (!S_ISREG(status.st_mode)) {
    throw Error(ErrorKind::unwritable_output, S_ISDIR(status.st_mode) ? "is a directory" : "is a device")
        .file(target)
        .expected("the name of a file");
  }
  if (!overwrite) throw already_exists(target);
  return status.st_mode & 07777;
}

}  // namespace

WholeFile::WholeFile(const std::string& target, bool overwrite, Leftovers leftovers)
    : target_(target), resolved_(target), overwrite_(overwrite) {
  if (target.empty()) throw unwritable(target, ENOENT);
  const mode_t old_permissions = check_target(target_, overwrite_);
  std::error_code ignored;
  if (old_permissions != 0) resolved_ = fs::canonical(target_, ignored).string();
  if (resolved_.empty()) resolved_ = target_;

  if (leftovers == Leftovers::removed)
    for (const std::string& stale : stale_partials(resolved_, S_IFREG)) ::unlink(stale.c_str());

  int descriptor = -1;
  for (int attempt = 0; descriptor < 0; ++attempt) {
    temporary_ = partial_name(resolved_, attempt);
    descriptor = create_unfinished_file(temporary_);
    if (descriptor < 0 && errno != EEXIST) throw unwritable(target_, errno);
  }
  if (old_permissions != 0)
    ::fchmod(descriptor, old_permissions);  // a private file stays private; else as umask has it
  lock_ = PartialLock(descriptor);
}

WholeFile::~WholeFile() {
  lock_.release();  // before the file goes: network file systems keep what is open under yet another name
  if (!committed_) ::unlink(temporary_.c_str());
  forget_unfinished(temporary_);
}

void WholeFile::write(std::string_view bytes) {
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor < 0) throw unwritable(target_, errno);
  int error = write_all(descriptor, bytes);
  if (::close(descriptor) != 0 && error == 0) error = errno;  // network file systems report a full disk here
  if (error != 0) throw unwritable(target_, error);
}

void WholeFile::commit() {
  assert(!committed_);
  if (const int error = make_durable(temporary_); error != 0) throw unwritable(target_, error);
  {
    const Uninterrupted whole;
    if (overwrite_) {
      check_target(target_, true);  // what has become a directory or a device since is not replaced
      if (::rename(temporary_.c_str(), resolved_.c_str()) != 0) throw unwritable(target_, errno);
    } else {
      const int error = rename_to_free_name(temporary_, resolved_);
      if (error == EEXIST) throw already_exists(target_);
      if (error != 0) throw unwritable(target_, error);
    }
  }
  committed_ = true;
  lock_.release();
  // The file is whole under its name now; whether the name would outlive a power cut is the last thing to
  // try, and no reason to call the output missing.
  const std::string folder = fs::path(resolved_).parent_path().string();
  make_durable(folder.empty() ? "." : folder);
}

WholeFiles::WholeFiles(const std::vector<std::string>& names, bool overwrite) : overwrite_(overwrite) {
  for (const std::string& name : names) claim(name);
}

void WholeFiles::claim(const std::string& name) {
  if (!name.empty()) claimed_.emplace_back(name, std::make_unique<WholeFile>(name, overwrite_));
}

WholeFile& WholeFiles::file(const std::string& name) {
  const auto found = std::find_if(claimed_.begin(), claimed_.end(),
                                  [&](const auto& claimed) { return claimed.first == name; });
  assert(found != claimed_.end());
  if (std::find(written_.begin(), written_.end(), name) == written_.end()) written_.push_back(name);
  return *found->second;
}

void WholeFiles::write(const std::string& name, std::string_view bytes) {
  if (!name.empty()) file(name).write(bytes);
}

void WholeFiles::commit() {
  for (const std::string& name : written_) file(name).commit();
}

void write_whole(const std::string& path, std::string_view bytes, bool overwrite) {
  WholeFile file(path, overwrite);
  file.write(bytes);
  file.commit();
}

}  // namespace vegard::sim
