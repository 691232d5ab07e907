// The studio: a page in the user's browser, served by the program itself, for photographs and scenes of one
// folder.
//
// It is a face of the commands: what the page does, it does by running `vegard` with words that it shows.
// What these write are ordinary files and runs of the folder.
#pragma once

#include <string>

namespace vegard::apps {

struct StudioOptions {
  std::string
      opened;    ///< a photograph, scene or run inside the folder that the page begins with; may be empty
  int port = 0;  ///< on the loopback address; 0: any that is free
  bool opens_browser = true;
  bool from_desktop = false;  ///< started from a menu: shows the folder of `opened`, or the user's pictures
  double idle_s = 0.0;        ///< after so long without a request it ends by itself; 0: never
};

/// Serves the working directory, or what `from_desktop` says, until Ctrl-C, or until nobody asks for
/// anything. Throws Error(usage) if `opened` is not inside of it, Error(unreadable_input) if it does not
/// exist, and Error(unwritable_output) if the port cannot be had.
void run_studio(const StudioOptions& options);

}  // namespace vegard::apps
