#include "sim/base/file/random_bytes.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::sim {

RandomBytes::RandomBytes(std::string name, std::string_view bytes)
    : name_(std::move(name)), bytes_(bytes), size_(bytes.size()) {
  if (bytes.data() != nullptr) return;
  std::string problem;
  descriptor_ = open_input(name_, problem, size_);
  if (descriptor_ < 0) throw unreadable(name_, problem);
}

RandomBytes::~RandomBytes() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t RandomBytes::read(std::uint64_t place, char* to, std::size_t count) const {
  if (place >= size_) return 0;
  count = std::min(count, size_ - static_cast<std::size_t>(place));
  if (descriptor_ < 0) {
    std::copy_n(bytes_.data() + place, count, to);
    return count;
  }
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(descriptor_, to + done, count - done, static_cast<off_t>(place + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw unreadable(name_, "cannot be read: " + std::generic_category().message(errno));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string RandomBytes::bytes(std::uint64_t place, std::uint64_t count) const {
  std::string all;
  if (place <= size_ && count <= size_ - place) {
    all.resize(static_cast<std::size_t>(count));
    all.resize(read(place, all.data(), all.size()));
  }
  if (all.size() != count)
    throw unreadable(name_, "the file is truncated, or damaged: what it points to lies behind its end")
        .hint(kCopyAgain);
  return all;
}

}  // namespace vegard::sim
