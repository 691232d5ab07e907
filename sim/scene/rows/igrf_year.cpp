#include "sim/scene/rows/igrf_year.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

#include "sim/base/utc_time.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::sim {

double igrf_year(const Scene& scene) {
  const std::string& time = scene.site.time_utc;
  const auto refuse = [&](const std::string& problem) {
    complain({problem, "site.time_utc from 1900 to 2029, such as \"2019-09-01T05:00:00Z\"",
              "or field.model = \"dipole\""},
             {scene.file, line_of(scene, "field.model"), "field.model"});
  };
  std::optional<double> seconds = utc_seconds(time);
  if (!seconds && has_form(time, "0000-00-00")) seconds = utc_seconds(time + "T00:00:00Z");  // it is slow
  const std::string of_field = "the reference field (\"igrf\") ";
  if (time.empty()) refuse(of_field + "changes with the years, and the scene has no time");
  if (!seconds) refuse(of_field + "is not known for " + time);
  const std::string text = utc_text(*seconds);
  const int year = std::stoi(text.substr(0, 4));
  const auto start = [](int of) {
    const std::string digits = std::to_string(of);
    return utc_seconds(std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits +
                       "-01-01T00:00:00Z");
  };
  const std::optional<double> first = start(year), next = start(year + 1);
  if (year < static_cast<int>(kFirstIgrfYear) || year >= static_cast<int>(kLastIgrfYear) || !first || !next)
    refuse(of_field + "is not known for " + time);
  return year + (*seconds - *first) / (*next - *first);
}

}  // namespace vegard::sim
