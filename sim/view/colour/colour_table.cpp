#include "sim/view/colour/colour_table.h"

#include <algorithm>
#include <cassert>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/table/table_files.h"

namespace vegard::sim {
namespace {

constexpr const char* kTableChannels[3] = {"red", "green", "blue"};
constexpr int kTableRows =
    256;  // of a formula's table: exact at its greys of 8 bits, and straight in between

double ramp(double x, double from, double to) { return std::clamp((x - from) / (to - from), 0.0, 1.0); }

std::array<double, 3> formula(const std::string& name, double x) {
  if (name == "171") return {ramp(x, 0.0, 0.69), x, ramp(x, 0.75, 1.0)};
  if (name == "195") return {x * x, ramp(x, 0.0, 0.8), ramp(x, 0.55, 1.0)};
  if (name == "284") return {ramp(x, 0.0, 0.75), ramp(x, 0.0, 0.85), ramp(x, 0.6, 1.0)};
  return {ramp(x, 0.0, 0.69), ramp(x, 0.47, 1.0), ramp(x, 0.75, 1.0)};
}

}  // namespace

ColourTable ColourTable::named(const std::string& name) {
  ColourTable table;
  if (name == "none") return table;
  assert(name == "171" || name == "195" || name == "284" || name == "304");
  for (int i = 0; i < kTableRows; ++i) {
    const double x = static_cast<double>(i) / (kTableRows - 1);
    table.grey_.push_back(x);
    const std::array<double, 3> rgb = formula(name, x);
    for (int c = 0; c < 3; ++c) table.rgb_[c].push_back(rgb[c]);
  }
  return table;
}

ColourTable::ColourTable(const Scene& scene) {
  const std::string& name = scene.sensor.colour_table;
  if (!is_table_file(name)) {
    *this = named(name);
    return;
  }
  const std::string place = table_place(scene, name);
  const CsvTable csv = read_csv_table(table_text(scene, "sensor.colour_table"), place);
  csv.require_within("grey", 0.0, 1.0);
  csv.require_increasing("grey");
  for (int c = 0; c < 3; ++c) csv.require_within(kTableChannels[c], 0.0, 1.0);
  grey_ = csv.column("grey");
  for (int c = 0; c < 3; ++c) rgb_[c] = csv.column(kTableChannels[c]);
  for (const bool first : {true, false})
    if ((first ? grey_.front() : grey_.back()) != (first ? 0.0 : 1.0))
      throw unreadable(place, first ? "the table begins above black" : "the table ends below white")
          .line(first ? csv.lines.front() : csv.lines.back())
          .key("sensor.colour_table")
          .expected("rows from grey 0 to grey 1");
}

std::array<double, 3> ColourTable::at(double grey) const {
  const double x = grey > 0.0 ? std::min(grey, 1.0) : 0.0;  // what is no number is black
  if (is_none()) return {x, x, x};
  const auto above = std::upper_bound(grey_.begin(), grey_.end(), x);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(above - grey_.begin()), grey_.size() - 1);
  const double t = (x - grey_[i - 1]) / (grey_[i] - grey_[i - 1]);
  std::array<double, 3> rgb;
  for (int c = 0; c < 3; ++c) rgb[c] = rgb_[c][i - 1] + t * (rgb_[c][i] - rgb_[c][i - 1]);
  return rgb;
}

void ColourTable::colour(Image& shown) const {
  if (is_none()) return;
  assert(shown.channels() == 3);
  for (std::size_t p = 0; p < shown.data.size(); p += 3) {
    float* rgb = shown.data.data() + p;
    const std::array<double, 3> colour = at((static_cast<double>(rgb[0]) + rgb[1] + rgb[2]) / 3.0);
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(colour[c]);
  }
}

}  // namespace vegard::sim
