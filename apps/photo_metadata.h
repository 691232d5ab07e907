// What a scene does not give, from the photograph on the command line.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "fit/photo/photo_facts.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Adds --no-metadata; `off` must outlive the parsing.
void add_no_metadata_option(CLI::App& command, bool& off);

/// That of the file, with the picture's size from its pixels where its head does not say it.
sim::PictureMetadata metadata_of(const std::string& photo);

/// Takes into the scene what neither its file nor `changes` ("path=value", of --set) give, and says on
/// standard output what was taken and what is to be noted. Throws Error(unreadable_input).
std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes);

}  // namespace vegard::apps
