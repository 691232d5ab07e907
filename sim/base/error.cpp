#include "sim/base/error.h"

#include <utility>

namespace vegard::sim {
namespace {

std::string compose(const ErrorDetails& d) {
  std::string text;
  if (!d.file.empty()) {
    text += d.file;
    if (d.line > 0) text += ":" + std::to_string(d.line);
    text += ": ";
  }
  if (!d.key.empty()) text += d.key + ": ";
  text += d.problem;
  if (!d.expected.empty()) text += " (expected " + d.expected + ")";
  if (!d.hint.empty()) text += "; " + d.hint;
  return text;
}

}  // namespace

Error::Error(ErrorKind kind, ErrorDetails details)
    : kind_(kind), details_(std::move(details)), text_(compose(details_)) {}

}  // namespace vegard::sim
