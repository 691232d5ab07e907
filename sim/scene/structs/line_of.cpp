#include "sim/scene/structs/line_of.h"

namespace vegard::sim {

int line_of(const Scene& scene, const std::string& key) {
  for (std::string part = key; !part.empty();) {
    const auto line = scene.lines.find(part);
    if (line != scene.lines.end()) return line->second;
    const std::size_t dot = part.rfind('.');
    part = dot == std::string::npos ? "" : part.substr(0, dot);
  }
  return 0;
}

bool is_latitude_given(const Scene& scene) {
  return scene.lines.count("site.latitude_deg") > 0 || scene.site.latitude_deg != Site{}.latitude_deg;
}

bool is_longitude_given(const Scene& scene) {
  return scene.lines.count("site.longitude_deg") > 0 || scene.site.longitude_deg != Site{}.longitude_deg;
}

Error with_place(const Error& error, const Scene& scene) {
  const ErrorDetails& details = error.details();
  if (error.kind() != ErrorKind::scene || details.line != 0) return error;
  if (!details.file.empty() && details.file != scene.file) return error;
  return Error(error).file(scene.file).line(line_of(scene, details.key));
}

}  // namespace vegard::sim
