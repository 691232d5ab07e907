#include "sim/base/picture/quiet_decoder.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace vegard::sim {
namespace {

std::mutex mutex;
int holders = 0;
int kept = -1;  ///< where the words went before; -1 if they still go there

}  // namespace

QuietDecoder::QuietDecoder() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (holders++ > 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  kept =
      ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);  // fails where there is no standard error: nothing to keep
  if (kept >= 0) ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietDecoder::~QuietDecoder() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (--holders > 0 || kept < 0) return;
  ::dup2(kept, STDERR_FILENO);
  ::close(kept);
  kept = -1;
}

}  // namespace vegard::sim
