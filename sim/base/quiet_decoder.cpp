#include "sim/base/quiet_decoder.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace vegard::sim {
namespace {

std::mutex mutex;
int holders = 0;
int kept_stream = -1;  ///< where the words went before; -1 if they still go there

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
  ::close(kept_stream);
  kept_stream = -1;
}

}  // namespace vegard::sim
