// The files of the studio's page (apps/studio/page), compiled in by cmake/embed.cmake.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace vegard::apps {

struct StudioPage {
  std::string_view name;  ///< "studio.js"
  std::string_view bytes;
};

const std::vector<StudioPage>& studio_pages();

}  // namespace vegard::apps
