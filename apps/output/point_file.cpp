#include "apps/output/point_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "apps/options/refusals.h"
#include "sim/base/error.h"
#include "sim/base/text.h"
#include "sim/base/version.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::apps {
namespace {

/// Linear light of which only the colour is given: the largest component is 1, what is out of gamut is 0.
std::array<float, 3> colour_of(const float* photons_per_s, const std::vector<sim::Vector3>& rgb) {
  sim::Vector3 sum{};
  for (std::size_t l = 0; l < rgb.size(); ++l)
    for (int c = 0; c < 3; ++c) sum[c] += photons_per_s[l] * rgb[l][c];
  const double largest = *std::max_element(sum.begin(), sum.end());
  std::array<float, 3> colour{};
  for (int c = 0; c < 3; ++c)
    colour[c] = largest > 0.0 ? static_cast<float>(std::max(sum[c], 0.0) / largest) : 0.0f;
  return colour;
}

/// Little-endian, whatever the machine is.
void append_binary(float number, std::string& to) {
  std::uint32_t bits;
  std::memcpy(&bits, &number, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>(bits >> shift & 0xff);
}

std::vector<std::string> remarks_on(const sim::Scene& scene, const std::string& unit, int every) {
  std::vector<std::string> remarks = {
      "vegard " + sim::version() + ", seed " + std::to_string(scene.seed) +
          fmt::format(", time.start_s {}", scene.time.start_s),
      "x east, y north, z up, in " + unit + ", the observer at the origin",
      "line_*: photons per second into all directions, by wavelength in tenths of a nanometre",
      "red green blue: linear light (" + sim::word_of(scene.sensor.primaries) +
          "), only its colour: the largest is 1; brightness is in the lines"};
  remarks.push_back(every == 1 ? "every beam"
                               : fmt::format("one of {} beams, with the light of all of them", every));
  return remarks;
}

}  // namespace

PointFormat point_format(const std::string& path) {
  const std::string extension = sim::lowered_extension(path);
  if (extension == ".ply") return PointFormat::ply;
  if (extension == ".csv") return PointFormat::csv;
  throw usage_error("--output", "'" + path + "' cannot hold points", "a name that ends in .ply or .csv");
}

PointFile::PointFile(const std::string& path, const sim::Scene& scene, const std::string& unit, int every,
                     bool overwrite)
    : path_(path),
      format_(point_format(path)),
      unit_(unit),
      remarks_(remarks_on(scene, unit, every)),
      columns_({"x", "y", "z"}),
      rgb_(sim::line_colours_at_unit_gain(scene)),
      scale_(unit == "m" ? 1000.0f : 1.0f),
      file_(path, overwrite),
      stream_(std::fopen(file_.temporary().c_str(), "wb")) {
  for (const double nm : scene.emission.lines) columns_.push_back("line_" + sim::line_name(nm));
  for (const char* name : {"red", "green", "blue"}) columns_.emplace_back(name);
  if (!stream_) throw sim::unwritable(path_, errno);
  put(header());
}

/// As long for any number of points, so that it can be written over when that is known.
std::string PointFile::header() const {
  std::string text;
  if (format_ == PointFormat::csv) {
    for (const std::string& remark : remarks_) text += "# " + remark + "\n";
    return text + sim::joined(columns_, ",") + "\n";
  }
  constexpr std::size_t kDigits = 20;  // of the largest 64-bit number
  const std::string count = std::to_string(count_);
  text = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& remark : remarks_) text += "comment " + remark + "\n";
  text += "comment " + std::string(kDigits - count.size(), '-') + "\n";
  text += "element vertex " + count + "\n";
  for (const std::string& column : columns_) text += "property float " + column + "\n";
  return text + "end_header\n";
}

void PointFile::put(const std::string& bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size())
    throw sim::unwritable(path_, errno);
}

void PointFile::write(const sim::EmissionPoints& points) {
  std::string bytes;
  std::vector<float> row(columns_.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* light = points.photons_per_s.data() + i * points.lines;
    for (int k = 0; k < 3; ++k) row[k] = points.position_in_enu_km[i * 3 + k] * scale_;
    std::copy(light, light + points.lines, row.begin() + 3);
    const std::array<float, 3> colour = colour_of(light, rgb_);
    std::copy(colour.begin(), colour.end(), row.begin() + 3 + points.lines);
    if (format_ == PointFormat::ply) {
      for (const float number : row) append_binary(number, bytes);
    } else {
      fmt::format_to(std::back_inserter(bytes), "{}\n", fmt::join(row, ","));
    }
  }
  put(bytes);
  count_ += points.size();
}

void PointFile::commit() {
  if (std::fseek(stream_.get(), 0, SEEK_SET) != 0) throw sim::unwritable(path_, errno);
  put(header());
  if (std::fclose(stream_.release()) != 0) throw sim::unwritable(path_, errno);
  file_.commit();
}

}  // namespace vegard::apps
