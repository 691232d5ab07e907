// Checks single values against their declaration, and parts of a scene as a whole.
#pragma once

#include <optional>
#include <string>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

struct Scene;

/// Returns the valid values in words: "a number from 0.1 to 20 (keV)", "\"srgb\" or \"smpte-c\"".
std::string expected_text(const Declaration& declaration);

/// Returns a complaint about a number that is not finite, outside the limits, or against the rule.
std::optional<Complaint> number_complaint(const Declaration& declaration, double number);

/// Returns a complaint about a text that is none of the choices, or against the rule.
std::optional<Complaint> text_complaint(const Declaration& declaration, const std::string& text);

/// Returns a complaint about a name that is not in fit.photos; an empty name stands for all photographs.
std::optional<Complaint> photo_complaint(const Scene& scene, const std::string& photo);

/// Refuses settings that are only known for the Earth if the body is another one, and a body "earth" with
/// other numbers than the Earth's. Throws Error(scene) with the scene's file.
void check_body(const Scene& scene);

/// Throws Error(scene) unless the scene's body is the Earth; `what`, "the map", is the subject of the
/// message.
void require_earth(const Scene& scene, const std::string& what);

/// Checks the scene's own lines: no two may have one wavelength, follow a line that the emission tables lack,
/// or have the wavelength of a set of bands. Throws Error(scene) with the scene's file.
void check_own_lines(const Scene& scene);

/// Checks paths, names, limits, scales and priors of fit.free. Throws Error(scene) with the scene's file and
/// the entry's line.
void check_free_parameters(const Scene& scene);

/// Checks paths and expressions of fit.tied, with the start values of fit.free. Call it after
/// check_free_parameters(). Throws Error(scene) with the scene's file and the entry's line.
void check_tied_parameters(const Scene& scene);

/// Checks the entries of fit.radars, but not their files. Throws Error(scene) with the scene's file and the
/// entry's line.
void check_radars(const Scene& scene);

/// Checks the keys: paths, times, values on the whole way between them, and the scene at each key's time.
/// Throws Error(scene) with the scene's file and the key's line.
void check_keyframes(const Scene& scene);

}  // namespace vegard::sim
