// Scenes: read, looked into, changed.
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>

#include "fit/photo/scene_photos.h"
#include "fit/ready_scene.h"
#include "python/bindings.h"
#include "sim/base/error.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::python {
namespace {

/// What TOML text says, by Python's own reader.
py::object value_of_toml(const std::string& text) {
  return py::module_::import("tomllib").attr("loads")("value = " + text)["value"];
}

/// As TOML writes it within an array or a table, where a text is in quotes.
std::string toml_of(const py::handle& value) {
  if (py::hasattr(value, "tolist")) return toml_of(value.attr("tolist")());  // NumPy's numbers and arrays
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::float_>(value)) {
    const double number = value.cast<double>();
    return std::isnan(number)   ? "nan"
           : std::isinf(number) ? (number > 0.0 ? "inf" : "-inf")
                                : sim::real_text(number);
  }
  if (py::isinstance<py::int_>(value)) return py::str(value);
  if (py::isinstance<py::str>(value)) return sim::quoted_text(value.cast<std::string>());
  std::string text;
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, one] : value.cast<py::dict>())
      text += (text.empty() ? "" : ", ") + key.cast<std::string>() + " = " + toml_of(one);
    return "{ " + text + " }";
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    for (const py::handle one : value) text += (text.empty() ? "" : ", ") + toml_of(one);
    return "[" + text + "]";
  }
  throw py::type_error("a parameter is a number, bool, str, a list of them or an array, not " +
                       std::string(py::str(py::type::of(value).attr("__name__"))));
}

/// As --set takes it: a bare text is a word.
std::string set_text(const py::handle& value) {
  return py::isinstance<py::str>(value) ? value.cast<std::string>() : toml_of(value);
}

std::shared_ptr<const sim::Scene> ready(sim::Scene scene) {
  fit::make_ready(scene);
  return std::make_shared<const sim::Scene>(std::move(scene));
}

void change(sim::Scene& scene, const py::dict& changes) {
  for (const auto& [path, value] : changes)
    sim::set_from_text(scene, path.cast<std::string>(), set_text(value));
}

/// What all ways of reading do: the camera, the changes, the check.
SceneHandle opened(sim::Scene scene, const std::optional<std::string>& camera,
                   const std::optional<py::dict>& changes, const std::optional<std::uint64_t>& seed) {
  if (camera) sim::take_camera(scene, *camera);
  if (changes) change(scene, *changes);
  if (seed) sim::set_from_text(scene, "seed", std::to_string(*seed));
  return {ready(std::move(scene))};
}

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

bool is_entry_of_fit(const std::string& path) {
  return path == std::string(sim::free_table) + "." + sim::free_key ||
         path == std::string(sim::free_table) + "." + sim::tied_key;
}

py::object value_at(const SceneHandle& self, const std::string& path) {
  const sim::Scene& scene = *self.scene;
  if (is_entry_of_fit(path)) {
    const py::dict whole = py::module_::import("tomllib").attr("loads")(sim::write_scene(scene));
    return whole["fit"].attr("get")(last_part(path), py::list());
  }
  const std::vector<sim::ParameterPath> paths = sim::resolve(scene, path);
  const sim::ParameterPath& first = paths.front();
  if (paths.size() == 1 && (first.row->component.empty() || last_part(path) == last_part(first.text)))
    return value_of_toml(sim::value_text(scene, first));
  py::list values;
  for (const sim::ParameterPath& one : paths) values.append(value_of_toml(sim::value_text(scene, one)));
  return values;
}

/// One line of parameters().
struct Parameter {
  std::string path, unit, meaning, limits;
  py::object value;
  double least = 0.0, most = 0.0;
  std::vector<std::string> choices;
  bool may_be_free = false;
};

std::vector<Parameter> parameters_of(const SceneHandle& self) {
  std::vector<Parameter> all;
  for (const sim::ParameterPath& path : sim::all_paths(*self.scene)) {
    const sim::ParameterRow& row = *path.row;
    all.push_back({path.text, row.unit, row.meaning, sim::limits_text(row),
                   value_of_toml(sim::value_text(*self.scene, path)), row.min, row.max, row.choices,
                   row.can_be_free});
  }
  return all;
}

void set_all(SceneHandle& self, const py::dict& changes) {
  sim::Scene changed = *self.scene;
  change(changed, changes);
  self.scene = ready(std::move(changed));
}

std::vector<std::string> take_from(SceneHandle& self, const std::string& photo) {
  fit::PhotoDefaults defaults = fit::taken_from_photograph(*self.scene, photo);
  self.scene = ready(std::move(defaults.scene));
  std::vector<std::string> told;
  for (const fit::PhotoFact& fact : defaults.taken) told.push_back(fit::fact_text(fact));
  told.insert(told.end(), defaults.notes.begin(), defaults.notes.end());
  return told;
}

}  // namespace

py::class_<SceneHandle> bind_scene(py::module_& m) {
  py::class_<Parameter>(m, "Parameter", "One number, word or switch of a scene, as `vegard params` lists it.")
      .def_readonly("path", &Parameter::path,
                    "'sheet.main.energy_kev': what scene[path] and --set take (str).")
      .def_readonly("value", &Parameter::value, "float, int, bool or str.")
      .def_readonly("unit", &Parameter::unit, "'keV'; empty if it has none (str).")
      .def_readonly("min", &Parameter::least, "The least that it may be, in its unit; -inf: any (float).")
      .def_readonly("max", &Parameter::most, "The most that it may be, in its unit; inf: any (float).")
      .def_readonly("limits", &Parameter::limits, "Limits or choices in words (str).")
      .def_readonly("choices", &Parameter::choices, "Words that it may be; empty: any (list of str).")
      .def_readonly("may_be_free", &Parameter::may_be_free, "Whether a fit may find it (bool).")
      .def_readonly("meaning", &Parameter::meaning, "One line (str).")
      .def("__repr__", [](const Parameter& p) {
        return "<vegard.Parameter " + p.path + " = " + std::string(py::repr(p.value)) +
               (p.unit.empty() ? "" : " ") + p.unit + ">";
      });

  py::class_<SceneHandle> scene(m, "Scene",
                                "A scene: site, camera, what shines, and what a fit is to find. scene[path] "
                                "reads and sets its parameters by\n"
                                "their paths, checked as --set checks them; vegard.Error says what is wrong, "
                                "and the scene stays as it was.");
  scene
      .def("__getitem__", &value_at, py::arg("path"),
           "The value at a path: float, int, bool or str, a list of them for a vector.")
      .def(
          "__setitem__",
          [](SceneHandle& self, const std::string& path, const py::object& value) {
            py::dict one;
            one[py::str(path)] = value;
            set_all(self, one);
          },
          py::arg("path"), py::arg("value"), "Sets one value and checks the whole scene.")
      .def("set", &set_all, py::arg("values"),
           "Sets several values, a dict by path, and checks the whole scene after the last: for those that "
           "must agree.")
      .def("parameters", &parameters_of,
           "All parameters of the scene in the order of a scene file (list of Parameter).")
      .def(
          "copy", [](const SceneHandle& self) { return self; }, "Another scene that is the same.")
      .def("__copy__", [](const SceneHandle& self) { return self; })
      .def("__deepcopy__", [](const SceneHandle& self, const py::dict&) { return self; })
      .def(
          "to_toml", [](const SceneHandle& self) { return sim::write_scene(*self.scene); },
          "A scene file with every value written out, which vegard.parse() reads back to the same scene "
          "(str).")
      .def_property_readonly(
          "file", [](const SceneHandle& self) { return self.scene->file; },
          "The file that it was read from; names in it are relative to that file's (str).")
      .def("take_from", &take_from, py::arg("photo"),
           "Takes from a photograph's own words what the scene's file leaves out: place, time, size, field "
           "of view,\n"
           "exposure, as `vegard fit` does unless it is told --no-metadata. Returns what was taken, and "
           "notes (list of\n"
           "str).")
      .def("__repr__", [](const SceneHandle& self) {
        const sim::Scene& s = *self.scene;
        return "<vegard.Scene '" + s.file + "', " + std::to_string(s.camera.width) + " x " +
               std::to_string(s.camera.height) + " pixels, " + std::to_string(s.emission.lines.size()) +
               " lines>";
      });

  m.def(
      "load",
      [](const py::object& path, const std::optional<std::string>& camera,
         const std::optional<py::dict>& changes, const std::optional<std::uint64_t>& seed) {
        const auto file = py::module_::import("os").attr("fspath")(path).cast<std::string>();
        return opened(sim::read_scene(file), camera, changes, seed);
      },
      py::arg("path"), py::kw_only(), py::arg("camera") = py::none(), py::arg("set") = py::none(),
      py::arg("seed") = py::none(),
      "Reads and checks a scene file.\n\n"
      "camera: a file whose [camera] and [site] win, as `vegard calibrate` writes it (--camera)\n"
      "set: values by path, as Scene.set() takes them (--set)\n"
      "seed: another seed of the random numbers (--seed)");
  m.def(
      "parse",
      [](const std::string& text, const std::string& name) {
        return opened(sim::parse_scene(text, name), {}, {}, {});
      },
      py::arg("text"), py::arg("name") = "scene.toml",
      "Reads and checks the text of a scene file; `name` stands for the file in messages and is what names "
      "in the text\n"
      "are relative to.");
  return scene;
}

}  // namespace vegard::python
