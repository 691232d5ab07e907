// Photographs, and the cost that a fit of a scene to them goes down: residuals and Jacobian.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "fit/answer/input_files.h"
#include "fit/needed_memory.h"
#include "fit/photo/photo.h"
#include "fit/photo/scene_photos.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/structs/line_of.h"

namespace vegard::python {
namespace {

std::string file_of(const py::object& path) {
  return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

PhotoHandle read(const SceneHandle& self, const py::object& path, const std::optional<std::string>& mask,
                 const std::optional<std::string>& decoding, bool averaged) {
  const std::shared_ptr<const sim::Scene> scene = self.scene;
  const std::string file = file_of(path);
  const py::gil_scoped_release others_may_run;
  return {std::make_shared<const fit::Photo>(
      fit::photograph_for(*scene, file, mask.value_or(""), decoding.value_or(""),
                          averaged ? fit::PhotoPixels::for_fit : fit::PhotoPixels::of_file))};
}

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Bools = py::array_t<bool, py::array::c_style | py::array::forcecast>;

PhotoHandle of_array(const Floats& light, const std::optional<Bools>& usable, const std::string& name) {
  const bool grey = light.ndim() == 2;
  if (!grey && (light.ndim() != 3 || light.shape(2) != 3))
    throw py::value_error("light has neither the shape (height, width) nor (height, width, 3)");
  constexpr py::ssize_t kMaxSide = 65535;
  if (light.size() == 0 || light.shape(0) > kMaxSide || light.shape(1) > kMaxSide)
    throw py::value_error("light is no picture of 1 to 65535 pixels a side");
  if (usable &&
      (usable->ndim() != 2 || usable->shape(0) != light.shape(0) || usable->shape(1) != light.shape(1)))
    throw py::value_error("usable has not the shape (height, width)");
  sim::Image image(static_cast<int>(light.shape(1)), static_cast<int>(light.shape(0)),
                   grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"});
  std::copy_n(light.data(), image.data.size(), image.data.begin());
  std::vector<std::uint8_t> used;
  if (usable) used.assign(usable->data(), usable->data() + usable->size());
  const py::gil_scoped_release others_may_run;
  return {std::make_shared<const fit::Photo>(fit::photo_of_light(image, used, name))};
}

CostHandle cost_of(const SceneHandle& self, const py::object& photo, int threads) {
  require_threads(threads);
  CostHandle handle;
  handle.scene = self.scene;
  const sim::Scene& scene = *handle.scene;
  handle.photos = photographs_given(scene, photo, true);
  std::vector<const fit::Photo*> photos;
  for (const auto& one : handle.photos) photos.push_back(one.get());
  handle.alone = std::make_shared<std::mutex>();
  const py::gil_scoped_release others_may_run;
  fit::require_memory_of_fit(scene, threads, {sim::usable_memory_bytes(), false, "cost"});
  handle.cost =
      sim::placing_errors(scene, [&] { return std::make_shared<fit::SceneCost>(scene, photos, threads); });
  return handle;
}

std::vector<double> values_of(const CostHandle& self, const std::optional<Doubles>& values) {
  if (!values) return self.cost->start();
  if (values->ndim() != 1 || static_cast<std::size_t>(values->size()) != self.cost->free().size())
    throw py::value_error("values are not one for each of the " + std::to_string(self.cost->free().size()) +
                          " free parameters");
  std::vector<double> at(values->data(), values->data() + values->size());
  for (const double value : at)
    if (!std::isfinite(value)) throw py::value_error("a value is no finite number");
  const std::string beyond = self.cost->beyond_limits(at);
  if (!beyond.empty()) throw py::value_error(beyond);
  return at;
}

/// Numbers that are written before they are read, so that nothing need set them to 0 first.
struct Numbers {
  std::size_t count = 0;
  std::unique_ptr<double[]> data;

  explicit Numbers(std::size_t size) : count(size), data(new double[size]) {}
};

py::array_t<double> numbers_array(Numbers&& numbers, const std::vector<py::ssize_t>& shape) {
  double* const data = numbers.data.get();
  const py::capsule capsule(data, [](void* at) { delete[] static_cast<double*>(at); });
  numbers.data.release();
  return py::array_t<double>(shape, data, capsule);
}

/// Residuals, and the Jacobian if it is asked for; where the model has no value there, NaN.
struct Evaluated {
  Numbers residuals, jacobian;
};
Evaluated evaluated(const CostHandle& self, const std::optional<Doubles>& values, bool with_jacobian) {
  const std::vector<double> at = values_of(self, values);
  const fit::SceneCost& cost = *self.cost;
  const auto rows = static_cast<std::size_t>(cost.residuals());
  const py::gil_scoped_release others_may_run;
  Evaluated result{Numbers(rows), Numbers(with_jacobian ? rows * at.size() : 0)};
  const std::lock_guard<std::mutex> alone(*self.alone);
  double* const jacobian = with_jacobian ? result.jacobian.data.get() : nullptr;
  if (!cost.evaluate(at, result.residuals.data.get(), jacobian)) {
    std::fill_n(result.residuals.data.get(), result.residuals.count, std::nan(""));
    std::fill_n(result.jacobian.data.get(), result.jacobian.count, std::nan(""));
  }
  return result;
}

py::array_t<double> residuals(const CostHandle& self, const std::optional<Doubles>& values) {
  return numbers_array(evaluated(self, values, false).residuals, {self.cost->residuals()});
}

py::tuple residuals_and_jacobian(const CostHandle& self, const std::optional<Doubles>& values) {
  Evaluated result = evaluated(self, values, true);
  const py::ssize_t rows = self.cost->residuals(),
                    columns = static_cast<py::ssize_t>(self.cost->free().size());
  return py::make_tuple(numbers_array(std::move(result.residuals), {rows}),
                        numbers_array(std::move(result.jacobian), {rows, columns}));
}

template <class Value, class ValueOf>
std::vector<Value> values_of_free(const CostHandle& self, const ValueOf& value_of) {
  std::vector<Value> all;
  for (const fit::FreeNumber& number : self.cost->free()) all.push_back(value_of(number));
  return all;
}

void bind_photo(py::module_& m) {
  py::class_<PhotoHandle>(
      m, "Photo",
      "A photograph as linear light. Arrays are views of its own buffers: read-only, and none is "
      "copied.")
      .def_property_readonly(
          "light", [](const PhotoHandle& p) { return image_array(p.photo, p.photo->linear); },
          "(height, width, 3), float32: linear light of R, G and B, the file's largest value = 1.")
      .def_property_readonly(
          "usable",
          [](const PhotoHandle& p) {
            const sim::Image& light = p.photo->linear;
            return array_over(p.photo, reinterpret_cast<const bool*>(p.photo->usable.data()),
                              {light.height, light.width, light.channels()});
          },
          "(height, width, 3), bool: what is neither clipped nor masked.")
      .def_property_readonly(
          "decoding", [](const PhotoHandle& p) { return p.photo->decoding; },
          "How its numbers were taken for light, in words (str).")
      .def_property_readonly(
          "name", [](const PhotoHandle& p) { return p.photo->file_name; },
          "Its file without the folder (str).")
      .def_property_readonly(
          "sha256", [](const PhotoHandle& p) { return p.photo->sha256; },
          "Of the file's bytes, in hexadecimal digits (str).")
      .def("__repr__", [](const PhotoHandle& p) {
        return "<vegard.Photo '" + p.photo->file_name + "', " +
               sim::size_text(p.photo->linear.width, p.photo->linear.height) + " pixels, " +
               p.photo->decoding + ">";
      });
  m.def("photo_of_light", &of_array, py::arg("light"), py::arg("usable") = py::none(),
        py::arg("name") = "array",
        "A Photo of linear light that an array holds, which is copied.\n\n"
        "light: (height, width) or (height, width, 3); what is not finite is not used\n"
        "usable: (height, width) of bool, None: all\n"
        "name: stands for its file");
}

void bind_cost(py::module_& m) {
  py::class_<CostHandle>(
      m, "Cost",
      "What a fit of a scene makes small: whitened differences between photographs' profiles (and\n"
      "whatever else the scene's [fit] weighs) and the model's, in standard deviations; the gains and\n"
      "the sky are solved at every point. Values are those of the free parameters in the scene's\n"
      "units; without values both calls are at the start. Beams and random numbers are frozen. May be\n"
      "called from several threads, one after the other.")
      .def_property_readonly(
          "names",
          [](const CostHandle& c) {
            return values_of_free<std::string>(c, [](const auto& n) { return n.label(); });
          },
          "Paths of the free parameters, in the order of the Jacobian's columns (list of str).")
      .def_property_readonly(
          "units",
          [](const CostHandle& c) {
            return values_of_free<std::string>(c, [](const auto& n) { return n.unit(); });
          },
          "Their units (list of str).")
      .def_property_readonly(
          "limits",
          [](const CostHandle& c) {
            return values_of_free<std::pair<double, double>>(
                c, [](const auto& n) { return std::make_pair(n.min, n.max); });
          },
          "Their limits; infinite where there is none (list of pairs of float).")
      .def_property_readonly(
          "start",
          [](const CostHandle& c) {
            std::vector<double> start = c.cost->start();
            const auto count = static_cast<py::ssize_t>(start.size());
            return array_of(std::move(start), {count});
          },
          "(parameters,), float64: where a fit would start.")
      .def_property_readonly(
          "count", [](const CostHandle& c) { return c.cost->residuals(); },
          "How many residuals there are (int).")
      .def_property_readonly(
          "of_photographs", [](const CostHandle& c) { return c.cost->data_residuals(); },
          "How many of them are the photographs', which come first; the others are priors' (int).")
      .def("residuals", &residuals, py::arg("values") = py::none(),
           "(residuals,), float64, in standard deviations; NaN where the model "
           "has no value. ValueError for "
           "values\n"
           "beyond their limits.")
      .def(
          "jacobian",
          [](const CostHandle& c, const std::optional<Doubles>& values) {
            return py::object(residuals_and_jacobian(c, values)[1]);
          },
          py::arg("values") = py::none(),
          "(residuals, parameters), float64: exact derivatives of the residuals by the parameters, in "
          "standard\n"
          "deviations per unit.")
      .def("residuals_and_jacobian", &residuals_and_jacobian, py::arg("values") = py::none(),
           "(residuals, jacobian): arrays (residuals,) and (residuals, parameters), float64; both for the "
           "price of the\n"
           "Jacobian.")
      .def("__repr__", [](const CostHandle& c) {
        return "<vegard.Cost of " + std::to_string(c.cost->residuals()) + " residuals and " +
               std::to_string(c.cost->free().size()) + " parameters>";
      });
}

}  // namespace

std::vector<std::shared_ptr<const fit::Photo>> photographs_given(const sim::Scene& scene,
                                                                 const py::object& given, bool for_fit) {
  const fit::PhotoPixels pixels = for_fit ? fit::PhotoPixels::for_fit : fit::PhotoPixels::of_file;
  std::vector<std::shared_ptr<const fit::Photo>> photos;
  if (given.is_none()) {
    const py::gil_scoped_release others_may_run;
    for (fit::Photo& photo : fit::photographs_of(scene, pixels))
      photos.push_back(std::make_shared<const fit::Photo>(std::move(photo)));
  } else if (py::isinstance<PhotoHandle>(given)) {
    photos.push_back(given.cast<PhotoHandle>().photo);
  } else if (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given)) {
    for (const py::handle one : given) photos.push_back(one.cast<PhotoHandle>().photo);
  } else {
    const std::string file = file_of(given);
    const py::gil_scoped_release others_may_run;
    photos.push_back(std::make_shared<const fit::Photo>(fit::photograph_for(scene, file, "", "", pixels)));
  }
  const std::size_t named = scene.fit.photos.size(), wanted = std::max<std::size_t>(1, named);
  if (photos.size() != wanted)
    throw sim::Error(sim::ErrorKind::usage, "there are " + std::to_string(photos.size()) + " photographs")
        .key("photo")
        .expected(named == 0 ? "one"
                             : std::to_string(named) + ", those of the scene's [[fit.photo]] in their order");
  return photos;
}

std::vector<fit::InputFile> inputs_of_work(const sim::Scene& scene, const std::vector<fit::Photo>& photos) {
  const bool has_file = std::filesystem::is_regular_file(scene.file);
  const std::string sum = has_file ? sim::sha256_of_file(scene.file) : sim::sha256(sim::write_scene(scene));
  return fit::inputs_of(scene.file, sum, photos);
}

void bind_photographs(py::module_& m, py::class_<SceneHandle>& scene) {
  bind_photo(m);
  bind_cost(m);
  scene.def("photograph", &read, py::arg("path"), py::kw_only(), py::arg("mask") = py::none(),
            py::arg("decoding") = py::none(), py::arg("averaged") = false,
            "Reads a photograph of any format that `vegard fit` reads, a file or a frame of one, "
            "'a.pgm.gz#12' (Photo).\n\n"
            "mask: an image of its size, white where it is to be used\n"
            "decoding: how its numbers become light, as --decoding; None: as the scene says\n"
            "averaged: over blocks of pixels, as a fit of the scene reads large ones");
  const char* const photo_words =
      "photo: a Photo, the name of a file, a list of Photo, or None for those of the scene's [[fit.photo]]\n";
  const std::string at_start = std::string("\n\n") + photo_words + "threads: 0 for all cores";
  scene.def("cost", &cost_of, py::arg("photo") = py::none(), py::kw_only(), py::arg("threads") = 0,
            ("The cost of a fit of the scene (Cost), to be evaluated again and again." + at_start).c_str());
  scene.def(
      "residuals",
      [](const SceneHandle& self, const py::object& photo, int threads) {
        return residuals(cost_of(self, photo, threads), {});
      },
      py::arg("photo") = py::none(), py::kw_only(), py::arg("threads") = 0,
      ("cost(photo).residuals(): (residuals,), float64, in standard deviations." + at_start).c_str());
  scene.def(
      "jacobian",
      [](const SceneHandle& self, const py::object& photo, int threads) {
        return py::object(residuals_and_jacobian(cost_of(self, photo, threads), {})[1]);
      },
      py::arg("photo") = py::none(), py::kw_only(), py::arg("threads") = 0,
      ("cost(photo).jacobian(): (residuals, parameters), float64." + at_start).c_str());
}

}  // namespace vegard::python
