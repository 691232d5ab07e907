// The files of the studio's page (apps/studio/page), compiled in by cmake/embed.cmake.
#pragma once

#include <vector>

#include "apps/output/embedded_file.h"

namespace vegard::apps {

const std::vector<EmbeddedFile>& studio_pages();

}  // namespace vegard::apps
