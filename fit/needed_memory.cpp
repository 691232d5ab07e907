#include "fit/needed_memory.h"

#include <algorithm>

#include "fit/photo/averaging.h"
#include "sim/base/image.h"
#include "sim/render/needed_memory.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace {

// Of a photograph's pixel: its linear light and what of it is usable; beside them, while it is decoded,
// measured and looked at, the file's numbers and planes of one channel.
constexpr double kKeptOfPhoto = 15.0, kBesideOfPhoto = 30.0;
// Of the file's pixels while it is averaged, from above: numbers of 16 bits as floats, and their light where
// the sensor's part in it is undone first. A JPEG takes no more than its bytes.
constexpr double kOfAveraged = 27.0;
constexpr double kFitItself =
    40.0 * 1024.0 * 1024.0;              // what the solver and the report's plots take beside pictures
constexpr double kReportOfPixel = 60.0;  // pictures of the photograph, the model and what is left

}  // namespace

double fit_bytes(const sim::Scene& given, int threads) {
  const sim::Camera& camera = given.camera;
  const Averaging averaging = averaging_for_fit(given);
  const double averaged = averaging.any() ? kOfAveraged * camera.width * camera.height : 0.0;
  const sim::Scene scene = averaged_scene(given, averaging);
  const double pixels = static_cast<double>(scene.camera.width) * scene.camera.height;
  const double photos = std::max<double>(1.0, static_cast<double>(scene.fit.photos.size()));
  const auto& roi = scene.fit.roi_px;
  const double width = roi[2] > 0 ? roi[2] : scene.camera.width,
               height = roi[3] > 0 ? roi[3] : scene.camera.height;
  int free = 0;
  for (const sim::FreeParameter& one : scene.fit.free)
    free += one.path.empty() ? 1 : static_cast<int>(sim::resolve(scene, one.path).size());
  // As profile_model.cpp has it: a dozen cells to a band, of four pixels at most.
  const double cell_px = std::clamp(std::floor(width / std::max(1, scene.fit.bands) / 12.0), 1.0, 4.0);
  const double model = sim::model_bytes(scene, width * height / cell_px, free, threads);
  // Two of each photograph: one for the search, one for the last word.
  const double fitting = photos * (pixels * kKeptOfPhoto + 2.0 * model) + pixels * kBesideOfPhoto;
  const double reporting = photos * (pixels * kKeptOfPhoto + 2.0 * model) +
                           sim::render_bytes(scene, threads, {false, kReportOfPixel});
  return kFitItself + std::max({averaged, fitting, reporting});
}

double require_memory_of_fit(const sim::Scene& scene, int threads, const sim::MemoryLimit& limit) {
  constexpr double kHalfDark = 0.5;
  const double bytes = sim::kProgramBytes + fit_bytes(scene, threads);
  sim::require_memory(limit, limit.given ? bytes : kHalfDark * bytes, fit_in_words(scene), kLighterFit);
  return bytes;
}

std::string fit_in_words(const sim::Scene& scene) {
  return "a fit of " + sim::size_text(scene.camera.width, scene.camera.height) + " pixels";
}

}  // namespace vegard::fit
