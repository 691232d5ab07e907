#include "apps/filter_options.h"

#include "apps/usage_error.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::apps {

void add_filter_option(CLI::App& command, std::vector<std::string>& words) {
  command
      .add_option(
          "--line", words,
          "A grey picture through the filter of one emission line, 557.7=a.fits; one to three of them, "
          "in place of a photograph")
      ->type_name("NM=FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<fit::FilterFile> filter_files(const std::vector<std::string>& words) {
  std::vector<fit::FilterFile> files;
  for (const std::string& word : words) files.push_back(fit::filter_file(word));
  return files;
}

void check_filters(const sim::Scene& scene) {
  if (sim::sees_through_filters(scene)) return;
  throw usage_error("--line", "the scene's sensor.response is \"" + scene.sensor.response + "\"",
                    "\"filters\", an imager with a filter per line", "--set sensor.response=filters");
}

}  // namespace vegard::apps
