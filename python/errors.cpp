// sim::Error as the one exception of the module.
#include "python/bindings.h"
#include "sim/base/error.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::python {
namespace {

const char* word_of_kind(sim::ErrorKind kind) {
  switch (kind) {
    case sim::ErrorKind::usage:
      return "usage";
    case sim::ErrorKind::scene:
      return "scene";
    case sim::ErrorKind::existing_output:
      return "existing_output";
    case sim::ErrorKind::unreadable_input:
      return "unreadable_input";
    case sim::ErrorKind::unwritable_output:
      return "unwritable_output";
  }
  return "";
}

py::object text_or_none(const std::string& text) {
  return text.empty() ? py::object(py::none()) : py::object(py::str(text));
}

/// Lives as long as the interpreter: translators are asked until its end.
PyObject* error_class = nullptr;

void raise(const sim::Error& error) {
  const sim::ErrorDetails& details = error.details();
  const py::object exception = py::reinterpret_borrow<py::object>(error_class)(error.what());
  exception.attr("kind") = word_of_kind(error.kind());
  exception.attr("message") = details.problem;
  exception.attr("file") = text_or_none(details.file);
  exception.attr("line") = details.line > 0 ? py::object(py::int_(details.line)) : py::object(py::none());
  exception.attr("key") = text_or_none(details.key);
  exception.attr("expected") = text_or_none(details.expected);
  exception.attr("hint") = text_or_none(details.hint);
  PyErr_SetObject(error_class, exception.ptr());
}

}  // namespace

void require_within(const char* argument, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw sim::Error(sim::ErrorKind::usage, sim::short_real_text(value) + " is out of range")
      .key(argument)
      .expected("a number from " + sim::short_real_text(min) + " to " + sim::short_real_text(max));
}

void require_threads(int threads) { require_within("threads", threads, 0.0, 1024.0); }

void bind_errors(py::module_& m) {
  py::dict unknown;
  for (const char* name : {"kind", "message", "file", "line", "key", "expected", "hint"})
    unknown[name] = py::none();
  error_class = PyErr_NewExceptionWithDoc(
      "vegard.Error",
      "What is wrong with an input. str() is the whole message, as the command line prints it; its parts "
      "are\n"
      "\n"
      "kind: 'usage', 'scene', 'existing_output', 'unreadable_input' or 'unwritable_output'\n"
      "message: what is wrong\n"
      "file: the file it is in, or None\n"
      "line: the line in that file from 1, or None\n"
      "key: the scene's path or the option, 'camera.width', or None\n"
      "expected: what would have been right, or None\n"
      "hint: what to do, or None",
      PyExc_Exception, unknown.ptr());
  if (error_class == nullptr) throw py::error_already_set();
  m.add_object("Error", py::reinterpret_borrow<py::object>(error_class));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const sim::Error& error) {
      raise(error);
    }
  });
}

}  // namespace vegard::python
