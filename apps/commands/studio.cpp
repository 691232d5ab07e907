#include "apps/commands/commands.h"

#include <memory>
#include <optional>

#include "apps/options/exit_code.h"
#include "apps/studio/studio.h"

namespace vegard::apps {

void add_studio_command(Program& program) {
  struct StudioWords {
    StudioOptions options;
    bool no_browser = false;
    std::optional<double> idle_s;
  };
  const auto words = std::make_shared<StudioWords>();
  const Command command =
      program.add("studio", "Open this folder's photographs and scenes as a page in the browser");
  command.option("OPENED", words->options.opened, "A photograph, scene or run of the folder to begin with");
  command.option("--port", words->options.port, "Port on the loopback address (0: any that is free)")
      .range(0, 65535);
  command
      .option("--idle", words->idle_s,
              "End when no page has asked for anything for so many seconds (0: never; by default so, with "
              "--desktop after 600)")
      .type_name("SECONDS")
      .range(0.0, 1e6);
  command.flag("--no-browser", words->no_browser, "Only print the address");
  command.flag("--desktop", words->options.from_desktop,
               "As from a desktop's menu: show the folder of OPENED, or that of your pictures");
  command.runs([words] {
    constexpr double kIdleOfDesktop_s = 600.0;  // nobody is there to press Ctrl-C
    words->options.idle_s = words->idle_s.value_or(words->options.from_desktop ? kIdleOfDesktop_s : 0.0);
    words->options.opens_browser = !words->no_browser;
    run_studio(words->options);
    return static_cast<int>(good);
  });
}

}  // namespace vegard::apps
