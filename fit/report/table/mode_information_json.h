// What a picture says of the emission tables, as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/uncertainty/mode_information.h"

namespace vegard::fit {

/// Returns {"modes_sha256": …, "modes": [1, 2 …], "information": [[…] …], "towards": […], "lines":
/// [{"nm", "over_nm", "ln_ratio_by_mode"} …]}, exactly.
nlohmann::ordered_json mode_information_json(const ModeInformation& told);

/// Returns {"630.0": {"over_nm", "factor", "ln_sigma", "ln_sigma_of_tables"} …}.
nlohmann::ordered_json corrections_json(const std::vector<TablesCorrection>& corrections);

/// Reads mode_information_json(). Throws nlohmann::json::exception if it is something else or its sizes do
/// not match.
ModeInformation mode_information_of(const nlohmann::ordered_json& json);

}  // namespace vegard::fit
