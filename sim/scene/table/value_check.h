// Checks of single values against their declaration, and of a scene as a whole.
#pragma once

#include <optional>
#include <string>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

/// What would be right, in words: "a number from 0.1 to 20 (keV)", "\"srgb\" or \"smpte-c\"".
std::string expected_text(const Declaration& declaration);

/// Not finite, outside the limits, or against the rule.
std::optional<Complaint> number_complaint(const Declaration& declaration, double number);

/// None of the choices, or against the rule.
std::optional<Complaint> text_complaint(const Declaration& declaration, const std::string& text);

/// A name that is none of fit.photos; empty stands for all photographs.
std::optional<Complaint> photo_complaint(const Scene& scene, const std::string& photo);

/// What a scene asks for that is known of the Earth alone, where its body is another one; and numbers of the
/// Earth that are others than its own. Throws Error(scene) with the scene's file.
void check_body(const Scene& scene);

/// Throws Error(scene) unless the scene's body is the Earth: `what`, "the map", is known of nothing else.
void require_earth(const Scene& scene, const std::string& what);

/// The scene's own lines: no two at one wavelength, none that follows what the emission tables lack, none at
/// the name of a set of bands. Throws Error(scene) with the scene's file.
void check_own_lines(const Scene& scene);

/// Paths, names, limits, scales and priors of fit.free. Throws Error(scene) with the scene's file and the
/// entry's line.
void check_free_parameters(const Scene& scene);

/// Paths and expressions of fit.tied, at the numbers that fit.free starts from. To be called after
/// check_free_parameters(). Throws Error(scene) with the scene's file and the entry's line.
void check_tied_parameters(const Scene& scene);

}  // namespace vegard::sim
