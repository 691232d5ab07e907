#include "apps/describe.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "apps/exit_code.h"
#include "apps/output_files.h"
#include "apps/photo_metadata.h"
#include "apps/start_scene.h"
#include "fit/photo/photo_facts.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct Options {
  std::string photo, output;
  bool overwrite = false;
};

class Listing {
 public:
  explicit Listing(const std::string& title) : text_(title + "\n") {}

  void add(const char* name, const std::optional<std::string>& words) {
    if (words) text_ += fmt::format("  {:<24} {}\n", name, *words);
  }
  void add(const char* name, const std::optional<double>& value, const char* unit) {
    if (value) add(name, fmt::format("{:.8g}{}{}", *value, *unit == '\0' ? "" : " ", unit));
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

std::string file_name_of(const std::string& photo) {
  return std::filesystem::path(photo).filename().string();
}

int run(const Options& options) {
  if (same_file(options.photo, options.output)) refuse_same_file("--output", options.output, "the picture");
  const sim::PictureMetadata metadata = metadata_of(options.photo);
  const std::string name = file_name_of(options.photo);
  if (!options.output.empty()) {
    sim::WholeFile file(options.output, options.overwrite);
    file.write(start_scene(name, fit::photo_facts(metadata)));
    file.commit();
  }
  std::printf("%s", description_text(name, metadata).c_str());
  if (!options.output.empty()) std::printf("%s\n", options.output.c_str());
  return good;
}

}  // namespace

std::string description_text(const std::string& photo_name, const sim::PictureMetadata& metadata) {
  Listing said(photo_name + " says:");
  if (metadata.width_px && metadata.height_px)
    said.add("size", fmt::format("{} x {} pixels", *metadata.width_px, *metadata.height_px));
  if (metadata.orientation != 1)
    said.add("orientation", fmt::format("{}, undone here", metadata.orientation));
  said.add("make", metadata.make);
  said.add("model", metadata.model);
  said.add("lens", metadata.lens);
  said.add("focal length", metadata.focal_length_mm, "mm");
  said.add("35 mm equivalent", metadata.focal_length_35mm_mm, "mm");
  said.add("sensor", metadata.focal_plane_px_per_mm, "pixels per mm");
  said.add("exposure", metadata.exposure_s, "s");
  said.add("f-number", metadata.f_number, "");
  said.add("ISO", metadata.iso, "");
  if (metadata.taken_local)
    said.add("camera's clock", *metadata.taken_local + metadata.utc_offset.value_or(" (zone unknown)"));
  said.add("GPS time", metadata.gps_time_utc);
  said.add("latitude", metadata.latitude_deg, "deg");
  said.add("longitude", metadata.longitude_deg, "deg");
  said.add("altitude", metadata.altitude_m, "m");

  const fit::PhotoFacts facts = fit::photo_facts(metadata);
  std::string text = said.text() + "in a scene's keys:\n";
  for (const fit::PhotoFact& fact : facts.facts) text += "  " + fit::fact_text(fact) + "\n";
  if (facts.facts.empty()) text += "  nothing\n";
  for (const std::string& note : facts.notes) text += "note: " + note + "\n";
  return text;
}

void add_describe_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "describe",
      "Tell what a picture says of itself (place, time, lens, exposure), and write a scene of it");
  command->add_option("PHOTO", options->photo, "The picture")->required();
  command->add_option("-o,--output", options->output, "A scene to begin with")->type_name("SCENE.toml");
  command->add_flag("--overwrite", options->overwrite, "Replace an output that exists");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vegard::apps
