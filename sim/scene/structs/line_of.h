// The place of a key in a scene's file: the line that sets it, whether the site is given, and errors that
// name it.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the 1-based line of a key such as "fit.roi_px", or of the vector of which `key` names a component
/// ("sheet.main.center_km.north"). 0 if the file does not set the key, or if set_from_text() has changed it.
int line_of(const Scene& scene, const std::string& key);

/// True if the scene's file sets the site's latitude (longitude), or if the value is not the default.
bool is_latitude_given(const Scene& scene);
bool is_longitude_given(const Scene& scene);

/// Returns the error with the scene's file and the line of its key added, if it is an Error(scene) that lacks
/// them: code that works with the numbers of a scene does not know its file.
Error with_place(const Error& error, const Scene& scene);

/// Returns call(). An Error that it throws passes through with_place().
template <typename Call>
auto placing_errors(const Scene& scene, const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    throw with_place(error, scene);
  }
}

}  // namespace vegard::sim
