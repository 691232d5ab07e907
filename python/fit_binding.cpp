// Fits of scenes to photographs.
#include <pybind11/stl.h>

#include <optional>

#include "fit/answer/input_files.h"
#include "fit/map/curtains/stored_map.h"
#include "fit/needed_memory.h"
#include "fit/report/run_directory.h"
#include "fit/report/table/result_json.h"
#include "fit/scene_fit.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_work.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::python {
namespace {

/// With the photographs, which a run's directory shows.
struct Fit {
  std::shared_ptr<const fit::FitResult> result;
  std::shared_ptr<const std::vector<fit::Photo>> photos;
};

struct FitPhoto {
  std::shared_ptr<const fit::FitResult> result;
  const fit::FittedPhoto* photo = nullptr;
};

struct FitWords {
  int threads = 0, max_evaluations = 0;
  bool intervals = false;
  int bootstrap = 0, mcmc = 0;
  bool stability = false;
  std::optional<std::string> from_map;
};

fit::SceneFitOptions options_of(const FitWords& words, LongWork& long_work) {
  fit::SceneFitOptions options;
  options.threads = words.threads;
  options.max_evaluations = words.max_evaluations;
  options.intervals = words.intervals;
  options.bootstrap = words.bootstrap;
  options.mcmc = words.mcmc;
  options.stability = words.stability;
  options.stop = long_work.stop();
  options.progress = [&long_work](const std::string& stage, int evaluations, double chi2_per_dof,
                                  double share) {
    long_work.tell({stage, share, evaluations, chi2_per_dof});
  };
  return options;
}

Fit fit_scene(const SceneHandle& self, const py::object& photo, const FitWords& words,
              const py::object& progress, const py::object& stop) {
  require_threads(words.threads);
  require_within("max_evaluations", words.max_evaluations, 1.0, 1e6);
  if (words.bootstrap != 0) require_within("bootstrap", words.bootstrap, 2.0, 1e6);
  if (words.mcmc != 0) require_within("mcmc", words.mcmc, 2.0, 1e6);
  const std::shared_ptr<const sim::Scene> scene = self.scene;
  const auto given = photographs_given(*scene, photo, true);
  LongWork long_work(progress, stop);
  // A fit may decode a photograph again; the caller's stay as they are.
  auto photos = std::make_shared<std::vector<fit::Photo>>();
  auto result = result_of<fit::FitResult>(long_work, [&] {
    for (const auto& one : given) photos->push_back(*one);
    fit::require_memory_of_fit(*scene, words.threads, {sim::usable_memory_bytes(), false, "fit"});
    const std::vector<fit::InputFile> inputs = inputs_of_work(*scene, *photos);
    std::optional<fit::StoredMap> map;
    if (words.from_map) {
      map = fit::read_stored_map(*words.from_map);
      std::vector<std::string> decodings;
      for (const fit::Photo& one : *photos) decodings.push_back(one.decoding);
      fit::check_same_subject(*map, *scene, inputs, decodings);
    }
    fit::FitResult found = sim::placing_errors(*scene, [&] {
      return fit::fit_scene(*scene, *photos, map ? &*map : nullptr, options_of(words, long_work));
    });
    found.inputs = inputs;
    fit::add_radar_files(found);
    found.command = "vegard.Scene.fit() in Python";
    return found;
  });
  return {std::make_shared<const fit::FitResult>(std::move(result)), std::move(photos)};
}

py::object or_none(const std::optional<double>& number) {
  return number ? py::object(py::float_(*number)) : py::object(py::none());
}

template <class Number>
py::dict values_by_path(const std::vector<Number>& numbers, py::dict values = {}) {
  for (const Number& number : numbers) values[py::str(number.path)] = number.value;
  return values;
}

py::array_t<double> correlation(const Fit& self) {
  std::vector<double> all;
  for (const std::vector<double>& row : self.result->correlation)
    all.insert(all.end(), row.begin(), row.end());
  const auto count = static_cast<py::ssize_t>(self.result->correlation.size());
  return array_of(std::move(all), {count, count});
}

void write(const Fit& self, const py::object& directory, bool overwrite, int threads) {
  require_threads(threads);
  const auto name = py::module_::import("os").attr("fspath")(directory).cast<std::string>();
  const py::gil_scoped_release others_may_run;
  fit::RunContext context;
  context.threads = threads;
  fit::write_run(name, overwrite, *self.result, *self.photos, context);
}

/// (bands, rows, 3) of a profile's values, if they are in columns; else of one axis.
py::array_t<double> profile_array(const FitPhoto& self, const std::vector<double>& values) {
  const fit::Profile& profile = self.photo->data;
  const auto count = static_cast<py::ssize_t>(values.size());
  if (count == static_cast<py::ssize_t>(profile.bands) * profile.rows * 3)
    return array_over(self.result, values.data(), {profile.bands, profile.rows, 3});
  return array_over(self.result, values.data(), {count});
}

void bind_numbers(py::module_& m) {
  py::class_<fit::FittedParameter>(m, "FittedParameter", "One number that a fit has found.")
      .def_readonly("path", &fit::FittedParameter::path, "'sheet.main.energy_kev' (str).")
      .def_readonly("unit", &fit::FittedParameter::unit, "'keV' (str).")
      .def_readonly("meaning", &fit::FittedParameter::meaning, "One line (str).")
      .def_readonly("value", &fit::FittedParameter::value, "In that unit (float).")
      .def_readonly("initial", &fit::FittedParameter::initial, "Where the search started (float).")
      .def_readonly("min", &fit::FittedParameter::min, "Limit in force; -inf: none (float).")
      .def_readonly("max", &fit::FittedParameter::max, "Limit in force; inf: none (float).")
      .def_property_readonly(
          "sigma", [](const fit::FittedParameter& p) { return or_none(p.sigma); },
          "Half-width of the 68 % interval; None without an error bar (float).")
      .def_readonly("interval68", &fit::FittedParameter::interval68,
                    "Its ends, which may be lopsided; None without an error bar (pair of float).")
      .def_readonly("at_limit", &fit::FittedParameter::at_limit, "(bool)")
      .def_readonly("why_no_sigma", &fit::FittedParameter::why_no_sigma,
                    "In words; empty with an error bar (str).")
      .def("__repr__", [](const fit::FittedParameter& p) {
        return "<vegard.FittedParameter " + p.path + " = " + std::string(py::repr(py::float_(p.value))) +
               " +- " + std::string(py::repr(or_none(p.sigma))) + " " + p.unit + ">";
      });
  py::class_<fit::DerivedNumber>(m, "DerivedNumber",
                                 "What follows from the parameters and is what people publish.")
      .def_readonly("name", &fit::DerivedNumber::name, "'distance of the main sheet' (str).")
      .def_readonly("value", &fit::DerivedNumber::value, "NaN if it is unconstrained (float).")
      .def_readonly("unit", &fit::DerivedNumber::unit, "(str)")
      .def_property_readonly(
          "sigma", [](const fit::DerivedNumber& d) { return or_none(d.sigma); },
          "Statistical standard error, or None (float).")
      .def_property_readonly(
          "systematic", [](const fit::DerivedNumber& d) { return or_none(d.systematic); },
          "By the fit's choices, where stability was asked for; or None (float).")
      .def_property_readonly(
          "trust", [](const fit::DerivedNumber& d) { return fit::trust_name(d.trust); },
          "'good', 'doubtful' or 'unconstrained' (str).")
      .def_readonly("trust_reason", &fit::DerivedNumber::trust_reason, "(str)")
      .def_readonly("why_none", &fit::DerivedNumber::why_none, "In words, if there is no value (str).");
  py::class_<FitPhoto>(
      m, "FitPhoto",
      "What belongs to one photograph of a fit. Profiles are float64 of shape (bands, rows, 3), linear\n"
      "light, views of the result's own buffers.")
      .def_property_readonly(
          "name", [](const FitPhoto& p) { return p.photo->name; },
          "Of its entry; empty if it is the only one (str).")
      .def_property_readonly(
          "data", [](const FitPhoto& p) { return profile_array(p, p.photo->data.mean); },
          "The photograph's profile; NaN where nothing is usable.")
      .def_property_readonly(
          "sigma", [](const FitPhoto& p) { return profile_array(p, p.photo->sigma); },
          "Its standard deviation, all sources; 0 where it is not used.")
      .def_property_readonly(
          "model", [](const FitPhoto& p) { return profile_array(p, p.photo->model); },
          "That of the best model, sky included.")
      .def_property_readonly(
          "chi2", [](const FitPhoto& p) { return p.photo->chi2; }, "Its share (float).")
      .def_property_readonly(
          "decoding", [](const FitPhoto& p) { return p.photo->decoding; }, "In words (str).")
      .def_property_readonly(
          "scene",
          [](const FitPhoto& p) { return SceneHandle{std::make_shared<const sim::Scene>(p.photo->best)}; },
          "The best scene as this photograph sees it, with its gain and sky (Scene).");
}

}  // namespace

void bind_fits(py::module_& m, py::class_<SceneHandle>& scene) {
  bind_numbers(m);
  const auto of_result = [](auto member) {
    return [member](const Fit& self) { return (*self.result).*member; };
  };
  py::class_<Fit>(m, "Fit", "What a fit has found.")
      .def_property_readonly(
          "verdict", [](const Fit& f) { return fit::verdict_name(f.result->verdict); },
          "'good', 'doubtful', 'failed' or 'interrupted' (str).")
      .def_property_readonly("verdict_line", of_result(&fit::FitResult::verdict_line),
                             "Whether to believe it, and why, in a sentence (str).")
      .def_property_readonly("reasons", of_result(&fit::FitResult::reasons),
                             "What speaks against it, or is worth knowing (list of str).")
      .def_property_readonly("parameters", of_result(&fit::FitResult::parameters),
                             "The free parameters (list of FittedParameter).")
      .def_property_readonly(
          "values",
          [](const Fit& f) { return values_by_path(f.result->tied, values_by_path(f.result->parameters)); },
          "The values of the free and the tied parameters by path, in their units (dict).")
      .def_property_readonly("derived", of_result(&fit::FitResult::derived),
                             "Distances, energies, fluxes and the like (list of DerivedNumber).")
      .def_property_readonly("correlation", &correlation,
                             "(parameters, parameters), float64; rows without an error bar hold zeros.")
      .def_property_readonly("chi2", of_result(&fit::FitResult::chi2), "(float)")
      .def_property_readonly("dof", of_result(&fit::FitResult::dof), "Degrees of freedom (int).")
      .def_property_readonly("evaluations", of_result(&fit::FitResult::evaluations),
                             "Of the residuals (int).")
      .def_property_readonly(
          "interrupted",
          [](const Fit& f) {
            return f.result->verdict == fit::Verdict::interrupted || f.result->validation_interrupted;
          },
          "Whether `stop` has cut it short: it is the best so far (bool).")
      .def_property_readonly(
          "scene",
          [](const Fit& f) { return SceneHandle{std::make_shared<const sim::Scene>(f.result->best)}; },
          "The scene with the best values, gain and sky written into it (Scene).")
      .def_property_readonly(
          "photos",
          [](const Fit& f) {
            std::vector<FitPhoto> photos;
            for (const fit::FittedPhoto& one : f.result->photos) photos.push_back({f.result, &one});
            return photos;
          },
          "What belongs to each photograph (list of FitPhoto).")
      .def(
          "to_json", [](const Fit& f) { return fit::result_json(*f.result); },
          "All of it, as result.json of a run's directory has it (str).")
      .def("write", &write, py::arg("directory"), py::kw_only(), py::arg("overwrite") = false,
           py::arg("threads") = 0,
           "Writes the run's directory with its report, as `vegard fit --out` does; whole or not at all.")
      .def("__repr__", [](const Fit& f) { return "<vegard.Fit: " + f.result->verdict_line + ">"; });

  scene.def(
      "fit",
      [](const SceneHandle& self, const py::object& photo, int threads, int max_evaluations, bool intervals,
         int bootstrap, int mcmc, bool stability, const std::optional<std::string>& from_map,
         const py::object& progress, const py::object& stop) {
        return fit_scene(self, photo,
                         {threads, max_evaluations, intervals, bootstrap, mcmc, stability, from_map},
                         progress, stop);
      },
      py::arg("photo") = py::none(), py::kw_only(), py::arg("threads") = 0,
      py::arg("max_evaluations") = fit::FitOptions().max_evaluations, py::arg("intervals") = false,
      py::arg("bootstrap") = 0, py::arg("mcmc") = 0, py::arg("stability") = false,
      py::arg("from_map") = py::none(), py::arg("progress") = py::none(), py::arg("stop") = py::none(),
      "Finds the scene's free parameters, fit.free, in a photograph or in several (Fit): what `vegard fit` "
      "does.\n\n"
      "photo: a Photo, the name of a file, a list of Photo, or None for those of the scene's [[fit.photo]]\n"
      "threads: 0 for all cores; the result is the same\n"
      "max_evaluations: of the residuals\n"
      "intervals: profile-likelihood intervals of every parameter\n"
      "bootstrap: so many draws of the bands\n"
      "mcmc: a Markov chain of so many steps\n"
      "stability: repeats the fit with other choices, for systematic errors\n"
      "from_map: the directory of a map whose curtains are refined\n"
      "progress: called with a Progress now and then\n"
      "stop: a threading.Event; once it is set, the best so far is returned. Ctrl-C raises "
      "KeyboardInterrupt.");
}

}  // namespace vegard::python
