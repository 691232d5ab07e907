// Maps of precipitation from photographs.
#include <pybind11/stl.h>

#include <optional>

#include "fit/map/curtains/curtains.h"
#include "fit/map/curtains/map_verdicts.h"
#include "fit/map/map_fit.h"
#include "fit/map/rasterised_map.h"
#include "fit/report/map_run.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_work.h"
#include "sim/base/error.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::python {
namespace {

struct Map {
  std::shared_ptr<const fit::MapResult> result;
  std::shared_ptr<const fit::RasterisedMap> image;
  std::shared_ptr<const std::vector<fit::Curtain>> curtains;
  std::shared_ptr<const fit::MapRunFacts> facts;
};

/// The spectrum that words and numbers name; a number that the kind does not have is refused, as on the
/// command line.
sim::ElectronSpectrum electron_spectrum(const std::string& word, const std::optional<double>& spread,
                                        const std::optional<double>& kappa) {
  sim::ElectronSpectrum spectrum;
  spectrum.kind = sim::spectrum_kind(word);
  if (sim::spectrum_word(spectrum.kind) != word)
    throw sim::Error(sim::ErrorKind::usage, "'" + word + "' is no spectrum of electrons")
        .key("spectrum")
        .expected("maxwellian, gaussian, mono or kappa");
  const auto take = [&](const char* name, const std::optional<double>& value,
                        sim::ElectronSpectrum::Kind kind, double least, double most, double& to) {
    if (!value) return;
    if (spectrum.kind != kind)
      throw sim::Error(sim::ErrorKind::usage, "a spectrum of the kind '" + word + "' has no such number")
          .key(name)
          .expected(std::string("spectrum=\"") + sim::spectrum_word(kind) + "\" beside it");
    require_within(name, *value, least, most);
    to = *value;
  };
  using Kind = sim::ElectronSpectrum::Kind;
  constexpr double kMinSpread = 0.01, kMaxSpread = 1.0;
  take("spread", spread, Kind::gaussian, kMinSpread, kMaxSpread, spectrum.spread);
  take("kappa", kappa, Kind::kappa, sim::kMinKappa, sim::kMaxKappa, spectrum.kappa);
  return spectrum;
}

Map map_scene(const SceneHandle& self, const py::object& photo, int threads, int replicates, double sparsity,
              double farthest_km, double altitude_scale, const std::string& spectrum,
              const std::optional<double>& spread, const std::optional<double>& kappa,
              const py::object& progress, const py::object& stop) {
  require_threads(threads);
  require_within("replicates", replicates, 0.0, 1000.0);
  require_within("sparsity", sparsity, 0.0, 1000.0);
  require_within("farthest_km", farthest_km, 0.0, 2000.0);
  require_within("altitude_scale", altitude_scale, 0.9, 1.2);
  const sim::ElectronSpectrum electrons = electron_spectrum(spectrum, spread, kappa);
  const std::shared_ptr<const sim::Scene> scene = self.scene;
  const auto given = photographs_given(*scene, photo, false);
  LongWork long_work(progress, stop);
  return result_of<Map>(long_work, [&] {
    std::vector<fit::Photo> photos;
    for (const auto& one : given) photos.push_back(*one);
    auto facts = std::make_shared<fit::MapRunFacts>();
    facts->inputs = inputs_of_work(*scene, photos);
    facts->command = "vegard.Scene.map() in Python";
    fit::MapOptions options;
    options.threads = threads;
    options.replicates = replicates;
    options.sparsity = sparsity;
    options.farthest_km = farthest_km;
    options.altitude_scale = altitude_scale;
    options.spectrum = electrons;
    options.stop = long_work.stop();
    options.progress = [&](const std::string& stage, double chi2_per_value, double share) {
      long_work.tell({stage, share, 0, chi2_per_value});
    };
    auto result = std::make_shared<const fit::MapResult>(
        sim::placing_errors(*scene, [&] { return fit::map_photos(*scene, photos, options); }));
    for (std::size_t i = 0; i < photos.size(); ++i)
      facts->decodings.emplace_back(result->photos[i].name, photos[i].decoding);
    facts->faint = fit::find_faint_curtains(*result);
    return Map{result, std::make_shared<const fit::RasterisedMap>(fit::rasterised_map(*result)),
               std::make_shared<const std::vector<fit::Curtain>>(fit::find_curtains(*result)), facts};
  });
}

/// A plane of the map over the raster: rows to the north, of an image whose first row is the northernmost.
py::array_t<float> plane(const Map& self, int channel) {
  const sim::Image& image = self.image->planes;
  const py::ssize_t across = image.channels() * sizeof(float), down = across * image.width;
  const float* southernmost = image.data.data() + image.index(0, image.height - 1, channel);
  return array_over(self.image, southernmost, {image.height, image.width}, {-down, across});
}

py::array_t<double> axis(double first, double step, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(first + i * step);
  return array_of(std::move(places), {count});
}

/// The columns of curtains.csv.
struct CurtainColumn {
  const char* name;
  double (*value_at)(const fit::CurtainPoint&);
};
constexpr CurtainColumn kColumns[] = {
    {"east_km", [](const fit::CurtainPoint& p) { return p.foot_km.east; }},
    {"north_km", [](const fit::CurtainPoint& p) { return p.foot_km.north; }},
    {"distance_km", [](const fit::CurtainPoint& p) { return p.distance_km; }},
    {"azimuth_deg", [](const fit::CurtainPoint& p) { return p.azimuth_deg; }},
    {"lower_border_km", [](const fit::CurtainPoint& p) { return p.lower_border_km.value; }},
    {"energy_flux_mw_m2", [](const fit::CurtainPoint& p) { return p.flux_mw_m2.value; }},
    {"energy_kev", [](const fit::CurtainPoint& p) { return p.energy_kev.value; }},
    {"width_km", [](const fit::CurtainPoint& p) { return p.width_km.value; }},
    {"lateral_error_km", [](const fit::CurtainPoint& p) { return p.lateral_error_km; }},
    {"distance_error_km", [](const fit::CurtainPoint& p) { return p.distance_error_km; }},
    {"lower_border_error_km", [](const fit::CurtainPoint& p) { return p.lower_border_km.error; }},
    {"energy_flux_error_mw_m2", [](const fit::CurtainPoint& p) { return p.flux_mw_m2.error; }},
    {"energy_error_kev", [](const fit::CurtainPoint& p) { return p.energy_kev.error; }},
    {"width_error_km", [](const fit::CurtainPoint& p) { return p.width_km.error; }},
    {"border_in_view", [](const fit::CurtainPoint& p) { return p.border_in_view ? 1.0 : 0.0; }},
    {"at_edge", [](const fit::CurtainPoint& p) { return p.at_edge ? 1.0 : 0.0; }},
    {"energy_limit", [](const fit::CurtainPoint& p) { return static_cast<double>(p.energy_limit); }},
    {"found_in", [](const fit::CurtainPoint& p) { return p.found_in; }}};

py::list curtains_of(const Map& self) {
  py::list all;
  for (const fit::Curtain& curtain : *self.curtains) {
    py::dict columns;
    for (const CurtainColumn& column : kColumns) {
      std::vector<double> values;
      for (const fit::CurtainPoint& point : curtain.points) values.push_back(column.value_at(point));
      const auto count = static_cast<py::ssize_t>(values.size());
      columns[column.name] = array_of(std::move(values), {count});
    }
    const auto count = static_cast<py::ssize_t>(curtain.points.size());
    columns["probability"] =
        array_of(std::vector<double>(curtain.points.size(), curtain.probability), {count});
    columns["diffuse"] =
        array_of(std::vector<double>(curtain.points.size(), curtain.is_diffuse_patch ? 1.0 : 0.0), {count});
    all.append(columns);
  }
  return all;
}

void write(const Map& self, const py::object& directory, bool overwrite) {
  const auto name = py::module_::import("os").attr("fspath")(directory).cast<std::string>();
  const py::gil_scoped_release others_may_run;
  fit::write_map_run(name, overwrite, *self.result, *self.curtains, *self.facts);
}

}  // namespace

void bind_maps(py::module_& m, py::class_<SceneHandle>& scene) {
  py::class_<fit::QuantityVerdict>(m, "QuantityVerdict", "What to believe of one quantity of a map.")
      .def_readonly("quantity", &fit::QuantityVerdict::quantity, "'distance of the lower border' (str).")
      .def_property_readonly(
          "trust", [](const fit::QuantityVerdict& v) { return fit::trust_name(v.trust); },
          "'good', 'doubtful' or 'unconstrained' (str).")
      .def_readonly("value", &fit::QuantityVerdict::value, "What was found, in words with errors (str).")
      .def_readonly("reason", &fit::QuantityVerdict::reason, "(str)")
      .def("__repr__", [](const fit::QuantityVerdict& v) {
        return "<vegard.QuantityVerdict " + v.quantity + ": " + fit::trust_name(v.trust) + ">";
      });
  const auto plane_of = [](int channel) {
    return [channel](const Map& self) { return plane(self, channel); };
  };
  py::class_<Map>(
      m, "Map",
      "Precipitation over the ground. Planes are float32 of shape (rows, columns), rows to the north and\n"
      "columns to the east, of feet at 110 km altitude in the site's tangent plane; views of the map's own\n"
      "buffer. NaN where no picture shows it.")
      .def_property_readonly("energy_flux_mw_m2", plane_of(0), "(rows, columns): energy flux in mW m^-2.")
      .def_property_readonly("energy_kev", plane_of(1),
                             "(rows, columns): E0 of the electrons in keV; NaN where there is no flux.")
      .def_property_readonly("relative_flux_error", plane_of(2),
                             "(rows, columns): standard error of the flux, a share of it.")
      .def_property_readonly("ln_energy_error", plane_of(3), "(rows, columns): standard error of ln(E0).")
      .def_property_readonly("sensitivity", plane_of(4),
                             "(rows, columns): signal to noise ratio of 1 mW m^-2 in a cell by itself.")
      .def_property_readonly(
          "east_km",
          [](const Map& s) {
            return axis(s.image->raster.west_km, s.image->raster.step_km, s.image->raster.columns);
          },
          "(columns,), float64: middles of the columns, km to the east of the site.")
      .def_property_readonly(
          "north_km",
          [](const Map& s) {
            return axis(s.image->raster.south_km, s.image->raster.step_km, s.image->raster.rows);
          },
          "(rows,), float64: middles of the rows, km to the north of the site.")
      .def_property_readonly(
          "curtains", &curtains_of,
          "The ridges of the flux, that which carries most energy first: a dict of the columns of "
          "curtains.csv,\neach (points,) float64, from one end to the other (list of dict).")
      .def_property_readonly(
          "verdicts", [](const Map& s) { return fit::map_verdicts(*s.result, *s.curtains); },
          "What to believe of it (list of QuantityVerdict).")
      .def_property_readonly(
          "flux_is_absolute", [](const Map& s) { return fit::is_absolute(*s.result); },
          "Whether the sensor's scale is known; else the flux is right up to a factor (bool).")
      .def_property_readonly(
          "chi2_per_value", [](const Map& s) { return s.result->chi2_per_value(); }, "(float)")
      .def_property_readonly(
          "interrupted", [](const Map& s) { return s.result->interrupted; },
          "Whether `stop` has cut it short (bool).")
      .def("write", &write, py::arg("directory"), py::kw_only(), py::arg("overwrite") = false,
           "Writes the map's directory with its report, as `vegard map --out` does; whole or not at all.")
      .def("__repr__", [](const Map& s) {
        return "<vegard.Map of " + sim::size_text(s.image->raster.columns, s.image->raster.rows) +
               " cells, " + std::to_string(s.curtains->size()) + " curtains>";
      });
  const fit::MapOptions usual;
  scene.def(
      "map", &map_scene, py::arg("photo") = py::none(), py::kw_only(), py::arg("threads") = 0,
      py::arg("replicates") = usual.replicates, py::arg("sparsity") = usual.sparsity,
      py::arg("farthest_km") = usual.farthest_km, py::arg("altitude_scale") = usual.altitude_scale,
      py::arg("spectrum") = "maxwellian", py::arg("spread") = py::none(), py::arg("kappa") = py::none(),
      py::arg("progress") = py::none(), py::arg("stop") = py::none(),
      "Maps the precipitation that a photograph shows, of any shape (Map): what `vegard map` does.\n\n"
      "photo: a Photo, the name of a file, a list of Photo, or None for those of the scene's [[fit.photo]]\n"
      "threads: 0 for all cores; the result is the same\n"
      "replicates: perturbed solutions from which errors follow; 0: no errors\n"
      "sparsity: what a lit cell costs in chi2 / 2; 0: left-out blocks of the picture choose\n"
      "farthest_km: how far the ground reaches; 0: as far as the picture shows a lower border\n"
      "altitude_scale: at so many times the tables' altitudes stands all light\n"
      "spectrum: of the electrons: 'maxwellian', 'gaussian', 'mono' or 'kappa'\n"
      "spread: standard deviation of a Gaussian over E0, 0.01 to 1; None: 0.25\n"
      "kappa: of a kappa distribution; None: 5\n"
      "progress: called with a Progress now and then\n"
      "stop: a threading.Event; once it is set, the best so far is returned. Ctrl-C raises "
      "KeyboardInterrupt.");
}

}  // namespace vegard::python
