// A file that cmake/embed.cmake has compiled into the program.
#pragma once

#include <string_view>

namespace vegard::apps {

struct EmbeddedFile {
  std::string_view name;  ///< without its folder: "studio.js"
  std::string_view bytes;
};

}  // namespace vegard::apps
