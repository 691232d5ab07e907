// The studio's server: which requests are answered, and how.
//
// It listens on the loopback address only. Every path begins with a random word that only the page knows; a
// request whose Host is not this server, or whose Origin is another page, is refused; nothing is answered to
// other origins. Files of the folder are shown without access to the studio, since a page that somebody sent
// may be among them.
#pragma once

#include <memory>
#include <string>

namespace vegard::apps {

class StudioFolder;
class StudioJobs;

class StudioServer {
 public:
  /// Begins to serve, in threads of its own. Throws Error(unwritable_output) if the port cannot be had; 0:
  /// any.
  StudioServer(const StudioFolder& folder, StudioJobs& jobs, int port);
  ~StudioServer();
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;

  /// The address of the page, with the random word.
  std::string address() const;

  /// Time since the last request of the page, in seconds.
  double idle_s() const;

 private:
  class Routes;
  std::unique_ptr<Routes> routes_;
};

}  // namespace vegard::apps
