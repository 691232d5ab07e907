#include "sim/base/quiet_decoder.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <mutex>

namespace vegard::sim {
namespace {

std::mutex mutex;
int holders = 0;
/// The stream to which messages went before; -1 if they still go there.
std::atomic<int> kept_stream{-1};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

QuietDecoder::QuietDecoder() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (holders++ > 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  kept_stream =
      ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);  // fails where there is no standard error: nothing to keep
  if (kept_stream >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietDecoder::~QuietDecoder() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (--holders > 0 || kept_stream < 0) return;
  ::dup2(kept_stream, STDERR_FILENO);
  ::close(kept_stream.exchange(-1));
}

int error_stream() {
  const int kept = kept_stream.load();
  return kept >= 0 ? kept : STDERR_FILENO;
}

}  // namespace vegard::sim
