#include "tests/recovery/scorecard/one_case.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "fit/fit.h"
#include "fit/photo/photo.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/recovery/scorecard/draws.h"
#include "tests/recovery/scorecard/photograph.h"
#include "tests/recovery/scorecard/score.h"
#include "tests/recovery/scorecard/truth.h"

namespace vegard::scorecard {
namespace {

void put(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

struct Case {
  Truth truth;
  sim::Scene start;
  std::string file;  // its bytes
};

Case made(int scene, const CaseOptions& options) {
  Case result;
  result.truth = truth(options.set, scene);
  result.truth.scene.emission.tables = options.tables;
  result.start = options.from_truth ? start_at_truth(result.truth) : wide_start(result.truth);
  if (options.free_ends) result.start = with_free_ends(result.start);
  result.start.emission.uncertainty = options.uncertainty;
  if (options.drawn_physics) {
    const Draws draws(options.set, static_cast<std::uint32_t>(scene));
    const int modes = sim::emission_tables(result.truth.scene).modes().count();
    for (int k = 0; k < modes; ++k)
      result.truth.scene.emission.modes.push_back(draws.mode(static_cast<std::uint32_t>(k)));
  }
  const Photograph photo = photograph(result.truth, options.threads, options.is_lossless);
  result.file = photo.bytes;
  if (!options.keep.empty()) {
    std::filesystem::create_directories(options.keep);
    const std::string name = options.keep + fmt::format("/s{:04d}", scene);
    const std::string of = fmt::format("Scene {} of set {} of the recovery scorecard: ", scene, options.set);
    put(name + (options.is_lossless ? ".png" : ".jpg"), photo.bytes);
    put(name + "_truth.toml", sim::write_scene(photo.scene, of + "the truth."));
    put(name + "_start.toml", sim::write_scene(result.start, of + "what the fit starts from."));
  }
  return result;
}

/// Files can only be read by their names.
fit::Photo read(const std::string& bytes, int scene) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("vegard-scorecard-{}-{}.picture", getpid(), scene);
  put(file, bytes);
  fit::Photo photo = fit::read_photo(file.string(), fit::Decoding::automatic);
  std::filesystem::remove(file);
  return photo;
}

}  // namespace

void make_case(int scene, const CaseOptions& options) { made(scene, options); }

Row run_case(int scene, const CaseOptions& options) {
  const Case made_case = made(scene, options);
  const fit::Photo photo = read(made_case.file, scene);
  fit::FitOptions fit_options;
  fit_options.threads = options.threads;
  fit_options.max_evaluations = options.max_evaluations;
  const auto before = std::chrono::steady_clock::now();
  const fit::FitResult result = fit::fit_photo(made_case.start, photo, fit_options);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - before;
  Row row = score(made_case.truth, made_case.start, result);
  row.scene = scene;
  row.set = std::to_string(options.set);
  row.seconds = taken.count();
  return row;
}

}  // namespace vegard::scorecard
