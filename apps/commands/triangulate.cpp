#include "apps/commands/commands.h"

#include <memory>
#include <string>
#include <vector>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/triangulation/triangulation_texts.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct TriangulateRequest {
  std::string table, output, geojson, kml, earth = "wgs84";
  std::vector<std::string> cameras;
  std::vector<double> pointing_error_deg, clock_error_s, heights_km;
  fit::SightTableFormat format;
  double drift_km_s = 0.5;
  bool no_refraction = false, overwrite = false;
};

/// The number for a camera, of a list with one for each or one for all.
double number_for(const std::vector<double>& numbers, std::size_t camera) {
  return numbers[numbers.size() == 1 ? 0 : camera];
}

void check_count(const std::string& key, const std::vector<double>& numbers, std::size_t cameras) {
  if (numbers.size() > 1 && numbers.size() != cameras)
    throw usage_error(key,
                      std::to_string(numbers.size()) + " numbers for " + std::to_string(cameras) + " cameras",
                      "one for all cameras, or one for each");
}

std::vector<fit::PlacedCamera> cameras_of(const TriangulateRequest& request) {
  if (request.cameras.size() < 2)
    throw usage_error("--camera", "one camera gives no heights", "two or more",
                      "give --camera once for each of them");
  check_count("--pointing-error", request.pointing_error_deg, request.cameras.size());
  check_count("--clock-error", request.clock_error_s, request.cameras.size());
  std::vector<fit::PlacedCamera> cameras;
  for (std::size_t i = 0; i < request.cameras.size(); ++i) {
    std::optional<double> pointing;
    if (!request.pointing_error_deg.empty()) pointing = number_for(request.pointing_error_deg, i);
    cameras.push_back(fit::placed_camera(
        request.cameras[i], pointing,
        request.clock_error_s.empty() ? 0.0 : number_for(request.clock_error_s, i), !request.no_refraction));
  }
  return cameras;
}

int run_triangulate(const TriangulateRequest& request) {
  std::vector<std::string> inputs = request.cameras;
  inputs.push_back(request.table);
  protect_outputs({{"--output", request.output}, {"--geojson", request.geojson}, {"--kml", request.kml}},
                  inputs);
  fit::TriangulationSettings settings;
  settings.earth = request.earth == "sphere" ? fit::EarthShape::sphere : fit::EarthShape::wgs84;
  settings.is_refracted = !request.no_refraction;
  settings.drift_km_s = request.drift_km_s;
  if (!request.heights_km.empty()) {
    settings.heights = {request.heights_km[0], request.heights_km[1]};
    if (!(settings.heights.lowest_km < settings.heights.highest_km))
      throw usage_error("--heights", "the first height is not below the second one", "LOWEST,HIGHEST in km");
  }
  const std::vector<fit::PlacedCamera> cameras = cameras_of(request);
  std::vector<std::string> names;
  for (const fit::PlacedCamera& camera : cameras) names.push_back(camera.name);
  const std::vector<fit::SightedFeature> features = fit::read_sights(
      sim::input_bytes(request.table, "a table of pixels"), request.table, names, request.format);
  sim::WholeFiles files({request.output, request.geojson, request.kml}, request.overwrite);
  const fit::Triangulation all = fit::triangulation(cameras, features, settings);
  if (!request.output.empty()) files.write(request.output, fit::triangulation_csv(all));
  if (!request.geojson.empty()) files.write(request.geojson, fit::triangulation_geojson(all));
  if (!request.kml.empty()) files.write(request.kml, fit::triangulation_kml(all));
  files.commit();
  json_answer() = fit::triangulation_json(all);
  json_answer()["outputs"] = json_names(files.written());
  say_result(fit::triangulation_table(all));
  return all.is_good() ? good : doubted;
}

}  // namespace

void add_triangulate_command(Program& program) {
  const auto request = std::make_shared<TriangulateRequest>();
  const Command command = program.add(
      "triangulate", "Find heights and places of what two or more cameras see, by geometry alone");
  command
      .option("TABLE", request->table,
              "Columns name, camera, x_px, y_px and sigma_px: a name with one row for each camera is a "
              "point, one with several a curve")
      .type_name("SIGHTS.csv")
      .required();
  command
      .option("--camera", request->cameras,
              "A camera's file with its site; once for each camera, two or more")
      .type_name("CAMERA.toml")
      .repeated()
      .one_an_occurrence()
      .required();
  command.option("-o,--output", request->output, "A table of places, with errors").type_name("OUT.csv");
  command.option("--geojson", request->geojson, "Places and lines of sight for maps")
      .type_name("OUT.geojson");
  command.option("--kml", request->kml, "The same for Google Earth and others").type_name("OUT.kml");
  command
      .option("--pointing-error", request->pointing_error_deg,
              "Standard error of the cameras' directions, one or one for each (default: as their files say)")
      .delimiter(',')
      .type_name("DEG[,DEG]")
      .finite_range(0.0, 30.0);
  command
      .option("--clock-error", request->clock_error_s,
              "Standard error of the cameras' clocks, one or one for each (default: 0)")
      .delimiter(',')
      .type_name("S[,S]")
      .finite_range(0.0, 86400.0);
  command
      .option("--drift-km-s", request->drift_km_s,
              "How fast the light may drift: standard deviation of each horizontal component")
      .finite_range(0.0, 100.0)
      .shows_default();
  command
      .option("--pixel-error", request->format.error_px,
              "Standard error of a pixel, where the table has no sigma_px")
      .type_name("PX")
      .finite_range(1e-6, 1e4)
      .shows_default();
  command
      .option("--first-pixel", request->format.first_pixel,
              "Coordinate of the first pixel's centre in the table")
      .finite_range(-10.0, 10.0)
      .shows_default();
  command.option("--heights", request->heights_km, "Heights at which curves are matched (default: 60,500 km)")
      .delimiter(',')
      .expected(2)
      .type_name("LOW,HIGH")
      .finite_range(1.0, 2000.0);
  command
      .option("--earth", request->earth,
              "What heights count from: the ellipsoid, or the sphere on which this program's scenes lie")
      .one_of({"wgs84", "sphere"})
      .shows_default();
  command.flag("--no-refraction", request->no_refraction, "The cameras' directions are without refraction");
  command.flag("--overwrite", request->overwrite, "Replace outputs that exist");
  command.runs([request] { return run_triangulate(*request); });
}

}  // namespace vegard::apps
