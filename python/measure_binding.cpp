// From a photograph to an answer: the stages of `vegard measure`.
#include <pybind11/stl.h>

#include <optional>

#include "fit/measurement/measure.h"
#include "python/bindings.h"
#include "python/long_work.h"

namespace vegard::python {
namespace {

using fit::AnswerPart;
using fit::Measurement;
using fit::MeasureStage;

std::string path_of(const py::object& path) {
  return path.is_none() ? "" : py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

py::object read_json(const std::string& text) {
  return text.empty() ? py::object(py::none()) : py::module_::import("json").attr("loads")(text);
}

Measurement measure_photo(const py::object& photo, const py::object& out,
                          const std::optional<std::string>& time,
                          const std::optional<std::vector<double>>& site, const py::object& camera,
                          const py::object& mask, const std::optional<std::string>& decoding, double line_nm,
                          int replicates, int threads, bool map, bool overwrite, const py::object& progress,
                          const py::object& stop) {
  require_threads(threads);
  require_within("replicates", replicates, 0.0, 1000.0);
  require_within("line_nm", line_nm, 100.0, 2000.0);
  if (site && site->size() != 2 && site->size() != 3)
    throw py::value_error("site is neither (latitude, longitude) nor (latitude, longitude, height in m)");
  fit::MeasureRequest request;
  request.photo = path_of(photo);
  request.out = path_of(out);
  request.time = time.value_or("");
  if (site) {
    require_within("site", (*site)[0], -90.0, 90.0);
    require_within("site", (*site)[1], -180.0, 360.0);
    request.site = sim::Observer{(*site)[0], (*site)[1], site->size() == 3 ? (*site)[2] : 0.0};
  }
  request.camera = path_of(camera);
  request.mask = path_of(mask);
  request.decoding = decoding.value_or("");
  request.line_nm = line_nm;
  request.replicates = replicates;
  request.threads = threads;
  request.no_map = !map;
  request.overwrite = overwrite;
  request.command = "vegard.measure() in Python";
  LongWork long_work(progress, stop);
  return result_of<Measurement>(long_work, [&] {
    const fit::Tell tell([&](const std::string& line, fit::Tell::Tone) {
      if (!line.empty()) long_work.tell({line, 0.0, 0, 0.0});
    });
    return fit::measure(request, {tell, [&](fit::MapOptions& options) {
                                    options.stop = long_work.stop();
                                    options.progress = [&](const std::string& stage, double chi2_per_value,
                                                           double share) {
                                      long_work.tell({stage, share, 0, chi2_per_value});
                                    };
                                  }});
  });
}

py::object site_of(const Measurement& self) {
  if (!self.site) return py::none();
  return py::make_tuple(self.site->latitude_deg, self.site->longitude_deg, self.site->height_m);
}

}  // namespace

void bind_measurements(py::module_& m) {
  py::class_<MeasureStage>(m, "MeasureStage", "One stage on the way from a photograph to an answer.")
      .def_readonly("title", &MeasureStage::title, "'Which part of it is sky' (str).")
      .def_property_readonly(
          "trust", [](const MeasureStage& s) { return fit::trust_name(s.trust); },
          "'good', 'doubtful' or 'unconstrained' (str).")
      .def_readonly("found", &MeasureStage::found, "What it found, in a sentence or two (str).")
      .def_readonly("lacking", &MeasureStage::lacking, "What is missing and would help; may be empty (str).")
      .def_readonly("command", &MeasureStage::command,
                    "The command that does the same alone; empty if there is none (str).")
      .def_readonly("exit_code", &MeasureStage::exit_code, "With which that command would end (int).")
      .def_readonly("files", &MeasureStage::files, "What it has written in the folder (list of str).")
      .def_property_readonly(
          "numbers", [](const MeasureStage& s) { return read_json(s.numbers); },
          "What that command gives with --json, units in the keys; None if nothing was found (dict).")
      .def("__repr__", [](const MeasureStage& s) {
        return "<vegard.MeasureStage " + s.title + ": " + fit::trust_name(s.trust) + ">";
      });
  py::class_<AnswerPart>(m, "AnswerPart", "A part of a measurement's answer, with a trust of its own.")
      .def_readonly("name", &AnswerPart::name, "'direction', 'distance', 'energy' … (str).")
      .def_property_readonly(
          "trust", [](const AnswerPart& part) { return fit::trust_name(part.trust); },
          "'good', 'doubtful' or 'unconstrained' (str).")
      .def_readonly("reasons", &AnswerPart::reasons, "Why it is not good; empty if it is (list of str).")
      .def("__repr__", [](const AnswerPart& part) {
        return "<vegard.AnswerPart " + part.name + ": " + fit::trust_name(part.trust) + ">";
      });
  py::class_<Measurement>(m, "Measurement", "What a photograph tells.")
      .def_property_readonly(
          "trust", [](const Measurement& self) { return fit::trust_name(self.trust); },
          "'good', 'doubtful' or 'unconstrained' (str).")
      .def_readonly("answer", &Measurement::answer, "The answer in a few sentences (list of str).")
      .def_readonly("parts", &Measurement::parts,
                    "How far each part of it is to be trusted (list of AnswerPart).")
      .def_readonly("not_known", &Measurement::not_known,
                    "What the picture does not tell, and what would (list of str).")
      .def_readonly("out", &Measurement::out, "The folder that was written, with report.html (str).")
      .def_readonly("stages", &Measurement::stages, "In their order (list of MeasureStage).")
      .def_property_readonly(
          "time",
          [](const Measurement& self) {
            return self.time_utc.empty() ? std::optional<std::string>() : self.time_utc;
          },
          "Of the picture, ISO 8601 in UTC; None if it is not known (str).")
      .def_property_readonly(
          "site", &site_of,
          "(latitude, longitude, height) in degrees and m; None if it is not known (tuple).")
      .def_readonly("camera", &Measurement::camera, "Given or found; None if it is not known (Camera).")
      .def_readonly("has_azimuth", &Measurement::has_azimuth,
                    "Whether the camera's azimuth is known, not only its elevation (bool).")
      .def_property_readonly(
          "verdicts",
          [](const Measurement& self) {
            return self.map ? self.map->verdicts : std::vector<fit::QuantityVerdict>();
          },
          "What to believe of the map; empty without one (list of QuantityVerdict).")
      .def("to_json", &fit::measure_json, "measure.json of the folder (str).")
      .def("__repr__", [](const Measurement& self) {
        return "<vegard.Measurement of " + self.photo + ": " + fit::trust_name(self.trust) + ">";
      });
  const fit::MeasureRequest usual;
  m.def("measure", &measure_photo, py::arg("photo"), py::arg("out") = py::none(), py::kw_only(),
        py::arg("time") = py::none(), py::arg("site") = py::none(), py::arg("camera") = py::none(),
        py::arg("mask") = py::none(), py::arg("decoding") = py::none(), py::arg("line_nm") = usual.line_nm,
        py::arg("replicates") = usual.replicates, py::arg("threads") = usual.threads, py::arg("map") = true,
        py::arg("overwrite") = false, py::arg("progress") = py::none(), py::arg("stop") = py::none(),
        "Finds camera, distance and, where possible, energy of the aurora in one photograph (Measurement): "
        "what\n`vegard measure` does, with the same folder.\n\n"
        "photo: the name of a file\n"
        "out: the folder to write; None: the photo's name with _measured, in the working directory\n"
        "time: ISO 8601 in UTC or with a zone; None: the photo's own\n"
        "site: (latitude, longitude) or (latitude, longitude, height) in degrees, north and east, and m;\n"
        "  None: the photo's own, or the camera's\n"
        "camera: the name of a camera's file, if the pointing is known\n"
        "mask: an image of the photo's size, white where it is sky\n"
        "decoding: how numbers become light, as --decoding has it; None: by the format\n"
        "line_nm: wavelength of the emission line, of a photo through one filter\n"
        "replicates: perturbed solutions for the map's error bars\n"
        "threads: 0 for all cores; the result is the same\n"
        "map: whether the precipitation is mapped\n"
        "overwrite: whether a measurement that exists is replaced\n"
        "progress: called with a Progress now and then, whose stage is the last line that was found\n"
        "stop: a threading.Event; once it is set, a map ends. Ctrl-C raises KeyboardInterrupt.");
}

}  // namespace vegard::python
