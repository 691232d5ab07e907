// How much memory a command may take, and what is said of one that would take more.
#pragma once

#include <cstdint>
#include <string>

#include "apps/options/command.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Adds --memory-limit: "4G", "500M", "2.5" (GB, of 2^30 bytes). `words` stays empty if it is not given, and
/// must outlive the parsing.
Option add_memory_option(
    const Command& command, std::string& words,
    const std::string& meaning = "Refuse what would take more memory (default: most of what is free)");

/// In bytes; without words four fifths of what the machine has left (sim/base/available_memory.h). Infinity
/// where that is not known.
double memory_limit_bytes(const std::string& words);

/// sim::threads_to_render() within that limit.
int threads_to_render(const sim::Scene& scene, int threads, double bytes_per_px, bool sheet_layers,
                      const std::string& memory_words);

/// fit::require_memory_of_fit() within that limit. Reports on standard error, before it begins, a fit that
/// will take more than 2 GB.
void check_memory_of_fit(const sim::Scene& scene, int threads, const std::string& memory_words);

}  // namespace vegard::apps
