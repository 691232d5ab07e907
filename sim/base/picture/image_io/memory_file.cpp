#include "sim/base/picture/image_io/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

#include "sim/base/picture/image_io/library.h"

namespace vegard::sim {

MemoryFile::MemoryFile(std::string_view bytes, const std::string& name)
    : descriptor_(::memfd_create("image", MFD_CLOEXEC)) {
  while (descriptor_ >= 0 && !bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (descriptor_ >= 0 && bytes.empty()) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw failure(ErrorKind::unreadable_input, name, "there is not enough memory for this file");
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

}  // namespace vegard::sim
