#include "sim/scene/freedom/ties.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

std::vector<ParameterPath> resolved(const Scene& scene, const std::string& path, int line) {
  std::vector<ParameterPath> paths;
  with_origin(scene, line, path, [&] { paths = resolve(scene, path); });
  return paths;
}

}  // namespace

void with_origin(const Scene& scene, int line, const std::string& key, const std::function<void()>& what) {
  try {
    what();
  } catch (const Error& error) {
    const std::string& faulty = error.details().key;
    throw Error(error).file(scene.file).line(line).key(faulty.empty() ? key : faulty);
  }
}

std::vector<ParameterPath> paths_of(const Scene& scene, const FreeParameter& free) {
  if (free.path.empty() && !free.name.empty()) return {};
  return resolved(scene, free.path, free.line);
}

std::vector<ParameterPath> paths_of(const Scene& scene, const TiedParameter& tied) {
  return resolved(scene, tied.path, tied.line);
}

bool meet(const std::string& photo, const std::string& other_photo) {
  return photo.empty() || other_photo.empty() || photo == other_photo;
}

namespace {

constexpr double kTieRounding = 1e-9;  // of a limit

bool belongs(const std::string& entry_photo, const std::string& photo) {
  return entry_photo.empty() || entry_photo == photo;
}

/// What an expression may use: names of fit.free, paths of numbers, and these without the sheet's name where
/// there is only one.
std::vector<std::string> usable_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const FreeParameter& free : scene.fit.free)
    if (!free.name.empty()) names.push_back(free.name);
  for (const ParameterPath& path : all_paths(scene)) {
    if (path.row->kind != ParameterKind::real) continue;
    names.push_back(path.text);
    const std::string prefix = "sheet." + (scene.sheets.empty() ? std::string() : scene.sheets[0].name) + ".";
    if (scene.sheets.size() == 1 && path.text.compare(0, prefix.size(), prefix) == 0)
      names.push_back("sheet." + path.text.substr(prefix.size()));
  }
  return names;
}

Tie tie_of(const Scene& scene, const TiedParameter& tied, const std::vector<std::string>& usable) {
  const std::vector<ParameterPath> paths = paths_of(scene, tied);
  if (paths.size() > 1)
    throw scene_error({"one expression for " + std::to_string(paths.size()) + " numbers",
                       "a path to one number", "tie the components one by one"},
                      {scene.file, tied.line, tied.path});
  Tie tie{paths.front(), Expression(tied.equals, usable), {}};
  for (const std::string& name : tie.expression.names()) {
    const bool is_named = std::any_of(scene.fit.free.begin(), scene.fit.free.end(),
                                      [&](const FreeParameter& free) { return free.name == name; });
    Tie::Input input;
    if (is_named)
      input.name = name;
    else
      input.path = resolve(scene, name).front();
    tie.inputs.push_back(input);
  }
  return tie;
}

/// Goes from a tie to those that it uses, and puts them into the order.
class Ordering {
 public:
  Ordering(const Scene& scene, const std::vector<Tie>& ties, const std::vector<int>& lines)
      : scene_(scene), ties_(ties), lines_(lines) {}

  std::vector<Tie> run() {
    for (std::size_t i = 0; i < ties_.size(); ++i) visit(i);
    return ordered_;
  }

 private:
  void visit(std::size_t i) {
    if (done_.count(i) > 0) return;
    const auto before = std::find(way_.begin(), way_.end(), i);
    if (before != way_.end()) {
      std::string circle;
      for (auto at = before; at != way_.end(); ++at) circle += ties_[*at].path.text + ", which needs ";
      throw scene_error({"the ties go in a circle: " + circle + ties_[i].path.text,
                         "numbers that follow from others", "make one of them free"},
                        {scene_.file, lines_[i], ties_[i].path.text});
    }
    way_.push_back(i);
    for (const Tie::Input& input : ties_[i].inputs)
      for (std::size_t k = 0; k < ties_.size(); ++k)
        if (input.path.row != nullptr && ties_[k].path.id == input.path.id) visit(k);
    way_.pop_back();
    done_.insert(i);
    ordered_.push_back(ties_[i]);
  }

  const Scene& scene_;
  const std::vector<Tie>& ties_;
  const std::vector<int>& lines_;
  std::vector<std::size_t> way_;
  std::set<std::size_t> done_;
  std::vector<Tie> ordered_;
};

}  // namespace

bool is_within_limits(const ParameterPath& path, double value) {
  const double min = path.row->min, max = path.row->max;
  return std::isfinite(value) && value >= min - kTieRounding * std::abs(min) &&
         value <= max + kTieRounding * std::abs(max);
}

std::vector<Tie> ties_of(const Scene& scene, const std::string& photo) {
  if (scene.fit.tied.empty()) return {};
  const std::vector<std::string> usable = usable_names(scene);
  std::vector<Tie> ties;
  std::vector<int> lines;
  for (const TiedParameter& tied : scene.fit.tied) {
    if (!belongs(tied.photo, photo)) continue;
    with_origin(scene, tied.line, tied.path, [&] { ties.push_back(tie_of(scene, tied, usable)); });
    lines.push_back(tied.line);
  }
  return Ordering(scene, ties, lines).run();
}

}  // namespace vegard::sim
