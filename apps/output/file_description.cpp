#include "apps/output/file_description.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>

#include "apps/options/file_names.h"
#include "fit/photo/pointing/exchange/aida_camera.h"
#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "fit/photo/pointing/exchange/star_files.h"
#include "sim/base/array/array_format.h"
#include "sim/base/file/input_file.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/shown_text.h"

namespace vegard::apps {
namespace {

std::string solution_text(const fit::SipWcs& wcs) {
  const double scale = std::sqrt(std::abs(wcs.degrees_per_px.determinant()));
  constexpr double kSecondsPerDegree = 3600.0;
  std::string text = fmt::format(
      "  a tangent plane on the sky (Astrometry.net's .wcs)\n  reference    right ascension {:.4f}, "
      "declination {:.4f} deg, J2000, at ({:.2f}, {:.2f}) px\n  scale        {:.2f} seconds of arc a pixel "
      "there\n",
      wcs.reference.right_ascension_deg, wcs.reference.declination_deg, wcs.reference_px.x() - 0.5,
      wcs.reference_px.y() - 0.5, scale * kSecondsPerDegree);
  if (wcs.width_px > 0) text += fmt::format("  size         {} x {} pixels\n", wcs.width_px, wcs.height_px);
  if (wcs.a.order > 0) text += fmt::format("  distortion   SIP of order {}\n", wcs.a.order);
  text += wcs.degrees_per_px.determinant() > 0.0 ? "  the sky is mirrored, rows counted from the top\n" : "";
  return text + "  vegard calibrate --wcs makes a camera of it\n";
}

std::string stars_text(std::string_view bytes, const std::string& path) {
  if (fit::is_star_list(bytes, path)) {
    const fit::StarPoints list = fit::read_star_list(bytes, path);
    std::string text = fmt::format("  {} points of light (Astrometry.net's .axy)\n", list.points.size());
    if (list.frame.known)
      text += fmt::format("  in {} x {} pixels\n", list.frame.width_px, list.frame.height_px);
    return text + "  vegard calibrate with --camera recognises stars among them\n";
  }
  const sim::FitsTable table = sim::read_fits_table(bytes, path);
  std::string names;
  for (const auto& [name, values] : table.columns) names += (names.empty() ? "" : ", ") + name;
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.begin()->second.size();
  std::string text = fmt::format("  a FITS table of {} rows: {}\n", rows, sim::shortened_text(names));
  if (table.columns.count("field_x") != 0)
    text += "  stars that were recognised (Astrometry.net's .corr): vegard calibrate takes them\n";
  return text;
}

std::string aida_text(const std::vector<fit::AidaCamera>& cameras) {
  constexpr std::size_t kMaxShown = 20;
  std::string text =
      fmt::format("  {} camera{} of AIDA_tools\n", cameras.size(), cameras.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < cameras.size() && i < kMaxShown; ++i) {
    const fit::AidaCamera& c = cameras[i];
    text += fmt::format(
        "  line {}: station {:g}, pointed to azimuth {:g}, zenith distance {:g} deg, lens {}, f {:.4f} "
        "{:.4f} of the picture's sides\n",
        c.line, c.station, c.azimuth_deg, c.zenith_deg, c.model, c.numbers[0], c.numbers[1]);
  }
  if (cameras.size() > kMaxShown) text += "  ...\n";
  return text + "  vegard calibrate --acc makes a camera of it\n";
}

std::string word_of(const sim::ArrayWords& words, const std::string& key) {
  for (const auto& [found, value] : words)
    if (found == key) return value;
  return {};
}

std::string netcdf_text(const sim::ArrayFile& file, const sim::ArrayWords& words) {
  std::string text =
      "  netCDF by the conventions " + sim::shortened_text(word_of(words, "Conventions")) + "\n";
  for (const char* key : {"title", "source", "verdict_line"})
    if (const std::string value = word_of(words, key); !value.empty())
      text += fmt::format("  {:<12} {}\n", key, sim::shortened_text(value));
  text += "  variables:\n";
  for (const sim::StoredArray& array : file.arrays()) {
    std::string sizes;
    for (const std::uint64_t size : array.dims) sizes += (sizes.empty() ? "" : " x ") + std::to_string(size);
    const std::string units = word_of(array.words, "units");
    text += fmt::format("    {:<36} {:<14} {:<10} {}\n", sim::shown_text(array.name), sizes,
                        units.empty() ? "-" : sim::shortened_text(units),
                        sim::shortened_text(word_of(array.words, "long_name")));
  }
  return text;
}

std::optional<std::string> fits_text(const std::string& path) {
  const std::string bytes = sim::input_bytes(path, "a FITS file", sim::kMaxPictureBytes);
  const sim::FitsKeywords keywords = sim::read_fits_header(bytes, path);
  const auto axes = keywords.find("NAXIS");
  if (axes == keywords.end() || axes->second != "0") return std::nullopt;  // an image
  if (keywords.count("CTYPE1") != 0) return solution_text(fit::read_sip_wcs(bytes, path));
  const auto is_table = [&] { return bytes.find("XTENSION= 'BINTABLE'") != std::string::npos; };
  if (is_table() && keywords.count("ZIMAGE") == 0 && bytes.find("ZIMAGE") == std::string::npos)
    return stars_text(bytes, path);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> other_file_text(const std::string& path) {
  std::optional<std::string> text;
  if (std::filesystem::path(path).extension() == ".acc") {
    text = aida_text(fit::read_aida_cameras(sim::input_bytes(path, "a camera of AIDA_tools"), path));
  } else if (constexpr std::string_view kFits = "SIMPLE  =";
             sim::read_beginning(path, kFits.size()).bytes == kFits) {
    text = fits_text(path);
  } else if (const sim::ArrayFormat* const format = sim::array_format_of(path);
             format != nullptr && format->open == sim::open_hdf5) {
    const std::unique_ptr<sim::ArrayFile> file = sim::open_array_file(path);
    const auto words = file->words().find("");
    if (words != file->words().end() && word_of(words->second, "Conventions").compare(0, 3, "CF-") == 0)
      text = netcdf_text(*file, words->second);
  }
  if (!text) return std::nullopt;
  return sim::shown_text(file_name_of(path)) + ":\n" + *text;
}

}  // namespace vegard::apps
