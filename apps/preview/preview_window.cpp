#include "apps/preview/preview_window.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>

#include "sim/base/module.h"

namespace vegard::apps {

bool has_display() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return true;
  }
  return false;
}

bool display_answers() {
  const PreviewWindowModule& module = sim::module_functions<PreviewWindowModule>();
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO), ::dup2(nowhere, STDOUT_FILENO);
    try {
      module.open("vegard").release();
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::unique_ptr<PreviewWindow> open_preview_window(const std::string& title) {
  return sim::module_functions<PreviewWindowModule>().open(title);
}

}  // namespace vegard::apps
