// The live view of a scene as one page that needs nothing else: its scripts (apps/live/page) and the scene's
// tables are inside of it.
#pragma once

#include <string>
#include <vector>

#include "apps/output/embedded_file.h"
#include "sim/render/live/live_view.h"

namespace vegard::apps {

/// The files of apps/live/page, compiled in by cmake/embed.cmake.
const std::vector<EmbeddedFile>& live_pages();

/// Returns the page. `name` is its title. The same view gives the same bytes.
std::string live_page(const sim::LiveView& view, const std::string& name);

}  // namespace vegard::apps
