// What is wrong with the words of a command line or with the scene that it names, told with its place.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Error(usage) about the option `key`.
inline sim::Error usage_error(const std::string& key, const std::string& problem, const std::string& expected,
                              const std::string& hint = {}) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = problem;
  details.expected = expected;
  details.hint = hint;
  return sim::Error(sim::ErrorKind::usage, details);
}

/// The same error with the scene's file and the line of its key, if it is about the scene and does not have
/// them: those who work with the numbers of a scene do not know its file.
sim::Error with_place(const sim::Error& error, const sim::Scene& scene);

/// call(), with the place of what is wrong with the scene in its errors.
template <typename Call>
auto placing_errors(const sim::Scene& scene, const Call& call) {
  try {
    return call();
  } catch (const sim::Error& error) {
    throw with_place(error, scene);
  }
}

/// Throws Error(scene), with the key's place, if the scene's points are of unit weight (film.weight), so that
/// its picture is none in rayleighs. `what` needs them: "--as-seen".
void require_rayleighs(const sim::Scene& scene, const std::string& what);

}  // namespace vegard::apps
