// Any text as a scene file. Its comments that begin with "#set" are applied to it as --set would be, so that
// one input holds both; what is read is worked out as far as a fit or a picture needs it, and written again.
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "sim/base/error.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/ties.h"
#include "sim/scene/table/parameter_table.h"

namespace {

using namespace vegard;

void require(bool promise) {
  if (!promise) std::abort();
}

/// False if it was refused as scenes are.
template <typename Use>
bool accepted(const Use& use) {
  try {
    use();
    return true;
  } catch (const sim::Error& error) {
    require(error.kind() == sim::ErrorKind::scene && !error.details().problem.empty());
    return false;
  }
}

/// "#set path = text" of every line that begins so.
void apply_sets(sim::Scene& scene, const std::string& text) {
  constexpr std::string_view kStart = "#set ";
  int sets = 0;
  for (std::size_t at = text.find(kStart); at != std::string::npos && sets < 8;
       at = text.find(kStart, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    std::string line = text.substr(at + kStart.size());
    line.resize(std::min(line.size(), line.find('\n')));
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    ++sets;
    accepted([&] { sim::set_from_text(scene, line.substr(0, equals), line.substr(equals + 1)); });
  }
}

/// Ties with all their inputs at 1.5.
void work_out_ties(const sim::Scene& scene) {
  for (const sim::Tie& tie : sim::ties_of(scene)) {
    const std::vector<double> values(tie.inputs.size(), 1.5);
    sim::is_within_limits(tie.path, tie.expression.value(values));
    require(tie.expression.slopes(values).size() == values.size());
  }
}

/// What is written reads as the same scene.
void write_and_read(const sim::Scene& scene) {
  const std::string written = sim::write_scene(scene);
  require(sim::write_scene(sim::parse_scene(written, scene.file)) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  sim::Scene scene;
  const bool read = accepted([&] { scene = sim::parse_scene(text, "scene.toml"); });
  if (!read) {
    scene = sim::Scene();
    scene.sheets.emplace_back();
  }
  apply_sets(scene, text);
  if (!accepted([&] { sim::validate(scene); })) return 0;
  accepted([&] { work_out_ties(scene); });
  bool written = true;
  try {
    write_and_read(scene);
  } catch (const sim::Error&) {
    written = false;
  }
  require(written);
  return 0;
}
