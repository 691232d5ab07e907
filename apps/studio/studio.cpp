#include "apps/studio/studio.h"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "apps/preview/preview_window.h"
#include "apps/studio/studio_folder.h"
#include "apps/studio/studio_jobs.h"
#include "apps/studio/studio_server.h"
#include "sim/base/error.h"

namespace vegard::apps {
namespace {

/// Opens the address in the desktop's browser, if there is a desktop. The browser is a grandchild: nobody
/// waits for it.
void open_in_browser(const std::string& address) {
  if (!has_display()) return;
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::fork() == 0) {
      ::setsid();
      for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
      ::execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
    }
    ::_exit(0);
  }
  if (nowhere >= 0) ::close(nowhere);
}

/// The folder of the user's pictures as the desktop has it (user-dirs.dirs of xdg-user-dirs), else the home
/// folder.
std::filesystem::path pictures_folder() {
  namespace files = std::filesystem;
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  const files::path home = variable("HOME");
  const std::string settings = variable("XDG_CONFIG_HOME");
  std::ifstream lines((settings.empty() ? home / ".config" : files::path(settings)) / "user-dirs.dirs");
  const std::string key = "XDG_PICTURES_DIR=\"", relative = "$HOME/";
  std::error_code unknown;
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::string value = line.substr(key.size(), line.rfind('"') - key.size());
    const files::path folder = value.compare(0, relative.size(), relative) == 0
                                   ? home / value.substr(relative.size())
                                   : files::path(value);
    if (files::is_directory(folder, unknown)) return folder;
  }
  return home;
}

/// Works from now on in the folder that a desktop means, and returns what to begin with, in it.
std::string enter_folder_of(const std::string& opened) {
  namespace files = std::filesystem;
  std::error_code unknown, refused;
  const bool is_folder = files::is_directory(opened, unknown);
  const files::path file = opened.empty() ? files::path() : files::canonical(opened);
  const files::path folder = opened.empty() ? pictures_folder() : is_folder ? file : file.parent_path();
  files::current_path(folder, refused);
  if (refused) throw sim::unreadable(folder.string(), refused.message()).expected("a folder");
  return is_folder ? std::string() : file.filename().string();
}

/// In an address: all but letters, digits and "-_.~/" as %XX.
std::string escaped(const std::string& name) {
  std::string text;
  for (const unsigned char c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       std::string("-_.~/").find(c) != std::string::npos;
    constexpr const char* kDigits = "0123456789ABCDEF";
    if (plain)
      text += static_cast<char>(c);
    else
      text += {'%', kDigits[c / 16], kDigits[c % 16]};
  }
  return text;
}

}  // namespace

void run_studio(const StudioOptions& options) {
  if (!options.opened.empty() && !std::filesystem::exists(options.opened))
    throw sim::unreadable(options.opened, "there is no such file or folder");
  const std::string wanted = options.from_desktop ? enter_folder_of(options.opened) : options.opened;
  const StudioFolder folder;
  std::string opened;
  if (!wanted.empty()) {
    opened = folder.name_of(wanted);
    if (opened.empty())
      throw usage_error("vegard studio",
                        "'" + options.opened + "' is not in the working directory, which the studio shows",
                        "a file or a run below it", "change to its folder first, or add --desktop");
  }
  const std::atomic<bool>& stop = watch_for_interrupt();
  StudioJobs jobs;
  const StudioServer server(folder, jobs, options.port);
  const std::string address = server.address() + (opened.empty() ? "" : "#" + escaped(opened));
  say_text("The studio of this folder is open at\n  " + address + "\nCtrl-C closes it.\n");
  show_output();
  json_answer()["address"] = address;
  if (options.opens_browser) open_in_browser(address);
  const auto is_left = [&] { return options.idle_s > 0.0 && server.idle_s() > options.idle_s; };
  while (!stop.load() && !is_left()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace vegard::apps
