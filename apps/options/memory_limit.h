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

/// Throws Error(usage), about the option unless the scene's own `key` is named, if `bytes` are more than the
/// limit. `what` takes them: "a picture of 8000 x 6000 pixels"; `hint` says how to need less.
void require_memory(const std::string& words, double bytes, const std::string& what, const std::string& hint);

/// With as many threads as may be used, at most the number asked for (0: all cores), so that a picture of the
/// scene can be made within the limit: the result is the same. Throws as require_memory() if one is too many.
int threads_to_render(const sim::Scene& scene, int threads, double bytes_per_px, bool sheet_layers,
                      const std::string& memory_words);

/// Throws as require_memory() if a fit of the scene's photographs would take more than the limit. How much it
/// takes depends on how much of the picture is lit: without words it must be too much even for a picture that
/// is half dark. Tells on standard error, before it begins, of a fit that will take more than 2 GB.
void check_memory_of_fit(const sim::Scene& scene, int threads, const std::string& memory_words);

}  // namespace vegard::apps
