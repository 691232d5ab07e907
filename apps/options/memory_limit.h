// The limit of a command's memory, and its messages.
#pragma once

#include <string>

#include "apps/options/command.h"
#include "sim/render/needed_memory.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Adds --memory-limit: "4G", "500M", "2.5" (GB, of 2^30 bytes). `words` stays empty if it is not given, and
/// must outlive the parsing.
Option add_memory_option(
    const Command& command, std::string& words,
    const std::string& meaning =
        "Refuse work that needs more memory: 500M, 8G (default: four fifths of what is free)");

/// Returns the limit in bytes; if `words` is empty, four fifths of the machine's free memory
/// (sim/base/memory_limit.h), or infinity where that is not known.
double memory_limit_bytes(const std::string& words);

/// sim::threads_to_render() within that limit.
int threads_to_render(const sim::Scene& scene, int threads, const sim::RenderingUse& use,
                      const std::string& memory_words);

/// fit::require_memory_of_fit() within that limit. Also prints a note on standard error if the fit will take
/// more than 2 GB.
void check_memory_of_fit(const sim::Scene& scene, int threads, const std::string& memory_words);

}  // namespace vegard::apps
